"""Every step that computes something has a formula; its numbers stand under their symbols and are right."""

import math
import re
from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pytestqt.qtbot import QtBot

from core import ClipScene, Settings, trace
from core.explain.formulas import Stated, call, formula_of, is_same, named, on_grid
from core.explain.latex import split_cells
from core.explain.number_text import latex_text
from core.explain.records import Formula
from core.explain.steps import formula
from core.explain.term_latex import TermLatex, work_out
from core.records.terms import Operation, Term, term
from core.trace.stage_trace import Explanation
from tests.core.explain.explained_steps import all_said, rare_trace, steps_of
from tests.core.explain.read_formulas import BREAKS, RELATIONS, holds, read, statements
from widgets.inspector.formula_view import FormulaView
from widgets.inspector.typesetter import Typesetter


def test_every_formula_can_be_checked_from_what_it_shows() -> None:
    """Numbers stand under their symbols; all that is stated holds for the digits that are printed."""
    stated, found_count, long = 0, 0, 0
    for explanation, _, _, made, _ in all_said():
        if made is None:
            continue
        symbols, numbers = split_cells(made.symbolic), split_cells(made.substituted)
        assert len(symbols) == len(numbers), (explanation.key, made)
        assert not re.search(r"\bnan\b|\binf\b|None|−|e[-+]\d|num", made.substituted), (explanation.key, made)
        found = statements(made.substituted)
        assert all(map(holds, found)), (explanation.key, made)
        stated, found_count = stated + relation_count(numbers), found_count + len(found)
        long += max(made.digits.values(), default=0) > 8
    assert found_count > 0.95 * stated, (found_count, stated)
    assert long < 0.005 * stated, "few steps need more than eight digits"


def relation_count(cells: tuple[str, ...]) -> int:
    """Return how many statements, read or not, the cells of a line of numbers have."""
    parts = " & ".join("|" if cell in BREAKS else cell for cell in cells).split("|")
    return sum(any(cell in RELATIONS for cell in part.split(" & ")) for part in parts)


def test_formulas_can_be_typeset(qtbot: QtBot) -> None:
    typesetter = Typesetter(capacity=10_000)
    number = re.compile(r"\(?-?\d+(\.\d*)?\)?")
    cells: dict[str, str] = {}  # Other digits are no other problem.
    for made in {step.explanation.key: step.formula for step in all_said()}.values():
        if made is not None:
            for cell in (*split_cells(made.symbolic), *split_cells(made.substituted)):
                cells.setdefault(re.sub(r"\d+", "0", cell), cell)
    problems = {
        cell: typesetter.typeset(cell, "#000000", 18.0).problem
        for cell in cells.values()
        if not number.fullmatch(cell)
    }
    assert {cell: problem for cell, problem in problems.items() if problem} == {}


def only(stage: str, key: str, settings: Settings, place: int = 0, name: str = "grid-ties") -> Formula:
    """Return one formula of a rare triangle."""
    traced = rare_trace(name, settings).stage(stage)
    found = [e for e in map(traced.explain, range(1, traced.steps.count + 1)) if e and e.key == key]
    return formula(found[place])


def test_a_step_without_formula_gives_none() -> None:
    assert formula(Explanation("cull.kept.verdict", {}, (), (), None, 0)) is None
    assert formula(Explanation("lines.walk.next-pixel", {}, (), (), None, 0)) is None


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (577.25, "577.25"),
        (-0.03125, "-0.03125"),
        (1 / 3, "0.3333"),
        (-0.0, "0"),
        (12.0, "12"),
        (1.25e-7, r"{1.25 \cdot 10^{-7}}"),
        (math.nan, r"\mathrm{NaN}"),
        (-math.inf, r"-\infty"),
    ],
)
def test_numbers_in_formulas(value: float, expected: str) -> None:
    assert latex_text(value) == expected


def test_negative_numbers_stand_in_brackets_behind_operators() -> None:
    a, b, c = named("a", -2.0), named("b", -3.0), named("c", -1e-9)
    made = formula_of(named("x", -5.0).equals(a + b + c))
    assert split_cells(made.substituted) == (
        *("-5", r"\approx", "-2", "+", "(-3)", "+", r"({-1 \cdot 10^{-9}})"),
    )


TERMS = st.recursive(
    st.builds(lambda number: named("a", number / 4), st.integers(-9, 9)) | st.integers(-9, 9).map(term),
    lambda inner: st.one_of(
        st.builds(Operation, st.sampled_from(["+", "-", "*", "@", "/", "÷", "//"]), inner, inner),
        st.builds(lambda base, power: base**power, inner, st.integers(2, 3)),
        st.builds(Term.__neg__, inner),
        st.builds(call, st.sampled_from(["floor", "ceil", "round"]), inner),
        st.builds(call, st.sampled_from(["min", "max"]), inner, inner),
    ),
    max_leaves=6,
)


@given(TERMS)
def test_what_is_printed_means_what_was_written(written: Term) -> None:
    """Brackets stand where the numbers need them."""
    found, _ = work_out(read(" ".join(TermLatex(True).cells(written))))
    assert is_same(found, work_out(written)[0])


def shown(*stated: Stated) -> str:
    """Return the line of numbers of a formula."""
    return " ".join(split_cells(formula_of(*stated).substituted))


def test_numbers_have_the_digits_that_show_what_is_said() -> None:
    # A small difference of large numbers.
    a, b = named("a", 258.12890625), named("b", 258.00390625)
    assert shown(named("d", 0.125).equals(a - b)) == "0.125 = 258.129 - 258.004"
    assert shown(named("s", 516.1328125).equals(a + b)) == "516.1 = 258.1 + 258"
    # Neighbours in float32, and a rounding that four digits would turn around.
    assert shown(named("z", 0.30000001).compared("<", 0.3)) == "0.30000001 > 0.3"
    assert shown(named("n", 110).equals(call("ceil", named("x", 109.50004) - named("c", 0.5)))) == (
        r"110 = \lceil 109.50004 - 0.5 \rceil"
    )
    # Whole numbers, such as depths of 2^24 steps.
    assert shown(named("z", 14860003).compared("<", 14860000)) == "14860003 > 14860000"


def test_grid_positions_are_exact() -> None:
    places = [on_grid("x", value) for value in (22.5, 258 + 33 / 256, -1 / 256)]
    assert shown(*places) == r"22.5 \quad 258\frac{33}{256} \quad -\frac{1}{256}"


def test_the_view_shows_them(qtbot: QtBot) -> None:
    view = FormulaView()
    qtbot.addWidget(view)
    view.resize(400, 120)
    view.show()
    view.show_formula(only("raster", "raster.test.edge-0", Settings(fill="brute-force")))
    qtbot.waitUntil(view.is_complete)
    assert not view.to_image(1.0).isNull()
    assert "plain text" not in view.tip()


BIG_TRIANGLE = [[[-30.0, -30, 0, 1], [40, -30, 0, 1], [-30, 45, 0, 1]]]
"""Its edge functions in a picture of 300 pixels go beyond the 32,768 square pixels of 32 bits."""


@pytest.mark.parametrize("fill", ["hierarchy", "bounding-box", "incremental", "scanline"])
def test_numbers_that_wrap_around_are_congruent_not_equal(fill: str) -> None:
    scene = ClipScene(BIG_TRIANGLE, size=(300, 300))
    traced = trace(scene, Settings(coverage="fixed-24.8", fill=fill), region=(140, 140, 6, 4))
    signs = Counter()
    for name in ("edges", "bin", "raster"):
        for explanation, _, _ in steps_of(traced.stage(name)):
            made = formula(explanation)
            for statement in statements(made.substituted) if made is not None else ():
                assert holds(statement), (explanation.key, made)
                signs.update(statement.relations)
    assert signs[r"\equiv"]


def test_the_logarithm_of_0_is_minus_infinity() -> None:
    (found,) = statements(r"-\infty & = & \log_{{2}} \max(0, 0)")
    assert holds(found)
