"""The border between panes."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from widgets.basics.panes import PaneSplitter
from widgets.basics.theme import current_theme


def test_the_grip_hides_nothing_of_the_panes(qtbot: QtBot) -> None:
    splitter = PaneSplitter(Qt.Orientation.Horizontal)
    qtbot.addWidget(splitter)
    for _ in range(2):
        pane = QWidget(splitter)
        pane.setStyleSheet("background: #ff0000")
        splitter.addWidget(pane)
    splitter.resize(300, 200)
    splitter.show()
    picture = splitter.grab().toImage()
    left, right = (splitter.widget(number).geometry() for number in range(2))
    for x in (left.right(), right.left()):
        assert picture.pixelColor(x, 100).name() == "#ff0000"


@pytest.mark.parametrize("direction", [Qt.Orientation.Horizontal, Qt.Orientation.Vertical])
def test_the_ring_of_the_focus_goes_around_the_grip(qtbot: QtBot, direction: Qt.Orientation) -> None:
    splitter = PaneSplitter(direction)
    qtbot.addWidget(splitter)
    for _ in range(2):
        splitter.addWidget(QWidget())
    splitter.resize(300, 200)
    with qtbot.waitActive(splitter):
        splitter.show()
        splitter.activateWindow()
    border = splitter.handle(1)
    border.clearFocus()
    border.setFocus(Qt.FocusReason.TabFocusReason)
    picture, middle = border.grab().toImage(), border.rect().center()

    def is_ring(x: int, y: int) -> bool:
        return border.mask().contains(QPoint(x, y)) and picture.pixelColor(x, y).name() == focus

    focus = current_theme().focus
    row = [is_ring(x, middle.y() - 3) for x in range(picture.width())]
    column = [is_ring(middle.x() - 3, y) for y in range(picture.height())]
    assert (sum(row), sum(column)) == (4, 4), "two pixels at each of its four sides"
    border.clearFocus()
