"""Two runs of one stage that are stepped together: a fixed list of pairs of positions for each level."""

from functools import partial
from weakref import WeakKeyDictionary

import numpy as np

from app.session.moment import Cursor
from core.records.arrays import Flags, Integers
from core.records.steps import Level
from core.trace.stage_trace import StageTrace

SIDES = 1 << 20
"""More than two for each triangle of a trace."""


class LockStep:
    """Where two runs are; the first one's cursor leads.

    A row stands beside the row of the other run that is about the same triangle and pixel, or without a pixel of the
    same kind: the first such row beside the first one, the second beside the second. Rows that only one run has stand
    side by side where they come before the same partners, as long as both have some; else the other run waits. A larger
    step stands beside the last one that shares a row with it.

    Notes
    -----
    The pairs come in the order of the first run: where the second one works in another order, it goes back and forth.
    Steps are undone by as many steps back because the list does not change.
    """

    def __init__(self, first: StageTrace, second: StageTrace, cursor: Cursor) -> None:
        self._runs = first, second
        self.pairs = partial(_pairs, first, second)
        """Returns (K, 2) the positions of both, from their starts to their ends, in steps of a level."""
        self._level, self._index = cursor.level, 0
        self.positions = 0, 0
        """Of both, in operations done."""
        self._put(cursor.position)

    def follow(self, cursor: Cursor) -> None:
        """Take the second run along: the first one is there now, by a step or a jump, or steps have another size."""
        if cursor.level != self._level or not any(self._go(k, cursor.position) for k in (0, 1, -1)):
            self._level = cursor.level
            self._put(cursor.position)

    def step_second(self, direction: int, level: Level) -> bool:
        """Step the second run where the first one has no step; return whether that is so."""
        return level == self._level and self._go(direction, self.positions[0])

    def land(self, row: int | None, second_row: int | None) -> None:
        """Put both just after a row of each; a run without one goes where it is beside the other one."""
        mine, theirs = (
            None if at is None else run.steps.position_after(at)
            for at, run in zip((row, second_row), self._runs, strict=True)
        )
        if mine is None:
            ours, others = self.pairs(Level.PIXEL).T
            mine = int(ours[np.argmax(others == theirs)])
        self._put(mine, theirs)

    def put_beside(self) -> None:
        """Put the second run beside the last step of the first one, from where it may go on alone."""
        pairs, mine = self.pairs(self._level), self.positions[0]
        self._index = int(pairs[:, 0].searchsorted(mine))
        self.positions = mine, int(pairs[self._index, 1])

    def land_second(self, position: int) -> None:
        """Put the second run at a position, and the first one beside the row that is done there."""
        ours, others = self.pairs(Level.PIXEL).T
        self._put(
            int(ours[min(int(np.searchsorted(np.maximum.accumulate(others), position)), len(ours) - 1)]),
            position,
        )

    def text(self, run: int) -> str:
        """Return how far run 0 or 1 is, and whether it waits for the other one."""
        boundaries, pairs = self._runs[run].steps.boundaries(self._level), self.pairs(self._level)
        done, count = int(boundaries.searchsorted(self.positions[run], "right")) - 1, len(boundaries) - 1
        last = pairs[max(self._index - 1, 0) : self._index + 1]
        if not count:
            return "no steps in this stage"
        if len(last) == 2 and last[0, run] == last[1, run] and tuple(last[1]) == self.positions:
            return f"waits for {'BA'[run]}, step {done:,} of {count:,}"
        return f"step {done:,} of {count:,}"

    def _go(self, direction: int, position: int) -> bool:
        """Go to the next pair (1) or the one before (-1) if the first run is at a position there."""
        pairs, index = self.pairs(self._level), self._index + direction
        if not 0 <= index < len(pairs) or pairs[index, 0] != position:
            return False
        self._index, self.positions = index, (position, int(pairs[index, 1]))
        return True

    def _put(self, position: int, second: int | None = None) -> None:
        """Put the first run at a position, and the second one beside it, or at a position of its own."""
        pairs = self.pairs(self._level)
        start, end = (int(pairs[:, 0].searchsorted(position, side)) for side in ("left", "right"))
        is_within = start == end
        self._index = end - 1 if is_within or (position > 0 and end == len(pairs)) else start
        if second is not None:
            self._index += int(np.argmax(pairs[self._index : end, 1] == second))
        elif is_within:
            done = self.pairs(Level.OPERATION)
            second = int(done[done[:, 0].searchsorted(position), 1])
        self.positions = position, int(pairs[self._index, 1]) if second is None else second


_KEPT: WeakKeyDictionary[StageTrace, WeakKeyDictionary[StageTrace, dict[Level, Integers]]] = (
    WeakKeyDictionary()
)
"""Pairs that were found, for as long as both runs are there."""


def _pairs(first: StageTrace, second: StageTrace, level: Level) -> Integers:
    kept = _KEPT.setdefault(first, WeakKeyDictionary()).setdefault(second, {})
    if level not in kept:
        kept[level] = _found_pairs(first, second, level)
    return kept[level]


def _found_pairs(first: StageTrace, second: StageTrace, level: Level) -> Integers:
    runs = first, second
    ends = [run.steps.starts.searchsorted(run.steps.boundaries(min(level, Level.PIXEL))[1:]) for run in runs]
    begins, stops = [], []
    for run, after, listed in zip(runs, ends, _listed(*runs, *ends), strict=True):
        starts, places = run.steps.starts, np.arange(len(listed))
        latest = np.append(listed, -1)[np.maximum.accumulate(np.where(listed >= 0, places, -1))]
        stops.append(starts[np.append(after, 0)[latest]])
        begins.append(np.where(listed >= 0, starts[np.append(0, after)[listed]], stops[-1]))
    begin, stop = np.stack(begins, axis=1), np.stack(stops, axis=1)
    if level == Level.OPERATION:
        # A row's operations stand beside those of its partner, in order.
        counts = (stop - begin).max(axis=1)
        done = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts) + 1
        stop = np.minimum(np.repeat(begin, counts, axis=0) + done[:, None], np.repeat(stop, counts, axis=0))
    found = np.concatenate([np.zeros((1, 2), np.int64), stop])
    last = np.array([[run.steps.count for run in runs]])
    return found if (found[-1] == last).all() else np.concatenate([found, last])


def _listed(first: StageTrace, second: StageTrace, ends: Integers, others_ends: Integers) -> Integers:
    """Return (2, K) the steps of both runs in order, -1 for a run that waits; they end after so many rows."""
    names = [*first.steps.kinds, *second.steps.kinds]
    rows = _partners(*(_row_keys(run, names) for run in (first, second)))
    shared, taken = np.flatnonzero(rows >= 0), np.full(len(others_ends), -1)
    # Of the steps with partners in one step of the other run the last one stands beside it.
    taken[others_ends.searchsorted(rows[shared], "right")] = ends.searchsorted(shared, "right")
    partner = _inverse(taken, len(ends))
    taken = _inverse(partner, len(taken))
    alone, others_alone = np.flatnonzero(partner < 0), np.flatnonzero(taken < 0)
    ahead = np.append(partner, len(taken))[_next(partner >= 0)]
    beside = _partners(
        (ahead * SIDES + _sides(first, ends))[alone],
        (_next(taken >= 0) * SIDES + _sides(second, others_ends))[others_alone],
    )
    partner[alone] = np.append(others_alone, -1)[beside]
    taken = _inverse(partner, len(taken))
    # What is left of the second run comes right before its next step that has a partner.
    left, places = np.flatnonzero(taken < 0), np.arange(len(ends))
    before = np.append(taken, len(ends))[_next(taken >= 0)[left]]
    order = np.argsort(np.append(before, places), kind="stable")
    found: Integers = np.stack([np.append(0 * left - 1, places), np.append(left, partner)])[:, order]
    return found


def _sides(run: StageTrace, ends: Integers) -> Integers:
    """Return a number for each step that ends after so many rows: its triangle, and whether it ends at a pixel."""
    found: Integers = 2 * (run.triangle[ends - 1] + 1) + (run.pixel[ends - 1, 0] >= 0)
    return found


def _row_keys(run: StageTrace, names: list[str]) -> Integers:
    """Return a number for each row: its triangle with its pixel, or else with its kind."""
    kind = np.array([names.index(name) for name in run.steps.kinds], np.int64)[run.steps.kind]
    column, row = run.pixel.T
    sides = _sides(run, np.arange(run.steps.row_count) + 1)
    return (sides << 32) + np.where(column >= 0, (row << 16) + column, kind)


def _partners(ours: Integers, theirs: Integers) -> Integers:
    """Return where the other one has the same key: for the first with a key the first, and so on; -1: nowhere."""
    if np.array_equal(ours, theirs):
        return np.arange(len(ours))
    order, others_order = np.argsort(ours, kind="stable"), np.argsort(theirs, kind="stable")
    keys, others = ours[order], theirs[others_order]
    place = others.searchsorted(keys) + np.arange(len(keys)) - keys.searchsorted(keys)
    has = place < others.searchsorted(keys, "right")
    found = np.full(len(keys), -1)
    found[order[has]] = others_order[place[has]]
    return found


def _inverse(partner: Integers, count: int) -> Integers:
    """Return who has each of ``count`` places as a partner, -1: nobody."""
    found = np.full(count, -1)
    found[partner[partner >= 0]] = np.flatnonzero(partner >= 0)
    return found


def _next(flags: Flags) -> Integers:
    """Return the first place from each one on at which a flag is set, or how many places there are."""
    found: Integers = np.minimum.accumulate(np.where(flags, np.arange(len(flags)), len(flags))[::-1])[::-1]
    return found
