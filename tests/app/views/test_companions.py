"""What stands beside a stage's own view: the space that corners enter, the texture, the new depths."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication, QLabel
from pytestqt.qtbot import QtBot

from app.session.document import open_document
from app.session.session import Session
from app.views.companions import COMPANIONS, entered_diagram, new_depths
from app.window.main_window import MainWindow
from core import Settings
from core.transform.traced import SPACES, spaces_reached
from lessons.lectures.scenes import LECTURE_SCENES
from lessons.scenes import make_scene
from widgets.inspector.step_table import StepTableView
from widgets.space.diagram import CUBE, Diagram
from widgets.space.view import SpaceView

pytestmark = pytest.mark.shared_window


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scene", "beside"),
    [("cube", {"transform", "cull", "depth"}), ("textured-floor", {"transform", "cull", "shade", "depth"})],
)
def test_a_stage_of_two_sides_shows_both(window: MainWindow, scene: str, beside: set[str]) -> None:
    session, area = window.session, window.page.main_area
    session.open(open_document(make_scene(scene), scene))
    shown = set()
    for stage in ("transform", "cull", "raster", "shade", "depth", "blend"):
        session.set_stage(stage, 40)
        if area.beside.isVisible():
            shown.add(stage)
            assert area.beside.currentWidget() is area.companions[stage].widget
    assert shown == beside
    session.set_stage("depth", 40)
    window.page.show_view("scene")
    assert not area.beside.isVisible(), "only beside the stage's own view"
    assert set(COMPANIONS) >= beside


def test_what_is_empty_leaves_the_room_to_the_scene(window: MainWindow) -> None:
    """Bones move vertices before any is divided by w; patches are cut first, which has a table of its own."""
    session, area = window.session, window.page.main_area
    session.open(open_document(make_scene("bent-bar"), "bent-bar"))
    session.set_stage("transform", 1)
    assert not area.beside.isVisible()
    session.open(open_document(make_scene("diced-ball"), "diced-ball"))
    session.set_stage("transform", 1)
    assert area.beside.isVisible()
    (table,) = (view.table() for view in area.beside.findChildren(StepTableView) if view.isVisible())
    assert table is not None
    assert table.title == "Where it is cut"
    assert any(cell is not None for cell in table.cells[0])
    session.set_stage("transform")
    assert area.beside.currentWidget() is area.companions["order"].widget
    assert area.beside.isVisible()


def test_both_depths_are_alike_and_lie_where_they_are_largest(window: MainWindow) -> None:
    area, page = window.page.main_area, window.page
    window.session.open(open_document(make_scene("cube"), "cube"))
    window.session.set_stage("depth", 40)
    new_depths = area.companions["depth"].grid
    for panes in (["run"], ["run", "scene"], ["run", "thumbnails"]):
        page.show_panes(["inspector", *panes])
        page.settle()
        main = page.grid.mapTo(area, page.grid.rect().topLeft())
        other = new_depths.mapTo(area, new_depths.rect().topLeft())
        assert (main.x() == other.x()) is ("scene" in panes), "below each other in a narrow area"
        # Of an odd height one has a pixel more.
        assert page.grid.placement().cell == pytest.approx(new_depths.placement().cell, rel=0.01), panes


def test_corners_enter_the_cube_as_they_are_divided(qapp: object) -> None:
    session = Session(open_document(make_scene("cube"), "cube"))
    session.set_stage("transform", 0)
    counts = []
    for position in np.linspace(0, session.stage_trace.steps.count, 8).astype(int).tolist():
        session.go_to(position)
        there = spaces_reached(session.trace, "transform", position) >= SPACES.index("NDC")
        diagram = entered_diagram(session.moment)
        outlines = [stroke for stroke in diagram.strokes if stroke.ink == "text"]
        assert len(outlines) == there.all(axis=1).sum()
        assert [word.text for word in diagram.words] == ([] if there.any() else ["empty so far"])
        counts.append(len(outlines))
    assert counts == sorted(counts)
    assert (counts[0], counts[-1]) == (0, 12)


def test_new_depths_are_those_that_the_triangle_has_compared_by_now(qapp: object) -> None:
    session = Session(open_document(make_scene("intersecting"), "intersecting"))
    stage = session.trace.stage("depth")
    row = len(stage.triangle) - 5
    buffer = new_depths(session.moment, stage, row)
    rows = np.flatnonzero(stage.triangle[: row + 1] == stage.triangle[row])
    column, line = stage.pixel[rows].T
    assert buffer.known is not None
    assert buffer.known.sum() == len(rows)
    assert np.array_equal(buffer.values[line, column], stage.columns["stored"][rows])


def test_both_sides_are_halves_whatever_is_written_in_them(window: MainWindow) -> None:
    session, area = window.session, window.page.main_area
    session.open(open_document(make_scene("cube"), "cube"))
    sizes = set()
    for stage in ("depth", "transform"):
        for position in (0, 40):
            session.set_stage(stage, position)
            QApplication.processEvents()
            assert abs(area.view_stack.width() - area.beside.width()) <= 1, stage
        sizes.add(area.beside.width())
    assert len(sizes) == 1


def test_predicting_hides_the_other_side_and_moves_nothing(window: MainWindow) -> None:
    session, area = window.session, window.page.main_area
    session.open(open_document(make_scene("cube"), "cube"))
    session.set_stage("depth", 40)
    QApplication.processEvents()
    before = area.grid.mapTo(window, area.grid.rect().topLeft()), area.grid.size()
    session.set_predicting(True)
    QApplication.processEvents()
    assert not area.companions["depth"].widget.isVisible()
    assert (area.grid.mapTo(window, area.grid.rect().topLeft()), area.grid.size()) == before


def test_the_cube_stays_where_it_is_when_its_caption_is_shorter(qapp: object) -> None:
    view = SpaceView()
    view.resize(200, 300)
    diagram = Diagram(frame=CUBE, caption="A caption of several words that fill several lines. " * 3)
    view.show_diagram(diagram)
    before = view.projection().project(CUBE)
    view.show_diagram(replace(diagram, caption="One line."))
    np.testing.assert_array_equal(view.projection().project(CUBE), before)


def test_a_clipper_fills_its_table_beside_the_pixels(window: MainWindow) -> None:
    scene = LECTURE_SCENES["LMU"][0]
    window.session.open(open_document(scene.make(), scene.title, settings=Settings(**scene.settings)))
    session, area = window.session, window.page.main_area
    view = area.companions["raster"].widget
    assert isinstance(view, StepTableView)
    filled = []
    for position in (0, 3, 9, session.trace.stage("raster").steps.count):
        session.set_stage("raster", position)
        assert area.beside.isVisible()
        table = view.table()
        assert table is not None
        filled.append(sum(cell is not None for row in table.cells for cell in row))
    assert filled[0] == 0
    assert filled == sorted(set(filled))
    view.cells.clicked.emit(view.cells.model().index(1, 0))
    assert session.explanation is not None
    assert session.explanation.values["border"] == "right"


def test_scan_lines_have_their_active_list_beside_them(window: MainWindow) -> None:
    session, area = window.session, window.page.main_area
    session.open(
        open_document(make_scene("intersecting"), "intersecting", settings=Settings(visibility="scan-line"))
    )
    session.set_stage("depth", 20)
    assert area.beside.isVisible()
    assert area.beside.currentWidget() is not area.companions["depth"].widget


def test_the_screen_stands_beside_the_buffer_that_is_drawn_into(qtbot: QtBot) -> None:
    session = Session(
        open_document(make_scene("two-buffers"), "Two buffers", settings=Settings(presentation="triple"))
    )
    beside = COMPANIONS["resolve"](session)
    qtbot.addWidget(beside.widget)
    session.set_stage("resolve")
    assert beside.is_wanted(session.moment)
    beside.refresh(session.moment)
    assert np.array_equal(beside.grid.buffer().values, session.moment.stage_trace.buffers[-1].at(10**6))
    assert "refresh 4, row 15 from the top" in beside.widget.findChildren(QLabel)[0].text()
    session.set_stage("resolve", 0)
    beside.refresh(session.moment)
    assert not beside.grid.buffer().known.any()
    plain = Session(open_document(make_scene("two-buffers"), "Two buffers"))
    plain.set_stage("resolve")
    assert not beside.is_wanted(plain.moment)
