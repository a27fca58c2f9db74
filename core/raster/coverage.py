"""Coverage: the inside decision at the pixels of a schedule."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from core.raster.edges.edge_functions import EdgeFunctions, is_inside
from core.raster.fills.incremental import stepped_values
from core.raster.number_formats.exact import ExactFormat, decide_filtered
from core.raster.pixel_runs import ADDED_A, EVALUATED, Raster, Runs, expand
from core.records.arrays import Flags, Floats, Integers

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
