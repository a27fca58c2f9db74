"""Tables that fill: their numbers are those of the trace, known cells stay, and no cell is of a later step."""

from fractions import Fraction

import numpy as np
import pytest

from core import ClipScene, Settings, trace
from core.explain import sentence
from core.explain.step_tables import has_tables, step_table
from core.geometry.line_clipping.cohen_sutherland import cohen_sutherland_listing
from core.geometry.line_clipping.liang_barsky import liang_barsky_listing
from core.records.tables import StepTable
from core.trace import StageTrace
from lessons.scenes import make_scene
from lessons.slides.scenes import clipped, degenerate, frustum_segments

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
    assert has_tables(found)
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


def test_cyrus_beck_names_entries_and_exits():
    table = tables_of(raster_of("cyrus-beck", -2, -1, 10, 8))[-1]
    way, t = (texts(table)[k] for k in (0, 1)), [row[4] for row in table.cells]
    assert [row[3] for row in way] == ["PE", "PL"]
    assert float(t[0].full) == float(Fraction(2, 12))


def test_passes_of_cohen_sutherland_appear_one_by_one():
    tables = tables_of(raster_of("cohen-sutherland", -2, -1, 10, 8))
    assert [len(table.rows) for table in tables] == sorted(len(table.rows) for table in tables)
    assert not tables[0].rows
    _, passes = cohen_sutherland_listing(2, 2, 14, 11, *WINDOW)
    rows = texts(tables[-1])
    assert [(row[1], row[3]) for row in rows] == [(f"{a:04b}", f"{b:04b}") for a, b, *_ in passes]
    assert rows[-1][-1] == "accepted: or = 0"
    assert rows[0][-1] == "end 0 cut at left"


def test_a_frustum_rejects_early_and_leaves_the_other_planes_empty():
    found = trace(frustum_segments(), Settings(clipping="sutherland-hodgman")).stage("cull")
    kept, dropped = (step_table(found, int(found.steps.starts[end])) for end in found.steps.triangle_ends)
    assert kept is not None
    assert dropped is not None
    assert kept.note == (
        "Neither accepted (or = 000001) nor rejected (and = 000000): it crosses the near plane."
    )
    assert [row[-1] for row in texts(dropped)] == [*["inside"] * 4, "rejected", "", "", ""]
    assert texts(dropped)[-1][:2] == ["··1000", "··1000"]


def test_edges_are_in_or_out_of_each_plane():
    corners = np.array([[[-3.0, 0, 0, 1], [0.5, 0, 0, 1], [0.5, 0.5, 0, 1]]])
    found = trace(ClipScene(corners, size=(8, 8)), Settings(clipping="sutherland-hodgman")).stage("clip")
    plane = next(table for table in tables_of(found) if table.title.startswith("left") and table.note)
    assert [row[2] for row in texts(plane)] == ["IN → OUT", "OUT → IN", "IN → IN"]
    assert [row[4] for row in texts(plane)] == ["new", "new, end", "end"]
    assert plane.note == "3 corners in, 4 out."
    assert not has_tables(trace(ClipScene(corners, size=(8, 8))).stage("clip"))


def test_a_table_is_text_with_all_digits():
    table = tables_of(raster_of("cyrus-beck", -2, -1, 10, 8))[-1]
    assert "\t0.16666666666666666\t" in table.text()
    assert table.text().splitlines()[0] == "Cyrus-Beck: segment 0"


def test_a_point_inside_and_one_outside_are_clipped_as_points():
    for clipper in ("cohen-sutherland", "liang-barsky", "cyrus-beck"):
        inside, outside = (
            tables_of(raster_of(clipper, *ends))[-1].note for ends in ((3, 3, 3, 3), (-1, 3, -1, 3))
        )
        assert "drawn" in inside
        assert "nothing of it is drawn" in outside


@pytest.mark.parametrize("clipper", ["cohen-sutherland", "liang-barsky", "cyrus-beck"])
def test_points_and_parallel_segments_are_kept_inside_and_on_the_border(clipper):
    found = trace(degenerate(), Settings(line_clipping=clipper)).stage("raster")
    ends = [int(found.steps.starts[end]) for end in found.steps.group_ends]
    tables = [step_table(found, position) for position in ends]
    kept = ["nothing of it is drawn" not in table.note for table in tables if table is not None]
    assert kept == [True, True, False, False, True, True, False]
    said = " ".join(table.text() for table in tables[4:] if table is not None)
    assert ("point" in said) == (clipper != "cohen-sutherland")
    assert "parallel" not in said


def test_corners_that_all_lie_on_a_plane_are_inside_it():
    corners = np.array([[[-0.5, -0.5, -1, 1], [0.5, -0.5, -1, 1], [0.0, 0.5, -1, 1]]])
    found = trace(ClipScene(corners, size=(8, 8)), Settings(clipping="sutherland-hodgman")).stage("cull")
    table = step_table(found, found.steps.count)
    assert table is not None
    assert texts(table)[1] == ["0", "0", "0", "inside"]
    assert table.note == "Accepted without clipping: the outcodes have no bit (or = 000000)."
    explanation = found.explain(2)
    assert explanation is not None
    said = sentence(explanation, 0, None)
    assert "all of its corners lie on it, which counts as inside" in said


def test_tables_of_polygons_fill_with_edges_crossings_and_walks() -> None:
    raster = trace(make_scene("polygon-holes"), triangle=0).stage("raster")
    done = raster.steps.rows_done(22)
    edges = step_table(raster, 22)
    assert edges is not None
    assert edges.title == "Edge table of polygon 0"
    assert len(edges.rows) == 14
    assert sum(line[0] is not None for line in edges.cells) == done + 1
    row = step_table(raster, 220)
    assert row is not None
    assert row.title == f"Active edges of row {int(raster.columns['row'][raster.steps.row_at(220)[0]])}"
    assert {line[0].text for line in row.cells if line[0]} == {"moves on", "inside", "outside"}
    settings = Settings(polygon_clipping="weiler-atherton")
    clip = trace(make_scene("weiler-atherton"), settings, triangle=0).stage("clip")
    walk = step_table(clip, clip.steps.count)
    assert walk is not None
    assert walk.title == "Walk around ring 0 of the result"
    assert walk.cells[0][0].text == "start"
    assert walk.note.startswith("That is the start: ring 0 is closed")
