"""Outlines as a kept picture: the same lines as painted directly, whatever was shown before."""

import numpy as np
import pytest
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QImage, QPainter, QRegion

from widgets.basics.theme import DARK, LIGHT, Theme
from widgets.grid.canvas import OutlineLayer
from widgets.grid.geometry import GridGeometry, outline_lines, paint_focus, paint_outlines
from widgets.grid.names import name_boxes
from widgets.grid.view import GridPlacement, GridView, place

pytestmark = pytest.mark.usefixtures("qapp")
AREA = QRect(0, 0, 160, 120)


def placed(zoom: float = 1.0) -> GridPlacement:
    return place(16, 12, AREA, GridView(zoom=zoom))


def geometry_at(x: float, focus: int = 1) -> GridGeometry:
    """Return two triangles, by default with the second in focus; a corner of the first at (x, 10)."""
    vertices = np.array([[1.0, 1.0], [14.0, 2.0], [x, 10.0], [2.0, 11.0], [5.0, 11.0], [2.0, 8.0]])
    return GridGeometry(vertices, np.array([[0, 1, 2], [3, 4, 5]]), focus=focus)


def on_canvas(paint) -> np.ndarray:
    """Return (120, 160, 4) uint8, what was painted onto grey."""
    image = QImage(AREA.size(), QImage.Format.Format_RGB32)
    image.fill(Qt.GlobalColor.gray)
    with QPainter(image) as painter:
        paint(painter)
    return np.array(image.constBits()).reshape(120, 160, 4)


def by_layer(layer: OutlineLayer, placement: GridPlacement, geometry: GridGeometry, theme: Theme = LIGHT):
    return on_canvas(lambda painter: layer.paint_others(painter, placement, AREA, geometry, theme))


def directly(placement: GridPlacement, geometry: GridGeometry, theme: Theme = LIGHT):
    return on_canvas(lambda painter: paint_outlines(painter, outline_lines(placement, geometry), theme))


def below_and_above(below: GridGeometry, above: GridGeometry, free: QRegion | None) -> np.ndarray:
    """Return the outlines of one geometry under the triangle in focus of another."""
    layer = OutlineLayer()

    def paint(painter: QPainter) -> None:
        layer.paint_others(painter, placed(), AREA, below, LIGHT)
        names = name_boxes(placed(), above, LIGHT)
        layer.paint_focus(painter, AREA, placed(), above, LIGHT, None, free, names)

    return on_canvas(paint)


def is_alike(first: np.ndarray, second: np.ndarray, most: int = 30) -> bool:
    """Tell whether two pictures differ by rounding, or where a few halos cross."""
    difference = np.abs(first.astype(int) - second.astype(int)).max(axis=2)
    return np.count_nonzero(difference > 3) <= most


def test_an_edge_of_two_triangles_is_one_line() -> None:
    corners = np.array([[1.0, 1.0], [14.0, 2.0], [5.0, 10.0], [14.0, 2.0], [1.0, 1.0], [9.0, 0.5]])
    apart = GridGeometry(corners, np.arange(6).reshape(2, 3), focus=-1)
    assert len(outline_lines(placed(), apart)) == 5
    nowhere = np.full((3, 2), np.nan)
    partly = GridGeometry(np.concatenate([corners, nowhere]), np.arange(9).reshape(3, 3), focus=0)
    assert len(outline_lines(placed(), partly)) == 5


def test_the_picture_is_what_is_painted_directly() -> None:
    for theme in (LIGHT, DARK):
        painted = by_layer(OutlineLayer(), placed(), geometry_at(5.0), theme)
        assert is_alike(painted, directly(placed(), geometry_at(5.0), theme), most=60)
        assert not is_alike(painted, on_canvas(lambda painter: None))


def test_what_was_shown_before_leaves_nothing_behind() -> None:
    layer = OutlineLayer()
    for x in (5.0, 9.0, 5.0):
        for theme in (LIGHT, DARK):
            for zoom in (1.0, 2.0, 1.0):
                shown = placed(zoom), geometry_at(x), theme
                assert np.array_equal(by_layer(layer, *shown), by_layer(OutlineLayer(), *shown))


def test_more_places_than_are_kept_are_all_right() -> None:
    layer, geometry = OutlineLayer(most=2), geometry_at(5.0)
    zooms = np.linspace(1.0, 3.0, 5).tolist()
    for zoom in (*zooms, *zooms):
        assert np.array_equal(
            by_layer(layer, placed(zoom), geometry), by_layer(OutlineLayer(), placed(zoom), geometry)
        )


def test_the_triangle_in_focus_is_as_painted_directly() -> None:
    layer, geometry = OutlineLayer(), geometry_at(5.0)
    for held in (None, 4, None):
        for free in (QRegion(AREA), QRegion(0, 0, 40, 120), None):
            shown = placed(), geometry, LIGHT, held, free, name_boxes(placed(), geometry, LIGHT)
            expected = on_canvas(lambda painter, shown=shown: paint_focus(painter, *shown))
            for _ in range(2):
                kept = on_canvas(lambda painter, shown=shown: layer.paint_focus(painter, AREA, *shown))
                assert is_alike(kept, expected)


@pytest.mark.parametrize("free", [QRegion(AREA), None])
def test_the_triangle_in_focus_hides_its_own_outline(free: QRegion | None) -> None:
    for focus in (0, 1):
        shown = geometry_at(5.0, focus)
        alone = GridGeometry(shown.vertices, shown.triangles[[1 - focus]], focus=-1)
        assert np.array_equal(*(below_and_above(below, shown, free) for below in (shown, alone)))
    assert geometry_at(5.0, 0).outline_key == geometry_at(5.0, 1).outline_key


def test_a_point_in_focus_has_no_outline() -> None:
    points = GridGeometry(np.array([[1.0, 1.0], [9.0, 2.0]]), np.array([[0, 0, 0], [1, 1, 1]]), focus=1)
    assert points.outlined.tolist() == [[0, 0, 0]]


def test_a_lone_triangle_in_focus_has_no_outline() -> None:
    alone = GridGeometry(np.array([[1.0, 1.0], [14.0, 2.0], [5.0, 10.0]]), np.array([[0, 1, 2]]))
    nothing = on_canvas(lambda painter: None)
    assert np.array_equal(by_layer(OutlineLayer(), placed(), alone), nothing)


def test_a_handle_on_the_border_of_the_raster_is_whole_and_one_beyond_it_is_cut_off() -> None:
    inner = AREA.adjusted(20, 20, -20, -20)
    placement = place(16, 12, inner, GridView())

    def around(x: float, y: float) -> np.ndarray:
        vertex = GridGeometry(np.array([[x, y]]), np.zeros((1, 3), int), focus=0)
        picture = on_canvas(lambda p: paint_focus(p, placement, vertex, LIGHT, None, QRegion(inner), []))
        column, row = round(placement.left + x * placement.cell), round(placement.bottom - y * placement.cell)
        return picture[row - 12 : row + 12, column - 12 : column + 12]

    whole = around(8, 6)
    assert np.unique(whole.reshape(-1, 4), axis=0).shape[0] > 2
    for corner in ((0, 0), (16, 0), (16, 12), (0, 12), (5, 0)):
        assert np.array_equal(around(*corner), whole), corner
    assert (around(8, -1) == around(8, -1)[-1, 0]).all(axis=2)[14:].all(), "nothing below the viewport"
