"""A table of depths in the Scene pane: cells, order of the patches, test and size; undo, files, what is refused."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit

from app.files.open_any import open_any
from app.files.state_files import EXTENSION, State, StateFileError, load_state, save_state
from app.pages.step.pixel_story import story_of
from app.session.document import open_document
from app.window.main_window import MainWindow
from core.depth.whole_depths import table_scene
from core.records.depth_table import DepthTable
from core.scene import ClipScene
from lessons.window_scenes import two_triangles

pytestmark = pytest.mark.shared_window


@pytest.fixture
def editing(window: MainWindow) -> MainWindow:
    """Return a window with the table of the lectures, in the Scene pane."""
    window.session.open(open_document(two_triangles(), "Table"))
    window.page.show_panes(["scene", "inspector"])
    QApplication.processEvents()
    return window


def table_of(window: MainWindow) -> DepthTable:
    scene = window.session.document.scene
    assert isinstance(scene, ClipScene)
    assert scene.table is not None
    return scene.table


def type_cell(window: MainWindow, line: int, column: int, text: str) -> None:
    """Type into a cell of the chosen patch, ``line`` counted from the top."""
    item = window.page.depth_tables.cells.item(line, column)
    assert item is not None
    item.setText(text)


@pytest.mark.slow
def test_it_is_there_for_tables_only_and_opens_at_the_depth_test(editing: MainWindow) -> None:
    session, page = editing.session, editing.page
    assert session.cursor.stage == "depth"
    assert page.depth_tables.isVisible()
    assert page.depth_tables.patches.count() == 2
    session.undo()
    assert not page.depth_tables.isVisible()


def test_a_table_that_is_opened_from_the_menu_begins_at_the_depth_test(window: MainWindow) -> None:
    window.files.show_opened(open_any("depth-table"))
    assert (window.session.cursor.stage, window.session.cursor.position) == ("depth", 3)
    assert window.page.current_view() == "pixels"


def test_a_typed_cell_is_drawn_and_undone(editing: MainWindow) -> None:
    before = table_of(editing)
    type_cell(editing, 0, 7, "3")
    assert table_of(editing).depths[0, 7, 7] == 3
    assert editing.session.trace.source.picture.depth[7, 7] == 3
    type_cell(editing, 0, 7, "inf")
    assert np.isposinf(table_of(editing).depths[0, 7, 7])
    type_cell(editing, 0, 0, "-")
    assert np.isnan(table_of(editing).depths[0, 7, 0])
    for _ in range(3):
        editing.session.undo()
    assert table_of(editing) is before
    item = editing.page.depth_tables.cells.item(0, 0)
    assert item is not None
    assert item.text() == "5"


def test_a_cell_that_is_no_depth_is_refused_and_nothing_is_lost(editing: MainWindow) -> None:
    before = table_of(editing)
    for text in ("x", "-3", "1.5", "99999", "nan", "-inf"):
        editing.messages.dismiss()
        type_cell(editing, 0, 0, text)
        assert table_of(editing) is before
        assert f"Expected a whole number from 0 to 9999, ∞ (or inf), or - for none, got {text}" in (
            editing.messages.text.text()
        )
        item = editing.page.depth_tables.cells.item(0, 0)
        assert item is not None
        assert item.text() == "5"


def test_digits_go_into_the_cell_and_not_to_the_stages(editing: MainWindow) -> None:
    cells = editing.page.depth_tables.cells
    cells.setFocus(Qt.FocusReason.TabFocusReason)
    cells.setCurrentCell(0, 0)
    QTest.keyClick(cells, Qt.Key.Key_9)
    assert editing.session.cursor.stage == "depth"
    field = cells.findChild(QLineEdit)
    assert field is not None
    assert field.text() == "9"
    QTest.keyClick(field, Qt.Key.Key_Return)
    QApplication.processEvents()
    assert table_of(editing).depths[0, 7, 0] == 9


def test_patches_are_moved_added_and_removed(editing: MainWindow) -> None:
    editor, before = editing.page.depth_tables, table_of(editing)
    editor.later_button.click()
    moved = table_of(editing)
    assert np.array_equal(moved.depths, before.depths[::-1], equal_nan=True)
    assert np.array_equal(moved.colors, before.colors[::-1])
    assert editor.current_patch() == 1
    editor.patches.model().moveRow(editor.patches.rootIndex(), 1, editor.patches.rootIndex(), 0)
    assert np.array_equal(table_of(editing).depths, before.depths, equal_nan=True)
    editor.add_button.click()
    assert np.isnan(table_of(editing).depths[2]).all()
    editing.session.set_stage("depth", 9)
    editor.show_current_patch(0)
    editor.remove_button.click()
    assert len(table_of(editing).depths) == 2


@pytest.mark.slow
def test_the_test_and_the_size_are_chosen(editing: MainWindow) -> None:
    editor = editing.page.depth_tables
    editor.test_box.setCurrentIndex(2)
    editor.test_box.activated.emit(2)
    assert table_of(editing).test == "greater"
    assert editing.session.trace.source.picture.depth[0, 7] == 0
    editor.columns.setValue(3)
    editor.columns.editingFinished.emit()
    assert table_of(editing).size == (3, 8)
    assert editing.session.trace.source.raster.shape == (8, 3)


def test_a_patch_is_pasted_as_a_whole_or_not_at_all(editing: MainWindow) -> None:
    editor, before = editing.page.depth_tables, table_of(editing)
    for text, message in (
        ("1 2\n3 4", "2 × 2 cells"),
        ("1 2\n3", "Row 2 has 1 cell, row 1 has 2"),
        ("a", "Row 1, cell 1: expected"),
    ):
        QGuiApplication.clipboard().setText(text)
        editor.paste_patch()
        assert table_of(editing) is before
        assert message in editing.messages.text.text()
    editor.show_current_patch(1)
    editor.copy_patch()
    editor.show_current_patch(0)
    editor.paste_patch()
    assert np.array_equal(table_of(editing).depths[0], before.depths[1], equal_nan=True)


@pytest.mark.slow
def test_emptying_the_last_cell_is_refused(editing: MainWindow) -> None:
    editor = editing.page.depth_tables
    editor.remove_button.click()
    before = table_of(editing)
    editor.columns.setValue(1)
    editor.rows.setValue(1)
    editor.columns.editingFinished.emit()
    assert "at least one depth" in editing.messages.text.text()
    assert table_of(editing) is before
    assert editor.columns.value() == 8


def test_a_state_file_keeps_the_table(editing: MainWindow, tmp_path: Path) -> None:
    path = tmp_path / f"table{EXTENSION}"
    save_state(path, State(editing.session.document, stage="depth", position=7))
    opened = open_any(str(path)).document.scene
    assert isinstance(opened, ClipScene)
    assert opened.table is not None
    now = table_of(editing)
    assert np.array_equal(opened.table.depths, now.depths, equal_nan=True)
    assert np.array_equal(opened.clip, two_triangles().clip)
    path.write_text(path.read_text(encoding="utf-8").replace("5\\t5\\t5", "5\\tx\\t5", 1), encoding="utf-8")
    with pytest.raises(StateFileError, match=r"scene.patches.0: row \d, cell 2: expected"):
        load_state(path)


@pytest.mark.slow
def test_every_view_shows_a_table_at_every_stage(editing: MainWindow) -> None:
    session, page = editing.session, editing.page
    for stage in ("transform", "bin", "raster", "interpolate", "depth", "resolve"):
        session.set_stage(stage)
        assert (session.stage_trace.steps.count > 0) == (stage in ("depth", "resolve"))
        for view in page.view_names():
            page.show_view(view)
            QApplication.processEvents()
    page.show_view("pixels")


@pytest.mark.slow
def test_the_history_of_a_cell_tells_of_patches_alone(editing: MainWindow) -> None:
    source = editing.session.trace.source
    story, _ = story_of(source, 1, 4)
    assert story.verdict == "Patch 0 is visible here; 1 fragment rejected."
    assert [entry.title for entry in story.entries] == ["Initial value", "Clear", "Patch 0", "Patch 1"]
    assert story.entries[-1].reason == "Failed the depth test: 6 is not nearer than patch 0 (5)."
    story, _ = story_of(source, 7, 0)
    assert story.verdict == "No patch covers this pixel."
    last = story.entries[-1]
    assert (last.title, last.reason) == ("2 more patches", "No fragment here.")


@pytest.mark.slow
def test_a_dragged_patch_and_a_chosen_one_are_stepped(editing: MainWindow) -> None:
    session = editing.session
    session.edit(replace(session.document, triangle=1))
    assert set(session.trace.stage("depth").triangle.tolist()) == {1}
    editing.page.depth_tables.remove_button.click()
    assert session.document.triangle is None


@pytest.mark.slow
def test_the_raster_of_a_table_is_its_cells_whatever_is_asked(editing: MainWindow) -> None:
    session, before = editing.session, table_of(editing)
    for action in (
        "next_triangle",
        "fit_region",
        "whole_picture",
        "toggle_shared",
        "next_vertex",
        "vertex_left",
    ):
        editing.run_action(action)
        assert (session.document.raster.columns, session.document.raster.rows) == (8, 8), action
        assert session.document.raster.origin is None
        assert table_of(editing) is before


@pytest.mark.slow
def test_a_table_with_fewer_fragments_than_patches_is_saved_opened_and_shown(
    window: MainWindow, tmp_path: Path
) -> None:
    table = DepthTable([[[np.nan]], [[4]]], np.ones((2, 4)))
    path = tmp_path / f"one{EXTENSION}"
    save_state(path, State(open_document(table_scene(table), "One fragment")))
    window.files.show_opened(open_any(str(path)))
    session = window.session
    for view in window.page.main_area.view_names():
        window.page.show_view(view)
        for stage in ("transform", "clip", "depth"):
            session.set_stage(stage, 1)
        QApplication.processEvents()
    session.edit(replace(session.document, triangle=0))
    story, _ = story_of(session.trace.source, 0, 0, 0)
    assert story.verdict == "Patch 0 has no fragment here: its cell is empty."
