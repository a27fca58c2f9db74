"""A symbol on screen is the name of the same numbers in conditions and in files; old names stay known."""

import re

import numpy as np
import pytest

from app.cli.trace_tables import arrays, csv_parts, row_record
from app.pages.step.grid_records import buffers_of
from app.session.moment import Cursor, Step
from core import Settings
from core.explain.steps import variables
from core.methods import table
from core.trace.conditions import parse_condition, symbols_of, variable_names
from core.trace.stage_trace import StageTrace
from tests.core.explain.explained_steps import line_trace, rare_trace, steps_of

SYMBOL = re.compile(r"([A-Za-zλ]\d?|d[xy]\d?)( \(.*\))?")
"""Labels of variables that are a letter, with the number of a corner or edge, or dx and dy."""


def drawn_lines(line: str) -> StageTrace:
    return line_trace(Settings(polygon_mode="wireframe", line=line)).stage("raster")


@pytest.mark.parametrize("line", table.names("line"))
def test_the_symbols_of_a_line_are_names_in_conditions(line: str) -> None:
    check_labels(drawn_lines(line))


def test_the_symbols_of_triangles_are_names_in_conditions() -> None:
    traced = rare_trace("grid-ties", Settings(fill="brute-force"))
    for stage in ("edges", "raster", "interpolate", "depth"):
        check_labels(traced.stage(stage))


def check_labels(found: StageTrace) -> None:
    """Check that a label and a condition by the same name are about the same numbers."""
    checked = 0
    for explanation, triangle, pixel in steps_of(found):
        row = np.flatnonzero((found.pixel == pixel).all(axis=1) & (found.triangle == triangle))
        for variable in variables(explanation):
            # The intermediate coordinate of a line method is its y as a real number, not the pixel's. Within a row,
            # a condition means the sum that is tested and the pixel that is drawn.
            if variable.column.endswith("_before") or variable.column.startswith("sum_"):
                continue
            symbol = SYMBOL.fullmatch(variable.name)
            if symbol is None or isinstance(variable.now, tuple | str) or variable.now is None:
                continue
            name = symbol[1]
            if name in ("x", "y") and explanation.values.get("decision") == variable.now:
                continue
            holds = parse_condition(f"{name} == {variable.now!r}" if variable.now == variable.now else name)
            if variable.now == variable.now:
                assert holds.holds(found)[row].any(), (name, variable)
            checked += 1
    assert checked


def test_bresenham_is_exported_by_its_symbols() -> None:
    found = drawn_lines("bresenham")
    wanted = {"D", "x", "y", "dx", "dy"}
    assert wanted <= set(variable_names(found))
    for names in (
        next(csv_parts(found))[1].strip().split(","),
        row_record(found, 1)["columns"],
        arrays(found),
    ):
        assert wanted <= set(names)
        assert not {"decision", "column", "row"} & set(names)


def test_edge_functions_are_exported_as_e0() -> None:
    found = rare_trace("grid-ties", Settings(fill="brute-force")).stage("raster")
    assert symbols_of(found) == {f"value_{k}": f"E{k}" for k in range(3)}
    for names in (
        next(csv_parts(found))[1].strip().split(","),
        row_record(found, 1)["columns"],
        arrays(found),
    ):
        assert {"E0", "E1", "E2"} <= set(names)
        assert "value_0" not in names


@pytest.mark.parametrize(
    ("old", "new"),
    [("decision >= 0", "D >= 0"), ("column == 2", "x == 2"), ("row == 3", "y == 3"), ("slope > 0", "m > 0")],
)
def test_old_names_still_work(old: str, new: str) -> None:
    found = drawn_lines("bresenham")
    assert np.array_equal(parse_condition(old).holds(found), parse_condition(new).holds(found))


def test_the_buffer_of_decisions_has_the_symbol_as_title() -> None:
    traced = line_trace(Settings(polygon_mode="wireframe", line="bresenham"))
    end = Cursor("raster", traced.stage("raster").steps.count)
    titles = [buffer.label for buffer in buffers_of(Step(traced, end))]
    assert "D" in titles
    assert "decision" not in titles
