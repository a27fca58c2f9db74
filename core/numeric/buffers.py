"""Memory that is used again, and NumPy's own buffers: large arrays cost more to get from the system than to fill.

The GNU C library gives blocks above a limit, 128 kB at first, back to the system as soon as they are freed, and takes
new pages for the next array. When such a block is freed the limit grows to its size, up to 32 MB: so one block of
nearly that size, never written to, is taken and freed here. Sorting 110,000 bytes then takes 0.23 ms, not 0.82.

Where an operand is repeated along an axis and the rows of the result are shorter than half of NumPy's buffer (8,192
numbers by default), NumPy first copies the operands into buffers: 0.3 to 0.5 ns a number more (measured, NumPy 2.4),
three times what the sum itself takes. Operations that convert types do need a buffer; one of some hundred numbers is
as good for them.
"""

import ctypes
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from math import prod
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

BUFFERED = 512
"""Numbers in a buffer; rows of half as many are no longer copied."""
_LARGEST_KEPT = 31 << 20
"""Bytes of a block that the C library still keeps for later."""
_block = np.empty(_LARGEST_KEPT, np.uint8)
del _block


def give_back() -> None:
    """Give freed memory back to the system where the C library (GNU's) keeps it: after something large was let go."""
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None) if sys.platform == "linux" else None
    if trim is not None:
        trim(0)


class ScratchBuffers:
    """Named pieces of memory that only grow.

    Notes
    -----
    A fresh array of more than about a megabyte is given by the system page by page, at three to four times the
    cost of the work that is done in it. Whoever asks again for the same name and type gets the same memory, contents
    undefined; so two arrays that live at the same time need two names, and an scratch serves one picture at a time.
    """

    def __init__(self) -> None:
        self._pieces: dict[tuple[str, DTypeLike], NDArray[Any]] = {}

    def __call__(self, name: str, *shape: int, dtype: DTypeLike = np.float64) -> NDArray[Any]:
        """Return an uninitialised array of ``shape``."""
        count = shape[0] if len(shape) == 1 else prod(shape)
        piece = self._pieces.get((name, dtype))
        if piece is None or len(piece) < count:
            piece = self._pieces[name, dtype] = np.empty(count + count // 4 + 16, dtype)
        return piece[:count] if len(shape) == 1 else piece[:count].reshape(shape)

    @property
    def byte_count(self) -> int:
        """Bytes held."""
        return sum(piece.nbytes for piece in self._pieces.values())


@contextmanager
def short_buffers() -> Iterator[None]:
    """Have NumPy use short buffers in this thread, until the end of the block."""
    before = np.setbufsize(BUFFERED)
    try:
        yield
    finally:
        np.setbufsize(before)
