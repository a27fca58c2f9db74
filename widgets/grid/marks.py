"""Marks in single pixels: pointed at, pinned, of the step just done; hatches that tell marks apart; samples."""

import itertools
from dataclasses import dataclass, field
from functools import lru_cache
from math import ceil

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QImage, QPainter, QPen, QRegion

from core.records.arrays import cached_property
from core.records.words import numbered
from widgets.basics.image import id_table
from widgets.basics.theme import Theme, faded
from widgets.grid.layers import CellMark
from widgets.grid.view import GridPlacement, widget_lines

# Hatches, checkers and other small tiles that tell marks apart by their form.


_TILE = 10
"""Side of a tile in logical pixels."""


def is_pattern(mark: CellMark) -> bool:
    """Return whether a mark is drawn as a pattern over the area of its pixels, and not as a glyph in each."""
    return mark in _LINES or mark in (CellMark.COVERED, CellMark.NAN)


_LINES = {
    CellMark.EDGE_0: [QLineF(-1, 5, 11, 5)],
    CellMark.EDGE_1: [QLineF(5, -1, 5, 11)],
    CellMark.EDGE_2: [QLineF(-2, 12, 12, -2), QLineF(-7, 7, 7, -7), QLineF(3, 17, 17, 3)],
    CellMark.REJECTED: [QLineF(-2, -2, 12, 12), QLineF(-7, 3, 3, 13), QLineF(7, -3, 17, 7)],
}
"""The strokes of each hatch in one tile, continued on the next."""


@lru_cache(maxsize=64)
def pattern_brush(mark: CellMark, theme: Theme, ratio: float) -> QBrush:
    """Return the brush of a pattern mark; ``ratio`` is device pixels per logical pixel."""
    if mark is CellMark.COVERED:
        color = QColor(theme.covered)
        color.setAlphaF(0.5)
        return QBrush(color)
    tile = transparent_image(_TILE, _TILE, ratio)
    painter = QPainter(tile)
    if mark is CellMark.NAN:
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


def mark_color(mark: CellMark, theme: Theme) -> str:
    """Return the colour of a mark."""
    colors = {
        CellMark.COVERED: theme.covered,
        CellMark.EDGE_0: theme.vertex[0],
        CellMark.EDGE_1: theme.vertex[1],
        CellMark.EDGE_2: theme.vertex[2],
        CellMark.TIE: theme.tie,
        CellMark.REJECTED: theme.rejected,
        CellMark.DEPTH_PASSED: theme.covered,
        CellMark.DEPTH_FAILED: theme.rejected,
        CellMark.NAN: theme.nan_dark,
        CellMark.DIFFERENCE: theme.rejected,
        CellMark.RIGHT: "#3ccb9c",
        CellMark.MISSING: theme.tie,
        CellMark.EXTRA: theme.rejected,
        CellMark.DOUBLE: theme.rejected,
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


# Marks on single pixels: the one under the pointer, the pinned one, and those of the step just done.


_LEAST_SIDE = 7.0
"""Marks of smaller cells are drawn around the cell at this size, so that they are found."""
_RING = 9.0
"""Radius of the ring around a point, in widget pixels."""


def box_lines(left: float, low: float, right: float, high: float) -> NDArray[np.float64]:
    """Return (4, 2, 2) the sides of a box: bottom, right, top, left."""
    corners = np.array([[left, low], [right, low], [right, high], [left, high]], float)
    return np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)


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
        found = QRectF()
        pixels = np.concatenate([self.pixels, self.trail])
        if len(pixels):
            (column0, row0), (column1, row1) = pixels.min(axis=0).tolist(), pixels.max(axis=0).tolist()
            found = placement.cells_rect(column0, row0, column1 - column0 + 1, row1 - row0 + 1)
        is_drawn = np.isfinite(self.lines).all(axis=(1, 2))
        places = np.concatenate([self.lines[is_drawn].reshape(-1, 2), self.points])
        places = places[np.isfinite(places).all(axis=1)]
        if len(places):
            (left, low), (right, high) = places.min(axis=0).tolist(), places.max(axis=0).tolist()
            ring = _RING + 3.0  # with its pen
            around = QRectF(placement.to_widget(left, high), placement.to_widget(right, low))
            found |= around.adjusted(-ring, -ring, ring, ring).intersected(QRectF(placement.viewport))
        return found

    @cached_property
    def crossed(self) -> set[tuple[int, int]]:
        """Columns and rows of the pixels that trail and lines run through: asked for at every painting."""
        found: set[tuple[int, int]] = set()
        lines = self.lines[np.isfinite(self.lines).all(axis=(1, 2))]
        for start, end in [*itertools.pairwise(self.trail + 0.5), *lines]:
            count = 2 * min(ceil(np.abs(end - start).max()), 4096) + 1  # Of a longer line most is outside.
            places = np.floor(np.linspace(start, end, count)).astype(int)
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
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    paint_step(painter, placement, mark.pixels, theme)
    painter.restore()


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


# The samples of magnified pixels: a dot at each place, filled in the colour of the triangle that has it, or
# hollow.


LEAST_CELL = 12.0
"""Side of a cell in logical pixels from which one sample is drawn; of n x n samples n times as much."""
LIGHT_RING = 4.0
"""By how much the diameter of a dot's light ring is more than that of what is filled."""
MOST_NAMED = 4
"""Samples that a tooltip names one by one; of more it counts them."""


@dataclass(frozen=True, eq=False)
class SampleDots:
    """S samples in every pixel of a grid of H x W pixels."""

    position: NDArray[np.float64] = field(repr=False)
    """(S, 2) places inside of a pixel, 0 to 1, y up."""
    shown: NDArray[np.integer] = field(repr=False)
    """(S, H, W) number of the triangle that has the sample, -1 for none."""

    def __post_init__(self) -> None:
        if self.position.ndim != 2 or self.position.shape[1] != 2:
            raise ValueError(f"position must be (S, 2), got {self.position.shape}")
        if self.shown.ndim != 3 or len(self.shown) != len(self.position):
            raise ValueError(f"shown must be ({len(self.position)}, H, W), got {self.shown.shape}")

    def text_at(self, column: int, row: int) -> str:
        """Say what the samples of a pixel show: ``Samples 0 and 2 show triangle 3, samples 1 and 3 none``."""
        shown = self.shown[:, row, column]
        parts: list[str] = []
        for triangle in sorted({int(number) for number in shown}, key=lambda number: (number < 0, number)):
            samples = np.flatnonzero(shown == triangle).tolist()
            if len(shown) <= MOST_NAMED:
                subject = numbered("sample", samples)
            else:
                subject = f"{len(samples)} of {len(shown)} samples"
            what = f"triangle {triangle}" if triangle >= 0 else "none"
            verb = "" if parts else " shows" if len(samples) == 1 else " show"
            parts.append(f"{subject}{verb} {what}")
        text = ", ".join(parts)
        return text[0].upper() + text[1:]


def between_samples(placement: GridPlacement, dots: SampleDots) -> tuple[float, float]:
    """Return where a number stands best in a cell: between two rows of dots, near the middle.

    Returns
    -------
    below : float
        How far below the cell's middle, in logical pixels.
    room : float
        Height that is free of dots there, in logical pixels.
    """
    heights = np.unique(dots.position[:, 1])
    middle, gap = (heights[1:] + heights[:-1]) / 2, np.diff(heights)
    chosen = int(np.abs(middle - 0.5).argmin())
    dot = _fill_of(placement, dots) + LIGHT_RING
    return float(0.5 - middle[chosen]) * placement.cell, float(gap[chosen]) * placement.cell - dot


def has_room(placement: GridPlacement, dots: SampleDots) -> bool:
    """Return whether the dots of a pixel stand clearly apart at this zoom."""
    return bool(placement.cell >= LEAST_CELL * len(dots.position) ** 0.5)


def paint_samples(
    painter: QPainter, placement: GridPlacement, dots: SampleDots, cells: tuple[int, int, int, int]
) -> None:
    """Paint the samples of cells (column0, row0, column1, row1), where there is room for them.

    A dot has a dark ring within a light one, so that it is seen on every colour. A sample that nothing has is a small
    dark dot: it differs by its form from one that a dark triangle has.
    """
    column0, row0, column1, row1 = cells
    if not has_room(placement, dots) or column1 <= column0 or row1 <= row0:
        return
    rows, columns = np.mgrid[row0:row1, column0:column1]
    x = placement.left + (columns + dots.position[:, 0, None, None]) * placement.cell
    y = placement.bottom - (rows + dots.position[:, 1, None, None]) * placement.cell
    shown = dots.shown[:, row0:row1, column0:column1]
    fill = _fill_of(placement, dots)
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    is_had = shown >= 0
    _paint_points(painter, x[~is_had], y[~is_had], (("#ffffff", 3.6), ("#000000", 2.0)))
    _paint_points(painter, x[is_had], y[is_had], (("#ffffff", fill + LIGHT_RING), ("#000000", fill + 2.4)))
    colors = id_table()
    for triangle in np.unique(shown[is_had]).tolist():
        color = QColor(*colors[triangle % len(colors)].tolist())
        _paint_points(painter, x[shown == triangle], y[shown == triangle], ((color, fill),))
    painter.restore()


def _fill_of(placement: GridPlacement, dots: SampleDots) -> float:
    """Return the diameter of what is filled of a dot, in logical pixels."""
    return float(min(max(placement.cell / len(dots.position) ** 0.5 * 0.14, 3.0), 9.0))


def _paint_points(
    painter: QPainter,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    discs: tuple[tuple[str | QColor, float], ...],
) -> None:
    """Paint discs of a colour and diameter each, one over the other, at all places (K,)."""
    points = [QPointF(*place) for place in np.stack((x, y), axis=1).tolist()]
    for color, width in discs:
        painter.setPen(QPen(QColor(color), width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
        painter.drawPoints(points)
