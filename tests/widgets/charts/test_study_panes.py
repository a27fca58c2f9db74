"""The controls, the table, the list and the pictures of a study: real clicks, keys and typing."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QRect, QSize, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QWidget
from pytestqt.qtbot import QtBot

from tests.widgets.showing import shown
from widgets.basics.controls import ElidedLabel, FlowLayout
from widgets.basics.message_bar import Progress
from widgets.experiments.case_pictures import PicturesRecord, StudyPictures
from widgets.experiments.controls import DialChoice, FamilyEntry, FamilyList, StudyChoices, StudyControls
from widgets.experiments.series import Cell, StudyTable, TableRecord
from widgets.grid.layers import GridBuffer

KEY, LEFT = Qt.Key, Qt.MouseButton.LeftButton
SIGNALS = ("chosen", "dial_chosen")
CHOICES = StudyChoices(
    works=[("any", "Any ends"), ("pixel", "Pixel ends")],
    work="any",
    dials=(DialChoice("length", "Length", "pixels", (4, 8, 16, 64), 16),),
    measures=[("mean", "Mean distance"), ("area", "Area")],
    measure="mean",
    costs=[("time", "Time per line"), ("bytes", "Bytes")],
    cost="time",
    rounds=9,
    seed=0,
)


@pytest.fixture
def controls(qtbot: QtBot) -> StudyControls:
    made = StudyControls()
    made.show_choices(CHOICES)
    made.told = []
    for name in (*SIGNALS, "start_requested", "cancel_requested"):
        getattr(made, name).connect(lambda *args, name=name: made.told.append((name, *args)))
    return shown(qtbot, made, 900, 120)


def test_what_the_user_chooses_is_told_and_what_is_shown_is_not(controls: StudyControls) -> None:
    for box in (controls.work_box, controls.measure_box, controls.cost_box):
        QTest.keyClick(box, KEY.Key_Down)
    dial = controls.dial("length")
    QTest.keyClick(dial.slider, KEY.Key_Right)
    for typed in ("10", "9999"):
        dial.field.edit.selectAll()
        QTest.keyClicks(dial.field.edit, typed)
        QTest.keyClick(dial.field.edit, KEY.Key_Return)
    assert controls.told == [
        ("chosen", "work", "pixel"),
        ("chosen", "measure", "area"),
        ("chosen", "cost", "bytes"),
        ("dial_chosen", "length", 64.0),
        ("dial_chosen", "length", 10.0),
    ]
    assert (dial.slider.value(), dial.field.error_text()) == (1, "expected a number between 4 and 64")
    other = DialChoice("size", "Size", "", (1, 2), 2)
    controls.show_choices(
        StudyChoices([("m", "Mesh")], "m", (other,), [("e", "E")], "e", [("time", "T")], "time", 3, 7)
    )
    assert len(controls.told) == 5
    shown_now = controls.rounds_box.value(), controls.seed_box.value(), controls.dial("size").field.value()
    assert shown_now == (3, 7, 2)


def test_measuring_shows_progress_and_a_way_out(controls: StudyControls) -> None:
    QTest.mouseClick(controls.start_button, LEFT)
    controls.show_progress(Progress("Bresenham, round 2 of 9", 40, 100))
    assert (controls.start_button.isVisible(), controls.doing.text()) == (False, "Bresenham, round 2 of 9")
    QTest.mouseClick(controls.cancel_button, LEFT)
    for width in (620, 760, 900, 990):
        controls.resize(width, 200)
        controls.layout().activate()
        assert controls.doing.mapTo(controls, controls.doing.rect().topRight()).x() <= controls.width()
    controls.show_progress(None)
    assert (controls.start_button.isVisible(), controls.cancel_button.isVisible()) == (True, False)
    assert controls.told == [("start_requested",), ("cancel_requested",)]


def test_controls_begin_a_new_line_rather_than_be_cut(controls: StudyControls) -> None:
    assert controls.heightForWidth(420) > controls.heightForWidth(1400)
    controls.resize(420, 400)
    assert controls.minimumHeight() == controls.heightForWidth(420)
    for box in (controls.work_box, controls.cost_box, controls.seed_box):
        assert controls.rect().contains(box.mapTo(controls, box.rect().bottomRight()))


def test_a_flow_places_items_in_order_and_goes_on_in_the_next_line(qtbot: QtBot) -> None:
    pane = QWidget()
    qtbot.addWidget(pane)
    flow = FlowLayout(pane, 10)
    labels = [QLabel("x", pane) for _ in range(4)]
    for label in labels:
        label.setFixedSize(QSize(100, 20))
    for label in labels[1:]:
        flow.addWidget(label)
    flow.insert_widget(0, labels[0])
    flow.setGeometry(QRect(0, 0, 330, 100))
    assert [(label.x(), label.y()) for label in labels] == [(0, 0), (110, 0), (220, 0), (0, 30)]
    assert (flow.heightForWidth(330), flow.heightForWidth(100)) == (50, 110)
    assert (flow.count(), flow.takeAt(9), flow.itemAt(0).widget()) == (4, None, labels[0])


def test_a_long_text_is_elided_and_read_in_full_in_the_tooltip(qtbot: QtBot) -> None:
    label = ElidedLabel()
    qtbot.addWidget(label)
    label.resize(60, 20)
    looks = []
    for count in (20, 30):
        label.setText("a very long text " * count)
        assert (label.minimumSizeHint().width(), label.toolTip()) == (0, "a very long text " * count)
        looks.append(label.grab().toImage())
    assert looks[0] == looks[1]


TABLE = TableRecord(
    ("Method", "Time", "Note"),
    ("dda", "wu", "bres", "rect"),
    (
        (Cell("DDA"), Cell("12.3 µs", 1.2345e-5, "1.2345e-05"), Cell("")),
        (Cell("Wu"), Cell("–"), Cell("It was refused.")),
        (Cell("Bresenham"), Cell("9 µs", 9e-6, "9e-06"), Cell("")),
        (Cell("Rectangle"), Cell("1 ms", 1e-3, "0.001"), Cell("")),
    ),
)


@pytest.fixture
def table(qtbot: QtBot) -> StudyTable:
    made = shown(qtbot, StudyTable(), 700, 300)
    made.show_table(TABLE)
    return made


def column(table: StudyTable, number: int) -> list[str]:
    return [str(table.model().index(row, number).data()) for row in range(table.model().rowCount())]


def test_a_click_on_a_heading_sorts_by_size_with_the_unmeasured_last(table: StudyTable) -> None:
    header = table.horizontalHeader()
    seen = [column(table, 1)]
    for _ in range(2):
        QTest.mouseClick(header.viewport(), LEFT, pos=QPoint(header.sectionViewportPosition(1) + 10, 8))
        seen.append(column(table, 1))
    table.show_table(TABLE)
    rising, falling = ["9 µs", "12.3 µs", "1 ms", "–"], ["1 ms", "12.3 µs", "9 µs", "–"]
    assert [*seen, column(table, 1)] == [["12.3 µs", "–", "9 µs", "1 ms"], rising, falling, falling]


def test_rows_are_copied_with_all_digits_and_chosen_by_their_method(table: StudyTable) -> None:
    QTest.keyClick(table, KEY.Key_C, Qt.KeyboardModifier.ControlModifier)
    lines = QGuiApplication.clipboard().text().splitlines()
    assert (lines[:2], len(lines)) == (["Method\tTime\tNote", "DDA\t1.2345e-05\t"], 5)
    table.selectRow(2)
    assert table.text().splitlines()[1:] == ["Bresenham\t9e-06\t"]
    chosen: list[str] = []
    table.row_chosen.connect(chosen.append)
    table.activated.emit(table.model().index(2, 0))
    assert chosen == ["bres"]


def test_a_table_without_numbers_says_what_comes_there(table: StudyTable) -> None:
    table.show_table(TableRecord((), (), ()))
    empty = table.viewport().grab().toImage()
    table.show_table(TableRecord(("Method",), (), ()))
    assert table.viewport().grab().toImage() != empty


def test_families_are_chosen_ticked_and_set_off(qtbot: QtBot) -> None:
    families, chosen = FamilyList(), []
    qtbot.addWidget(families)
    families.family_chosen.connect(chosen.append)
    rows = [
        FamilyEntry("all", "All", "", True, ends_group=True),
        FamilyEntry("a", "A"),
        FamilyEntry("b", "B"),
    ]
    families.show_families(rows, "all")
    families.resize(200, 2000)
    families.show()
    heights = [families.visualItemRect(families.item(row)).height() for row in range(3)]
    assert heights[0] > heights[1] == heights[2]
    assert sum(heights) <= families.height() <= max(sum(heights) + 4, families.minimumSizeHint().height())
    ticked, plain = (families.item(row).icon().pixmap(16, 16).toImage() for row in (0, 1))
    assert ticked != plain
    QTest.keyClick(families, KEY.Key_Down)
    assert chosen == ["a"]


@pytest.fixture
def pictures(qtbot: QtBot) -> StudyPictures:
    made = shown(qtbot, StudyPictures(), 900, 320)
    result, reference = np.arange(12, dtype=np.float32).reshape(3, 4), np.full((3, 4), 5, np.float32)
    named = (("picture", result, "scalar"), ("reference", reference, "scalar"))
    buffers = (*(GridBuffer(*each) for each in named), GridBuffer("difference", result - reference, "signed"))
    made.show_pictures(
        PicturesRecord("DDA: 11 differ", buffers, ("DDA", "Reference", "Difference"), can_step=True)
    )
    return made


def test_one_pixel_is_read_in_all_three_pictures_by_mouse_and_arrows(pictures: StudyPictures) -> None:
    first, middle, last = pictures.linked.grids
    QTest.mouseMove(middle, middle.placement().cells_rect(3, 2).center().toPoint())
    assert pictures.values.text() == "pixel (3, 2): picture 11, reference 5, difference 6"
    QTest.mouseClick(middle, LEFT, pos=middle.placement().cells_rect(1, 0).center().toPoint())
    assert [each.pin() for each in (first, middle, last)] == [(1, 0)] * 3
    QTest.mouseClick(middle, LEFT, pos=middle.placement().cells_rect(1, 0).center().toPoint())
    assert pictures.pin is None
    QTest.mouseClick(middle, LEFT, pos=middle.placement().cells_rect(1, 0).center().toPoint())
    seen = []
    for key, held in ((KEY.Key_Right, "No"), (KEY.Key_Up, "No"), (KEY.Key_Left, "Shift")):
        QTest.keyClick(last, key, Qt.KeyboardModifier[f"{held}Modifier"])
        seen.append(pictures.pin)
    assert seen == [(2, 0), (2, 1), (0, 1)]
    first.zoom_by(3.0)
    assert len({grid.view() for grid in pictures.linked.grids}) == 1


def test_only_what_is_possible_is_offered(pictures: StudyPictures, qtbot: QtBot) -> None:
    offered = pictures.step_button.isEnabled(), pictures.divergence_button.isVisible()
    assert offered == (True, False)
    with qtbot.waitSignal(pictures.step_requested):
        QTest.mouseClick(pictures.step_button, LEFT)
    pictures.show_waiting("Drawing …")
    assert (pictures.heading.text(), pictures.step_button.isEnabled()) == ("Drawing …", False)
    assert all(grid.buffer() is None for grid in pictures.linked.grids)
