"""What explanations hand to lessons and widgets: formulas, variables, stage cards, questions and verdicts."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

Value = float | int | bool | str | tuple[float, ...] | None
"""What a variable can hold; None: it has no value."""


@dataclass(frozen=True)
class Formula:
    """Two lines of LaTeX; with equal cell counts (see `core.explain.latex`) numbers stand under their symbols."""

    symbolic: str
    r"""The law in symbols, as ``E_0 = a_0 x + b_0 y + c_0``; ``\vertex{k}{...}`` colours other symbols."""
    substituted: str = ""
    """The same with the numbers of this step put in; may be empty."""
    digits: Mapping[float, int] = field(default_factory=dict, compare=False)
    """Size of each number that the second line shows, to its significant digits: whatever shows it has as many."""


@dataclass(frozen=True)
class StageCard:
    """The card of one stage; every text is one or two short sentences."""

    title: str
    gets: str
    gives: str
    purpose: str
    source: str = ""
    """Author, title, year, or the lecture."""


@dataclass(frozen=True)
class Variable:
    """One variable at a step."""

    name: str
    now: Value
    before: Value = None
    """The value before the step; it counts as changed where it differs from `now`."""
    meaning: str = ""
    """One sentence for the tooltip."""
    vertex: int | None = None
    """0, 1 or 2 where the variable belongs to that vertex, edge or weight."""
    digits: Mapping[float, int] = field(default_factory=dict, compare=False)
    """Significant digits of numbers by their size, as the formula of the step shows them; of others the usual four."""
    column: str = ""
    """Its column in the trace."""
    share: float | None = None
    """What part of a whole it is, which is drawn as a bar; ``None``: of none."""
    element: int | None = None
    """Which number of that column's array it is; ``None``: all of it."""

    def is_changed(self) -> bool:
        """Return whether the step changed it; NaN equals NaN here."""
        return not _is_same(self.now, self.before)


def _is_same(first: Value, second: Value) -> bool:
    if isinstance(first, tuple) and isinstance(second, tuple):
        return len(first) == len(second) and all(map(_is_same, first, second))
    if isinstance(first, float) and isinstance(second, float) and math.isnan(first) and math.isnan(second):
        return True
    return first == second


class AnswerKind(Enum):
    """How a question is answered."""

    NUMBER = "number"
    CHOICE = "choice"
    GRID = "grid"


@dataclass(frozen=True)
class Question:
    """Something to predict, as it is shown."""

    text: str
    kind: AnswerKind
    choices: tuple[str, ...] = ("Yes", "No")
    """Buttons of a choice."""


@dataclass(frozen=True)
class Asked:
    """What can be asked about a step, and what is right."""

    text: str
    answer: float
    """The number, or the index of the right choice."""
    reveal: str
    """One sentence with the value."""
    choices: tuple[str, ...] = ()
    """Empty: a number is asked for."""


def choice(text: str, answer: int, reveal: str, choices: tuple[str, ...] = ("Yes", "No")) -> Asked:
    """Return a question with choices; ``answer`` is the index of the right one."""
    return Asked(text, answer, reveal, choices)


def number(text: str, answer: float, reveal: str) -> Asked | None:
    """Return a question for a number; ``None`` where the answer is not finite."""
    return Asked(text, answer, reveal) if math.isfinite(answer) else None


@dataclass(frozen=True)
class Verdict:
    """What became of an answer."""

    is_right: bool | None
    """``None``: the value was shown without an answer."""
    text: str
    """One sentence with the value."""
