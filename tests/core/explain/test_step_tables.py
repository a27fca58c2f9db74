"""Tables that fill: their numbers are those of the trace, known cells stay, and no cell is of a later step."""

import numpy as np
import pytest

from core import Settings, trace
from core.explain.step_tables import first_in_table, step_table
from core.lines.cohen_sutherland import cohen_sutherland_listing
from core.lines.parametric_clipping import liang_barsky_listing
from core.records.steps import StepTable
from core.trace.stage_trace import StageTrace
from lessons.lectures.scenes import clipped

WINDOW = (4.0, 3.0, 12.0, 9.0)
"""Borders of the clip window that the lectures' scenes have, in pixels."""


def raster_of(clipper: str, *ends: float) -> StageTrace:
    """Return the raster stage of a segment in the lectures' clip window, whose corner is (0, 0)."""
    return trace(clipped(*ends)(), Settings(line_clipping=clipper)).stage("raster")


def tables_of(found: StageTrace) -> list[StepTable]:
    made = [step_table(found, position) for position in range(found.steps.count + 1)]
    return [table for table in made if table is not None]


def texts(table: StepTable) -> list[list[str]]:
    return [["" if cell is None else cell.text for cell in row] for row in table.cells]


@pytest.mark.parametrize("clipper", ["cohen-sutherland", "liang-barsky", "cyrus-beck"])
@pytest.mark.parametrize("ends", [(-2, 1, 6, 5), (-2, 8, 6, 8), (3, 3, 3, 3)])
def test_cells_appear_with_the_step_that_makes_them_and_stay(clipper, ends):
    found = raster_of(clipper, *ends)
    assert first_in_table(found) < found.steps.row_count
    for position, table in enumerate(tables_of(found)):
        for row, cells in enumerate(table.cells):
            for column, cell in enumerate(cells):
                assert cell is None or cell.position <= position
                assert ((row, column) in table.made) == (cell is not None and cell.position == position)
    first, *_, last = tables_of(found)
    assert not any(map(any, texts(first)))
    assert first.note == ""
    assert last.note


@pytest.mark.parametrize("ends", [(-2, 1, 6, 5), (-2, 5, 2, 9), (2, -1, 2, 8)])
def test_liang_barsky_fills_in_the_numbers_of_its_listing(ends):
    found = raster_of("liang-barsky", *ends)
    _, seen = liang_barsky_listing(
        *found.columns["window_start"][0], *found.columns["window_end"][0], *WINDOW
    )
    table = tables_of(found)[-1]
    assert table.rows == ("left", "right", "bottom", "top")
    for cells, numbers in zip(table.cells, seen, strict=False):
        shown = [
            float(cells[k].full.replace("−", "-")) if cells[k].full != "–" else np.nan for k in (0, 1, 3)
        ]
        assert np.array_equal(shown, numbers[:3], equal_nan=True)
    assert all(not any(cells) for cells in table.cells[len(seen) :]), "given up before these borders"


def test_passes_of_cohen_sutherland_appear_one_by_one():
    tables = tables_of(raster_of("cohen-sutherland", -2, -1, 10, 8))
    assert [len(table.rows) for table in tables] == sorted(len(table.rows) for table in tables)
    assert not tables[0].rows
    _, passes = cohen_sutherland_listing(2, 2, 14, 11, *WINDOW)
    rows = texts(tables[-1])
    assert [(row[1], row[3]) for row in rows] == [(f"{a:04b}", f"{b:04b}") for a, b, *_ in passes]
    assert rows[-1][-1] == "accepted: or = 0"
    assert rows[0][-1] == "end 0 cut at left"
