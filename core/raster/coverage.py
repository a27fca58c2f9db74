"""Coverage: the inside decision at the pixels of a schedule."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from core.arrays import Flags, Floats, Integers
from core.raster.edge_functions import EdgeFunctions, edge_value, is_inside
from core.raster.schedule import Raster, Runs, expand

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
    """(Q, 3) float64, the three edge functions at the pixel's centre."""
    accepted: Flags
    """(Q,) bool, taken without a test: the block or the span was inside as a whole."""
    covered: Flags
    """(Q,) bool."""
    tie: Flags
    """(Q, 3) bool, the centre lies exactly on this edge."""


def examine_pixels(edges: EdgeFunctions, runs: Runs, raster: Raster) -> PixelTests:
    """Look at every pixel of ``runs`` and keep all numbers."""
    run, place = expand(runs.lengths)
    primitive, column, row = runs.triangle[run], runs.start[run] + place, runs.row[run]
    x, y = raster.centers(column, row)
    a, b, c = edges.a[primitive], edges.b[primitive], edges.c[primitive]
    values = edge_value(a, b, c, x[:, None], y[:, None])
    inside = is_inside(values, edges.owns_tie[primitive]).all(axis=1)
    accepted = runs.accepted[run]
    return PixelTests(run, primitive, column, row, values, accepted, inside | accepted, values == 0)


def cover(edges: EdgeFunctions, runs: Runs, raster: Raster) -> Iterator[tuple[Fragments, int]]:
    """Yield the covered pixels of ``runs`` in batches, and how many pixels were tested for them.

    Notes
    -----
    The same decision as ``examine_pixels``: what depends on the row alone is computed once a run.
    """
    length = runs.lengths
    end = np.cumsum(length)
    first = 0
    while first < len(runs):
        done = int(end[first - 1]) if first else 0
        last = max(int(np.searchsorted(end, done + BATCH, "right")), first + 1)
        yield _cover_batch(edges, runs.part(first, last), raster)
        first = last


def _cover_batch(edges: EdgeFunctions, runs: Runs, raster: Raster) -> tuple[Fragments, int]:
    count = runs.lengths
    run, place = expand(count)
    column = runs.start.take(run)
    column += place
    primitive, row = runs.triangle.take(run), runs.row.take(run)
    if runs.accepted.all():
        return Fragments(primitive, column, row), 0
    x, y = raster.along(column), raster.along(runs.row)
    covered = runs.accepted.take(run)
    tested = len(covered) - int(np.count_nonzero(covered))
    inside = np.ones(len(covered), bool)
    for k in range(3):
        a, owns_tie = edges.a[runs.triangle, k], edges.owns_tie[runs.triangle, k]
        row_part = edges.b[runs.triangle, k] * y + edges.c[runs.triangle, k]
        value = a.take(run)
        value *= x
        value += row_part.take(run)
        inside &= is_inside(value, owns_tie.take(run))
    covered |= inside
    return Fragments(primitive, column, row).select(covered), tested
