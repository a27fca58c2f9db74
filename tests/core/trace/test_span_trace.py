"""The trace of the fill ``spans`` and of packed keys: order of execution, exact crossings, the least key."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, trace
from core.methods import table
from core.numeric.large_arrays import ScratchBuffers
from core.spans.fill import lanes_of_edges
from core.spans.lanes import LEFT, MIDDLE_LEFT, MIDDLE_RIGHT, RIGHT, tie_owners
from core.trace.stage_trace import StageTrace
from tests.core.strategies import ANY_TRIANGLES, REGIONS, clip_of_window
from tests.core.trace.trace_cases import SCENES, small_region

SPANS = Settings(fill="spans", depth="fixed-38")


def kinds_of(found: StageTrace) -> np.ndarray:
    """Return the kind of every row as a word."""
    return np.array(found.steps.kinds)[found.steps.kind]


def drawing(found: StageTrace, name: str) -> list[str]:
    """Return a buffer after all rows as text, top row first; ``.``: nothing there."""
    buffer = next(track for track in found.buffers if track.name == name).at(found.steps.row_count)
    return ["".join("." if np.isnan(value) else str(int(value)) for value in row) for row in buffer[::-1]]


def two_triangles() -> ClipScene:
    """Return one with rows 1 to 5 and, drawn after it, one with rows 0 to 6."""
    size = (10, 8)
    low = [(1.5, 1), (4.75, 1), (1.5, 6)]
    tall = [(5, 0), (9.5, 0), (5, 7)]
    return ClipScene(clip_of_window([low, tall], size), size=size)


def test_passes_go_from_left_to_right_through_every_span():
    found = trace(two_triangles(), SPANS).stage("raster")
    assert drawing(found, "pass") == [
        "..........",
        "..........",
        ".0...0....",
        ".0...01...",
        ".01..01...",
        ".012.012..",
        ".012.0123.",
        ".....0123.",
    ]


def test_the_first_pass_draws_the_longest_spans_first():
    found = trace(two_triangles(), SPANS).stage("raster")
    c, kind = found.columns, kinds_of(found)
    lanes = np.flatnonzero(kind == "lane")
    assert c["lane"][lanes].tolist() == [1, 0]
    assert c["row_count"][lanes].tolist() == [5, 7]
    # Longest first; of equal length those of lower levels, on one level those of the first lanes.
    first = np.flatnonzero((kind == "pass") & (c["pass_number"] == 0))
    first = first[np.argsort(c["rank"][first])]
    assert [(int(found.triangle[row]), int(c["row"][row])) for row in first] == [
        (1, 0),
        (1, 1),
        (0, 1),
        (0, 2),
        (1, 2),
        (0, 3),
        (1, 3),
        (1, 4),
        (0, 4),
        (0, 5),
        (1, 5),
    ]
    empty = np.flatnonzero((kind == "lane-row") & (c["length"] == 0))
    assert [(int(found.triangle[row]), int(c["row"][row])) for row in empty] == [(1, 6)]
    assert c["place"][empty].tolist() == [-1]


@given(
    ANY_TRIANGLES,
    REGIONS,
    st.sampled_from(table.names("fill_rule")),
    st.sampled_from(table.names("pixel_center")),
)
def test_every_pixel_has_its_rank(case, region, fill_rule, center):
    clip, size = case
    column, row, columns, rows = region
    region = (min(column, size[0] - 1), min(row, size[1] - 1), columns + 1, rows + 1)
    settings = Settings(fill="spans", fill_rule=fill_rule, pixel_center=center)
    found = trace(ClipScene(clip, size=size), settings, region=region).stage("raster")
    c, kind = found.columns, kinds_of(found)
    is_pixel = found.pixel[:, 0] >= 0
    assert np.array_equal(np.sort(c["rank"][is_pixel]), np.arange(is_pixel.sum()))
    assert (c["rank"][~is_pixel] == -1).all()
    passes = np.flatnonzero(kind == "pass")
    in_order = passes[np.argsort(c["rank"][passes])]
    assert (np.diff(c["pass_number"][in_order]) >= 0).all()
    for number in np.unique(c["pass_number"][passes]):
        of_pass = in_order[c["pass_number"][in_order] == number]
        assert (c["pass_size"][of_pass] == len(of_pass)).all()
        assert np.array_equal(c["place"][of_pass], np.arange(len(of_pass)))
    assert np.array_equal(c["column"][passes], c["start"][passes] + c["pass_number"][passes])


@pytest.mark.parametrize("name", ["clip", "lit", "near-plane"])
def test_lanes_stand_tallest_first(name):
    found = trace(SCENES[name], SPANS).stage("raster")
    c = found.columns
    lanes = np.flatnonzero(kinds_of(found) == "lane")
    order = lanes[np.argsort(c["lane"][lanes])]
    assert np.array_equal(c["lane"][order], np.arange(found.constants["lane_count"]))
    assert (np.diff(c["row_count"][order]) <= 0).all()
    rows = np.flatnonzero(kinds_of(found) == "lane-row")
    for lane in lanes:
        own = rows[c["primitive"][rows] == c["primitive"][lane]]
        assert c["row"][own].tolist() == [c["first_row"][lane] + r for r in range(c["row_count"][lane])]
        assert c["level"][own].tolist() == list(range(c["row_count"][lane]))


@given(ANY_TRIANGLES)
def test_the_fractions_are_those_of_the_engine(case):
    clip, size = case
    traced = trace(ClipScene(clip, size=size), Settings(fill="spans"))
    found, edges, raster = traced.stage("raster"), traced.source.geometry.edges, traced.source.raster
    c = found.columns
    lanes = lanes_of_edges(edges, raster, tie_owners("shared-edge"), ScratchBuffers())
    for row in np.flatnonzero(kinds_of(found) == "lane-row").tolist():
        lane, level = c["lane"][row], c["level"][row]
        crossings = (lanes.numerator[:, lane] + level * lanes.step[:, lane]) * lanes.reciprocal[:, lane]
        assert c["left"][row] == max(crossings[LEFT], crossings[MIDDLE_LEFT])
        assert c["right"][row] == min(crossings[RIGHT], crossings[MIDDLE_RIGHT])


@pytest.mark.parametrize("name", sorted(name for name, scene in SCENES.items() if scene.corner_count))
def test_the_least_key_is_what_the_depth_test_keeps(name):
    scene = SCENES[name]
    found = trace(scene, SPANS, region=small_region(scene)).stage("depth")
    c = found.columns
    kept = c["key"] >= 0
    assert np.array_equal(c["passes"][kept], c["key"][kept] < c["before_key"][kept])
    assert np.array_equal(c["after_key"][kept], np.minimum(c["key"], c["before_key"])[kept])
    assert np.array_equal(c["after"][kept], (c["after_key"][kept] >> 24) - (1 << 20))
    passed = np.flatnonzero(c["passes"])
    assert np.array_equal(c["after_key"][passed] & 0xFFFFFF, found.triangle[passed] + 1)
    assert (c["key"][~kept] == -1).all()
    assert set(kinds_of(found)[~kept]) <= {"out-of-range"}


def test_a_tie_keeps_the_triangle_that_came_first():
    corners = [[[-1, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1]]]
    found = trace(ClipScene(corners * 2, size=(4, 4)), SPANS).stage("depth")
    second = found.triangle == 1
    assert not found.columns["passes"][second].any()
    assert (found.columns["key"][second] == found.columns["before_key"][second] + 1).all()


def test_the_key_of_earlier_triangles_is_there_when_one_is_traced():
    corners = [[[-1, -1, z, 1], [1, -1, z, 1], [0, 1, z, 1]] for z in (0.5, 0.0)]
    found = trace(ClipScene(corners, size=(4, 4)), SPANS, 1).stage("depth")
    assert (found.columns["before_key"] & 0xFFFFFF == 1).all()
    assert found.columns["passes"].all()


def test_without_a_depth_test_there_is_no_key():
    found = trace(SCENES["clip"], Settings(depth="fixed-38", visibility="last-drawn")).stage("depth")
    assert "key" not in found.columns
    assert {"plane", "store"} <= set(kinds_of(found))
