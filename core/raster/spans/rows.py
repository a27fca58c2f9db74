"""Rows: all lanes step up together; each row of a triangle becomes one span of inside columns.

A triangle is convex, so an edge drawn on beyond its ends never cuts the triangle: in every row the left bound is
the larger crossing of the left edges, the right bound the smaller one of the right edges, and no edge needs to know
where it ends. In the triangle's own rows both bounds so lie within the triangle's columns, whatever an edge that is
nearly level does outside.

What else is linear in the rows is carried along: the number of the row, or of its first pixel, or a packed word.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from core.numeric.buffers import ScratchBuffers
from core.numeric.sorting import largest_first
from core.raster.pixel_runs import Raster
from core.raster.spans.lanes import LEFT, MIDDLE_LEFT, MIDDLE_RIGHT, RIGHT, TieOwners, TriangleSetup
from core.records.arrays import Floats, Integers

GROUP = 4096
"""Crossings of one edge side that are computed in one go: enough to hide the cost of the calls."""


@dataclass(frozen=True, eq=False)
class Carried:
    """Integers of L lanes that change by a fixed step from row to row."""

    first: Integers
    """(L,) int64, value at the lane's first row; used up where it changes."""
    up: Integers | int
    """(L,) int64 or one number for all, change per row; 0: none."""


@dataclass(frozen=True, eq=False)
class Spans:
    """S stretches of inside pixels, each in one row of one triangle; none is empty; longest first."""

    lane: Integers
    """(S,) int64."""
    start: Integers
    """(S,) int64, first column."""
    carried: list[Integers]
    """(S,) int64 each, the carried values in the span's row."""
    longer: list[int]
    """Element k: how many spans have more than k pixels."""

    def __len__(self) -> int:
        return len(self.lane)

    @property
    def pixel_count(self) -> int:
        """Pixels of all spans together."""
        return sum(self.longer)


def walk_rows(
    lanes: TriangleSetup,
    raster: Raster,
    owners: TieOwners,
    carried: Sequence[Carried],
    scratch: ScratchBuffers,
) -> Spans:
    """Return the spans of all lanes, longest first, with the carried values of their rows; see `bounds_of_rows`."""
    lane = Carried(np.arange(len(lanes.triangle)), 0)
    (of_lane, *values), start, length = bounds_of_rows(lanes, raster, owners, (lane, *carried), scratch)
    columns, longer = longest_first(length, (of_lane, start.astype(np.int64), *values), scratch)
    return Spans(columns[0], columns[1], columns[2:], longer)


def bounds_of_rows(
    lanes: TriangleSetup,
    raster: Raster,
    owners: TieOwners,
    carried: Sequence[Carried],
    scratch: ScratchBuffers,
) -> tuple[list[Integers], Integers, Integers]:
    """Walk the rows of all lanes, lowest level first.

    Returns
    -------
    rows : list of (R,) int64
        Every carried value.
    start, length : (R,) int32
        First column and number of pixels (below 1: none).

    Notes
    -----
    Lanes stand tallest first, so those with more than r rows are the first ``taller[r]``: a level works on a leading
    part of the arrays, without gaps. Levels of few lanes are taken several at a time; a lane that ends within such a
    group gets empty rows. The numerators of ``lanes`` are used up.
    """
    groups = _groups(lanes.taller)
    total = sum([count * levels for count, levels in groups])
    left, right = scratch("bounds", 2, total)
    values = [scratch(f"row_carried_{k}", total, dtype=np.int64) for k in range(len(carried))]
    done = row = 0
    for (count, levels), (further, _) in pairwise((*groups, (0, 0))):
        end = done + count * levels
        shape = (levels, count)
        bounds = left[done:end].reshape(shape), right[done:end].reshape(shape)
        _cross(lanes, row, levels, count, further, *bounds, scratch)
        for value, carry in zip(values, carried, strict=True):
            _carry(carry, levels, further, value[done:end].reshape(shape))
        done = end
        row += levels
    start, length = _bound_columns(left, right, lanes.reaches_out, raster, owners, scratch)
    return values, start, length


def _groups(taller: list[int]) -> list[tuple[int, int]]:
    """Return lanes and levels of the groups of levels that are computed together."""
    groups, row = [], 0
    while row < len(taller):
        levels = min(max(GROUP // taller[row], 1), len(taller) - row)
        groups.append((taller[row], levels))
        row += levels
    return groups


def _cross(
    lanes: TriangleSetup,
    row: int,
    levels: int,
    count: int,
    further: int,
    left: Floats,
    right: Floats,
    scratch: ScratchBuffers,
) -> None:
    """Write the bounds (levels, count) of the next rows, and move the numerators of the ``further`` lanes on."""
    numerator, step, reciprocal = (
        lanes.numerator[:, :count],
        lanes.step[:, :count],
        lanes.reciprocal[:, :count],
    )
    if levels == 1:
        at = scratch("crossing", 4, count)
        np.multiply(numerator, reciprocal, out=at)
        np.maximum(at[LEFT], at[MIDDLE_LEFT], out=left[0])
        np.minimum(at[RIGHT], at[MIDDLE_RIGHT], out=right[0])
        numerator[:, :further] += step[:, :further]
        return
    block = scratch("crossings", 4, levels, count)
    np.multiply(step[:, None], np.arange(float(levels))[:, None], out=block)
    block += numerator[:, None]
    block *= reciprocal[:, None]
    np.maximum(block[LEFT], block[MIDDLE_LEFT], out=left)
    np.minimum(block[RIGHT], block[MIDDLE_RIGHT], out=right)
    numerator[:, :further] += step[:, :further] * levels
    if lanes.taller[row + levels - 1] < count:
        ends = np.array(lanes.taller[row : row + levels])
        has_ended = np.arange(count) >= ends[:, None]
        np.copyto(left, 0.0, where=has_ended)
        np.copyto(right, -1.0, where=has_ended)


def _carry(carry: Carried, levels: int, further: int, values: Integers) -> None:
    """Write the carried values (levels, count) of the next rows, and move those of the ``further`` lanes on."""
    count = values.shape[1]
    first, up = carry.first[:count], carry.up if isinstance(carry.up, int) else carry.up[:count]
    is_fixed = isinstance(up, int) and not up
    if levels == 1 or is_fixed:
        values[:] = first
    elif isinstance(up, int):
        np.add(first, (np.arange(levels) * up)[:, None], out=values)
    else:
        np.multiply(up, np.arange(levels)[:, None], out=values)
        values += first
    if not is_fixed:
        change = up if isinstance(up, int) else up[:further]
        first[:further] += change if levels == 1 else change * levels


def _bound_columns(
    left: Floats, right: Floats, reaches_out: bool, raster: Raster, owners: TieOwners, scratch: ScratchBuffers
) -> tuple[Integers, Integers]:
    """Return first column and length (R,) int32 of spans between crossings (R,); the crossings are used up."""
    # One more than the crossing, cut off: the next whole number, since the guard leaves none on a whole number.
    left += 1 + owners.left_guard
    right += 1 + owners.right_guard
    if reaches_out:
        first_column, _, end_column, _ = raster.bounds
        np.maximum(left, float(first_column), out=left)
        np.minimum(right, float(end_column), out=right)
    start, length = scratch("row_columns", 2, len(left), dtype=np.int32)
    np.copyto(start, left, casting="unsafe")
    np.copyto(length, right, casting="unsafe")
    length -= start
    return start, length


def longest_first(
    length: Integers, columns: Sequence[Integers], scratch: ScratchBuffers
) -> tuple[list[Integers], list[int]]:
    """Put rows in order of their length, the longest first, without empty ones.

    Parameters
    ----------
    length : (R,) int32
        Used up.
    columns : sequence of (R,) int64
        What is known of the rows.

    Returns
    -------
    columns : list of (S,) int64
    longer : list of int
        Element k: how many have more than k pixels.
    """
    np.maximum(length, 0, out=length)
    order, longer = largest_first(length, scratch("missing_pixels", 2 * len(length), dtype=np.uint8))
    placed = []
    for number, given in enumerate(columns):
        placed.append(scratch(f"span_column_{number}", len(order), dtype=np.int64))
        given.take(order, out=placed[-1], mode="clip")
    return placed, longer
