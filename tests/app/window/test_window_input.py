"""Real clicks, keys and typing in the window: edits, focus, refusals; nothing is left half changed."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton
from pytestqt.qtbot import QtBot

from app.session.document import open_document
from app.window.main_window import MainWindow
from core.records.motion import Motion
from core.records.steps import Level
from lessons.scenes import make_scene

pytestmark = pytest.mark.shared_window


def type_value(window: MainWindow, qtbot: QtBot, path: str, text: str) -> None:
    """Type a number into the outline."""
    field = window.page.outline.field(path).edit
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)


def place_of(window: MainWindow, column: int, row: int) -> QPoint:
    """Return where a pixel of the main grid is, in the grid's coordinates."""
    return window.page.grid.placement().cells_rect(column, row).center().toPoint()


def test_a_vertex_is_dragged_with_depth_and_w_kept(window: MainWindow) -> None:
    grid, session = window.page.grid, window.session
    scene = session.document.scene
    geometry = window.page.grids.geometry
    vertex = int(geometry.triangles[geometry.focus][0])
    start = grid.placement().to_widget(*geometry.vertices[vertex])
    before = scene.clip.copy()
    QTest.mousePress(grid, Qt.MouseButton.LeftButton, pos=start.toPoint())
    for step in range(1, 6):
        QTest.mouseMove(grid, start.toPoint() + QPoint(6 * step, -4 * step))
    QTest.mouseRelease(grid, Qt.MouseButton.LeftButton, pos=start.toPoint() + QPoint(30, -20))
    after = session.document.scene
    moved = np.argwhere((after.clip != before).any(axis=2))
    assert len(moved) in (1, 2)
    assert np.array_equal(after.clip[..., 2:], before[..., 2:])
    window.menus.actions_by_name["undo"].trigger()
    undone = session.document.scene
    assert np.array_equal(undone.clip, before)
    window.menus.actions_by_name["redo"].trigger()
    assert np.array_equal(session.document.scene.clip, after.clip)


def test_shared_corners_split_and_join(window: MainWindow) -> None:
    session = window.session
    window.menus.actions_by_name["toggle_shared"].trigger()
    assert session.document.scene.shared is None
    assert not window.menus.actions_by_name["toggle_shared"].isChecked()
    window.menus.actions_by_name["toggle_shared"].trigger()
    assert session.document.scene.shared is not None


def test_a_click_pins_and_shows_the_history(window: MainWindow) -> None:
    QTest.mouseClick(window.page.grid, Qt.MouseButton.LeftButton, pos=place_of(window, 20, 20))
    assert window.session.pin == (20, 20)
    assert window.page.column.currentWidget() is window.page.history
    assert "20" in window.page.history.place.text()
    assert "(20, 20)" in window.pointed.text()


def test_hovering_one_grid_reads_in_all(window: MainWindow, qtbot: QtBot) -> None:
    window.page.toggle_pane("thumbnails")
    qtbot.wait(1)
    tile = window.page.strip.tile("edge 0")
    QTest.mouseMove(tile.grid, tile.grid.placement().cells_rect(12, 13).center().toPoint())
    assert window.session.hover == (12, 13)
    assert all(window.page.strip.tile(name).value.text() for name in window.page.strip.names())
    assert window.pointed.text().startswith("pixel (12, 13)")


def test_values_are_typed(window: MainWindow, qtbot: QtBot) -> None:
    window.page.show_panes(["scene"])
    picture = window.session.trace.source.picture.primitive
    type_value(window, qtbot, "corner/0/0/x", "20.5")
    assert not np.array_equal(window.session.trace.source.picture.primitive, picture)
    type_value(window, qtbot, "corner/0/0/w", "-1")
    assert window.session.document.scene.clip[0, 0, 3] == -1


def test_nonsense_changes_nothing(window: MainWindow, qtbot: QtBot) -> None:
    window.page.show_panes(["scene"])
    for text in ["", "abc", "1e999", "nan", "--3", "1/0"]:
        document = window.session.document
        type_value(window, qtbot, "corner/0/0/x", text)
        assert window.session.document is document
        QTest.keyClick(window.page.outline.field("corner/0/0/x").edit, Qt.Key.Key_Escape)


def test_w_of_zero_is_refused_with_a_reason(window: MainWindow, qtbot: QtBot) -> None:
    window.page.show_panes(["scene"])
    document = window.session.document
    type_value(window, qtbot, "corner/0/0/w", "0")
    assert window.session.document is document
    assert "w must not be 0" in window.messages.text.text()
    assert window.page.outline.field("corner/0/0/w").value() == 1
    type_value(window, qtbot, "corner/0/0/x", "0.25")  # an edit that is taken
    assert window.session.document is not document
    assert not window.messages.isVisible()


def test_bad_values_of_a_scene_are_told(window: MainWindow, qtbot: QtBot) -> None:
    window.page.show_panes(["scene"])
    for path, text, reason in [
        ("camera/range/near", "100", "near"),
        ("camera/range/far", "0.01", "far"),
        ("camera/range/near", "-1", "near"),
        ("camera/lens/field_of_view", "0", "field of view"),
        ("camera/lens/field_of_view", "180", "field of view"),
        ("document/focus/triangle", "1e9", "between 0 and"),
        ("document/focus/triangle", "1.5", "triangle"),
    ]:
        window.session.open(open_document(make_scene("sphere"), "Sphere"))
        document = window.session.document
        type_value(window, qtbot, path, text)
        assert window.session.document is document
        field = window.page.outline.field(path)
        told = (window.messages.text.text() if window.messages.isVisible() else "") + field.error_text()
        assert reason in told.replace("_", " ").lower()


def test_shadows_and_motion_are_edited_and_undone(window: MainWindow, qtbot: QtBot) -> None:
    window.page.show_panes(["scene"])
    session = window.session
    session.open(open_document(make_scene("box-in-light"), "Box in light"))
    before, headings = session.document, window.page.outline.findChildren(QToolButton)
    for heading in headings:
        if heading.objectName() in ("light/0", "motion"):
            heading.click()
    box = window.page.outline.flag("light/0/shadow/casts_shadow")
    box.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(box, Qt.Key.Key_Space)
    assert session.document.scene.casting_light == -1
    type_value(window, qtbot, "motion/camera/x", "1/4")
    assert session.document.scene.motion == Motion((0.25, 0.0, 0.0))
    session.undo()
    session.undo()
    assert session.document.scene is before.scene
    assert box.isChecked()
    assert window.page.outline.field("motion/camera/x").value() == 0


def test_a_method_that_the_scene_cannot_serve(window: MainWindow) -> None:
    window.page.show_panes(["methods"])
    scene = make_scene("cube")
    flat = replace(scene, camera=replace(scene.camera, projection="orthographic"))
    window.session.open(open_document(flat, "Flat cube"))
    document = window.session.document
    window.page.settings_panel.setting_chosen.emit("depth", "inverse-w")
    assert window.session.document is document
    assert "perspective camera" in window.messages.text.text()
    assert window.page.settings_panel.combo("depth").currentData() == document.settings.depth


@pytest.mark.own_window
def test_space_presses_the_button_that_tab_has_reached(window: MainWindow) -> None:
    button = window.page.timeline.first_button
    button.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(button, Qt.Key.Key_Space)
    assert not window.page.timeline.is_playing()
    assert window.session.cursor.position == 0
    window.page.grid.setFocus()
    QTest.keyClick(window.page.grid, Qt.Key.Key_Space)
    assert window.page.timeline.is_playing()
    window.run_action("unpin")
    assert not window.page.timeline.is_playing()


@pytest.mark.slow
def test_no_button_lacks_a_name_or_a_tooltip(window: MainWindow) -> None:
    window.page.show_view("compare")
    nameless = [
        button.objectName() or type(button).__name__
        for button in window.findChildren(QToolButton)
        if button.isVisible() and not (button.text() or button.accessibleName() or button.toolTip())
    ]
    assert nameless == []


def test_going_to_a_pixel(window: MainWindow) -> None:
    window.run_action("go_to_pixel")
    field = window.overlays.ask_bar.field
    for text, told in (("abc", "Enter column and row"), ("1000, 3", "is not in the raster")):
        field.selectAll()
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)
        assert told in window.overlays.ask_bar.hint.text()
    field.selectAll()
    QTest.keyClicks(field, "12, 7")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert window.session.pin == (12, 7)
    assert not window.overlays.ask_bar.isVisible()


def test_a_condition_is_a_breakpoint(window: MainWindow) -> None:
    window.session.go_to(0)
    window.run_action("edit_condition")
    QTest.keyClicks(window.overlays.ask_bar.field, "covered and row == 20")
    QTest.keyClick(window.overlays.ask_bar.field, Qt.Key.Key_Return)
    window.run_action("run_forward")
    trace = window.session.stage_trace
    row, _ = trace.steps.row_at(window.session.cursor.position)
    values = trace.variables(row)
    assert values["covered"]
    assert values["row"] == 20
    window.run_action("edit_condition")
    window.overlays.ask_bar.field.setText("no_such_name > 1")
    QTest.keyClick(window.overlays.ask_bar.field, Qt.Key.Key_Return)
    assert "no_such_name" in window.overlays.ask_bar.hint.text()
    assert window.page.stepping.breaks.condition == "covered and row == 20"


@pytest.mark.own_window
def test_escape_closes_one_thing_at_a_time(window: MainWindow) -> None:
    window.page.take_focus()
    window.session.set_pin((3, 3))
    window.run_action("go_to_pixel")
    window.overlays.toggle_keys()
    for visible in (window.overlays.key_help, window.overlays.ask_bar):
        assert visible.isVisible()
        QTest.keyClick(window, Qt.Key.Key_Escape)
        assert not visible.isVisible()
        assert window.session.pin == (3, 3)
        assert (
            window.overlays.ask_bar.isAncestorOf(window.focusWidget()) == window.overlays.ask_bar.isVisible()
        )
    QTest.keyClick(window, Qt.Key.Key_Escape)
    assert window.session.pin is None


@pytest.mark.own_window
def test_escape_takes_a_drag_back_and_leaves_the_pin(window: MainWindow) -> None:
    grid, session = window.page.grid, window.session
    session.set_pin((3, 3))
    document, geometry = session.document, window.page.grids.geometry
    start = grid.placement().to_widget(*geometry.vertices[0]).toPoint()
    QTest.mousePress(grid, Qt.MouseButton.LeftButton, pos=start)
    for step in range(1, 6):
        QTest.mouseMove(grid, start + QPoint(6 * step, -4 * step))
    assert session.document is not document
    # Pressed in the window, where Escape is also a shortcut.
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_Escape)
    assert session.document is document
    assert not session.can_undo
    assert session.pin == (3, 3)
    QTest.mouseRelease(grid, Qt.MouseButton.LeftButton, pos=start + QPoint(30, -20))
    assert session.document is document
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_Escape)
    assert session.pin is None


def test_the_menu_of_a_pixel(window: MainWindow) -> None:
    menu = window.page.pixel_menu
    menu.fill(20, 20)
    texts = [action.text() for action in menu.menu.actions()]
    assert texts[0] == "Pixel (20, 20)"
    depth = next(action for action in menu.menu.actions() if action.data() == "depth")
    depth.trigger()
    assert window.session.cursor.stage == "depth"
    assert window.session.pin == (20, 20)
    row, _ = window.session.stage_trace.steps.row_at(window.session.cursor.position)
    assert window.session.stage_trace.pixel[row].tolist() == [20, 20]


def test_playing_goes_to_the_end_and_stops(window: MainWindow, qtbot: QtBot) -> None:
    session = window.session
    session.set_level(Level.TRIANGLE)
    session.go_to(0)
    window.page.timeline.show_speed(60)
    window.run_action("toggle_play")
    qtbot.waitUntil(lambda: not window.page.timeline.is_playing())
    assert session.cursor.position == session.stage_trace.steps.count


def test_focus_raster_and_start_are_edits_like_others(window: MainWindow) -> None:
    window.page.show_panes(["scene"])
    session = window.session
    session.open(open_document(make_scene("torus"), "Torus"))
    focused = session.document
    window.run_action("focus_all")
    assert session.document.triangle is None
    window.run_action("toggle_cleared")
    assert session.document.before == "cleared"
    window.edits.focus_triangle(5)
    window.run_action("fit_region")
    while session.document is not focused:
        session.undo()
    assert window.menus.actions_by_name["undo"].isEnabled()
    QApplication.processEvents()
    assert window.page.outline.field("document/focus/triangle").value() == focused.triangle
