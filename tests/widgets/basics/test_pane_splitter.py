"""The border between panes."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from widgets.basics.panes import PaneSplitter


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
