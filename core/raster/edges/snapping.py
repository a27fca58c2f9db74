"""Window positions of the corners as the coverage decision sees them: snapped to 1/256 pixel, or as they are.

Notes
-----
GPUs decide coverage on a 1/256-pixel grid, and so do we: every product and sum of an edge function then
fits float64 exactly (see ``edge_functions``), so a pixel on a shared edge is drawn once. Which corners are snapped, and
in which numbers the edges are computed, is up to the number format (``number_format``).
"""

from dataclasses import dataclass

import numpy as np

from core.methods import table
from core.raster.number_formats.number_format import CornerPositions, NumberFormat
from core.records.arrays import Flags, Floats

SUBPIXELS = 256
"""Steps of the 1/256-pixel grid in one pixel."""
SNAP_LIMIT = 2.0**16
"""Corners farther from the window's origin than this, in pixels, are not snapped."""


@dataclass(frozen=True, eq=False)
class WindowVertices:
    """M vertices in the window, placed once for all triangles that share them."""

    x: Floats
    """(M,) float64 pixels that coverage is decided on (snapped); NaN where the vertex cannot be projected."""
    y: Floats
    """(M,) float64, likewise."""
    is_projected: Flags
    """(M,) bool, where ``x`` and ``y`` hold."""


def place_corners(clip: Floats, size: tuple[int, int], coverage: str) -> CornerPositions:
    """Put corners on the grid of a coverage method.

    Parameters
    ----------
    clip : (P, 3, 4) float64
    size : (width, height)
    coverage : str
        A method of the family ``coverage``.
    """
    return place_corners_in(clip, size, table.get("coverage", coverage).function())


def place_corners_in(clip: Floats, size: tuple[int, int], numbers: NumberFormat) -> CornerPositions:
    """Put corners (P, 3, 4) on the grid of a number format; see `place_corners`."""
    x, y, w = clip[..., 0], clip[..., 1], clip[..., 3]
    homogeneous = _component_rows(w.shape, 3)
    homogeneous[..., 0] = (x + w) * (size[0] / 2)
    homogeneous[..., 1] = (y + w) * (size[1] / 2)
    homogeneous[..., 2] = w
    window = window_position(clip, size)
    decided, is_projected = numbers.place(window)
    return CornerPositions(homogeneous, window, decided, is_projected, clip, size, numbers)


def place_vertices(clip: Floats, size: tuple[int, int], numbers: NumberFormat) -> WindowVertices:
    """Put vertices (M, 4) on the grid of a number format, as ``place_corners`` does with corners."""
    decided, is_projected = numbers.place(window_position(clip, size))
    return WindowVertices(decided[:, 0], decided[:, 1], is_projected)


def window_position(clip: Floats, size: tuple[int, int]) -> Floats:
    """Return where clip positions (..., 4) lie in the window, (..., 2) float64 pixels; NaN where w <= 0."""
    w = clip[..., 3]
    position = _component_rows(w.shape, 2)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for axis in range(2):
            along = position[..., axis]
            np.divide(clip[..., axis], w, out=along)
            along += 1
            along *= size[axis] / 2
    in_front = w > 0
    if not in_front.all():
        position[~in_front] = np.nan
    return position


def _component_rows(shape: tuple[int, ...], count: int) -> Floats:
    """Return an empty array (*shape, count) where every component of every corner is a contiguous row."""
    return np.empty((count, *reversed(shape))).T


def snap(window: Floats, limit: float = SNAP_LIMIT) -> tuple[Floats, Flags]:
    """Round to the nearest 1/256 pixel, half to even. (P, 3, 2) pixels to (P, 3, 2) and (P, 3) bool.

    Corners more than ``limit`` pixels away along an axis are not projected.
    """
    is_projected = (np.abs(window[..., 0]) <= limit) & (np.abs(window[..., 1]) <= limit)
    snapped = window.copy(order="K")
    if not is_projected.all():
        snapped[~is_projected] = np.nan
    snapped *= SUBPIXELS
    np.rint(snapped, out=snapped)
    snapped /= SUBPIXELS
    return snapped, is_projected


def snap_one(value: float) -> float:
    """Listing of one snapped coordinate."""
    return float(np.rint(value * SUBPIXELS) / SUBPIXELS)  #: snap
