"""What a pixel grid paints, and what it tells of its pixels."""

import gc
import weakref

import numpy as np
import pytest
from PySide6.QtCore import QBuffer, QEvent, QIODevice, QObject, QPoint, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QGuiApplication, QImage, QPainter
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from tests.widgets.grid.pixel_grids import LEFT, TRIANGLE, at, color_at, picture, shown_grid, wheel
from widgets.basics.theme import current_theme
from widgets.grid.geometry import GridGeometry, handle_part
from widgets.grid.layers import CellMark, GridBuffer, MaskOverlay
from widgets.grid.marks import StepMark
from widgets.grid.names import name_boxes
from widgets.grid.paint import number_boxes, number_writing
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.rulers import ruler_labels
from widgets.grid.view import FIT, GridView


@pytest.fixture
def grid(qtbot) -> PixelGrid:
    return shown_grid(qtbot)


def test_no_line_crosses_the_numbers_of_the_rulers(qtbot) -> None:
    widget = PixelGrid()
    qtbot.addWidget(widget)
    # Narrow: the raster does not fill the viewport, and the rulers stand at the raster.
    widget.resize(400, 700)
    widget.show_buffer(GridBuffer("z", np.zeros((16, 24), np.float32)))
    widget.show()
    qtbot.waitExposed(widget)
    labels = ruler_labels(widget.placement(), widget.rect(), current_theme())
    columns = [box for box, _ in labels if QRectF(widget.placement().viewport).contains(box.center())]
    assert columns
    before = picture(widget)
    steep = np.array([[x + 0.5, y] for x in range(24) for y in (-30.0, 20.0)])
    corners = np.array([[2 * k, 2 * k + 1, (2 * k + 2) % 48] for k in range(24)])
    for focus in (0, -1):
        widget.show_geometry(GridGeometry(steep, corners, focus=focus))
        after = picture(widget)
        assert after != before
        for box in columns:
            area = box.adjusted(0, 4, 0, 0).toRect()  # A line along the border keeps its width.
            assert after.copy(area) == before.copy(area)


def test_an_edge_along_the_border_of_the_picture_keeps_its_width(qtbot) -> None:
    widget = PixelGrid()
    qtbot.addWidget(widget)
    widget.resize(700, 500)
    widget.show_buffer(GridBuffer("coverage", np.zeros((3, 4), bool)))
    widget.show_geometry(GridGeometry(np.array([[0.0, 0], [4, 0], [0, 3]]), np.array([[0, 1, 2]])))
    image, place = picture(widget), widget.placement()
    casing = [image.pixelColor(round(place.left) - 2, y).lightness() < 64 for y in range(60, 440)]
    assert all(casing)


def test_the_rulers_say_what_they_count_where_there_is_room(qtbot) -> None:
    widget = PixelGrid()
    qtbot.addWidget(widget)
    widget.resize(700, 500)
    for size, wanted in (
        ((3, 4), {"column 0", "row\n0", "1"}),
        ((6, 8), {"0", "column 1", "row\n0"}),
        ((48, 64), {"0", "10"}),
    ):
        widget.show_buffer(GridBuffer("z", np.zeros(size, np.float32)))
        labels = ruler_labels(widget.placement(), widget.rect(), current_theme())
        assert wanted <= {text for _, text in labels}


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


@pytest.mark.parametrize(("zoom", "shown"), [(1.0, False), (1.25, False), (2.0, True), (8.0, True)])
def test_numbers_appear_only_in_large_cells(grid: PixelGrid, zoom: float, shown: bool) -> None:
    grid.set_view(GridView(0.5, 0.5, zoom))
    assert grid.has_numbers() == shown == (grid.placement().cell >= 40)
    rect = grid.placement().cells_rect(12, 8)
    below = picture(grid).copy(rect.adjusted(3, rect.height() / 2 + 4, -3, -3).toRect())
    kinds = {below.pixel(x, y) for x in range(below.width()) for y in range(below.height())}
    assert (len(kinds) > 1) == shown


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


def test_hidden_cells_do_not_tell_their_values(grid: PixelGrid) -> None:
    grid.set_view(GridView(0.5, 0.5, 3.0))
    hidden = np.zeros((16, 24), np.bool_)
    hidden[8, 12] = True
    grid.show_hidden(hidden)
    assert grid.value_text((12, 8)) == "?"
    assert grid.value_text((12, 8), digits=0) == "?"
    covered = picture(grid)
    buffer = grid.buffer()
    assert buffer is not None
    values = np.array(buffer.values)
    values[8, 12] = 0.123
    grid.show_buffer(GridBuffer("z", values))
    rect = grid.placement().cells_rect(12, 8).adjusted(2, 2, -2, -2).toRect()
    assert picture(grid).copy(rect) == covered.copy(rect)
    grid.show_hidden(None)
    assert grid.value_text((12, 8)) == "0.123"
    assert picture(grid).copy(rect) != covered.copy(rect)
    with pytest.raises(ValueError, match="hidden must have the shape"):
        grid.show_hidden(np.zeros((2, 2), np.bool_))


def test_copy_takes_the_pinned_value_in_full(grid: PixelGrid) -> None:
    values = np.full((16, 24), -1 / 3)
    grid.show_buffer(GridBuffer("z", values))
    grid.show_pin((3, 3))
    QTest.keyClick(grid, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert float(QGuiApplication.clipboard().text()) == -1 / 3


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


def test_names_for_those_who_do_not_see(grid: PixelGrid) -> None:
    grid.show_buffer(GridBuffer("depth", np.full((16, 24), 0.5), title="depth z"))
    grid.show_pin((2, 3))
    assert "depth z" in grid.accessibleName()
    assert grid.spoken_description() == "Pinned pixel 2, 3: 0.5"


def test_an_empty_grid_says_so(qtbot) -> None:
    grid = PixelGrid()
    qtbot.addWidget(grid)
    grid.resize(300, 200)
    grid.show()
    silent = PixelGrid()
    silent.empty_text = ""
    qtbot.addWidget(silent)
    silent.resize(300, 200)
    assert picture(grid) != picture(silent)
    QTest.mouseMove(grid, QPoint(50, 50))
    QTest.mouseClick(grid, LEFT, Qt.KeyboardModifier.NoModifier, QPoint(50, 50))
    wheel(grid, QPoint(50, 50), 1)
    assert grid.view() == FIT


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


def test_a_table_of_whole_numbers_is_written_large(grid: PixelGrid) -> None:
    values = np.full((16, 24), np.inf)
    grid.set_view(GridView(0.5, 0.5, 2.0))
    inked = []
    for number in (7.25, 7.0):
        values[8, 12] = number
        grid.show_buffer(GridBuffer("depth", values.copy(), range=(0, 9)))
        rect = grid.placement().cells_rect(12, 8).adjusted(3, 3, -3, -3).toRect()
        cell = picture(grid).copy(rect)
        inked.append(
            len({y for y in range(cell.height()) if len({cell.pixel(x, y) for x in range(cell.width())}) > 1})
        )
    assert inked[1] > inked[0]


def test_no_mark_of_a_step_strikes_out_what_is_written(qtbot) -> None:
    widget = PixelGrid()
    qtbot.addWidget(widget)
    widget.resize(500, 500)
    widget.show_buffer(GridBuffer("z", np.full((8, 8), 5.0)))
    geometry = GridGeometry(np.array([[1.0, 1.0], [7.0, 1.5], [3.0, 7.0]]), np.array([[0, 1, 2]]))
    widget.show_geometry(geometry)
    theme, placement = current_theme(), widget.placement()
    trail = np.array([[0, 6], [5, 6], [0, 4]])
    mark = StepMark(lines=np.array([[[0.0, 0.6], [8.0, 0.6]]]), trail=trail)
    buffer = widget.buffer()
    assert buffer is not None
    written = [box.toRect() for box, _, _ in widget.names()]
    assert len(written) == 6
    writing = number_writing(placement, buffer, theme)
    assert writing is not None
    written += [*number_boxes(placement, buffer, writing, mark.crossed)]
    before = picture(widget)
    widget.show_step(mark)
    after = picture(widget)
    assert after != before
    for box in written:
        assert after.copy(box) == before.copy(box)


def test_names_of_edges_stand_beside_numbers_and_the_pin_beside_names(qtbot) -> None:
    widget = PixelGrid()
    qtbot.addWidget(widget)
    widget.resize(500, 500)
    geometry = GridGeometry(np.array([[0.5, 0.5], [6.5, 0.5], [0.5, 6.5]]), np.array([[0, 1, 2]]))
    widget.show_geometry(geometry)
    widget.show_buffer(GridBuffer("1/w", np.full((7, 7), 0.53125)))
    theme, placement, buffer = current_theme(), widget.placement(), widget.buffer()
    assert buffer is not None
    writing = number_writing(placement, buffer, theme)
    assert writing is not None
    numbers = number_boxes(placement, buffer, writing, {(x, y) for x in range(7) for y in range(7)})
    assert numbers.intersects(name_boxes(placement, geometry, theme)[5][0].toRect())
    edges = [box.toRect() for box, name, _ in widget.names() if name.startswith("E")]
    assert len(edges) == 3
    assert not any(numbers.intersects(box) for box in edges)
    before = picture(widget)
    widget.show_pin((3, 0))
    after = picture(widget)
    assert after != before
    assert all(after.copy(box) == before.copy(box) for box in edges)


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


def test_nothing_is_written_where_a_picture_is_cleared(qtbot) -> None:
    widget = PixelGrid()
    qtbot.addWidget(widget)
    widget.resize(500, 500)
    values = np.zeros((2, 2, 4), np.uint8)
    values[0, 0] = 255
    buffer = GridBuffer("display", values, "color")
    widget.show_buffer(buffer)
    writing = number_writing(widget.placement(), buffer, current_theme())
    assert writing is not None
    taken = [number_boxes(widget.placement(), buffer, writing, {(column, 0)}).isEmpty() for column in (0, 1)]
    assert taken == [False, True]


def test_a_first_whole_number_leaves_no_centre_in_other_cells(qtbot) -> None:
    known = np.zeros((6, 6), bool)
    values = np.full((6, 6), 0.0)
    pictures = []
    for is_stepped in (True, False):
        widget = PixelGrid()
        qtbot.addWidget(widget)
        widget.resize(360, 360)
        if is_stepped:
            widget.show_buffer(GridBuffer("z", values, known=known, range=(0.0, 7.0)))
            picture(widget)
        after, is_known = values.copy(), known.copy()
        after[5, 0], is_known[5, 0] = 7.0, True
        widget.show_buffer(GridBuffer("z", after, known=is_known, range=(0.0, 7.0)))
        pictures.append(picture(widget))
    assert pictures[0] == pictures[1]
