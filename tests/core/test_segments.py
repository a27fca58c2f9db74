"""Segments and points: pixels, clipping, stages, and the agreement of picture, trace, history and fast path."""

import re
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import STAGES, ClipScene, Settings, draw_lines, render, trace
from core.clipping.planes import clip_segments
from core.clipping.sutherland_hodgman import ALL_PLANES
from core.culling.culling import plane_distances
from core.explain.steps import account
from core.methods import table
from core.records.primitives import Primitives
from core.scene import CORNER_COUNTS
from tests.core.agreement import Case, check_case, random_case
from tests.core.strategies import clip_of_window

SIZE = (16, 16)
"""Powers of two: the way to clip space and back is exact."""
EIGHTHS = st.integers(0, 8 * 12).map(lambda number: number / 8)


def segments(ends, **more) -> ClipScene:
    """Return the scene of segments with ends (T, 2, 2) in the window."""
    return ClipScene(clip_of_window(np.asarray(ends, float), SIZE), size=SIZE, kind="segments", **more)


@given(
    ends=st.lists(st.lists(st.tuples(EIGHTHS, EIGHTHS), min_size=2, max_size=2), min_size=1, max_size=5),
    line=st.sampled_from(table.names("line")),
)
def test_a_segment_has_the_pixels_of_its_line_to_the_last(ends, line):
    drawn = draw_lines(np.array(ends, float), *SIZE, line=line, last_pixel=True)
    inside = ((drawn.pixels >= 0) & (drawn.pixels < SIZE)).all(axis=1)
    count = np.zeros((SIZE[1], SIZE[0]), int)
    np.add.at(count, tuple(drawn.pixels[inside].T[::-1]), 1)
    assert np.array_equal(render(segments(ends), Settings(line=line)).cover_count, count)


def test_a_strip_draws_the_pixels_of_its_vertices_once():
    corners = np.array([[1.5, 1.5], [9.5, 3.5], [3.5, 10.5]])
    index = np.array([[0, 1], [1, 2]])
    assert render(segments(corners[index], shared=index)).cover_count.max() == 1
    assert render(segments(corners[index])).cover_count.max() == 2


def test_a_clipped_segment_draws_its_pixels_once():
    beyond = segments([[[1.5, 1.5], [30, 4.5]], [[-9, 9], [40, 12]]])
    frame = render(beyond, Settings(clipping="sutherland-hodgman"))
    assert frame.cover_count.max() == 1


@pytest.mark.parametrize("line", ["bresenham", "wu"])
def test_a_point_is_the_pixel_that_contains_it(line):
    clip = clip_of_window(np.array([[[1.25, 2.75]], [[15.99, 0.5]], [[16.5, 3.5]]]), SIZE)
    frame = render(ClipScene(clip, size=SIZE, kind="points"), Settings(line=line))
    assert list(zip(*np.nonzero(frame.primitive >= 0), strict=True)) == [(0, 15), (2, 1)]


NUMBERS = st.integers(-16, 16).map(lambda number: number / 8)


@given(ends=st.lists(st.lists(NUMBERS, min_size=4, max_size=4), min_size=2, max_size=2))
def test_a_clipped_segment_is_the_part_inside_of_all_planes(ends):
    first, last = Fraction(0), Fraction(1)
    is_empty = False
    for start, end in np.array([plane_distances(np.array(end)) for end in ends]).T.tolist():
        start, end = Fraction(start), Fraction(end)
        is_empty |= start < 0 and end < 0
        if start < 0 <= end:
            first = max(first, start / (start - end))
        if end < 0 <= start:
            last = min(last, start / (start - end))
    corners = np.array(ends)[[0, 1, 1]][None]
    whole = Primitives(corners, np.array([[[0.0], [1.0], [1.0]]]), np.zeros(1, int), np.zeros(1, int), {})
    found = clip_segments(whole, plane_distances(corners), ALL_PLANES)
    if is_empty or first > last:
        # Of a segment that only touches, rounding may leave a point.
        assert len(found.primitives) == 0 or abs(first - last) < 1e-12
        return
    if len(found.primitives) == 0:
        assert last - first < 1e-12
        return
    assert found.primitives.varyings[0, :, 0] == pytest.approx([float(first), float(last), float(last)])
    assert (plane_distances(found.primitives.clip) >= -1e-12).all()


@pytest.mark.parametrize("kind", ["segments", "points"])
def test_every_stage_has_its_steps_and_those_of_areas_have_none(kind):
    scene = ClipScene(
        np.array([[[-0.5, -0.5, 0, 1], [0.9, 1.4, -1.5, -0.6]]])[:, : CORNER_COUNTS[kind]],
        size=SIZE,
        kind=kind,
    )
    run = trace(scene, Settings(clipping="sutherland-hodgman"))
    counts = {
        stage: len(run.stage(stage).triangle) for stage in ("transform", "cull", "clip", "edges", "bin")
    }
    lines = kind == "segments"
    assert counts == {
        "transform": 4 if lines else 2,
        "cull": 8,
        "clip": 6 if lines else 1,
        "edges": 0,
        "bin": 0,
    }
    assert {run.stage("cull").kind_of(row) for row in range(8)} == {"behind", "plane", "kept"}


def of_kind(case: Case, kind: str) -> Case:
    """Return the case with the first corners of its triangles."""
    scene, count = case.scene, CORNER_COUNTS[kind]
    cut = ClipScene(
        scene.clip[:, :count],
        scene.attributes[:, :count],
        scene.size,
        scene.texture,
        scene.background,
        kind=kind,
    )
    return Case(cut, case.settings, case.pixels)


@pytest.mark.parametrize("seed", range(8))
def test_picture_trace_history_and_fast_path_agree(seed):
    case = random_case(seed)
    if isinstance(case.scene, ClipScene):
        for kind in ("segments", "points"):
            check_case(of_kind(case, kind))


def test_a_wrong_kind_and_a_wrong_shape_are_refused():
    with pytest.raises(
        ValueError, match="kind must be one of points, segments, triangles, fragments, polygons, got lines"
    ):
        ClipScene(np.zeros((1, 2, 4)), kind="lines")
    with pytest.raises(ValueError, match=r"clip must be \(T, 2, 4\)"):
        ClipScene(np.ones((1, 3, 4)), kind="segments")


@pytest.mark.parametrize("kind", ["segments", "points"])
def test_no_step_speaks_of_triangles(kind):
    clip = np.array([[[-0.5, -0.5, 0, 1], [2.0, 0.4, 0.5, 1]]])[:, : CORNER_COUNTS[kind]]
    run = trace(
        ClipScene(clip, size=SIZE, kind=kind),
        Settings(clipping="sutherland-hodgman", line_clipping="cohen-sutherland"),
    )
    said = []
    for stage in STAGES:
        found = run.stage(stage)
        for row in np.unique(found.steps.kind, return_index=True)[1].tolist():
            first = int(found.steps.starts[row])
            operations = len(found.steps.operations[found.kind_of(row)])
            for position in range(first + 1, first + operations + 1):
                explanation = found.explain(position)
                assert explanation is not None
                said.append(account(explanation, int(found.triangle[row]), None)[0])
    assert said
    assert not [text for text in said if re.search("triangle|edge|corner", text, re.IGNORECASE)]


CLIPPERS = ("cohen-sutherland", "liang-barsky", "cyrus-beck")


@pytest.mark.parametrize("clipper", CLIPPERS)
def test_a_segment_is_clipped_to_the_window_of_its_scene(clipper):
    clip = clip_of_window(np.array([[[-1.0, -2], [9, 7]]]), (16, 12))
    scene = ClipScene(clip, size=(16, 12), kind="segments", clip_region=[-1, -1, 0, 0])
    settings = Settings(line_clipping=clipper)
    raster = trace(scene, settings).stage("raster")
    lines = raster.extra["outline_clip"].lines
    start, end = lines.segments[0]
    assert start == pytest.approx([-1 + 10 * 2 / 9, 0])
    assert end == pytest.approx([-1 + 10 * 8 / 9, 6])
    if clipper != "cohen-sutherland":
        crossing = dict(zip(raster.columns["border"], raster.columns["crossing_t"], strict=True))
        wanted = {"left": 1 / 10, "bottom": 2 / 9, "right": 9 / 10, "top": 8 / 9}
        assert {name: crossing[name] for name in wanted} == pytest.approx(wanted)
    check_case(Case(scene, settings, [(1, 0), (7, 5), (7, 6), (12, 9)]))


def test_cyrus_beck_clips_to_a_convex_polygon_and_others_say_what_they_need():
    triangle = np.array([[2.0, 2], [14, 2], [8, 10]])
    clip = clip_of_window(np.array([[[0.0, 4], [16, 4]]]), (16, 12))
    region = triangle / (8, 6) - 1
    scene = ClipScene(clip, size=(16, 12), kind="segments", clip_region=region)
    raster = trace(scene, Settings(line_clipping="cyrus-beck")).stage("raster")
    assert raster.extra["outline_clip"].lines.segments[0] == pytest.approx(np.array([[3.5, 4], [12.5, 4]]))
    with pytest.raises(ValueError, match="cohen-sutherland needs a rectangle"):
        render(scene, Settings(line_clipping="cohen-sutherland"))


@pytest.mark.parametrize(
    ("region", "message"),
    [
        ([0, 0, 0, 1], "the clip window must have an area: left below right, and bottom below top"),
        ([[0, 0], [0, 1], [1, 0]], "window must be convex and counter-clockwise"),
        ([[0, 0], [0.5, 0], [1, 0]], "window must have an area"),
        ([[0, 0], [1, 0]], "window must have at least three corners"),
        ([0, 0, np.inf, 1], "clip_region"),
    ],
)
def test_a_bad_clip_window_is_refused(region, message):
    with pytest.raises(ValueError, match=message):
        ClipScene(np.ones((1, 2, 4)), kind="segments", clip_region=region)
