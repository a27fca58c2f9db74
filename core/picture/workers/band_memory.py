"""Where the pixels and the depth of a band lie in shared memory: depth first, since its numbers are the widest."""

from multiprocessing.shared_memory import SharedMemory

import numpy as np
from numpy.typing import DTypeLike, NDArray

DEPTH_BYTES = 8
"""Of one pixel, for the widest type that a depth method stores."""
COLOR_BYTES = 4


def byte_count(rows: int, columns: int, with_depth: bool) -> int:
    """Return how many bytes a band needs."""
    return rows * columns * (COLOR_BYTES + (DEPTH_BYTES if with_depth else 0))


def band_pixels(memory: SharedMemory, rows: int, columns: int, with_depth: bool) -> NDArray[np.uint8]:
    """Return the pixels (rows, columns, 4) uint8 of a band, as a view of the memory."""
    offset = rows * columns * DEPTH_BYTES if with_depth else 0
    return np.ndarray((rows, columns, COLOR_BYTES), np.uint8, memory.buf, offset)


def band_depth(memory: SharedMemory, rows: int, columns: int, stored_type: DTypeLike) -> np.ndarray:
    """Return the depth (rows, columns) of a band as the depth method stores it, as a view of the memory."""
    return np.ndarray((rows, columns), stored_type, memory.buf)
