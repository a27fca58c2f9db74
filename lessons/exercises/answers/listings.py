"""The wrong line of a listing."""

from dataclasses import dataclass
from typing import ClassVar

from core.records.cells import Form
from lessons.exercises.answers.answer import Answer, NotCheckedError, Verdict
from lessons.exercises.draws import Draws


@dataclass(frozen=True, eq=False)
class LineAnswer(Answer):
    """A listing, one line of which is wrong."""

    lines: tuple[str, ...]
    reference: int
    """Number of the wrong line, from 0."""
    also: frozenset[int] = frozenset()
    """Lines that count as right, too."""

    kind: ClassVar[str] = "line"
    is_many: ClassVar[bool] = False

    def __post_init__(self) -> None:
        right = self.also | {self.reference}
        if len(self.lines) < 3 or not all(0 <= line < len(self.lines) for line in right):
            raise ValueError(
                f"expected a listing of 3 or more lines with the wrong one in it, got {len(self.lines)} lines"
            )

    @property
    def credit(self) -> str:
        """How points are given."""
        return "The wrong line earns all points."

    @property
    def chance(self) -> float:
        """Mean score of all lines that say something."""
        return len(self.also | {self.reference}) / len(self._telling)

    @property
    def _telling(self) -> list[int]:
        """Return the lines that hold a word or a number."""
        return [k for k, line in enumerate(self.lines) if any(mark.isalnum() for mark in line)]

    @property
    def offered(self) -> str:
        """The lines with their numbers, from 1."""
        return "\n".join(f"{k:>2}  {line}" for k, line in enumerate(self.lines, 1))

    @property
    def form(self) -> Form:
        """The lines."""
        return Form(self.kind, items=self.lines)

    def given(self, response: int) -> str:
        """Return the number of the line."""
        return str(response + 1)

    def read(self, given: object) -> int:
        """Read the number of a line, from 1."""
        if given in ("", [], None):
            raise NotCheckedError("the answer is empty")
        text = given.strip() if isinstance(given, str) else str(given) if type(given) is int else ""
        if not (text.isascii() and text.isdecimal() and len(text) <= 4 and 1 <= int(text) <= len(self.lines)):
            raise NotCheckedError(f"expected the number of a line, 1 to {len(self.lines)}, got {given!r:.40}")
        return int(text) - 1

    def check(self, response: int) -> Verdict:
        """Score a line."""
        is_right = response == self.reference or response in self.also
        number, mark = response + 1, "right" if is_right else "wrong"
        said = "is the wrong one" if is_right else "is as it should be"
        return Verdict(float(is_right), f"line {number} {said}", {mark: frozenset({response})})

    def is_same(self, one: int, other: int) -> bool:
        """Compare lines; all that count as right are the same."""
        right = self.also | {self.reference}
        return one == other or {one, other} <= right

    def text(self, response: int) -> str:
        """Return the line with its number."""
        return f"line {response + 1}: {self.lines[response].strip()}"

    def said(self, text: str) -> str:
        """Return the number of the line of a text."""
        return text.removeprefix("line ").partition(":")[0]

    def first_wrong(self, response: int) -> str:
        """Say whether the wrong line comes before or after."""
        if response in self.also | {self.reference}:
            return ""
        side = "after" if response < self.reference else "before"
        return f"The wrong line comes {side} line {response + 1}."

    def random(self, draws: Draws) -> int:
        """Guess a line that says something."""
        return draws.item(self._telling)

    def extremes(self) -> list[int]:
        """No answer takes all lines, or none."""
        return []
