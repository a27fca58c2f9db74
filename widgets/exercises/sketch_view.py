"""A plane or space with whole numbers on its axes, and the points and outlines of a question in it."""

from collections.abc import Sequence
from math import ceil

from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF, Qt, Slot
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from core.records.sketch import Place, Sketch
from widgets.basics.drawn_text import LabelPlaces
from widgets.basics.theme import current_theme, faded, text_font, theme_notifier

CLOSEST = 22.0
"""Least pixels between two numbers of an axis, at a text size of 13."""
HEIGHT = 260
"""Pixels at a text size of 13."""
RADIUS = 4.0
STEPS = (1, 2, 5, 10, 20, 50)
AXES = {"x": QPointF(4, -6), "y": QPointF(6, 10), "z": QPointF(-14, 4)}
"""Names of the axes of space, and how far from its end each stands."""
DEPTH = 0.35
"""How far a unit of z runs to the left and down: the z axis at 45 degrees, at half its length."""


class SketchView(QWidget):
    """Shows a `Sketch`; squares are square, and space is drawn obliquely."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._sketch = Sketch()
        self._answer: Place | None = None
        self._name = ""
        self.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        theme_notifier().theme_changed.connect(self._follow_theme)

    def show_sketch(self, sketch: Sketch | None) -> None:
        """Show a sketch; ``None``: there is none."""
        self.setVisible(sketch is not None)
        self._sketch = sketch or Sketch()
        self.show_answer(None)

    def show_answer(self, place: Place | None, name: str = "") -> None:
        """Show the point that is an answer, with its name; ``None``: there is none."""
        self._answer, self._name = place, name
        self.setAccessibleName(f"Sketch: {self.shown.text}")
        self.updateGeometry()
        self.update()

    @property
    def shown(self) -> Sketch:
        """The sketch with the point of the answer."""
        return self._sketch if self._answer is None else self._sketch.with_point(self._name, self._answer)

    def sizeHint(self) -> QSize:
        """Return the size that the theme's text asks for."""
        height = HEIGHT * current_theme().text_px // 13
        return QSize(3 * height // 2, height)

    @Slot()
    def _follow_theme(self) -> None:
        self.updateGeometry()
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint lines at whole numbers, both axes with their numbers, outlines, and points with their names."""
        theme, sketch = current_theme(), self.shown
        pixels = min(self.width(), self.height()) / 2 / (sketch.reach + 1)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), QColor(theme.panel))
        (self._paint_space if sketch.is_space else self._paint_axes)(painter, pixels)
        painter.setPen(QPen(QColor(theme.text), 2.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for outline in sketch.outlines:
            painter.drawPolygon(QPolygonF([self._at(place, pixels) for place in outline]))
        painter.setFont(text_font(theme))
        names, metrics = LabelPlaces(QRectF(self.rect())), QFontMetricsF(painter.font())
        centers = [self._at(place, pixels) for _, place in sketch.points]
        painter.setBrush(QColor(theme.text))
        for center in centers:
            painter.drawEllipse(center, RADIUS, RADIUS)
            names.take(QRectF(center.x() - RADIUS, center.y() - RADIUS, 2 * RADIUS, 2 * RADIUS))
        for (name, _), center in zip(sketch.points, centers, strict=True):
            size = QSizeF(metrics.horizontalAdvance(name) + 4, metrics.height())
            box = names.find(center, size, RADIUS + 2)
            if box is not None:
                painter.fillRect(box, faded(theme.panel, 0.8))
                painter.drawText(box, Qt.AlignmentFlag.AlignCenter, name)
        painter.end()

    def _at(self, place: Sequence[float], pixels: float) -> QPointF:
        """Return where a place is on the widget: the origin in its middle, ``pixels`` to a unit."""
        x, y, z = (*place, 0.0)[:3]
        x, y = x - DEPTH * z, y - DEPTH * z
        return QPointF(self.width() / 2 + x * pixels, self.height() / 2 - y * pixels)

    def _paint_space(self, painter: QPainter, pixels: float) -> None:
        """Paint three axes with dots at whole numbers, and the way to each point: along x, then z, then y."""
        theme, last = current_theme(), ceil(self.shown.reach)
        painter.setFont(text_font(theme))
        for axis, (name, beside) in enumerate(AXES.items()):
            places = [
                self._at([number * (axis == k) for k in range(3)], pixels)
                for number in range(-last, last + 1)
            ]
            painter.setPen(QPen(QColor(theme.muted_text), 1.0))
            painter.drawLine(places[0], places[-1])
            painter.drawText(places[-1] + beside, name)
            painter.setPen(QPen(QColor(theme.muted_text), 3.0))
            painter.drawPoints(places)
        painter.setPen(QPen(QColor(theme.muted_text), 1.0, Qt.PenStyle.DashLine))
        for _, (x, y, z) in self.shown.points:
            way = (x, 0, 0), (x, 0, z), (x, y, z)
            painter.drawPolyline(QPolygonF([self._at(place, pixels) for place in way]))

    def _paint_axes(self, painter: QPainter, pixels: float) -> None:
        """Paint a line at every whole number, or at every fifth, tenth ..., and the number beside the axis."""
        theme = current_theme()
        painter.setFont(text_font(theme, theme.small_px))
        metrics = QFontMetricsF(painter.font())
        step = next((step for step in STEPS if step * pixels >= CLOSEST * theme.text_px / 13), STEPS[-1])
        for axis, length in enumerate((self.width(), self.height())):
            last = int(length / 2 / pixels) // step * step
            for number in range(-last, last + 1, step):
                place = self._at((number, 0) if axis == 0 else (0, number), pixels)
                color, width = (
                    (QColor(theme.muted_text), 1.5) if number == 0 else (faded(theme.grid_line, 0.4), 1.0)
                )
                painter.setPen(QPen(color, width))
                if axis == 0:
                    painter.drawLine(QPointF(place.x(), 0), QPointF(place.x(), self.height()))
                else:
                    painter.drawLine(QPointF(0, place.y()), QPointF(self.width(), place.y()))
                size = QSizeF(metrics.horizontalAdvance(str(number)), metrics.height())
                across = -size.width() / 2 if axis == 0 else -size.width() - 4
                box = QRectF(place + QPointF(across, 2 if axis == 0 else -size.height() / 2), size)
                if number and QRectF(self.rect()).contains(box):
                    painter.setPen(QColor(theme.muted_text))
                    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, str(number))
