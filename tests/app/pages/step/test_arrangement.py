"""The picture comes first: how much of the window the main view has, and what may not move it."""

import pytest
from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.window.main_window import MainWindow
from app.window.preferences import Preferences
from core.stages.declared import STAGES
from widgets.basics.message_bar import Message, MessageKind


def area_of_the_view(window: MainWindow) -> float:
    """Return the part of the window that the main view has."""
    view = window.page.main_view()
    return view.width() * view.height() / (window.width() * window.height())


@pytest.mark.parametrize(("size", "least"), [((1280, 800), 0.45), ((1920, 1080), 0.6)])
def test_the_main_view_has_its_part_of_the_window(
    window: MainWindow, qtbot: QtBot, size: tuple[int, int], least: float
) -> None:
    window.resize(*size)
    qtbot.waitUntil(lambda: (window.width(), window.height()) == size)
    for stage in STAGES:
        window.session.set_stage(stage)
        for view in window.page.view_names():
            window.page.show_view(view)
            QApplication.processEvents()
            whole = window.page.main_area.view_stack
            assert whole.width() * whole.height() >= least * size[0] * size[1], (stage, view)
            if view != "compare":
                assert area_of_the_view(window) >= least, (stage, view)


def place_of_pixel(window: MainWindow) -> tuple[QPoint, QPoint]:
    """Return the corners of pixel (20, 20) in the window."""
    QApplication.processEvents()
    grid = window.page.grid
    rect = grid.placement().cells_rect(20, 20).toRect()
    return grid.mapTo(window, rect.topLeft()), grid.mapTo(window, rect.bottomRight())


def test_no_feedback_moves_the_grid(window: MainWindow) -> None:
    place = place_of_pixel(window)
    for kind in MessageKind:
        window.messages.show_message(Message(kind, "A long message. " * 40, "Details. " * 200))
        window.messages.details_button.click()
        assert window.messages.isVisible()
        assert place_of_pixel(window) == place
        window.messages.dismiss()
        assert place_of_pixel(window) == place
    window.tell("A hint that is a good deal longer than the room beside the names of the pages has. " * 4)
    assert place_of_pixel(window) == place
    window.toggle_predict()
    assert window.page.prediction.isVisible()
    assert place_of_pixel(window) == place
    window.toggle_predict()
    window.session.set_pin((20, 20))
    assert place_of_pixel(window) == place
    window.page.main_area.buffer_choice.buffer_chosen.emit("edge 0")
    window.page.main_area.range_button.click()
    assert window.page.ranges.isVisible()
    assert place_of_pixel(window) == place
    window.page.card.fold_button.click()
    assert place_of_pixel(window) == place


def test_no_step_of_a_stage_moves_the_grid(window: MainWindow) -> None:
    for stage in STAGES:
        window.session.set_stage(stage, 0)
        window.page.show_view("pixels")
        count = window.session.stage_trace.steps.count
        places = set()
        for position in range(0, count + 1, max(count // 3, 1)):
            window.session.go_to(position)
            places.add(str(place_of_pixel(window)))
        assert len(places) == 1, stage


def test_panes_are_folded_at_first_and_come_by_keys(window: MainWindow) -> None:
    page = window.page
    assert page.shown_panes() == ["inspector", "details", "navigator", "run"]
    assert not page.outline.isVisible()
    page.side_tabs.buttons["scene"].click()
    assert page.outline.isVisible()
    assert page.columns.sizes()[0] >= 200
    page.side_tabs.buttons["methods"].click()
    assert page.shown_panes() == ["methods", "inspector", "details", "navigator", "run"]
    assert window.menus.actions_by_name["pane_methods"].isChecked()
    page.side_tabs.buttons["methods"].click()
    assert page.shown_panes() == ["inspector", "details", "navigator", "run"]
    assert page.side_panes.isHidden()


def test_a_buffer_that_is_alone_is_shown_once(window: MainWindow) -> None:
    page = window.page
    page.toggle_pane("thumbnails")
    assert page.strip.isVisible()
    window.session.set_stage("cull")
    assert not page.strip.isVisible()
    assert not page.main_area.buffer_choice.isEnabled()
    assert page.main_area.buffer_choice.currentText() == page.grid.buffer().label  # type: ignore[union-attr]
    window.session.set_stage("raster")
    assert page.strip.isVisible()


def test_shown_panes_and_widths_come_back(window: MainWindow, qtbot: QtBot) -> None:
    page = window.page
    page.show_panes(["overlays", "thumbnails"])
    page.columns.restoreState(b"30.000 25.000")
    left = page.columns.sizes()[0]
    layout = page.layout_state()
    window.memory.save_preferences(window)
    kept = window.memory.preferences
    assert kept.shown_panes == ["overlays", "thumbnails"]
    other = MainWindow(window.session.document, kept)
    qtbot.addWidget(other)
    other.resize(1280, 800)
    other.memory.restore(other)
    other.show()
    assert other.page.shown_panes() == ["overlays", "thumbnails"]
    assert other.page.columns.sizes()[0] == pytest.approx(left, abs=2)
    assert other.page.layout_state()["step columns"] == layout["step columns"]
    other.close()


def test_the_layout_of_an_earlier_version_opens_as_at_first(window: MainWindow, qtbot: QtBot) -> None:
    """Panes of three columns with the strip below, as they were saved before panes could be folded."""
    earlier = "AAAA/wAAAAEAAAADAAABKAAAAmgAAAFgAf////8BAAAAAQA="
    layout = {"columns": earlier, "rows": earlier, "inspector": earlier, "step columns": earlier}
    other = MainWindow(window.session.document, Preferences(layout=layout))
    qtbot.addWidget(other)
    other.resize(1280, 800)
    other.memory.restore(other)
    other.show()
    qtbot.waitExposed(other)
    assert other.page.shown_panes() == ["inspector", "details", "navigator", "run"]
    assert area_of_the_view(other) >= 0.45
    other.close()
