"""The session: edits, stepping, jumps and pins, with signals only when something changed."""

from dataclasses import replace

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from app.session.document import TeachingRaster, fit_region, focus_on, open_document
from app.session.session import Session
from core import STAGES
from core.records.steps import Level
from lessons.scene_edits import move_corner
from lessons.scenes import make_scene


@pytest.fixture
def session(qapp: object) -> Session:
    return Session(open_document(make_scene("shared-edge"), "Shared edge"))


def test_forward_and_back_undo_each_other_on_all_levels(session: Session) -> None:
    for stage in STAGES:
        session.set_stage(stage, 0)
        for level in Level:
            session.set_level(level)
            for _ in range(3):
                before = session.cursor
                session.step(1)
                if session.cursor != before:
                    after = session.cursor
                    session.step(-1)
                    assert session.cursor == before
                    session.step(1)
                    assert session.cursor == after
            session.go_to(0)


def test_the_neighbouring_stage_is_entered_at_its_start_and_left_by_going_back(session: Session) -> None:
    session.set_stage(STAGES[2], 1)
    for direction in (1, -1):
        before = session.cursor
        session.next_stage(direction)
        assert session.cursor.stage == STAGES[2 + direction]
        assert session.cursor.position == 0
        session.go_back()
        assert session.cursor == before


def test_a_scene_is_asked_about_as_long_as_anybody_asks(session: Session) -> None:
    session.set_asked("one", is_open=True)
    session.set_asked("other", is_open=False, by="lesson")
    assert session.is_asked_about
    assert (session.asker, session.asked_scenes) == ("exercise", {"one", "other"})
    session.set_asked("", is_open=False)
    assert not session.is_asked_about


def test_a_pin_appears_in_the_middle_whatever_way_it_is_nudged(session: Session) -> None:
    for way in ((1, 0), (0, -1), (0, 1)):
        session.set_pin(None)
        session.nudge_pin(*way)
        assert session.pin == (32, 24)


def test_equal_values_emit_nothing(session: Session, qtbot: QtBot) -> None:
    session.set_pin((3, 4))
    with qtbot.assertNotEmitted(session.changed):
        session.set_pin((3, 4))
        session.edit(session.document)
        session.set_setting("fill", session.document.settings.fill)
        session.set_level(session.cursor.level)


def test_edit_undo_redo_give_the_same_picture(session: Session) -> None:
    before = session.trace.source.picture.color
    document = session.document
    session.edit(replace(document, scene=move_corner(document.scene, 0, 0, (5.0, 30.0), (64, 48))))
    after = session.trace.source.picture.color
    assert not np.array_equal(before, after)
    session.undo()
    assert np.array_equal(session.trace.source.picture.color, before)
    session.redo()
    assert np.array_equal(session.trace.source.picture.color, after)


def test_shared_corners_move_together(session: Session) -> None:
    scene = session.document.scene
    assert scene.shared is not None
    names = scene.shared
    shared = next(name for name in np.unique(names) if (names == name).sum() == 2)
    triangle, corner = (int(n) for n in np.argwhere(names == shared)[0])
    moved = move_corner(scene, triangle, corner, (20.25, 20.5), (64, 48))
    at = moved.clip[names == shared]
    assert np.array_equal(at[0], at[1])
    assert np.array_equal(moved.clip[names != shared], scene.clip[names != shared])


def test_a_refused_setting_changes_nothing(session: Session) -> None:
    document = session.document
    with pytest.raises(ValueError, match="fill must be one of"):
        session.set_setting("fill", "magic")
    assert session.document is document


def test_jumps_are_undone_exactly(session: Session) -> None:
    session.set_stage("raster", 0)
    session.set_level(Level.OPERATION)
    for _ in range(5):
        session.step(1)
    here = session.cursor
    session.set_stage("depth")
    session.go_back()
    assert session.cursor == here
    session.go_forward()
    assert session.cursor.stage == "depth"


def test_the_pin_stays_in_the_raster(session: Session) -> None:
    session.set_pin((63, 47))
    session.nudge_pin(1, 0)
    assert session.pin == (63, 47)
    session.nudge_pin(-1, -1)
    assert session.pin == (62, 46)
    session.set_pin((64, 0))
    assert session.pin == (62, 46)


def test_a_large_mesh_opens_at_one_triangle_that_is_seen(qapp: object) -> None:
    document = open_document(make_scene("torus"), "Torus")
    assert document.triangle is not None
    picture = document.make_trace().source.picture
    assert (picture.primitive == document.triangle).any()


def test_the_region_fits_the_triangle(qapp: object) -> None:
    document = fit_region(focus_on(open_document(make_scene("cube"), "Cube"), 0))
    assert document.raster.columns <= 96
    assert document.raster.rows <= 72


def test_the_teaching_raster_has_limits() -> None:
    with pytest.raises(ValueError, match="1x1 to 96x72 pixels, got 97x10"):
        TeachingRaster(97, 10)
