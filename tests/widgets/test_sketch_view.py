"""A sketch in space is drawn obliquely: z runs to the left and down."""

import pytest
from PySide6.QtGui import QColor
from pytestqt.qtbot import QtBot

from core.records.cells import Sketch
from widgets.basics.theme import current_theme
from widgets.exercises.question_view import SketchView


@pytest.mark.parametrize(
    ("place", "at"), [((3, 2, 0), (3, 2)), ((0, 0, 3), (-1.05, -1.05)), ((3, -1, 2), (2.3, -1.7))]
)
def test_a_point_in_space_is_painted_where_its_axes_lead(
    qtbot: QtBot, place: tuple[float, ...], at: tuple[float, float]
) -> None:
    view = SketchView()
    qtbot.addWidget(view)
    view.show_sketch(Sketch((("N", place),), (((0, 0, 0), place),)))
    view.resize(320, 320)
    image, unit = view.grab().toImage(), 160 / (3 + 1)
    ink = QColor(current_theme().text)
    assert image.pixelColor(round(160 + unit * at[0]), round(160 - unit * at[1])) == ink
    assert image.pixelColor(round(160 + unit * at[0] / 2), round(160 - unit * at[1] / 2)) == ink
