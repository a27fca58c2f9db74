"""The right column of the Step page: the pane of a lesson while one is open, and the inspector below it."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication, QEvent, QObject, Qt, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from app.pages.step.inspector_column import InspectorColumn
from widgets.basics.controls import column_layout
from widgets.basics.theme import current_theme

if TYPE_CHECKING:
    from widgets.lessons.lesson_scroll import LessonScroll  # Made with the first lesson.

INSPECTOR_LINES = 9
"""Height that the inspector keeps under a lesson, in lines of text, where sentence and formula need no less."""
LESSON_PART = 2 / 3
"""Part of the height that the lesson has at least, if it needs it: in large type the inspector scrolls."""


class SideColumn(QWidget):
    """Both panes, one below the other; hidden where there is nothing to show."""

    def __init__(self, inspector: InspectorColumn, parent: QWidget) -> None:
        super().__init__(parent)
        self._inspector = inspector
        self._lesson: LessonScroll | None = None
        self._gives_way = self._is_idle = self._is_presenting = self._is_owed = self._is_put_off = False
        self._layout = column_layout(self, 4)
        self._below = QWidget(self)
        column_layout(self._below).addWidget(inspector)
        self._layout.addWidget(self._below, 1)
        inspector.installEventFilter(self)
        inspector.step_grown.connect(self._divide)

    def show_lesson(self, lesson: "LessonScroll | None") -> None:
        """Show the pane of a lesson above the inspector, or no longer."""
        if lesson is self._lesson:
            return
        if self._lesson is not None:
            self._layout.removeWidget(self._lesson)
            self._lesson.height_changed.disconnect(self._divide)
            self._lesson.hide()
        self._lesson = lesson
        if lesson is not None:
            self._layout.insertWidget(0, lesson, 0, Qt.AlignmentFlag.AlignTop)
            lesson.height_changed.connect(self._divide)
            lesson.show()
        self._follow()

    def let_inspector_give_way(self, gives_way: bool) -> None:
        """Leave the inspector out where the lesson needs the room: nothing has been stepped that it could show."""
        if gives_way != self._gives_way:
            self._gives_way = gives_way
            # When all is known that the lesson shows, and before it is painted.
            self._is_owed = True
            QCoreApplication.postEvent(self, QEvent(QEvent.Type.LayoutRequest))

    def put_off(self, is_put_off: bool) -> None:
        """Divide the height no more until all is known that is shown, then once."""
        self._is_put_off = is_put_off
        self._layout.setEnabled(not is_put_off)
        if self._lesson is not None:
            self._lesson.put_off(is_put_off)
        if not is_put_off:
            self._divide()
            self._layout.invalidate()
            self._layout.activate()
        self._inspector.put_off(is_put_off)

    def set_idle(self, is_idle: bool) -> None:
        """Leave the inspector out of a lesson: no step has been done that it could show."""
        if is_idle != self._is_idle:
            self._is_idle = is_idle
            self._divide()

    def set_presenting(self, is_presenting: bool) -> None:
        """Leave the inspector out wherever the lesson needs the room: a class does not scroll."""
        self._is_presenting = is_presenting
        self._divide()

    def panes(self) -> list[QWidget]:
        """Return the pane of a lesson, while it is there."""
        return [] if self._lesson is None else [self._lesson]

    def _follow(self) -> None:
        """Be there while one of both is."""
        self.setVisible(not self._inspector.isHidden() or self._lesson is not None)
        self._divide()

    def event(self, event: QEvent) -> bool:
        """Divide the height where that was put off."""
        if event.type() == QEvent.Type.LayoutRequest and self._is_owed:
            self._divide()
        return super().event(event)

    @Slot()
    def _divide(self) -> None:
        """Give the lesson the height that it wants, unless the inspector would have too little."""
        if self._is_put_off:
            return
        self._is_owed = False
        if self._lesson is None:
            self._below.show()
            self._inspector.show_part_alone(False)
            return
        whole, part = self._inspector.step_heights(self.width())
        least = min(whole, round(INSPECTOR_LINES * 1.5 * current_theme().text_px))
        wanted = self._lesson.height_for(self.width())
        room = self.height() - wanted - self._layout.spacing()
        is_alone, has_room = False, room >= least
        if self._is_presenting:
            is_alone, has_room = room < whole, room >= part
        gives_way = self._gives_way or self._is_presenting
        is_wanted = not (self._inspector.isHidden() or self._is_idle)
        is_inspected = is_wanted and (has_room or not gives_way)
        self._inspector.show_part_alone(is_alone and has_room)
        most = self.height()
        if is_inspected and not has_room:
            most = max(most - least, round(LESSON_PART * most))
        self._lesson.take_room(self.width(), wanted, most)
        if is_inspected and self._below.isHidden():
            # At once in its place.
            top = min(wanted, most) + self._layout.spacing()
            self._below.setGeometry(0, top, self.width(), self.height() - top)
        self._below.setVisible(is_inspected)

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
