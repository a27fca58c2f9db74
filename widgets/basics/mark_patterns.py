"""Hatches, checkers and other small tiles that tell marks apart by their form."""

from functools import lru_cache
from math import ceil

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QImage, QPainter, QPen

from widgets.basics.theme import Theme
from widgets.grid.overlay import Mark

_TILE = 10
"""Side of a tile in logical pixels."""


def is_pattern(mark: Mark) -> bool:
    """Return whether a mark is drawn as a pattern over the area of its pixels, and not as a glyph in each."""
    return mark in _LINES or mark in (Mark.COVERED, Mark.NAN)


_LINES = {
    Mark.EDGE_0: [QLineF(-1, 5, 11, 5)],
    Mark.EDGE_1: [QLineF(5, -1, 5, 11)],
    Mark.EDGE_2: [QLineF(-2, 12, 12, -2), QLineF(-7, 7, 7, -7), QLineF(3, 17, 17, 3)],
    Mark.REJECTED: [QLineF(-2, -2, 12, 12), QLineF(-7, 3, 3, 13), QLineF(7, -3, 17, 7)],
}
"""The strokes of each hatch in one tile, continued on the next."""


@lru_cache(maxsize=64)
def pattern_brush(mark: Mark, theme: Theme, ratio: float) -> QBrush:
    """Return the brush of a pattern mark; ``ratio`` is device pixels per logical pixel."""
    if mark is Mark.COVERED:
        color = QColor(theme.covered)
        color.setAlphaF(0.5)
        return QBrush(color)
    tile = transparent_image(_TILE, _TILE, ratio)
    painter = QPainter(tile)
    if mark is Mark.NAN:
        half = _TILE / 2
        painter.fillRect(QRectF(0, 0, _TILE, _TILE), QColor(theme.nan_light))
        painter.fillRect(QRectF(0, 0, half, half), QColor(theme.nan_dark))
        painter.fillRect(QRectF(half, half, half, half), QColor(theme.nan_dark))
    else:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        halo = QColor(theme.halo())
        halo.setAlphaF(0.45)
        painter.setPen(QPen(halo, 3.0))
        painter.drawLines(_LINES[mark])
        painter.setPen(QPen(QColor(mark_color(mark, theme)), 1.5))
        painter.drawLines(_LINES[mark])
    painter.end()
    return QBrush(tile)


def mark_color(mark: Mark, theme: Theme) -> str:
    """Return the colour of a mark."""
    colors = {
        Mark.COVERED: theme.covered,
        Mark.EDGE_0: theme.vertex[0],
        Mark.EDGE_1: theme.vertex[1],
        Mark.EDGE_2: theme.vertex[2],
        Mark.TIE: theme.tie,
        Mark.REJECTED: theme.rejected,
        Mark.DEPTH_PASSED: theme.covered,
        Mark.DEPTH_FAILED: theme.rejected,
        Mark.NAN: theme.nan_dark,
        Mark.DIFFERENCE: theme.rejected,
        Mark.RIGHT: "#3ccb9c",
        Mark.MISSING: theme.tie,
        Mark.EXTRA: theme.rejected,
        Mark.DOUBLE: theme.rejected,
    }
    return colors[mark]


@lru_cache(maxsize=16)
def cell_tile(side: float, line_strength: float, has_centre: bool, theme: Theme, ratio: float) -> QImage:
    """Return one cell's grid lines (left, bottom) and sample centre as a tile of ``side`` logical pixels.

    ``line_strength`` is the opacity of the lines, 0 to 1.
    """
    tile = transparent_image(side, side, ratio)
    painter = QPainter(tile)
    line = QColor(theme.grid_line)
    line.setAlphaF(line_strength)
    width = max(1.0, round(ratio)) / ratio
    painter.fillRect(QRectF(0, 0, width, side), line)
    painter.fillRect(QRectF(width, side - width, side - width, width), line)
    if has_centre:
        radius = 1.5 if side >= 24 else 1.0
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        middle = QPointF(side / 2, side / 2)
        for color, grown in (("#ffffff", 0.9), ("#000000", 0.0)):
            shade = QColor(color)
            shade.setAlphaF(0.75)
            painter.setBrush(shade)
            painter.drawEllipse(middle, radius + grown, radius + grown)
    painter.end()
    return tile


def transparent_image(width: float, height: float, ratio: float) -> QImage:
    """Return a transparent image of a size in logical pixels."""
    image = QImage(
        max(ceil(width * ratio - 1e-6), 1),
        max(ceil(height * ratio - 1e-6), 1),
        QImage.Format.Format_ARGB32_Premultiplied,
    )
    image.setDevicePixelRatio(ratio)
    image.fill(0)
    return image
