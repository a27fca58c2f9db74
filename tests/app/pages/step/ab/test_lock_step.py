"""Two runs in lock-step stand at the same pixel; who has no step there waits, and steps back undo steps forward."""

import gc
import weakref
from collections import Counter
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.pages.step.ab.lock_step import LockStep
from app.session.document import open_document
from app.session.moment import Cursor
from core import STAGES
from core.records.listing import Operation
from core.records.steps import Level, Steps, ends_of
from core.trace.stage_trace import StageTrace
from lessons.scenes import make_scene
from tests.covering import every_nth

ROWS = st.lists(st.tuples(st.integers(0, 2), st.integers(-1, 3), st.sampled_from("st")), max_size=12)
"""Of each row triangle, column of the pixel, and kind."""
OPERATIONS = {"s": 1, "t": 3}


def run(rows: list[tuple[int, int, str]]) -> StageTrace:
    """Return a run of such rows, with groups of equal columns."""
    rows = sorted(rows, key=lambda row: row[0])
    triangle, column = (np.array([row[k] for row in rows], np.int64) for k in (0, 1))
    done = {
        kind: tuple(Operation(f"part {k}", (), "") for k in range(count))
        for kind, count in OPERATIONS.items()
    }
    kind = np.array(["st".index(row[2]) for row in rows], np.int64)
    steps = Steps(("s", "t"), kind, done, ends_of(triangle), ends_of(triangle, column))
    pixel = np.where(column[:, None] >= 0, np.stack([column, 0 * column], axis=1), -1)
    return StageTrace("raster", "", steps, {}, triangle, pixel.reshape(-1, 2), {})


def keys(stage: StageTrace) -> list[tuple[int, tuple[int, int] | str]]:
    """Return what each row is about: its triangle, and its pixel or else its kind."""
    pixels = [tuple(pixel) for pixel in stage.pixel.tolist()]
    return [
        (triangle, pixel if pixel[0] >= 0 else stage.kind_of(row))
        for row, (triangle, pixel) in enumerate(zip(stage.triangle.tolist(), pixels, strict=True))
    ]


def assert_laws(first: StageTrace, second: StageTrace) -> None:
    """Both go from start to end through all their steps, and who moves together is about the same."""
    both = LockStep(first, second, Cursor())
    for level in Level:
        pairs = both.pairs(level)
        assert pairs[0].tolist() == [0, 0]
        assert pairs[-1].tolist() == [first.steps.count, second.steps.count]
        for places, stage in zip(pairs.T, (first, second), strict=True):
            assert set(places.tolist()) == set(stage.steps.boundaries(level).tolist())
        moves = np.diff(pairs, axis=0)
        assert (moves[:, 0] >= 0).all()
        assert moves.any(axis=1).all(), "something happens in each step"
        if level > Level.STAGE:
            together = pairs[1:][moves.all(axis=1)]
            rows = [
                stage.steps.starts.searchsorted(places, "left") - 1
                for places, stage in zip(together.T, (first, second), strict=True)
            ]
            assert (first.triangle[rows[0]] == second.triangle[rows[1]]).all()
    mine, theirs = keys(first), keys(second)
    counts = Counter(mine), Counter(theirs)
    seen = Counter[object](), Counter[object]()
    pairs = both.pairs(Level.PIXEL)
    for before, after in pairwise(pairs):
        if (after != before).all():
            row, other = (
                stage.steps.row_at(int(place))[0] for stage, place in zip((first, second), after, strict=True)
            )
            if mine[row] != theirs[other]:
                assert mine[row][0] == theirs[other][0]
                assert seen[0][mine[row]] >= counts[1][mine[row]], "only A has it"
                assert counts[0][theirs[other]] < counts[1][theirs[other]], "only B has it"
        if after[0] != before[0]:
            seen[0][mine[first.steps.row_at(int(after[0]))[0]]] += 1


@given(ROWS, ROWS)
def test_both_reach_all_their_steps_and_move_together_only_about_the_same(
    rows: list[tuple[int, int, str]], others: list[tuple[int, int, str]]
) -> None:
    assert_laws(run(rows), run(others))


@pytest.mark.parametrize(
    ("name", "other"),
    every_nth(
        [
            ("shared-edge", {"fill": "hierarchy"}),
            ("shared-edge", {"polygon_mode": "wireframe"}),
            ("segment", {"line": "gupta-sproull"}),
            ("intersecting", {"visibility": "painters"}),
        ],
        2,
    ),
)
def test_the_laws_hold_in_every_stage(name: str, other: dict[str, str]) -> None:
    document = open_document(make_scene(name), name)
    first, second = document.make_trace(), document.make_trace(replace(document.settings, **other))
    for stage in STAGES:
        assert_laws(first.stage(stage), second.stage(stage))


@given(ROWS, ROWS, st.sampled_from(list(Level)), st.lists(st.booleans(), max_size=30))
def test_steps_back_undo_steps_forward(
    rows: list[tuple[int, int, str]], others: list[tuple[int, int, str]], level: Level, path: list[bool]
) -> None:
    first, second = run(rows), run(others)
    cursor = Cursor(level=level)
    both, came_from = LockStep(first, second, cursor), list[tuple[int, int]]()
    for forward in path:
        before = both.positions
        if not both.step_second(1 if forward else -1, level):
            move = first.steps.forward if forward else first.steps.back
            cursor = replace(cursor, position=move(cursor.position, level))
            both.follow(cursor)
        if forward and both.positions != before:
            came_from.append(before)
        elif not forward:
            assert both.positions == (came_from.pop() if came_from else (0, 0))


def test_the_end_of_one_is_the_end_of_the_other() -> None:
    first, second = run([(0, k, "s") for k in (0, 1, 2)]), run([(0, k, "t") for k in (2, 0, 1, 1)])
    both = LockStep(first, second, Cursor())
    for position, beside in ((first.steps.count, second.steps.count), (0, 0)):
        both.follow(Cursor(position=position))
        assert both.positions == (position, beside)


def test_beside_the_last_step_of_one_the_other_may_go_on() -> None:
    first, second = run([(0, 0, "s")]), run([(0, k, "s") for k in (0, 1, 2)])
    end = Cursor(position=first.steps.count)
    both = LockStep(first, second, end)
    assert both.positions == (first.steps.count, second.steps.count)
    both.put_beside()
    assert both.positions == (first.steps.count, int(second.steps.starts[1]))
    assert both.step_second(1, end.level)
    assert both.positions == (first.steps.count, int(second.steps.starts[2]))


def test_a_jump_into_a_step_lands_beside_the_operation() -> None:
    first, second = run([(0, k, "t") for k in (0, 1, 2)]), run([(0, k, "t") for k in (2, 0, 1)])
    both = LockStep(first, second, Cursor())
    both.follow(Cursor(position=5))
    assert both.positions == (5, 8)


def test_the_text_says_who_waits_and_why() -> None:
    first, second = run([(0, 0, "s"), (0, 1, "s")]), run([(0, -1, "s"), (0, 1, "s"), (1, 0, "s")])
    both, said = LockStep(first, second, Cursor()), []
    for _ in range(4):
        if not both.step_second(1, Level.PIXEL):
            both.follow(Cursor(position=both.positions[0] + 1))
        said.append((both.text(0), both.text(1)))
    assert said == [
        ("step 1 of 2", "waits for A, step 0 of 3"),
        ("waits for B, step 1 of 2", "step 1 of 3"),
        ("step 2 of 2", "step 2 of 3"),
        ("waits for B, step 2 of 2", "step 3 of 3"),
    ]


def test_runs_that_were_stepped_together_are_let_go() -> None:
    first, second = run([(0, 0, "s")]), run([(0, 0, "t")])
    seen = weakref.ref(first), weakref.ref(second)
    assert len(LockStep(first, second, Cursor()).pairs(Level.PIXEL)) == 2
    del first, second
    gc.collect()
    assert [at() for at in seen] == [None, None]
