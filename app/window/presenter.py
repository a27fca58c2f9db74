"""Presenting: the whole screen for the picture and the step, large type, and the keys of a clicker."""

from dataclasses import dataclass

from PySide6.QtCore import QEvent, QObject, QPoint, Qt, Signal, Slot
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QApplication,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QTextEdit,
    QWidget,
)

from app.pages.page_bar import Page
from app.window.appearance import the_application
from app.window.parts import WindowParts
from core import STAGES
from widgets.basics.accessibility import give_focus
from widgets.basics.theme import current_theme

CLICKER = {
    Qt.Key.Key_PageDown: "step_forward",
    Qt.Key.Key_PageUp: "step_back",
    Qt.Key.Key_F5: "start",  # At the start, on the Start page and in a lesson: open something else.
    Qt.Key.Key_B: "black",
    Qt.Key.Key_Period: "black",
}
"""What the keys that clickers send do while presenting."""
IN_LESSONS = {"step_forward": "advance", "step_back": "retreat"}
"""What the same keys do while a lesson is open, by the names of `LessonPresenter`."""
PAGES_TO_STEP = ("start", "step")
"""Pages on which F5 is the clicker's: on the others it measures, runs, analyses or checks."""
TYPED = (Qt.Key.Key_B, Qt.Key.Key_Period)
"""Keys of a clicker that fields take."""
ANSWERING = tuple("-0123456789")
"""What begins an answer that is typed or chosen by its number."""
ARROWS = (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Down)
HINT = "Page Down: next. Page Up: back. F5: lessons and scenes. Period: black screen. Esc: leave."
"""What is said when one begins to present."""
HINT_ROOM = 32
"""Width of a hint around its text, in logical pixels."""
PRESENTED_PANES = ("inspector",)
"""Panes that are shown at first, but beside a view of the whole width."""
WHOLE_WIDTH = ("compare", "flow")
"""Views without a pane beside them: each picture of A | B has a sentence of its own, Flow is of the whole run."""


@dataclass(frozen=True)
class _Desk:
    """What leaving brings back."""

    theme: str
    window_state: Qt.WindowState
    layout: dict[str, str]


class Presenter(QObject):
    """Arranges a window for presenting, and back again as it was."""

    presenting_changed = Signal(bool)

    def __init__(self, window: WindowParts) -> None:
        super().__init__(window)
        self._desk: _Desk | None = None
        self._is_whole_width = False
        self._blank = QWidget(window, accessibleName="Black screen")
        self._blank.setStyleSheet("background: #000000")
        self._blank.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._blank.hide()
        self.hint = QLabel(window, wordWrap=True)
        self.hint.setProperty("role", "floating")
        self.hint.hide()
        window.statusBar().messageChanged.connect(self._show_hint)
        window.page.main_area.view_changed.connect(self._follow_view)
        window.pages.page_made.connect(self._take_page)

    @property
    def _window(self) -> WindowParts:
        # Not an attribute: a window in a cycle would not be deleted when it is released.
        window: WindowParts = self.parent()  # type: ignore[assignment]
        return window

    @property
    def is_presenting(self) -> bool:
        """Whether the window is arranged for presenting."""
        return self._desk is not None

    def toggle(self) -> None:
        """Fill the screen and arrange the window for presenting, or go back to the desk."""
        if self.is_presenting:
            self.leave()
        else:
            self.arrange()
            self._window.showFullScreen()
            self._window.notices.tell(HINT)

    def arrange(self) -> None:
        """Show only what the step needs, in large type: without filling the screen."""
        window, page = self._window, self._window.page
        self._desk = _Desk(window.appearance.name, window.windowState(), page.layout_state())
        window.menuBar().hide()
        window.pages.show_bar(False)
        for each in window.pages.made:
            each.set_presenting(True)
        self._is_whole_width = self._takes_all(page.current_view())
        page.show_panes(() if self._is_whole_width else PRESENTED_PANES)
        window.appearance.set_theme("presenter-dark" if current_theme().is_dark else "presenter")
        page.lessons.read()
        the_application().installEventFilter(self)
        self.presenting_changed.emit(True)

    @Slot(str)
    def _follow_view(self, name: str) -> None:
        """Give some views the whole width, and the step its words again beside another view."""
        is_whole_width = self._takes_all(name)
        if self.is_presenting and is_whole_width != self._is_whole_width:
            self._is_whole_width = is_whole_width
            self._window.page.show_panes(() if is_whole_width else PRESENTED_PANES)

    def _takes_all(self, view: str) -> bool:
        """Return whether a view has the whole width, but for a lesson and the listing that is changed in it."""
        page = self._window.page
        return view in WHOLE_WIDTH and not (page.lessons.is_before_a_class and page.column.wants_listing())

    @Slot(object)
    def _take_page(self, page: Page) -> None:
        """Arrange a page that is shown for the first time."""
        page.set_presenting(self.is_presenting)

    def leave(self) -> None:
        """Go back to the desk: the window as it was."""
        if self._desk is None:
            return
        window, page, desk = self._window, self._window.page, self._desk
        self._desk = None
        the_application().removeEventFilter(self)
        self._blank.hide()
        self.hint.hide()
        window.menuBar().show()
        window.pages.show_bar(True)
        for each in window.pages.made:
            each.set_presenting(False)
        window.setWindowState(desk.window_state)
        window.appearance.set_theme(desk.theme)
        page.restore_layout(desk.layout)
        self.presenting_changed.emit(False)

    def end_black(self) -> bool:
        """Show the picture again; return whether the screen was black."""
        was_black = self._blank.isVisible()
        self._blank.hide()
        return was_black

    def place(self) -> None:
        """Follow the size of the window."""
        if self._desk is not None:
            self._window.appearance.follow_height()
            self._blank.setGeometry(self._window.rect())
            self._place_hint()

    # The clicker.

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take the keys of a clicker, wherever the focus is, but for what is being typed; let arrows step."""
        if isinstance(event, QKeyEvent) and self._steps(event):
            event.ignore()  # No view and no table keeps it from the window's keys.
            return True
        if isinstance(event, QKeyEvent) and self._answers(event):
            event.accept()
            return True
        if isinstance(event, QKeyEvent) and self._takes(event):
            if event.type() == QEvent.Type.ShortcutOverride:
                event.accept()
                return True
            if event.type() == QEvent.Type.KeyPress:
                self._click(CLICKER[Qt.Key(event.key())])
                return True
        return False

    def _takes(self, event: QKeyEvent) -> bool:
        """Return whether a key is a clicker's."""
        is_of_page = event.key() == Qt.Key.Key_F5 and self._window.pages.current_name not in PAGES_TO_STEP
        # In a lesson letters are typed where an answer or a line is, and Page Down is still the clicker's.
        heeds_fields = event.key() in TYPED or not self._window.page.lessons.is_open
        is_elsewhere = is_of_page or self._window.overlays.scenes.isVisible()
        return event.key() in CLICKER and not is_elsewhere and _is_for_all(event, heeds_fields)

    def _steps(self, event: QKeyEvent) -> bool:
        """Return whether it is asked who wants an arrow that is pressed on the Step page: the window does."""
        if event.type() != QEvent.Type.ShortcutOverride or event.key() not in ARROWS:
            return False
        focus = QApplication.focusWidget()
        return focus is not None and self._window.page.isAncestorOf(focus) and _is_for_all(event, True)

    def _answers(self, event: QKeyEvent) -> bool:
        """Give the open question the keyboard for a digit or a sign: a digit would go to a stage else."""
        if event.type() != QEvent.Type.ShortcutOverride or event.text() not in ANSWERING:
            return False
        page = self._window.page
        stop = page.lessons.unfocused_answer()
        if stop is None or not page.isVisible() or not _is_for_all(event, True):
            return False
        give_focus(stop)
        return True

    def _click(self, action: str) -> None:
        """Do what a clicker means; what is black is shown first."""
        is_black = self._blank.isVisible()
        self._blank.setVisible(action == "black" and not is_black)
        if action == "black":
            self._blank.setGeometry(self._window.rect())
            self._blank.raise_()
        elif not is_black:
            is_on_start = self._window.pages.current_name == "start"
            self._window.pages.show_page("step")
            lessons = self._window.page.lessons
            if action == "start" and (is_on_start or lessons.is_open or self._is_at_start()):
                self._window.run_action("choose_scene")
            elif lessons.is_open:
                getattr(lessons, IN_LESSONS[action])()
            elif action != "start":
                self._window.run_action(action)
            else:
                self._window.page.stepping.choose_stage(0)

    def _is_at_start(self) -> bool:
        """Return whether nothing of the run is done: going to its start would change nothing."""
        cursor = self._window.session.cursor
        return cursor.stage == STAGES[0] and cursor.position == 0

    # Hints, whose bar is out of sight.

    @Slot(str)
    def _show_hint(self, text: str) -> None:
        self.hint.setVisible(bool(text) and self.is_presenting)
        self.hint.setText(text)
        self._place_hint()

    def _place_hint(self) -> None:
        """Lie at the bottom, beside the picture where there is something beside it: nothing moves for it."""
        if self.hint.isVisible():
            room, side = self._window.rect().adjusted(16, 16, -16, -16), self._window.page.side
            if side.isVisible():
                room.setLeft(side.mapTo(self._window, QPoint(0, 0)).x())
            line = self.hint.fontMetrics().horizontalAdvance(self.hint.text()) + HINT_ROOM
            self.hint.setFixedWidth(min(line, room.width()))
            self.hint.setFixedHeight(self.hint.heightForWidth(self.hint.width()))
            self.hint.move(room.left(), room.bottom() - self.hint.height())
            self.hint.raise_()


def _is_for_all(event: QKeyEvent, heeds_fields: bool) -> bool:
    """Return whether a key is pressed alone, and not for a menu, a dialog or, with ``heeds_fields``, a field."""
    is_typing = heeds_fields and _takes_text(QApplication.focusWidget())
    is_elsewhere = QApplication.activeModalWidget() or QApplication.activePopupWidget()
    return not (event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier or is_typing or is_elsewhere)


def _takes_text(widget: QWidget | None) -> bool:
    """Return whether keys are typed into a widget: a field, or an editor of several lines."""
    if isinstance(widget, QPlainTextEdit | QTextEdit):
        return not widget.isReadOnly()
    return isinstance(widget, QLineEdit | QAbstractSpinBox) and not widget.isReadOnly()
