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
    start = segments[:, 0]
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        direction = segments[:, 1] - start
        keep = np.isfinite(segments).all(axis=(1, 2)) & np.isfinite(direction).all(axis=1)
        enter = np.full(len(segments), -np.inf if extended else 0.0)
        leave = np.full(len(segments), np.inf if extended else 1.0)
        if extended:
            keep &= (direction != 0).any(axis=1)
        for axis in (0, 1):
            low, high = box[axis], box[axis + 2]
            moves = direction[:, axis] != 0
            first = (low - start[:, axis]) / direction[:, axis]
            second = (high - start[:, axis]) / direction[:, axis]
            enter = np.where(moves, np.maximum(enter, np.minimum(first, second)), enter)
            leave = np.where(moves, np.minimum(leave, np.maximum(first, second)), leave)
            keep &= moves | ((start[:, axis] >= low) & (start[:, axis] <= high))
        keep &= enter <= leave
        ends = np.stack((enter, leave), axis=1)[:, :, None]
        cut = start[:, None, :] + ends * direction[:, None, :]
        keep &= np.isfinite(cut).all(axis=(1, 2))
        # Ends of 1e300 leave rounding errors far larger than the box.
        cut = np.clip(cut, box[:2], box[2:])
    source = np.flatnonzero(keep)
    return cut[source], source


def widget_lines(
    segments: NDArray[np.float64], placement: GridPlacement, extended: bool = False
) -> tuple[list[QLineF], NDArray[np.intp]]:
    """Return the visible parts of (N, 2, 2) window segments as widget lines, and where each is from."""
    margin = 16.0
    rect = QRectF(placement.viewport).adjusted(-margin, -margin, margin, margin)
    left, top = placement.to_window(rect.topLeft())
    right, bottom = placement.to_window(rect.bottomRight())
    cut, source = clip_segments(segments, (left, bottom, right, top), extended)
    x = placement.left + (cut[:, :, 0] - placement.corner) * placement.cell
    y = placement.bottom - (cut[:, :, 1] - placement.corner) * placement.cell
    ends = np.stack((x[:, 0], y[:, 0], x[:, 1], y[:, 1]), axis=1)
    return [QLineF(*row) for row in ends.tolist()], source
