"""The grids of the page: the same arrays as the trace, overlays, ranges, and handles on the triangle in question."""

from dataclasses import replace

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from app.pages.step.grid_records import OUTLINE_LIMIT, buffers_of, mask_overlays
from app.session.document import open_document
from app.session.moment import Change
from app.window.main_window import MainWindow
from core import STAGES, ClipScene
from lessons.scenes import make_scene
from tests.covering import every_nth
from widgets.grid.layers import MaskOverlay

pytestmark = pytest.mark.shared_window


def test_tiles_show_the_arrays_of_the_trace(window: MainWindow) -> None:
    window.page.toggle_pane("thumbnails")
    for stage in every_nth(STAGES, 3):
        session = window.session
        session.set_stage(stage)
        session.go_to(session.stage_trace.steps.count // 2)
        state = session.stage_trace.state(session.cursor.position)
        if window.page.strip.isHidden():
            shown = {"": window.page.grid.buffer()}
            assert list(state) in ([], [shown[""].name])
            continue
        shown = {name: window.page.strip.tile(name).grid.buffer() for name in window.page.strip.names()}
        assert set(state) <= set(shown)
        for name, values in state.items():
            buffer = shown[name]
            known = np.ones(values.shape[:2], bool) if buffer.known is None else buffer.known
            assert np.array_equal(
                buffer.values[known], values[known].astype(buffer.values.dtype), equal_nan=True
            )


def test_a_title_brings_its_buffer_into_the_main_view(window: MainWindow) -> None:
    window.page.toggle_pane("thumbnails")
    window.page.strip.tile("edge 1").title.click()
    buffer = window.page.grid.buffer()
    assert buffer.name == "edge 1"
    window.session.set_stage("depth")
    window.session.set_stage("raster")
    assert window.page.grid.buffer().name == "edge 1"


def test_overlays_stack(window: MainWindow) -> None:
    window.page.toggle_pane("overlays")
    legend = window.page.legend
    for key in ("covered", "outside 0"):
        legend.box(key).click()
    assert {"covered", "outside 0"} <= {overlay.key for overlay in window.page.grid.overlays()}
    legend.box("covered").click()
    assert "covered" not in {overlay.key for overlay in window.page.grid.overlays()}


def test_the_axes_can_show_centres(window: MainWindow) -> None:
    window.page.toggle_pane("overlays")
    legend, grid = window.page.legend, window.page.grid
    assert grid.placement().ruler_text(3) == "3"
    legend.box("centres").click()
    assert grid.placement().ruler_text(3) == "3.5"
    # In every stage, while a step is predicted, and in the state that is saved.
    window.stepping.choose_stage(6)
    assert grid.placement().ruler_text(3) == "3.5"
    legend.box("centres").click()
    assert grid.placement().ruler_text(3) == "3"
    window.stepping.choose_stage(5)
    assert "centres" not in legend.shown_keys()


def test_masks_are_the_marks_of_the_rows_done(window: MainWindow) -> None:
    session = window.session
    trace, raster = session.stage_trace, session.trace.source.raster
    masks = {o.key: o for o in mask_overlays(session.moment) if isinstance(o, MaskOverlay)}
    done = trace.steps.rows_done(session.cursor.position)
    pixels = trace.pixel[:done][trace.marks["covered"][:done]]
    expected = np.zeros(raster.shape, bool)
    expected[pixels[:, 1], pixels[:, 0]] = True
    assert np.array_equal(masks["covered"].mask, expected)


def test_a_range_is_kept_until_it_is_reset(window: MainWindow) -> None:
    window.page.main_area.buffer_choice.buffer_chosen.emit("edge 0")
    window.page.ranges.range_changed.emit(-10.0, 10.0)
    assert window.page.grid.buffer().range == (-10.0, 10.0)
    window.session.step(1)
    assert window.page.grid.buffer().range == (-10.0, 10.0)
    window.page.ranges.range_reset.emit()
    assert window.page.grid.buffer().range != (-10.0, 10.0)


def test_handles_are_on_the_triangle_that_is_stepped(window: MainWindow) -> None:
    session, grids = window.session, window.page.grids
    session.go_to(4)
    assert grids.geometry.focus == 0
    session.go_to(session.stage_trace.steps.count)
    assert grids.geometry.focus == 1


def test_handles_go_to_the_triangle_that_is_clicked(window: MainWindow) -> None:
    session, grids = window.session, window.page.grids
    session.go_to(session.stage_trace.steps.count)
    rows, columns = np.nonzero(session.trace.source.picture.primitive == 0)
    window.page.grid.pixel_clicked.emit(int(columns[0]), int(rows[0]))
    assert grids.geometry.focus == 0


def test_edges_of_another_triangle_than_the_step_s_say_whose_they_are(window: MainWindow) -> None:
    session, grids = window.session, window.page.grids
    session.go_to(session.stage_trace.steps.count)
    assert "triangle 1" in window.page.column.sentence.text()
    assert grids.geometry.owner == ""
    rows, columns = np.nonzero(session.trace.source.picture.primitive == 0)
    window.page.grid.pixel_clicked.emit(int(columns[0]), int(rows[0]))
    assert grids.geometry.owner == "of triangle 0"
    session.step(-1)
    assert grids.geometry.owner == ""


def test_a_drag_leaves_the_handles_where_they_are(window: MainWindow) -> None:
    session, grids = window.session, window.page.grids
    session.go_to(session.stage_trace.steps.count)
    rows, columns = np.nonzero(session.trace.source.picture.primitive == 0)
    window.page.grid.pixel_clicked.emit(int(columns[0]), int(rows[0]))
    before = session.cursor
    window.page.grid.vertex_dragged.emit(0, 7.0, 30.0)
    assert session.cursor.position == session.stage_trace.steps.count != before.position
    assert grids.geometry.focus == 0


def test_an_edit_is_shown_once(window: MainWindow, qtbot: QtBot) -> None:
    session = window.session
    session.go_to(session.stage_trace.steps.count)
    with qtbot.waitSignal(session.changed, check_params_cb=lambda what: what == Change.DOCUMENT):
        window.page.grid.vertex_dragged.emit(0, 7.0, 30.0)
    count = session.stage_trace.steps.count
    assert session.cursor.position == count
    assert window.page.timeline.position_box.text() == str(count)


def test_a_region_of_a_large_picture_counts_its_own_pixels(window: MainWindow) -> None:
    window.session.open(open_document(make_scene("sphere"), "Sphere"))
    first_column, first_row, _, _ = window.session.trace.source.raster.bounds
    window.page.grid.pixel_clicked.emit(2, 3)
    assert window.session.pin == (first_column + 2, first_row + 3)
    for buffer in buffers_of(window.session.moment):
        assert buffer.origin == (first_column, first_row)


def test_only_a_history_in_sight_is_told(window: MainWindow) -> None:
    page = window.page
    page.column.setCurrentWidget(page.column.step)
    before = page.history.verdict.text()
    window.session.set_hover((20, 20))
    assert page.history.verdict.text() == before
    page.column.setCurrentWidget(page.history)
    assert page.history.verdict.text() != before


@pytest.mark.parametrize("triangle", [None, 1500])
def test_of_many_triangles_only_the_one_in_focus_is_outlined(
    window: MainWindow, triangle: int | None
) -> None:
    document = open_document(make_scene("torus"), "Torus")
    assert document.triangle_count > OUTLINE_LIMIT
    window.session.open(replace(document, triangle=triangle))
    geometry = window.page.grids.geometry
    assert len(geometry.triangles) == 1
    wanted = 0 if triangle is None else triangle
    assembled = window.session.trace.source.geometry
    corner = assembled.vertices.corners[wanted, 0]
    origin = window.session.trace.source.raster.bounds[:2]
    assert np.array_equal(geometry.vertices[0], assembled.vertices.window[corner, :2] - origin)


@pytest.mark.slow
def test_a_corner_of_one_of_many_triangles_is_dragged(window: MainWindow, qtbot: QtBot) -> None:
    clip = np.tile([[-0.5, -0.5, 0.0, 1.0], [0.5, -0.5, 0.0, 1.0], [0.0, 0.5, 0.0, 1.0]], (500, 1, 1))
    scene = ClipScene(clip, size=(16, 16))
    window.session.open(replace(open_document(scene, "Many"), triangle=450))
    window.page.grid.vertex_dragged.emit(1, 14.0, 4.0)
    qtbot.waitUntil(lambda: window.session.document.scene is not scene, timeout=20000)
    moved = window.session.document.scene
    assert np.argwhere((moved.clip != scene.clip).any(axis=2)).tolist() == [[450, 1]]
