"""Traces of wireframes: the rows give the picture, the listings give the rows, groups are edges."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import STAGES, ClipScene, Settings, Trace, render, trace
from core.edits.edit import original
from core.edits.typed import Typed
from core.explain.steps import sentence, variables
from core.lanes.program import steps_until_problem
from core.lines.line_method import OFF, has_intensities, line_traits
from core.lines.smooth import FILTER_TABLE
from core.lines.traced import SET_UP
from core.lines.wireframe import interpolate_affine_along, interpolate_along
from core.methods import table
from core.records.steps import Level
from core.trace.stage_trace import StageTrace
from lessons.small_scenes import segment_scene
from tests.core.strategies import ANY_TRIANGLES, clip_of_window
from tests.core.trace.executed_rows import Ran, lines_that_run
from tests.core.trace.trace_cases import SCENES, settings_of
from tests.covering import in_turns

LINES = list(table.names("line"))
SEVERAL = ("rectangle", "wu", "gupta-sproull")
"""Methods that draw more than one pixel in a column."""
ANEW = {"f", "g", "I", "d", "entry", "T"}
"""Variables of a listing that are shown without what they were in an earlier column or pixel."""
FOLDED = {"depth": ("depth", "depth"), "primitive": ("depth", "primitive"), "color": ("blend", "color")}
CHOICES = [
    {},
    {"interpolation": "affine", "blend": "over"},
    {"interpolation": "flat", "visibility": "painters"},
    {"clipping": "sutherland-hodgman", "depth": "inverse-w"},
    {"pixel_center": "integer", "visibility": "last-drawn", "cull": "back"},
]


def wireframe(line: str = "bresenham", **choices) -> Settings:
    return Settings(**{"polygon_mode": "wireframe", "line": line, **choices})


def check_fold(traced: Trace, column: int, row: int, columns: int, rows: int) -> None:
    frame = render(traced.source.scene, traced.source.settings)
    crop = slice(row, row + rows), slice(column, column + columns)
    for name, (stage, track) in FOLDED.items():
        found = traced.stage(stage).state(traced.stage(stage).steps.count)[track]
        assert found.tobytes() == np.ascontiguousarray(getattr(frame, name)[crop]).tobytes(), name
    raster = traced.stage("raster")
    assert np.array_equal(raster.state(raster.steps.count)["overdraw"], frame.cover_count[crop])


@given(ANY_TRIANGLES, st.sampled_from(LINES), st.sampled_from(CHOICES), st.sampled_from([1.0, 1e5]))
def test_any_triangles(case, line, choice, scale):
    clip, size = case
    values = np.linspace(0, 1, clip.size).reshape(clip.shape)
    scene = ClipScene(clip * np.array([scale, 1, 1, 1]), values, size)
    traced = trace(scene, wireframe(line, **choice))
    check_fold(traced, 0, 0, *size)
    check_chosen_pixels(traced.stage("raster"), traced.source.raster.bounds)
    check_values(traced.stage("interpolate"), choice.get("interpolation", "perspective"))


# Listings


def check_chosen_pixels(found: StageTrace, bounds: tuple[int, int, int, int]) -> None:
    """Run the listing of every segment; its pixels inside the raster are the rows, with the same decisions."""
    line = found.method.removeprefix("line=")
    c = found.columns
    left, bottom, right, top = bounds
    for segment in np.unique(c["segment"]).tolist():
        # A row that sets up a line whose first pixels lie off the raster draws nothing.
        rows = np.flatnonzero((c["segment"] == segment) & c["covered"])
        ends = [*c["first_end"][rows[0]], *c["second_end"][rows[0]]]
        ends = [int(end) for end in ends] if line_traits(line).takes_pixels else ends
        if max(np.abs(ends)) > 2000:
            continue
        with lines_that_run() as ran:
            listed = table.get("line", line).listing(*ends, False)
        inside = [left <= x < right and bottom <= y < top for x, y, *_ in listed]
        index = np.flatnonzero(inside)
        listed = [listed[k] for k in index]
        check_marks_of_pixels(found, rows, index, ran)
        assert [(x, y) for x, y, *_ in listed] == list(zip(c["column"][rows], c["row"][rows], strict=True))
        number = c["sum_advanced" if line.startswith("bresenham") else "decision"][rows]
        assert np.array_equal([d for _, _, d, *_ in listed], number)
        if has_intensities(line):
            assert np.array_equal([shown for *_, shown in listed], c["intensity"][rows])
        if line not in SEVERAL:
            assert np.array_equal(index, c["index"][rows])


def check_marks_of_pixels(found: StageTrace, rows: np.ndarray, index: np.ndarray, ran: Ran) -> None:
    """Check that the lines marked at a pixel ran between its predecessor and itself, or for its column."""
    if not len(rows):
        return
    of_listing = next(iter(found.explain(int(found.steps.starts[row]) + 1).listing for row in rows[:1]))
    ((lines,),) = [calls for code, calls in ran.items() if code is of_listing.function.__code__]
    draws = [place for place, line in enumerate(lines) if line == of_listing.lines["draw"]]
    is_several = found.method.removeprefix("line=") in SEVERAL
    for row, number in zip(rows.tolist(), index.tolist(), strict=True):
        # Pixels of a column share what is computed for it.
        first = max(number - 3, 0) if is_several else number
        begin = draws[first - 1] + 1 if first else 0
        since = set(lines[begin : draws[number] + 1])
        for position in range(found.steps.starts[row] + 1, found.steps.starts[row + 1] + 1):
            made = found.explain(int(position))
            shown = of_listing.source.splitlines()[made.line - 1].strip()
            assert made.line in since, (made.key, shown)


@pytest.mark.parametrize("line", LINES)
def test_every_assignment_is_a_step_and_every_variable_holds_what_the_listing_holds(line):
    corners = [(1.5, 1.5), (9.5, 3.5), (4.5, 8.5)]
    found = trace(ClipScene(clip_of_window([corners], (12, 10)), size=(12, 10)), wireframe(line)).stage(
        "raster"
    )
    c, steps = found.columns, found.steps
    assigned = {}
    for start, end in pairwise([0, *steps.group_ends.tolist()]):
        ends = [*c["first_end"][start], *c["second_end"][start]]
        ends = [int(end) for end in ends] if line_traits(line).takes_pixels else ends
        listed = original("line", line)
        ran = iter(steps_until_problem(Typed(listed.function, listed.source).program, [*ends, False])[0])
        for position in range(steps.starts[start] + 1, steps.starts[end] + 1):
            made = found.explain(position)
            row = steps.row_at(position)[0]
            now, held = next(
                (noted.before, noted.after)
                for noted in ran
                # A rectangle looks at pixels that it does not draw.
                if noted.line == made.line
                and [noted.after.get("column", c["column"][row]), noted.after.get("row", c["row"][row])]
                == [*found.pixel[row]]
            )
            shown = {variable.name: variable for variable in variables(made) if variable.name in held}
            for name, variable in shown.items():
                assert variable.now == held[name], (made.key, name)
                if variable.is_changed():
                    known = {None} if name in ANEW else set()
                    assert variable.before in {now.get(name), *known}, (made.key, name)
                    assert made.line == assigned.setdefault((made.key, name), made.line)
            # Nothing that is shown changes in between: what the listing assigns is a step.
            assert all(
                variable.is_changed() for name, variable in shown.items() if now.get(name) != held[name]
            )
    assert {name for _, name in assigned} >= ({"L"} if line == "rectangle" else {"x"})


@in_turns(
    pixel_center=table.names("pixel_center"),
    line=LINES,
    name=["clip", "lit", "single-triangle", "near-plane"],
)
def test_the_listing_executed_gives_the_rows(name, line, pixel_center):
    traced = trace(SCENES[name], wireframe(line, pixel_center=pixel_center))
    assert traced.stage("raster").steps.row_count
    check_chosen_pixels(traced.stage("raster"), traced.source.raster.bounds)


@pytest.mark.parametrize("line", LINES)
def test_the_columns_show_where_a_decision_comes_from(line):
    found = trace(SCENES["clip"], wireframe(line)).stage("raster")
    c = found.columns
    later = c["index"] > 0
    step = np.where(c["is_steep"], *(c["second_end"] - c["first_end"])[:, ::-1].T)
    if line in ("bresenham", "bresenham-lecture"):
        follows = later & ~np.isnan(c["previous"])
        wanted = c["previous"] + 2 * c["rise"] - 2 * c["run"] * stepped_before(c)
        assert np.array_equal(c["decision"][follows], wanted[follows])
    elif line == "midpoint":
        assert np.array_equal(c["decision"], c["slope"] * c["major"] + c["intercept"])
    elif line == "dda":
        follows = ~np.isnan(c["previous"])
        added = c["previous"] + np.where(step < 0, -1, 1) * c["slope"]
        assert np.array_equal(c["decision"][follows], added[follows])
        first = c["index"] == 0
        assert np.array_equal(c["decision"][first], (c["slope"] * c["major"] + c["intercept"])[first])
    elif line == "bresenham-float":
        second = c["index"] == 1
        assert second.any()
        assert np.array_equal(c["decision"][second], c["slope"][second])
    elif line == "dda-float32":
        follows = ~np.isnan(c["previous"])
        signed = np.where(step < 0, -1, 1) * c["slope"]
        added = c["previous"].astype(np.float32) + signed.astype(np.float32)
        assert np.array_equal(c["decision"][follows], added[follows])
    elif line == "rectangle":
        check_rectangle(c)
    elif has_intensities(line):
        assert np.array_equal(c["decision"], c["slope"] * c["major"] + c["intercept"])
        assert np.array_equal(c["fraction"], c["decision"] - np.floor(c["decision"]))
        check_intensities(c, line)
    elif line == "diamond-exit":
        assert (c["exit_start"] <= 0.5).all()
        assert (c["exit_end"] >= 0.5).all()
        assert (np.abs(c["decision"]) <= 0.5).all()


def check_rectangle(c) -> None:
    """The distances along and across are those of the pixel's centre, and within the rectangle."""
    way = c["second_end"] - c["first_end"]
    x, y = c["column"] - c["first_end"][:, 0], c["row"] - c["first_end"][:, 1]
    assert np.allclose(c["length"], np.hypot(*way.T))
    assert np.allclose(c["decision"], (way[:, 0] * y - way[:, 1] * x) / c["length"], atol=1e-9)
    assert np.allclose(c["along"], (way[:, 0] * x + way[:, 1] * y) / c["length"], atol=1e-9)
    assert (np.abs(c["decision"]) <= 0.5).all()
    assert ((c["along"] >= 0) & (c["along"] <= c["length"])).all()


def check_intensities(c, line: str) -> None:
    """The intensity follows from the fraction, or from the distance by the table; times the share of the column."""
    is_lower = c["minor"] <= c["decision"]
    if line == "wu":
        part = np.where(is_lower, 1 - c["fraction"], c["fraction"])
    else:
        away = np.abs(c["minor"] - c["decision"])
        assert np.array_equal(c["line_distance"], away * c["cosine"])
        part = FILTER_TABLE[c["entry"]]
        assert np.array_equal(part, c["filtered"])
        assert (np.abs(c["entry"] / 16 - c["line_distance"]) <= 1 / 32).all()
    assert np.array_equal(c["intensity"], part * c["share"])
    assert ((c["intensity"] > 0) & (c["intensity"] <= 1)).all()
    assert (c["share"] < 1).any()
    assert (c["share"] == 1).any()


def stepped_before(c) -> np.ndarray:
    """Whether the row before (of the same segment) stepped."""
    return np.concatenate([[False], c["has_stepped"][:-1]])


def check_values(found: StageTrace, interpolation: str) -> None:
    c = found.columns
    for row in range(0, found.steps.row_count, max(found.steps.row_count // 50, 1)):
        if interpolation == "flat":
            assert sorted(c["weights"][row].tolist()) == [0, 0, 1]
            continue
        t, (first, second) = c["t"][row], c["end_values"][row]
        if interpolation == "affine":
            value = interpolate_affine_along(t, first, second)
        else:
            total, value = interpolate_along(t, *c["end_w"][row], first, second)
            assert total == c["total"][row] == c["inverse_w"][row] == c["parts"][row].sum()
            assert c["s"][row] == c["parts"][row][1] / total
        assert np.array_equal(value, c["values"][row])
        assert np.allclose(c["weights"][row] @ c["corner_values"][row], value, atol=1e-9)


@pytest.mark.parametrize("choice", CHOICES, ids=str)
@pytest.mark.parametrize("name", ["clip", "lit", "textured-clip", "orthographic"])
def test_the_listing_of_interpolation_gives_the_values(name, choice):
    scene = SCENES[name]
    settings = settings_of({"polygon_mode": "wireframe", **choice}, scene)
    found = trace(scene, settings).stage("interpolate")
    assert found.steps.row_count
    mode = settings.interpolation
    assert {found.kind_of(row) for row in range(found.steps.row_count)} == {
        mode if mode == "flat" else f"line-{mode}"
    }
    check_values(found, mode)


# Stepping


@pytest.mark.parametrize("line", LINES)
def test_rows_are_the_pixels_of_the_edges_in_order(line):
    corners = [(1.5, 1.5), (9.5, 3.5), (4.5, 7.5)]
    scene = ClipScene(clip_of_window([corners], (12, 9)), size=(12, 9))
    found = trace(scene, wireframe(line)).stage("raster")
    c, steps = found.columns, found.steps
    assert c["edge"][np.append(0, steps.group_ends[:-1])].tolist() == [2, 0, 1]
    assert len(steps.group_ends) == 3
    assert steps.triangle_ends.tolist() == [steps.row_count]
    starts = np.append(0, steps.group_ends[:-1])
    assert [found.kind_of(int(row)) for row in starts] == [f"{line}-start"] * 3
    others = np.setdiff1d(np.arange(steps.row_count), starts)
    later = set(table.get("line", line).operations) - {f"{line}-start"}
    assert {found.kind_of(int(row)) for row in others} == later
    for group, (first, end) in enumerate(zip(starts, steps.group_ends, strict=True)):
        index, t = c["index"][first:end], c["t"][first:end]
        assert index[0] == 0
        if line in SEVERAL:
            assert (np.diff(index) > 0).all()
            assert (np.diff(t) >= 0).all()
        else:
            assert index.tolist() == list(range(end - first))
            assert (np.diff(t) * (-1 if t[0] > 0.5 else 1) > 0).all()
        ends = [corners[group], corners[(group + 1) % 3]]
        ends = sorted(ends) if has_intensities(line) else ends
        assert np.allclose(c["window_start"][first], ends[0])
        assert np.allclose(c["window_end"][first], ends[1])
    assert steps.forward(0, Level.GROUP) == steps.starts[steps.group_ends[0]]
    assert steps.back(steps.count, Level.GROUP) == steps.starts[steps.group_ends[1]]


@pytest.mark.parametrize("line", LINES)
def test_every_step_names_a_line_of_the_listing_and_numbers_that_there_are(line):
    found = trace(SCENES["clip"], wireframe(line)).stage("raster")
    seen = set()
    for position in range(1, found.steps.count + 1):
        explanation = found.explain(position)
        assert explanation.listing is not None
        assert explanation.line > 0, explanation.key
        assert set(explanation.changed) <= set(explanation.values)
        numbers = [np.asarray(explanation.values[name], float) for name in explanation.changed]
        assert all(np.isfinite(number).all() for number in numbers), explanation.key
        seen.add(explanation.key)
    operations = table.get("line", line).operations
    assert {key for key in seen if OFF not in key} == {
        f"raster.{kind}.{operation.name}" for kind in operations for operation in operations[kind]
    }


@pytest.mark.parametrize("line", LINES)
def test_a_line_that_begins_off_the_raster_steps_its_set_up(line):
    found = trace(segment_scene([((-3, 1), (6, 4))], (8, 6)), Settings(line=line)).stage("raster")
    begun = trace(segment_scene([((0, 1), (6, 4))], (8, 6)), Settings(line=line)).stage("raster")
    assert found.kind_of(0) == f"{line}{OFF}"
    names = [done.name for done in found.steps.operations[f"{line}{OFF}"]]
    first = [done.name for done in begun.steps.operations[f"{line}-start"]]
    assert names[:-1] == [name for name in first if name in SET_UP] != []
    last = found.explain(int(found.steps.starts[1]))
    assert sentence(last, 0, None).startswith("The line's first ")
    assert not found.marks["covered"][0]
    assert found.marks["covered"][1:].all()


@pytest.mark.parametrize("choice", CHOICES, ids=str)
def test_every_stage_of_a_wireframe_steps_both_ways(choice):
    traced = trace(SCENES["clip"], wireframe("diamond-exit", **choice))
    for stage in STAGES:
        steps = traced.stage(stage).steps
        for level in Level:
            boundaries = steps.boundaries(level).tolist()
            for before, after in pairwise(boundaries):
                assert steps.forward(before, level) == after
                assert steps.back(after, level) == before


def test_marks_and_buffers_of_the_raster():
    traced = trace(SCENES["clip"], wireframe("bresenham"))
    found = traced.stage("raster")
    assert found.marks["covered"].all()
    assert not found.marks["rejected"].any()
    assert np.array_equal(found.marks["tie"], found.columns["decision"] == 0)
    assert found.marks["tie"].any()
    state = found.state(found.steps.count)
    assert np.array_equal(state["coverage"] == 1, state["edge"] >= 0)
    assert np.array_equal(np.isnan(state["coverage"]), np.isnan(state["t"]))
    assert found.state(0)["edge"].max() == -1
    assert found.pixel.tolist() == np.stack([found.columns["column"], found.columns["row"]], axis=1).tolist()


@pytest.mark.parametrize("fill", table.names("fill"))
def test_bins_of_a_wireframe_are_boxes_only(fill):
    traced = trace(SCENES["clip"], wireframe(fill=fill))
    bins = traced.stage("bin")
    assert (bins.columns["node"] == -1).all()
    assert bins.steps.row_count == len(traced.source.geometry.primitives)
    assert len(traced.source.runs) == 0


def test_one_triangle_is_drawn_over_the_outlines_of_the_earlier_ones():
    scene = SCENES["clip"]
    last = len(scene.clip) - 1
    for line in LINES:
        traced = trace(scene, wireframe(line), last)
        check_fold(traced, 0, 0, *scene.size)
        assert set(traced.stage("raster").triangle.tolist()) == {last}
