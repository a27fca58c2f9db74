"""The steps of a run on one lane: each line that ran, with all variables before and after it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from core.lanes.limits import LISTING, Limits
from core.lanes.masks import Some
from core.lanes.nodes import Assign, Declare, Each, If, Loop, Put, Return, Statement
from core.lanes.problem import Problem
from core.lanes.program import Program
from core.lanes.python_values import Log, at_lane
from core.lanes.run import Frame, Stop

KINDS: dict[type[Statement], str] = {
    Assign: "set",
    Declare: "set",
    Put: "append",
    If: "if",
    Loop: "while",
    Each: "for",
    Return: "return",
}


@dataclass(frozen=True, eq=False)
class LaneStep:
    """One line that ran."""

    statement: Statement
    before: Mapping[str, Any]
    """Variables by name, as plain numbers and lists."""
    after: Mapping[str, Any]
    value: Any
    """What was stored, put, tested or returned."""
    depth: int
    """In how many calls it stands; 1: in the listing itself."""
    unset: tuple[str, ...] = ()
    """Variables that it has read before they had a value, where the language allows that."""

    @property
    def kind(self) -> str:
        """What it does: ``set``, ``append``, ``if``, ``while``, ``for`` or ``return``."""
        return KINDS[type(self.statement)]

    @property
    def line(self) -> int:
        """Its line, from 1."""
        return self.statement.place.line

    @property
    def set(self) -> tuple[str, ...]:
        """Names of the variables that it gave another value."""
        missing = object()
        return tuple(
            name for name, value in self.after.items() if self.before.get(name, missing) is not value
        )


class _Recorder:
    """Notes what a run on one lane does."""

    def __init__(self, limits: Limits, hidden: Mapping[str, Any]) -> None:
        self.steps: list[LaneStep] = []
        self._limits, self._hidden = limits, hidden
        self._before: dict[int, dict[str, Any]] = {}
        self._plain: dict[int, tuple[Any, int, Any]] = {}

    def begin(self, statement: Statement, mask: Some, frame: Frame) -> None:
        """Keep the variables before a statement."""
        self._before[frame.depth] = self._variables(frame)

    def end(self, statement: Statement, mask: Some, frame: Frame, value: Any) -> None:
        """Keep the step."""
        if len(self.steps) >= self._limits.steps:
            raise Problem(statement.place, f"this takes more than {self._limits.steps:,} steps: stopped here")
        after, before = self._variables(frame), self._before[frame.depth]
        self.steps.append(LaneStep(statement, before, after, at_lane(value, 0), frame.depth))

    def _variables(self, frame: Frame) -> dict[str, Any]:
        return {name: self._kept(value) for name, value in frame.names.items() if name not in self._hidden}

    def _kept(self, value: Any) -> Any:
        """Return the plain value; of the same one as before the same object."""
        if not isinstance(value, list | Log):
            return value
        length = len(value.entries if isinstance(value, Log) else value)
        known = self._plain.get(id(value))
        if known is None or known[0] is not value or known[1] != length:
            known = self._plain[id(value)] = (value, length, at_lane(value, 0))
        return known[2]


def record_steps(
    program: Program, values: Sequence[Any], *, limits: Limits = LISTING, stop: Stop | None = None
) -> tuple[LaneStep, ...]:
    """Run a program on one lane, with plain numbers, and return its steps; raises `Problem`."""
    recorder = _Recorder(limits, program.dialect.names())
    program.run(values, 1, limits=limits, watch=recorder, stop=stop)
    return tuple(recorder.steps)


def steps_until_problem(
    program: Program, values: Sequence[Any], *, limits: Limits = LISTING, stop: Stop | None = None
) -> tuple[tuple[LaneStep, ...], Problem | None]:
    """Return the steps of a run on one lane, and what ended it; ``None``: it came to its end."""
    recorder = _Recorder(limits, program.dialect.names())
    try:
        program.run(values, 1, limits=limits, watch=recorder, stop=stop)
    except Problem as problem:
        return tuple(recorder.steps), problem
    return tuple(recorder.steps), None
