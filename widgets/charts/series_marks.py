"""Colour and shape of a series: the shape alone tells twelve apart, the colour helps.

The shapes are those of pyqtgraph. The colours keep away from what has a meaning in the program: the blue, orange and
green of vertices, the accent of the present step.
"""

from pyqtgraph.graphicsItems.ScatterPlotItem import Symbols
from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QColor, QIcon, QIconEngine, QPainter

from widgets.basics.theme import Theme, current_theme

SHAPES = ("o", "s", "t1", "d", "star", "t", "h", "+", "x", "p", "t2", "t3")
THIN_SHAPES = ("star", "+", "x")
LIGHT_COLORS = ("#4b4fa8", "#0b7a75", "#8a5a00", "#8c2f39", "#3f6b1e", "#5d6670", "#7b3f98", "#1f6f9f")
DARK_COLORS = ("#a9adff", "#55d6cf", "#e0b45a", "#ff9aa5", "#a5d97f", "#c3ccd5", "#d9a3f0", "#7cc7f2")


def series_color(number: int, theme: Theme | None = None) -> str:
    """Return the colour ``#rrggbb`` of a series."""
    colors = DARK_COLORS if (theme or current_theme()).is_dark else LIGHT_COLORS
    return colors[number % len(colors)]


def series_shape(number: int) -> str:
    """Return pyqtgraph's name of the shape of a series."""
    return SHAPES[number % len(SHAPES)]


def paint_mark(painter: QPainter, at: QPointF, number: int, size: float) -> None:
    """Draw the mark of a series; shapes that are thin are drawn larger than others, or they would look small."""
    shape = series_shape(number)
    size *= 1.35 if shape in THIN_SHAPES else 1.0
    painter.save()
    painter.translate(at)
    painter.scale(size, size)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(series_color(number)))
    painter.drawPath(Symbols[shape])
    painter.restore()


class SeriesIcon(QIconEngine):
    """The mark of a series as an icon, sharp in every size and in files."""

    def __init__(self, number: int) -> None:
        super().__init__()
        self._number = number

    def paint(self, painter: QPainter, rect: QRect, mode: QIcon.Mode, state: QIcon.State) -> None:
        """Draw the mark in the middle of a rectangle."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_mark(painter, QRectF(rect).center(), self._number, 0.72 * rect.height())

    def clone(self) -> QIconEngine:
        """Return the same."""
        return SeriesIcon(self._number)
