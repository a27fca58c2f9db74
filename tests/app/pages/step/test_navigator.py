"""The way from a whole model into a triangle and back: opening, going in, the navigator."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.files.open_any import open_any
from app.session.document import open_document
from app.views.scene_picture import fractions
from app.views.view_space import viewing_camera, viewing_matrix
from app.window.main_window import MainWindow
from core.records.steps import Level
from lessons.run_place import FIRST_STEP
from lessons.scenes import built_in_scene

pytestmark = pytest.mark.shared_window


@pytest.fixture
def model(window: MainWindow) -> MainWindow:
    """Return the window with a mesh of many triangles, as it opens."""
    scene = built_in_scene("torus")
    window.session.open(open_document(scene.make(), scene.title))
    window.session.set_stage("transform", 0)
    window.page.show_own_view()
    QApplication.processEvents()
    return window


def test_a_model_fills_the_view_that_it_opens_in(model: MainWindow) -> None:
    assert model.page.current_view() == "scene"
    presenter = model.page.views.scene_presenter
    space = presenter.space
    view = model.page.main_view()
    camera = viewing_camera(space, view.orbit())
    matrix = viewing_matrix(camera, view.picture_size())
    places = fractions(matrix, space.vertices.world[:, :3])
    size = np.ptp(places, axis=0)
    assert size.max() >= 0.5
    assert places.min() >= 0
    assert places.max() <= 1


def test_one_key_goes_into_the_triangle_and_one_back(model: MainWindow) -> None:
    view = model.page.main_view()
    home = view.orbit()
    model.run_action("fit_region")
    assert view.orbit().extent < home.extent / 4
    model.page.show_view("pixels")
    document = model.session.document
    assert document.raster.origin is not None
    assert model.page.navigator.isVisible()
    model.session.set_stage("raster", 0)
    model.run_action("whole_picture")
    assert model.page.current_view() == "scene"
    assert view.chosen_orbit() is None
    assert model.session.document.triangle == document.triangle
    model.run_action("fit_region")
    assert model.page.current_view() == "pixels"
    assert model.page.navigator.isVisible()


def test_a_click_on_a_model_goes_into_the_triangle(model: MainWindow) -> None:
    view, presenter = model.page.main_view(), model.page.views.scene_presenter
    home = view.orbit()
    presenter._take_picked(700)
    assert model.session.document.triangle == 700
    assert view.orbit().extent < home.extent / 4


@pytest.mark.own_window
def test_the_navigator_moves_the_region(model: MainWindow, qtbot: QtBot) -> None:
    page = model.page
    page.show_view("pixels")
    QApplication.processEvents()
    navigator = page.navigator
    qtbot.waitUntil(lambda: not page.navigation.is_drawing)
    before = model.session.document.raster
    width = model.session.document.scene.size[0]
    region = navigator.region()
    assert region.width() == pytest.approx(before.columns / width)
    start = navigator._box().center().toPoint()
    QTest.mousePress(navigator, Qt.MouseButton.LeftButton, pos=start)
    QTest.mouseMove(navigator, QPointF(start.x() - 20, start.y() + 10).toPoint())
    QTest.mouseRelease(navigator, Qt.MouseButton.LeftButton, pos=start)
    qtbot.waitUntil(lambda: model.session.document.raster != before)
    after = model.session.document.raster
    assert after.origin[0] < before.origin[0]
    assert after.origin[1] < before.origin[1]
    assert "F goes back to it" in model.statusBar().currentMessage()
    page.grid.setFocus()
    navigator.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(navigator, Qt.Key.Key_Right)
    qtbot.waitUntil(lambda: model.session.document.raster != after)
    moved = model.session.document.raster.origin
    assert moved[0] > after.origin[0]
    model.session.undo()
    model.session.undo()
    assert model.session.document.raster == before


def test_the_navigator_pans_a_magnified_grid_and_can_be_hidden(window: MainWindow) -> None:
    page = window.page
    assert not page.navigator.isVisible()
    page.grid.zoom_by(4.0)
    assert page.navigator.isVisible()
    before = page.grid.view()
    page.navigator.region_moved.emit(0.2, 0.5)
    assert page.grid.view().x < before.x
    assert page.grid.view().zoom == before.zoom
    assert "of 64" in page.navigator.accessibleDescription()
    page.navigator.close_button.click()
    assert not page.navigator.isVisible()
    assert "navigator" not in page.shown_panes()
    window.run_action("pane_navigator")
    assert page.navigator.isVisible()
    window.run_action("predict")
    assert not page.navigator.isVisible()


def test_the_navigator_keeps_off_the_step(window: MainWindow) -> None:
    page, session = window.page, window.session
    page.grid.zoom_by(1.5)
    session.set_level(Level.PIXEL)
    trace = session.stage_trace
    geometry = page.navigator.geometry()
    placement = page.grid.placement()
    hidden = next(
        row
        for row, (column, line) in enumerate(trace.pixel.tolist())
        if geometry.contains(placement.cells_rect(column, line).toRect())
    )
    session.go_to(trace.steps.position_after(hidden))
    cell = placement.cells_rect(*trace.pixel[hidden].tolist()).toRect()
    assert not page.navigator.geometry().intersects(cell)


@pytest.mark.slow
def test_the_navigator_hides_no_vertex_where_a_corner_is_free(window: MainWindow) -> None:
    page, session = window.page, window.session
    window.resize(1280, 800)
    session.open(open_document(built_in_scene("teapot").make(), "Teapot"))
    page.show_view("pixels")
    session.set_stage("raster", 0)
    QApplication.processEvents()
    placement, document = page.grid.placement(), session.document
    assert document.triangle is not None
    vertices = session.trace.source.geometry.vertices
    window = vertices.window[vertices.corners[document.triangle], :2] - np.array(placement.origin)
    box = page.navigator.geometry()
    assert not any(box.contains(placement.to_widget(*place).toPoint()) for place in window.tolist())


def test_the_navigator_shows_the_outline_until_the_run_is_done(window: MainWindow, qtbot: QtBot) -> None:
    page, session = window.page, window.session
    page.grid.zoom_by(2.0)
    qtbot.waitUntil(lambda: not page.navigation.is_drawing)

    def colors() -> set[int]:
        image = page.navigator._image
        return {image.pixelColor(x, y).rgb() for x in range(image.width()) for y in range(image.height())}

    outline = colors()
    assert {color & 0xFFFFFF for color in outline} <= {0x808080, 0}
    session.set_stage("resolve", session.trace.stage("resolve").steps.count)
    assert len(colors() - outline) >= 2, "the colours of both triangles"
    session.step(-1)
    assert colors() == outline


@pytest.mark.slow
def test_the_navigator_leaves_the_numbers_beside_the_raster(window: MainWindow) -> None:
    page, session = window.page, window.session
    session.open(open_document(built_in_scene("teapot").make(), "Teapot"))
    session.set_stage("edges", 11)
    page.settle()
    raster = page.grid.placement().seen_raster
    assert page.navigator.isVisible()
    assert raster.left() <= page.navigator.geometry().left()


@pytest.mark.slow
def test_a_mesh_opens_large_from_its_front_also_when_it_opens_again(window: MainWindow) -> None:
    opened, page = replace(open_any("torus"), place=FIRST_STEP), window.page
    window.files.show_opened(opened)
    page.settle()
    view = page.main_view()
    first = view.orbit()
    assert np.abs(first.azimuth) < np.pi / 3, "a face that looks along +z is seen"
    view.zoom_by(8.0)
    page.grid.zoom_by(4.0)
    window.files.show_opened(opened)
    page.settle()
    assert view.orbit() == first
    assert page.grid.view().zoom == 1


def test_a_click_beside_the_model_says_so(model: MainWindow) -> None:
    model.page.views.scene_presenter._take_picked(-1)
    assert "No triangle is here" in model.statusBar().currentMessage()
