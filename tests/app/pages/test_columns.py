"""The three columns of the Step page keep the widths that they were dragged to."""

from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from app.pages.columns import StepColumns


def test_dragged_widths_stay_and_presenting_leaves_them(qtbot: QtBot) -> None:
    page = QWidget()
    qtbot.addWidget(page)
    columns = StepColumns(page)
    columns.show_columns(QWidget(), QWidget(), QWidget())
    columns.resize(1900, 700)
    page.resize(1900, 700)
    page.show()
    columns.setSizes([410, 1040, 440])
    dragged = columns.sizes()
    columns.splitterMoved.emit(410, 1)
    columns.spread()
    assert columns.sizes() == dragged
    columns.set_presenting(True)
    assert columns.sizes()[2] > dragged[2]
    columns.splitterMoved.emit(400, 1)
    columns.set_presenting(False)
    assert columns.sizes() == dragged
