"""A pixel grid under pointer and wheel: hover, click, zoom, pan, vertices that are dragged, brushes."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from tests.widgets.grid.pixel_grids import LEFT, TRIANGLE, at, drag, shown_grid, wheel
from widgets.grid.marks import StepMark
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.view import FIT, GridView


@pytest.fixture
def grid(qtbot) -> PixelGrid:
    return shown_grid(qtbot)


def test_hover_and_click_name_the_pixel(grid: PixelGrid, qtbot) -> None:
    with qtbot.waitSignal(grid.pixel_hovered) as hovered:
        QTest.mouseMove(grid, at(grid, 5.5, 3.5))
    assert hovered.args == [5, 3]
    with qtbot.waitSignal(grid.pixel_clicked) as clicked:
        QTest.mouseClick(grid, LEFT, Qt.KeyboardModifier.NoModifier, at(grid, 23.5, 15.5))
    assert clicked.args == [23, 15]
    with qtbot.waitSignal(grid.pixel_left):
        QTest.mouseMove(grid, QPoint(2, 2))
    with qtbot.assertNotEmitted(grid.pixel_clicked):
        QTest.mouseClick(grid, LEFT, Qt.KeyboardModifier.NoModifier, QPoint(2, 2))


def test_hover_is_told_once_per_pixel(grid: PixelGrid) -> None:
    heard: list[tuple[int, int]] = []
    grid.pixel_hovered.connect(lambda column, row: heard.append((column, row)))
    for x in (5.2, 5.4, 5.6, 6.2):
        QTest.mouseMove(grid, at(grid, x, 3.5))
    assert heard == [(5, 3), (6, 3)]


def test_slots_emit_nothing(grid: PixelGrid, qtbot) -> None:
    signals = [
        grid.pixel_hovered,
        grid.pixel_left,
        grid.pixel_clicked,
        grid.view_changed,
        grid.vertex_dragged,
    ]
    for signal in signals:
        with qtbot.assertNotEmitted(signal):
            grid.show_hover((1, 1))
            grid.show_pin((2, 2))
            grid.show_geometry(TRIANGLE)
            grid.show_step(StepMark(np.array([[3, 3]])))
            grid.set_view(GridView(0.3, 0.3, 2.0))


def test_wheel_zooms_about_the_pointer(grid: PixelGrid, qtbot) -> None:
    position = at(grid, 20.5, 12.5)
    before = grid.placement()
    with qtbot.waitSignal(grid.view_changed) as changed:
        wheel(grid, position, 2)
    assert changed.args == [grid.view()]
    assert grid.placement().cell > before.cell
    assert grid.placement().pixel_at(QPointF(position)) == (20, 12)
    grid.fit()
    assert grid.view() == FIT


@pytest.mark.parametrize("button", [Qt.MouseButton.MiddleButton, Qt.MouseButton.RightButton])
def test_drag_pans(grid: PixelGrid, button: Qt.MouseButton) -> None:
    grid.set_view(GridView(0.5, 0.5, 3.0))
    before = grid.placement()
    drag(grid, QPoint(300, 300), QPoint(340, 270), button)
    assert grid.placement().left == pytest.approx(before.left + 40, abs=1)
    assert grid.placement().bottom == pytest.approx(before.bottom - 30, abs=1)


def test_space_pans_instead_of_clicking(grid: PixelGrid, qtbot) -> None:
    grid.set_view(GridView(0.5, 0.5, 3.0))
    QTest.keyPress(grid, Qt.Key.Key_Space)
    with qtbot.assertNotEmitted(grid.pixel_clicked), qtbot.waitSignal(grid.view_changed):
        drag(grid, QPoint(300, 300), QPoint(340, 270))
    QTest.keyRelease(grid, Qt.Key.Key_Space)
    with qtbot.waitSignal(grid.pixel_clicked):
        QTest.mouseClick(grid, LEFT, Qt.KeyboardModifier.NoModifier, QPoint(300, 300))


def test_an_unmoved_right_click_asks_for_a_menu(grid: PixelGrid, qtbot) -> None:
    with qtbot.waitSignal(grid.pixel_menu_requested) as asked:
        QTest.mouseClick(grid, Qt.MouseButton.RightButton, Qt.KeyboardModifier.NoModifier, at(grid, 4.5, 4.5))
    assert asked.args[:2] == [4, 4]


def test_a_vertex_is_dragged(grid: PixelGrid, qtbot) -> None:
    grid.show_geometry(TRIANGLE)
    heard: list[tuple[str, tuple[float, ...]]] = []
    grid.vertex_dragged.connect(lambda *args: heard.append(("dragged", args)))
    grid.vertex_drag_finished.connect(lambda *args: heard.append(("finished", args)))
    with qtbot.assertNotEmitted(grid.pixel_clicked):
        drag(grid, at(grid, 20.0, 3.0), at(grid, 22.0, 6.0))
    assert [name for name, _ in heard] == ["dragged", "dragged", "finished"]
    vertex, x, y = heard[-2][1]
    assert vertex == 1
    assert (x, y) == pytest.approx((22.0, 6.0), abs=0.05)


def test_no_pixel_is_pointed_at_while_a_vertex_is_dragged(grid: PixelGrid, qtbot) -> None:
    grid.show_geometry(TRIANGLE)
    QTest.mouseMove(grid, at(grid, 20.0, 3.0))
    QTest.mousePress(grid, LEFT, Qt.KeyboardModifier.NoModifier, at(grid, 20.0, 3.0))
    with qtbot.waitSignal(grid.pixel_left), qtbot.assertNotEmitted(grid.pixel_hovered):
        QTest.mouseMove(grid, at(grid, 22.0, 6.0))
    with qtbot.waitSignal(grid.pixel_hovered) as pointed:
        QTest.mouseRelease(grid, LEFT, Qt.KeyboardModifier.NoModifier, at(grid, 22.5, 6.5))
    assert pointed.args == [22, 6]


def test_shift_rounds_a_dragged_vertex(grid: PixelGrid) -> None:
    grid.show_geometry(TRIANGLE)
    places: list[tuple[float, float]] = []
    grid.vertex_dragged.connect(lambda _, x, y: places.append((x, y)))
    shift = Qt.KeyboardModifier.ShiftModifier
    QTest.mousePress(grid, LEFT, shift, at(grid, 8.0, 13.0))
    end = at(grid, 10.7, 9.1)
    place, everywhere = QPointF(end), QPointF(grid.mapToGlobal(end))
    move = QMouseEvent(QEvent.Type.MouseMove, place, everywhere, LEFT, LEFT, shift)
    QApplication.sendEvent(grid, move)
    QTest.mouseRelease(grid, LEFT, shift, end)
    assert places[-1] == (10.5, 9.0)


def test_escape_takes_a_drag_back(grid: PixelGrid) -> None:
    grid.show_geometry(TRIANGLE)
    taken_back: list[int] = []
    finished: list[int] = []
    grid.vertex_drag_taken_back.connect(taken_back.append)
    grid.vertex_drag_finished.connect(finished.append)
    QTest.mousePress(grid, LEFT, Qt.KeyboardModifier.NoModifier, at(grid, 8.0, 13.0))
    QTest.mouseMove(grid, at(grid, 12.0, 9.0))
    QTest.keyClick(grid, Qt.Key.Key_Escape)
    assert taken_back == [2]
    QTest.mouseRelease(grid, LEFT, Qt.KeyboardModifier.NoModifier, at(grid, 12.0, 9.0))
    assert finished == []


def test_a_vertex_is_not_moved_while_there_are_no_pixels(grid: PixelGrid, qtbot) -> None:
    grid.show_geometry(TRIANGLE)
    buffer = grid.buffer()
    QTest.mousePress(grid, LEFT, Qt.KeyboardModifier.NoModifier, at(grid, 8.0, 13.0))
    end = at(grid, 12.0, 9.0)
    QTest.mouseMove(grid, at(grid, 10.0, 9.0))
    grid.show_buffer(None)
    with qtbot.assertNotEmitted(grid.vertex_dragged):
        QTest.mouseMove(grid, at(grid, 0.5, 0.5))
    grid.show_buffer(buffer)
    with qtbot.waitSignal(grid.vertex_dragged) as told:
        QTest.mouseMove(grid, end)
    assert told.args == [2, pytest.approx(12.0), pytest.approx(9.0)]


def test_a_click_on_a_vertex_is_a_click_on_its_pixel(grid: PixelGrid, qtbot) -> None:
    grid.show_geometry(TRIANGLE)
    with qtbot.assertNotEmitted(grid.vertex_dragged), qtbot.waitSignal(grid.pixel_clicked) as clicked:
        QTest.mouseClick(grid, LEFT, Qt.KeyboardModifier.NoModifier, at(grid, 20.2, 3.2))
    assert clicked.args == [20, 3]


def test_a_brush_clicks_every_pixel_once(grid: PixelGrid) -> None:
    heard: list[tuple[int, int]] = []
    grid.pixel_clicked.connect(lambda column, row: heard.append((column, row)))
    grid.set_brush(True)
    QTest.mousePress(grid, LEFT, Qt.KeyboardModifier.NoModifier, at(grid, 3.5, 3.5))
    for x in (3.8, 4.5, 4.9, 5.5):
        QTest.mouseMove(grid, at(grid, x, 3.5))
    QTest.mouseRelease(grid, LEFT, Qt.KeyboardModifier.NoModifier, at(grid, 5.5, 3.5))
    assert heard == [(3, 3), (4, 3), (5, 3)]
