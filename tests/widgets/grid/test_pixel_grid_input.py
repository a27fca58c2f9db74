"""A pixel grid under pointer and wheel: hover, click, zoom, pan, vertices that are dragged, brushes."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from tests.widgets.grid.pixel_grids import LEFT, TRIANGLE, at, drag, shown_grid, wheel
from tests.widgets.showing import Told, told
from widgets.grid.geometry import vertex_near
from widgets.grid.marks import StepMark
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.view import FIT, GridView

NO_KEY = Qt.KeyboardModifier.NoModifier


@pytest.fixture
def grid(qtbot) -> PixelGrid:
    return shown_grid(qtbot)


@pytest.fixture
def heard(grid: PixelGrid) -> Told:
    """Return what the grid tells from now on."""
    pixels = ("pixel_hovered", "pixel_left", "pixel_clicked", "pixel_menu_requested")
    vertices = ("vertex_dragged", "vertex_drag_finished", "vertex_drag_taken_back")
    return told(grid, *pixels, *vertices, "view_changed")


def click(grid: PixelGrid, place: QPoint, button: Qt.MouseButton = LEFT) -> None:
    QTest.mouseClick(grid, button, NO_KEY, place)


def test_pointer_and_click_name_the_pixel_once(grid: PixelGrid, heard: Told) -> None:
    for x in (5.2, 5.4, 5.6, 6.2):
        QTest.mouseMove(grid, at(grid, x, 3.5))
    click(grid, at(grid, 23.5, 15.5))
    QTest.mouseMove(grid, QPoint(2, 2))
    click(grid, QPoint(2, 2))
    hovered = [each for each in heard if each[0] == "pixel_hovered"]
    assert hovered[:2] == [("pixel_hovered", 5, 3), ("pixel_hovered", 6, 3)]
    assert [each for each in heard if each not in hovered] == [("pixel_clicked", 23, 15), ("pixel_left",)]
    click(grid, at(grid, 4.5, 4.5), Qt.MouseButton.RightButton)
    assert ("pixel_menu_requested", 4, 4) in [each[:3] for each in heard]


def test_what_is_set_by_the_program_tells_nothing(grid: PixelGrid, heard: Told) -> None:
    grid.show_hover((1, 1))
    grid.show_pin((2, 2))
    grid.show_geometry(TRIANGLE)
    grid.show_step(StepMark(np.array([[3, 3]])))
    grid.set_view(GridView(0.3, 0.3, 2.0))
    assert heard == []


def test_wheel_zooms_about_the_pointer(grid: PixelGrid, heard: Told) -> None:
    position = at(grid, 20.5, 12.5)
    before = grid.placement()
    wheel(grid, position, 2)
    assert ("view_changed", grid.view()) in heard
    assert grid.placement().cell > before.cell
    assert grid.placement().pixel_at(QPointF(position)) == (20, 12)
    grid.fit()
    assert grid.view() == FIT


@pytest.mark.parametrize("way", ["middle", "right", "space"])
def test_drag_pans(grid: PixelGrid, heard: Told, way: str) -> None:
    grid.set_view(GridView(0.5, 0.5, 3.0))
    before = grid.placement()
    if way == "space":
        QTest.keyPress(grid, Qt.Key.Key_Space)
    button = {"middle": Qt.MouseButton.MiddleButton, "right": Qt.MouseButton.RightButton}.get(way, LEFT)
    drag(grid, QPoint(300, 300), QPoint(340, 270), button)
    assert grid.placement().left == pytest.approx(before.left + 40, abs=1)
    assert grid.placement().bottom == pytest.approx(before.bottom - 30, abs=1)
    assert {name for name, *_ in heard} <= {"view_changed", "pixel_hovered"}
    if way == "space":
        QTest.keyRelease(grid, Qt.Key.Key_Space)
        click(grid, QPoint(300, 300))
        assert "pixel_clicked" in {name for name, *_ in heard}


def test_a_vertex_is_dragged_and_no_pixel_is_pointed_at_meanwhile(grid: PixelGrid, heard: Told) -> None:
    grid.show_geometry(TRIANGLE)
    QTest.mouseMove(grid, at(grid, 20.0, 3.0))
    heard.clear()
    drag(grid, at(grid, 20.0, 3.0), at(grid, 22.0, 6.0))
    names = [name for name, *_ in heard]
    assert [name for name in names if name.startswith("vertex")] == [
        *("vertex_dragged", "vertex_dragged", "vertex_drag_finished")
    ]
    dragged = [rest for name, *rest in heard if name == "vertex_dragged"]
    assert dragged[-1] == [1, pytest.approx(22.0, abs=0.05), pytest.approx(6.0, abs=0.05)]
    assert names[0] == "pixel_left"
    assert "pixel_clicked" not in names
    pointed = [rest for name, *rest in heard if name == "pixel_hovered"]
    assert (len(pointed), names[-1]) == (1, "pixel_hovered"), "where the vertex is let go"


@pytest.mark.parametrize("nearest", [0, 1])
def test_of_two_vertices_within_reach_the_nearest_is_taken(grid: PixelGrid, nearest: int) -> None:
    places = np.array([[8.0, 8.0], [8.0, 8.0], [20.0, 3.0]])
    places[1 - nearest, 0] += 3 / grid.placement().cell
    geometry = replace(TRIANGLE, vertices=places)
    assert vertex_near(geometry, grid.placement(), grid.placement().to_widget(8.0, 8.0)) == nearest


def test_shift_rounds_a_dragged_vertex(grid: PixelGrid, heard: Told) -> None:
    grid.show_geometry(TRIANGLE)
    shift = Qt.KeyboardModifier.ShiftModifier
    QTest.mousePress(grid, LEFT, shift, at(grid, 8.0, 13.0))
    end = at(grid, 10.7, 9.1)
    place, everywhere = QPointF(end), QPointF(grid.mapToGlobal(end))
    QApplication.sendEvent(grid, QMouseEvent(QEvent.Type.MouseMove, place, everywhere, LEFT, LEFT, shift))
    QTest.mouseRelease(grid, LEFT, shift, end)
    assert [each for each in heard if each[0] == "vertex_dragged"][-1] == ("vertex_dragged", 2, 10.5, 9.0)


def test_escape_takes_a_drag_back(grid: PixelGrid, heard: Told) -> None:
    grid.show_geometry(TRIANGLE)
    QTest.mousePress(grid, LEFT, NO_KEY, at(grid, 8.0, 13.0))
    QTest.mouseMove(grid, at(grid, 12.0, 9.0))
    QTest.keyClick(grid, Qt.Key.Key_Escape)
    assert heard[-1] == ("vertex_drag_taken_back", 2)
    QTest.mouseRelease(grid, LEFT, NO_KEY, at(grid, 12.0, 9.0))
    assert "vertex_drag_finished" not in {name for name, *_ in heard}


def test_a_vertex_is_not_moved_while_there_are_no_pixels(grid: PixelGrid, heard: Told) -> None:
    grid.show_geometry(TRIANGLE)
    buffer = grid.buffer()
    QTest.mousePress(grid, LEFT, NO_KEY, at(grid, 8.0, 13.0))
    end = at(grid, 12.0, 9.0)
    QTest.mouseMove(grid, at(grid, 10.0, 9.0))
    grid.show_buffer(None)
    heard.clear()
    QTest.mouseMove(grid, at(grid, 0.5, 0.5))
    assert heard == []
    grid.show_buffer(buffer)
    QTest.mouseMove(grid, end)
    assert heard == [("vertex_dragged", 2, pytest.approx(12.0), pytest.approx(9.0))]


def test_a_click_on_a_vertex_is_a_click_on_its_pixel(grid: PixelGrid, heard: Told) -> None:
    grid.show_geometry(TRIANGLE)
    click(grid, at(grid, 20.2, 3.2))
    assert ("pixel_clicked", 20, 3) in heard
    assert "vertex_dragged" not in {name for name, *_ in heard}


def test_a_brush_clicks_every_pixel_once(grid: PixelGrid, heard: Told) -> None:
    grid.set_brush(True)
    QTest.mousePress(grid, LEFT, NO_KEY, at(grid, 3.5, 3.5))
    for x in (3.8, 4.5, 4.9, 5.5):
        QTest.mouseMove(grid, at(grid, x, 3.5))
    QTest.mouseRelease(grid, LEFT, NO_KEY, at(grid, 5.5, 3.5))
    assert [rest for name, *rest in heard if name == "pixel_clicked"] == [[3, 3], [4, 3], [5, 3]]
