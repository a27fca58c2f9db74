"""Listings as answers: the wrong line is found, or a listing is repaired or written and run beside the right one."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, TypeVar

from core import Settings, render
from core.edits.edit import Edit, apply_edit, original
from core.lanes.problem import Place, Problem
from core.records.cells import Form
from core.records.frame import Frame
from core.scene import ClipScene
from lessons.exercises.answers.answer import Answer, NotCheckedError, Verdict
from lessons.exercises.coding.shader_task import Beside, ShaderTask
from lessons.exercises.coding.task import Shown, Task, Wrong
from lessons.exercises.numbers import Draws

# The wrong line of a listing.


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


# A listing that is repaired or written: run beside the right one on hidden inputs, never as Python.


NAMES_SHOWN = 3
"""Most classes of inputs that are named."""
OPENED = 40
"""Most inputs that are drawn to find one whose pictures differ."""
MISSING, WRITE = "this line is missing", "write the rest"
"""What stands where a line, or a whole function, is to be written."""
Found = TypeVar("Found")


class CannotRunError(NotCheckedError):
    """A listing that cannot be read, or whose run cannot go on: it is no wrong answer."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(str(problem))
        self.place: Place = problem.place
        self.sentence = problem.sentence


@dataclass(frozen=True, eq=False)
class Opened:
    """A hidden input on which a listing is wrong, as the program runs it."""

    shown: Shown
    edit: Edit
    """What was written."""

    @property
    def typed(self) -> Settings:
        """Settings that run what was written; those of ``shown`` run what is right."""
        return apply_edit(self.shown.settings, self.edit)


def _ran(work: Callable[[], Found]) -> Found:
    """Do what runs a listing; CannotRunError where it cannot."""
    try:
        return work()
    except Problem as problem:
        raise CannotRunError(problem) from None


@dataclass(frozen=True, eq=False)
class CodeAnswer(Answer):
    """A listing; any that gives the same as the right one on all hidden inputs is right."""

    task: Task
    start: str
    """What stands in the editor at first: with a wrong line, without a line, or the head alone."""
    scene: ClipScene | None = None
    """What must be drawn otherwise, where a picture is shown."""

    kind: ClassVar[str] = "code"

    def __post_init__(self) -> None:
        if not self._right_classes(self.reference) == frozenset(self.task.cases):
            raise ValueError(f"the right listing of {self.task.name} is not right")
        if self._start_classes == frozenset(self.task.cases):
            raise ValueError("expected a listing that is wrong at first, got one that is right")

    @property
    def reference(self) -> str:
        """The right listing."""
        return self.task.text

    @property
    def named_mistakes(self) -> dict[str, str]:
        """By mistakes of the shelf, the listing that makes them."""
        return {fault.mistake: self.task.with_fault(fault) for fault in self.task.faults if fault.mistake}

    @property
    def credit(self) -> str:
        """How points are given."""
        count, classes = len(self.task.all_cases), len(self.task.cases)
        return (
            f"It is run on {count} inputs that are not shown, sorted by kind into {classes} classes. A class counts if "
            "all of its inputs are right; those that the listing has right at first earn nothing. Another way to write "
            "the same is right. A text that cannot run is not checked, and no points are lost."
        )

    @property
    def offered(self) -> str:
        """The listing as it is at first."""
        return self.start

    @cached_property
    def chance(self) -> float:
        """Mean score of listings that return something simple."""
        scores = [self.check(guess).score for guess in self.task.guessed]
        return sum(scores) / len(scores)

    @property
    def form(self) -> Form:
        """The listing in an editor."""
        return Form(self.kind, start=(self.start,))

    def problem(self, text: str) -> CannotRunError | None:
        """Return why a text cannot run, as far as that shows without inputs; ``None``: it can.

        Notes
        -----
        A long text may take seconds: not for the thread of a window.
        """
        try:
            self.task.check_text(text)
        except Problem as problem:
            return CannotRunError(problem)
        return None

    def given(self, response: str) -> str:
        """Return the listing."""
        return response

    def read(self, given: object) -> str:
        """Read a listing, which is not run yet; CannotRunError for a text that is none."""
        if given is None or given == []:
            raise NotCheckedError("the answer is empty")
        if not isinstance(given, str):
            raise NotCheckedError(f"expected a listing as text, got {type(given).__name__}")
        text = given.replace("\r\n", "\n").replace("\r", "\n").strip("\n").rstrip()
        if not text.strip():
            raise NotCheckedError("the answer is empty")
        _ran(lambda: self.task.read(text))
        return text

    def left_out(self, response: str) -> str:
        """Say that nothing is changed."""
        return "Nothing is changed yet" if response == self.start else ""

    def wrong(self, response: str) -> list[Wrong]:
        """Return the hidden inputs on which a listing is wrong, small ones first."""
        return _ran(lambda: self.task.wrong_cases(response))

    def _right_classes(self, response: str) -> frozenset[str]:
        return frozenset(self.task.cases) - {one.name for one in self.wrong(response)}

    @cached_property
    def _start_classes(self) -> frozenset[str]:
        """Classes that the listing has right at first."""
        try:
            return self._right_classes(self.start)
        except CannotRunError:
            return frozenset()

    def check(self, response: str) -> Verdict:
        """Run a listing on all hidden inputs."""
        right, total, before = self._right_classes(response), len(self.task.cases), len(self._start_classes)
        score = max((len(right) - before) / (total - before), 0.0)
        return Verdict(score, f"right in {len(right)} of {total} classes of inputs")

    def is_same(self, one: str, other: str) -> bool:
        """Compare what two listings return."""
        if one == other:
            return True
        try:
            return all(map(self.task.is_right, self.task.results(one), self.task.results(other)))
        except Problem:
            return False

    def text(self, response: str) -> str:
        """Return the listing."""
        return response

    def first_wrong(self, response: str) -> str:
        """Name classes of inputs that are wrong."""
        names = list(dict.fromkeys(one.name for one in self.wrong(response)))
        if not names:
            return ""
        more = f", and {len(names) - NAMES_SHOWN} more classes" if len(names) > NAMES_SHOWN else ""
        return f"Wrong: {', '.join(names[:NAMES_SHOWN])}{more}."

    def reason(self, response: str) -> str:
        """Tell the smallest input on which it is wrong, and what must come out."""
        wrong = self.wrong(response)
        if not wrong:
            return ""
        first, told = wrong[0], self.task.told
        said = first.case.said[0].upper() + first.case.said[1:]
        return f"{said}: yours {told(first.found)}; right {told(first.wanted)}."

    @property
    def is_stepped(self) -> bool:
        """Whether the program runs the right listing beside it somewhere."""
        return not self.task.draws_other and self.task.shown(self.task.all_cases[0][1]) is not None

    def opened(self, response: str) -> Opened | Beside | None:
        """Return the smallest wrong input whose picture differs, or else the smallest; ``None``: none is drawn.

        Of a shader, a scene that it draws otherwise. Raises ValueError where it cannot draw it.
        """
        if isinstance(self.task, ShaderTask):
            beside = self.task.beside(response)
            return beside if beside is not None and beside.differs else None
        found: list[Opened] = []
        for one in self.wrong(response) if self.is_stepped else []:
            shown = self.task.shown(one.case)
            if shown is None:
                continue
            found.append(Opened(shown, self._edit(shown, response)))
            if _differs(found[-1]):
                return found[-1]
            if len(found) == OPENED:
                break
        return found[0] if found else None

    def _edit(self, shown: Shown, text: str) -> Edit:
        """Return a listing in place of the program's, under the name that it has there."""
        if self.task.whole:
            return Edit(shown.part, shown.of, f"{self.task.whole}\n{text}")
        name = original(shown.part, shown.of).source.partition("(")[0]
        return Edit(shown.part, shown.of, re.sub(r"^def \w+", name, text, count=1))

    def drawn(self, response: str) -> Frame:
        """Return what a listing draws of the scene whose picture is wanted."""
        shown = self.task.shown(self.task.all_cases[0][1])
        if shown is None or self.scene is None:
            raise ValueError(f"{self.task.name} draws no picture")
        return render(self.scene, apply_edit(shown.settings, self._edit(shown, response)))

    @cached_property
    def picture(self) -> Frame | None:
        """What must be drawn, where that is shown."""
        return None if self.scene is None else self.drawn(self.reference)

    def random(self, draws: Draws) -> str:
        """Return something simple."""
        return draws.item(self.task.guessed)

    def extremes(self) -> list[str]:
        """Change nothing, where that runs."""
        return [self.start] if self.problem(self.start) is None else []


def _differs(opened: Opened) -> bool:
    frames = [render(opened.shown.scene, settings) for settings in (opened.shown.settings, opened.typed)]
    return any(
        bool((one != other).any())
        for one, other in (
            [frame.primitive for frame in frames],
            [frame.cover_count for frame in frames],
            [frame.color for frame in frames],
            [frame.depth for frame in frames],
        )
    )


def with_line(task: Task, number: int, line: str | None) -> str:
    """Return the right listing with another line, from 1, at the same depth; ``None``: without this one."""
    lines = task.text.split("\n")
    old = lines[number - 1]
    new = f"{task.note} {MISSING}" if line is None else line.strip()
    lines[number - 1] = old[: len(old) - len(old.lstrip())] + new
    return "\n".join(lines)


def head_alone(task: Task) -> str:
    """Return the head of the listing, and a note below it."""
    return f"{task.head}\n  {task.note} {WRITE}{task.tail}"
