"""Marks on single pixels: the one under the pointer, the pinned one, and those of the step just done."""

import itertools
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QRegion

from core.records.cached import cached_property
from widgets.basics.theme import Theme, faded
from widgets.grid.line_clip import widget_lines
from widgets.grid.view import GridPlacement

_LEAST_SIDE = 7.0
"""Marks of smaller cells are drawn around the cell at this size, so that they are found."""
_RING = 9.0
"""Radius of the ring around a point, in widget pixels."""


@dataclass(frozen=True, eq=False)
class StepMark:
    """What the step just done was about, in the columns and rows of a grid."""

    pixels: NDArray[np.integer] = field(default_factory=lambda: np.empty((0, 2), np.int64), repr=False)
    """(N, 2) columns and rows."""
    lines: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 2, 2)), repr=False)
    """(L, 2, 2) ends of lines in the window, y up; NaN: none."""
    points: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 2)), repr=False)
    """(P, 2) places in the window."""
    trail: NDArray[np.integer] = field(default_factory=lambda: np.empty((0, 2), np.int64), repr=False)
    """(K, 2) pixels that were looked at one after the other, those of the step last."""

    def __post_init__(self) -> None:
        if self.pixels.ndim != 2 or self.pixels.shape[1] != 2:
            raise ValueError(f"pixels must be (N, 2), got {self.pixels.shape}")

    def reach(self, placement: GridPlacement) -> QRectF:
        """Return where in the widget something is marked; of nothing, nothing."""
        if len(self.lines) or len(self.points):
            is_drawn = np.isfinite(self.lines).all(axis=(1, 2))
            places = np.concatenate([self.lines[is_drawn].reshape(-1, 2), self.points])
            places = places[np.isfinite(places).all(axis=1)]
            if not len(places):
                return QRectF()
            (left, low), (right, high) = places.min(axis=0).tolist(), places.max(axis=0).tolist()
            ring = _RING + 3.0  # with its pen
            around = QRectF(placement.to_widget(left, high), placement.to_widget(right, low))
            return around.adjusted(-ring, -ring, ring, ring).intersected(QRectF(placement.viewport))
        pixels = np.concatenate([self.pixels, self.trail])
        if not len(pixels):
            return QRectF()
        (column0, row0), (column1, row1) = pixels.min(axis=0).tolist(), pixels.max(axis=0).tolist()
        return placement.cells_rect(column0, row0, column1 - column0 + 1, row1 - row0 + 1)

    @cached_property
    def crossed(self) -> set[tuple[int, int]]:
        """Columns and rows of the pixels that the trail runs through: asked for at every painting."""
        found: set[tuple[int, int]] = set()
        for start, end in itertools.pairwise(self.trail):
            count = 2 * int(np.abs(end - start).max()) + 1
            places = np.floor(np.linspace(start + 0.5, end + 0.5, count)).astype(int)
            found.update(map(tuple, places.tolist()))
        return found


def paint_step_mark(
    painter: QPainter, placement: GridPlacement, mark: StepMark, theme: Theme, written: QRegion
) -> None:
    """Paint the trail below, then the pixels, lines and points of the step in the accent.

    No line runs through what is ``written`` on the grid: it would strike it out.
    """
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    if not written.isEmpty():
        painter.setClipRegion(QRegion(placement.viewport) - written, Qt.ClipOperation.IntersectClip)
    _paint_trail(painter, placement, mark.trail, theme)
    lines = widget_lines(mark.lines, placement)[0] if len(mark.lines) else []
    for pen in (_pen(theme.halo(), 5.0), _pen(theme.accent, 3.0)):
        painter.setPen(pen)
        painter.drawLines(lines)
        for x, y in mark.points[np.isfinite(mark.points).all(axis=1)].tolist():
            painter.drawEllipse(placement.to_widget(x, y), _RING, _RING)
    painter.restore()
    paint_step(painter, placement, mark.pixels, theme)


def _paint_trail(
    painter: QPainter, placement: GridPlacement, trail: NDArray[np.integer], theme: Theme
) -> None:
    """Draw the order of the last pixels: a line that grows stronger, dashed where it jumps, with a head."""
    centers = [placement.cells_rect(column, row).center() for column, row in trail.tolist()]
    for k, (start, end) in enumerate(itertools.pairwise(centers)):
        is_jump = int(np.abs(trail[k + 1] - trail[k]).max()) > 1
        style = Qt.PenStyle.DotLine if is_jump else Qt.PenStyle.SolidLine
        strength = 0.25 + 0.75 * (k + 1) / len(centers)
        for color, width in ((theme.halo(), 3.4), (theme.accent, 1.6)):
            painter.setPen(QPen(faded(color, strength), width, style))
            painter.drawLine(start, end)
    if len(centers) > 1:
        line = QLineF(centers[-2], centers[-1])
        side = min(max(0.3 * placement.cell, 4.0), 9.0)
        painter.setPen(QPen(QColor(theme.accent), 1.6))
        for turn in (150.0, 210.0):
            painter.drawLine(QLineF.fromPolar(side, line.angle() + turn).translated(centers[-1]))


def paint_step(
    painter: QPainter, placement: GridPlacement, pixels: NDArray[np.integer], theme: Theme
) -> None:
    """Outline the (N, 2) pixels (column, row) of the step just done in the accent, as one region."""
    lines = region_outline(pixels, placement)
    if not lines:
        return
    small = placement.cell < 12
    painter.save()
    # A wide quiet line of the contrary brightness keeps the accent visible on every colour of a map.
    painter.setPen(_pen(theme.halo(), 3.0 if small else 5.0))
    painter.drawLines(lines)
    painter.setPen(_pen(theme.accent, 1.6 if small else 3.0))
    painter.drawLines(lines)
    painter.restore()


def paint_hover(painter: QPainter, placement: GridPlacement, pixel: tuple[int, int]) -> None:
    """Outline the pixel under the pointer with a thin double line."""
    rect = marked_rect(placement, pixel)
    painter.save()
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(_pen("#000000", 1.0))
    painter.drawRect(rect.adjusted(-0.5, -0.5, 0.5, 0.5))
    painter.setPen(_pen("#ffffff", 1.0))
    painter.drawRect(rect.adjusted(0.5, 0.5, -0.5, -0.5))
    painter.restore()


def paint_pin(painter: QPainter, placement: GridPlacement, pixel: tuple[int, int]) -> None:
    """Mark the pinned pixel with four corner brackets around it."""
    rect, seen = marked_rect(placement, pixel).adjusted(-2, -2, 2, 2), QRectF(placement.viewport)
    if seen.adjusted(-4, -4, 4, 4).contains(rect):
        # Whole at the border of the picture, too.
        rect = rect.intersected(seen.adjusted(1, 1, -1, -1))
    reach = max(min(rect.width() * 0.3, 12.0), 3.0)
    lines = []
    for corner, right, down in (
        (rect.topLeft(), 1, 1),
        (rect.topRight(), -1, 1),
        (rect.bottomLeft(), 1, -1),
        (rect.bottomRight(), -1, -1),
    ):
        lines.append(QLineF(corner.x(), corner.y(), corner.x() + right * reach, corner.y()))
        lines.append(QLineF(corner.x(), corner.y(), corner.x(), corner.y() + down * reach))
    painter.save()
    small = placement.cell < 12
    painter.setPen(_pen("#ffffff", 2.6 if small else 4.5))
    painter.drawLines(lines)
    painter.setPen(_pen("#000000", 1.2 if small else 2.2))
    painter.drawLines(lines)
    painter.restore()


def marked_rect(placement: GridPlacement, pixel: tuple[int, int]) -> QRectF:
    """Return the rectangle that a mark of a pixel is drawn around: its cell, grown if that is very small."""
    rect = placement.cells_rect(*pixel)
    grow = max((_LEAST_SIDE - placement.cell) / 2, 0.0)
    return rect.adjusted(-grow, -grow, grow, grow)


def region_outline(pixels: NDArray[np.integer], placement: GridPlacement) -> list[QLineF]:
    """Return the border of a set of pixels as widget lines; straight runs are one line.

    Parameters
    ----------
    pixels : (N, 2) integer array
        Columns and rows; those outside the raster are left out.
    """
    columns, rows = pixels[:, 0], pixels[:, 1]
    inside = (columns >= 0) & (columns < placement.columns) & (rows >= 0) & (rows < placement.rows)
    if not inside.any():
        return []
    columns, rows = columns[inside], rows[inside]
    column0, row0 = int(columns.min()), int(rows.min())
    padded = np.zeros((int(rows.max()) - row0 + 3, int(columns.max()) - column0 + 3), np.int8)
    padded[rows - row0 + 1, columns - column0 + 1] = 1

    # A border runs where neighbours differ; runs of equal sign along it are joined.
    lines = []
    across = np.diff(padded, axis=0)[:, 1:-1]
    for line, start, end in _runs(across):
        left = placement.cells_rect(column0 + start, row0 + line, end - start, 0)
        lines.append(QLineF(left.topLeft(), left.topRight()))
    upward = np.diff(padded, axis=1)[1:-1].T
    for line, start, end in _runs(np.ascontiguousarray(upward)):
        side = placement.cells_rect(column0 + line, row0 + start, 0, end - start)
        lines.append(QLineF(side.bottomLeft(), side.topLeft()))
    return lines


def _runs(values: NDArray[np.int8]) -> list[tuple[int, int, int]]:
    """Return (row, start, end) of the runs of equal values other than 0 along the rows of (M, N) values."""
    edges = np.zeros((values.shape[0], values.shape[1] + 1), bool)
    edges[:, 0] = edges[:, -1] = True
    edges[:, 1:-1] = values[:, 1:] != values[:, :-1]
    rows, starts = np.nonzero(edges)
    same_row = rows[1:] == rows[:-1]
    rows, ends, starts = rows[:-1][same_row], starts[1:][same_row], starts[:-1][same_row]
    keep = values[rows, starts] != 0
    return list(zip(rows[keep].tolist(), starts[keep].tolist(), ends[keep].tolist(), strict=True))


def _pen(color: str, width: float) -> QPen:
    """Return a solid pen with square ends and sharp corners."""
    return QPen(
        QColor(color), width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.SquareCap, Qt.PenJoinStyle.MiterJoin
    )
