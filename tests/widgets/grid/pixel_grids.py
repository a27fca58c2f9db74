"""A pixel grid in a window, and what a user does to it."""

import numpy as np
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QImage, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from tests.widgets.showing import shown
from widgets.grid.geometry import GridGeometry
from widgets.grid.layers import GridBuffer
from widgets.grid.pixel_grid import PixelGrid

LEFT = Qt.MouseButton.LeftButton
TRIANGLE = GridGeometry(np.array([[2.0, 2.0], [20.0, 3.0], [8.0, 13.0]]), np.array([[0, 1, 2]]))


def shown_grid(qtbot) -> PixelGrid:
    """Return a grid of 24 x 16 pixels in a window."""
    widget = PixelGrid()
    widget.show_buffer(GridBuffer("z", np.linspace(0, 1, 24 * 16).reshape(16, 24).astype(np.float32)))
    return shown(qtbot, widget, 800, 560)


def at(grid: PixelGrid, x: float, y: float) -> QPoint:
    return grid.placement().to_widget(x, y).toPoint()


def wheel(grid: PixelGrid, position: QPoint, notches: int) -> None:
    event = QWheelEvent(
        QPointF(position),
        QPointF(grid.mapToGlobal(position)),
        QPoint(),
        QPoint(0, 120 * notches),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(grid, event)


def drag(grid: PixelGrid, start: QPoint, end: QPoint, button: Qt.MouseButton = LEFT) -> None:
    QTest.mousePress(grid, button, Qt.KeyboardModifier.NoModifier, start)
    QTest.mouseMove(grid, (start + end) / 2)
    QTest.mouseMove(grid, end)
    QTest.mouseRelease(grid, button, Qt.KeyboardModifier.NoModifier, end)


def picture(widget: QWidget) -> QImage:
    return widget.grab().toImage()


def color_at(grid: PixelGrid, column: int, row: int) -> str:
    rect = grid.placement().cells_rect(column, row)
    return (
        picture(grid)
        .pixelColor((rect.topLeft() + QPointF(rect.width() * 0.25, rect.height() * 0.25)).toPoint())
        .name()
    )
