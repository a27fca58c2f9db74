"""Painting the cells of a map: a fill and a character for each outcome."""

from functools import lru_cache

from PySide6.QtCore import QRect, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from widgets.atlas.records import CellKind
from widgets.basics.theme import Theme, text_font

_MARK_PART = 0.62
"""Height of the character in parts of the cell."""


@lru_cache(maxsize=256)
def cell_pixmap(kind: CellKind | None, side: int, theme: Theme, ratio: float) -> QPixmap:
    """Return one cell of ``side`` logical pixels; ``None``: a cell that has not been run."""
    pixmap = QPixmap(round(side * ratio), round(side * ratio))
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(QColor(0, 0, 0, 0))
    with QPainter(pixmap) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_cell(painter, QRectF(0, 0, side, side), kind, theme)
    return pixmap


def paint_cell(painter: QPainter, area: QRectF, kind: CellKind | None, theme: Theme) -> None:
    """Paint one cell with a pixel between it and the next one."""
    inner = area.adjusted(0.5, 0.5, -0.5, -0.5)
    if kind is None:
        painter.setPen(QPen(QColor(theme.hidden), 1.0, Qt.PenStyle.DotLine))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(inner.adjusted(0.5, 0.5, -0.5, -0.5))
        return
    painter.fillRect(inner, QColor(kind.fills[theme.is_dark]))
    painter.setFont(text_font(theme, max(round(area.height() * _MARK_PART), 7)))
    painter.setPen(QColor(kind.inks[theme.is_dark]))
    painter.drawText(area, int(Qt.AlignmentFlag.AlignCenter), kind.mark)


def paint_ring(painter: QPainter, area: QRect, theme: Theme, is_strong: bool) -> None:
    """Mark a cell: chosen (strong) or pointed at, readable on every fill."""
    outer = QRectF(area).adjusted(-1, -1, 1, 1) if is_strong else QRectF(area)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.halo()), 4.0 if is_strong else 3.0))
    painter.drawRect(outer)
    painter.setPen(QPen(QColor(theme.focus), 2.0 if is_strong else 1.0))
    painter.drawRect(outer)
