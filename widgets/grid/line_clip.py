"""Segments cut to a box in float64 before Qt sees them: coordinates of 1e9, infinity, NaN do no harm."""

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QRectF

from widgets.grid.view import GridPlacement


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
