"""Where the pixels of a grid stand on the screen: zoom, pan, and segments cut to what Qt can take.

Window coordinates are y-up with pixel (column, row) centred at (column + 0.5, row + 0.5); widget
coordinates are y-down in logical screen pixels. This is the only place that turns one into the other.
"""

from dataclasses import dataclass
from math import ceil, floor, isfinite

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRect, QRectF

# Where the pixels of a grid stand on the screen: zoom and pan, and the mappings between the spaces.


MOST_PIXELS_PER_CELL = 400.0
WHOLE_CELL = 6.0
"""Side of a cell in device pixels from which it is rounded, so that all cells are alike."""


@dataclass(frozen=True)
class GridView:
    """The part of a raster that is shown; independent of the widget's size, so grids can share it."""

    x: float = 0.5
    """Middle of the view as a fraction of the raster's width, from the left."""
    y: float = 0.5
    """Middle of the view as a fraction of the raster's height, from the bottom."""
    zoom: float = 1.0
    """Magnification; at 1 the whole raster just fits."""


FIT = GridView()
"""The whole raster, as large as it fits."""


@dataclass(frozen=True)
class GridPlacement:
    """A raster of columns x rows cells placed in a widget."""

    columns: int
    rows: int
    viewport: QRect
    """The part of the widget that shows pixels (without rulers)."""
    left: float
    """Widget x of the left edge of column 0; whole device pixels."""
    bottom: float
    """Widget y of the bottom edge of row 0; whole device pixels."""
    cell: float
    """Side of a cell in logical pixels; a whole number of device pixels where it has six or more."""
    corner: float = 0.0
    """Window coordinate of the corner of cell (0, 0): 0 for centres at halves, -0.5 on integers."""
    origin: tuple[int, int] = (0, 0)
    """What the rulers call column 0 and row 0."""
    has_centers: bool = False
    """Whether the rulers have the coordinates of centres, in place of numbers."""

    def ruler_text(self, number: int) -> str:
        """Return what a ruler says of the column or row ``number`` of the picture."""
        return f"{number + self.corner + 0.5:g}" if self.has_centers else str(number)

    def to_widget(self, x: float, y: float) -> QPointF:
        """Return the widget position of a window position."""
        return QPointF(self.left + (x - self.corner) * self.cell, self.bottom - (y - self.corner) * self.cell)

    def to_window(self, position: QPointF) -> tuple[float, float]:
        """Return the window position of a widget position."""
        return (
            (position.x() - self.left) / self.cell + self.corner,
            (self.bottom - position.y()) / self.cell + self.corner,
        )

    def pixel_at(self, position: QPointF) -> tuple[int, int] | None:
        """Return (column, row) of the cell under a widget position, or None outside the raster."""
        if not QRectF(self.viewport).contains(position):
            return None
        column = floor((position.x() - self.left) / self.cell)
        row = floor((self.bottom - position.y()) / self.cell)
        return (column, row) if 0 <= column < self.columns and 0 <= row < self.rows else None

    def cells_rect(self, column: float, row: float, columns: float = 1, rows: float = 1) -> QRectF:
        """Return the widget rectangle of a block of cells whose lower left cell is (column, row)."""
        side = self.cell
        return QRectF(
            self.left + column * side, self.bottom - (row + rows) * side, columns * side, rows * side
        )

    @property
    def seen_raster(self) -> QRectF:
        """The part of the viewport that the raster takes, with room for its border."""
        raster = self.cells_rect(0, 0, self.columns, self.rows).adjusted(-1, -1, 1, 1)
        return raster.intersected(QRectF(self.viewport))

    def visible_cells(self) -> tuple[int, int, int, int]:
        """Return (column0, row0, column1, row1) of the cells in the viewport; the upper ends are excluded."""
        return self.cells_in(QRectF(self.viewport))

    def cells_in(self, area: QRectF) -> tuple[int, int, int, int]:
        """Return (column0, row0, column1, row1) of the visible cells that touch a part of the widget."""
        rect = area.intersected(QRectF(self.viewport))
        column0 = max(floor((rect.left() - self.left) / self.cell), 0)
        column1 = min(ceil((rect.right() - self.left) / self.cell), self.columns)
        row0 = max(floor((self.bottom - rect.bottom()) / self.cell), 0)
        row1 = min(ceil((self.bottom - rect.top()) / self.cell), self.rows)
        return column0, row0, max(column1, column0), max(row1, row0)


def place(
    columns: int, rows: int, viewport: QRect, view: GridView, ratio: float = 1.0, corner: float = 0.0
) -> GridPlacement:
    """Place a raster in ``viewport`` as ``view`` wants it; ``ratio`` is device pixels per logical pixel."""
    fit = _fitting_cell(viewport, columns, rows)
    cell = whole_cell(min(fit * view.zoom, max(MOST_PIXELS_PER_CELL, fit)), ratio)
    middle = QRectF(viewport).center()
    left = round((middle.x() - view.x * columns * cell) * ratio) / ratio
    bottom = round((middle.y() + view.y * rows * cell) * ratio) / ratio
    return GridPlacement(columns, rows, viewport, left, bottom, cell, corner)


def _fitting_cell(viewport: QRect, columns: int, rows: int) -> float:
    """Return the side of the cells of a raster that just fits, with room for its border."""
    return min(max(viewport.width() - 2, 1) / columns, max(viewport.height() - 2, 1) / rows)


def whole_cell(cell: float, ratio: float = 1.0) -> float:
    """Round the side of a cell down to whole device pixels where it has at least six."""
    return floor(cell * ratio + 1e-6) / ratio if cell * ratio >= WHOLE_CELL else cell


def zoomed(placement: GridPlacement, position: QPointF, factor: float, ratio: float = 1.0) -> GridView:
    """Return the view magnified by ``factor`` with the window point under ``position`` kept in its place.

    The side of a cell changes by at least one device pixel, so that every notch of the wheel is seen, and
    stays between half of what fits and 400 logical pixels.
    """
    viewport = placement.viewport
    fit = _fitting_cell(viewport, placement.columns, placement.rows)
    cell = placement.cell * factor
    if cell * ratio >= WHOLE_CELL:
        step = 1.0 if factor > 1 else -1.0
        grown = placement.cell * ratio + step
        cell = (max(cell * ratio, grown) if step > 0 else min(cell * ratio, grown)) / ratio
    cell = whole_cell(max(min(cell, max(MOST_PIXELS_PER_CELL, fit)), 0.5 * fit), ratio)
    across = (position.x() - placement.left) / placement.cell
    up = (placement.bottom - position.y()) / placement.cell
    middle = QRectF(viewport).center()
    x = across - (position.x() - middle.x()) / cell
    y = up - (middle.y() - position.y()) / cell
    return clamped(GridView(x / placement.columns, y / placement.rows, cell / fit))


def panned(placement: GridPlacement, view: GridView, delta: QPointF) -> GridView:
    """Return the view after the raster was dragged by ``delta`` logical pixels."""
    x = view.x - delta.x() / (placement.cell * placement.columns)
    y = view.y + delta.y() / (placement.cell * placement.rows)
    return clamped(GridView(x, y, view.zoom))


def clamped(view: GridView) -> GridView:
    """Keep the middle of the view inside of the raster, and the zoom finite and positive."""
    zoom = view.zoom if isfinite(view.zoom) and view.zoom > 0 else 1.0
    x = view.x if isfinite(view.x) else 0.5
    y = view.y if isfinite(view.y) else 0.5
    return GridView(min(max(x, 0.0), 1.0), min(max(y, 0.0), 1.0), zoom)


# Segments cut to a box in float64 before Qt sees them: coordinates of 1e9, infinity, NaN do no harm.


def clip_segments(
    segments: NDArray[np.float64], box: tuple[float, float, float, float], extended: bool = False
) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Cut segments to a box.

    Parameters
    ----------
    segments : (N, 2, 2) float64 array
        Both ends (x, y) of each segment, in the space of the box.
    box : tuple of float
        Left, bottom, right, top.
    extended : bool
        Whether to cut the whole line through both ends instead.

    Returns
    -------
    cut : (M, 2, 2) float64 array
        What is inside.
    source : (M,) intp array
        The segment that each piece comes from.

    Notes
    -----
    A segment with an end that is not finite has no direction and is left out. A segment of no length is a
    point; a line through it does not exist and is left out too.

    References
    ----------
    Y. Liang, B. Barsky: A new concept and method for line clipping, 1984.
    """
    segments = np.asarray(segments, dtype=np.float64).reshape(-1, 2, 2)
    start, low, high = segments[:, 0], np.array(box[:2]), np.array(box[2:])
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        direction = segments[:, 1] - start
        moves = direction != 0
        first, second = (low - start) / direction, (high - start) / direction
        enter, leave = (-np.inf, np.inf) if extended else (0.0, 1.0)
        entered = np.where(moves, np.minimum(first, second), -np.inf).max(axis=1, initial=enter)
        left = np.where(moves, np.maximum(first, second), np.inf).min(axis=1, initial=leave)
        is_beside = (~moves & ((start < low) | (start > high))).any(axis=1)
        cut = start[:, None] + np.array([entered, left]).T[..., None] * direction[:, None]
        # Where an end or the direction is not finite, so is what is cut.
        keep = (entered <= left) & ~is_beside & np.isfinite(cut).all(axis=(1, 2))
        source = np.flatnonzero(keep)
        # Ends of 1e300 leave rounding errors far larger than the box.
        return np.minimum(np.maximum(cut[source], low), high), source


def widget_lines(
    segments: NDArray[np.float64], placement: GridPlacement, extended: bool = False
) -> tuple[list[QLineF], NDArray[np.intp]]:
    """Return the visible parts of (N, 2, 2) window segments as widget lines, and where each is from."""
    margin = 16.0
    rect = QRectF(placement.viewport).adjusted(-margin, -margin, margin, margin)
    left, top = placement.to_window(rect.topLeft())
    right, bottom = placement.to_window(rect.bottomRight())
    cut, source = clip_segments(segments, (left, bottom, right, top), extended)
    scale = np.array([placement.cell, -placement.cell])
    ends = np.array([placement.left, placement.bottom]) + (cut - placement.corner) * scale
    return [QLineF(*row) for row in ends.reshape(-1, 4).tolist()], source
