"""What a pixel grid paints, and that it paints no more than has changed."""

import gc
import weakref

import numpy as np
import pytest
from PySide6.QtCore import QBuffer, QEvent, QIODevice, QObject, QPoint, QSize, Qt
from PySide6.QtGui import QColor, QImage, QPainter
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from tests.widgets.grid.pixel_grids import TRIANGLE, at, color_at, picture, shown_grid
from widgets.basics.theme import current_theme
from widgets.grid.geometry import GridGeometry, handle_part
from widgets.grid.layers import CellMark, GridBuffer, MaskOverlay
from widgets.grid.marks import StepMark
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.view import GridView


@pytest.fixture
def grid(qtbot) -> PixelGrid:
    return shown_grid(qtbot)


def test_an_edge_along_the_border_of_the_picture_keeps_its_width(qtbot) -> None:
    widget = PixelGrid()
    qtbot.addWidget(widget)
    widget.resize(700, 500)
    widget.show_buffer(GridBuffer("coverage", np.zeros((3, 4), bool)))
    widget.show_geometry(GridGeometry(np.array([[0.0, 0], [4, 0], [0, 3]]), np.array([[0, 1, 2]])))
    image, place = picture(widget), widget.placement()
    casing = [image.pixelColor(round(place.left) - 2, y).lightness() < 64 for y in range(60, 440)]
    assert all(casing)


class Painted(QObject):
    count = 0

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        self.count += event.type() == QEvent.Type.Paint
        return False


def test_row_0_is_drawn_at_the_bottom(grid: PixelGrid) -> None:
    mask = np.zeros((16, 24), np.bool_)
    mask[0, 0] = True
    grid.show_buffer(GridBuffer("c", mask, "bool"))
    assert color_at(grid, 0, 0) == current_theme().covered
    assert color_at(grid, 0, 15) == current_theme().empty
    rect = grid.placement().cells_rect(0, 0)
    assert rect.center().y() > grid.height() / 2
    assert rect.center().x() < grid.width() / 2


@pytest.mark.parametrize(
    "vertices",
    [
        [[1e9, 2e9], [-1e9, 5.0], [8.0, -3e9]],
        [[np.nan, np.nan], [4.0, 4.0], [8.0, 9.0]],
        [[np.inf, 0.0], [-np.inf, 4.0], [8.0, 9.0]],
        [[1e308, -1e308], [-1e308, 1e308], [1e-308, 0.0]],
        [[3.0, 3.0], [3.0, 3.0], [3.0, 3.0]],
    ],
)
def test_far_away_geometry_does_no_harm(grid: PixelGrid, vertices: list[list[float]]) -> None:
    places = np.array(vertices)
    grid.show_geometry(GridGeometry(places, np.array([[0, 1, 2], [2, 1, 0]]), snapped=places))
    for zoom in (1.0, 30.0):
        grid.set_view(GridView(0.5, 0.5, zoom))
        assert not picture(grid).isNull()
    QTest.mouseMove(grid, at(grid, 5.5, 5.5))


def test_an_edge_through_far_vertices_is_where_it_belongs(grid: PixelGrid) -> None:
    plain = picture(grid)
    far = np.array([[5.0, 1e9], [-1e9, 8.5], [1e9, 8.5]])
    grid.show_geometry(GridGeometry(far, np.array([[0, 1, 2]])))
    drawn = picture(grid)
    rect = grid.placement().cells_rect(3, 8).toRect()
    middle, top = rect.center(), QPoint(rect.center().x() + 7, rect.top() + 5)
    assert drawn.pixel(middle + QPoint(7, 0)) != plain.pixel(middle + QPoint(7, 0))
    assert drawn.pixel(top) == plain.pixel(top)


def test_lines_stay_thin_at_every_zoom(grid: PixelGrid) -> None:
    grid.show_buffer(GridBuffer("c", np.zeros((16, 24), np.bool_), "bool"))
    flat = np.array([[12.0, 400.0], [-400.0, 8.25], [400.0, 8.25]])
    for zoom in (1.0, 6.0, 13.0):
        grid.show_geometry(None)
        grid.set_view(GridView(0.5, 0.5, zoom))
        before = picture(grid)
        grid.show_geometry(GridGeometry(flat, np.array([[0, 1, 2]])))
        after = picture(grid)
        x = int(grid.placement().to_widget(12.6, 0).x())
        changed = sum(before.pixel(x, y) != after.pixel(x, y) for y in range(10, grid.height() - 30))
        assert 2 <= changed <= 8


def test_marks_change_only_their_surroundings(grid: PixelGrid) -> None:
    plain = picture(grid)
    for show in (grid.show_hover, grid.show_pin):
        show((10, 7))
        marked = picture(grid)
        assert marked != plain
        far = grid.placement().cells_rect(14, 2, 6, 4).toRect()
        assert marked.copy(far) == plain.copy(far)
        show(None)
        assert picture(grid) == plain
    grid.show_step(StepMark(np.array([[10, 7], [11, 7]])))
    accent = QColor(current_theme().accent)
    stepped = picture(grid)
    edge = grid.placement().cells_rect(10, 7).topLeft().toPoint() + QPoint(8, 0)
    assert stepped.pixelColor(edge) == accent
    # The two pixels are outlined as one region: nothing between them.
    between = grid.placement().cells_rect(11, 7)
    inside = QPoint(int(between.left()), int(between.center().y()) + 5)
    assert stepped.pixelColor(inside) == plain.pixelColor(inside)
    grid.show_step(StepMark())
    assert picture(grid) == plain


def test_a_step_outside_of_the_raster_does_no_harm(grid: PixelGrid) -> None:
    plain = picture(grid)
    grid.show_step(StepMark(np.array([[-5, 3], [400, 2]])))
    assert picture(grid) == plain
    grid.show_step(StepMark())
    assert picture(grid) == plain
    with pytest.raises(ValueError, match="pixels must be"):
        StepMark(np.zeros(3, np.int64))


@pytest.mark.parametrize("zoom", [1.0, 2.5])
def test_partial_painting_equals_painting_everything(grid: PixelGrid, qtbot, zoom: float) -> None:
    random = np.random.default_rng(5)
    values = random.random((16, 24)).astype(np.float32)
    mask, known = random.random((16, 24)) < 0.3, random.random((16, 24)) < 0.7
    values[8:] = 1.0  # pale: outlined where they meet cells without a value
    grid.set_view(GridView(0.5, 0.5, zoom))
    fresh = PixelGrid()
    qtbot.addWidget(fresh)
    fresh.resize(grid.size())
    fresh.set_view(grid.view())
    grid.show_geometry(TRIANGLE)
    for index in range(12):
        values, mask = values.copy(), mask.copy()
        column, row = random.integers(0, 24), random.integers(0, 16)
        values[row, column] = np.nan if index % 4 == 3 else random.random()
        mask[row, column] ^= True
        marks = (CellMark.REJECTED, CellMark.TIE, CellMark.DEPTH_FAILED, CellMark.COVERED)
        overlays = [MaskOverlay(mark.name, mark, mask) for mark in marks]
        buffer = GridBuffer("z", values, range=(0, 1), known=known)
        step = np.array([[column, row]])
        for widget in (grid, fresh):
            if widget is fresh:
                widget.show_buffer(None)
            widget.show_geometry(TRIANGLE)
            widget.show_buffer(buffer)
            widget.show_overlays(overlays)
            widget.show_step(StepMark(step, trail=step + np.array([[-1, 0], [0, 0]])))
        QApplication.processEvents()
        assert picture(grid) == picture(fresh), index


def test_a_cell_under_the_trail_is_painted_as_with_everything(grid: PixelGrid) -> None:
    # Part of a smooth line is not what the whole line is there: its pixels differed by 1 of 255.
    places = np.stack((np.arange(8) * 5 % 24, np.arange(8) * 7 % 16), axis=1)
    values = np.random.default_rng(3).random((16, 24))
    grid.show_step(StepMark(places[-1:], trail=places))
    for column, row in ((10, 7), (14, 3), (6, 10), (17, 9)):
        values = values.copy()
        values[row, column] = 1.0 - values[row, column]
        grid.show_buffer(GridBuffer("z", values, range=(0, 1)))
        QApplication.processEvents()
        in_parts = grid.screen().grabWindow(grid.winId()).toImage()
        grid.repaint()
        assert in_parts == grid.screen().grabWindow(grid.winId()).toImage()


def test_another_range_or_place_is_painted_as_with_everything(grid: PixelGrid, qtbot) -> None:
    values = np.random.default_rng(3).random((16, 24))
    for buffer in (
        GridBuffer("z", values),
        GridBuffer("z", 2 * values),
        GridBuffer("z", 2 * values, origin=(40, 7)),
        GridBuffer("z", values > 0.5, "bool", origin=(40, 7)),
    ):
        grid.show_buffer(buffer)
        QApplication.processEvents()
        in_parts = grid.screen().grabWindow(grid.winId()).toImage()
        grid.repaint()
        assert in_parts == grid.screen().grabWindow(grid.winId()).toImage()
        fresh = PixelGrid()
        qtbot.addWidget(fresh)
        fresh.resize(grid.size())
        fresh.show_buffer(buffer)
        assert picture(grid) == picture(fresh)


def test_the_same_again_paints_nothing(grid: PixelGrid, qtbot) -> None:
    values = np.arange(384.0).reshape(16, 24)
    mask = values > 100
    step = np.array([[1, 1]])

    def show() -> None:
        grid.show_buffer(GridBuffer("z", values.copy()))
        grid.show_overlays([MaskOverlay("c", CellMark.COVERED, mask.copy())])
        grid.show_step(StepMark(step.copy()))
        grid.show_pin((2, 2))
        grid.show_hover((3, 3))
        grid.set_view(GridView(0.5, 0.5, 1.5))

    show()
    QApplication.processEvents()
    watcher = Painted()
    grid.installEventFilter(watcher)
    show()
    QApplication.processEvents()
    assert watcher.count == 0
    grid.show_hover((4, 4))
    qtbot.waitUntil(lambda: watcher.count == 1)


def test_focus_is_shown_for_the_keyboard_only(grid: PixelGrid) -> None:
    def corner() -> QColor:
        return picture(grid).pixelColor(1, 1)

    grid.clearFocus()
    plain = corner()
    grid.setFocus(Qt.FocusReason.MouseFocusReason)
    assert corner() == plain
    grid.clearFocus()
    grid.setFocus(Qt.FocusReason.TabFocusReason)
    assert corner() == QColor(current_theme().focus)


def test_another_size_of_raster_drops_what_belonged_to_the_old(grid: PixelGrid) -> None:
    hidden = np.ones((16, 24), np.bool_)
    grid.show_hidden(hidden)
    grid.show_overlays([MaskOverlay("c", CellMark.COVERED, hidden)])
    grid.show_pin((23, 15))
    grid.show_buffer(GridBuffer("z", np.zeros((4, 5))))
    assert not picture(grid).isNull()
    assert grid.value_text((4, 3)) == "0"
    assert grid.value_text((23, 15)) == ""


def test_integer_centres_move_the_triangle(grid: PixelGrid) -> None:
    half = grid.placement().to_widget(2.5, 2.5)
    grid.set_pixel_center("integer")
    assert grid.placement().to_widget(2.0, 2.0) == half
    with pytest.raises(ValueError, match="got 'corner'"):
        grid.set_pixel_center("corner")


def test_the_view_is_written_as_vectors(grid: PixelGrid) -> None:
    grid.show_geometry(TRIANGLE)
    target = QBuffer()
    target.open(QIODevice.OpenModeFlag.WriteOnly)
    generator = QSvgGenerator()
    generator.setOutputDevice(target)
    generator.setSize(QSize(800, 560))
    painter = QPainter(generator)
    grid.paint_to(painter)
    painter.end()
    text = bytes(target.data().data()).decode()
    assert text.count("<polyline") + text.count("<path") > 5
    assert "#0072b2" in text.lower()


def test_a_grid_goes_away_cleanly(qtbot) -> None:
    grid = PixelGrid()
    grid.show_buffer(GridBuffer("z", np.zeros((4, 4))))
    grid.show()
    QApplication.processEvents()
    gone = weakref.ref(grid)
    grid.close()
    grid.deleteLater()
    del grid
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    QApplication.processEvents()
    gc.collect()
    assert gone() is None


@pytest.mark.parametrize(
    ("corners", "part"),
    [
        ([[2.0, 2.0], [20.0, 3.0], [8.0, 13.0]], 1.0),
        ([[2.0, 2.0], [2.4, 2.0], [8.0, 13.0]], 0.62),
        ([[2.0, 2.0], [2.0, 2.0], [8.0, 13.0]], 0.4),
        ([[2.0, 2.0], [np.nan, np.nan], [np.inf, 13.0]], 1.0),
    ],
)
def test_handles_are_smaller_on_a_tiny_triangle(grid: PixelGrid, corners, part: float) -> None:
    assert grid.placement().cell == 31
    geometry = GridGeometry(np.array(corners), np.array([[0, 1, 2]]))
    assert handle_part(grid.placement(), geometry) == pytest.approx(part)


@pytest.mark.parametrize("focus", [0, -1])
@pytest.mark.parametrize("is_kept", [True, False])
def test_no_line_of_a_thumbnail_leaves_its_frame(qtbot, focus: int, is_kept: bool) -> None:
    widget = PixelGrid(compact=True)
    qtbot.addWidget(widget)
    widget.resize(300, 100)
    widget.show_buffer(GridBuffer("z", np.zeros((16, 16), np.float32)))
    far = np.array([[-99.0, 3.0], [99.0, 5.0], [8.0, 13.0]])
    widget.show_geometry(GridGeometry(far, np.array([[0, 1, 2]]), focus))
    widget.show()
    qtbot.waitExposed(widget)
    if is_kept:
        shown = picture(widget)
    else:
        shown = QImage(widget.size(), QImage.Format.Format_RGB32)
        QWidget.render(widget, shown, QPoint())
    panel = QColor(current_theme().panel)
    left = range(int(widget.placement().left) - 1)
    assert len(left) > 80
    assert all(shown.pixelColor(x, y) == panel for x in left for y in range(100))
    inside = {shown.pixelColor(150, y).name() for y in range(10, 90)}
    assert len(inside) > 1


def test_a_vertex_hides_no_value_of_the_pinned_pixel(qtbot) -> None:
    widget = PixelGrid()
    qtbot.addWidget(widget)
    widget.resize(500, 500)
    corners = np.array([[4.5, 4.5], [8.5, 4.5], [8.5, 2.5]])
    widget.show_geometry(GridGeometry(corners, np.array([[0, 1, 2]])))
    widget.show_buffer(GridBuffer("overdraw", np.full((9, 9), 16)))
    middle = at(widget, 4.5, 4.5)
    vertex = QColor(current_theme().vertex[0])
    assert picture(widget).pixelColor(middle) == vertex
    widget.show_pin((4, 4))
    around = picture(widget).copy(middle.x() - 20, middle.y() - 12, 40, 24)
    shades = [around.pixelColor(x, y).lightness() for x in range(40) for y in range(24)]
    assert picture(widget).pixelColor(middle) != vertex
    assert sum(shade > 200 for shade in shades) > 200, "the ground of the number"
    assert sum(shade < 80 for shade in shades) > 20, "its digits"
    hidden = np.zeros((9, 9), bool)
    hidden[4, 4] = True
    widget.show_hidden(hidden)
    assert picture(widget).pixelColor(middle) == vertex


def test_the_pin_of_a_pixel_at_the_border_is_whole(qtbot) -> None:
    widget = PixelGrid()
    qtbot.addWidget(widget)
    widget.resize(700, 400)  # The raster is as high as the view.
    widget.show_buffer(GridBuffer("coverage", np.zeros((1, 1), bool)))
    widget.show_pin((0, 0))
    image, bottom = picture(widget), round(widget.placement().bottom)
    black = [
        sum(image.pixelColor(x, y).lightness() < 32 for x in range(700))
        for y in range(bottom - 8, bottom + 2)
    ]
    assert max(black) >= 20, "two brackets"
