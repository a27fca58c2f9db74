"""Segments and points in the window: outlines, handles, typed ends, words, and steps through all stages."""

from collections.abc import Callable

import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from app.files.open_any import open_any
from app.pages.step.setting_records import settings_records
from app.session.document import open_document
from app.views.stage_views import chapters_of
from app.window.main_window import MainWindow
from core import STAGES
from core.scene import ClipScene
from lessons.scenes import make_scene
from tests.covering import every_nth
from widgets.timeline.chapters import ChapterState

pytestmark = pytest.mark.shared_window


def open_scene(window: MainWindow, name: str) -> ClipScene:
    """Open a built-in scene of segments or points."""
    scene = make_scene(name)
    assert isinstance(scene, ClipScene)
    window.session.open(open_document(scene, name))
    return scene


@pytest.mark.slow
@pytest.mark.parametrize(("name", "handles"), every_nth([("segment", 2), ("points", 1)], 2))
@pytest.mark.own_window
def test_every_end_has_a_handle_that_moves_it(window: MainWindow, name: str, handles: int) -> None:
    scene, grid = open_scene(window, name), window.page.grid
    window.session.go_to(0)
    window.page.grid.grab()
    chosen = [grid.choose_next_vertex() for _ in range(handles + 1)]
    assert len(set(chosen)) == handles
    assert chosen[0] == chosen[-1]
    assert grid.nudge_vertex(1.0, 2.0)
    moved = window.session.document.scene
    assert isinstance(moved, ClipScene)
    assert moved.kind == scene.kind
    assert (moved.clip != scene.clip).any(axis=2).sum() == 1
    assert moved.clip[0, 0, :2] == pytest.approx(scene.clip[0, 0, :2] + 2 * np.array([1.0, 2.0]) / scene.size)
    window.session.undo()
    assert window.session.document.scene is scene


def test_stages_of_areas_are_skipped_with_a_reason(window: MainWindow) -> None:
    open_scene(window, "segment")
    chapters = chapters_of(window.session.trace, current="raster", is_predicting=False)
    skipped = {chapter.title: chapter.reason for chapter in chapters if chapter.state is ChapterState.SKIPPED}
    assert skipped["Edges"] == "A segment has no edge functions: it has no inside."
    assert skipped["Bin"] == "A segment has no area: its pixels are found without boxes and blocks."
    assert chapters[STAGES.index("raster")].counts == "1 segment → 9 fragments"


def test_families_of_areas_say_why_they_do_nothing(window: MainWindow) -> None:
    open_scene(window, "points")
    reasons = {record.family: record.refusal for record in settings_records(window.session.document)}
    for family in ("cull", "polygon_mode", "fill", "fill_rule"):
        assert reasons[family] == "Points have no area."
    assert reasons["line"] == "A point is one pixel."
    open_scene(window, "segment")
    reasons = {record.family: record.refusal for record in settings_records(window.session.document)}
    assert reasons["line"] == reasons["line_clipping"] == ""


@pytest.mark.slow
@pytest.mark.parametrize("clipper", every_nth(["Cohen-Sutherland", "Liang-Barsky", "Cyrus-Beck"], 3))
def test_a_typed_segment_is_stepped_in_six_actions_and_clipped_in_three_more(
    window: MainWindow, qtbot: QtBot, clipper: str
) -> None:
    session, page = window.session, window.page
    window.pages.show_page("start")
    actions = 0

    def act(do: Callable[[], object]) -> None:
        nonlocal actions
        do()
        actions += 1

    def type_end(path: str, text: str) -> None:
        edit = page.outline.field(path).edit
        edit.setFocus()
        edit.selectAll()
        qtbot.keyClicks(edit, text)
        qtbot.keyClick(edit, Qt.Key.Key_Return)

    def choose(family: str, title: str) -> None:
        combo = page.settings_panel.combo(family)
        combo.setCurrentIndex(combo.findText(title))
        combo.activated.emit(combo.currentIndex())

    (card,) = [card for card in window.pages.current.cards.cards if card.entry.name == "segment"]
    act(card.click)
    qtbot.waitUntil(lambda: session.document.title == "Segment")
    act(lambda: qtbot.keyClick(window, Qt.Key.Key_S))
    act(lambda: type_end("corner/0/0/x", "2.5, 3.5"))
    act(lambda: type_end("corner/0/1/x", "20.5, 10.5"))
    act(lambda: qtbot.keyClick(window, Qt.Key.Key_6))
    act(lambda: qtbot.keyClick(window, Qt.Key.Key_Right))
    assert actions <= 6
    assert session.cursor.stage == "raster"
    assert session.cursor.position > 0
    row, _ = session.stage_trace.steps.row_at(session.cursor.position)
    assert session.stage_trace.pixel[row].tolist() == [2, 3]
    actions = 0
    act(lambda: qtbot.keyClick(window, Qt.Key.Key_M))
    act(lambda: choose("line_clipping", clipper))
    act(lambda: qtbot.keyClick(window, Qt.Key.Key_Right))
    assert actions <= 3
    assert session.document.settings.line_clipping == clipper.lower()
    assert session.stage_trace.extra["outline_clip"].lines.is_kept.all()


@pytest.mark.slow
def test_clippers_of_rectangles_are_refused_for_a_polygon(window: MainWindow, qtbot: QtBot) -> None:
    open_scene(window, "polygon-window")
    (record,) = (r for r in settings_records(window.session.document) if r.family == "line_clipping")
    refused = {choice.value for choice in record.choices if choice.refusal}
    assert {"cohen-sutherland", "liang-barsky"} <= refused
    assert not {"none", "cyrus-beck"} & refused
    before = window.session.document
    with pytest.raises(ValueError, match="cohen-sutherland needs a rectangle"):
        window.session.set_setting("line_clipping", "cohen-sutherland")
    assert window.session.document is before
    window.session.set_setting("line_clipping", "cyrus-beck")
    assert len(window.page.grids.geometry.focus_vertices) == 2
    window.files.show_opened(open_any("clipped-segment"))
    assert window.session.document.settings.line_clipping == "liang-barsky"
    window.open_path("polygon-window")
    qtbot.waitUntil(lambda: not window.files.job.is_running)
    assert window.session.document.title == "Segment and convex polygon"
    assert window.session.document.settings.line_clipping == "cyrus-beck"


def test_menus_name_what_the_scene_is_made_of(window: MainWindow) -> None:
    action = window.menus.actions_by_name["next_triangle"]
    assert action.text() == "Next triangle"
    open_scene(window, "segment")
    assert action.text() == "Next segment"
