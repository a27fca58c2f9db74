"""Fills by testing: the inside decision at pixels, over the image, a box, blocks, or by additions from pixel to pixel.

The box of a triangle is walked row by row. Its first value is evaluated, the first of every other row is that of the
row below plus b, and along a row a is added. One addition a pixel and edge instead of two products and two sums:
exact where sums are (``int64``, ``exact``, and ``snapped`` where an end of every edge is before the eye); where each
sum is rounded, the errors add up along the way, and the edge drifts.

The walk starts at the corner of the box in the *image*, whatever region of it is drawn, so that every region shows its
part of the picture.

References
----------
J. Pineda, *A parallel algorithm for polygon rasterization*, 1988.

Each returns the runs it looks at; all of them decide by the same rule and cover the same pixels.

References
----------
M. Zwicker, *Computergrafik*, lecture "Binning"; F. Pellacini, "brute force triangle rasterization".
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from core.coverage.binning import bound, one_level, runs_of_blocks, two_levels
from core.coverage.edges import EdgeFunctions, ExactFormat, decide_filtered, edge_value, is_inside
from core.coverage.number_formats import FormatValue, NumberFormat, number_format
from core.coverage.pixel_runs import (
    ADDED_A,
    ADDED_B,
    EVALUATED,
    Boxes,
    FillTraits,
    Raster,
    Runs,
    Stepping,
    expand,
    rows_of,
)
from core.methods import method, table
from core.records.arrays import Flags, Floats, Integers

# Incremental edge functions: a value is the one of the pixel before, plus a to the right or b upwards.


def step_to(edges: EdgeFunctions, runs: Runs, raster: Raster) -> Stepping:
    """Add up from the first pixel of every box of the image to the first pixels of runs."""
    whole = bound(edges, replace(raster, region=None))
    triangle, numbers = runs.triangle, edges.numbers
    x, y = (
        numbers.of_pixels(place[:, None])
        for place in raster.centers(whole.column[triangle], whole.row[triangle])
    )
    a, b, c = edges.a[triangle], edges.b[triangle], edges.c[triangle]
    with np.errstate(over="ignore", invalid="ignore"):
        first = edge_value(a, b, c, x, y)
    climbs, strides = runs.row - whole.row[triangle], runs.start - whole.column[triangle]
    at_row, below = add_up(first, increments(numbers, b), climbs)
    value, left = add_up(at_row, increments(numbers, a), strides)
    added = np.where(strides > 0, ADDED_A, np.where(climbs > 0, ADDED_B, EVALUATED))
    return Stepping(value, np.where((strides > 0)[:, None], left, below), added)


def increments(numbers: NumberFormat, slope: FormatValue) -> FormatValue:
    """Return what a value grows by from pixel to pixel, where a or b is ``slope``, any shape."""
    increment: FormatValue = slope * numbers.of_pixels(np.ones(1))
    return increment


def add_up(value: FormatValue, step: FormatValue, count: Integers) -> tuple[FormatValue, FormatValue]:
    """Add steps (N, 3) to values (N, 3), one after the other, ``count`` (N,) times each.

    Returns
    -------
    value : (N, 3)
    before : (N, 3)
        What the last addition started from; where there was none, the value itself.
    """
    order = np.argsort(-count, kind="stable")
    now, step = value[order], step[order]
    before = now.copy()
    with np.errstate(over="ignore", invalid="ignore"):
        for active in _active_counts(count):
            before[:active] = now[:active]
            now[:active] += step[:active]
    found, earlier = np.empty_like(now), np.empty_like(before)
    found[order], earlier[order] = now, before
    return found, earlier


def stepped_values(edges: EdgeFunctions, runs: Runs) -> FormatValue:
    """Return the values (Q, 3) at all pixels of runs, run by run, added up along them from where they start."""
    assert runs.stepping is not None
    length = runs.lengths
    order = np.argsort(-length, kind="stable")
    now, step = runs.stepping.value[order], increments(edges.numbers, edges.a)[runs.triangle[order]]
    place = (np.cumsum(length) - length)[order]
    values = np.empty((int(length.sum()), 3), now.dtype)
    with np.errstate(over="ignore", invalid="ignore"):
        for active in _active_counts(length):
            values[place[:active]] = now[:active]
            now[:active] += step[:active]
            place[:active] += 1
    return values


def _active_counts(count: Integers) -> list[int]:
    """Return for k = 0, 1, ... how many of ``count`` (N,) are greater than k, while there are any."""
    longest = int(count.max(initial=0))
    histogram = np.bincount(np.maximum(count, 0), minlength=longest + 1)
    at_most = np.cumsum(histogram)
    counts: list[int] = (len(count) - at_most[:longest]).tolist()
    return counts


def step_covers(
    before: list[float], increments: list[float], owns_tie: Flags | list[bool]
) -> tuple[list[float], bool]:
    """Listing of one pixel: values (3,) of the pixel it is reached from, and what is added to each of them."""
    values = []
    inside = []
    for k in range(3):
        value = before[k] + increments[k]  #: add
        values.append(value)
        inside.append(bool(value > 0 or (value == 0 and owns_tie[k])))
    return values, all(inside)  #: covered


# Coverage: the inside decision at the pixels of a schedule.


BATCH = 1 << 17
"""Pixels looked at in one go: large enough to hide call overhead, small enough to stay in the cache."""


@dataclass(frozen=True, eq=False)
class Fragments:
    """F covered pixels in drawing order."""

    primitive: Integers
    """(F,) int64, index of the primitive."""
    column: Integers
    row: Integers

    def __len__(self) -> int:
        return len(self.primitive)

    def select(self, keep: Flags) -> "Fragments":
        """Return the fragments where ``keep`` (F,) holds."""
        return self.take(np.flatnonzero(keep))

    def take(self, index: Integers) -> "Fragments":
        """Return the fragments ``index``, (G,) int64."""
        return Fragments(self.primitive.take(index), self.column.take(index), self.row.take(index))


AnyFragments = TypeVar("AnyFragments", bound=Fragments)


def join_fragments(parts: Sequence[AnyFragments]) -> AnyFragments:
    """Return fragments of one kind, at least one part of them, as one."""
    names = [name for name, values in vars(parts[0]).items() if values is not None]
    return type(parts[0])(**{name: np.concatenate([getattr(part, name) for part in parts]) for name in names})


@dataclass(frozen=True, eq=False)
class PixelTests:
    """Q pixels that were looked at, in drawing order, with every number that took part in the decision."""

    run: Integers
    """(Q,) int64, index of the run."""
    primitive: Integers
    """(Q,) int64."""
    column: Integers
    row: Integers
    values: Floats
    """(Q, 3) float64, the three edge functions at the pixel's centre, as they are shown: see ``number_format``."""
    accepted: Flags
    """(Q,) bool, taken without a test: the block or the span was inside as a whole."""
    covered: Flags
    """(Q,) bool."""
    tie: Flags
    """(Q, 3) bool, the centre lies exactly on this edge."""
    before: Floats
    """(Q, 3) float64, the values that the last addition started from; NaN where the values were evaluated."""
    added: Integers
    """(Q,) int64, ``EVALUATED``, ``ADDED_A`` or ``ADDED_B``: how the values were got."""


def examine_pixels(edges: EdgeFunctions, runs: Runs, raster: Raster) -> PixelTests:
    """Look at every pixel of ``runs`` and keep all numbers."""
    run, place = expand(runs.lengths)
    primitive, column, row = runs.triangle[run], runs.start[run] + place, runs.row[run]
    numbers, before, added = edges.numbers, np.full((len(run), 3), np.nan), np.full(len(run), EVALUATED)
    if runs.stepping is None:
        values, sides = edges.decide(primitive, *raster.centers(column, row))
    else:
        values = stepped_values(edges, runs)
        added = np.where(place > 0, ADDED_A, runs.stepping.added[run])
        earlier = np.where((place > 0)[:, None], np.roll(values, 1, axis=0), runs.stepping.before[run])
        before[added != EVALUATED] = numbers.shown_values(earlier[added != EVALUATED])
        sides = is_inside(values, edges.owns_tie.take(primitive, axis=0))
    accepted = runs.accepted[run]
    covered, tie = every_edge(sides) | accepted, np.asarray(values == 0)
    shown = numbers.shown_values(values)
    return PixelTests(run, primitive, column, row, shown, accepted, covered, tie, before, added)


def every_edge(sides: Flags) -> Flags:
    """Return (Q,) bool, whether all three of ``sides`` (Q, 3) hold: asking along so short an axis takes longer."""
    inside: Flags = sides[:, 0] & sides[:, 1] & sides[:, 2]
    return inside


def cover(edges: EdgeFunctions, runs: Runs, raster: Raster) -> Iterator[tuple[Fragments, int]]:
    """Yield the covered pixels of ``runs`` in batches, and how many pixels were tested for them.

    Notes
    -----
    The same decision as ``examine_pixels``: what depends on the row alone is computed once a run.
    """
    length = runs.lengths
    end = np.cumsum(length)
    first, count = 0, len(end)
    while first < count:
        done = int(end[first - 1]) if first else 0
        last = max(int(np.searchsorted(end, done + BATCH, "right")), first + 1)
        whole = first == 0 and last == count
        yield _cover_batch(edges, runs if whole else runs.part(first, last), length[first:last], raster)
        first = last


def _cover_batch(edges: EdgeFunctions, runs: Runs, length: Integers, raster: Raster) -> tuple[Fragments, int]:
    run, place = expand(length)
    column = runs.start.take(run)
    column += place
    primitive, row = runs.triangle.take(run), runs.row.take(run)
    if runs.accepted.all():
        return Fragments(primitive, column, row), 0
    if runs.stepping is not None:
        sides = is_inside(stepped_values(edges, runs), edges.owns_tie[primitive])
        return Fragments(primitive, column, row).select(every_edge(sides)), len(sides)
    if edges.rule is not None:
        covered = edges.covers(primitive, *raster.centers(column, row))
        return Fragments(primitive, column, row).select(covered), len(covered)
    x, y = raster.along(column), raster.along(runs.row)
    covered = runs.accepted.take(run)
    tested = len(covered) - int(np.count_nonzero(covered))
    inside = np.ones(len(covered), bool)
    for k in range(3):
        inside &= _sides(edges, k, runs.triangle, run, x, y)
    covered |= inside
    return Fragments(primitive, column, row).select(covered), tested


def _sides(edges: EdgeFunctions, k: int, triangle: Integers, run: Integers, x: Floats, y: Floats) -> Flags:
    """Decide on which side of edge k pixels (F,) lie; ``triangle`` and ``y`` are those of the runs (R,)."""
    numbers, owns_tie = edges.numbers, edges.owns_tie[triangle, k]
    exact = edges.a[triangle, k], edges.b[triangle, k], edges.c[triangle, k]
    if isinstance(numbers, ExactFormat):
        shown = edges.shown_a[triangle, k], edges.shown_b[triangle, k], edges.shown_c[triangle, k]
        return decide_filtered(shown, exact, owns_tie, run, x, y)
    a, b, c = exact
    with np.errstate(over="ignore", invalid="ignore"):
        row_part = b * numbers.of_pixels(y) + c
        value = a.take(run)
        value *= numbers.of_pixels(x)
        value += row_part.take(run)
    return is_inside(value, owns_tie.take(run))


# Fills by testing: brute force over the image, bounding box, blocks, hierarchy of blocks, additions over
# the box.


LEVEL_FACTOR = 4
"""Blocks on a side of a block of the upper level."""


@method(
    "fill",
    "bounding-box",
    "Bounding box",
    source="Zwicker 2016, Binning; Pellacini, brute force triangle rasterization",
    exact_for="every triangle",
)
def bounding_box(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Test every pixel of the box around the triangle."""
    return rows_of(boxes, np.arange(len(edges)))


@method(
    "fill",
    "hierarchy",
    "Hierarchy of blocks",
    source="Zwicker 2016, Further improvement; Greene 1996",
    exact_for="every triangle",
    takes=("block_size",),
    traits=FillTraits(group_label="Block"),
)
def hierarchy(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Look at blocks of blocks first, then at the blocks of those that the triangle's border crosses."""
    return runs_of_blocks(two_levels(edges, boxes, raster, block_size, LEVEL_FACTOR), boxes)


@method(
    "fill",
    "blocks",
    "Blocks of n x n pixels",
    source="Zwicker 2016, Improvement",
    exact_for="every triangle",
    takes=("block_size",),
    traits=FillTraits(group_label="Block"),
)
def blocks(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Discard or accept whole blocks, test the pixels of the others."""
    return runs_of_blocks(one_level(edges, boxes, raster, block_size), boxes)


@method(
    "fill",
    "brute-force",
    "Brute force",
    source="Zwicker 2016, Pixel inside/outside test; Jubair, Triangle Rasterization 3/7",
    exact_for="every triangle",
    traits=FillTraits(looks_everywhere=True),
)
def brute_force(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Test every pixel of the image for every triangle that has an area."""
    first_column, first_row, end_column, end_row = raster.bounds
    everywhere = Boxes(
        boxes.case, *(np.full(len(edges), n) for n in (first_column, first_row, end_column, end_row))
    )
    return rows_of(everywhere, np.flatnonzero(edges.doubled_area != 0))


@method(
    "fill",
    "incremental",
    "Bounding box, by additions",
    source="J. Pineda, A parallel algorithm for polygon rasterization, 1988",
    exact_for="numbers with exact sums: int64, exact, and snapped where every edge has an end in front of the "
    "eye",
    breaks_where="rounded sums (float64 not snapped, float32, float16, inverse): values drift along rows and "
    "columns",
)
def incremental(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Test every pixel of the box around the triangle, from the values of its neighbour."""
    runs = rows_of(boxes, np.arange(len(edges)))
    return replace(runs, stepping=step_to(edges, runs, raster))


def effective_fill(fill: str, coverage: str) -> str:
    """Return the fill that runs: ``bounding-box`` instead of spans that do not suit the numbers.

    Spans give the pixels of a test at every pixel only where values are monotone along a row, and are made for
    float64.
    """
    needs_float64 = "float64-edges" in table.get("fill", fill).needs
    return "bounding-box" if needs_float64 and not number_format(coverage).suits_spans else fill
