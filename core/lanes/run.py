"""What one run of a program keeps: its lanes, its clock, what it has stored; and the variables of a call."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from time import thread_time
from typing import Any, Protocol

from core.lanes.limits import Limits
from core.lanes.masks import NOBODY, Mask, Some, lanes_in
from core.lanes.nodes import Statement
from core.lanes.problem import Place, Problem, counted
from core.records.arrays import Flags

TICKS = 31
"""The clock is looked at once in so many statements, and one more."""
UNSET = object()
"""The value of a call that has not returned."""

Stop = Callable[[], bool]
_bounds: ContextVar[tuple[float, float, Stop | None] | None] = ContextVar("bounds", default=None)
"""When runs end, the seconds that they may take, and what stops them before."""


@contextmanager
def bounded(seconds: float, stop: Stop | None = None) -> Iterator[None]:
    """Let all runs in the block share one clock of processor time; end them where ``stop()`` says so, see `Problem`.

    A block within another one ends no later than that, and where that is stopped.
    """
    outer, end = _bounds.get(), thread_time() + seconds
    if outer is not None:
        (end, seconds), stop = min((end, seconds), outer[:2]), stop or outer[2]
    token = _bounds.set((end, seconds, stop))
    try:
        yield
    finally:
        _bounds.reset(token)


class Watch(Protocol):
    """What looks on while a program runs."""

    def begin(self, statement: Statement, mask: Some, frame: "Frame") -> None:
        """A statement is about to run; the mask is (L,)."""

    def end(self, statement: Statement, mask: Some, frame: "Frame", value: Any) -> None:
        """It has run; ``value`` is what was stored, put, tested or returned; the mask is (L,)."""


class Run:
    """What all calls of one run share."""

    def __init__(
        self,
        lanes: int,
        limits: Limits,
        watch: Watch | None = None,
        is_checking: bool = False,
        stop: Stop | None = None,
    ) -> None:
        self.lanes, self.limits, self.watch, self.is_checking = lanes, limits, watch, is_checking
        self.place = Place(1)
        self.dead: Mask = NOBODY
        """Lanes that were discarded."""
        self.unset: list[tuple[str, Flags]] = []
        """Variables that lanes (L,) have read before they had a value, where that is allowed; while watched."""
        bounds = _bounds.get()
        self._end, self._seconds, self._stop = thread_time() + limits.seconds, limits.seconds, stop
        if bounds is not None:
            self._end, self._seconds = min((self._end, self._seconds), bounds[:2])
            self._stop = stop or bounds[2]
        self._ticks, self._stored = 0, 0

    def tick(self, place: Place) -> None:
        """Note where the run is, and stop it where it takes too long."""
        self.place = place
        self._ticks += 1
        if not self._ticks & TICKS:
            if thread_time() > self._end:
                raise Problem(place, f"this takes longer than {self._seconds:g} seconds: stopped here")
            if self._stop is not None and self._stop():
                raise Problem(place, "stopped")

    def make_room(self, place: Place, count: int) -> None:
        """Count numbers that are stored from now on; fewer than none: so many are no longer."""
        self.check_room(place, count)
        self._stored += count

    def check_room(self, place: Place, count: int) -> None:
        """Refuse numbers for which there is no room beside those that are stored."""
        if self._stored + count > self.limits.stored:
            raise Problem(
                place, f"variables and lists have more than {self.limits.stored:,} numbers: stopped here"
            )

    def some(self, mask: Mask) -> str:
        """Return in which part of the lanes something is so, for a sentence; the mask is (L,)."""
        count = lanes_in(mask, self.lanes)
        return (
            "" if self.lanes < 2 or count == self.lanes else f" in {count:,} of {counted(self.lanes, 'lane')}"
        )


class Frame:
    """The variables of one call."""

    __slots__ = ("depth", "given", "loops", "names", "returned", "run", "value")

    def __init__(self, run: Run, names: dict[str, Any], depth: int) -> None:
        self.run, self.names, self.depth = run, names, depth
        self.given: dict[str, Any] = {}
        """Of a variable that has a value in some lanes only: their mask."""
        self.value: Any = UNSET
        self.returned = 0
        """How many returns and discards were run."""
        self.loops: list[list[Mask]] = []
        """Of every loop that runs: the lanes that have left it, and those that go on with its next round."""
