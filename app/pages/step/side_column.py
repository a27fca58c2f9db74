"""The right column of the Step page: the pane of a lesson while one is open, and the inspector below it."""

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QScrollArea, QWidget

from app.pages.step.inspector_column import InspectorColumn
from widgets.basics.controls import column_layout
from widgets.basics.theme import current_theme

INSPECTOR_LINES = 9
"""Least height of the inspector under a lesson, in lines of text: sentence and formula."""


class SideColumn(QWidget):
    """Both panes, one below the other; hidden where there is nothing to show."""

    def __init__(self, inspector: InspectorColumn, parent: QWidget) -> None:
        super().__init__(parent)
        self._inspector = inspector
        self._lesson: QScrollArea | None = None
        self._layout = column_layout(self, 4)
        self._layout.addWidget(inspector, 1)
        inspector.installEventFilter(self)

    def show_lesson(self, lesson: QScrollArea | None) -> None:
        """Show the pane of a lesson above the inspector, or no longer."""
        if self._lesson is not None and self._lesson is not lesson:
            self._layout.removeWidget(self._lesson)
            self._lesson.hide()
        self._lesson = lesson
        if lesson is not None:
            self._layout.insertWidget(0, lesson)
            lesson.show()
        self._follow()

    def _follow(self) -> None:
        """Be there while one of both is; give the lesson what the inspector leaves."""
        is_inspected = not self._inspector.isHidden()
        self.setVisible(is_inspected or self._lesson is not None)
        if self._lesson is not None:
            least = round(INSPECTOR_LINES * 1.5 * current_theme().text_px) if is_inspected else 0
            self._lesson.setMaximumHeight(max(self.height() - least, self.height() // 3))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Divide another height."""
        super().resizeEvent(event)
        self._follow()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the inspector when it is folded away or shown."""
        if watched is self._inspector and event.type() in (
            QEvent.Type.ShowToParent,
            QEvent.Type.HideToParent,
        ):
            self._follow()
        return False
