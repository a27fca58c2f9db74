"""Overlays of line clipping: borders of the window, parts that are left, crosses where borders are crossed."""

import numpy as np
import pytest

from app.pages.step.grid_overlays import clip_overlays, cross_segments
from app.session.moment import Cursor, Step
from app.views.clip_diagram import clip_state, is_in_ndc
from core import ClipScene, Settings, trace
from core.records.steps import Level
from lessons.scenes import make_scene
from tests.core.strategies import clip_of_window

SIZE = (12, 9)
CORNERS = [(-3.5, 4.5), (7.5, -2.5), (16.5, 7.0)]
SCENE = ClipScene(clip_of_window([CORNERS], SIZE), size=SIZE)


def overlays(clipper: str, position: int | None = None, region=None):
    settings = Settings(polygon_mode="wireframe", line_clipping=clipper)
    traced = trace(SCENE, settings, region=region)
    stage = traced.stage("raster")
    place = stage.steps.count if position is None else position
    return stage, clip_overlays(Step(traced, Cursor("raster", place)))


def test_there_are_none_where_no_lines_are_clipped() -> None:
    assert overlays("none")[1] == []


def test_the_window_of_a_scene_is_shown_before_a_clipper_is_chosen() -> None:
    traced = trace(make_scene("clipped-segment"), Settings())
    (window,) = clip_overlays(Step(traced, Cursor("raster")))
    assert not window.extended
    assert sorted(map(tuple, window.segments[:, 0].tolist())) == [(4, 3), (4, 9), (12, 3), (12, 9)]


@pytest.mark.parametrize("clipper", ["cohen-sutherland", "liang-barsky", "cyrus-beck", "exact"])
def test_what_is_left_of_each_edge_is_shown_when_it_is_known(clipper: str) -> None:
    stage, (window, lines) = overlays(clipper)
    assert window.extended
    assert sorted(map(tuple, window.segments[:, 0].tolist())) == [(0, 0), (0, 9), (12, 0), (12, 9)]
    kept = stage.extra["outline_clip"]
    assert np.array_equal(lines.segments, kept.lines.segments[kept.lines.is_kept])
    assert set(lines.edges) <= {0, 1, 2}
    assert len(overlays(clipper, 0)[1][1].segments) == 0


@pytest.mark.parametrize("clipper", ["cohen-sutherland", "liang-barsky"])
def test_a_crossing_is_marked_while_its_edge_is_clipped(clipper: str) -> None:
    stage, _ = overlays(clipper)
    position = stage.steps.forward(0, Level.PIXEL)
    _, (_, lines) = overlays(clipper, position)
    point = lines.segments.mean(axis=(0, 1))
    assert len(lines.segments) == 2
    assert lines.edges == (-1, -1)
    assert point[0] == pytest.approx(0)


def test_a_region_moves_them() -> None:
    _, (whole, _) = overlays("liang-barsky")
    _, (part, _) = overlays("liang-barsky", region=(3, 2, 5, 4))
    assert np.array_equal(part.segments, whole.segments - np.array([3, 2]))


def test_crosses_lie_on_their_points() -> None:
    crosses = cross_segments(np.array([[2.0, 3.0], [5.0, 1.0]]))
    assert crosses.shape == (4, 2, 2)
    assert crosses.mean(axis=1).tolist() == [[2, 3], [2, 3], [5, 1], [5, 1]]


@pytest.mark.parametrize("clipping", ["after-divide", "project-first"])
def test_clip_space_shows_the_triangle_that_the_division_made(clipping: str) -> None:
    clip = np.array([[[-0.5, -0.5, 0.1, 1.0], [1.0, 1.5, 0.2, 2.0], [0.3, 0.2, 0.4, -0.5]]])
    traced = trace(ClipScene(clip, size=SIZE), Settings(clipping=clipping))
    stage = traced.stage("clip")
    for position in range(stage.steps.count + 1):
        state = clip_state(traced, 0, position)
        assert is_in_ndc(state)
        assert np.allclose(state.before[2, :3], clip[0, 2, :3] / -0.5)
    undefined = clip.copy()
    undefined[0, 2, 3] = 0
    traced = trace(ClipScene(undefined, size=SIZE), Settings(clipping=clipping))
    assert clip_state(traced, 0, 3).sentence.endswith("the triangle is dropped.")
