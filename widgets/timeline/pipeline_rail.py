"""The stages of the pipeline in a row: what goes in and out, how long it takes, where we are."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from PySide6.QtCore import QEvent, QRect, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import QColor, QFont, QFontMetrics, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QSizePolicy, QWidget

from widgets.basics.controls import row_layout
from widgets.basics.marks import blended
from widgets.basics.theme import current_theme, theme_notifier

_BAR_ROOM = 5
"""Height of the bar of a stage's share of the time, with the gap above it."""


class StageState(Enum):
    """Where a stage stands; each has a word and a look."""

    WAITING = "not run yet"
    DONE = "done"
    CURRENT = "current"
    SKIPPED = "not needed"
    INSERTED = "inserted"


@dataclass(frozen=True)
class StageEntry:
    """One stage as the rail shows it."""

    name: str
    key: str = ""
    """The key that chooses it, such as ``3``."""
    counts: str = ""
    """What goes in and out, such as ``12 → 8``."""
    unit: str = ""
    """What is counted, such as ``triangles``."""
    duration: str = ""
    """Measured time, such as ``0.4 ms``."""
    state: StageState = StageState.DONE
    is_inserted: bool = False
    """The pipeline has put it in by itself, to provide what a later stage needs."""
    reason: str = ""
    """Why it is not needed or was inserted."""
    share: float | None = None
    """Part of the whole time, 0 to 1, shown as a bar; ``None``: not known."""


class StageButton(QAbstractButton):
    """One stage: key and name, counts, time, and a bar as long as its share of the time."""

    def __init__(self, entry: StageEntry, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._entry = entry
        self._is_under_mouse = False
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.show_entry(entry)

    def show_entry(self, entry: StageEntry) -> None:
        """Show another state of the stage."""
        self._entry = entry
        words = [entry.state.value]
        if entry.is_inserted and entry.state is not StageState.INSERTED:
            words.append(StageState.INSERTED.value)
        status = f"{', '.join(words)}: {entry.reason}" if entry.reason else ", ".join(words)
        counted = f"{entry.counts} {entry.unit}".strip()
        figures = " in ".join(part for part in (counted, entry.duration) if part)
        if entry.share is not None:
            figures += f", {100 * entry.share:.0f} % of all stages"
        key = f" ({entry.key})" if entry.key else ""
        self.setToolTip("\n".join(part for part in (f"{entry.name}{key}", figures, status) if part))
        self.setAccessibleName(f"Stage {entry.name}")
        self.setAccessibleDescription(", ".join(part for part in (status, figures) if part))
        self.updateGeometry()
        self.update()

    def entry(self) -> StageEntry:
        """Return what is shown."""
        return self._entry

    def sizeHint(self) -> QSize:
        """Room for the widest of the three lines, and the bar below them."""
        entry = self._entry
        name = QFontMetrics(self._name_font(is_bold=True)).horizontalAdvance(entry.name)
        small = QFontMetrics(self._small_font())
        key = small.horizontalAdvance(entry.key) + 6 if entry.key else 0
        lines = (entry.counts or self._state_word(), f"{entry.unit}  {entry.duration}")
        width = max(name + key, *(small.horizontalAdvance(line) for line in lines))
        height = QFontMetrics(self._name_font()).height() + 2 * small.height() + 12 + _BAR_ROOM
        return QSize(width + 14, height)

    def minimumSizeHint(self) -> QSize:
        """Never narrower than the name."""
        return QSize(36, self.sizeHint().height())

    def event(self, event: QEvent) -> bool:
        """Light up under the mouse."""
        if event.type() in (QEvent.Type.Enter, QEvent.Type.Leave):
            self._is_under_mouse = event.type() == QEvent.Type.Enter
            self.update()
        return super().event(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw ground, state, the three lines and the bar."""
        del event
        theme = current_theme()
        entry = self._entry
        is_current = entry.state is StageState.CURRENT
        is_dim = entry.state in (StageState.SKIPPED, StageState.WAITING)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint_ground(painter, is_current=is_current)
        small = QFontMetrics(self._small_font())
        inner = self.rect().adjusted(7, 4, -7, -6)
        name_height = QFontMetrics(self._name_font()).height()
        left = inner.left()
        middle = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        if entry.key:
            painter.setFont(self._small_font())
            painter.setPen(QColor(theme.muted_text))
            key_width = small.horizontalAdvance(entry.key)
            painter.drawText(QRect(left, inner.top(), key_width + 2, name_height), middle, entry.key)
            left += key_width + 6
        name_font = self._name_font(is_bold=is_current)
        painter.setFont(name_font)
        painter.setPen(QColor(theme.muted_text if is_dim else theme.text))
        room = inner.right() - left + 4
        name = QFontMetrics(name_font).elidedText(entry.name, Qt.TextElideMode.ElideRight, room)
        painter.drawText(QRect(left, inner.top(), room, name_height), middle, name)
        painter.setFont(self._small_font())
        painter.setPen(QColor(theme.muted_text))
        room = small.horizontalAdvance(f"{entry.unit}  {entry.duration}")
        figures = (entry.unit, entry.duration) if room <= inner.width() else (entry.unit or entry.duration,)
        lines = [entry.counts or self._state_word(), "  ".join(figures)]
        for number, line in enumerate(lines):
            top = inner.top() + name_height + 1 + number * small.height()
            text = small.elidedText(line, Qt.TextElideMode.ElideRight, inner.width() + 4)
            painter.drawText(QRect(inner.left(), top, inner.width() + 6, small.height()), middle, text)
        if entry.share is not None:
            self._paint_share(painter, entry.share)

    def _paint_share(self, painter: QPainter, share: float) -> None:
        """Draw the bar: neutral, for the accent says where we are."""
        theme = current_theme()
        track = QRectF(7.0, self.height() - 9.0, self.width() - 14.0, 3.0)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(theme.selection))
        painter.drawRect(track)
        painter.setBrush(QColor(theme.muted_text))
        painter.drawRect(QRectF(track.left(), track.top(), track.width() * min(share, 1.0), track.height()))

    def _paint_ground(self, painter: QPainter, *, is_current: bool) -> None:
        theme = current_theme()
        box = QRectF(self.rect()).adjusted(1.0, 1.0, -1.0, -1.0)
        ground = QColor(theme.panel)
        if is_current:
            ground = blended(theme.accent, theme.panel, 0.12)
        elif self.isDown() or self._is_under_mouse:
            ground = QColor(theme.selection)
        elif self._entry.state is StageState.SKIPPED:
            ground = QColor(theme.window)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(ground)
        painter.drawRoundedRect(box, 3.0, 3.0)
        if is_current:
            painter.fillRect(QRectF(box.left(), box.bottom() - 3.0, box.width(), 3.0), QColor(theme.accent))
        outline = None
        if self.hasFocus():
            outline = QPen(QColor(theme.focus), 2.0)
        elif self._entry.is_inserted or self._entry.state is StageState.INSERTED:
            outline = QPen(QColor(theme.outline), 1.0, Qt.PenStyle.DashLine)
        if outline is not None:
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(outline)
            painter.drawRoundedRect(box, 3.0, 3.0)

    def _state_word(self) -> str:
        states = (StageState.SKIPPED, StageState.INSERTED, StageState.WAITING)
        return self._entry.state.value if self._entry.state in states else ""

    def _name_font(self, *, is_bold: bool = False) -> QFont:
        font = QFont(self.font())
        font.setPixelSize(current_theme().text_px)
        font.setBold(is_bold)
        return font

    def _small_font(self) -> QFont:
        font = QFont(self.font())
        font.setPixelSize(current_theme().small_px)
        font.setFeature(QFont.Tag("tnum"), 1)
        return font


class PipelineRail(QWidget):
    """A row of stages; Tab enters it, arrows move in it, Enter or Space chooses."""

    stage_chosen = Signal(int)
    """The user has chosen a stage by its place in the row."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._buttons: list[StageButton] = []
        self._widest: list[int] = []
        """Room that each stage has needed so far: numbers that change many times a second must move nothing."""
        self._row = row_layout(self, 2)
        self.setAccessibleName("Pipeline")
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme_notifier().theme_changed.connect(self._follow_theme)

    @Slot(object)
    def show_stages(self, entries: Sequence[StageEntry]) -> None:
        """Show the stages in order; buttons are kept where their number stays."""
        while len(self._buttons) > len(entries):
            button = self._buttons.pop()
            self._row.removeWidget(button)
            button.hide()
            button.deleteLater()
        for place, entry in enumerate(entries):
            if place == len(self._buttons):
                button = StageButton(entry, self)
                button.clicked.connect(self._choose)
                button.installEventFilter(self)
                self._buttons.append(button)
                self._row.addWidget(button)
            elif self._buttons[place].entry() != entry:
                self._buttons[place].show_entry(entry)
        self._share_width()
        self._set_tab_stop()

    def buttons(self) -> tuple[StageButton, ...]:
        """Return the buttons in order."""
        return tuple(self._buttons)

    def minimumSizeHint(self) -> QSize:
        """Keep the window free to be narrow; names are then shortened."""
        height = max((button.sizeHint().height() for button in self._buttons), default=52)
        return QSize(40 * max(1, len(self._buttons)), height)

    def sizeHint(self) -> QSize:
        """Room for every line of every stage."""
        width = sum(button.sizeHint().width() + self._row.spacing() for button in self._buttons)
        return QSize(width, self.minimumSizeHint().height())

    def eventFilter(self, watched: object, event: QEvent) -> bool:
        """Move among the stages with the arrow keys while one has the focus."""
        if isinstance(event, QKeyEvent) and watched in self._buttons:
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
                place = next(k for k, button in enumerate(self._buttons) if button is watched)
                if is_choice:
                    self.stage_chosen.emit(place)
                else:
                    target = ends.get(key, place + moves.get(key, 0))
                    target = min(max(target, 0), len(self._buttons) - 1)
                    self._buttons[target].setFocus(Qt.FocusReason.TabFocusReason)
                return True
        return False

    def _share_width(self) -> None:
        wanted = [button.sizeHint().width() for button in self._buttons]
        if len(wanted) == len(self._widest):
            wanted = [max(pair) for pair in zip(wanted, self._widest, strict=True)]
        if wanted != self._widest:
            self._widest = wanted
            for place, width in enumerate(wanted):
                self._row.setStretch(place, width)
            self.updateGeometry()

    def _set_tab_stop(self) -> None:
        """Make the present stage the one that Tab reaches."""
        places = [k for k, b in enumerate(self._buttons) if b.entry().state is StageState.CURRENT] or [0]
        for place, button in enumerate(self._buttons):
            is_stop = place == places[0]
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus if is_stop else Qt.FocusPolicy.NoFocus)

    @Slot()
    def _choose(self) -> None:
        button = self.sender()
        for place, candidate in enumerate(self._buttons):
            if candidate is button:
                self.stage_chosen.emit(place)

    @Slot()
    def _follow_theme(self) -> None:
        self._widest = []
        self._share_width()
        self.update()
