"""Lanes and rows: triangles side by side, tallest first; all lanes step up together and give spans of inside columns.

An edge from (x0, y0) to (x1, y1) crosses the row whose centres are at y in the column

    q = ((x0 - center) dy + (y - y0) dx) / dy        dx = x1 - x0,  dy = y1 - y0

A column is right of it if it is greater than q, or equal to q and the fill rule gives the tie to the right.

Exactness
---------
Snapped corners are multiples of 2^-8 up to 2^16 and centres multiples of 2^-1, so numerator and dy are multiples of
2^-16 and 2^-8 below 2^35 and 2^18: float64 holds them, and the numerator's step dx from row to row, without
rounding. Only the quotient is rounded, to within 2^-38 where it lies in a raster of at most 2^14 columns. A quotient
that is not a whole number is at least 2^-16 / 2^17 = 2^-33 away from one. So a guard of 2^-35, taken off for a tie
that belongs to the right of the edge and added for one that does not, decides every pixel as the edge functions in
exact arithmetic do: for every corner that can be snapped, every slope and every number of rows.

A triangle is convex, so an edge drawn on beyond its ends never cuts the triangle: in every row the left bound is
the larger crossing of the left edges, the right bound the smaller one of the right edges, and no edge needs to know
where it ends. In the triangle's own rows both bounds so lie within the triangle's columns, whatever an edge that is
nearly level does outside.

What else is linear in the rows is carried along: the number of the row, or of its first pixel, or a packed word.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import numpy as np

from core.coverage.pixel_runs import Raster
from core.methods import table
from core.numeric.large_arrays import ScratchBuffers, largest_first
from core.records.arrays import Floats, Integers

# TriangleSetup: triangles side by side, tallest first, and where their edges cross the rows, as exact
# fractions.


ROUNDING_MARGIN = 2.0**-35
"""Columns; larger than the rounding of a crossing, smaller than its distance from a whole number that it is not."""
SUBPIXEL_GUARD = 2.0**-10
"""The same for the rows of corners, which are multiples of 2^-8."""
NOWHERE = 1e15
"""Size of the numerator of an edge that bounds no row: over any dy, and after any number of steps, its crossing is
2^32 columns away."""


@dataclass(frozen=True)
class TieOwners:
    """Which triangle's side owns a pixel centre that lies exactly on an edge, per kind of edge."""

    left: bool
    right: bool
    bottom: bool
    top: bool

    @property
    def left_guard(self) -> float:
        """What is added to a left crossing."""
        return -ROUNDING_MARGIN if self.left else ROUNDING_MARGIN

    @property
    def right_guard(self) -> float:
        """What is added to a right crossing."""
        return ROUNDING_MARGIN if self.right else -ROUNDING_MARGIN


@cache
def tie_owners(fill_rule: str) -> TieOwners:
    """Ask a method of the family ``fill_rule`` about a left, a right, a bottom and a top edge."""
    a, b = np.array([1.0, -1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0, -1.0])
    return TieOwners(*table.get("fill_rule", fill_rule).function(a, b).tolist())


@dataclass(frozen=True, eq=False)
class TriangleSetup:
    """L triangles that have rows, tallest first."""

    triangle: Integers
    """(L,) int64, index of the triangle."""
    taller: list[int]
    """Element r: how many lanes have more than r rows."""
    first_row: Floats
    """(L,) float64, whole numbers."""
    numerator: Floats
    """(4, L) float64, of the crossings with the first row: two left edges, then two right ones."""
    step: Floats
    """(4, L) float64, dx: what the numerator grows by from row to row."""
    reciprocal: Floats
    """(4, L) float64, 1 / dy."""
    reaches_out: bool
    """Some triangle, drawn or not, has a corner left or right of the raster."""


def row_range(y: Floats, raster: Raster, owners: TieOwners, scratch: ScratchBuffers) -> tuple[Floats, Floats]:
    """Return the first row and the number of rows (P,) float64 of triangles with corners at y (3, P), in the raster."""
    first, end = scratch("row_range", 2, y.shape[1])
    np.minimum(y[0], y[1], out=first)
    np.minimum(first, y[2], out=first)
    np.maximum(y[0], y[1], out=end)
    np.maximum(end, y[2], out=end)
    first -= raster.center + (SUBPIXEL_GUARD if owners.bottom else -SUBPIXEL_GUARD)
    end -= raster.center - (SUBPIXEL_GUARD if owners.top else -SUBPIXEL_GUARD)
    _, first_row, _, end_row = raster.bounds
    for edge in (first, end):
        np.ceil(edge, out=edge)
        np.clip(edge, float(first_row), float(end_row), out=edge)
    end -= first
    return first, end


def set_up_lanes(
    x: Floats, y: Floats, doubled_area: Floats, raster: Raster, owners: TieOwners, scratch: ScratchBuffers
) -> TriangleSetup:
    """Put triangles side by side.

    Parameters
    ----------
    x, y : (3, P) float64
        Snapped window coordinates of the corners.
    doubled_area : (P,) float64
        Its sign is the facing; triangles where it is 0 are left out.
    scratch : ScratchBuffers
        The lanes live in its memory.
    """
    first, rows = row_range(y, raster, owners, scratch)
    np.copyto(rows, 0.0, where=doubled_area == 0)  # also where a corner is nowhere
    order, taller = largest_first(rows, scratch("missing_rows", 2 * len(rows), dtype=np.uint8))
    lane_first = scratch("lane_first", len(order))
    first.take(order, out=lane_first, mode="clip")
    first_column, _, end_column, _ = raster.bounds
    is_within = bool(x.min(initial=first_column) >= first_column) and bool(
        x.max(initial=0) < end_column + raster.center
    )
    corners = _from_lowest_corner(x, y, doubled_area, order, scratch)
    numerator, step, reciprocal = _edges(*corners, lane_first, raster.center, scratch)
    return TriangleSetup(order, taller, lane_first, numerator, step, reciprocal, not is_within)


_TURNED = np.array([[0, 1, 2, 0, 1, 2], [1, 2, 0, 2, 0, 1], [2, 0, 1, 1, 2, 0]])
"""Corner (0 to 2) that comes first, second, third if corner 0, 1, 2 is the lowest, and the same of clockwise ones."""


def _from_lowest_corner(
    x: Floats, y: Floats, doubled_area: Floats, order: Integers, scratch: ScratchBuffers
) -> tuple[Floats, Floats]:
    """Return x and y (3, L) of the corners of ``order`` (L,), counter-clockwise from the lowest one."""
    total, count = x.shape[1], len(order)
    y0, y1, y2 = y
    turn, flag = scratch("turn", 2, total, dtype=np.int8)
    holds = flag.view(np.bool_)
    np.less(y1, y0, out=turn.view(np.bool_))
    np.less(y2, np.minimum(y0, y1, out=scratch("lower", total)), out=holds)
    np.maximum(turn, flag << 1, out=turn)
    np.less(doubled_area, 0, out=holds)
    turn += flag * np.int8(3)
    turn = turn.take(order)

    place = scratch("place", count, dtype=np.int64)
    turned_x, turned_y = scratch("turned", 2, 3, count)
    flat_x, flat_y = x.reshape(-1), y.reshape(-1)
    for corner, first_place in enumerate(_TURNED * total):
        first_place.take(turn, out=place, mode="clip")
        place += order
        flat_x.take(place, out=turned_x[corner], mode="clip")
        flat_y.take(place, out=turned_y[corner], mode="clip")
    return turned_x, turned_y


LEFT, MIDDLE_LEFT, RIGHT, MIDDLE_RIGHT = range(4)


def _edges(
    x: Floats, y: Floats, first_row: Floats, center: float, scratch: ScratchBuffers
) -> tuple[Floats, Floats, Floats]:
    """Return numerator at the first row, step and reciprocal (4, L) of the edges between corners at x, y (3, L).

    From the lowest corner the edge 0 to 1 goes up the right side, 2 to 0 comes down the left side; the edge 1 to 2 is
    on the right where it goes up, on the left where it goes down. A level edge bounds no row.
    """
    count = len(first_row)
    numerator, step, reciprocal = scratch("edges", 3, 4, count)
    dy, above_start, part = scratch("edge", 3, count)
    for side, start, end in ((RIGHT, 0, 1), (LEFT, 0, 2), (MIDDLE_RIGHT, 1, 2)):
        if side != LEFT:
            np.subtract(first_row, y[start], out=above_start)
            above_start += center
        np.subtract(y[end], y[start], out=dy)
        np.subtract(x[end], x[start], out=step[side])
        np.subtract(x[start], center, out=numerator[side])
        numerator[side] *= dy
        np.multiply(above_start, step[side], out=part)
        numerator[side] += part
        level = (dy == 0).nonzero()[0]
        dy[level] = 1
        np.divide(1.0, dy, out=reciprocal[side])
        numerator[side][level] = -NOWHERE if side == LEFT else NOWHERE

    # The middle edge is on the left where it goes down, else on the right. Products with 1 and 0 put its numerator
    # there, and on the other side -NOWHERE: far out on the right too, as it is divided by a negative dy there.
    step[MIDDLE_LEFT], reciprocal[MIDDLE_LEFT] = step[MIDDLE_RIGHT], reciprocal[MIDDLE_RIGHT]
    goes_down = np.less(reciprocal[MIDDLE_RIGHT], 0, out=part)
    np.multiply(numerator[MIDDLE_RIGHT], goes_down, out=numerator[MIDDLE_LEFT])
    numerator[MIDDLE_RIGHT] -= numerator[MIDDLE_LEFT]
    goes_down *= NOWHERE
    numerator[MIDDLE_RIGHT] -= goes_down
    goes_down -= NOWHERE
    numerator[MIDDLE_LEFT] += goes_down
    return numerator, step, reciprocal


# Rows: all lanes step up together; each row of a triangle becomes one span of inside columns.


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
    numerator = lanes.numerator[:, :count]
    step = lanes.step[:, :count]
    reciprocal = lanes.reciprocal[:, :count]
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
