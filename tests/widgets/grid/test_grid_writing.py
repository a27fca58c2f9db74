"""What is written on a pixel grid: numbers, names and rulers, none over another; and what it tells of its pixels."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QGuiApplication
from PySide6.QtTest import QTest

from tests.widgets.grid.pixel_grids import LEFT, picture, shown_grid, wheel
from widgets.basics.theme import LIGHT, PRESENTER, Theme, current_theme
from widgets.grid.geometry import GridGeometry
from widgets.grid.layers import GridBuffer
from widgets.grid.marks import StepMark
from widgets.grid.names import name_boxes
from widgets.grid.overlay_paint import corner_glyph
from widgets.grid.paint import number_boxes, number_writing
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.rulers import ruler_labels
from widgets.grid.view import FIT, GridView, place


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


@pytest.mark.parametrize(("zoom", "shown"), [(1.0, False), (1.25, False), (2.0, True), (8.0, True)])
def test_numbers_appear_only_in_large_cells(grid: PixelGrid, zoom: float, shown: bool) -> None:
    grid.set_view(GridView(0.5, 0.5, zoom))
    assert grid.has_numbers() == shown == (grid.placement().cell >= 40)
    rect = grid.placement().cells_rect(12, 8)
    below = picture(grid).copy(rect.adjusted(3, rect.height() / 2 + 4, -3, -3).toRect())
    kinds = {below.pixel(x, y) for x in range(below.width()) for y in range(below.height())}
    assert (len(kinds) > 1) == shown


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
    every_other = np.argwhere(np.indices((8, 8)).sum(axis=0) % 2)
    mark = StepMark(every_other, lines=np.array([[[0.0, 0.3], [8.0, 0.3]]]), trail=trail)
    buffer = widget.buffer()
    assert buffer is not None
    written = [box.toRect() for box, _, _ in widget.names()]
    assert len(written) == 6
    writing = number_writing(placement, buffer, theme)
    assert writing is not None
    inside = {cell for cell in mark.crossed if max(cell) < 8}
    assert inside > {(column, 0) for column in range(8)}
    written += [*number_boxes(placement, buffer, writing, inside)]
    before = picture(widget)
    widget.show_step(mark)
    after = picture(widget)
    assert after != before
    for box in written:
        assert after.copy(box) == before.copy(box)


def test_a_mark_of_pixels_and_lines_reaches_to_both(qtbot) -> None:
    widget = PixelGrid()
    qtbot.addWidget(widget)
    widget.resize(500, 500)
    widget.show_buffer(GridBuffer("z", np.full((8, 8), 5.0)))
    mark = StepMark(np.array([[1, 1], [6, 6]]), lines=np.array([[[3.0, 3.0], [4.0, 4.0]]]))
    assert mark.reach(widget.placement()).contains(widget.placement().cells_rect(1, 1, 6, 6))


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


@pytest.mark.parametrize("cell", [24, 30, 38, 46, 60, 90, 140])
@pytest.mark.parametrize("theme", [LIGHT, PRESENTER])
@pytest.mark.usefixtures("qapp")
def test_the_cross_of_a_failed_depth_touches_no_digit(cell: int, theme: Theme) -> None:
    placement = place(1, 1, QRect(0, 0, cell + 2, cell + 2), GridView())
    for value in (5.0, 12.0, 0.8974):
        writing = number_writing(placement, GridBuffer("depth", np.full((1, 1), value)), theme)
        if writing is None:
            continue
        middle, reach = corner_glyph(placement.cells_rect(0, 0))
        cross = QRectF(middle, middle).adjusted(-reach, -reach, reach, reach)
        ink = QFontMetricsF(writing.font).tightBoundingRect("0" * min(len(f"{value:g}"), writing.width))
        ink.moveCenter(placement.cells_rect(0, 0).center() + QPointF(0, writing.top + writing.height / 2))
        assert not cross.intersects(ink), value
