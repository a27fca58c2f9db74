"""Running to an event: the next row of a trace that has a mark, touches a pixel, or meets a condition.

A trace is data, so running is a search in its columns; nothing is executed. Positions are those of
``core.records.steps.Steps``: an event is reached when its row is done.
"""

from core.records.arrays import Flags
from core.trace.stage_trace import StageTrace

FORWARD, BACK = 1, -1


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
    trace: StageTrace, position: int, column: int, row: int, direction: int = FORWARD
) -> int | None:
    """Return the position of the next row that is about one pixel."""
    events = (trace.pixel[:, 0] == column) & (trace.pixel[:, 1] == row)
    return next_event(trace, position, events, direction)
