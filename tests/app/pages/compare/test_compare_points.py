"""Points of the Compare page: their pictures, two locked together, and stepping to where they part."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.pages.compare.page import ComparePage
from app.window.main_window import MainWindow
from tests.app.pages.compare.compare_pages import WRONG, click, compare_page, measured, wait_for_pictures

pytestmark = pytest.mark.shared_window


@pytest.fixture
def page(window: MainWindow) -> ComparePage:
    return compare_page(window)


def test_a_point_opens_its_picture_the_reference_and_the_difference(page: ComparePage, qtbot: QtBot) -> None:
    study = measured(page, qtbot)
    assert "Click a mark for its pictures" in page.pictures.heading.text()
    QApplication.processEvents()  # The controls of the measuring have made room.
    places = page.scatter.places()
    click(page, "visibility=painters")
    wait_for_pictures(page, qtbot)
    assert page.scatter.places() == places, "no mark moves away from the next click"
    point = next(point for point in study.points if point.method == "visibility=painters")
    buffers = [grid.buffer() for grid in page.pictures.linked.grids]
    wrong = round(point.errors[WRONG] * buffers[2].values.size / 1e6)
    assert np.count_nonzero(buffers[2].values) == wrong > 0
    assert f"{wrong:,} of" in page.pictures.heading.text()
    QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert "Click a mark for its pictures" in page.pictures.heading.text()
    assert page.scatter.places() == places
    QTest.mouseClick(page.pictures.close_button, Qt.MouseButton.LeftButton)
    assert not page.pictures.isVisible()
    click(page, "visibility=painters")
    assert page.pictures.isVisible()


@pytest.mark.slow
def test_a_run_opens_on_the_step_page_and_undo_leads_back(
    window: MainWindow, page: ComparePage, qtbot: QtBot
) -> None:
    before = window.session.document
    measured(page, qtbot)
    click(page, "visibility=painters")
    wait_for_pictures(page, qtbot)
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.mouseClick(page.pictures.step_button, Qt.MouseButton.LeftButton)
    assert window.pages.current_name == "step"
    assert window.session.document.settings.visibility == "painters"
    pin = window.session.pin
    assert pin is not None
    window.session.undo()
    assert window.session.document is before


def test_the_pinned_pixel_is_where_stepping_begins(
    window: MainWindow, page: ComparePage, qtbot: QtBot
) -> None:
    measured(page, qtbot)
    click(page, "visibility=z-buffer")
    wait_for_pictures(page, qtbot)
    grid = page.pictures.linked.grids[0]
    QTest.mouseClick(
        grid, Qt.MouseButton.LeftButton, pos=grid.placement().cells_rect(60, 64).center().toPoint()
    )
    assert page.pictures.pin is not None
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.keyClick(window, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert window.session.pin == page.pictures.pin


@pytest.mark.slow
def test_two_points_are_locked_and_stepped_to_where_they_part(
    window: MainWindow, page: ComparePage, qtbot: QtBot
) -> None:
    measured(page, qtbot)
    click(page, "visibility=z-buffer")
    click(page, "visibility=last-drawn", Qt.KeyboardModifier.ControlModifier)
    assert page.chosen == ("visibility=z-buffer", "visibility=last-drawn")
    wait_for_pictures(page, qtbot)
    first, second, difference = (grid.buffer() for grid in page.pictures.linked.grids)
    assert np.array_equal((first.values != second.values).any(axis=2), difference.values != 0)
    assert page.pictures.divergence_button.isVisible()
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.mouseClick(page.pictures.divergence_button, Qt.MouseButton.LeftButton)
    assert window.page.current_view() == "compare"
    assert window.session.document.settings.visibility == "z-buffer"
    assert window.page.comparing.other.visibility == "last-drawn"
    pin = window.session.pin
    assert difference.values[pin[1], pin[0]] != 0
    assert window.session.cursor.stage == "depth"


def test_two_points_that_never_part_say_so(window: MainWindow, page: ComparePage, qtbot: QtBot) -> None:
    measured(page, qtbot)
    click(page, "visibility=last-drawn")
    page.choose("visibility=painters", is_added=True)
    wait_for_pictures(page, qtbot)
    page.opened.step_to_divergence()
    qtbot.waitUntil(
        lambda: (
            window.pages.current_name == "step" or "do not diverge" in window.statusBar().currentMessage()
        ),
        timeout=60000,
    )
    buffers = [grid.buffer() for grid in page.pictures.linked.grids]
    assert (window.pages.current_name == "step") or not np.count_nonzero(buffers[2].values)


@pytest.mark.own_window
def test_without_a_point_the_keys_say_what_to_do(window: MainWindow, page: ComparePage) -> None:
    QTest.keyClick(window, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert "Click a point first" in window.statusBar().currentMessage()
    both = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    QTest.keyClick(window, Qt.Key.Key_Return, both)
    assert "Select two points first" in window.statusBar().currentMessage()
