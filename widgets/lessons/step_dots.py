"""A dot for each step of a lesson: which are done or seen, which one is shown; a click opens any of them."""

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QSize, Qt, Signal, Slot
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QWidget

from widgets.basics.controls import LEAST_TARGET, row_layout
from widgets.basics.focus_order import ArrowGroup
from widgets.basics.theme import current_theme
from widgets.lessons.records import Standing


class StepDot(QAbstractButton):
    """One dot: filled when its step is done, with a point in it when it was only seen, in a ring when it is shown."""

    def __init__(self, number: int, parent: QWidget) -> None:
        super().__init__(parent)
        self.number = number
        self._standing, self._is_current = Standing.OPEN, False
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)

    def show_standing(self, standing: Standing, is_current: bool) -> None:
        """Show how far the learner is with the step, and whether it is the one that is shown."""
        self._standing, self._is_current = standing, is_current
        shown = ", shown now" if is_current else ""
        name = f"Step {self.number + 1}: {standing.value}{shown}"
        self.setAccessibleName(name)
        self.setToolTip(f"{name}. Click to open it.")
        self.update()

    def sizeHint(self) -> QSize:
        """Return the size of what is clicked."""
        side = max(LEAST_TARGET, round(1.4 * current_theme().text_px))
        return QSize(side, side)

    def minimumSizeHint(self) -> QSize:
        """Return the same: a dot is not squeezed."""
        return self.sizeHint()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the dot, and the ring of the focus."""
        theme = current_theme()
        radius = 0.34 * theme.text_px
        middle = QPointF(self.width() / 2, self.height() / 2)
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            ink = QColor(theme.text)
            painter.setPen(QPen(ink, max(1.4, 0.1 * theme.text_px)))
            is_done = self._standing is Standing.DONE
            painter.setBrush(ink if is_done else Qt.BrushStyle.NoBrush)
            painter.drawEllipse(middle, radius, radius)
            if self._standing is Standing.SEEN:
                painter.setBrush(ink)
                painter.setPen(Qt.PenStyle.NoPen)
                painter.drawEllipse(middle, 0.45 * radius, 0.45 * radius)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            if self._is_current:
                painter.setPen(QPen(ink, max(1.4, 0.1 * theme.text_px)))
                painter.drawLine(
                    QPointF(middle.x() - 1.3 * radius, self.height() - 2.0),
                    QPointF(middle.x() + 1.3 * radius, self.height() - 2.0),
                )
            if self.hasFocus():
                painter.setPen(QPen(QColor(theme.focus), 2))
                painter.drawRoundedRect(self.rect().adjusted(1, 1, -1, -1), 3, 3)


class StepDots(QWidget):
    """The dots of a lesson, one stop of Tab."""

    step_chosen = Signal(int)
    """Number of a step, from 0."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.dots: list[StepDot] = []
        self._row = row_layout(self, 0)
        self._group = ArrowGroup((), self)
        self.setAccessibleName("Steps of the lesson")

    def show_standings(self, standings: Sequence[Standing], number: int) -> None:
        """Show how far the learner is with each step; the one with this number is shown."""
        while len(self.dots) > len(standings):
            dot = self.dots.pop()
            self._row.removeWidget(dot)
            dot.hide()
            dot.deleteLater()
        while len(self.dots) < len(standings):
            dot = StepDot(len(self.dots), self)
            dot.clicked.connect(self._choose)
            self.dots.append(dot)
            self._row.addWidget(dot)
            dot.show()
        for place, (dot, standing) in enumerate(zip(self.dots, standings, strict=True)):
            dot.show_standing(standing, place == number)
        self._group.show_buttons(self.dots)

    @Slot()
    def _choose(self) -> None:
        dot = self.sender()
        assert isinstance(dot, StepDot)
        self.step_chosen.emit(dot.number)
