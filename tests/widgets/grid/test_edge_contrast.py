"""Edges, vertices and fragments are told from what they lie on: measured from the pixels of a grid."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor, QImage
from pytestqt.qtbot import QtBot

from widgets.basics.theme import DARK, LIGHT, Theme, contrast, paint_as
from widgets.grid.geometry import GridGeometry
from widgets.grid.layers import GridBuffer
from widgets.grid.pixel_grid import PixelGrid

LEAST = 3.0
CORNERS = np.array([[2.0, 2.0], [18.0, 3.0], [9.0, 17.0]])
GROUNDS = ("#000000", "#202326", "#404040", "#56b4e9", "#8a8a8a", "#f4f5f6", "#ffffff", "#0072B2", "#E69F00")


def painted(qtbot: QtBot, ground: str, known: np.ndarray | None = None) -> tuple[PixelGrid, QImage]:
    """Return a grid with a triangle over a ground of one colour, and its picture."""
    grid = PixelGrid()
    qtbot.addWidget(grid)
    grid.resize(500, 500)
    color = QColor(ground)
    values = np.tile(np.array([color.red(), color.green(), color.blue()], np.uint8), (20, 20, 1))
    grid.show_buffer(GridBuffer("color", values, "color", known=known))
    grid.show_geometry(GridGeometry(CORNERS, np.array([[0, 1, 2]])))
    return grid, grid.grab().toImage()


def across(image: QImage, place: QPointF, way: QPointF) -> list[str]:
    """Return the colours along a short line through a place, in half pixels."""
    points = (place + way * (step / 2) for step in range(-16, 17))
    return [image.pixelColor(point.toPoint()).name() for point in points]


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
def test_edges_stand_out_from_every_ground(qtbot: QtBot, theme: Theme) -> None:
    with paint_as(theme):
        for ground in GROUNDS:
            grid, image = painted(qtbot, ground)
            placement = grid.placement()
            for edge in range(3):
                first, second = (
                    placement.to_widget(*CORNERS[k].tolist()) for k in ((edge + 1) % 3, (edge + 2) % 3)
                )
                along = second - first
                length = np.hypot(along.x(), along.y())
                way = QPointF(-along.y(), along.x()) / length
                colors = across(image, first + along * 0.3, way)
                centre = colors[len(colors) // 2 - 2 : len(colors) // 2 + 3]
                middle = min(centre, key=lambda color: contrast(color, theme.vertex[edge]))
                around = colors[len(colors) // 2 - 9 : len(colors) // 2 + 10]
                assert contrast(middle, theme.vertex[edge]) < 1.3, (ground, edge)
                assert max(contrast(middle, other) for other in around) >= LEAST, (ground, edge)
                assert max(contrast(ground, other) for other in around) >= LEAST, (ground, edge)


@pytest.mark.parametrize(("theme", "ground"), [(LIGHT, "#ffffff"), (LIGHT, "#f0e442"), (DARK, "#000000")])
def test_a_fragment_as_light_as_the_grid_is_outlined(qtbot: QtBot, theme: Theme, ground: str) -> None:
    known = np.zeros((20, 20), bool)
    known[12:15, 3:6] = True
    with paint_as(theme):
        grid, image = painted(qtbot, ground, known)
        box = grid.placement().cells_rect(3, 12, 3, 3)
        for side, way in (
            (QPointF(box.left(), box.center().y() + 6), QPointF(1, 0)),
            (QPointF(box.right(), box.center().y() + 6), QPointF(1, 0)),
            (QPointF(box.center().x() + 6, box.top()), QPointF(0, 1)),
            (QPointF(box.center().x() + 6, box.bottom()), QPointF(0, 1)),
        ):
            colors = across(image, side, way)[8:-8]
            for inside in (ground, theme.empty):
                assert max(contrast(color, inside) for color in colors) >= LEAST, (side, colors)


def test_an_edge_is_named_beside_its_line(qtbot: QtBot) -> None:
    """Names are drawn where the line is long enough, and not in a thumbnail."""
    with paint_as(LIGHT):
        _, image = painted(qtbot, "#ffffff")
        wanted = [QColor(color).name() for color in LIGHT.vertex_text]
        seen = {image.pixelColor(x, y).name() for x in range(0, 500) for y in range(150, 350)}
        # Vertices have the same colours, but none lies in these rows; edge 0's name stands at the right.
        assert set(wanted[:2]) <= seen
