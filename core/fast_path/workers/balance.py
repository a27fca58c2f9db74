"""Where one band ends and the next begins, so that all are done at the same time, and where its pixels lie."""

from itertools import pairwise
from multiprocessing.shared_memory import SharedMemory

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Floats

PIXEL_BYTES = 4
STEP = 0.1
"""Largest part of the height that a cut moves after one picture: one slow picture is no reason to turn all over."""
DAMPING = 0.5
"""Part of the way that a cut moves: times are never twice the same."""


def even_cuts(count: int) -> Floats:
    """Return the cuts (count + 1,) float64 of bands of the same height, 0 at the bottom to 1 at the top."""
    return np.linspace(0.0, 1.0, count + 1)


def rows_of(cuts: Floats, height: int) -> list[tuple[int, int]]:
    """Return first and end row of every band of a picture of ``height`` rows, none of them empty.

    Parameters
    ----------
    cuts : (N + 1,) float64
        From 0 to 1, parts of the height.
    height : int
        At least N.
    """
    count = len(cuts) - 1
    place = np.arange(count + 1)
    rows = np.clip(np.rint(cuts * height).astype(np.int64), place, height - count + place)
    rows = np.maximum.accumulate(rows - place) + place
    return [(int(first), int(end)) for first, end in pairwise(rows)]


def moved_cuts(cuts: Floats, seconds: Floats, fixed: Floats) -> Floats:
    """Return the cuts for the next picture, closer to bands that take the same time.

    Parameters
    ----------
    cuts : (N + 1,) float64
        Those of the last picture.
    seconds : (N,) float64
        What every band took.
    fixed : (N,) float64
        The part of it that does not depend on its rows: vertices, culling, the message.

    Notes
    -----
    Within a band the work is taken to be spread evenly over its rows. Where it is not, the next picture tells: the
    cuts rest where all bands take the same time, however wrong ``fixed`` is.
    """
    fixed = np.minimum(fixed, seconds)
    divided = seconds - fixed
    total = divided.sum()
    wanted = np.maximum(seconds.mean() - fixed, 0.0)
    if total <= 0 or wanted.sum() <= 0:
        return cuts
    done = np.concatenate([[0.0], np.cumsum(divided)]) / total
    target = np.concatenate([[0.0], np.cumsum(wanted)]) / wanted.sum()
    # A band without work has no inside: the small slope keeps the places in order.
    done = (done + 1e-6 * cuts) / (1 + 1e-6)
    move: Floats = np.clip(DAMPING * (np.interp(target, done, cuts) - cuts), -STEP, STEP)
    return cuts + move


def byte_count(rows: int, columns: int) -> int:
    """Return how many bytes a band needs."""
    return rows * columns * PIXEL_BYTES


def band_pixels(memory: SharedMemory, rows: int, columns: int) -> NDArray[np.uint8]:
    """Return the pixels (rows, columns, 4) uint8 of a band, as a view of the memory."""
    return np.ndarray((rows, columns, PIXEL_BYTES), np.uint8, memory.buf)
