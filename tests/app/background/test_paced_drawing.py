"""Drawing at a pace: at once, then seldom, and never what nobody sees."""

import pytest
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from app.pages.experiment_page import PAUSE, PacedDrawing


@pytest.fixture
def page(qtbot: QtBot) -> QWidget:
    found = QWidget()
    qtbot.addWidget(found)
    return found


def drawings(page: QWidget) -> tuple[PacedDrawing, list[int]]:
    pace, drawn = PacedDrawing(page), []
    pace.due.connect(lambda: drawn.append(1))
    return pace, drawn


@pytest.mark.slow
def test_many_parts_are_drawn_at_once_and_once_more(page: QWidget, qtbot: QtBot) -> None:
    pace, drawn = drawings(page)
    page.show()
    for _ in range(400):
        pace.ask()
    assert len(drawn) == 1, "the first is drawn without waiting"
    qtbot.waitUntil(lambda: len(drawn) == 2)
    qtbot.wait(2 * PAUSE)
    assert len(drawn) == 2, "after the last part nothing is drawn again"


def test_a_hidden_page_is_drawn_when_it_is_shown(page: QWidget, qtbot: QtBot) -> None:
    pace, drawn = drawings(page)
    for _ in range(400):
        pace.ask()
    qtbot.wait(2 * PAUSE)
    assert drawn == []
    page.show()
    assert drawn == [1]


def test_what_has_been_drawn_is_not_owed(page: QWidget) -> None:
    pace, drawn = drawings(page)
    pace.ask()
    pace.settle()
    page.show()
    QApplication.processEvents()
    assert drawn == []
