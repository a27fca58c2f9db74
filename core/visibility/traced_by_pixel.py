"""Trace of ray casting in its own loops: the triangles that a ray asks and misses have rows, too."""

from dataclasses import replace

import numpy as np

from core.records.arrays import Flags, Floats, Integers
from core.records.listing import Operation, listing
from core.trace.source import TraceSource
from core.trace.stage_trace import InsertedRows, StageTrace, insert_rows, no_pixels
from core.visibility.rays_by_pixel import cast_all_rays

MOST_ASKED = 100_000
"""Pairs of a ray and a triangle up to which those that miss have rows."""
ASKED_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "ray-loops": (Operation("count", "loops"),),
    "ray-missed": (Operation("miss", "meets", (), ("edge_values",)),),
}
"""Kind of row to what it does: how much all rays ask, and a triangle that a ray does not meet."""


def with_misses(source: TraceSource, found: StageTrace) -> StageTrace:
    """Return the rows of hits, triangle by triangle, with one for each miss, and before all one that counts both.

    A hit is a fragment, in depth range or not; a miss is any other pair of a pixel and a primitive that is drawn. There
    are no rows for misses of more than `MOST_ASKED` pairs, and of lines, which no ray asks whether they are met.
    """
    primitives, rays = len(source.geometry.primitives), source.raster.shape[0] * source.raster.shape[1]
    is_listed = source.geometry.outlines is None and primitives * rays <= MOST_ASKED
    primitive, place = _missed(source) if is_listed else (np.empty(0, np.int64), np.empty(0, np.int64))
    first_column, first_row, _, _ = source.raster.bounds
    row, column = np.divmod(place, source.raster.shape[1])
    row, column = row + first_row, column + first_column
    values, is_outside = _edges_at(source, primitive, column, row)
    missed = len(primitive)

    def behind_loops(of_misses: np.ndarray, of_loops: object) -> np.ndarray:
        return np.concatenate([[of_loops], of_misses]).astype(of_misses.dtype)

    rows = InsertedRows(
        before=behind_loops(np.searchsorted(source.fragments.primitive, primitive), 0),
        group=np.zeros(missed + 1, np.int64),
        triangle=behind_loops(source.geometry.primitives.triangle[primitive], -1),
        kinds=tuple(ASKED_OPERATIONS),
        kind=behind_loops(np.ones(missed, np.int64), 0),
        operations=ASKED_OPERATIONS,
        columns={
            "column": behind_loops(column, -1),
            "row": behind_loops(row, -1),
            "primitive": behind_loops(primitive, -1),
            "edge_values": np.concatenate([np.full((1, 3), np.nan), values]),
            "is_outside": np.concatenate([np.zeros((1, 3), bool), is_outside]),
        },
        listings=dict.fromkeys(ASKED_OPERATIONS, listing(cast_all_rays)),
        pixel=np.concatenate([no_pixels(1), np.stack([column, row], axis=1)]),
    )
    joined = insert_rows(found, np.zeros(found.steps.row_count, np.int64), rows)
    is_miss = joined.steps.kind == joined.steps.kinds.index("ray-missed")
    focus = -1 if source.triangle is None else source.triangle
    counts = {"ray_count": rays, "primitive_count": primitives, "hit_count": found.steps.row_count}
    return replace(
        joined,
        marks={**joined.marks, "rejected": is_miss},
        constants={**joined.constants, **counts, "lists_misses": is_listed, "focus": focus},
    )


def _missed(source: TraceSource) -> tuple[Integers, Integers]:
    """Return the primitive and the place in the flattened picture of every miss, in drawing order."""
    pixels = source.raster.shape[0] * source.raster.shape[1]
    is_hit = np.zeros((len(source.geometry.primitives), pixels), bool)
    is_hit[source.fragments.primitive, source.place] = True
    primitive, place = np.nonzero(~is_hit)
    return primitive, place


def _edges_at(
    source: TraceSource, primitive: Integers, column: Integers, row: Integers
) -> tuple[Floats, Flags]:
    """Return the edge functions (I, 3) of primitives at pixels, and outside of which edges they lie.

    NaN and none where a primitive has no edge functions.
    """
    if source.geometry.polygons is not None or not len(primitive):
        return np.full((len(primitive), 3), np.nan), np.zeros((len(primitive), 3), bool)
    edges = source.geometry.edges
    values, sides = edges.decide(primitive, *source.raster.centers(column, row))
    return edges.numbers.shown_values(values), ~sides
