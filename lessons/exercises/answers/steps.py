"""Be the rasterizer: one step at a time, each judged at once; a wrong one is tried again or put right."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import prod
from typing import ClassVar

from core.records.cells import Form, StepLine, StepsState
from core.records.words import counted
from lessons.exercises.answers.answer import (
    Answer,
    Entry,
    NotCheckedError,
    Value,
    Verdict,
    behind,
    exact,
    exact_pair,
    with_heads,
)
from lessons.exercises.numbers import Draws

Tries = tuple[Value, ...]
"""What was tried at a step, in order; ``FIXED`` last where the program put it right."""
Run = tuple[Tries, ...]
"""The steps that were done, and the one that is being tried."""

FIXED = None
"""In place of a try: the program put the step right."""
TRY_LIMIT = 20
"""Most tries of a step that are read."""


def _is_done(step: Entry, tries: Tries) -> bool:
    """Return whether a step is right by now."""
    return bool(tries) and (tries[-1] is FIXED or step.is_close(tries[-1], step.right))


@dataclass(frozen=True, eq=False)
class StepsAnswer(Answer):
    """The steps of a run, each from the right state before it: only a first try earns."""

    steps: tuple[Entry, ...]
    size: tuple[int, int] = (1, 1)
    """Columns and rows of the raster, for pixels and places."""

    kind: ClassVar[str] = "steps"
    slip: ClassVar[str] = "A slip: all steps but one were right at once."

    def __post_init__(self) -> None:
        if not self.steps:
            raise ValueError("expected steps, got none")

    @property
    def reference(self) -> Run:
        """Every step right at the first try."""
        return tuple((step.right,) for step in self.steps)

    @property
    def offered(self) -> str:
        """The steps with their numbers, and what each wants."""
        wanted = (" | ".join(step.options) or f"a {step.kind}" for step in self.steps)
        heads = [f"{number}. {step.label}" for number, step in enumerate(self.steps, 1)]
        return with_heads(heads, (f" ({want})" for want in wanted))

    @property
    def credit(self) -> str:
        """How points are given."""
        return (
            f"Each of the {len(self.steps)} steps earns its share where the first try is right. "
            "A wrong step may be tried again, or be put right, and earns nothing."
        )

    @property
    def chance(self) -> float:
        """Mean score of a guess at every step; numbers and places are not guessed."""
        return sum(1 / self._count(step) for step in self.steps) / len(self.steps)

    def _count(self, step: Entry) -> float:
        """Return how many answers a step can be given."""
        if step.kind == "choice":
            return len(step.options)
        return self.size[0] * self.size[1] if step.kind == "pixel" else float("inf")

    @property
    def is_many(self) -> bool:
        """Whether there are more than a thousand runs."""
        return prod(map(self._count, self.steps)) > 1000

    def open_step(self, run: Run) -> int | None:
        """Return the number of the step that is asked now; ``None``: all are done."""
        done = len(run) - bool(run and not _is_done(self.steps[len(run) - 1], run[-1]))
        return done if done < len(self.steps) else None

    def tried(self, run: Run, value: Value) -> Run:
        """Return the run after one more try, or after ``FIXED``, at the step that is asked."""
        number = self.open_step(run)
        if number is None:
            raise ValueError("all steps are done")
        before = run[number] if number < len(run) else ()
        return (*run[:number], (*before, value))

    @property
    def form(self) -> Form:
        """The steps."""
        return Form(self.kind, tuple((step,) for step in self.steps), size=self.size, state=self.state)

    def state(self, given: list[list[str]]) -> StepsState:
        """Return how far a run is; NotCheckedError where its last try means nothing."""
        run = self.read(given) if given else ()
        number = self.open_step(run)
        lines = []
        for k, step in enumerate(self.steps):
            tries = run[k] if k < len(run) else ()
            texts = [step.text(value) for value in tries if value is not FIXED]
            standing = "open" if k == number else ""
            if FIXED in tries:
                standing, texts = "fixed", [*texts, step.text(step.right)]
            elif tries and k != number:
                standing = "right" if len(tries) == 1 else "wrong"
            lines.append(StepLine(step.label, ", then ".join(texts), standing))
        done = len(self.steps) if number is None else number
        pixels = frozenset(step.right for step in self.steps[:done] if step.kind == "pixel")
        asked = None if number is None else self.steps[number]
        return StepsState(tuple(lines), asked, done, is_missed=done < len(run), pixels=pixels)

    def given(self, response: Run) -> list[list[str]]:
        """Return the tries as texts."""
        return [
            ["fixed" if value is FIXED else step.typed(value) for value in tries]
            for step, tries in zip(self.steps, response, strict=False)
        ]

    def read(self, given: object) -> Run:
        """Read a list with a try, a list of tries or ``fixed`` for each step; the last ones may be missing."""
        if given in ("", [], None):
            raise NotCheckedError("the answer is empty")
        if not isinstance(given, list) or len(given) > len(self.steps):
            got = f"{len(given)}" if isinstance(given, list) else type(given).__name__
            raise NotCheckedError(f"expected a list of up to {len(self.steps)} steps, got {got}")
        run = []
        for number, (step, entry) in enumerate(zip(self.steps, given, strict=False)):
            tries = self._read_tries(step, entry)
            if not _is_done(step, tries) and number < len(given) - 1:
                tries = (*tries, FIXED)
            run.append(tries)
        return tuple(run)

    def _read_tries(self, step: Entry, entry: object) -> Tries:
        # A pixel or place as a list of two numbers is one try, not two.
        is_pair = step.kind in ("pixel", "place") and isinstance(entry, list) and len(entry) == 2
        is_one = not isinstance(entry, list) or (is_pair and not any(_is_pair(part) for part in entry))
        tries = [entry] if is_one else entry
        assert isinstance(tries, list)
        if not 1 <= len(tries) <= TRY_LIMIT:
            raise NotCheckedError(f"expected 1 to {TRY_LIMIT} tries of a step, got {len(tries)}")
        return tuple(FIXED if one == "fixed" else step.read(one) for one in tries)

    def check(self, response: Run) -> Verdict:
        """Count the steps whose first try is right."""
        marks: dict[str, list[int]] = {"right": [], "wrong": [], "fixed": []}
        for number, (step, tries) in enumerate(zip(self.steps, response, strict=False)):
            marks["right" if step.is_close(tries[0], step.right) else "wrong"].append(number)
            if FIXED in tries:
                marks["fixed"].append(number)
        right, count = len(marks["right"]), len(self.steps)
        wrong, left = len(marks["wrong"]), count - len(response)
        counts = f"{right} of {count} steps right, {wrong} wrong, {left} not done"
        return Verdict(right / count, counts, marks)

    def _first_wrong(self, run: Sequence[Tries]) -> int | None:
        for number, (step, tries) in enumerate(zip(self.steps, run, strict=False)):
            if not step.is_close(tries[0], step.right):
                return number
        return None

    def is_same(self, one: Run, other: Run) -> bool:
        """Compare the first tries; a run that is not finished says the same if it is wrong somewhere."""
        pairs = list(zip(self.steps, one, other, strict=False))
        if not all(_is_same_try(step, mine[0], its[0]) for step, mine, its in pairs):
            return False
        return len(one) == len(other) or self._first_wrong([mine for _, mine, _ in pairs]) is not None

    def is_slip(self, response: Run) -> bool:
        """All steps are done, and one alone went wrong."""
        is_complete = len(response) == len(self.steps) > 2
        return is_complete and len(self.check(response).marks["wrong"]) == 1

    def text(self, response: Run) -> str:
        """Return the steps, one a line, with all tries."""
        return "\n".join(
            f"{step.label}: {', then '.join(_try_text(step, value) for value in tries)}"
            for step, tries in zip(self.steps, response, strict=False)
        )

    def said(self, text: str) -> list[list[str | list[str]]]:
        """Return the tries of the steps of a text."""
        steps = self.steps[: text.count("\n") + 1]
        lines = behind(text, [f"{step.label}: " for step in steps])
        return [_said_tries(step, line) for step, line in zip(steps, lines, strict=True)]

    def left_out(self, response: Run) -> str:
        """Count the steps that are not done."""
        number = self.open_step(response)
        count = 0 if number is None else len(self.steps) - number
        return f"{counted(count, 'step')} {'is' if count == 1 else 'are'} not done" if count else ""

    def first_wrong(self, response: Run) -> str:
        """Name the first wrong step."""
        found = self._first_wrong(response)
        return "" if found is None else f"The first wrong step: {self.steps[found].label}."

    def random(self, draws: Draws) -> Run:
        """Guess every step."""
        return tuple((step.guess(draws, (step.right,), self.size),) for step in self.steps)

    def extremes(self) -> list[Run]:
        """Have every step put right, or do none."""
        return [((FIXED,),) * len(self.steps), ()]


def _is_same_try(step: Entry, one: Value, other: Value) -> bool:
    return one is other or step.is_close(one, other)


def _try_text(step: Entry, value: Value) -> str:
    return "fixed" if value is FIXED else step.text(value)


def _said_tries(step: Entry, line: str) -> list[str | list[str]]:
    if step.kind == "choice":  # An option may hold ", then" itself.
        longest_first = sorted((*step.options, "fixed"), key=len, reverse=True)
        return re.findall("|".join(map(re.escape, longest_first)), line)
    return [exact_pair(one) if one.startswith("(") else exact(one) for one in line.split(", then ")]


def _is_pair(given: object) -> bool:
    return isinstance(given, list) or (isinstance(given, str) and "," in given)


def first_tries(values: Sequence[Value], steps: Sequence[Entry]) -> Run:
    """Return a run of first tries; ``FIXED`` where there are fewer of them than steps."""
    missing = max(len(steps) - len(values), 0)
    return tuple((value,) for value in (*values[: len(steps)], *(FIXED,) * missing))
