"""What A | B keeps, and what it forgets: from stage to stage, from scene to scene, and when it is left."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.files.open_any import open_any
from app.session.document import Document, open_document
from app.window.main_window import MainWindow
from core import STAGES
from lessons.scene_edits import move_corner
from lessons.scenes import make_scene

pytestmark = pytest.mark.shared_window


def opened(name: str) -> Document:
    """Return a built-in scene or one of a lecture's."""
    return open_any(name).document


def moved(document: Document) -> Document:
    """Return a document with a corner half a pixel further to the right."""
    x, y = 10.5, 12.0
    return replace(document, scene=move_corner(document.scene, 0, 0, (x, y), document.traced_scene.size))


def compared(window: MainWindow, name: str, stage: str = "raster", **differences: str) -> MainWindow:
    """Show A | B of a scene at the start of a stage."""
    window.session.open(opened(name))
    window.session.set_stage(stage, 0)
    window.page.comparing.set_differences(differences)
    window.page.show_view("compare")
    return window


def test_b_is_forgotten_where_it_has_no_effect(window: MainWindow) -> None:
    comparing = compared(window, "shared-edge", fill="hierarchy").page.comparing
    window.session.open(opened("pellacini-line"))
    window.session.set_stage("raster", 0)
    assert dict(comparing.differences) == {}
    assert comparing.other.fill == window.session.document.settings.fill
    assert comparing.other.line != window.session.document.settings.line, "it follows the stage"


@pytest.mark.slow
def test_what_b_shows_stays_in_later_stages_where_it_differs(window: MainWindow) -> None:
    comparing = compared(window, "textured-floor", "interpolate").page.comparing
    assert comparing.other.interpolation == "affine"
    window.session.set_stage("resolve", 0)
    assert (comparing.other.interpolation, comparing.other.antialiasing) == ("affine", "none")


def test_a_clipping_that_only_follows_is_named_and_is_no_first_divergence(
    window: MainWindow, qtbot: QtBot
) -> None:
    compared(window, "textured-floor", "raster", interpolation="affine")
    assert (
        window.page.compare_view.titles[1]
        .text()
        .startswith("B: interpolation: Affine (screen-linear), clips the near plane")
    )
    with qtbot.waitSignal(window.session.changed):
        window.run_action("divergence")
    qtbot.waitUntil(lambda: window.session.cursor.stage == "interpolate")
    assert "A and B differ in the interpolated values." in window.statusBar().currentMessage()


def test_b_is_kept_where_it_has_an_effect(window: MainWindow) -> None:
    comparing = compared(window, "shared-edge", fill="hierarchy", interpolation="affine").page.comparing
    window.session.open(opened("cube"))
    assert dict(comparing.differences) == {"fill": "hierarchy", "interpolation": "affine"}
    window.session.open(replace(opened("cube"), settings=comparing.other))
    assert dict(comparing.differences) == {}, "A has them already"


@pytest.mark.slow
def test_undoing_an_opened_scene_forgets_what_has_no_effect_in_the_other(window: MainWindow) -> None:
    comparing = compared(window, "cube").page.comparing
    window.session.open(opened("pellacini-line"))
    comparing.set_differences({"line": "dda"})
    window.session.undo()
    assert dict(comparing.differences) == {}


@pytest.mark.slow
def test_b_stays_as_chosen_in_every_stage(window: MainWindow) -> None:
    comparing = compared(window, "shared-edge", fill="scanline-lecture").page.comparing
    for stage in STAGES:
        window.session.set_stage(stage, 0)
        assert dict(comparing.differences) == {"fill": "scanline-lecture"}
        assert comparing.other.fill == "scanline-lecture"
        assert window.page.compare_view.titles[1].text().startswith("B: fill: ")


def test_another_scene_is_shown_as_a_whole_in_all_pictures(window: MainWindow) -> None:
    view = compared(window, "shared-edge").page.compare_view
    for grid in (window.page.grid, view.grids[0]):
        grid.zoom_by(57.6)
    window.session.open(opened("cube"))
    assert {grid.view().zoom for grid in (window.page.grid, *view.grids)} == {1.0}
    view.grids[0].zoom_by(4.0)
    zoomed = view.grids[2].view()
    assert zoomed.zoom > 3.0
    window.session.set_setting("fill", "blocks")
    assert view.grids[2].view() == zoomed, "an edit leaves the zoom"


@pytest.mark.slow
def test_an_edit_leaves_a_printed_b(window: MainWindow) -> None:
    window.session.open(opened("pellacini-line"))
    comparing = window.page.comparing
    window.show_printed("pellacini-dda")
    scene = window.session.document.scene
    window.session.edit(moved(window.session.document))
    assert window.session.document.scene is not scene
    assert comparing.printed == "pellacini-dda"
    assert comparing.other.replacements
    assert "as printed" in window.page.compare_view.titles[1].text()
    window.session.open(opened("lmu-line"))
    assert comparing.printed == "", "A no longer runs the right method beside it"
    assert comparing.other.replacements == {}


@pytest.mark.slow
def test_a_mistake_in_the_scene_stays_beside_its_scene_only(window: MainWindow, qtbot: QtBot) -> None:
    document = opened("single-triangle")
    window.session.open(document)
    window.page.comparing.show_mistake({}, moved(document).scene, "with the mistake: one corner")
    window.page.show_view("compare")
    qtbot.waitUntil(lambda: not window.page.comparing.meeting.is_searching)
    window.page.comparing.meeting.go_to_divergence()
    window.page.comparing.meeting.meet_at((20, 20))
    assert not window.page.comparing.meeting.is_searching, "the latest wish holds"
    assert window.session.moment.pixel == (20, 20)
    titles = window.page.compare_view.titles
    assert titles[0].text().startswith("A: without the mistake")
    assert titles[1].text().startswith("B: with the mistake: one corner")
    window.session.set_setting("shading", "flat")
    assert titles[1].text().startswith("B: with the mistake: one corner")
    window.session.edit(moved(window.session.document))
    assert "mistake" not in titles[1].text()
    window.session.undo()
    assert titles[1].text().startswith("B: with the mistake: one corner")
    window.session.open(opened("cube"))
    window.session.undo()
    assert "mistake" not in titles[1].text()


def test_a_goal_ends_with_a_b_that_cannot_be_drawn(window: MainWindow) -> None:
    compared(window, "cube", depth="inverse-w")
    scene = make_scene("cube")
    flat = replace(scene, camera=replace(scene.camera, projection="orthographic"))
    window.session.open(open_document(flat, "Flat cube"))
    comparing, summary = window.page.comparing, window.page.compare_view.summary
    assert summary.text().startswith("B cannot be drawn")
    window.page.show_view("pixels")
    comparing.meeting.meet_at((20, 20))
    window.page.show_view("compare")
    assert summary.text().startswith("B cannot be drawn")
    cursor = window.session.cursor
    comparing.set_differences({"fill": "scanline"})
    assert "pixels differ" in summary.text()
    assert window.session.cursor == cursor


def test_a_b_of_too_many_steps_is_refused(window: MainWindow, qtbot: QtBot) -> None:
    document = opened("sphere")
    few = replace(document.settings, fill="spans")
    window.session.open(replace(document, settings=few, triangle=None))
    window.session.set_stage("cull", 0)
    window.page.comparing.set_differences({"fill": "brute-force"})
    window.page.show_view("compare")
    said = window.page.compare_view.summary
    qtbot.waitUntil(lambda: "B cannot be drawn: Testing every pixel for all 2,208" in said.text())


def test_leaving_ends_the_search_and_the_run_of_b(window: MainWindow) -> None:
    comparing = compared(window, "shared-edge", interpolation="affine").page.comparing
    before = window.session.cursor
    comparing.meeting.go_to_divergence()
    window.page.show_view("pixels")
    assert not comparing.meeting.is_searching
    window.session.set_setting("coverage", "float32")
    told: list[str] = []
    window.page.message_sent.connect(told.append)
    window.run_action("divergence")
    assert told == ["Show A | B first (Ctrl+D)."]
    assert not comparing.meeting.is_searching
    assert window.session.cursor == before
    comparing.meeting.meet_at((20, 20))
    window.page.show_view("compare")
    assert window.session.cursor != before, "what was asked for before it is shown holds"


@pytest.mark.slow
def test_each_stage_keeps_its_buffer(window: MainWindow) -> None:
    comparing = compared(window, "cube", "depth", visibility="last-drawn").page.comparing
    box = window.page.compare_view.buffer_box
    comparing.set_buffer("primitive")
    window.session.set_stage("raster")
    assert box.currentData() == "coverage"
    comparing.set_buffer("overdraw")
    window.session.set_stage("depth")
    assert box.currentData() == "primitive"
    window.session.set_stage("raster")
    assert box.currentData() == "overdraw"


def test_a_wheel_over_a_choice_of_buffers_changes_nothing(window: MainWindow) -> None:
    compared(window, "cube", "depth", visibility="last-drawn")
    for box in (window.page.compare_view.buffer_box, window.page.main_area.buffer_choice):
        shown, at = box.currentIndex(), QPointF(5, 5)
        turned = QWheelEvent(
            at,
            at,
            QPoint(),
            QPoint(0, -120),
            Qt.MouseButton.NoButton,
            Qt.KeyboardModifier.NoModifier,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(box, turned)
        assert box.currentIndex() == shown
        assert not turned.isAccepted()
