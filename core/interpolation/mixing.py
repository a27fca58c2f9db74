"""Mixing: the values of fragments from those at the corners of their primitives, a block of fragments at a time.

The rule is ``w0 * v0 + w1 * v1 + w2 * v2``, added up in this order. What costs time is to get at the values: a
block of fragments in rows of pixels shows a few hundred primitives out of many thousand. So these get small
numbers of their own, their values are copied to contiguous rows that fit the processor's nearest cache, and all
further look-ups stay there. Values that are equal at all corners (white light falls alike on red, green and
blue) are mixed once, and what all primitives share (alpha is mostly 1) is not looked up.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from core.records.arrays import Floats, Integers
from core.records.primitives import CornerValues

BLOCK = 16384
"""Fragments mixed at once: enough to make the calls cheap, few enough for the processor's cache."""


class LocalNumbers:
    """Numbers the primitives that a block of fragments shows, 0, 1, 2 and so on."""

    def __init__(self, primitive_count: int, block: int = BLOCK) -> None:
        self._number = np.empty(primitive_count, np.int64)
        self._order = np.arange(block)

    def number(self, primitive: Integers) -> tuple[Integers, Integers]:
        """Return the primitives that occur in ``primitive`` (F,), and the number of each fragment's among them.

        Parameters
        ----------
        primitive : (F,) int64 array
            At most ``block`` of them.

        Returns
        -------
        shown : (U,) int64 array
            Every primitive once.
        local : (F,) int64 array
            ``shown[local]`` is ``primitive``.
        """
        order = self._order[: len(primitive)]
        # Of all fragments of a primitive one is the last to write: it speaks for the primitive.
        self._number[primitive] = order
        speaks = np.flatnonzero(self._number.take(primitive) == order)
        shown = primitive.take(speaks)
        self._number[shown] = order[: len(shown)]
        return shown, self._number.take(primitive)


@dataclass(frozen=True, eq=False)
class _Value:
    """One of the K values at the corners."""

    source: int | float
    """Which column of the tables it is, or, as a float, the number that all corners share."""
    places: list[int]
    """Which of the K it is: several where values are equal."""


class Mixer:
    """Mixes the values at the corners of primitives."""

    def __init__(self, values: CornerValues) -> None:
        """Look for columns in the rows of ``values`` that are equal or shared."""
        self._rows = np.ascontiguousarray(values.rows)
        self._index = values.index
        self._values, self._columns = _distinct_values(self._rows)
        self._second, self._third = np.empty((2, BLOCK))

    def tables(self, primitives: Integers) -> Floats:
        """Return what has to be looked up of primitives (U,): (3, M, U) float64, M columns of every corner."""
        rows = self._rows.take(self._index.take(primitives, axis=1), axis=0)
        tables: Floats = rows.transpose(0, 2, 1)[:, self._columns]
        return tables

    def at_corners(self, tables: Floats, local: Integers) -> Iterator[tuple[list[int], Floats]]:
        """Yield which of the K values are equal, and what they are at the corners of fragments, (3, F).

        Parameters
        ----------
        tables : (3, M, U) float64 array
            From `tables`.
        local : (F,) int64 array
            Which of the U primitives a fragment belongs to.
        """
        for value in self._values:
            if isinstance(value.source, float):
                yield value.places, np.full((3, len(local)), value.source)
            else:
                yield value.places, tables[:, value.source].take(local, axis=1)

    @np.errstate(invalid="ignore", over="ignore")
    def write_mixed(self, tables: Floats, weights: Floats, local: Integers, mixed: Floats) -> None:
        """Write the values of at most ``BLOCK`` fragments.

        Parameters
        ----------
        tables : (3, M, U) float64 array
            From `tables`.
        weights : (3, F) float64 array
            Of the corners.
        local : (F,) int64 array
            Which of the U primitives a fragment belongs to.
        mixed : (K, F) float64 array
            Is written: a row for every value.
        """
        second, third = self._second[: len(local)], self._third[: len(local)]
        for value in self._values:
            first = mixed[value.places[0]]
            for weight, table, product in zip(weights, tables, (first, second, third), strict=True):
                if isinstance(value.source, float):
                    np.multiply(weight, value.source, out=product)
                else:
                    table[value.source].take(local, out=product, mode="clip")
                    product *= weight
            first += second
            first += third
            for place in value.places[1:]:
                mixed[place] = first


def _distinct_values(rows: Floats) -> tuple[list[_Value], Integers]:
    """Return the values of rows (M, K) that differ, and the columns that have to be looked up for them.

    Whether values are equal is decided by their bits: 0 and -0 are not. Most columns show in a few rows that they are
    not another one or a number throughout.
    """
    bits = rows.view(np.int64)
    few = bits[-8:]
    looks_alike = (few[:, :, None] == few[:, None]).all(axis=0)
    looks_shared = (few == bits[:1]).all(axis=0) & (len(bits) > 0)
    distinct: list[_Value] = []
    columns: list[int] = []
    for place in range(rows.shape[1]):
        for value in distinct:
            first = value.places[0]
            if looks_alike[first, place] and (bits[:, first] == bits[:, place]).all():
                value.places.append(place)
                break
        else:
            if looks_shared[place] and (bits[:, place] == bits[0, place]).all():
                distinct.append(_Value(float(rows[0, place]), [place]))
            else:
                distinct.append(_Value(len(columns), [place]))
                columns.append(place)
    return distinct, np.array(columns, np.int64)
