"""One run of a program: its lanes and masks of them, its clock, its variables, and what its language gives it."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from enum import Enum
from time import thread_time
from typing import Any, Protocol

import numpy as np

from core.lanes.nodes import Statement
from core.lanes.problem import Limits, Place, Problem, counted
from core.records.arrays import Flags

# Masks of lanes: ``None`` is all lanes, `NOBODY` none, an array (L,) of bool at least one of them.


class Nobody(Enum):
    """The mask of no lane."""

    NOBODY = "nobody"


NOBODY = Nobody.NOBODY
Some = Flags | None
"""A mask of at least one lane."""
Mask = Flags | Nobody | None


def joined(first: Mask, second: Mask) -> Mask:
    """Return the lanes (L,) of either mask."""
    if isinstance(first, Nobody) or second is None:
        return second
    if isinstance(second, Nobody) or first is None:
        return first
    return first | second


def lanes_in(mask: Mask, lanes: int) -> int:
    """Return how many of so many lanes a mask (L,) has."""
    if isinstance(mask, Nobody):
        return 0
    return lanes if mask is None else int(np.count_nonzero(mask))


def split(mask: Some, flags: Flags, lanes: int) -> tuple[Mask, Mask]:
    """Return the lanes of a mask where ``flags`` (L,) hold, and the others: disjoint, together the mask."""
    yes = flags if mask is None else mask & flags
    count = int(np.count_nonzero(yes))
    if count == 0:
        return NOBODY, mask
    if count == lanes_in(mask, lanes):
        return mask, NOBODY
    return yes, (~flags if mask is None else mask & ~flags)


# What one run of a program keeps: its lanes, its clock, what it has stored; and the variables of a call.


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


# What a language gives the evaluator: its values, and what is done with them.


Value = Any
"""What a variable holds: what only the dialect knows."""
Rule = Callable[[Value, Value, Some, Run], Value]
"""Of an operator with two operands."""
Turn = Callable[[Some, int], tuple[Mask, Mask, Value]]
"""Of the lanes in a loop, and the number of the round: who goes on, who has ended, and the thing of this round."""


class Dialect(Protocol):
    """One language's values. ``mask`` is that of the lanes that are at ``place``; `Problem` says what does not go."""

    nothing: Value
    """What a return without a value gives."""
    is_typed: bool
    """Whether a variable keeps its type, which ``check_kept`` watches."""

    def names(self) -> Mapping[str, Value]:
        """Return the variables that every call begins with."""

    def constant(self, value: Any, place: Place) -> Value:
        """Return the value of what was typed."""

    def unknown(self, name: str, known: Iterable[str]) -> str:
        """Return what is said of a name without a value, where there are others."""

    def truth(self, value: Value, place: Place) -> Any:
        """Return a condition as one bool, where all lanes agree, or as flags (L,)."""

    def flag(self, truth: Any) -> Value:
        """Return the value of such a condition."""

    def uniform(self, value: Value, place: Place) -> bool:
        """Return a condition that must be the same in all lanes."""

    def rule(self, operator: str, place: Place) -> Rule:
        """Return what an operator does with two operands."""

    def prefix(self, operator: str, place: Place) -> Callable[[Value], Value]:
        """Return what an operator does with one operand."""

    def check_stored(self, value: Value, mask: Some, place: Place, run: Run) -> None:
        """Say what may not be stored in a variable; the mask is (L,)."""

    def check_kept(self, name: str, old: Value, new: Value, place: Place) -> None:
        """Say where a variable would change its type."""

    def size(self, value: Value) -> int:
        """Return how many numbers a variable takes up."""

    def merged(self, flags: Any, new: Value, old: Value, place: Place, run: Run, returned: int = 0) -> Value:
        """Return ``new`` where ``flags`` (L,) hold, else ``old``; 1: it is returned, 2: it is a part of that."""

    def zero(self, of: Any) -> Value:
        """Return what a variable of a type begins with that is declared without a value."""

    def typed(self, of: Any, value: Value, place: Place, name: str) -> Value:
        """Return the value that a variable of a type is declared with."""

    def many(
        self, parts: Sequence[Value], starred: Sequence[bool], mask: Some, place: Place, run: Run
    ) -> Value:
        """Return a list; of a starred part its elements; the mask is (L,)."""

    def elements(self, value: Value, mask: Some, place: Place, run: Run) -> list[Value]:
        """Return the elements of a value that has as many in every lane; the mask is (L,)."""

    def unpacked(
        self, value: Value, starred: Sequence[bool], mask: Some, place: Place, run: Run
    ) -> list[Value]:
        """Return a value for each of several names; one of them may be starred."""

    def turns(self, value: Value, mask: Some, place: Place, run: Run) -> Turn:
        """Return the rounds of a loop over a value; the mask is (L,)."""

    def put(self, whole: Value, value: Value, mask: Some, place: Place, run: Run) -> None:
        """Put a value at the end of a list; the mask is (L,)."""

    def part(self, whole: Value, index: Value, mask: Some, place: Place, run: Run) -> Value:
        """Return an element; the mask is (L,)."""

    def with_part(self, whole: Value, index: Value, new: Value, mask: Some, place: Place, run: Run) -> Value:
        """Return a value with another element; the mask is (L,)."""

    def field(self, whole: Value, name: str, place: Place) -> Value:
        """Return a part that has a name."""

    def call(self, name: str, values: Sequence[Value], mask: Some, place: Place, run: Run) -> Value:
        """Return what a function of the language makes of values; the mask is (L,)."""

    def arguments(
        self, name: str, parameters: Sequence[str], values: Sequence[Value], place: Place
    ) -> Sequence[Value]:
        """Return the values that a function of the program is called with."""
