"""The item of a step is marked in the view that is shown, and no view shows what comes later."""

from itertools import pairwise

import numpy as np
import pytest

from app.session.document import open_document
from app.window.main_window import MainWindow
from core import STAGES, Settings
from core.records.steps import Level
from core.transform.traced import WINDOW, is_dropped, spaces_reached
from lessons.scenes import make_scene
from tests.covering import in_turn
from widgets.space.diagram import Diagram
from widgets.space.scene_view import SceneView
from widgets.space.view import SpaceView

pytestmark = pytest.mark.shared_window

CASES = {
    "single-triangle": Settings(fill="bounding-box"),
    "near-plane": Settings(fill="hierarchy", clipping="sutherland-hodgman"),
    "textured-floor": Settings(fill="scanline", antialiasing="msaa-4"),
    "cube": Settings(fill="spans", cull="back"),
    "shared-edge": Settings(polygon_mode="wireframe"),
}


def open_scene(window: MainWindow, name: str, settings: Settings) -> None:
    window.session.open(open_document(make_scene(name), name, settings=settings))


def has_accent(diagram: Diagram) -> bool:
    inks = [shape.ink for shapes in (diagram.patches, diagram.strokes, diagram.spots) for shape in shapes]
    return "accent" in inks


def is_marked(window: MainWindow) -> bool:
    """Return whether the main view marks the step just done."""
    view = window.page.main_view()
    if isinstance(view, SceneView):
        picture = view.picture()
        return picture is not None and any(mark.ink == "accent" for mark in picture.marks)
    if isinstance(view, SpaceView):
        diagram = view.diagram()
        return diagram is not None and has_accent(diagram)
    step = window.page.grid.step()
    finite = [np.isfinite(shape).all(axis=tuple(range(1, shape.ndim))) for shape in (step.lines, step.points)]
    return bool(len(step.pixels) or any(found.any() for found in finite))


EVERY_DAY = ("near-plane",)


@pytest.mark.parametrize(
    "name", [name if name in EVERY_DAY else pytest.param(name, marks=pytest.mark.slow) for name in CASES]
)
def test_the_item_of_a_step_is_marked_in_the_view_that_shows_its_stage(window: MainWindow, name: str) -> None:
    session = window.session
    open_scene(window, name, CASES[name])
    unmarked = []
    for stage in STAGES:
        session.set_stage(stage, 0)
        window.page.settle()
        assert not is_marked(window)
        steps = session.stage_trace.steps
        kinds = [np.flatnonzero(steps.kind == kind) for kind in range(len(steps.kinds))]
        for rows in filter(len, kinds):
            places = rows[[0, len(rows) // 2, -1]].tolist()
            for row, level in in_turn(places, (Level.TRIANGLE, Level.PIXEL, Level.OPERATION)):
                session.set_level(level)
                session.go_to(steps.position_after(row))
                if not is_marked(window):
                    unmarked.append((stage, session.stage_trace.kind_of(row), level.name))
    assert unmarked == []


@pytest.mark.slow
def test_outlines_appear_as_corners_reach_the_window_and_vanish_as_triangles_are_dropped(
    window: MainWindow,
) -> None:
    session, grids = window.session, window.page.grids
    open_scene(window, "cube", Settings(cull="back"))
    for stage in ("transform", "cull", "edges"):
        session.set_stage(stage, 0)
        steps = session.stage_trace.steps
        shown = []
        for position in [*steps.boundaries(Level.TRIANGLE).tolist(), steps.count]:
            session.go_to(position)
            placed = (spaces_reached(session.trace, stage, position) == WINDOW).all(axis=1)
            left = placed & ~is_dropped(session.trace, stage, position)
            geometry = grids.geometry
            outlined = np.isfinite(geometry.vertices[geometry.triangles]).all(axis=(1, 2))
            outlined[geometry.focus] = left[geometry.focus]  # keeps its handles
            assert np.array_equal(outlined, left)
            shown.append(int(left.sum()))
        if stage == "transform":
            assert shown[0] == 0
            assert shown == sorted(shown)
        elif stage == "cull":
            assert shown == sorted(shown, reverse=True)
            assert shown[-1] == 6


def test_the_3d_view_drops_what_culling_drops_and_lights_what_is_shaded(window: MainWindow) -> None:
    session, page = window.session, window.page
    open_scene(window, "cube", Settings(cull="back"))
    drawn = []
    for stage, is_at_end in (("cull", False), ("cull", True), ("shade", False), ("shade", True)):
        session.set_stage(stage, None if is_at_end else 0)
        page.show_view("scene")
        page.settle()
        shown = page.views.scene_presenter.drawn
        numbers = shown.shot.numbers
        drawn.append((12 if numbers is None else len(numbers), shown.shot.is_lit))
    assert drawn == [(12, False), (6, False), (6, False), (6, True)]


def test_the_order_of_the_scan_is_marked_without_an_overlay(window: MainWindow) -> None:
    session, grid = window.session, window.page.grid
    session.set_stage("raster", 0)
    session.set_level(Level.PIXEL)
    visited: list[list[int]] = []
    for _ in range(20):
        session.step(1)
        visited += session.stage_trace.pixel[[len(visited)]].tolist()
        trail = grid.step().trail.tolist()
        assert trail == visited[-len(trail) :]
        assert len(trail) == min(len(visited), 8)
    assert all(before != after for before, after in pairwise(visited))


def test_an_edge_has_its_line_when_it_is_set_up(window: MainWindow) -> None:
    session, grid = window.session, window.page.grid
    session.set_stage("edges", 0)
    counts = []
    for position in session.stage_trace.steps.starts[:8].tolist():
        session.go_to(position)
        counts.append(
            sum(len(overlay.segments) for overlay in grid.overlays() if overlay.key == "edge lines")
        )
    assert counts == [0, 0, 0, 0, 0, 1, 2, 3]


@pytest.mark.parametrize("view", ["clip", "pyramid"])
def test_no_view_of_clip_space_shows_it_before_the_vertices_are_there(window: MainWindow, view: str) -> None:
    open_scene(window, "near-plane", Settings())
    session = window.session
    session.set_stage("transform", 0)
    window.page.show_view(view)
    space = window.page.main_view()
    assert space.diagram() is None
    session.go_to(session.stage_trace.steps.count)
    assert space.diagram() is not None
