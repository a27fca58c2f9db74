"""What all types of answers share."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, ClassVar

from core.records.cells import Form, Marks
from lessons.exercises.draws import Draws

Response = Any
"""An answer that was read: its type of answer knows its shape, and two that are the same compare equal."""


CANDIDATES = 64
"""Most answers of which a run is asked, where what chance gives is found by running."""


def spread(count: int, limit: int) -> list[int]:
    """Return all of 0 ... ``count`` - 1, or ``limit`` of them at even distances."""
    return [k * count // min(count, limit) for k in range(min(count, limit))]


class NotCheckedError(ValueError):
    """An answer is empty or malformed: it is not checked yet and costs nothing. The message is one sentence."""


@contextmanager
def placed(name: str) -> Iterator[None]:
    """Put the name of a cell before the sentence of a NotCheckedError."""
    try:
        yield
    except NotCheckedError as problem:
        raise NotCheckedError(f"{name}: {problem}") from None


@dataclass(frozen=True)
class Verdict:
    """What an answer earns, and why."""

    score: float
    """From 0 to 1."""
    counts: str
    """In words, as ``12 right, 1 missing, 2 extra``."""
    marks: Marks = field(default_factory=dict)
    """What is right and what is not."""


class Answer(ABC):
    """A type of answer with the right one."""

    kind: ClassVar[str]
    """The name of files, as ``pixels``."""
    named_limit: ClassVar[float] = 1.0
    """Largest score of an answer that is exactly what a known mistake gives."""
    slip: ClassVar[str] = "A slip: all but one is right."
    """What is said of a slip."""
    reference: Response
    """The right answer."""

    @property
    @abstractmethod
    def credit(self) -> str:
        """How points are given, as the question states it."""

    @property
    def offered(self) -> str:
        """What there is to choose from, to put in order or to fill in, as text; may be empty."""
        return ""

    @property
    def chance(self) -> float:
        """Mean score of random answers; 0: nothing to speak of."""
        return 0.0

    @property
    @abstractmethod
    def form(self) -> Form:
        """What the answer is given in."""

    @abstractmethod
    def given(self, response: Response) -> object:
        """Return what stands in the form where it says a response; `read` returns that."""

    @abstractmethod
    def read(self, given: object) -> Response:
        """Return what ``given``, from a TOML file or a form, means; NotCheckedError where it means nothing."""

    @property
    def is_many(self) -> bool:
        """Whether more than a thousand different answers can be given."""
        return True

    @abstractmethod
    def check(self, response: Response) -> Verdict:
        """Return what an answer earns."""

    def is_same(self, one: Response, other: Response) -> bool:
        """Return whether two answers say the same, within the tolerance."""
        return bool(one == other)

    def is_slip(self, response: Response) -> bool:
        """Return whether a wrong answer differs from the right one in the smallest way: one pixel, one digit."""
        return False

    @abstractmethod
    def text(self, response: Response) -> str:
        """Return an answer as text, as it was understood."""

    def said(self, text: str) -> object:
        """Return what `read` takes of a text that `text` has written; ValueError or IndexError where it is no such."""
        return text

    def left_out(self, response: Response) -> str:
        """Return a sentence without its full stop that says what an answer leaves empty; empty: nothing."""
        return ""

    def first_wrong(self, response: Response) -> str:
        """Return a sentence that says where a wrong answer goes wrong first, without what is right; may be empty."""
        return ""

    def reason(self, response: Response) -> str:
        """Return a sentence that says why a wrong answer is wrong, without what is right; may be empty."""
        return ""

    @abstractmethod
    def random(self, draws: Draws) -> Response:
        """Return an answer of somebody who guesses."""

    @abstractmethod
    def extremes(self) -> list[Response]:
        """Return the answers of somebody who marks all, or nothing: they must earn nothing."""
