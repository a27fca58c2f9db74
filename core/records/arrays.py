"""Read-only arrays, the checks that every public function makes on its input, and values that are found once.

``functools.cached_property`` of Python 3.11 computes under one lock for all instances of a class, so work in the
background would hold up a window that asks another instance for the same. Here there is no lock: threads that ask one
instance at a time may all compute, which gives the same result, as what is computed here never changes.
"""

from collections.abc import Callable, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, Generic, Self, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Read-only arrays and the checks that every public function makes on its input.


Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]
Scalar = TypeVar("Scalar", bound=np.generic)


def read_only(array: NDArray[Scalar]) -> NDArray[Scalar]:
    """Return a view of ``array``, of any shape, that cannot be written through."""
    view = array.view()
    view.flags.writeable = False
    return view


def checked(
    name: str,
    values: ArrayLike,
    shape: Sequence[int | str],
    dtype: type[np.generic] = np.float64,
    *,
    finite: bool = True,
    limit: float | None = None,
) -> NDArray[Any]:
    """Return ``values`` as a read-only copy of ``dtype``, or say what was wanted and what came.

    An array that is read-only itself, with numbers of its own, is returned without a copy.

    Parameters
    ----------
    name : str
        What the values are called in a message.
    shape : sequence of int or str
        A number must match, a letter (``"T"``) stands for any length.
    dtype : numpy scalar type
        Kind of the result; a fraction is refused where integers are wanted.
    finite : bool
        Refuse NaN and infinity.
    limit : float, optional
        Refuse values beyond plus or minus this.

    Raises
    ------
    ValueError
        For the first of: wrong number of axes, wrong shape, wrong type, a value that is not finite or too large.
    """
    array = np.asarray(values)
    wanted = "(" + ", ".join(str(length) for length in shape) + ("," if len(shape) == 1 else "") + ")"
    if array.ndim != len(shape):
        raise ValueError(f"{name} must be {wanted}, got {array.shape}")
    if any(isinstance(n, int) and n != m for n, m in zip(shape, array.shape, strict=True)):
        raise ValueError(f"{name} must be {wanted}, got {array.shape}")
    if array.dtype.kind not in "fiub":
        raise ValueError(f"{name} must be numbers, got {array.dtype}")
    if array.dtype.kind == "f":
        bad = ~np.isfinite(array)
        if finite and bad.any():
            where = tuple(int(index[0]) for index in np.nonzero(bad))
            raise ValueError(f"{name} must be finite, got {array[where]} at {where}")
        if np.issubdtype(dtype, np.integer) and (array != np.floor(array)).any():
            raise ValueError(f"{name} must be whole numbers, got {array.dtype}")
    if limit is not None and array.size and (largest := max(float(array.max()), -float(array.min()))) > limit:
        raise ValueError(f"{name} must be at most {limit:g} in size, got {largest:g}")
    if (
        array.dtype == dtype
        and array.flags.owndata
        and array.flags.c_contiguous
        and not array.flags.writeable
    ):
        return array
    copy = np.array(array, dtype=dtype, order="C")
    copy.flags.writeable = False
    return copy


def checked_size(name: str, size: ArrayLike, limit: int) -> tuple[int, int]:
    """Return ``size``, (2,) numbers, as (width, height), each from 1 to ``limit`` pixels, or raise ValueError."""
    numbers = np.asarray(size)
    is_pair = numbers.shape == (2,) and numbers.dtype.kind in "fiu"
    if not is_pair or not np.isfinite(numbers).all() or (numbers != np.floor(numbers)).any():
        raise ValueError(f"{name} must be two whole numbers (width, height), got {size!r}")
    width, height = (int(number) for number in numbers)
    if not (1 <= width <= limit and 1 <= height <= limit):
        raise ValueError(f"{name} must be 1 to {limit} pixels each way, got {width}x{height}")
    return width, height


# Attributes that are computed when they are first asked for, by any number of threads.


Value = TypeVar("Value")


class cached_property(Generic[Value]):  # noqa: N801
    """A method without arguments as an attribute that is kept, also of a frozen record."""

    def __init__(self, compute: Callable[[Any], Value]) -> None:
        self._compute = compute
        self.__doc__ = compute.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...

    @overload
    def __get__(self, instance: object, owner: type) -> Value: ...

    def __get__(self, instance: object | None, owner: type) -> Self | Value:
        if instance is None:
            return self
        # Asked only while it is not in the record's own dictionary, which is looked at first.
        value = self._compute(instance)
        vars(instance)[self._name] = value
        return value


# Whether two values are the same, bit for bit: asked before anything is traced or painted again.


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
