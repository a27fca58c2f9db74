"""The whole run as chapters in one row: a chapter per stage, what goes in and out of it, and how far the run is."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QPoint, QSize, Qt, Signal, Slot
from PySide6.QtGui import QKeyEvent, QMouseEvent, QResizeEvent
from PySide6.QtWidgets import QApplication, QSizePolicy, QWidget

from widgets.basics.controls import row_layout
from widgets.basics.theme import theme_notifier
from widgets.timeline.chapter_button import Chapter, ChapterButton, ChapterState, Spelling


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
            elif self._buttons[place].chapter() != chapter:
                self._buttons[place].show_chapter(chapter)
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
