"""What a listing must do: its right text, the hidden inputs by class, and what a run of another text gives on them."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from math import isclose
from typing import Any, ClassVar

import numpy as np

from core import Settings
from core.edits.typed import Shape, returned, surroundings
from core.lanes.problem import LISTING, Problem, line_rounds
from core.lanes.program import Program, compile_listing
from core.lanes.python_values import Log, at_lane
from core.scene import ClipScene
from lessons.exercises.asked_text import parts_of

SIDE = 12
"""Columns and rows of the raster of hidden lines and triangles."""
LIMITS = replace(LISTING, rounds=line_rounds(SIDE, SIDE))
"""Of a run on all hidden inputs together."""
CLOSE = 1e-9
"""Relative difference of two numbers that are the same: a sum may be written in another order."""


@dataclass(frozen=True)
class Case:
    """One hidden input."""

    values: tuple[Any, ...]
    """Of the parameters: numbers, and tuples of them."""
    said: str
    """In words, as ``from (1, 2) to (3, 4)``."""
    about: tuple[Any, ...] = ()
    """What it is shown with."""
    size: float = 0.0
    """How long or large it is: of those that are wrong the smallest is told."""


Classes = Mapping[str, tuple[Case, ...]]
"""Hidden inputs by class, short ones first."""


def in_classes(cases: Iterable[tuple[str, Case]], most: int | None = None) -> Classes:
    """Return hidden inputs by their classes: all of them, or the first ``most`` of each."""
    found: dict[str, list[Case]] = {}
    for name, case in cases:
        found.setdefault(name, []).append(case)
    return {name: tuple(of[:most]) for name, of in found.items()}


@dataclass(frozen=True)
class Shown:
    """Where the program runs the listing on a hidden input."""

    scene: ClipScene
    settings: Settings
    part: str
    """A key of `core.edits.EDITABLE`."""
    of: str
    """The method whose listing it stands for."""
    stage: str
    pixel: tuple[int, int] | None = None


@dataclass(frozen=True)
class Fault:
    """A line of a right listing, and what a mistake makes of it."""

    line: str
    wrong: str
    mistake: str = ""
    """Its name on the shelf; empty: it has none."""


@dataclass(frozen=True, eq=False)
class Wrong:
    """A hidden input for which a text gives another value than the right one."""

    name: str
    """Of its class."""
    case: Case
    found: Any
    wanted: Any


@dataclass(frozen=True, eq=False)
class Task:
    """A function to be repaired or written."""

    name: str
    """As files name it."""
    stage: str
    title: str
    """Behind *repair* and *write*, as ``the inside test``."""
    asked: str
    """What it must do, with the rule that decides, and the hints; see `parts_of`."""
    text: str
    """A right listing: any other that gives the same is right, too."""
    cases: Classes
    faults: tuple[Fault, ...] = ()
    guesses: tuple[str, ...] = ()
    """What somebody returns who guesses."""
    shape: Shape = "number"
    """Of what is returned; see `core.edits.typed`."""
    words: str = ""
    """What is returned, as ``the list of pixels``."""
    written: Callable[[Any], str] = str
    """Writes a returned value in words."""
    of: Callable[..., Any] | None = None
    """The function of the program whose helpers and constants it knows."""
    plain: Callable[[Any], Any] = field(default=lambda value: value)
    """What counts of a returned value; ValueError with a sentence where it is none."""
    tolerance: float = CLOSE
    shown: Callable[[Case], Shown | None] = field(default=lambda _case: None)
    whole: str = ""
    """The program's listing that calls the function, where it is a part of one."""
    draws_other: bool = False
    """Whether the right text draws something else than the method whose listing it stands for."""

    note: ClassVar[str] = "#"
    """Begins a note in a line."""
    tail: ClassVar[str] = ""
    """Ends a text."""

    def told(self, value: Any) -> str:
        """Return a returned value in words."""
        return self.written(value)

    @property
    def purpose(self) -> str:
        """What it must do."""
        return parts_of(self.asked)[0]

    @property
    def head(self) -> str:
        """First line of the listing."""
        return self.text.partition("\n")[0]

    @property
    def guessed(self) -> list[str]:
        """Texts of somebody who guesses."""
        return [f"{self.head}\n  return {guess}" for guess in self.guesses]

    @property
    def all_cases(self) -> list[tuple[str, Case]]:
        """Every hidden input with its class."""
        return [(name, case) for name, cases in self.cases.items() for case in cases]

    def with_fault(self, fault: Fault) -> str:
        """Return the listing with a wrong line; ValueError where it has not one such line."""
        lines = self.text.split("\n")
        found = [k for k, line in enumerate(lines) if line.strip() == fault.line]
        if len(found) != 1:
            raise ValueError(f"{self.name} has not one line {fault.line!r}")
        lines[found[0]] = lines[found[0]].replace(fault.line, fault.wrong)
        return "\n".join(lines)

    def program(self, text: str) -> Program:
        """Return a text, compiled; `Problem` where it cannot be read."""
        return compile_listing(text, *(surroundings(self.of) if self.of is not None else ()))

    def read(self, text: str) -> Any:
        """Return a text, compiled, that takes what the task gives; nothing runs. `Problem` where it cannot."""
        program = self.program(text)
        self._check_head(program)
        return program

    def check_text(self, text: str) -> None:
        """Raise `Problem` for a text that cannot run: it runs on no lanes, through all branches."""
        self._check_run(self.read(text))

    def run(self, text: str) -> list[Any]:
        """Return what a text returns for every hidden input; `Problem` where its run cannot go on."""
        program, cases = self.read(text), self.all_cases
        self._check_run(program)
        value = program.run(
            _columns([case.values for _, case in cases], len(cases)),
            len(cases),
            limits=LIMITS,
            accept=lambda value, place: returned(value, self.shape, self.words, place),
        )
        try:
            return list(map(self.plain, lane_values(value, len(cases))))
        except ValueError as problem:
            raise Problem(program.functions[program.name].place, str(problem)) from None

    def _check_run(self, program: Program) -> None:
        program.check(
            _columns([case.values for _, case in self.all_cases[:1]], 0),
            limits=LIMITS,
            accept=lambda value, place: returned(value, self.shape, self.words, place),
        )

    def _check_head(self, program: Program) -> None:
        function = program.functions[program.name]
        wanted = _parameters(self)
        if len(function.parameters) != len(wanted):
            sentence = f"{function.name} is given {', '.join(wanted)}: its head must take them"
            raise Problem(function.place, sentence)

    def results(self, text: str) -> tuple[Any, ...]:
        """Return what a text returns for every hidden input, in plain numbers.

        Raises
        ------
        Problem
            Where it cannot be read, or its run cannot go on.
        """
        return _results(self, text)

    def is_right(self, found: Any, wanted: Any) -> bool:
        """Return whether two returned values are the same, within the tolerance."""
        if isinstance(wanted, list):
            return (
                isinstance(found, list)
                and len(found) == len(wanted)
                and all(map(self.is_right, found, wanted))
            )
        return found == wanted or (
            found == found and isclose(found, wanted, rel_tol=self.tolerance, abs_tol=self.tolerance)
        )

    def wrong_cases(self, text: str) -> list[Wrong]:
        """Return the inputs for which a text gives another value than the right one, small ones first."""
        pairs = zip(self.all_cases, self.results(text), self.results(self.text), strict=True)
        wrong = [
            Wrong(name, case, found, wanted)
            for (name, case), found, wanted in pairs
            if not self.is_right(found, wanted)
        ]
        return sorted(wrong, key=lambda one: one.case.size)


@lru_cache(maxsize=64)
def _parameters(task: Task) -> tuple[str, ...]:
    """Return what a task is given."""
    return task.program(task.text).parameters


@lru_cache(maxsize=512)
def _results(task: Task, text: str) -> tuple[Any, ...]:
    return tuple(task.run(text))


def _columns(rows: Sequence[tuple[Any, ...]], lanes: int) -> list[Any]:
    """Return values lane by lane as an array for each parameter; a tuple as a list of arrays."""
    return [
        _columns(column, lanes) if isinstance(column[0], tuple) else np.array(column)[:lanes]
        for column in zip(*rows, strict=True)
    ]


def lane_values(value: Any, lanes: int) -> list[Any]:
    """Return the plain value of every lane."""
    if isinstance(value, Log):
        found: list[list[Any]] = [[] for _ in range(lanes)]
        for mask, part in value.entries:
            values = lane_values(part, lanes)
            for lane in range(lanes) if mask is None else np.flatnonzero(mask).tolist():
                found[lane].append(values[lane])
        return found
    if isinstance(value, list):
        parts = [lane_values(part, lanes) for part in value]
        return [[part[lane] for part in parts] for lane in range(lanes)]
    if isinstance(value, np.ndarray) and value.ndim:
        made: list[Any] = value.tolist()
        return made
    return [at_lane(value, 0)] * lanes
