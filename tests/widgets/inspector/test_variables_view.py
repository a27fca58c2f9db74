import gc
import math
from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QColor, QGuiApplication, QHelpEvent
from PySide6.QtWidgets import QApplication, QToolTip

from core.explain.number_text import latex_text
from core.explain.records import Variable
from tests.calls import calls_of
from tests.widgets.showing import shown
from widgets.basics.theme import current_theme
from widgets.inspector.variables import VariablesView, value_text


@pytest.fixture
def view(qtbot) -> VariablesView:
    return shown(qtbot, VariablesView(), 360, 260)


STEP = (
    Variable("x", 13, 13),
    Variable("centre", (13.5, 7.5), (12.5, 7.5)),
    Variable("alpha", 1 / 3, 0.25, "weight of vertex 0", 0),
    Variable("depth", math.nan, math.nan),
    Variable("is_inside", True, None),
)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "–"),
        (True, "yes"),
        ("tie", "tie"),
        ((1.0, 0.5), "(1, 0.5)"),
        ((1542.75, 1 / 3), "(1542.75, 0.3333)"),
        (1 / 3, "0.3333"),
        (7, "7"),
        (1542.75, "1542.75"),
        (-1542.75, "−1542.75"),
        (123456.78, "1.235e5"),
    ],
)
def test_values_as_text(value: object, text: str) -> None:
    assert value_text(value) == text


def test_nan_that_stays_nan_has_not_changed() -> None:
    assert not Variable("depth", math.nan, math.nan).is_changed()
    assert Variable("depth", math.nan, 1.0).is_changed()
    assert not Variable("p", (math.nan, 1.0), (math.nan, 1.0)).is_changed()


def test_changed_values_stand_out_by_weight_mark_and_colour_for_one_step(view) -> None:
    view.show_variables(STEP)
    changed, same = view.topLevelItem(2), view.topLevelItem(0)
    assert changed.font(1).bold()
    assert not same.font(1).bold()
    assert changed.foreground(1).color() == QColor(current_theme().accent_text)
    accent = QColor(current_theme().accent)

    def has_mark(row: int) -> bool:
        box = view.visualItemRect(view.topLevelItem(row))
        picture = view.viewport().grab(box).toImage()
        return any(picture.pixelColor(x, picture.height() // 2) == accent for x in range(picture.width()))

    assert has_mark(2)
    assert not has_mark(0)
    view.show_variables(tuple(Variable(v.name, v.now, v.now, v.meaning, v.vertex) for v in STEP))
    assert not has_mark(2)
    assert not changed.font(1).bold()


def test_a_vector_opens_and_stays_open_while_stepping(view) -> None:
    view.show_variables(STEP)
    centre = view.topLevelItem(1)
    centre.setExpanded(True)
    assert [centre.child(k).text(0) for k in range(2)] == ["x", "y"]
    assert centre.child(0).font(1).bold()
    assert not centre.child(1).font(1).bold()
    view.show_variables((Variable("x", 14, 13), Variable("centre", (14.5, 7.5), (13.5, 7.5)), *STEP[2:]))
    assert view.topLevelItem(1) is centre
    assert centre.isExpanded()
    assert centre.child(0).text(1) == "14.5"


def test_full_precision_on_hover_and_copy(qtbot, view) -> None:
    view.show_variables(STEP)
    item = view.topLevelItem(2)
    assert item.text(1) == "0.3333"
    place = view.visualItemRect(item).center()
    pointing = QHelpEvent(QEvent.Type.ToolTip, place, view.viewport().mapToGlobal(place))
    QApplication.sendEvent(view.viewport(), pointing)
    assert "alpha = 0.3333333333333333" in QToolTip.text()
    view.setCurrentItem(item)
    qtbot.keyClick(view, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QGuiApplication.clipboard().text() == "alpha = 0.3333333333333333"


def test_exact_fractions_on_demand(view) -> None:
    view.show_variables((Variable("a", 1 + 3 / 256, 0.1),))
    view.show_fractions(True)
    assert view.topLevelItem(0).text(1) == "1 3/256"
    assert view.topLevelItem(0).text(2) == "~0.1"


def test_other_names_give_other_rows_and_none_gives_an_empty_pane(view) -> None:
    view.show_variables(STEP)
    view.show_variables((Variable("t", 0.5),))
    assert view.topLevelItemCount() == 1
    view.show_variables(())
    assert view.topLevelItemCount() == 0


def test_rows_keep_nothing_of_the_variables_before(qtbot, view) -> None:
    others = (Variable("p", (0.5, 2.0, 1.0), None), Variable("t", False, True), Variable("u", 2, 2, "", 1))
    view.show_variables(STEP)
    view.topLevelItem(1).setExpanded(True)
    view.selectAll()
    view.show_variables(others)
    fresh = shown(qtbot, VariablesView(), 360, 260)
    fresh.show_variables(others)

    def look(of: VariablesView) -> list[object]:
        items = [of.topLevelItem(row) for row in range(of.topLevelItemCount())]
        assert not any((items[0].isExpanded(), of.selectedItems(), of.currentItem()))
        items[0].setExpanded(True)
        items += [items[0].child(k) for k in range(items[0].childCount())]
        roles = (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.FontRole, Qt.ItemDataRole.ForegroundRole)
        roles += (Qt.ItemDataRole.AccessibleTextRole,)
        return [(item.tip(k), *(item.data(k, role) for role in roles)) for item in items for k in range(3)]

    assert look(view) == look(fresh)


def test_vertex_colours_name_the_vertex(view) -> None:
    view.show_variables(STEP)
    assert view.topLevelItem(2).foreground(0).color() == QColor(current_theme().vertex_text[0])


@pytest.mark.parametrize("value", [1542.75, -0.0078125, 1 / 3, 98765.4321, 12.0])
def test_variables_have_the_digits_of_formulas(value: float) -> None:
    text = value_text(value).replace("−", "-")
    written = latex_text(value)
    assert text == written or "e" in text
    assert ("cdot" in written) == ("e" in text)


def test_only_cells_that_differ_are_set_and_laid_out_again(view) -> None:
    still = tuple(Variable(v.name, v.now, v.now, v.meaning, v.vertex) for v in STEP)
    view.show_variables(still)
    changed = []
    view.model().dataChanged.connect(lambda first, last: changed.append((first.row(), first.column())))
    view.show_variables(tuple(Variable(v.name, v.now, v.now, v.meaning, v.vertex) for v in STEP))
    assert changed == []
    view.show_variables((Variable("x", 14, 14), *still[1:]))
    assert set(changed) == {(0, 1), (0, 2)}


def test_only_values_that_differ_are_put_into_words(view) -> None:
    view.show_variables(STEP)
    again = (Variable("x", 14, 13), *(replace(each, digits={14: 6, 99: 5}) for each in STEP[1:]))
    assert calls_of([value_text], lambda: view.show_variables(again)) == {"value_text": 2}
    for digits in ({1 / 3: 6}, {2 / 3: 6}):
        view.show_variables((Variable("pair", (1 / 3, 2 / 3), digits=digits),))
        assert view.topLevelItem(0).text(1) == value_text((1 / 3, 2 / 3), digits=digits)
    view.show_variables((Variable("is_tie", 1),))
    view.show_variables((Variable("is_tie", True),))
    assert view.topLevelItem(0).text(1) == "yes", "equal, but not the same"


def test_a_closed_vector_is_written_when_it_is_opened(view) -> None:
    view.show_variables(STEP)
    centre = view.topLevelItem(1)
    assert centre.child(0).text(1) == ""
    centre.setExpanded(True)
    assert [centre.child(k).text(1) for k in range(2)] == ["13.5", "7.5"]
    centre.setExpanded(False)
    view.show_variables((STEP[0], Variable("centre", (14.5, 7.5), (13.5, 7.5)), *STEP[2:]))
    centre.setExpanded(True)
    assert centre.child(0).text(1) == "14.5"
    assert centre.child(0).data(1, Qt.ItemDataRole.AccessibleTextRole) == "x 14.5, changed"


def test_numbers_of_the_same_text_copy_in_full(view) -> None:
    view.show_variables((Variable("t", 1 / 3, 0.0),))
    view.show_variables((Variable("t", 1 / 3 + 1e-9, 0.0),))
    view.topLevelItem(0).setSelected(True)
    view.copy_values()
    assert QGuiApplication.clipboard().text() == f"t = {1 / 3 + 1e-9!r}"


def test_rows_that_go_are_held_no_longer(view) -> None:
    def rows() -> int:
        return sum(type(one).__name__ == "_VariableItem" for one in gc.get_objects())

    before = rows()
    for number in range(20):
        view.show_variables([Variable(f"p{number}", (1.0, 2.0, 3.0))] * (number % 3 + 1))
    gc.collect()
    assert rows() - before <= 3 * 4
