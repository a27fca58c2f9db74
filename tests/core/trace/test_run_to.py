"""Running to the next event, and the conditions of breakpoints."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Settings, trace
from core.trace.conditions import TEXT_LIMIT, parse_condition, variable_names
from core.trace.run_to import BACK, FORWARD, named_position, next_at_pixel, next_event, next_marked
from core.trace.stage_trace import MARKS
from lessons.scenes import make_scene
from tests.core.trace.trace_cases import SCENES

TRACED = trace(SCENES["clip"], Settings(fill="blocks", block_size=4))
STAGES = ("transform", "cull", "clip", "bin", "raster", "depth", "blend")


def search(found, position: int, events: np.ndarray, direction: int) -> int | None:
    """Look at one row after the other."""
    ends = [found.steps.position_after(row) for row in np.flatnonzero(events).tolist()]
    if direction == FORWARD:
        return next((end for end in ends if end > position), None)
    return next((end for end in reversed(ends) if end < position), None)


@given(st.sampled_from(STAGES), st.sampled_from(MARKS), st.sampled_from([FORWARD, BACK]), st.data())
def test_marks(stage, mark, direction, data):
    found = TRACED.stage(stage)
    position = data.draw(st.integers(0, found.steps.count))
    events = found.marks.get(mark, np.zeros(found.steps.row_count, bool))
    reached = next_marked(found, position, mark, direction)
    assert reached == search(found, position, events, direction)
    if reached is not None:
        assert events[found.steps.row_at(reached)[0]]


def test_to_every_mark_and_back():
    found = TRACED.stage("raster")
    for mark in ("covered", "rejected", "tie"):
        there, position = [], 0
        while (reached := next_marked(found, position, mark)) is not None:
            there.append(position := reached)
        back, position = [], found.steps.count + 1
        while (reached := next_marked(found, position, mark, BACK)) is not None:
            back.append(position := reached)
        assert there == back[::-1]
        assert len(there) == np.count_nonzero(found.marks[mark]) > 0


@given(st.integers(0, 11), st.integers(0, 8), st.sampled_from([FORWARD, BACK]), st.data())
def test_rows_at_a_pixel(column, row, direction, data):
    found = TRACED.stage("depth")
    position = data.draw(st.integers(0, found.steps.count))
    events = np.zeros(found.steps.row_count, bool)
    events[found.rows_at_pixel(column, row)] = True
    wanted = search(found, position, events, direction)
    assert next_at_pixel(found, position, column, row, direction) == wanted


def test_a_stage_without_rows_has_no_event():
    empty = trace(SCENES["clip"], Settings(), 3).stage("raster")
    assert next_marked(empty, 0, "covered") is None
    assert next_at_pixel(empty, 0, 3, 3, BACK) is None


def test_a_place_is_named_by_what_happens_there():
    found = TRACED.stage("raster")
    covered = [found.steps.position_after(row) for row in np.flatnonzero(found.marks["covered"]).tolist()]
    assert [named_position(found, at) for at in ("start", "end")] == [0, found.steps.count]
    assert [named_position(found, at) for at in ("covered", "1: covered", "3: covered")] == [
        covered[0], covered[0], covered[2],
    ]  # fmt: skip
    row = found.steps.row_at(named_position(found, "column == 5 and row == 4"))[0]
    assert found.pixel[row].tolist() == [5, 4]
    for at in ("depth-failed", "column == 99", f"{len(covered) + 1}: covered"):
        with pytest.raises(ValueError, match=f"no step of raster meets {at}"):
            named_position(found, at)


def test_wrong_events():
    found = TRACED.stage("cull")
    with pytest.raises(ValueError, match=r"events must be \(\d+,\), got \(2,\)"):
        next_event(found, 0, np.ones(2, bool))
    with pytest.raises(ValueError, match="direction must be 1 or -1, got 0"):
        next_event(found, 0, found.marks["covered"], 0)


RASTER, DEPTH, BIN = (TRACED.stage(stage) for stage in ("raster", "depth", "bin"))
C, D = RASTER.columns, DEPTH.columns


@pytest.mark.parametrize(
    ("found", "text", "wanted"),
    [
        (RASTER, "E0 < 0.5", C["value_0"] < 0.5),
        (RASTER, "value_0 < 0.5", C["value_0"] < 0.5),
        (RASTER, " covered ", C["covered"]),
        (RASTER, "not covered", ~C["covered"]),
        (RASTER, "value_0 < 0.5 and not covered", (C["value_0"] < 0.5) & ~C["covered"]),
        (RASTER, "values[1] == 0 or values[2] == 0", (C["values"][:, 1] == 0) | (C["values"][:, 2] == 0)),
        (RASTER, "0 < value_1 <= 2.5e1", (C["value_1"] > 0) & (C["value_1"] <= 25)),
        (RASTER, "column + 2 * row == 7", C["column"] + 2 * C["row"] == 7),
        (RASTER, "-(column - 3) / 2 > -1", -(C["column"] - 3) / 2 > -1),
        (RASTER, "triangle % 2 == 1", RASTER.triangle % 2 == 1),
        (RASTER, "covered == False", ~C["covered"]),
        (RASTER, "column == center + 2.5", C["column"] == 3),
        (RASTER, "kind == 'accept'", np.array(RASTER.steps.kinds)[RASTER.steps.kind] == "accept"),
        (RASTER, "weights[0] != weights[0]", np.isnan(C["weights"][:, 0])),
        (RASTER, "1 / (column - column) > 0", np.ones(RASTER.steps.row_count, bool)),
        (RASTER, "True", np.ones(RASTER.steps.row_count, bool)),
        (RASTER, "2 < 1", np.zeros(RASTER.steps.row_count, bool)),
        (DEPTH, "stored < before", D["stored"] < D["before"]),
        (DEPTH, "passes and +depth > 0.25", D["passes"] & (D["depth"] > 0.25)),
        (
            BIN,
            'verdict == "outside" and rejected_by == 2',
            (BIN.columns["verdict"] == "outside") & (BIN.columns["rejected_by"] == 2),
        ),
        (BIN, 'verdict != "outside"', BIN.columns["verdict"] != "outside"),
    ],
)
def test_conditions(found, text, wanted):
    condition = parse_condition(text)
    holds = condition.holds(found)
    assert holds.dtype == bool
    assert np.array_equal(holds, wanted)
    assert next_event(found, 0, condition.holds(found)) == search(found, 0, wanted, FORWARD)
    assert next_event(found, found.steps.count, condition.holds(found), BACK) == search(
        found, found.steps.count, wanted, BACK
    )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "this one is empty"),
        ("value_0 <", "value_0 < cannot be read"),
        ("value_0 = 1", "cannot be read"),
        ("x" * (TEXT_LIMIT + 1), f"at most {TEXT_LIMIT} characters, got {TEXT_LIMIT + 1}"),
        ("abs(value_0) < 1", r"abs\(value_0\) is neither"),
        ("__import__('os').system('ls')", "is neither"),
        ("value_0.real > 1", "value_0.real is neither"),
        ("[covered]", r"\[covered\] is neither"),
        ("lambda: covered", "is neither"),
        ("(covered := True)", "is neither"),
        ("covered if row else row", "is neither"),
        ("values[0:1] > 0", "is neither"),
        ("values[row] > 0", "is neither"),
        ("values[True] > 0", "is neither"),
        ("(values)[0][0] > 0", "is neither"),
        ("9 ** 9 ** 9 > 1", "is neither"),
        ("1 << 2", "is neither"),
        ("kind in 'accept'", "is neither"),
        ("covered is True", "is neither"),
        ("row == None", "None is neither"),
        ("row == 1j", "1j is neither"),
        ("row == b'a'", "is neither"),
        ("f'{row}' == '1'", "is neither"),
        ("covered\0", "cannot be read"),
        ("(" * 150 + "row" + ")" * 140, "cannot be read"),
    ],
)
def test_what_is_no_condition(text, message):
    with pytest.raises(ValueError, match=message):
        parse_condition(text)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("value_7 < 1", "the stage raster has no variable value_7; it has a, "),
        ("values > 0", r"values has 3 numbers in a row: choose one, as values\[0\]"),
        ("values[3] > 0", r"values has the numbers 0 to 2, got values\[3\]"),
        ("column[0] > 0", r"column is not a list of numbers"),
        ("column", "column is not true or false"),
        ("column + 1", "is not true or false"),
        ("not column", "column is not true or false; compare it with something"),
        ("covered and column", "column is not true or false; compare it with something"),
        ("kind < 'test'", "a text can only be equal"),
        ("kind == 3", "a text can only be equal"),
        ("kind + 1 == 2", "kind is a text and has no arithmetic"),
        ("'a'", "is not true or false"),
    ],
)
def test_conditions_that_a_stage_cannot_answer(text, message):
    with pytest.raises(ValueError, match=message):
        parse_condition(text).holds(RASTER)


def test_names_of_a_stage_are_all_usable():
    for stage in STAGES:
        found = TRACED.stage(stage)
        for name in variable_names(found):
            values = found.columns.get(name, np.zeros(1))
            if values.ndim == 1 and values.dtype.kind != "U" and name != "kind":
                assert parse_condition(f"{name} == {name}").holds(found).shape == (found.steps.row_count,)


@given(st.text("value_0()[]<>=!+-*/%andort 1.5'\"\\{}:,", max_size=40))
def test_any_text_is_a_condition_or_one_sentence(text):
    told = ""
    try:
        holds = parse_condition(text).holds(RASTER)
    except ValueError as error:
        told = str(error)
    if told:
        assert "\n" not in told
        assert len(told) < 700
    else:
        assert holds.shape == (RASTER.steps.row_count,)


def test_every_operation_at_a_pixel_is_reached_there_and_back() -> None:
    found = trace(make_scene("segment")).stage("raster")
    steps = found.steps
    for column, line in found.pixel[[0, 3, -1]].tolist():
        rows = np.flatnonzero((found.pixel == (column, line)).all(axis=1))
        wanted = [
            p for row in rows for p in range(int(steps.starts[row]) + 1, int(steps.starts[row + 1]) + 1)
        ]
        for direction, order in ((FORWARD, wanted), (BACK, wanted[::-1])):
            position, reached = 0 if direction == FORWARD else steps.count + 1, []
            while (
                place := next_at_pixel(found, position, column, line, direction, by_operation=True)
            ) is not None:
                reached.append(position := place)
            assert reached == order


def test_a_kind_of_line_pixels_holds_where_the_line_steps_and_an_unknown_kind_is_refused() -> None:
    found = trace(make_scene("segment")).stage("raster")
    kinds = [found.kind_of(row) for row in range(found.steps.row_count)]
    assert set(kinds) == {"bresenham-start", "bresenham", "bresenham-step"}
    for text in ("kind == 'bresenham'", "'bresenham' == kind", "not (kind != 'bresenham')"):
        assert parse_condition(text).holds(found).tolist() == [kind != "bresenham-start" for kind in kinds]
    assert parse_condition("kind == 'bresenham-step'").holds(found).sum() == kinds.count("bresenham-step")
    with pytest.raises(ValueError, match=r"no rows of the kind line; it has .*bresenham-start"):
        parse_condition("kind == 'line' and covered").holds(found)
