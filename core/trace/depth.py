"""Trace of the depth test: every fragment against what the buffer held."""

import numpy as np

from core.framebuffer.depth import depth_test
from core.listing import listing
from core.steps import Operation, Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

KINDS = ("test", "out-of-range", "store")


def trace_depth(source: TraceSource) -> StageTrace:
    """Return one row for every fragment."""
    fragments, tests = source.fragments, source.depth_tests
    depth, keeps, stored = source.depths
    after = np.where(tests.passes, stored, tests.before)
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
        "larger_is_nearer": np.full(len(fragments), source.depth_format.larger_is_nearer),
        "primitive": fragments.primitive,
    }
    triangle = source.triangle_of_fragment
    steps = Steps(
        kinds=KINDS,
        kind=np.where(keeps, 0 if tested else 2, 1),
        operations={
            "test": (
                Operation("depth", "compare", ("depth", "stored")),
                Operation("compare", "compare", ("before", "passes")),
                Operation("write", "store", ("after",)),
            ),
            "out-of-range": (Operation("range", "compare", ("depth", "passes")),),
            "store": (
                Operation("depth", "compare", ("depth", "stored")),
                Operation("write", "store", ("before", "after", "passes")),
            ),
        },
        triangle_ends=ends_of(triangle),
        group_ends=ends_of(fragments.primitive, fragments.row),
    )
    passed = np.flatnonzero(tests.passes)
    place = source.place
    identity = source.start.primitive
    every = np.arange(len(fragments))
    unknown = np.full(source.raster.shape, np.nan)
    return StageTrace(
        stage="depth",
        method=f"depth={source.settings.depth}",
        steps=steps,
        columns=columns,
        triangle=triangle,
        pixel=np.stack([fragments.column, fragments.row], axis=1),
        listings=dict.fromkeys(KINDS, listing(depth_test)),
        constants={"quantity": source.depth_format.quantity},
        marks={"covered": tests.passes, "depth-failed": ~tests.passes, "nan": np.isnan(depth)},
        buffers=(
            BufferTrack(
                "depth", source.start.depth, passed, place[passed], stored[passed], starts_known=True
            ),
            BufferTrack("primitive", identity, passed, place[passed], triangle[passed], "ids", True),
            BufferTrack("passes", unknown, every, place, tests.passes.astype(float), "flags"),
        ),
    )
