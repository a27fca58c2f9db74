"""Curves in a session: control points are typed, their points are not dragged, and a mesh keeps a triangle in focus."""

from pathlib import Path

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from app.files.state_files import State, load_state, save_state
from app.pages.step.grid_overlays import step_mark
from app.pages.step.scene_values import outline
from app.session.document import open_document, with_settings
from app.session.session import Session
from core import Settings
from core.scene import ClipScene
from core.stages.before_matrices import before_matrices
from lessons.scene_edits import move_corner, set_value
from lessons.scenes import make_scene


def test_control_points_are_listed_and_typed_and_the_curve_follows():
    scene = make_scene("curve")
    (group, _) = outline(scene, 3, scene.size)
    assert (group.title, [row.label for row in group.rows]) == (
        "Curve 0",
        [f"control point {k}" for k in range(4)],
    )
    moved = set_value(scene, "corner/0/1/y", 20.0, scene.size)
    assert isinstance(moved, ClipScene)
    before, after = (before_matrices(each, Settings()) for each in (scene, moved))
    # The first inner point has the share 3 (1/2)^3 of the middle.
    fall = (before.clip[3, 0, 1] - after.clip[3, 0, 1]) * 24
    assert fall == pytest.approx(20 * 3 / 8)


@pytest.mark.parametrize("name", ["curve", "hill"])
def test_a_point_of_a_curve_is_not_dragged(name):
    scene = make_scene(name)
    with pytest.raises(ValueError, match="a point of a curve or patch, which its control points make"):
        move_corner(scene, 0, 0, (3.0, 3.0), scene.size)


def test_other_segments_keep_a_triangle_in_focus(qtbot: QtBot):
    session = Session(open_document(make_scene("teapot"), "Teapot"))
    assert session.document.triangle is not None
    for segments, count in ((2, 240), (6, 2256)):
        session.set_setting("segments", segments)
        qtbot.waitUntil(lambda: session.document.settings.segments == segments)  # noqa: B023
        assert session.document.triangle_count == count
        assert 0 <= session.document.triangle < count
    coarse = with_settings(session.document, Settings(segments=1))
    assert 0 <= coarse.triangle < coarse.triangle_count < 64


def test_the_scheme_is_drawn_over_the_pixels():
    session = Session(open_document(make_scene("curve"), "Curve"))
    trace = session.trace.stage("transform")
    row = max(row for row in range(trace.steps.row_count) if trace.kind_of(row) == "mix")
    session.set_stage("transform", trace.steps.position_after(row))
    mark = step_mark(session.moment)
    assert np.allclose(mark.points, [[60, 6]])
    # Three sides of the control polygon, two of the next level, one of the last.
    assert len(mark.lines) == 6
    assert np.allclose(mark.lines[0], [[2, 4], [10, 40]])


def test_a_curve_is_saved_with_its_control_points(tmp_path: Path):
    scene = set_value(make_scene("curve-in-depth"), "corner/0/2/x", 30.0, (64, 48))
    document = open_document(scene, "Mine", settings=Settings(tessellation="bound"))
    save_state(tmp_path / "mine.rasterscope", State(document))
    opened, _ = load_state(tmp_path / "mine.rasterscope")
    assert (opened.document.scene.curves.control == scene.curves.control).all()
    assert opened.document.triangle_count == document.triangle_count
