"""The table of variables shows what is known by now, in order, and marks what has just changed."""

import re

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from core import STAGES, Settings
from core.explain import steps
from core.explain.latex import plain_text
from core.explain.records import Variable
from core.explain.step_values import StepValues
from core.trace.stage_trace import Explanation
from tests.core.explain.explained_steps import all_said, rare_trace
from widgets.inspector.variables import VariablesView, value_text


def at(stage: str, key: str, place: int = 0, settings: Settings | None = None) -> dict[str, Variable]:
    """Return the rows of one step of a rare triangle by name."""
    traced = rare_trace("grid-ties", settings or Settings(fill="brute-force")).stage(stage)
    found = [e for e in map(traced.explain, range(1, traced.steps.count + 1)) if e and e.key == key]
    return {variable.name: variable for variable in steps.variables(found[place])}


def test_rows_are_distinct_readable_and_finished() -> None:
    for explanation, *_, found in all_said():
        names = [variable.name for variable in found]
        assert len(set(names)) == len(names), explanation.key
        for variable in found:
            assert variable.meaning.endswith(".")
            assert "_" not in variable.name or explanation.key.endswith(".statement.run"), (
                "but as a shader has it"
            )
            assert value_text(variable.now) not in ("", "–")


def test_what_is_known_is_shown_and_nothing_from_later() -> None:
    for explanation, *_, found in all_said():
        if explanation.key.endswith(".statement.run"):
            continue  # Its variables are those of a shader.
        step = StepValues(explanation)
        hidden = steps.HIDDEN.get(f"{step.stage}.{step.kind}", frozenset())
        shown = {variable.name for variable in found}
        # Columns of one name are one variable at different times.
        of_stage, known = steps.variables_of(step.stage, step.kind), explanation.known
        earlier = {v.name for v in found if v.column in known or of_stage[v.column].after == steps.GIVEN}
        for name, text in of_stage.items():
            if name not in explanation.values or not np.size(explanation.values[name]):
                continue
            label = (text.label if isinstance(text.label, str) else text.label(step)).replace("#", "0")
            if text.after == "itself" and name not in explanation.known:
                assert label not in shown - earlier, (explanation.key, name)
            if name in explanation.changed and name not in hidden:
                assert label in shown, (explanation.key, name)


def test_a_decision_value_has_its_format_and_its_bits() -> None:
    # E0 of pixel (0, 0) is 42 = 1.0101 2^5.
    found = {}
    for coverage in ("float16", "fixed-24.8", "exact"):
        settings = Settings(fill="brute-force", coverage=coverage)
        found[coverage] = at("raster", "raster.test.decide", 0, settings)[f"E0 ({coverage})"]
    assert [variable.now for variable in found.values()] == [42.0, 42.0, 42.0]
    assert "Its bits in float16: 0 10100 0101000000." in found["float16"].meaning
    assert "Its bits in fixed-16.16: 0000000000101010.0000000000000000." in found["fixed-24.8"].meaning
    assert "bits" not in found["exact"].meaning


def test_every_stage_has_its_variables() -> None:
    steps.load_subjects()
    assert set(steps.VARIABLES) == set(STAGES)


def test_no_variable_has_two_texts() -> None:
    # "Subtracting 2 · dx = NaN" was said where the spans' dx# was imported behind the lines' dx.
    steps.load_subjects()
    with pytest.raises(ValueError, match="raster has a variable dx already"):
        steps.shows("raster", {"dx": steps.VariableText("dx#", "Extent of the edge.")})
    found = at("raster", "raster.lane-row.edge-0", 0, Settings(fill="spans"))
    assert [found[f"dx{k}"].now for k in range(3)] == [-6.0, 0.0, 6.0]


def test_a_decision_shows_snapped_values_and_unsnapped_weights_apart() -> None:
    # Pixel (0, 0) of the triangle (1, 1), (7, 1), (1, 7), whose edge functions are 42, -3 and -3 there.
    found = at("raster", "raster.test.decide")
    assert [found[f"E{k} (snapped)"].now for k in range(3)] == [42.0, -3.0, -3.0]
    weights = [found[f"λ{k} (unsnapped)"].now for k in range(3)]
    assert weights == pytest.approx([42 / 36, -3 / 36, -3 / 36])
    assert [found[f"E{k} (snapped)"].vertex for k in range(3)] == [0, 1, 2]
    assert [found[f"λ{k} (unsnapped)"].vertex for k in range(3)] == [0, 1, 2]
    assert found["covered"].now is False
    assert {name for name, variable in found.items() if variable.is_changed()} == {"covered"}


def test_a_decision_value_is_new_when_it_is_computed_and_old_afterwards() -> None:
    first = at("raster", "raster.test.edge-0")
    assert first["E0 (snapped)"].is_changed()
    assert "E1 (snapped)" not in first
    assert "covered" not in first
    assert not at("raster", "raster.test.edge-1")["E0 (snapped)"].is_changed()


def test_a_buffer_shows_what_it_held_before() -> None:
    found = at("depth", "depth.test.write")["depth buffer"]
    assert found.before == 1.0
    assert found.now == 0.5
    assert found.is_changed()


def test_a_kept_depth_is_not_marked() -> None:
    values = {"after": 0.25, "before": 0.25, "stored": 0.5, "depth": 0.5, "passes": False}
    values |= {"column": 0, "row": 0, "quantity": "z"}
    known = ("depth", "stored", "before", "passes", "after")
    made = Explanation("depth.test.write", values, known, ("after",), None, 0)
    found = {variable.name: variable for variable in steps.variables(made)}
    assert not found["depth buffer"].is_changed()


def test_vectors_are_tuples_and_texels_get_rows() -> None:
    values = {
        "texels": np.array([[1, 2], [2, 2], [1, 3], [2, 3]]),
        "texel_colors": np.arange(16.0).reshape(4, 4),
        "texel_position": np.array([1.5, 2.5]),
        "column": 0,
        "row": 0,
    }
    made = Explanation("shade.textured.texels", values, tuple(values), ("texels", "texel_colors"), None, 0)
    found = {variable.name: variable for variable in steps.variables(made)}
    assert found["texel 3"].now == (2.0, 3.0)
    assert found["texel colour 1"].now == (4.0, 5.0, 6.0, 7.0)
    assert found["x, y in texels"].now == (1.5, 2.5)
    assert found["texel 0"].vertex is None
    assert found["texel 0"].is_changed()
    assert not found["x, y in texels"].is_changed()


def test_an_unknown_stage_shows_nothing() -> None:
    assert steps.variables(Explanation("lines.walk.next-pixel", {"x": 1.0}, ("x",), ("x",), None, 0)) == ()


def test_the_view_shows_them(qtbot: QtBot) -> None:
    view = VariablesView()
    qtbot.addWidget(view)
    view.show_variables(list(at("raster", "raster.test.decide").values()))
    names = [view.topLevelItem(row).text(0) for row in range(view.topLevelItemCount())]  # type: ignore[union-attr]
    assert names.index("E0 (snapped)") < names.index("covered") < names.index("λ0 (unsnapped)")


def plain(text: str) -> str:
    """Return a symbol or formula without what sets subscripts and spaces, ``E_0^max`` as ``e0max``."""
    text = re.sub(r" \([a-z ]*\)$", "", text).translate(str.maketrans("₀₁₂ₑ", "012e"))
    return re.sub(r"[_^ ]", "", text).lower()


def test_symbols_are_those_of_the_formulas() -> None:
    symbols: dict[str, str] = {}
    shown: dict[str, set[str]] = {}
    for explanation, _, made, _, found in all_said():
        kind = explanation.key.rpartition(".")[0]
        symbols[kind] = symbols.get(kind, "") + (plain(plain_text(made.symbolic)) if made else "")
        shown.setdefault(kind, set()).update(
            plain(variable.name)
            for variable in found
            if variable.is_changed() and isinstance(variable.now, float)
        )
    short = {kind: {name for name in names if len(name) <= 3} for kind, names in shown.items()}
    # From the fourth on, the corners of a polygon are k in its formulas.
    missing = {
        kind: {name for name in names if re.sub(r"([3-9]|1\d)$", "k", name) not in symbols[kind]}
        for kind, names in short.items()
    }
    # Rays find z and the bounds e of their rounding errors aside; z is not in the formula of an integer plane.
    assert {name for names in missing.values() for name in names} <= {"1/w", "e", "z"}
    assert sum(map(len, short.values())) > 100
