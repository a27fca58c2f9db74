"""The bar that asks for a text: Enter hands it on, Escape closes, a problem stays until something else is typed."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from widgets.basics.prompts import AskBar


def test_enter_hands_the_text_on_and_escape_closes(qtbot: QtBot) -> None:
    bar = AskBar()
    qtbot.addWidget(bar)
    bar.ask("pixel", "Go to pixel", "as 12, 7")
    assert bar.isVisible()
    QTest.keyClicks(bar.field, "3, 4")
    with qtbot.waitSignal(bar.text_entered) as entered:
        QTest.keyClick(bar.field, Qt.Key.Key_Return)
    assert entered.args == ["pixel", "3, 4"]
    bar.show_problem("not in the raster")
    assert bar.hint.text() == "not in the raster"
    QTest.keyClicks(bar.field, "1")
    assert bar.hint.text() == "as 12, 7"
    with qtbot.waitSignal(bar.closed):
        QTest.keyClick(bar, Qt.Key.Key_Escape)
    assert not bar.isVisible()
