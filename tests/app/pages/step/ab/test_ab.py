"""A | B | difference: linked grids, what B does otherwise, and what cannot be drawn."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.files.open_any import open_any
from app.pages.step.ab.pictures import compare
from app.pages.step.ab.side_b import first_difference, right_ones, settings_difference
from app.session.document import open_document
from app.window.main_window import MainWindow
from core import STAGES, Settings
from core.study.divergence import diverge, is_same_schedule, stage_divergence
from lessons.scenes import make_scene
from tests.covering import every_nth
from widgets.grid.compare_view import Side
from widgets.grid.geometry import GridGeometry
from widgets.grid.layers import GridBuffer

pytestmark = pytest.mark.shared_window


def row_of_b(window: MainWindow) -> int:
    """Return the row that B has just done."""
    second = window.page.comparing.second
    return second.row


def test_the_difference_in_words() -> None:
    assert settings_difference(Settings(), Settings(block_size=4)) == "block size: 4"
    assert settings_difference(Settings(), Settings()) == ""


def test_numbers_among_the_settings_are_no_methods_to_compare_with() -> None:
    settings = Settings(curve_tolerance=64, segments=3, block_size=4, line="bresenham-lecture")
    found = {stage: list(right_ones(settings, stage)) for stage in STAGES}
    assert ("line", "bresenham") in found.pop("raster")
    assert not any(found.values())


@pytest.mark.parametrize(
    ("name", "family"), [("curve", "tessellation"), ("diced-ball", "tessellation"), ("bent-bar", "skinning")]
)
def test_b_differs_in_what_a_scene_is_about(name: str, family: str) -> None:
    document = open_document(make_scene(name), name)
    assert family in first_difference(document, document.make_trace(), "transform", {})


def test_a_pixel_found_outside_differs_from_none_not_reached() -> None:
    covered = np.array([[True, False, False]])
    a = GridBuffer("coverage", covered, "bool", known=np.array([[True, True, False]]))
    b = GridBuffer("coverage", covered, "bool", known=np.array([[True, False, False]]))
    sides = [Side(name, name, buffer=buffer) for name, buffer in (("A", a), ("B", b))]
    assert compare(*sides)[2].sentence == "0 of 3 pixels differ."


def test_no_outline_hides_a_pixel_that_differs() -> None:
    corners, triangles = np.array([[0.0, 0.0], [3.0, 0.0], [0.0, 1.0]]), np.array([[0, 1, 2]])
    buffer, geometry = GridBuffer("coverage", np.ones((1, 3), bool), "bool"), GridGeometry(corners, triangles)
    sides = [Side(name, name, buffer=buffer, geometry=geometry) for name in ("A", "B")]
    assert [side.geometry for side in compare(*sides)] == [geometry, geometry, None]


@pytest.mark.parametrize("name", every_nth(["textured-floor", "single-triangle", "cube"], 3))
def test_b_differs_in_the_stage_that_is_shown_and_draws(window: MainWindow, name: str) -> None:
    scene = make_scene(name)
    window.session.open(open_document(scene, name))
    window.page.show_view("compare")
    for stage in STAGES[STAGES.index("edges") :]:
        window.session.set_stage(stage, 0)
        comparing, view = window.page.comparing, window.page.compare_view
        assert view.grids[1].buffer() is not None
        mine = window.session.stage_trace
        theirs = window.session.document.make_trace(comparing.other).stage(stage)
        assert theirs.steps.row_count
        if stage != "blend":
            assert not is_same_schedule(mine, theirs) or stage_divergence(mine, theirs) is not None
        assert view.family_box.currentText().startswith("\u2022 ")


@pytest.mark.parametrize(
    ("name", "expected"), [("intersecting", {"visibility": "last-drawn"}), ("z-fighting", {"depth": "z-16"})]
)
def test_b_hides_other_pixels_where_any_method_of_the_depth_stage_does(
    name: str, expected: dict[str, str]
) -> None:
    document = open_document(make_scene(name), name)
    assert first_difference(document, document.make_trace(document.settings), "depth", {}) == expected


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("segment", {"line": "midpoint"}),
        ("pellacini-rectangle", {"line": "bresenham"}),
        ("lmu-line", {"line": "bresenham"}),
        ("jubair-parallel", {"line_clipping": "cyrus-beck"}),
        ("lmu-clipped", {"line_clipping": "cohen-sutherland"}),
    ],
)
def test_b_stands_against_the_method_that_a_scene_of_lines_is_about(
    name: str, expected: dict[str, str]
) -> None:
    document = open_any(name).document
    assert first_difference(document, document.make_trace(document.settings), "raster", {}) == expected


@pytest.mark.parametrize(
    ("name", "stage", "chosen", "expected"),
    [
        ("four-layers", "shade", {}, {"depth_test_time": "late"}),
        ("four-layers", "shade", {"depth_test_time": "prepass"}, {"depth_test_time": "early"}),
        ("box-in-light", "shade", {}, {"shadow": "rays"}),
        ("mirror-cube", "shade", {}, {"environment": "rays"}),
        ("two-buffers", "resolve", {}, {"presentation": "double"}),
        ("circle-of-bars", "depth", {}, {"visibility": "bsp"}),
        ("bar-and-wire", "resolve", {}, {"history": "clamped"}),
        ("intersecting", "depth", {"visibility": "scan-line"}, {"visibility": "z-buffer"}),
    ],
)
def test_b_is_what_the_lectures_compare_a_method_with(
    name: str, stage: str, chosen: dict[str, str], expected: dict[str, str]
) -> None:
    document = open_any(name).document
    document = replace(document, settings=replace(document.settings, **chosen))
    assert first_difference(document, document.make_trace(), stage, {}) == expected


def test_what_the_screen_shows_is_compared_first(window: MainWindow) -> None:
    window.session.open(
        open_document(make_scene("two-buffers"), "Bar", settings=Settings(presentation="triple"))
    )
    window.session.set_stage("resolve")
    window.page.show_view("compare")
    assert window.page.compare_view.buffer_box.currentData() == "screen"


@pytest.mark.slow
def test_two_depth_formats_are_compared_in_what_both_hold(window: MainWindow) -> None:
    window.session.open(open_document(make_scene("z-fighting"), "Plates"))
    window.session.set_stage("depth")
    window.page.show_view("compare")
    assert window.page.comparing.other.depth == "z-16"
    shown = window.page.compare_view.grids[2].buffer()
    assert shown.values.any()


@pytest.mark.slow
def test_both_stand_at_the_same_pixel_and_steps_are_undone(window: MainWindow) -> None:
    session, comparing = window.session, window.page.comparing
    session.open(open_document(make_scene("shared-edge"), "Two"))
    session.set_stage("raster", 0)
    comparing.set_differences({"fill": "hierarchy"})
    window.page.show_view("compare")
    theirs = session.document.make_trace(comparing.other).stage("raster")
    row = int(session.stage_trace.rows_at_pixel(36, 10)[0])
    session.go_to(session.stage_trace.steps.position_after(row))
    went = []
    for _ in range(12):
        pixel, second = session.moment.pixel, comparing.second
        assert pixel is not None
        assert second.pixel == pixel or not len(theirs.rows_at_pixel(*pixel))
        went.append((session.cursor, second.cursor))
        window.run_action("step_forward")
    while went:
        window.run_action("step_back")
        second = comparing.second
        assert (session.cursor, second.cursor) == went.pop()


def test_b_goes_on_alone_where_a_has_no_step(window: MainWindow) -> None:
    session, comparing, view = window.session, window.page.comparing, window.page.compare_view
    session.open(open_document(make_scene("single-triangle"), "One"))
    session.set_stage("raster", 0)
    comparing.set_differences({"fill": "scanline"})
    window.page.show_view("compare")
    window.run_action("step_forward")
    second = comparing.second
    assert (session.cursor.position, second.row) == (0, 0), "the edges of the scanline"
    assert "waits for B, step 0 of" in view.titles[0].text()
    outside = np.flatnonzero(session.stage_trace.marks["rejected"])[0]
    session.go_to(session.stage_trace.steps.position_after(outside))
    assert "waits for A, step" in view.titles[1].text()
    session.go_to(session.stage_trace.steps.count)
    second = comparing.second
    assert second.is_stage_done


def test_a_key_flips_both_pictures_while_it_is_held(window: MainWindow) -> None:
    window.page.show_view("compare")
    view = window.page.compare_view
    first, second = (grid.buffer() for grid in view.grids[:2])
    QTest.keyPress(window, Qt.Key.Key_X)
    assert [grid.buffer() for grid in view.grids[:2]] == [second, first]
    assert view.titles[0].text().startswith("B: ")
    QTest.keyRelease(window, Qt.Key.Key_X)
    assert [grid.buffer() for grid in view.grids[:2]] == [first, second]


@pytest.mark.slow
def test_the_first_divergence_is_reached_in_both(window: MainWindow, qtbot: QtBot) -> None:
    window.session.open(open_document(make_scene("single-triangle"), "One"))
    window.page.comparing.set_differences({"interpolation": "affine"})
    window.page.show_view("compare")
    with qtbot.waitSignal(window.page.message_sent, timeout=20000) as sent:
        window.run_action("divergence")
    session, comparing = window.session, window.page.comparing
    other = session.document.make_trace(comparing.other)
    found = diverge(session.trace, other, by_outcome=True)
    assert session.cursor.stage == found.stage == "interpolate"
    rows = [session.stage_trace.steps.row_at(session.cursor.position)[0]]
    rows.append(row_of_b(window))
    assert tuple(rows) == found.rows
    assert sent.args[0].startswith("First divergence, at pixel")
    for action in ("step_forward", "step_back"):
        window.run_action(action)
    assert session.stage_trace.steps.row_at(session.cursor.position)[0] == found.rows[0]
    assert row_of_b(window) == found.rows[1]


def test_each_side_has_its_own_pixel_centres(window: MainWindow) -> None:
    window.page.comparing.set_differences({"pixel_center": "integer"})
    window.page.show_view("compare")
    places = [grid.placement() for grid in window.page.compare_view.grids]
    centres = [place.to_window(place.cells_rect(2, 1).center()) for place in places]
    np.testing.assert_allclose(centres, [(2.5, 1.5), (2, 1), (2.5, 1.5)], atol=1e-9)


def test_the_pictures_are_exported_without_the_choices(window: MainWindow, tmp_path: Path) -> None:
    window.page.show_view("compare")
    window.exports.export_to(str(tmp_path / "both.svg"))
    drawing = (tmp_path / "both.svg").read_text()
    for text in ("A: fill: Bounding box", "B: fill: Scanline", "Difference, coverage", "pixels differ"):
        assert text in drawing
    for text in ("B = A", "Swap"):
        assert text not in drawing


def test_b_may_differ_in_several_families(window: MainWindow) -> None:
    comparing, view = window.page.comparing, window.page.compare_view
    window.page.show_view("compare")
    view.setting_chosen.emit("fill", "scanline-lecture")
    view.setting_chosen.emit("depth", "z-16")
    window.session.set_setting("interpolation", "affine")
    mine = window.session.document.settings
    assert comparing.other == replace(mine, fill="scanline-lecture", depth="z-16")
    assert "fill: Scanline" in view.titles[1].text()
    assert "depth: " in view.titles[1].text()
    view.setting_chosen.emit("interpolation", "perspective")
    assert comparing.other.interpolation == "perspective"
    view.reset_requested.emit()
    assert comparing.other == window.session.document.settings
    assert "0 of" in view.summary.text()


def test_depths_of_other_formats_are_not_subtracted(window: MainWindow) -> None:
    window.session.open(open_document(make_scene("cube"), "Cube"))
    window.session.set_stage("depth", 300)
    window.page.show_view("compare")
    view, comparing = window.page.compare_view, window.page.comparing
    assert comparing.other.visibility == "last-drawn"
    assert view.grids[2].buffer() is not None
    comparing.set_differences({"depth": "z-16"})
    comparing.set_buffer("depth")
    assert view.grids[2].buffer() is None
    assert "holds other numbers in A and in B" in view.summary.text()
    comparing.set_buffer("passes")
    assert view.grids[2].buffer() is not None


def test_swapping_and_using_b_are_edits(window: MainWindow) -> None:
    window.page.show_view("compare")
    view, comparing = window.page.compare_view, window.page.comparing
    view.setting_chosen.emit("fill", "scanline")
    mine, other = window.session.document.settings, comparing.other
    view.swap_requested.emit()
    assert (window.session.document.settings, comparing.other) == (other, mine)
    window.session.undo()
    assert window.session.document.settings == mine
    view.setting_chosen.emit("fill", "scanline")
    view.use_requested.emit()
    assert window.session.document.settings == comparing.other == other
    assert "The page now uses B" in window.statusBar().currentMessage()


def test_prediction_hides_both_pictures(window: MainWindow) -> None:
    window.run_action("predict")
    window.page.show_view("compare")
    assert [grid.buffer() for grid in window.page.compare_view.grids] == [None] * 3
    assert "Hidden until" in window.page.compare_view.summary.text()
    window.run_action("predict")
    window.page.show_view("compare")
    assert "pixels differ" in window.page.compare_view.summary.text()


def test_pin_and_hover_are_linked(window: MainWindow) -> None:
    window.page.show_view("compare")
    window.page.compare_view.linked.pixel_clicked.emit(10, 11)
    assert window.session.pin == (10, 11)
    assert [grid.pin() for grid in window.page.compare_view.grids] == [(10, 11)] * 3


def test_what_b_cannot_draw_is_told_in_its_place(window: MainWindow) -> None:
    scene = make_scene("cube")
    window.page.show_view("compare")
    window.page.compare_view.setting_chosen.emit("depth", "inverse-w")
    flat = replace(scene, camera=replace(scene.camera, projection="orthographic"))
    window.session.open(open_document(flat, "Flat cube"))
    assert window.page.compare_view.summary.text().startswith(
        "B cannot be drawn: depth inverse-w needs a perspective"
    )
    first, second, difference = window.page.compare_view.grids
    assert first.buffer() is not None
    assert second.buffer() is difference.buffer() is None
    assert second.empty_text.startswith("B cannot be drawn")


def test_a_slow_b_is_drawn_in_the_background(window: MainWindow, qtbot: QtBot) -> None:
    window.session.open(open_document(make_scene("sphere"), "Sphere"))
    window.page.show_view("compare")
    window.page.compare_view.setting_chosen.emit("fill", "brute-force")
    assert "Drawing B …" in window.page.compare_view.summary.text()
    qtbot.waitUntil(lambda: "pixels differ" in window.page.compare_view.summary.text(), timeout=20000)


@pytest.mark.slow
def test_a_vertex_is_dragged_in_either_picture(window: MainWindow) -> None:
    session = window.session
    session.open(replace(session.document, triangle=0))
    window.page.show_view("compare")
    document = session.document
    for grid in window.page.compare_view.grids[:2]:
        start = grid.placement().to_widget(*window.page.grids.geometry.vertices[0]).toPoint()
        QTest.mousePress(grid, Qt.MouseButton.LeftButton, pos=start)
        for step in range(1, 6):
            QTest.mouseMove(grid, start + QPoint(3 * step, 2 * step))
        assert session.document is not document
        assert "pixels differ" in window.page.compare_view.summary.text()
        QTest.mouseRelease(grid, Qt.MouseButton.LeftButton, pos=start + QPoint(15, 10))
        session.undo()
        assert session.document is document
    QTest.mousePress(grid, Qt.MouseButton.LeftButton, pos=start)
    QTest.mouseMove(grid, start + QPoint(15, 10))
    assert session.document is not document
    QTest.keyClick(grid, Qt.Key.Key_Escape)
    assert session.document is document


def test_several_choices_are_shown_once(window: MainWindow, monkeypatch: pytest.MonkeyPatch) -> None:
    page = window.page
    shown: list[int] = []
    show = page.compare_view.show_sides

    def count(*sides: Side) -> None:
        shown.append(1)
        show(*sides)

    monkeypatch.setattr(page.compare_view, "show_sides", count)
    with page.comparing.held():
        window.session.set_stage("raster", 5)
        page.comparing.set_differences({"fill": "brute-force"})
        page.show_view("compare")
        page.comparing.set_differences({"fill_rule": "inclusive"})
    assert len(shown) == 1
    assert dict(page.comparing.differences) == {"fill_rule": "inclusive"}
    assert page.comparing.second is not None
    page.show_view("pixels")
