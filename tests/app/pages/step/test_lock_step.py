"""Two runs in lock-step: one step each, who has no more waits, and steps back undo steps forward."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from app.pages.step.lock_step import LockStep
from core.records.operation import Operation
from core.records.steps import Level, Steps


def run(rows: int, operations: int = 2) -> Steps:
    """Return a run of ``rows`` pixels with a few operations each."""
    done = tuple(Operation(f"part {k}", (), "") for k in range(operations))
    ends = np.array([rows], np.int64)
    return Steps(("test",), np.zeros(rows, np.int64), {"test": done}, ends, ends)


def stepped(first: Steps, both: LockStep, position: int, direction: int, level: Level) -> int:
    """Step both runs, as a key does; return where the first one is."""
    if both.step_second(direction, level):
        return position
    move = first.forward if direction > 0 else first.back
    both.follow(move(position, level), level)
    return move(position, level)


@given(st.integers(0, 5), st.integers(0, 5), st.lists(st.booleans(), max_size=20))
def test_both_have_done_as_many_steps_as_they_have(
    first_rows: int, second_rows: int, path: list[bool]
) -> None:
    first, second = run(first_rows), run(second_rows, operations=3)
    both, position, count = LockStep(first, second, 0, Level.PIXEL), 0, 0
    for forward in path:
        count = min(max(count + (1 if forward else -1), 0), max(first_rows, second_rows))
        position = stepped(first, both, position, 1 if forward else -1, Level.PIXEL)
        assert position == int(first.starts[min(count, first_rows)])
        assert both.second_position == int(second.starts[min(count, second_rows)])
        assert both.waits(1) == (count > second_rows)


def test_the_end_of_one_is_the_end_of_the_other() -> None:
    first, second = run(3), run(7)
    both = LockStep(first, second, 0, Level.PIXEL)
    both.follow(first.count, Level.PIXEL)
    assert both.second_position == second.count
    both.follow(0, Level.PIXEL)
    assert both.second_position == 0


def test_both_go_on_together_from_where_they_were_put() -> None:
    first, second = run(9), run(9)
    both = LockStep(first, second, int(first.starts[2]), Level.PIXEL)
    both.land(int(second.starts[5]))
    position = int(first.starts[2])
    for count in (1, 2):
        position = stepped(first, both, position, 1, Level.PIXEL)
        assert both.second_position == int(second.starts[5 + count])
    for _ in range(2):
        position = stepped(first, both, position, -1, Level.PIXEL)
    assert (position, both.second_position) == (int(first.starts[2]), int(second.starts[5]))
