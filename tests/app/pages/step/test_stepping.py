"""The stepping presenter: runs to events, pins, breakpoints, lines and bookmarks; what the timeline shows."""

from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from pytestqt.qtbot import QtBot

from app.files.open_any import open_any
from app.pages.step.grid_records import buffers_of
from app.pages.step.stepping_presenter import EVENT_TITLES
from app.session.document import open_document
from app.window.main_window import MainWindow
from core import STAGES, ClipScene
from core.records.steps import Level
from core.stages.declared import stage_of
from lessons.scenes import make_scene
from widgets.basics.drawing import Mark

pytestmark = pytest.mark.shared_window


@pytest.mark.parametrize("event", ["covered", "rejected"])
def test_runs_to_events_and_back(window: MainWindow, event: str) -> None:
    session, stepping = window.session, window.page.stepping
    stepping.event_kind = event
    session.go_to(0)
    trace = session.stage_trace
    found = []
    for _ in range(3):
        stepping.run_to_event(1)
        row, _ = trace.steps.row_at(session.cursor.position)
        assert trace.marks[event][row]
        found.append(session.cursor.position)
    assert found == sorted(set(found))
    stepping.run_to_event(-1)
    assert session.cursor.position == found[1]


def test_the_buttons_beside_the_choice_run_too(window: MainWindow) -> None:
    window.session.go_to(0)
    window.page.events.next_button.click()
    after = window.session.cursor.position
    assert after > 0
    window.page.events.next_button.click()
    window.page.events.previous_button.click()
    assert window.session.cursor.position == after


def test_an_event_that_does_not_come_is_told(window: MainWindow) -> None:
    position = window.session.cursor.position
    window.page.stepping.event_kind = "nan"
    window.page.stepping.run_to_event(1)
    assert window.session.cursor.position == position
    assert window.statusBar().currentMessage().startswith("No further step")


def test_a_hint_goes_when_it_is_true_no_longer(window: MainWindow) -> None:
    bar = window.statusBar()
    window.session.set_pin((0, 0))
    window.page.stepping.run_to_pin(1)
    window.session.go_to(window.session.stage_trace.steps.count)
    window.page.stepping.run_to_pin(1)
    assert bar.currentMessage() == "No further step at pixel (0, 0) in this stage."
    window.session.set_pin((1, 0))
    assert bar.currentMessage() == ""
    window.page.stepping.run_to_pin(1)
    assert "(1, 0)" in bar.currentMessage()
    window.notices.tell("Saved.")
    window.session.go_to(0)
    assert bar.currentMessage() == "Saved.", "another message stays"


def test_every_event_can_be_chosen(window: MainWindow) -> None:
    box = window.page.events.box
    assert [box.itemData(k) for k in range(box.count())] == list(EVENT_TITLES)
    box.setCurrentIndex(2)
    box.activated.emit(2)
    assert window.page.stepping.event_kind == box.itemData(2)


def test_runs_to_the_pinned_pixel(window: MainWindow) -> None:
    session = window.session
    session.go_to(0)
    window.run_action("next_at_pin")
    assert "Pin a pixel first" in window.statusBar().currentMessage()
    session.set_pin((30, 20))
    window.run_action("next_at_pin")
    row, _ = session.stage_trace.steps.row_at(session.cursor.position)
    assert session.stage_trace.pixel[row].tolist() == [30, 20]


def test_breakpoints_of_pixels_and_lines(window: MainWindow) -> None:
    session, stepping = window.session, window.page.stepping
    session.set_pin((30, 20))
    stepping.toggle_pixel_breakpoint()
    session.go_to(0)
    stepping.run_to_breakpoint(1)
    first = session.cursor.position
    row, _ = session.stage_trace.steps.row_at(first)
    assert session.stage_trace.pixel[row].tolist() == [30, 20]
    stepping.toggle_pixel_breakpoint()
    explanation = session.explanation
    stepping.toggle_line_breakpoint(explanation.listing.function.__name__, explanation.line)
    session.go_to(0)
    stepping.run_to_breakpoint(1)
    reached = session.explanation
    assert reached.line == explanation.line
    assert session.cursor.position < first


def test_without_a_breakpoint_the_run_goes_to_the_end(window: MainWindow) -> None:
    window.run_action("run_forward")
    assert window.session.cursor.position == window.session.stage_trace.steps.count
    window.run_action("run_back")
    assert window.session.cursor.position == 0


def test_bookmarks(window: MainWindow) -> None:
    session, stepping = window.session, window.page.stepping
    here = session.cursor
    stepping.bookmarks.toggle()
    assert Mark.BOOKMARK in window.page.timeline.bar.run().marks
    session.set_stage("depth")
    stepping.bookmarks.go_to(0)
    assert session.cursor == here
    stepping.bookmarks.toggle()
    stepping.bookmarks.go_to(0)
    assert "not set" in window.statusBar().currentMessage()


def test_dragging_over_the_chapters_goes_through_the_whole_run(window: MainWindow, qtbot: QtBot) -> None:
    session, row = window.session, window.page.timeline.chapters
    session.set_stage(STAGES[-1])
    for index, stage in enumerate(STAGES):
        qtbot.mouseClick(row.buttons()[index], Qt.MouseButton.LeftButton)
        assert (session.cursor.stage, session.cursor.position) == (stage, 0)
    first, last = row.buttons()[0], row.buttons()[-1]
    start = QPoint(2, 10)
    qtbot.mousePress(first, Qt.MouseButton.LeftButton, pos=start)
    visited = []
    for x in range(20, row.width(), 40):
        qtbot.mouseMove(first, QPoint(x, 10))
        visited.append((STAGES.index(session.cursor.stage), session.cursor.position))
    qtbot.mouseMove(first, QPoint(row.width() + 50, 10))
    assert session.cursor.position == session.stage_trace.steps.count > 0
    qtbot.mouseRelease(first, Qt.MouseButton.LeftButton, pos=start)
    assert session.cursor.stage == last.chapter().title.lower() == STAGES[-1], "the release is no click"
    assert visited == sorted(visited)
    assert {stage for stage, _ in visited} == set(range(len(STAGES)))


def test_page_down_leaps_through_the_whole_run(window: MainWindow, qtbot: QtBot) -> None:
    session, timeline = window.session, window.page.timeline
    session.open(open_document(ClipScene([[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]]], size=(4, 3)), ""))
    session.set_stage(STAGES[0], 0)
    visited = []
    while session.cursor.stage != "interpolate":
        visited.append(session.cursor)
        qtbot.keyClick(timeline.bar, Qt.Key.Key_PageDown)
    assert len(visited) < 150
    for before in reversed(visited):
        qtbot.keyClick(timeline.chapters.buttons()[0], Qt.Key.Key_PageUp)
        assert session.cursor.stage == before.stage
        assert session.cursor.position <= before.position + 1


def test_a_chapter_says_which_lines_asked_for_blending(window: MainWindow) -> None:
    def blend_tip() -> str:
        return window.page.timeline.chapters.buttons()[STAGES.index("blend")].toolTip()

    window.session.set_setting("polygon_mode", "wireframe")
    assert "nserted" not in blend_tip()
    window.session.set_setting("line", "wu")
    assert "Inserted because wu needs its pixels blended" in blend_tip()
    window.session.set_setting("blend", "over")
    assert "nserted" not in blend_tip()


def test_levels_are_named_as_the_stage_has_them(window: MainWindow) -> None:
    buttons = window.page.timeline.level_buttons
    window.session.set_stage("clip")
    assert (buttons[Level.GROUP].text(), buttons[Level.PIXEL].text()) == ("Plane", "Edge")
    window.session.set_stage("raster")
    assert buttons[Level.PIXEL].text() == "Pixel"
    window.session.set_setting("fill", "scanline")
    assert buttons[Level.GROUP].text() == "Span"
    window.session.set_setting("visibility", "ray-casting-by-pixel")
    window.session.set_stage("depth")
    titles = [buttons[level].text() for level in (Level.TRIANGLE, Level.GROUP, Level.PIXEL)]
    assert titles == ["Row", "Pixel", "Candidate"]
    assert buttons[Level.GROUP].accessibleName() == "Step by pixel"
    depth = window.page.timeline.chapters.buttons()[STAGES.index("depth")].toolTip()
    assert "Accessed: each pixel once" in depth


def test_a_level_button_changes_how_far_a_step_goes(window: MainWindow) -> None:
    session = window.session
    session.go_to(0)
    window.page.timeline.level_buttons[Level.TRIANGLE].click()
    window.page.timeline.forward_button.click()
    assert session.cursor.position == session.stage_trace.steps.boundaries(Level.TRIANGLE)[1]
    window.page.timeline.back_button.click()
    assert session.cursor.position == 0
    window.page.timeline.back_button.click()
    assert session.cursor.stage == "bin"
    session.set_stage(STAGES[0], 0)
    assert not window.page.timeline.back_button.isEnabled()


@pytest.mark.slow
def test_right_and_left_walk_the_whole_run(window: MainWindow) -> None:
    session = window.session
    session.set_stage(STAGES[0], 0)
    window.run_action("step_back")
    assert "Nothing comes before this" in window.statusBar().currentMessage()
    for level in (Level.STAGE, Level.TRIANGLE):
        session.set_level(level)
        visited = [session.cursor]
        while len(visited) < 1000:
            window.run_action("step_forward")
            if session.cursor == visited[-1]:
                break
            visited.append(session.cursor)
        assert list(dict.fromkeys(cursor.stage for cursor in visited)) == list(STAGES)
        for before, after in pairwise(visited):
            assert after.position == 0 if after.stage != before.stage else after.position > before.position
        assert "The picture is finished" in window.statusBar().currentMessage()
        for cursor in reversed(visited[:-1]):
            window.run_action("step_back")
            assert session.cursor == cursor


def test_a_stage_is_entered_at_its_start_in_the_view_that_shows_it(window: MainWindow) -> None:
    page, session = window.page, window.session
    for number, stage in enumerate(STAGES[:10]):
        window.run_action(f"stage_{number}")
        assert (session.cursor.stage, session.cursor.position) == (stage, 0)
        assert page.current_view() == stage_of(stage).view
    window.run_action("stage_2")
    page.main_area.view_bar.tabBarClicked.emit(page.view_names().index("pyramid"))
    window.run_action("stage_5")
    assert page.current_view() == "pixels"
    window.run_action("stage_2")
    assert page.current_view() == "pyramid", "chosen by hand for this stage"
    window.files.show_opened(open_any("near-plane"))
    window.run_action("stage_2")
    assert page.current_view() == "clip", "another scene begins with the views of its own"


def test_buffers_hold_nothing_that_comes_later(window: MainWindow) -> None:
    session = window.session
    for stage in STAGES:
        session.set_stage(stage, 0)
        trace = session.stage_trace
        shown = buffers_of(session.moment)
        if trace.buffers:
            assert [buffer.name for buffer in shown] == [track.name for track in trace.buffers]
            for buffer, track in zip(shown, trace.buffers, strict=True):
                assert np.array_equal(np.asarray(buffer.known), track.known_at(0))
        else:
            (cleared,) = shown
            assert (cleared.values == cleared.values[0, 0]).all(), "only the background"


def test_half_planes_are_the_values_that_pixels_are_tested_with(window: MainWindow) -> None:
    session = window.session
    session.set_stage("edges", 0)
    raster = session.trace.stage("raster")
    tested = raster.triangle == session.stage_trace.triangle[0]
    column, row = raster.pixel[tested].T
    for count in (4, 5, 7):
        session.go_to(int(session.stage_trace.steps.starts[count]))
        shown = buffers_of(session.moment)
        assert len(shown) == {4: 1, 5: 1, 7: 6}[count]
        for buffer in shown if count > 4 else ():
            edge, column_name = int(buffer.name[-1]), "values" if "edge" in buffer.name else "weights"
            of_pixels = raster.columns[column_name][tested, edge]
            assert np.array_equal(buffer.values[row, column], of_pixels, equal_nan=True)
            assert "edge" in buffer.name or (buffer.values < 0).any(), "pixels outside have weights, too"


def test_the_marked_step_is_outlined_in_all_grids(window: MainWindow) -> None:
    window.page.toggle_pane("thumbnails")
    session = window.session
    session.set_level(Level.PIXEL)
    session.go_to(0)
    session.step(1)
    pixel = session.stage_trace.pixel[0]
    for grid in (window.page.grid, window.page.strip.tile("edge 0").grid):
        assert np.array_equal(grid.step().pixels, pixel[None])


def test_chapters_count_what_is_stepped_whatever_the_view(window: MainWindow) -> None:
    def counted() -> dict[str, str]:
        buttons = window.page.timeline.chapters.buttons()
        return {stage: button.chapter().counts for stage, button in zip(STAGES, buttons, strict=True)}

    session = window.session
    session.open(open_document(make_scene("intersecting"), "intersecting"))
    of_pixels = counted()
    for stage in ("interpolate", "shade", "depth", "blend", "resolve"):
        rows = session.trace.stage(stage).steps.row_count
        assert of_pixels[stage].split()[0] == f"{rows:,}"
    window.page.show_view("scene")
    window.page.settle()
    assert counted() == of_pixels
    units = [counts.split()[-1] for counts in of_pixels.values()]
    assert units == ["triangles"] * 4 + ["pixels"] + ["fragments"] * 5 + ["pixels"]


def test_a_click_on_a_value_goes_to_the_step_that_made_it(window: MainWindow, qtbot: QtBot) -> None:
    session, table = window.session, window.page.variables
    covered = session.trace.stage("resolve")
    picture = session.trace.source.picture.primitive.ravel()
    session.set_stage("resolve", int(covered.steps.starts[np.flatnonzero(picture >= 0)[0] + 1]))

    def click(name: str) -> None:
        item = table.findItems(name, Qt.MatchFlag.MatchExactly)[0]
        table.scrollToItem(item)
        where = table.visualItemRect(item)
        at = QPoint(table.columnViewportPosition(1) + table.columnWidth(1) - 12, where.center().y())
        qtbot.mouseClick(table.viewport(), Qt.MouseButton.LeftButton, pos=at)

    start = session.cursor
    way = []
    for name in ("linear", "source", "colour", "λ0 (unsnapped)"):
        click(name)
        way.append(session.cursor.stage)
    assert way == ["blend", "shade", "interpolate", "interpolate"]
    assert "Made here: λ0 (unsnapped)" in window.statusBar().currentMessage()
    for _ in range(4):
        window.run_action("visited_back")
    assert session.cursor == start
