"""Whether two values are the same, bit for bit: asked before anything is traced or painted again."""

from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np


def is_alike(one: Any, other: Any, apart_from: tuple[str, ...] = ()) -> bool:
    """Return whether two values are the same bits, looking into tuples, lists and records.

    Parameters
    ----------
    apart_from : tuple of str
        Fields of the records themselves that may differ.

    Notes
    -----
    Numbers are compared as bits: NaN is like itself, and 0 is not like -0. Arrays of other shapes or dtypes differ.
    """
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        is_like = one.dtype == other.dtype and one.shape == other.shape
        return bool(is_like and one.tobytes() == other.tobytes())
    if isinstance(one, float):
        return np.float64(one).tobytes() == np.float64(other).tobytes()
    if isinstance(one, tuple | list):
        return len(one) == len(other) and all(map(is_alike, one, other))
    if is_dataclass(one):
        names = (each.name for each in fields(one) if each.name not in apart_from)
        return all(is_alike(getattr(one, name), getattr(other, name)) for name in names)
    return bool(one == other)
