"""Where the pixels of a band lie in shared memory."""

from multiprocessing.shared_memory import SharedMemory

import numpy as np
from numpy.typing import NDArray

PIXEL_BYTES = 4


def byte_count(rows: int, columns: int) -> int:
    """Return how many bytes a band needs."""
    return rows * columns * PIXEL_BYTES


def band_pixels(memory: SharedMemory, rows: int, columns: int) -> NDArray[np.uint8]:
    """Return the pixels (rows, columns, 4) uint8 of a band, as a view of the memory."""
    return np.ndarray((rows, columns, PIXEL_BYTES), np.uint8, memory.buf)
