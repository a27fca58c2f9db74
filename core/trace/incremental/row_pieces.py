"""Rows put together from previous and new ones, one stretch of equal origin after another.

Rows belong to primitives and stand in drawing order, so the rows of a primitive are neighbours. Those of neighbouring
primitives that were neighbours before are copied in one go, and where nothing is new, not at all.
"""

from dataclasses import dataclass, fields, replace
from itertools import pairwise
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Integers

Joined = TypeVar("Joined")


@dataclass(frozen=True)
class Stretch:
    """Neighbouring rows of one origin."""

    is_kept: bool
    """Whether they are previous rows, not new ones."""
    start: int
    """First row, among those of its origin."""
    stop: int
    place: int
    """Where it begins in the rows that are put together."""


@dataclass(frozen=True, eq=False)
class RowPieces:
    """How R rows of P primitives are put together."""

    stretches: tuple[Stretch, ...]
    primitive: Integers
    """(R,) int64, the primitive of every row, as it is numbered now."""
    before_count: int
    """Rows that there were before."""

    @property
    def is_in_place(self) -> bool:
        """Whether all rows that are kept stand where they stood."""
        return self.before_count == len(self.primitive) and all(
            of.place == of.start for of in self.stretches if of.is_kept
        )

    def join(self, before: NDArray[Any], new: NDArray[Any]) -> NDArray[Any]:
        """Return the rows (R, ...); ``before`` itself where they are the same bits.

        Parameters
        ----------
        before : (B, ...) array
            Previous rows.
        new : (N, ...) array
            Rows of the primitives that changed.
        """
        if self.is_in_place and self._agree(before, new):
            return before
        parts = [(before if of.is_kept else new)[of.start : of.stop] for of in self.stretches]
        return np.concatenate(parts) if parts else new

    def _agree(self, before: NDArray[Any], new: NDArray[Any]) -> bool:
        """Return whether the new rows (N, ...) equal the previous ones (B, ...), bit for bit."""
        return all(
            bool(same_rows(new[of.start : of.stop], before[of.place : of.place + of.stop - of.start]).all())
            for of in self.stretches
            if not of.is_kept
        )

    def join_all(self, before: Joined, new: Joined) -> Joined:
        """Return the same of every array in a tuple, a mapping or a record; ``None`` stays."""
        joined: Any
        if isinstance(before, np.ndarray):
            joined = self.join(before, np.asarray(new))
        elif isinstance(before, tuple) and isinstance(new, tuple):
            joined = tuple(self.join_all(old, fresh) for old, fresh in zip(before, new, strict=True))
        elif isinstance(before, dict) and isinstance(new, dict):
            joined = {name: self.join_all(before[name], fresh) for name, fresh in new.items()}
        elif before is None:
            joined = None
        else:
            joined = _join_fields(self, before, new)
        result: Joined = joined
        return result


def _join_fields(pieces: RowPieces, before: Any, new: Any) -> Any:
    """Return a record whose fields are joined, those that are called ``primitive`` numbered as they are now."""
    names = [field.name for field in fields(new)]
    joined = {name: pieces.join_all(getattr(before, name), getattr(new, name)) for name in names}
    if "primitive" in joined:
        joined["primitive"] = pieces.primitive
    return replace(new, **joined)


def pieces_of(before: Integers, new: Integers, number_before: Integers) -> RowPieces:
    """Return how rows are put together.

    Parameters
    ----------
    before : (B,) int64
        The primitive of every previous row, not decreasing, as it was numbered then.
    new : (N,) int64
        The primitive of every new row, not decreasing.
    number_before : (P,) int64
        What number each primitive had; -1: its rows are new.
    """
    is_kept, count = number_before >= 0, len(number_before)
    number = np.where(is_kept, number_before, np.arange(count))
    start, stop = (
        np.where(is_kept, np.searchsorted(before, number, side), np.searchsorted(new, number, side))
        for side in ("left", "right")
    )
    length = stop - start
    filled = np.flatnonzero(length)
    goes_on = (is_kept[filled][1:] == is_kept[filled][:-1]) & (start[filled][1:] == stop[filled][:-1])
    first = np.concatenate([[0], np.flatnonzero(~goes_on) + 1, [len(filled)]])
    place = np.cumsum(length) - length
    stretches = tuple(
        Stretch(
            bool(is_kept[filled[i]]), int(start[filled[i]]), int(stop[filled[j - 1]]), int(place[filled[i]])
        )
        for i, j in pairwise(first)
        if j > i
    )
    return RowPieces(stretches, np.repeat(np.arange(count), length), len(before))


def same_rows(first: NDArray[Any], second: NDArray[Any]) -> NDArray[np.bool_]:
    """Return (N,) bool, where two arrays (N, ...) of one type have the same bits; whole numbers of any length, values.

    Notes
    -----
    Not ``==``: a NaN is the same as itself here, and 0 is not -0.
    """
    count = len(first)
    if first.dtype != second.dtype or first.shape != second.shape:
        return np.zeros(count, bool)
    if not first.size:
        return np.ones(count, bool)
    if first.dtype.hasobject:
        numbers, unchanged_primitives = first, second
    else:
        numbers, unchanged_primitives = (np.ascontiguousarray(of).view(np.uint8) for of in (first, second))
    same: NDArray[np.bool_] = np.equal(numbers, unchanged_primitives).reshape(count, -1).all(axis=1)
    return same
