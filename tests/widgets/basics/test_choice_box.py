"""The list of a combo box shows every choice whole, though the box itself is narrow."""

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from widgets.basics.choice_box import MOST_SEEN, ChoiceBox
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import LIGHT, PRESENTER, Theme


@pytest.mark.parametrize("theme", [LIGHT, PRESENTER], ids=lambda theme: theme.name)
@pytest.mark.parametrize("count", [3, MOST_SEEN, MOST_SEEN + 5])
def test_no_choice_is_cut_off(qtbot: QtBot, theme: Theme, count: int) -> None:
    application = QApplication.instance()
    apply_theme(application, theme)
    box = ChoiceBox()
    qtbot.addWidget(box)
    for number in range(count):
        box.addItem(f"Bounding box, by additions, number {number}")
    box.resize(90, box.sizeHint().height())
    box.show()
    qtbot.waitExposed(box)
    box.showPopup()
    view = box.view()
    qtbot.waitUntil(view.isVisible)
    application.processEvents()
    assert view.viewport().width() >= view.sizeHintForColumn(0)
    assert (view.verticalScrollBar().maximum() == 0) == (count <= MOST_SEEN)
    needed = sum(view.sizeHintForRow(row) for row in range(min(count, MOST_SEEN)))
    assert view.viewport().height() >= needed
    box.hidePopup()
    apply_theme(application, LIGHT)


def test_a_word_that_is_longer_than_a_box_is_shortened_not_cut(qtbot) -> None:
    box = ChoiceBox(most_rows=3)
    qtbot.addWidget(box)
    box.addItem("Bresenham, integers")
    box.resize(90, 60)
    rows = box.shown_rows()
    assert rows[0].endswith("…")
    assert max(map(box.fontMetrics().horizontalAdvance, rows)) < box.width()
