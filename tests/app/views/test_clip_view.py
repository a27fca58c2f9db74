from dataclasses import replace

import numpy as np
import pytest

from app.session.document import open_document
from app.session.session import Session
from app.views.clip_diagram import clip_diagram, clip_state, is_in_ndc
from core import ClipScene, Settings
from core.culling.culling import plane_distances
from lessons.scenes import make_scene

CLIPPED = Settings(clipping="sutherland-hodgman")
OVER_A_CORNER = np.array([[[-0.5, -0.5, 0.0, 1.0], [2.0, 0.2, 0.3, 1.0], [0.1, 1.5, -0.2, 1.0]]])


def session_of(scene, settings=CLIPPED) -> Session:
    session = Session(open_document(scene, "scene", settings=settings))
    session.set_stage("clip", 0)
    return session


@pytest.fixture(params=["crosser", "in front"])
def session(request, qapp) -> Session:
    scene = (
        make_scene("near-plane") if request.param == "crosser" else ClipScene(OVER_A_CORNER, size=(16, 12))
    )
    return session_of(scene)


def test_polygons_are_those_of_the_trace(session):
    trace = session.trace
    stage, clipped = trace.stage("clip"), trace.source.geometry.clipped
    ends = [np.flatnonzero(clipped.rows.plane == plane)[-1] for plane in clipped.planes]
    for level, row in enumerate(ends):
        state = clip_state(trace, 0, stage.steps.position_after(int(row)))
        wanted = clipped.polygons[level + 1][0, : clipped.counts[level + 1][0], :4]
        assert np.array_equal(state.polygon, wanted)
        assert state.plane == clipped.planes[level]
    assert np.array_equal(clip_state(trace, 0, None).polygon, wanted)
    assert np.array_equal(clip_state(trace, 0, 0).polygon, trace.source.geometry.kept.clip[0])


def test_between_planes_the_polygon_waits_and_corners_come_one_by_one(session):
    trace = session.trace
    stage, clipped = trace.stage("clip"), trace.source.geometry.clipped
    counts = []
    for row in range(stage.steps.row_count):
        state = clip_state(trace, 0, stage.steps.position_after(row))
        made = np.isfinite(clipped.rows.t[: row + 1])
        assert np.array_equal(state.emitted, clipped.rows.corner[: row + 1][made][:, :4])
        assert (state.corner is not None) == bool(np.isfinite(clipped.rows.t[row]))
        counts.append(len(state.emitted))
    assert counts == sorted(counts)
    assert counts[-1] > 0


def test_all_in_front_is_drawn_in_the_ndc_cube(qapp):
    state = clip_state(session_of(ClipScene(OVER_A_CORNER, size=(16, 12))).trace, 0, None)
    assert is_in_ndc(state)
    diagram = clip_diagram(state)
    drawn = [patch.points for patch in diagram.patches if patch.ink == "covered"]
    assert np.allclose(drawn[0], state.polygon[:, :3] / state.polygon[:, 3:] * [1, 1, -1])
    assert np.abs(drawn[0]).max() <= 1 + 1e-9
    assert "cube" in diagram.caption


@pytest.mark.parametrize("position", [3, 40])
def test_a_corner_behind_the_eye_is_drawn_in_clip_space(qapp, position):
    session = session_of(make_scene("near-plane"))
    state = clip_state(session.trace, 0, position)
    assert not is_in_ndc(state)
    diagram = clip_diagram(state)
    labels = [spot.label for spot in diagram.spots]
    assert any("w = −" in label for label in labels)
    # A corner on the plane that is highlighted lies on its face, seen in this slice.
    face = next(patch for patch in diagram.patches if patch.ink == "accent").points
    normal = np.cross(face[1] - face[0], face[2] - face[0])
    on_plane = np.abs(plane_distances(state.emitted)[:, state.plane]) < 1e-9
    squares = [spot.point for spot in diagram.spots if spot.shape == "square"][: len(state.emitted)]
    for point, is_on in zip(squares, on_plane, strict=True):
        if is_on:
            assert point @ normal == pytest.approx(0, abs=1e-12)


def test_no_clipping_culled_and_untouched_say_so(qapp):
    whole = session_of(make_scene("single-triangle"), Settings())
    assert "off" in clip_state(whole.trace, 0, None).sentence
    whole.set_setting("clipping", "sutherland-hodgman")
    assert "No plane crosses" in clip_state(whole.trace, 0, None).sentence
    outside = replace(make_scene("single-triangle"), clip=OVER_A_CORNER + np.array([5.0, 0, 0, 0]))
    culled = clip_state(session_of(outside).trace, 0, None)
    assert "culled (outside-plane)" in culled.sentence
    assert clip_diagram(culled).spots


def test_nothing_left_is_drawn_as_nothing(qapp):
    # Crosses the left and the bottom plane but passes the corner of the volume outside.
    corner = np.array([[[-3.0, -0.5, 0, 1], [-0.5, -3.0, 0, 1], [-3.0, -3.0, 0, 1]]])
    state = clip_state(session_of(ClipScene(corner, size=(8, 8))).trace, 0, None)
    assert len(state.polygon) == 0
    assert "nothing is left" in state.sentence
    assert not [patch for patch in clip_diagram(state).patches if patch.ink == "covered"]


def test_a_piece_of_a_tree_is_drawn_where_the_step_is_about_it(qapp: object) -> None:
    trace = session_of(make_scene("circle-of-bars"), Settings(visibility="bsp")).trace
    pieces, stage = trace.source.geometry.kept_pieces, trace.stage("clip")
    for row in range(stage.steps.row_count):
        state = clip_state(trace, int(stage.triangle[row]), stage.steps.position_after(row))
        assert np.array_equal(state.before, pieces.clip[stage.columns["kept"][row]])
    assert len({tuple(corner) for corner in pieces.clip[..., :2].reshape(-1, 2).tolist()}) > 9
