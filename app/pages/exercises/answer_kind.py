"""What a type of answer is on the page: the form that takes it, what is in the form, its picture and its marks."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from core.records.frame import Frame
from core.records.sketch import Place
from lessons.exercises.answers.answer import NotCheckedError, Response, Verdict
from lessons.exercises.numbers import Number, read_number
from lessons.exercises.question import Draft, Question
from widgets.exercises.records import AnswerForm, AnswerMarks, Understood
from widgets.grid.buffer import GridBuffer
from widgets.grid.geometry import GridGeometry
from widgets.grid.overlay import Overlay


@dataclass(frozen=True, eq=False)
class Live:
    """What is drawn of an answer while it is given."""

    outline: GridGeometry | None
    picture: GridBuffer | None = None
    overlays: Sequence[Overlay] = ()


class AnswerKind:
    """How one type of answer is given, drawn and marked."""

    def form(self, answer: Any) -> AnswerForm:
        """Return the form that takes an answer."""
        raise NotImplementedError

    def given(self, answer: Any, response: Response) -> object:
        """Return what is in the form where it says a response."""
        raise NotImplementedError

    def read(self, answer: Any, given: Any) -> object:
        """Return what the answer reads of what is in the form."""
        del answer
        return given

    def marks(self, question: Question, response: Response, verdict: Verdict) -> AnswerMarks:
        """Return what is right in a response, and what is not."""
        raise NotImplementedError

    def numbers(self, draft: Draft) -> str:
        """Return the numbers of a question as text, but for what the form or the picture shows."""
        return draft.given

    def size(self, draft: Draft) -> tuple[int, int] | None:
        """Return columns and rows of the picture; ``None``: the question has none."""
        return None if draft.scene is None else draft.scene.size

    def place(self, answer: Any, given: Any) -> Place | None:
        """Return the point of the plane that is in the form; ``None``: it is none, or not typed yet."""
        del answer, given
        return None

    def live(self, draft: Draft, response: Response | None) -> Live | None:
        """Return what is drawn of a response, or before there is one; ``None``: nothing."""
        del draft, response
        return None


def plain_number(value: Number) -> str:
    """Return a number as somebody would type it."""
    if not isinstance(value, Fraction):
        return f"{value:.6g}"
    decimals = f"{float(value):.6g}"
    return decimals if Fraction(decimals) == value else str(value)


def number_of(text: str) -> float | None:
    """Return the number that a text means, or ``None``."""
    try:
        return float(read_number(text))
    except ValueError:
        return None


def understood(read: Callable[[str], str], text: str) -> Understood:
    """Return how a text is read, or why it means nothing."""
    try:
        return Understood(read(text), is_readable=True)
    except NotCheckedError as problem:
        return Understood(str(problem), is_readable=False)


def coverage_of(frame: Frame, title: str) -> GridBuffer:
    """Return what a frame covers: its primitives where it has several, else where anything is."""
    primitive = frame.primitive
    if int(primitive.max(initial=-1)) > 0:
        return GridBuffer("picture", primitive, "ids", title=title)
    return GridBuffer("picture", primitive >= 0, "bool", title=title)
