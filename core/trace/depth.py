"""Trace of the depth test: every fragment against what the buffer held."""

import numpy as np

from core.framebuffer.depth import depth_in_range, store_depth
from core.framebuffer.packed_keys import packed_depth_test, rounded_depth_test
from core.records.arrays import Flags, Integers
from core.records.listing import RETURN, Listing, listing
from core.records.operation import Either, Operation
from core.records.steps import Steps, ends_of
from core.trace.depth_keys import PLANAR_OPERATIONS, key_columns, plane_columns
from core.trace.depth_values import value_columns, value_constants, value_listings, value_operations
from core.trace.rays import trace_rays
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "test": (
        Operation("depth", "", (), ("depth", "stored")),
        Operation("compare", "compare", {"passes": "nearer"}, ("before",)),
        Operation("write", Either("passes", "store", "reject"), {"after": RETURN}),
    ),
    "out-of-range": (Operation("range", "range", {"passes": RETURN}, ("depth",)),),
    "store": (
        Operation("depth", "", (), ("depth", "stored")),
        Operation("write", "store", {"after": RETURN}, ("before", "passes")),
    ),
}
"""Kind of row to what it does."""
DISCARDED: dict[str, tuple[Operation, ...]] = {"discarded": (Operation("discard", "", (), ("passes",)),)}
"""What the row of a fragment does that the fragment shader has discarded: it comes to no test."""
CELL = (
    Operation("depth", "", (), ("stored",)),
    Operation("compare", "compare", ("passes",), ("before",)),
    Operation("write", Either("passes", "store", "reject"), {"after": RETURN}),
)
"""What a row of a table of depths does, which is of the kind ``cell``."""


def trace_depth(source: TraceSource) -> StageTrace:
    """Return one row for every fragment."""
    if source.ray_tests is not None:
        return trace_rays(source, source.ray_tests)
    fragments, tests = source.fragments, source.depth_tests
    depth, keeps, stored = source.depths
    writes = np.ones(len(fragments), bool) if source.writes_depth is None else source.writes_depth
    is_stored = tests.passes & writes
    after = np.where(is_stored, stored, tests.before) if tests.left is None else tests.left
    tested = source.geometry.uses_depth_test
    columns: dict[str, np.ndarray] = {
        "column": fragments.column,
        "row": fragments.row,
        "depth": depth,
        "inverse_w": source.inverse_w,
        "stored": stored,
        "before": tests.before,
        "after": after,
        "passes": tests.passes,
        "writes": writes,
        "larger_is_nearer": np.full(len(fragments), source.depth_format.larger_is_nearer),
        "primitive": fragments.primitive,
    }
    operations = _operations(source)
    listings = {
        "test": listing(source.depth_format.listing),
        "out-of-range": listing(depth_in_range),
        "store": listing(store_depth),
    }
    columns |= value_columns(source)
    listings |= value_listings(source)
    is_table = source.scene.corner_count == 0
    if is_table:
        listings["cell"] = listing(source.depth_format.listing)
    if source.depth_format.is_planar:
        columns |= plane_columns(source)
        operations, listings = operations | PLANAR_OPERATIONS, listings | _planar_listings()
        if tested:
            columns |= key_columns(source)
    triangle = source.triangle_of_fragment
    kind = _kinds(tuple(operations), tested, keeps, columns, is_table)
    if not source.goes_on.all():
        kind[~source.goes_on] = len(operations)
        operations = operations | DISCARDED
    steps = Steps(
        kinds=tuple(operations),
        kind=kind,
        operations=operations,
        triangle_ends=ends_of(triangle),
        group_ends=ends_of(
            triangle if source.scene.corner_count == 0 else fragments.primitive, fragments.row
        ),
    )
    kept = np.flatnonzero(is_stored)
    changed = kept if tests.left is None else np.flatnonzero(keeps)
    place = source.place
    identity = source.start.primitive
    every = np.arange(len(fragments))
    unknown = np.full(source.raster.shape, np.nan)
    return StageTrace(
        stage="depth",
        method="" if source.scene.corner_count == 0 else f"depth={source.settings.depth}",
        steps=steps,
        columns=columns,
        triangle=triangle,
        pixel=np.stack([fragments.column, fragments.row], axis=1),
        listings=listings,
        constants={**value_constants(source), **_test_constants(source)},
        marks={"covered": tests.passes, "depth-failed": ~tests.passes, "nan": np.isnan(depth)},
        buffers=(
            BufferTrack(
                "depth", source.start.depth, changed, place[changed], after[changed], starts_known=True
            ),
            BufferTrack("primitive", identity, kept, place[kept], triangle[kept], "ids", True),
            BufferTrack("passes", unknown, every, place, tests.passes.astype(float), "flags"),
        ),
    )


def _test_constants(source: TraceSource) -> dict[str, str]:
    """Return how depths are compared, where a table of depths has chosen it."""
    return {"comparison": source.depth_format.comparison} if source.scene.corner_count == 0 else {}


def _operations(source: TraceSource) -> dict[str, tuple[Operation, ...]]:
    """Return what the rows do; most depth methods make the value that is stored in steps of their own."""
    if source.scene.corner_count == 0:
        return {**OPERATIONS, "cell": CELL}
    made = value_operations(source)
    if not made:
        return OPERATIONS
    return {kind: (*made, *rows[1:]) if kind != "out-of-range" else rows for kind, rows in OPERATIONS.items()}


def _kinds(
    names: tuple[str, ...], tested: bool, keeps: Flags, columns: dict[str, np.ndarray], is_table: bool
) -> Integers:
    """Return (R,) int64, which of ``names`` each row is."""
    test = "cell" if is_table else "test"
    usual = names.index(test if tested else "store")
    kind = np.where(keeps, usual, names.index("out-of-range"))
    if "is_linear" in columns:
        # A depth that is rounded pixel by pixel, or one that is a plane, needs words of its own.
        is_other = columns["is_linear"] != tested
        kind[keeps & is_other] = names.index("rounded" if tested else "plane")
    return kind


def _planar_listings() -> dict[str, Listing]:
    packed = listing(packed_depth_test)
    return {"test": packed, "plane": packed, "rounded": listing(rounded_depth_test)}
