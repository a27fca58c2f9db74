"""Which pixels' squares a triangle touches, wherever their centres lie: what exact areas are computed for.

A square lies beyond an edge if its corner nearest to the inside does: at the centre the edge function is then below
-(|a| + |b|)/2. A square for which this says nothing may still lie beside a corner of the triangle; its area is then 0.
"""

from dataclasses import dataclass

import numpy as np

from core.raster.edges.edge_functions import EdgeFunctions, edge_value
from core.raster.pixel_runs import BEHIND, MIXED, PROJECTED, Boxes, Raster, expand, rows_of
from core.records.arrays import Flags, Floats, Integers

BATCH = 1 << 20
"""Squares that are looked at in one go, about."""


@dataclass(frozen=True, eq=False)
class SquareFragments:
    """F pairs of a primitive and a pixel whose square it touches, in drawing order."""

    primitive: Integers
    """(F,) int64, index of the primitive."""
    column: Integers
    row: Integers
    is_whole: Flags
    """(F,) bool, the square lies inside as a whole."""
    edge_parts: tuple[Floats, Floats, Floats]
    """(F, 3) float64 each: change of the edge functions per column and per row, and their values at the centre."""


def bound_squares(edges: EdgeFunctions, raster: Raster) -> Boxes:
    """Return the pixels whose squares the bounding box of each triangle touches, by the cases of `bound`."""
    corners = edges.corners
    is_projected = corners.is_projected.all(axis=1)
    case = np.where(is_projected, PROJECTED, MIXED)
    case[(corners.homogeneous[..., 2] <= 0).all(axis=1)] = BEHIND
    bounds = raster.bounds
    box = np.empty((4, len(edges)), np.int64)
    # The square of pixel i reaches from i + center - 1/2 to i + center + 1/2.
    border = raster.center - 0.5
    for axis in range(2):
        along = corners.decided[..., axis]
        low, high = np.floor(along.min(axis=1) - border), np.ceil(along.max(axis=1) - border)
        box[axis] = np.maximum(np.where(is_projected, low, bounds[axis]), bounds[axis])
        box[axis + 2] = np.minimum(np.where(is_projected, high, bounds[axis + 2]), bounds[axis + 2])
    empty = (case == BEHIND) | (edges.doubled_area == 0) | (box[2] <= box[0]) | (box[3] <= box[1])
    box[2:, empty] = box[:2, empty]
    return Boxes(case, *box)


def touched_squares(edges: EdgeFunctions, raster: Raster) -> tuple[SquareFragments, int]:
    """Return the squares that P triangles touch, and how many were looked at."""
    boxes = bound_squares(edges, raster)
    runs = rows_of(boxes, np.arange(len(edges)))
    tested = int(runs.lengths.sum())
    ends = np.flatnonzero(np.diff(np.cumsum(runs.lengths) // BATCH, append=-1)) + 1
    parts = []
    for first, end in zip([0, *ends][:-1], ends, strict=True):
        part = runs.part(int(first), int(end))
        run, place = expand(part.lengths)
        parts.append(_examine(edges, raster, part.triangle[run], part.start[run] + place, part.row[run]))
    return _join(parts), tested


def _examine(
    edges: EdgeFunctions, raster: Raster, primitive: Integers, column: Integers, row: Integers
) -> SquareFragments:
    """Keep of squares (Q,) those that no edge has outside as a whole."""
    x, y = raster.centers(column, row)
    a, b, c = edges.shown_a[primitive], edges.shown_b[primitive], edges.shown_c[primitive]
    # Numbers that overflow a format of few bits touch nothing.
    with np.errstate(over="ignore", invalid="ignore"):
        value = edge_value(a, b, c, x[:, None], y[:, None])
        reach = (np.abs(a) + np.abs(b)) * 0.5
        touches = np.flatnonzero(np.all(value + reach > 0, axis=1))
        is_whole: Flags = np.all(value - reach >= 0, axis=1)
    return SquareFragments(
        primitive[touches],
        column[touches],
        row[touches],
        is_whole[touches],
        (a[touches], b[touches], value[touches]),
    )


def _join(parts: list[SquareFragments]) -> SquareFragments:
    none = np.empty(0, np.int64)
    parts = parts or [SquareFragments(none, none, none, none.astype(bool), (np.empty((0, 3)),) * 3)]
    return SquareFragments(
        np.concatenate([part.primitive for part in parts]),
        np.concatenate([part.column for part in parts]),
        np.concatenate([part.row for part in parts]),
        np.concatenate([part.is_whole for part in parts]),
        tuple(np.concatenate([part.edge_parts[k] for part in parts]) for k in range(3)),  # type: ignore[arg-type]
    )
