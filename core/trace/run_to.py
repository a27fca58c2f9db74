"""Running to an event: the next row of a trace that has a mark, touches a pixel, or meets a condition.

A trace is data, so running is a search in its columns; nothing is executed. Positions are those of
``core.records.steps.Steps``: an event is reached when its row is done.
"""

import re

from core.records.arrays import Flags
from core.trace.conditions import parse_condition
from core.trace.stage_trace import MARKS, StageTrace

FORWARD, BACK = 1, -1
START, END = "start", "end"
_COUNTED = re.compile(r"([1-9]\d{0,5}): (.+)", re.DOTALL)


def next_event(trace: StageTrace, position: int, events: Flags, direction: int = FORWARD) -> int | None:
    """Return the position at which the next row of ``events`` has just been done.

    Parameters
    ----------
    position : int
        Where the cursor is: operations done.
    events : (R,) bool
        The rows to stop at.
    direction : int
        ``FORWARD``: the nearest position after ``position``; ``BACK``: the nearest before it.

    Returns
    -------
    int or None
        ``None`` where there is no such row any more.

    Raises
    ------
    ValueError
        If ``events`` is not (R,), or for another direction.
    """
    if events.shape != (trace.steps.row_count,):
        raise ValueError(f"events must be ({trace.steps.row_count},), got {events.shape}")
    if direction not in (FORWARD, BACK):
        raise ValueError(f"direction must be {FORWARD} or {BACK}, got {direction}")
    ends = trace.steps.starts[1:][events]
    if direction == FORWARD:
        place = int(ends.searchsorted(position, "right"))
        return int(ends[place]) if place < len(ends) else None
    place = int(ends.searchsorted(position, "left")) - 1
    return int(ends[place]) if place >= 0 else None


def next_marked(trace: StageTrace, position: int, mark: str, direction: int = FORWARD) -> int | None:
    """Return the position of the next row with a mark of ``MARKS``, ``None`` where the stage has no such mark.

    Examples
    --------
    >>> from core import ClipScene, trace
    >>> scene = ClipScene([[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]]], size=(2, 2))
    >>> raster = trace(scene).stage("raster")
    >>> first = next_marked(raster, 0, "rejected")
    >>> raster.pixel[raster.steps.row_at(first)[0]].tolist()
    [1, 0]
    """
    if mark not in trace.marks:
        return None
    return next_event(trace, position, trace.marks[mark], direction)


def next_at_pixel(
    trace: StageTrace,
    position: int,
    column: int,
    row: int,
    direction: int = FORWARD,
    *,
    by_operation: bool = False,
) -> int | None:
    """Return the position of the next row that is about one pixel, or with ``by_operation`` of the next operation."""
    events = (trace.pixel[:, 0] == column) & (trace.pixel[:, 1] == row)
    reached = next_event(trace, position, events, direction)
    if not by_operation:
        return reached
    # Forwards the first operation beyond ``position`` of the row that ends next, backwards the last one before it.
    steps, current = trace.steps, trace.steps.row_at(position + (direction == FORWARD))[0]
    if direction == FORWARD:
        return None if reached is None else max(position, int(steps.starts[steps.row_at(reached)[0]])) + 1
    first = int(steps.starts[current]) if current >= 0 else 0
    return position - 1 if current >= 0 and events[current] and position - 1 > first else reached


def named_position(trace: StageTrace, at: str) -> int:
    """Return the position that a text names by what happens there: numbers of steps change with a method.

    Parameters
    ----------
    at : str
        ``start``, ``end``, a mark of ``MARKS``, or a condition on the stage's variables: the first row that has it
        has just been done. ``2: tie`` is the second such row.

    Raises
    ------
    ValueError
        If the stage has no such row, or the condition cannot be read.

    Examples
    --------
    >>> from core import ClipScene, trace
    >>> scene = ClipScene([[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]]], size=(2, 2))
    >>> raster = trace(scene).stage("raster")
    >>> [named_position(raster, at) for at in ("start", "covered", "2: row == 1", "end")]
    [0, 4, 16, 16]
    """
    if at in (START, END):
        return 0 if at == START else trace.steps.count
    counted = _COUNTED.fullmatch(at)
    number, event = (int(counted[1]), counted[2]) if counted else (1, at)
    if event in MARKS:
        flags = trace.marks.get(event)
    else:
        flags = parse_condition(event).holds(trace)
    ends = trace.steps.starts[:0] if flags is None else trace.steps.starts[1:][flags]
    if len(ends) < number:
        raise ValueError(f"no step of {trace.stage} meets {at}")
    return int(ends[number - 1])
