from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QGuiApplication, QImage
from PySide6.QtWidgets import QApplication

from core.explain.latex import (
    color_vertices,
    may_begin_line,
    plain_text,
    split_cells,
    vertex_of,
    without_macros,
)
from core.explain.records import Formula
from tests.calls import calls_of
from tests.widgets.showing import shown
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import DARK, LIGHT
from widgets.inspector.formula_layout import FormulaSetter, Line
from widgets.inspector.formula_view import FormulaView
from widgets.inspector.typesetter import Typesetter

EDGE = Formula(r"E_0 = a_0 \cdot x + b_0 \cdot y + c_0", r"1.5 = -0.25 \cdot 13.5 + 0.125 \cdot 7.5 + 4")
MATRIX = Formula(r"\begin{bmatrix} a_0 & b_0 \\ a_1 & b_1 \end{bmatrix}^{-1}")


@pytest.mark.parametrize(
    ("latex", "cells"),
    [
        ("a = b + c", ("a", "=", "b", "+", "c")),
        ("-a - b", ("-a", "-", "b")),
        (r"a \cdot -b", (r"a \cdot -b",)),
        ("f(x + 1) = 2", ("f(x + 1)", "=", "2")),
        (r"\frac{a + b}{c} \le 0", (r"\frac{a + b}{c}", r"\le", "0")),
        ("a & b + c & d", ("a", "b + c", "d")),
        (r"\begin{matrix} a & b \end{matrix} = c", (r"\begin{matrix} a & b \end{matrix}", "=", "c")),
        ("x^-1 + 2", ("x^-1", "+", "2")),
        ("", ()),
    ],
)
def test_a_line_is_cut_at_relations_and_sums_outside_brackets(latex: str, cells: tuple[str, ...]) -> None:
    assert split_cells(latex) == cells


def test_products_are_cut_on_demand_and_no_line_begins_with_one() -> None:
    cells = split_cells(r"a_0 \cdot x + b", splits_products=True)
    assert cells == ("a_0", r"\cdot", "x", "+", "b")
    assert [may_begin_line(cells, k) for k in range(5)] == [True, False, False, True, False]


@pytest.mark.parametrize(
    ("latex", "vertex"),
    [
        ("a_0", 0),
        ("w_{1}", 1),
        (r"\gamma", 2),
        (r"\frac{1}{w_2}", 2),
        ("a_0 x", None),
        ("a_0 + b_1", None),
        ("x_{12}", None),
        (r"\alpha_k", None),
        (r"\vertex{1}{u}", 1),
        ("12.5", None),
    ],
)
def test_a_cell_belongs_to_a_vertex_only_when_all_its_symbols_do(latex: str, vertex: int | None) -> None:
    assert vertex_of(latex) == vertex


def test_symbols_of_a_vertex_get_its_colour() -> None:
    colors = ("#000001", "#000002", "#000003")
    assert color_vertices("a_0 x", colors) == r"\textcolor{#000001}{a_0} x"
    assert color_vertices(r"\beta", colors) == r"\textcolor{#000002}{\beta}"
    assert color_vertices(r"\vertex{2}{u}", colors) == r"\textcolor{#000003}{u}"


def test_plain_text_and_standard_latex() -> None:
    assert plain_text(r"\frac{1}{w} = \vertex{0}{u} \cdot \alpha") == "1/w = u · α"
    assert without_macros(r"\vertex{0}{u} & = & 1") == "{u} = 1"
    assert plain_text(r"a & = & 1 & \quad & b & = & 2") == "a = 1; b = 2"
    assert plain_text(r"a = 7 \quad (\mathrm{mod} \, 2^{32})") == "a = 7 (mod 2^32)"
    assert plain_text(r"\frac{10^{-14} + a}{2 - 10^{-15}}") == "(10^−14 + a)/(2 − 10^−15)"


def test_a_matrix_with_an_exponent_is_typeset() -> None:
    cell = Typesetter().typeset(MATRIX.symbolic, "#000000", 18.0)
    assert cell.problem == ""
    assert cell.box.width() > 20


@pytest.mark.parametrize("latex", [r"\frac{a}{", r"\begin{bmatrix} a", "{", r"x^{"])
def test_what_cannot_be_typeset_says_why(latex: str) -> None:
    cell = Typesetter().typeset(latex, "#000000", 18.0)
    assert cell.renderer is None
    assert cell.problem


def test_the_cache_forgets_the_oldest() -> None:
    typesetter = Typesetter(capacity=2)
    first = typesetter.typeset("a", "#000000", 18.0)
    typesetter.typeset("b", "#000000", 18.0)
    assert typesetter.typeset("a", "#000000", 18.0) is first
    typesetter.typeset("c", "#000000", 18.0)
    assert typesetter.cached("b", "#000000", 18.0) is None
    assert typesetter.cached("a", "#000000", 18.0) is first


@pytest.fixture
def view(qtbot) -> FormulaView:
    apply_theme(QApplication.instance(), LIGHT)
    return shown(qtbot, FormulaView(typesetter=Typesetter()), 420, 120)


def wait_for_typesetting(qtbot, view: FormulaView) -> None:
    qtbot.waitUntil(view.is_complete)


def pixels(image: QImage) -> np.ndarray:
    image = image.convertToFormat(QImage.Format.Format_RGB32)
    return np.frombuffer(image.constBits(), np.uint32).reshape(image.height(), image.bytesPerLine() // 4)


def has_color(view: FormulaView, color: str) -> bool:
    return bool((pixels(view.grab().toImage()) & 0xFFFFFF == QColor(color).rgb() & 0xFFFFFF).any())


def test_numbers_stand_under_their_symbols_in_the_colour_of_the_vertex(qtbot, view) -> None:
    view.show_formula(EDGE)
    wait_for_typesetting(qtbot, view)
    symbols, numbers = view._lines
    assert len(symbols.pieces) == len(numbers.pieces)
    for above, below in zip(symbols.pieces, numbers.pieces, strict=True):
        assert above.left + above.width / 2 == pytest.approx(below.left + below.width / 2)
    assert numbers.pieces[2].color == LIGHT.vertex_text[0]
    assert numbers.pieces[4].color == LIGHT.text
    assert has_color(view, LIGHT.vertex_text[0])


def test_the_colours_follow_the_theme(qtbot, view) -> None:
    view.show_formula(EDGE)
    wait_for_typesetting(qtbot, view)
    assert not has_color(view, DARK.vertex_text[0])
    apply_theme(QApplication.instance(), DARK)
    wait_for_typesetting(qtbot, view)
    assert has_color(view, DARK.vertex_text[0])
    apply_theme(QApplication.instance(), LIGHT)


def test_the_hint_of_an_empty_view_has_room(view) -> None:
    view.show_formula(None)
    view.show_hint("This step has no formula.")
    assert view.heightForWidth(1000) >= view.fontMetrics().height()
    assert view.heightForWidth(120) >= 3 * view.fontMetrics().height()


def test_a_narrow_view_wraps_and_asks_for_height(qtbot, view) -> None:
    view.show_formula(EDGE)
    wait_for_typesetting(qtbot, view)
    assert len(view._lines) == 2
    view.resize(170, 200)
    assert len(view._lines) > 2
    assert view.heightForWidth(170) > view.heightForWidth(420)
    assert all(piece.left + piece.width <= 170 for line in view._lines for piece in line.pieces)


def test_only_cells_that_changed_are_typeset_again(qtbot, view) -> None:
    view.show_formula(EDGE)
    wait_for_typesetting(qtbot, view)
    known = len(view._typesetter._cells)
    view.show_formula(Formula(EDGE.symbolic, r"2.5 = -0.5 \cdot 14.5 + 0.75 \cdot 8.5 + \frac{1}{3}"))
    assert view.is_complete()
    assert len(view._typesetter._cells) == known


def test_showing_a_formula_does_not_wait_for_a_slow_typesetter(qtbot, view) -> None:
    view.BUDGET_SECONDS = 0.0
    view.show_formula(EDGE)
    assert not view.is_complete()
    view.grab()
    wait_for_typesetting(qtbot, view)
    setter = view._setter()
    assert all(setter.is_ready(cell) for cell in setter.cells_needed(EDGE))


def test_a_hurried_run_of_formulas_is_typeset_when_it_pauses(qtbot, view) -> None:
    view.show_formula(MATRIX)
    wait_for_typesetting(qtbot, view)
    known = len(view._typesetter._cells)
    for number in range(5):
        view.show_formula(Formula(rf"\begin{{bmatrix}} {number} & x \end{{bmatrix}}"))
    assert len(view._typesetter._cells) <= known + 1
    assert not view.is_complete()
    wait_for_typesetting(qtbot, view)
    assert "Shown as plain text" not in view.tip()


def test_a_formula_that_cannot_be_typeset_is_shown_as_text_with_the_reason(qtbot, view) -> None:
    view.show_formula(Formula(r"\frac{a}{"))
    wait_for_typesetting(qtbot, view)
    assert "Shown as plain text" in view.tip()
    assert (pixels(view.grab().toImage()) & 0xFFFFFF != QColor(LIGHT.panel).rgb() & 0xFFFFFF).sum() > 30


def test_it_copies_as_latex_by_key_and_as_a_picture(qtbot, view) -> None:
    view.show_formula(EDGE)
    wait_for_typesetting(qtbot, view)
    view.setFocus()
    qtbot.keyClick(view, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QGuiApplication.clipboard().text().splitlines()[0] == EDGE.symbolic + r" \\"
    qtbot.keyClick(
        view, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    )
    assert QGuiApplication.clipboard().image().width() > 300


def test_an_empty_view_says_what_it_is_for_and_the_formula_is_spoken(view) -> None:
    assert "formula" in view.spoken_description()
    view.show_formula(EDGE)
    assert "a 0 times x" in view.spoken_description()
    view.show_formula(None)
    assert "formula" in view.spoken_description()
    assert view.accessibleName() == "Formula"


EQUATIONS = Formula(
    r"x = \frac{a}{256} \quad y = \frac{b}{256}", r"57 = \frac{c}{256} \quad 15 = \frac{d}{256}"
)


@pytest.mark.parametrize("formula", [EDGE, EQUATIONS])
def test_a_formula_is_laid_out_once_for_all_widths_in_which_it_is_whole(qtbot, view, formula) -> None:
    view.show_formula(formula)
    wait_for_typesetting(qtbot, view)
    setter, apart = view._setter(), FormulaSetter(view._typesetter, view.font(), view._size())

    def placed(lines: tuple[Line, ...]) -> list[object]:
        return [vars(part) for line in lines for part in (*line.pieces, replace(line, pieces=()))]

    setter.layout(formula, 2000)
    assert calls_of([FormulaSetter._layout], lambda: setter.layout(formula, 1990)) == {}
    for width in range(60, 900, 7):
        apart._layouts.clear()
        assert placed(setter.layout(formula, width)) == placed(apart.layout(formula, width)), width


def test_two_equations_are_parted_between_them(qtbot, view) -> None:
    view.show_formula(EQUATIONS)
    wait_for_typesetting(qtbot, view)
    assert len(view._lines) == 2
    width = max(piece.left + piece.width for piece in view._lines[0].pieces)
    view.resize(round(0.8 * width), 400)
    texts = [[piece.latex for piece in line.pieces] for line in view._lines]
    assert [line[:2] for line in texts] == [["x", "="], ["57", "="], ["y", "="], ["15", "="]]
    assert all(line.pieces[0].left < 30 for line in view._lines)


def test_a_product_that_has_no_room_goes_on_in_the_next_line(qtbot, view) -> None:
    names = (r"\text{projectionMatrix}", r"\text{modelViewMatrix}", r"\text{position.xyzw of the vertex}")
    product = " \\cdot ".join(names)
    view.show_formula(Formula(f"p & = & {product}", f"4 & = & {product}"))
    wait_for_typesetting(qtbot, view)
    view.resize(300, 400)
    texts = [[piece.latex for piece in line.pieces] for line in view._lines]
    assert {line[0] for line in texts[2:]} <= {"=", "\\cdot"}
    assert view._scale(view._lines) > 0.75


def test_a_conclusion_in_a_line_of_its_own_stands_there_once(qtbot, view) -> None:
    view.show_formula(
        Formula(
            r"E_0 & > & 0 & \Rightarrow & \text{covered by this triangle}",
            r"1542.75 & > & 0 & \Rightarrow & \text{covered by this triangle}",
        )
    )
    wait_for_typesetting(qtbot, view)
    view.resize(200, 400)
    texts = [[piece.latex for piece in line.pieces] for line in view._lines]
    assert len(texts) == 3
    assert texts[2][0] == r"\Rightarrow"


def test_a_low_view_shows_lines_that_are_read_largest(qtbot, view) -> None:
    view.show_formula(EQUATIONS)
    wait_for_typesetting(qtbot, view)
    one_line = max(piece.left + piece.width for piece in view._lines[0].pieces)
    view.resize(round(0.8 * one_line), 70)
    assert len(view._lines) == 2, "one line, a little smaller, instead of two that are half as large"
    view.resize(round(0.8 * one_line), 400)
    assert len(view._lines) == 4
