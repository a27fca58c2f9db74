"""What all types of answers share: the verdict, and cells: numbers, words, pixels, places and options."""

import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, ClassVar

from core.records.cells import Cell, CellKind, Form, Lattice, Marks
from lessons.exercises.numbers import (
    Draws,
    Number,
    are_close,
    is_infinite,
    is_one_digit_off,
    number_text,
    plain_number,
    read_number,
    with_point,
)

# What all types of answers share.


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


# Cells of answers: numbers, words, pixels, places and options, each read, compared, written and guessed by
# itself.


Value = Any
"""A number; a word and a number, of which the latter may be missing; two outcodes; (column, row); (x, y); the number of
an option; ``None``: the cell is empty."""

ENTERS, LEAVES = "PE", "PL"
_CODES = re.compile(r"[01]{4} [01]{4}")
_DECIMALS = re.compile(r" \([^()]*\)$")
_WANTED = {
    "crossing": f"{ENTERS} or {LEAVES} and a number such as {ENTERS} 1/2, or none",
    "codes": "two outcodes such as 0101 0010",
}


def with_heads(heads: Iterable[str], texts: Iterable[str]) -> str:
    """Return a line for each text, behind its head."""
    return "\n".join(f"{head}{text}" for head, text in zip(heads, texts, strict=True))


def behind(text: str, heads: list[str]) -> list[str]:
    """Return what stands behind its head in each line of a text; ValueError where there are more or fewer lines."""
    return [line.removeprefix(head) for head, line in zip(heads, text.split("\n"), strict=True)]


def exact(text: str) -> str:
    """Return the text of a number without the decimals behind an exact fraction."""
    return _DECIMALS.sub("", text)


def exact_pair(text: str) -> list[str]:
    """Return the two numbers of a text in brackets."""
    return list(map(exact, text[1:-1].split(", ")))


def is_blank(given: object) -> bool:
    """Return whether nothing is given, or nothing but lists of empty texts."""
    if isinstance(given, list):
        return all(map(is_blank, given))
    return given is None or (isinstance(given, str) and not given.strip())


def read_entry(given: object, *, takes_comma: bool = False) -> Number:
    """Return one number of a file or form; NotCheckedError where it is none.

    ``takes_comma``: it stands alone, so that a comma in it can only be a decimal point.
    """
    if takes_comma and isinstance(given, str):
        given = with_point(given)
    if isinstance(given, bool) or not isinstance(given, str | int):
        raise NotCheckedError(f"expected a number, got {type(given).__name__}")
    if isinstance(given, str) and not given.strip():
        raise NotCheckedError("a number is missing")
    try:
        return read_number(given if isinstance(given, str) else str(given))
    except ValueError as problem:
        raise NotCheckedError(str(problem)) from None


def read_names(given: object, options: tuple[str, ...]) -> tuple[int, ...]:
    """Return the numbers of named options, each at most once."""
    if given in ("", [], None):
        raise NotCheckedError("the answer is empty")
    names = [given] if isinstance(given, str) else given
    if not isinstance(names, list):
        raise NotCheckedError(f"expected a list of options, got {type(given).__name__}")
    for name in names:
        if name not in options:
            raise NotCheckedError(f"expected one of {', '.join(options)}, got {name!r:.60}")
    if len(set(names)) != len(names):
        raise NotCheckedError("expected each option once, got one twice")
    return tuple(options.index(name) for name in names)


@dataclass(frozen=True)
class Entry(Cell):
    """A cell that is typed, pointed at or chosen."""

    stands_alone: bool = True
    """Whether a comma in a number can only be a decimal point."""

    def read(self, given: object) -> Value:
        """Return what an entry means; NotCheckedError where it means nothing."""
        if self.kind == "choice":
            chosen = read_names(given, self.options)
            if len(chosen) != 1:
                raise NotCheckedError(f"expected one of {', '.join(self.options)}, got {len(chosen)}")
            return chosen[0]
        if self.kind == "number":
            return read_entry(given, takes_comma=self.stands_alone)
        return self._read_pair(given) if self.kind in ("pixel", "place") else self._read_words(given)

    def _read_pair(self, given: object) -> Value:
        pair = given.strip("() ").split(",") if isinstance(given, str) else given
        if not isinstance(pair, list) or len(pair) != 2:
            raise NotCheckedError(f"expected two numbers for {self.label}, got {given!r:.60}")
        numbers = tuple(map(read_entry, pair))
        if self.kind == "place":
            return numbers
        if any(not isinstance(number, Fraction) or number.denominator != 1 for number in numbers):
            raise NotCheckedError(f"expected a pixel such as 3, 2, got {given!r:.60}")
        return tuple(map(int, numbers))

    def _read_words(self, given: object) -> Value:
        text = given.strip() if isinstance(given, str) else ""
        word, _, number = text.partition(" ")
        if self.kind == "crossing" and text == "none":
            return "none", None
        if self.kind == "crossing" and word in (ENTERS, LEAVES):
            return word, read_entry(number)
        if self.kind == "codes" and _CODES.fullmatch(text):
            return text
        raise NotCheckedError(f"expected {_WANTED[self.kind]}, got {given!r:.40}")

    def is_close(self, one: Value, other: Value) -> bool:
        """Return whether two values say the same, within the tolerance; an empty cell says nothing."""
        if one is None or other is None:
            return False
        if self.kind not in ("number", "crossing", "place"):
            return bool(one == other)
        return all(
            mine == its
            if isinstance(mine, str) or mine is None or its is None
            else are_close(mine, its, self.tolerance)
            for mine, its in zip(_parts(one), _parts(other), strict=True)
        )

    def is_digit_off(self, one: Value, other: Value, least: int = 1) -> bool:
        """Return whether two values differ by the sign of a number, or one digit of at least so many."""
        if self.kind not in ("number", "crossing") or one is None or other is None:
            return False
        (*words, mine), (*its_words, its) = _parts(one), _parts(other)
        return words == its_words and None not in (mine, its) and is_one_digit_off(mine, its, least)

    def text(self, value: Value) -> str:
        """Return a value as it was understood; an empty cell as ``...``."""
        text = "..." if value is None else self._written(value, number_text)
        return f"({text})" if self.kind in ("pixel", "place") else text

    def typed(self, value: Value) -> str:
        """Return a value as somebody would type it."""
        return "" if value is None else self._written(value, plain_number)

    def _written(self, value: Value, written: Callable[[Number], str]) -> str:
        if self.kind == "choice":
            return self.options[value]
        texts = [
            part if isinstance(part, str) else written(Fraction(part) if isinstance(part, int) else part)
            for part in _parts(value)
            if part is not None
        ]
        return (", " if self.kind in ("pixel", "place") else " ").join(texts)

    def guess(self, draws: Draws, like: Sequence[Value] = (), size: tuple[int, int] = (1, 1)) -> Value:
        """Return a guess: a number like those of ``like``, a pixel or place of a raster of ``size``, or any option."""
        columns, rows = size
        if self.kind == "choice":
            return draws.whole(0, len(self.options) - 1)
        if self.kind == "pixel":
            return draws.whole(0, columns - 1), draws.whole(0, rows - 1)
        if self.kind == "place":
            return Fraction(draws.whole(0, 10 * columns), 10), Fraction(draws.whole(0, 10 * rows), 10)
        if self.kind == "codes":
            # The nine regions around a window, for both ends.
            sides = [[draws.item(("00", "01", "10")) for _ in range(2)] for _ in range(2)]
            return " ".join("".join(codes) for codes in sides)
        number = random_number(draws, [_parts(value)[-1] for value in like if value is not None])
        return number if self.kind == "number" else (draws.item((ENTERS, LEAVES)), number)


def _parts(value: Value) -> tuple[Any, ...]:
    return value if isinstance(value, tuple) else (value,)


def random_number(draws: Draws, like: Sequence[Number | None]) -> Number:
    """Return a guess among numbers up to twice as large as those of ``like``; whole if all of them are."""
    finite = [number for number in like if number is not None and not is_infinite(number)]
    reach = 2 * max((int(max(number, -number)) for number in finite), default=0) + 10
    if all(isinstance(number, Fraction) and number.denominator == 1 for number in finite):
        return Fraction(draws.whole(-reach, reach))
    return Fraction(draws.whole(-100 * reach, 100 * reach), 100)


@dataclass(frozen=True)
class Dial(Lattice):
    """A number from ``low`` to ``high`` in steps that the learner changes."""

    kind: CellKind = "dial"
    low: Fraction = Fraction(0)
    high: Fraction = Fraction(1)
    step: Fraction = Fraction(1)
    corner: tuple[int, int, int] | None = None
    """Number of the primitive, its corner, 0 for x or 1 for y; ``None``: it is no coordinate of a corner."""

    @property
    def count(self) -> int:
        """How many values it has."""
        return (self.high - self.low) // self.step + 1

    @property
    def values(self) -> str:
        """What it can be, as ``0 to 8 in steps of 1/4 (0.25)``."""
        low, high, step = map(number_text, (self.low, self.high, self.step))
        return f"{low} to {high} in steps of {step}"

    def value(self, index: int) -> Fraction:
        """Return one of its values."""
        return self.low + index * self.step

    def index(self, value: Fraction) -> int:
        """Return the index of one of its values."""
        return int((value - self.low) / self.step)

    def nearest(self, value: float) -> int:
        """Return the index of its value that is nearest to a number."""
        return min(max(round((Fraction(value) - self.low) / self.step), 0), self.count - 1)

    def snapped(self, value: float) -> str:
        """Return the text of its value that is nearest to a number."""
        return self.typed(self.value(self.nearest(value)))

    def read(self, given: object) -> Fraction:
        """Return the value that an entry of a file or a text means; NotCheckedError where it means none."""
        with placed(self.label):
            number = read_entry(given)
        is_value = isinstance(number, Fraction) and self.low <= number <= self.high
        if not isinstance(number, Fraction) or not is_value or (number - self.low) % self.step:
            raise NotCheckedError(f"expected {self.label} from {self.values}, got {given!r:.40}")
        return number

    def text(self, value: Fraction) -> str:
        """Return a value with its decimals."""
        return number_text(value)

    def typed(self, value: Fraction) -> str:
        """Return a value as somebody would type it."""
        return plain_number(value)
