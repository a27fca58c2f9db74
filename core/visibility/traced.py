"""Trace of ray casting: at every pixel one triangle after another, against the nearest that its ray has met so far."""

import numpy as np

from core.depth.depth import depth_in_range
from core.records.listing import RETURN, Listing, Operation, listing
from core.records.steps import Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace
from core.visibility.ray_casting import (
    BY_FLOATS,
    EXACTLY,
    FIRST,
    RayTests,
    depth_of_nearest,
    hit_is_nearer,
    hit_value,
    ray_constants,
)
from core.visibility.rays_in_tree import TreeWalk
from core.visibility.traced_by_pixel import with_misses
from core.visibility.traced_in_tree import with_boxes

_HIT = (
    Operation("hit", "value", {"nearness": "value"}, ("depth",)),
    Operation("bound", "bound", {"error": "bound"}),
)
_WRITE = Operation("write", "store", {"after": RETURN}, ("stored", "before"))
_OTHER = ("nearest", "nearest_nearness", "nearest_error")
RAY_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "ray-first": (*_HIT, Operation("keep", "first", {"passes": RETURN}, ("stored", "after"))),
    "ray": (*_HIT, Operation("compare", "floats", {"passes": RETURN}, (*_OTHER, "sign")), _WRITE),
    "ray-exact": (
        *_HIT,
        Operation("doubt", "margin", (), _OTHER),
        Operation("exact", "exact", {"passes": RETURN}, ("sign",)),
        _WRITE,
    ),
    "out-of-range": (Operation("range", "range", {"passes": RETURN}, ("depth",)),),
}
"""Kind of row to what it does: a first hit, one that float64 tells from the nearest, and one that it does not."""


def trace_rays(source: TraceSource, rays: RayTests) -> StageTrace:
    """Return one row for every pixel and candidate triangle, and those of what rays ask besides.

    ``rays`` has the hits (F,) in depth range.
    """
    found = _trace_hits(source, rays)
    if source.geometry.drawing.asks_all:
        found = with_misses(source, found)
    return found if rays.walk is None else with_boxes(source, found, rays.walk)


def _trace_hits(source: TraceSource, rays: RayTests) -> StageTrace:
    fragments, tests = source.fragments, source.depth_tests
    depth, keeps, stored = source.depths
    kinds = tuple(RAY_OPERATIONS)
    kind = np.full(len(fragments), kinds.index("out-of-range"))
    names = {FIRST: "ray-first", BY_FLOATS: "ray", EXACTLY: "ray-exact"}
    kind[keeps] = np.array([kinds.index(names[how]) for how in sorted(names)])[rays.how]
    writes = np.ones(len(fragments), bool) if source.writes_depth is None else source.writes_depth
    passes, before = tests.passes, tests.before
    if rays.walk is not None:
        passes, before = _against_the_nearest_so_far(source, rays, rays.walk)
    is_kept = passes & writes
    after = np.where(is_kept, stored, before)
    columns: dict[str, np.ndarray] = {
        "column": fragments.column,
        "row": fragments.row,
        "depth": depth,
        "inverse_w": source.inverse_w,
        "stored": stored,
        "before": before,
        "after": after,
        "passes": passes,
        "writes": writes,
        "primitive": fragments.primitive,
    }
    columns |= _hits(source, rays, keeps)
    triangle = source.triangle_of_fragment
    kept = np.flatnonzero(is_kept)
    every, place = np.arange(len(fragments)), source.place
    unknown = np.full(source.raster.shape, np.nan)
    start = source.start
    return StageTrace(
        stage="depth",
        method=f"visibility={source.settings.visibility}",
        steps=Steps(
            kinds, kind, RAY_OPERATIONS, ends_of(triangle), ends_of(fragments.primitive, fragments.row)
        ),
        columns=columns,
        triangle=triangle,
        pixel=np.stack([fragments.column, fragments.row], axis=1),
        listings=_listings(),
        constants={
            **ray_constants(source.geometry.ray_planes),
            "quantity": source.depth_format.quantity.name,
        },
        marks={
            "covered": passes,
            "depth-failed": ~passes,
            "tie": keeps & (columns["sign"] == 0),
            "nan": np.isnan(depth),
        },
        buffers=(
            BufferTrack("primitive", start.primitive, kept, place[kept], triangle[kept], "ids", True),
            BufferTrack("nearness", unknown, kept, place[kept], columns["nearness"][kept]),
            BufferTrack("depth", start.depth, kept, place[kept], stored[kept], starts_known=True),
            BufferTrack("passes", unknown, every, place, passes.astype(float), "flags"),
        ),
    )


def _against_the_nearest_so_far(
    source: TraceSource, rays: RayTests, walk: TreeWalk
) -> tuple[np.ndarray, np.ndarray]:
    """Return which fragments (F,) were nearer when they were asked, and the depth (F,) of the nearest before each."""
    _, keeps, stored = source.depths
    passes, before = np.zeros(len(keeps), bool), np.full(len(keeps), np.nan, stored.dtype)
    passes[keeps] = rays.passes
    own, there = stored[keeps], source.start.depth.ravel()[source.place[keeps]]
    before[keeps] = np.where(walk.previous >= 0, own.take(walk.previous) if len(own) else own, there)
    return passes, before


def _hits(source: TraceSource, rays: RayTests, keeps: np.ndarray) -> dict[str, np.ndarray]:
    """Return how near every fragment (F,) is and the nearest before it, with bounds of the error."""
    planes, fragments, triangle = source.geometry.ray_planes, source.fragments, source.triangle_of_fragment
    m, n = planes.rays(fragments.column, fragments.row, source.raster.center)
    nearness, error = planes.values(triangle, m, n)
    nearest, sign = np.full(len(m), -1), np.full(len(m), -1)
    nearest[keeps], sign[keeps] = rays.before, rays.sign
    there, there_error = planes.values(np.maximum(nearest, 0), m, n)
    is_alone = nearest < 0
    columns: dict[str, np.ndarray] = {
        "m": m,
        "n": n,
        "nearness": nearness,
        "error": error,
        "nearest": nearest,
        "sign": sign,
    }
    columns["nearest_nearness"] = np.where(is_alone, np.nan, there)
    columns["nearest_error"] = np.where(is_alone, np.nan, there_error)
    columns |= {name: getattr(planes, name)[triangle] for name in ("a", "b", "c", "d", "sizes")}
    return columns


def _listings() -> dict[str, Listing]:
    compared, hit, write = listing(hit_is_nearer), listing(hit_value), listing(depth_of_nearest)
    kinds = ("ray-first", "ray", "ray-exact")
    return (
        dict.fromkeys(kinds, compared)
        | dict.fromkeys([f"{kind}.{name}" for kind in kinds for name in ("hit", "bound")], hit)
        | {"ray.write": write, "ray-exact.write": write, "out-of-range": listing(depth_in_range)}
    )
