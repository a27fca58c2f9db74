"""Orders of whole numbers, found digit by digit: NumPy sorts numbers of one or two bytes by counting them.

That takes 3 to 5 ns a number, ten times less than finding the order of long ones.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Integers

SHORT_LIMIT = 65535
"""Largest number of two bytes."""


def radix_order(*keys: Integers) -> Integers:
    """Return the order (F,) that sorts by the last of ``keys`` (F,) int64, 0 or more, then by the one before it.

    Notes
    -----
    Digit by digit from the lowest, 16 bits each. Equal keys stay as they are.
    """
    order = np.arange(len(keys[0]))
    for key in keys:
        for shift in range(0, int(key.max(initial=0)).bit_length(), 16):
            digit = ((key >> shift) & SHORT_LIMIT).astype(np.uint16)
            order = order.take(digit.take(order).argsort(kind="stable"))
    return order


def largest_first(size: NDArray[Any], memory: NDArray[np.uint8] | None = None) -> tuple[Integers, list[int]]:
    """Put things in order of their size, the largest first, without those of size 0.

    Parameters
    ----------
    size : (N,) whole numbers of any type, 0 or more
    memory : (2N or more,) uint8, optional
        To work in.

    Returns
    -------
    order : (M,) int64
        Equally large ones stay as they are.
    larger : list of int
        Element k: how many are larger than k; the first ``larger[k]`` of ``order`` are.
    """
    largest = int(size.max(initial=0))
    kind = np.dtype(np.uint8 if largest < 256 else np.uint16 if largest <= SHORT_LIMIT else np.int64)
    if memory is None or kind.itemsize > 2:
        missing = np.empty(len(size), kind)
    else:
        missing = memory[: kind.itemsize * len(size)].view(kind)
    np.subtract(largest, size, out=missing, casting="unsafe")
    order = missing.argsort(kind="stable")
    larger = np.searchsorted(missing.take(order), np.arange(largest, 0, -1, dtype=kind)).tolist()
    return order[: larger[0] if larger else 0], larger
