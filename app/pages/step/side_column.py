"""The right column of the Step page: the pane of a lesson while one is open, and the inspector below it."""

from PySide6.QtCore import QEvent, QObject, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from app.pages.step.inspector_column import InspectorColumn
from widgets.basics.controls import column_layout
from widgets.basics.theme import current_theme
from widgets.lessons.lesson_scroll import LessonScroll

INSPECTOR_LINES = 9
"""Least height of the inspector under a lesson, in lines of text: sentence and formula."""


class SideColumn(QWidget):
    """Both panes, one below the other; hidden where there is nothing to show."""

    def __init__(self, inspector: InspectorColumn, parent: QWidget) -> None:
        super().__init__(parent)
        self._inspector = inspector
        self._lesson: LessonScroll | None = None
        self._layout = column_layout(self, 4)
        self._layout.addWidget(inspector, 1)
        inspector.installEventFilter(self)

    def show_lesson(self, lesson: LessonScroll | None) -> None:
        """Show the pane of a lesson above the inspector, or no longer."""
        if self._lesson is not None and self._lesson is not lesson:
            self._layout.removeWidget(self._lesson)
            self._lesson.height_changed.disconnect(self._divide)
            self._lesson.hide()
        is_new, self._lesson = lesson is not self._lesson, lesson
        if lesson is not None and is_new:
            self._layout.insertWidget(0, lesson)
            lesson.height_changed.connect(self._divide)
            lesson.show()
        self._follow()

    def panes(self) -> list[QWidget]:
        """Return both, as far as they are there."""
        return [self._inspector] if self._lesson is None else [self._lesson, self._inspector]

    def _follow(self) -> None:
        """Be there while one of both is."""
        self.setVisible(not self._inspector.isHidden() or self._lesson is not None)
        self._divide()

    @Slot()
    def _divide(self) -> None:
        """Give the lesson the height that it wants, unless the inspector would have too little."""
        if self._lesson is not None:
            line = 1.5 * current_theme().text_px
            least = 0 if self._inspector.isHidden() else round(INSPECTOR_LINES * line)
            most = max(self.height() - least, self.height() // 2)
            self._lesson.take_room(self.width(), most)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Divide another height."""
        super().resizeEvent(event)
        self._divide()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the inspector when it is folded away or shown."""
        if watched is self._inspector and event.type() in (
            QEvent.Type.ShowToParent,
            QEvent.Type.HideToParent,
        ):
            self._follow()
        return False
