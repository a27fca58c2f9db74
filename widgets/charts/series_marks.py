"""Colour and shape of a series: the shape alone tells twelve apart, the colour helps.

The shapes are those of pyqtgraph. The colours keep away from what has a meaning in the program: the blue, orange and
green of vertices, the accent of the present step.
"""

from pyqtgraph.graphicsItems.ScatterPlotItem import Symbols
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPen, QPixmap

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


def series_growth(number: int) -> float:
    """Return how much larger than others a shape is drawn: thin ones would look small."""
    return 1.35 if series_shape(number) in THIN_SHAPES else 1.0


def series_icon(number: int, side: int, ratio: float = 1.0) -> QIcon:
    """Return the mark of a series as an icon."""
    pixmap = QPixmap(round(side * ratio), round(side * ratio))
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(Qt.GlobalColor.transparent)
    with QPainter(pixmap) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate(QPointF(side / 2, side / 2))
        size = 0.72 * side * series_growth(number)
        painter.scale(size, size)
        painter.setPen(QPen(Qt.PenStyle.NoPen))
        painter.setBrush(QColor(series_color(number)))
        painter.drawPath(Symbols[series_shape(number)])
    return QIcon(pixmap)
