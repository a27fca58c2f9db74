"""A | B | difference: the pictures stand where they are largest."""

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from widgets.grid.compare_view import CompareView, Side
from widgets.grid.layers import GridBuffer


@pytest.fixture
def view(qtbot: QtBot) -> CompareView:
    shown = CompareView()
    qtbot.addWidget(shown)
    buffer = GridBuffer("depth", np.zeros((48, 64)))
    shown.show_sides(*(Side(name, name, sentence=f"of {name}", buffer=buffer) for name in ("A", "B", "D")))
    shown.show_choices(False)
    shown.resize(1200, 500)
    shown.show()
    return shown


def sizes(view: CompareView) -> set[tuple[int, int]]:
    return {(grid.width(), grid.height()) for grid in view.grids}


def test_the_difference_stands_below_where_that_makes_the_pictures_larger(
    view: CompareView, qtbot: QtBot
) -> None:
    assert len({grid.mapTo(view, grid.rect().topLeft()).y() for grid in view.grids}) == 1
    view.resize(700, 700)
    qtbot.waitUntil(lambda: min(sizes(view))[0] > 300)
    first, second, difference = (grid.mapTo(view, grid.rect().topLeft()) for grid in view.grids)
    assert first.y() == second.y() < difference.y()
    assert [note.text() for note in view.notes] == ["A: of A", "B: of B", "D: of D"]
    assert all(note.visibleRegion().boundingRect().height() == note.height() for note in view.notes)
    view.resize(1200, 500)
    qtbot.waitUntil(lambda: len({grid.mapTo(view, grid.rect().topLeft()).y() for grid in view.grids}) == 1)
    assert [note.text() for note in view.notes] == ["of A", "of B", "of D"]


def test_long_sentences_are_whole_beside_the_difference_and_leave_the_pictures_their_size(
    view: CompareView, qtbot: QtBot
) -> None:
    view.resize(760, 900)
    qtbot.waitUntil(lambda: min(sizes(view))[0] > 300)
    before = sizes(view)
    long = "Pixel (8, 3) is drawn, since its centre lies at the second end of the segment. " * 3
    buffer = GridBuffer("depth", np.zeros((48, 64)))
    view.show_sides(*(Side(name, name, sentence=long, buffer=buffer) for name in ("A", "B", "D")))
    qtbot.waitUntil(lambda: all(note.height() >= note.heightForWidth(note.width()) for note in view.notes))
    assert sizes(view) == before


def test_long_sentences_take_no_room_of_the_pictures(view: CompareView, qtbot: QtBot) -> None:
    view.resize(700, 600)
    qtbot.waitUntil(lambda: view.linked.is_folded)
    QApplication.processEvents()
    before = sizes(view)
    buffer = GridBuffer("depth", np.zeros((48, 64)))
    view.show_sides(
        *(Side(name, name, sentence="A long story. " * 60, buffer=buffer) for name in ("A", "B", "D"))
    )
    QApplication.processEvents()
    assert sizes(view) == before


def test_pictures_are_seen_where_large_type_leaves_little_room(view: CompareView, qtbot: QtBot) -> None:
    view.resize(700, 12 * view.fontMetrics().lineSpacing())
    qtbot.waitUntil(lambda: min(height for _, height in sizes(view)) > 5 * view.fontMetrics().lineSpacing())
    assert not any(note.isVisible() for note in view.notes)
    view.resize(1200, 600)
    qtbot.waitUntil(lambda: all(note.isVisible() for note in view.notes))
