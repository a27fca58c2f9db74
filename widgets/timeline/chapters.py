"""The whole run as chapters in one row: a stage with its key, what goes in and out of it, how much of it is done."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum, IntEnum
from functools import lru_cache

from PySide6.QtCore import QEvent, QPoint, QRect, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QColor,
    QEnterEvent,
    QFont,
    QFontMetrics,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QAbstractButton, QApplication, QSizePolicy, QWidget

from widgets.basics.controls import row_layout
from widgets.basics.drawing import blended
from widgets.basics.theme import Theme, current_theme, text_font, theme_notifier

# One chapter of the run: a stage with its key, what goes in and out of it, and how much of it is done.


_SIDE = 6
"""Room at both sides of a chapter's text."""
_STRIP = 3
"""Height of the strip that shows how much of a chapter is done."""
_TICK = 3
"""By how much the tick in it is higher."""


class ChapterState(Enum):
    """Where a chapter lies in the run; each has a word and a look."""

    DONE = "done"
    CURRENT = "current"
    AHEAD = "not yet stepped"
    SKIPPED = "not needed"


class Spelling(IntEnum):
    """How much of a chapter is written; all chapters of a row are spelled alike, as fully as the row has room."""

    WORDS = 0
    UNITS = 1
    TITLE = 2
    KEY = 3


@dataclass(frozen=True)
class Chapter:
    """One stage of the run."""

    title: str
    key: str = ""
    """The key that enters it, such as ``3``."""
    counts: str = ""
    """What goes in and out, in words: ``12 triangles → 2,060 pixels``."""
    short_counts: str = ""
    """The same with the units' signs: ``12 tri → 2,060 px``."""
    duration: str = ""
    """Measured time with the share of all stages, for the tooltip."""
    state: ChapterState = ChapterState.AHEAD
    is_inserted: bool = False
    """The pipeline has put it in by itself, to provide what a later stage needs."""
    reason: str = ""
    """Why it is not needed or was inserted."""

    def second_line(self, spelling: Spelling) -> str:
        """Return what stands under the title."""
        if spelling >= Spelling.TITLE:
            return ""
        if self.state is ChapterState.SKIPPED:
            return str(self.state.value)
        return self.counts if spelling is Spelling.WORDS else self.short_counts


class ChapterButton(QAbstractButton):
    """One chapter: key and title, counts, and a strip as long as what is done of it."""

    def __init__(self, chapter: Chapter, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._chapter = chapter
        self._spelling = Spelling.WORDS
        self._share_done = 0.0
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.show_chapter(chapter)

    def show_chapter(self, chapter: Chapter) -> bool:
        """Show another state of the stage; return whether it looks otherwise, and not only the tooltip."""
        before, self._chapter = self._chapter, chapter
        words = [chapter.state.value] + ["inserted"] * chapter.is_inserted
        status = ", ".join(words) + (f": {chapter.reason}" if chapter.reason else "")
        figures = ", ".join(part for part in (chapter.counts, chapter.duration) if part)
        key = f" ({chapter.key})" if chapter.key else ""
        self.setToolTip("\n".join(part for part in (f"{chapter.title}{key}", figures, status) if part))
        self.setAccessibleName(f"Stage {chapter.title}")
        self.setAccessibleDescription(", ".join(part for part in (status, figures) if part))
        is_other = replace(before, duration=chapter.duration, reason=chapter.reason) != chapter
        if is_other:
            self.update()
        return is_other

    def chapter(self) -> Chapter:
        """Return what is shown."""
        return self._chapter

    def show_spelling(self, spelling: Spelling) -> None:
        """Write more or less of the chapter."""
        if spelling is not self._spelling:
            self._spelling = spelling
            self.update()

    def show_share_done(self, share: float) -> None:
        """Show how much of the present chapter is done, 0 to 1."""
        if share != self._share_done:
            self._share_done = share
            self.update(self._strip())

    def wanted_width(self, spelling: Spelling) -> int:
        """Return the width in pixels that a spelling needs."""
        return _wanted_width(self._chapter, spelling, current_theme())

    def sizeHint(self) -> QSize:
        """Room for a title and a line of counts."""
        height = sum(_line_heights(current_theme()))
        return QSize(self.wanted_width(self._spelling), max(height + _STRIP + 5, 24))

    def minimumSizeHint(self) -> QSize:
        """As tall as wanted, and wide enough to be hit."""
        return QSize(24, self.sizeHint().height())

    def enterEvent(self, event: QEnterEvent) -> None:
        """Light up under the mouse."""
        super().enterEvent(event)
        self.update()

    def leaveEvent(self, event: QEvent) -> None:
        """Be as before."""
        super().leaveEvent(event)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw ground and state, the two lines and the strip; or only the strip, where it alone has changed."""
        theme, chapter = current_theme(), self._chapter
        is_current = chapter.state is ChapterState.CURRENT
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint_ground(painter)
        self._paint_strip(painter)
        left, right, top = _SIDE, self.width() - _SIDE + 2, 2
        title_height, line_height = _line_heights(theme)
        flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        line = chapter.second_line(self._spelling)
        if not line:
            top = (self.height() - _STRIP - title_height) // 2
        # Of the text only its second line comes near the strip.
        is_whole = not self._strip().contains(event.rect())
        if chapter.key and is_whole:
            painter.setFont(self._small_font())
            painter.setPen(QColor(theme.muted_text))
            painter.drawText(QRect(left, top, right - left, title_height), flags, chapter.key)
            left += _small_width(chapter.key, theme) + 4
        if is_whole and (self._spelling < Spelling.KEY or is_current or not chapter.key):
            painter.setFont(self._title_font(is_bold=is_current))
            is_dim = chapter.state is ChapterState.SKIPPED
            painter.setPen(QColor(theme.muted_text if is_dim else theme.text))
            painter.drawText(QRect(left, top, right - left, title_height), flags, chapter.title)
        if line:
            painter.setFont(self._small_font())
            painter.setPen(QColor(theme.muted_text))
            box = QRect(_SIDE, top + title_height, right - _SIDE, line_height)
            painter.drawText(box, flags, line)

    def _strip(self) -> QRect:
        """Return where the strip is, with its tick."""
        height = _STRIP + _TICK + 1
        return QRect(0, self.height() - height, self.width(), height)

    def _paint_ground(self, painter: QPainter) -> None:
        """Draw the card: raised where there is work, an outline that is open below for the present chapter."""
        theme, state = current_theme(), self._chapter.state
        box = QRectF(self.rect()).adjusted(1.0, 1.0, -1.0, -1.0)
        ground = QColor(theme.window if state is ChapterState.SKIPPED else theme.panel)
        if state is ChapterState.CURRENT:
            ground = blended(theme.accent, theme.panel, 0.12)
        elif self.isDown() or self.underMouse():
            ground = QColor(theme.selection)
        painter.fillRect(box, ground)
        if state is ChapterState.CURRENT:
            painter.setPen(QPen(QColor(theme.accent), 2.0))
            corners = (box.bottomLeft(), box.topLeft(), box.topRight(), box.bottomRight())
            painter.drawPolyline(QPolygonF(corners))
        elif state is ChapterState.SKIPPED or self._chapter.is_inserted:
            painter.setPen(QPen(QColor(theme.outline), 1.0, Qt.PenStyle.DashLine))
            painter.drawRect(box)
        if self.hasFocus():
            painter.setPen(QPen(QColor(theme.focus), 2.0))
            painter.drawRect(box.adjusted(2.0, 2.0, -2.0, -2.0))

    def _paint_strip(self, painter: QPainter) -> None:
        """Draw how much of the chapter is done, with a tick of the accent where the run is."""
        theme, state = current_theme(), self._chapter.state
        if state is ChapterState.SKIPPED:
            return
        share = self._share_done if state is ChapterState.CURRENT else float(state is ChapterState.DONE)
        track = QRectF(1.0, self.height() - _STRIP - 1.0, self.width() - 2.0, _STRIP)
        painter.fillRect(track, QColor(theme.selection))
        painter.fillRect(
            QRectF(track.left(), track.top(), track.width() * share, track.height()), QColor(theme.muted_text)
        )
        if state is ChapterState.CURRENT:
            x = min(track.left() + track.width() * share, track.right() - 3.0)
            painter.fillRect(QRectF(x, track.top() - _TICK, 3.0, _STRIP + _TICK), QColor(theme.accent))

    def _title_font(self, *, is_bold: bool = False) -> QFont:
        return _title_font(current_theme(), is_bold=is_bold)

    def _small_font(self) -> QFont:
        return text_font(current_theme(), current_theme().small_px)


def _wanted_width(chapter: Chapter, spelling: Spelling, theme: Theme) -> int:
    # The title may become bold, and a stage may become needed, while nothing should move.
    name, key = _title_width(chapter.title, theme), _small_width(chapter.key, theme)
    if spelling is Spelling.KEY and chapter.key and chapter.state is not ChapterState.CURRENT:
        return key + 2 * _SIDE
    title = name + (key + 4 if chapter.key else 0)
    return max(title, _small_width(chapter.second_line(spelling), theme)) + 2 * _SIDE


@lru_cache(maxsize=64)
def _title_width(text: str, theme: Theme) -> int:
    return QFontMetrics(_title_font(theme, is_bold=True)).horizontalAdvance(text)


@lru_cache(maxsize=256)
def _small_width(text: str, theme: Theme) -> int:
    return QFontMetrics(text_font(theme, theme.small_px)).horizontalAdvance(text)


@lru_cache(maxsize=8)
def _line_heights(theme: Theme) -> tuple[int, int]:
    """Return the heights of the title and of the line of counts."""
    fonts = _title_font(theme), text_font(theme, theme.small_px)
    return QFontMetrics(fonts[0]).height(), QFontMetrics(fonts[1]).height()


def _title_font(theme: Theme, *, is_bold: bool = False) -> QFont:
    font = text_font(theme)
    font.setBold(is_bold)
    return font


# The whole run as chapters in one row: a chapter per stage, what goes in and out of it, and how far the run
# is.


class ChapterRow(QWidget):
    """A row of chapters; a click enters one, a drag scrubs through the whole run, arrows and Enter choose."""

    chapter_chosen = Signal(int)
    """The user enters a chapter, by its place in the row."""
    run_scrubbed = Signal(int, float)
    """The user drags to a place in the run: the chapter's place in the row and the share of it that is done."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._buttons: list[ChapterButton] = []
        self._rooms: dict[Spelling, list[int]] = {}
        """Room that each chapter has needed so far: numbers that change many times a second must move nothing."""
        self._pressed_at: QPoint | None = None
        self._is_scrubbing = False
        self._row = row_layout(self, 2)
        self.setAccessibleName("Stages of the run")
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme_notifier().theme_changed.connect(self._fit_anew)

    @Slot(object)
    def show_chapters(self, chapters: Sequence[Chapter]) -> None:
        """Show the chapters in order; buttons are kept where their number stays."""
        changed = []
        while len(self._buttons) > len(chapters):
            button = self._buttons.pop()
            self._row.removeWidget(button)
            button.hide()
            button.deleteLater()
        for place, chapter in enumerate(chapters):
            if place == len(self._buttons):
                button = ChapterButton(chapter, self)
                button.clicked.connect(self._choose)
                button.installEventFilter(self)
                self._buttons.append(button)
                self._row.addWidget(button)
            elif self._buttons[place].chapter() != chapter and self._buttons[place].show_chapter(chapter):
                changed.append(place)
        self._share_width(changed)
        self._set_tab_stop()

    @Slot(float)
    def show_share_done(self, share: float) -> None:
        """Show how much of the present chapter is done, 0 to 1."""
        for button in self._buttons:
            if button.chapter().state is ChapterState.CURRENT:
                button.show_share_done(share)

    def buttons(self) -> tuple[ChapterButton, ...]:
        """Return the buttons in order."""
        return tuple(self._buttons)

    def minimumSizeHint(self) -> QSize:
        """Keep the window free to be narrow; less is then written."""
        height = max((button.sizeHint().height() for button in self._buttons), default=24)
        return QSize(26 * max(1, len(self._buttons)), height)

    def sizeHint(self) -> QSize:
        """As wide as may be: the row writes what it has room for."""
        return QSize(sum(self._rooms.get(Spelling.WORDS, [0])), self.minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Write as much as fits now."""
        super().resizeEvent(event)
        self._fit_anew()

    def eventFilter(self, watched: object, event: QEvent) -> bool:
        """Scrub with the mouse; move among the chapters with the arrow keys while one has the focus."""
        if isinstance(event, QMouseEvent) and isinstance(watched, ChapterButton):
            return self._follow_mouse(watched, event)
        if isinstance(event, QKeyEvent) and watched in self._buttons:
            return self._follow_key(self._buttons.index(watched), event)
        return False

    def _follow_mouse(self, button: ChapterButton, event: QMouseEvent) -> bool:
        """Scrub once the mouse has moved far enough; a click stays the button's."""
        at = button.mapToParent(event.position().toPoint())
        if event.type() == QEvent.Type.MouseButtonPress and event.button() == Qt.MouseButton.LeftButton:
            self._pressed_at = at
        elif event.type() == QEvent.Type.MouseMove and self._pressed_at is not None:
            moved = abs(at.x() - self._pressed_at.x())
            if self._is_scrubbing or moved >= QApplication.startDragDistance():
                self._is_scrubbing = True
                button.setDown(False)
                self._scrub_to(at.x())
            return True
        elif event.type() == QEvent.Type.MouseButtonRelease:
            was_scrubbing, self._is_scrubbing, self._pressed_at = self._is_scrubbing, False, None
            return was_scrubbing
        return False

    def _scrub_to(self, x: int) -> None:
        place = max((k for k, button in enumerate(self._buttons) if button.x() <= x), default=0)
        button = self._buttons[place]
        self.run_scrubbed.emit(place, min(max((x - button.x()) / button.width(), 0.0), 1.0))

    def _follow_key(self, place: int, event: QKeyEvent) -> bool:
        moves = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}
        ends = {Qt.Key.Key_Home: 0, Qt.Key.Key_End: len(self._buttons) - 1}
        key = Qt.Key(event.key())
        is_choice = key in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space)
        if event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier or not (
            key in moves or key in ends or is_choice
        ):
            return False
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        if event.type() == QEvent.Type.KeyPress:
            if is_choice:
                self.chapter_chosen.emit(place)
            else:
                target = min(max(ends.get(key, place + moves.get(key, 0)), 0), len(self._buttons) - 1)
                self._buttons[target].setFocus(Qt.FocusReason.TabFocusReason)
            return True
        return False

    def _share_width(self, changed: Sequence[int] = ()) -> None:
        """Spell as fully as the row has room, and share its width by what each chapter writes.

        ``changed``: places of the chapters that write something else, where their number is the same.
        """
        for spelling in Spelling:
            rooms = self._rooms.setdefault(spelling, [])
            if len(rooms) != len(self._buttons):
                rooms = self._rooms[spelling] = [button.wanted_width(spelling) for button in self._buttons]
            for place in changed:
                rooms[place] = max(rooms[place], self._buttons[place].wanted_width(spelling))
        gaps = self._row.spacing() * max(len(self._buttons) - 1, 0)
        fitting = (each for each in Spelling if sum(self._rooms[each]) + gaps <= self.width())
        spelling = next(fitting, Spelling.KEY)
        for place, (button, width) in enumerate(zip(self._buttons, self._rooms[spelling], strict=True)):
            button.show_spelling(spelling)
            self._row.setStretch(place, width)

    def _set_tab_stop(self) -> None:
        """Make the present chapter the one that Tab reaches."""
        states = [button.chapter().state for button in self._buttons]
        stop = states.index(ChapterState.CURRENT) if ChapterState.CURRENT in states else 0
        for place, button in enumerate(self._buttons):
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus if place == stop else Qt.FocusPolicy.NoFocus)

    @Slot()
    def _choose(self) -> None:
        button = self.sender()
        for place, candidate in enumerate(self._buttons):
            if candidate is button:
                self.chapter_chosen.emit(place)

    @Slot()
    def _fit_anew(self) -> None:
        self._rooms.clear()
        self._share_width()
        self.updateGeometry()
        self.update()
