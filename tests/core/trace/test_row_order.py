"""The same rows pixel by pixel and row by row: every row keeps its numbers, and the buffers end alike."""

import numpy as np
import pytest

from core import Settings, trace
from core.records.primitives import DrawingOrder
from core.records.steps import PIXEL_BY_PIXEL, ROW_BY_ROW
from core.trace.row_order import in_order
from core.trace.stage_trace import StageTrace
from tests.core.trace.trace_cases import SCENES

ORDERS = (PIXEL_BY_PIXEL, ROW_BY_ROW)
CASES = [
    (scene, stage, Settings(cull="none", **chosen))
    for scene, chosen in [
        ("intersecting", {}),
        ("clip", {"blend": "over"}),
        ("lit", {"visibility": "ray-casting"}),
        ("clip", {"polygon_mode": "wireframe", "line": "wu", "blend": "over"}),
    ]
    for stage in ("raster", "shade", "depth", "blend")
]


def by_pixel(clip) -> DrawingOrder:
    """Draw as the z-buffer does, the tests listed pixel by pixel."""
    return DrawingOrder(np.arange(len(clip)), True, row_order=PIXEL_BY_PIXEL)


def same(one, other) -> bool:
    return np.array_equal(one, other, equal_nan=one.dtype.kind == "f")


def same_end(one: StageTrace, other: StageTrace, names=None) -> bool:
    ends, others = one.state(one.steps.count), other.state(other.steps.count)
    return ends.keys() == others.keys() and all(same(ends[n], others[n]) for n in names or ends)


@pytest.mark.parametrize("order", ORDERS, ids=["pixels", "rows"])
def test_buffers_and_rows_stay_and_steps_are_nested(order) -> None:
    for name, stage, settings in CASES:
        found = trace(SCENES[name], settings).stage(stage)
        sorted_rows = in_order(found, order)
        assert same_end(found, sorted_rows)
        keys = np.stack(order.keys(sorted_rows.pixel))
        rows = np.lexsort(order.keys(found.pixel)[::-1])
        assert all(same(found.columns[c][rows], sorted_rows.columns[c]) for c in found.columns)
        assert (np.diff(keys[0]) >= 0).all()
        # A step of each level ends exactly where its loop goes on.
        changes = [np.flatnonzero(np.diff(key)) + 1 for key in keys]
        count = sorted_rows.steps.row_count
        assert np.array_equal(sorted_rows.steps.triangle_ends, np.append(changes[0], count))
        assert set(sorted_rows.steps.triangle_ends) <= set(sorted_rows.steps.group_ends)
        if order.is_by_pixel:
            both = np.union1d(*changes)
            assert np.array_equal(sorted_rows.steps.group_ends, np.append(both, count))
        assert all((np.diff(track.rows) >= 0).all() for track in sorted_rows.buffers)


@pytest.mark.parametrize("antialiasing", ["none", "msaa-4", "ssaa-4"])
def test_a_method_of_visibility_asks_for_its_order(antialiasing) -> None:
    plain = Settings(cull="none", antialiasing=antialiasing)
    usual = trace(SCENES["clip"], plain).stage("depth")
    asked = trace(SCENES["clip"], plain.replaced(visibility=by_pixel)).stage("depth")
    assert usual.order is None
    assert asked.order is PIXEL_BY_PIXEL
    of_samples = [t.name for t in usual.buffers if t.name.split()[0] in ("depth", "primitive")]
    assert same_end(usual, asked, of_samples)
    if antialiasing != "ssaa-4":  # There the larger picture's pixels are gone through.
        column, row = asked.pixel.T
        assert (np.diff(row * 1000 + column) >= 0).all()
        assert len(asked.steps.group_ends) == len(np.unique(asked.pixel, axis=0))
