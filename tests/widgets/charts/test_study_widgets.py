"""The controls, the table and the pictures of a study: real clicks, keys and typing."""

import numpy as np
import pytest
from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QWidget
from pytestqt.qtbot import QtBot

from tests.widgets.showing import shown
from widgets.basics.flow_layout import FlowLayout
from widgets.basics.labels import ElidedLabel
from widgets.basics.message_bar import Progress
from widgets.charts.dial_control import DialChoice
from widgets.charts.family_list import FamilyEntry, FamilyList
from widgets.charts.study_controls import StudyChoices, StudyControls
from widgets.charts.study_pictures import PicturesRecord, StudyPictures
from widgets.charts.study_table import Cell, StudyTable, TableRecord
from widgets.grid.buffer import GridBuffer

LENGTH = DialChoice("length", "Length", "pixels", (4, 8, 16, 64), 16)
CHOICES = StudyChoices(
    works=[("any", "Any ends"), ("pixel", "Pixel ends")],
    work="any",
    dials=(LENGTH,),
    measures=[("mean", "Mean distance"), ("area", "Area")],
    measure="mean",
    costs=[("time", "Time per line"), ("bytes", "Bytes")],
    cost="time",
    rounds=9,
    seed=2,
)


@pytest.fixture
def controls(qtbot: QtBot) -> StudyControls:
    made = StudyControls()
    made.show_choices(CHOICES)
    return shown(qtbot, made, 900, 120)


def test_a_dial_is_slid_and_typed(controls: StudyControls, qtbot: QtBot) -> None:
    dial = controls.dial("length")
    dial.slider.setFocus()
    with qtbot.waitSignal(controls.dial_chosen) as chosen:
        QTest.keyClick(dial.slider, Qt.Key.Key_Right)
    assert chosen.args == ["length", 64.0]
    assert dial.field.value() == 64
    dial.field.edit.selectAll()
    QTest.keyClicks(dial.field.edit, "10")
    with qtbot.waitSignal(controls.dial_chosen) as chosen:
        QTest.keyClick(dial.field.edit, Qt.Key.Key_Return)
    assert chosen.args == ["length", 10.0]
    assert dial.slider.value() == 1, "the nearest stop"
    with qtbot.assertNotEmitted(controls.dial_chosen):
        dial.field.edit.selectAll()
        QTest.keyClicks(dial.field.edit, "9999")
        QTest.keyClick(dial.field.edit, Qt.Key.Key_Return)
    assert dial.field.error_text() == "expected a number between 4 and 64"


@pytest.mark.parametrize(
    ("name", "value"),
    [("work", "pixel"), ("measure", "area"), ("cost", "bytes"), ("rounds", 8), ("seed", 1)],
)
def test_choices_are_told_by_name(controls: StudyControls, qtbot: QtBot, name: str, value: str | int) -> None:
    box = getattr(controls, f"{name}_box")
    box.setFocus()
    with qtbot.waitSignal(controls.chosen) as chosen:
        QTest.keyClick(box, Qt.Key.Key_Down)
    assert chosen.args == [name, value]


def test_showing_emits_nothing(controls: StudyControls, qtbot: QtBot) -> None:
    with qtbot.assertNotEmitted(controls.chosen), qtbot.assertNotEmitted(controls.dial_chosen):
        other = DialChoice("size", "Size", "", (1, 2), 2)
        controls.show_choices(
            StudyChoices([("m", "Mesh")], "m", (other,), [("e", "E")], "e", [("time", "T")], "time", 3, 7)
        )
    assert controls.rounds_box.value() == 3
    assert controls.seed_box.value() == 7
    assert controls.dial("size").field.value() == 2


def test_measuring_shows_progress_and_a_way_out(controls: StudyControls, qtbot: QtBot) -> None:
    assert not controls.cancel_button.isVisible()
    with qtbot.waitSignal(controls.start_requested):
        QTest.mouseClick(controls.start_button, Qt.MouseButton.LeftButton)
    controls.show_progress(Progress("Bresenham, round 2 of 9", 40, 100))
    assert not controls.start_button.isVisible()
    assert controls.doing.text() == "Bresenham, round 2 of 9"
    with qtbot.waitSignal(controls.cancel_requested):
        QTest.mouseClick(controls.cancel_button, Qt.MouseButton.LeftButton)
    controls.show_progress(None)
    assert controls.start_button.isVisible()


def test_controls_begin_a_new_line_rather_than_be_cut(controls: StudyControls) -> None:
    wide = controls.heightForWidth(1400)
    assert controls.heightForWidth(420) > wide
    controls.resize(420, 400)
    assert controls.minimumHeight() == controls.heightForWidth(420)
    for box in (controls.work_box, controls.cost_box, controls.seed_box):
        place = box.mapTo(controls, box.rect().bottomRight())
        assert controls.rect().contains(place)


def test_a_flow_places_items_in_order(qtbot: QtBot) -> None:
    pane = QWidget()
    qtbot.addWidget(pane)
    flow = FlowLayout(pane, 10)
    labels = [QLabel("x", pane) for _ in range(4)]
    for label in labels:
        label.setFixedSize(QSize(100, 20))
    for label in labels[1:]:
        flow.addWidget(label)
    flow.insert_widget(0, labels[0])
    pane.resize(330, 100)
    pane.show()
    qtbot.waitExposed(pane)
    assert [(label.x(), label.y()) for label in labels] == [(0, 0), (110, 0), (220, 0), (0, 30)]
    assert flow.heightForWidth(330) == 50
    assert flow.heightForWidth(100) == 110
    assert (flow.count(), flow.takeAt(9), flow.itemAt(0).widget()) == (4, None, labels[0])


def test_a_long_text_is_elided_and_read_in_full_in_the_tooltip(qtbot: QtBot) -> None:
    label = ElidedLabel()
    qtbot.addWidget(label)
    label.setText("a very long text " * 20)
    label.resize(60, 20)
    assert label.minimumSizeHint().width() == 0
    assert label.toolTip() == "a very long text " * 20
    narrow = label.grab().toImage()
    label.setText("a very long text " * 30)
    assert label.grab().toImage() == narrow


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


def click_heading(table: StudyTable, number: int) -> None:
    header = table.horizontalHeader()
    x = header.sectionViewportPosition(number) + 10
    QTest.mouseClick(header.viewport(), Qt.MouseButton.LeftButton, pos=header.rect().center().__class__(x, 8))


def test_a_click_on_a_heading_sorts_by_size_with_the_unmeasured_last(table: StudyTable) -> None:
    assert column(table, 0) == ["DDA", "Wu", "Bresenham", "Rectangle"]
    click_heading(table, 1)
    assert column(table, 1) == ["9 µs", "12.3 µs", "1 ms", "–"]
    click_heading(table, 1)
    assert column(table, 1) == ["1 ms", "12.3 µs", "9 µs", "–"]
    table.show_table(TABLE)
    assert column(table, 1) == ["1 ms", "12.3 µs", "9 µs", "–"], "the order stays"


def test_what_is_copied_has_all_digits(table: StudyTable) -> None:
    QTest.keyClick(table, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    lines = QGuiApplication.clipboard().text().splitlines()
    assert lines[:2] == ["Method\tTime\tNote", "DDA\t1.2345e-05\t"]
    assert len(lines) == 5
    table.selectRow(2)
    assert table.text().splitlines()[1:] == ["Bresenham\t9e-06\t"]


def test_a_row_is_chosen_by_its_method(table: StudyTable, qtbot: QtBot) -> None:
    table.setFocus()
    table.selectRow(2)
    with qtbot.waitSignal(table.row_chosen) as chosen:
        table.activated.emit(table.model().index(2, 0))
    assert chosen.args == ["bres"]


def test_a_line_sets_a_group_off_and_the_list_is_no_longer_than_its_rows(qtbot: QtBot) -> None:
    families = FamilyList()
    qtbot.addWidget(families)
    rows = [
        FamilyEntry("all", "All", ends_group=True),
        FamilyEntry("some", "Some"),
        FamilyEntry("few", "Few"),
    ]
    families.show_families(rows, "all")
    families.resize(200, 2000)
    families.show()
    heights = [families.visualItemRect(families.item(row)).height() for row in range(3)]
    assert heights[0] > heights[1] == heights[2]
    assert sum(heights) <= families.height() <= max(sum(heights) + 4, families.minimumSizeHint().height())


def test_families_are_chosen_and_ticked(qtbot: QtBot) -> None:
    families = FamilyList()
    qtbot.addWidget(families)
    entries = [FamilyEntry("line", "Lines", "two works", True), FamilyEntry("fill", "Fills")]
    with qtbot.assertNotEmitted(families.family_chosen):
        families.show_families(entries, "line")
    ticked, plain = (families.item(row).icon().pixmap(16, 16).toImage() for row in (0, 1))
    assert ticked != plain
    families.setFocus()
    with qtbot.waitSignal(families.family_chosen) as chosen:
        QTest.keyClick(families, Qt.Key.Key_Down)
    assert chosen.args == ["fill"]


@pytest.fixture
def pictures(qtbot: QtBot) -> StudyPictures:
    made = shown(qtbot, StudyPictures(), 900, 320)
    result = np.arange(12, dtype=np.float32).reshape(3, 4)
    reference = np.full((3, 4), 5, np.float32)
    made.show_pictures(
        PicturesRecord(
            "DDA: 11 pixels differ",
            (
                GridBuffer("picture", result),
                GridBuffer("reference", reference),
                GridBuffer("difference", result - reference, "signed"),
            ),
            ("DDA", "Reference", "Difference"),
            can_step=True,
        )
    )
    return made


def test_one_pixel_is_read_in_all_three_pictures(pictures: StudyPictures) -> None:
    grid = pictures.linked.grids[1]
    QTest.mouseMove(grid, grid.placement().cells_rect(3, 2).center().toPoint())
    assert pictures.values.text() == "pixel (3, 2): picture 11, reference 5, difference 6"
    QTest.mouseClick(
        grid, Qt.MouseButton.LeftButton, pos=grid.placement().cells_rect(1, 0).center().toPoint()
    )
    assert pictures.pin == (1, 0)
    assert [each.pin() for each in pictures.linked.grids] == [(1, 0)] * 3


def test_arrows_read_pixel_by_pixel(pictures: StudyPictures) -> None:
    grid = pictures.linked.grids[2]
    grid.setFocus()
    seen = []
    for key, modifier in (
        (Qt.Key.Key_Right, Qt.KeyboardModifier.NoModifier),
        (Qt.Key.Key_Right, Qt.KeyboardModifier.NoModifier),
        (Qt.Key.Key_Up, Qt.KeyboardModifier.NoModifier),
        (Qt.Key.Key_Left, Qt.KeyboardModifier.ShiftModifier),
    ):
        QTest.keyClick(grid, key, modifier)
        seen.append(pictures.pin)
    assert seen == [(2, 1), (3, 1), (3, 2), (0, 2)]
    assert pictures.values.text() == "pixel (0, 2): picture 8, reference 5, difference 3"


def test_zooming_one_picture_zooms_all(pictures: StudyPictures) -> None:
    pictures.linked.grids[0].zoom_by(3.0)
    views = {grid.view() for grid in pictures.linked.grids}
    assert len(views) == 1


def test_only_what_is_possible_is_offered(pictures: StudyPictures, qtbot: QtBot) -> None:
    assert pictures.step_button.isEnabled()
    assert not pictures.divergence_button.isVisible()
    with qtbot.waitSignal(pictures.step_requested):
        QTest.mouseClick(pictures.step_button, Qt.MouseButton.LeftButton)
    pictures.show_waiting("Drawing …")
    assert pictures.heading.text() == "Drawing …"
    assert not pictures.step_button.isEnabled()
    assert all(grid.buffer() is None for grid in pictures.linked.grids)


def test_what_is_being_done_is_in_the_panel_at_any_width(controls, qtbot) -> None:
    for width in (620, 760, 900, 990):
        controls.resize(width, 200)
        controls.show_progress(Progress("Bresenham, round 2 of 9", 1, 9))
        controls.layout().activate()
        right = controls.doing.mapTo(controls, controls.doing.rect().topRight()).x()
        assert right <= controls.width(), width


def test_a_table_without_numbers_says_what_comes_there(table: StudyTable) -> None:
    def written() -> int:
        picture = table.viewport().grab().toImage()
        ground = picture.pixel(2, 2)
        middle = range(picture.height() // 2 - 12, picture.height() // 2 + 12)
        return sum(picture.pixel(x, y) != ground for y in middle for x in range(picture.width()))

    table.show_table(TableRecord((), (), ()))
    assert written() > 200
    table.show_table(TableRecord(("Method",), (), ()))
    assert written() == 0
