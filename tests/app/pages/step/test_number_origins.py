"""A click on a number of the formula, on a cell or on a row of the history goes to the step that made it."""

import re

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.pages.step.pixel_origins import variable_of
from app.session.document import open_document
from app.window.main_window import MainWindow
from core.explain.latex import plain_text, split_cells
from core.explain.steps import formula
from lessons.scenes import make_scene
from widgets.inspector.formula_layout import FormulaNumber

pytestmark = pytest.mark.shared_window

CONSTANTS = ("s", "0", "12.92", "n_x", "n_y")
"""Symbols of what no variable holds: the sign of a triangle's area, constants, a box's columns and rows."""


def place_of(window: MainWindow, symbol: str) -> QPoint:
    """Return a place of the formula's view where the number of a symbol stands."""
    view = window.page.formula
    window.page.settle()
    while not view.is_complete():
        QApplication.processEvents()
    for _ in range(3):  # The view takes the height of its lines a moment later.
        QApplication.processEvents()
    for y in range(view.height() - 1, 0, -5):
        for x in range(0, view.width(), 4):
            number = view.number_under(QPointF(x, y))
            if number is not None and number.symbol.replace("_", "") == symbol:
                return QPoint(x, y)
    raise AssertionError(f"no number of {symbol} in {view.tip()}")


def click_variable(window: MainWindow, qtbot: QtBot, name: str) -> None:
    table = window.page.variables
    window.page.column.setCurrentWidget(window.page.column.step)
    item = table.findItems(name, Qt.MatchFlag.MatchExactly)[0]
    table.scrollToItem(item)
    where = table.visualItemRect(item)
    at = QPoint(table.columnViewportPosition(1) + table.columnWidth(1) - 12, where.center().y())
    qtbot.mouseClick(table.viewport(), Qt.MouseButton.LeftButton, pos=at)


@pytest.mark.parametrize("scene", ["single-triangle", pytest.param("cube", marks=pytest.mark.slow)])
def test_a_byte_is_followed_to_its_vertex_in_a_few_clicks(
    window: MainWindow, qtbot: QtBot, scene: str
) -> None:
    session, view = window.session, window.page.formula
    session.open(open_document(make_scene(scene), scene))
    resolve = session.trace.stage("resolve")
    shown = np.flatnonzero(session.trace.source.picture.primitive.ravel() >= 0)
    session.set_stage("resolve", int(resolve.steps.starts[shown[len(shown) // 2] + 1]))
    start, way = session.cursor, []
    is_lit = scene == "cube"
    clicks = ("*linear", "*source", "*albedo" if is_lit else "*colour", "λ0", "n0", "a0", "y1", "ywindow")
    for what in clicks:
        before = session.cursor
        if what.startswith("*"):
            click_variable(window, qtbot, what[1:])
        else:
            place = place_of(window, what)
            qtbot.mouseMove(view, place)
            qtbot.mouseClick(view, Qt.MouseButton.LeftButton, pos=place)
        assert session.cursor != before, (what, window.statusBar().currentMessage())
        way.append(session.cursor.stage)
    assert list(dict.fromkeys(way)) == ["blend", "shade", "interpolate", "edges", "transform"]
    for _ in clicks:
        window.run_action("visited_back")
    assert session.cursor == start


def test_a_number_says_where_it_comes_from_before_it_is_clicked(window: MainWindow, qtbot: QtBot) -> None:
    session, view = window.session, window.page.formula
    raster = session.stage_trace
    session.go_to(int(raster.steps.starts[40]) + 1)
    place = place_of(window, "a0")
    qtbot.mouseMove(view, QPoint(1, 1))
    qtbot.mouseMove(view, place)
    assert view.cursor().shape() is Qt.CursorShape.PointingHandCursor
    qtbot.mouseMove(view, QPoint(1, 1))
    assert view.cursor().shape() is Qt.CursorShape.ArrowCursor
    view.number_clicked.emit(FormulaNumber("", "123456"))
    assert "constant of the formula" in window.statusBar().currentMessage()


@pytest.mark.parametrize(
    "stage", ["transform", "cull", "edges", "bin", "raster", "interpolate", "depth", "resolve"]
)
def test_numbers_of_formulas_are_variables_of_their_step(window: MainWindow, stage: str) -> None:
    trace = window.session.trace.stage(stage)
    rows = np.unique([np.flatnonzero(trace.steps.kind == kind)[-1] for kind in np.unique(trace.steps.kind)])
    unknown = []
    for row in rows.tolist():
        for position in range(int(trace.steps.starts[row]) + 1, int(trace.steps.starts[row + 1]) + 1):
            explanation = trace.explain(position)
            shown = None if explanation is None else formula(explanation)
            if explanation is None or shown is None:
                continue
            for symbol, number in zip(
                split_cells(shown.symbolic), split_cells(shown.substituted), strict=False
            ):
                is_plain = re.fullmatch(r"[-\u2212]?\d+(\.\d+)?", number) and not symbol.isdigit()
                found = FormulaNumber(plain_text(symbol), number)
                if is_plain and variable_of(explanation, found) is None and symbol not in CONSTANTS:
                    unknown.append((explanation.key, symbol, number))
    assert unknown == []


def test_the_value_of_a_pixel_comes_from_the_step_that_wrote_it(window: MainWindow) -> None:
    session = window.session
    trace = session.stage_trace
    session.go_to(trace.steps.count)
    column, row = trace.pixel[100].tolist()
    session.set_pin((column, row))
    window.run_action("value_origin_pixel")
    at, _ = trace.steps.row_at(session.cursor.position)
    assert trace.pixel[at].tolist() == [column, row]
    assert "was written here" in window.statusBar().currentMessage()
    window.run_action("visited_back")
    assert session.cursor.position == trace.steps.count
    session.go_to(0)
    window.run_action("value_origin_pixel")
    assert "has written" in window.statusBar().currentMessage()


def test_a_click_on_the_history_goes_to_the_test_of_that_triangle(window: MainWindow, qtbot: QtBot) -> None:
    session, history = window.session, window.page.history
    column, row = session.stage_trace.pixel[np.flatnonzero(session.stage_trace.marks["covered"])[30]].tolist()
    session.set_pin((column, row))
    window.page.column.setCurrentWidget(history)
    rows = history.view.model()
    visited = []
    for number in range(rows.rowCount()):
        place = history.view.visualRect(rows.index(number, 0)).center()
        qtbot.mouseClick(history.view.viewport(), Qt.MouseButton.LeftButton, pos=place)
        visited.append(session.cursor.stage)
    assert "depth" in visited
    at, _ = session.stage_trace.steps.row_at(session.cursor.position)
    assert session.stage_trace.pixel[at].tolist() == [column, row]
