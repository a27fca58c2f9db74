"""A number, a vector or a matrix."""

from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import ClassVar

from lessons.exercises.answers.answer import Answer, NotCheckedError, Verdict, placed
from lessons.exercises.draws import Draws
from lessons.exercises.numbers import (
    Number,
    are_close,
    is_infinite,
    is_one_digit_off,
    number_text,
    read_number,
    with_point,
)

Numbers = tuple[Number, ...]


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


@dataclass(frozen=True)
class NearMiss:
    """Wrong answers that earn something."""

    answers: tuple[Numbers, ...]
    share: Fraction
    """Of all points."""
    sentence: str
    """What earns this share, as the question states it."""


@dataclass(frozen=True, eq=False)
class NumberAnswer(Answer):
    """Numbers that are right all together or not at all, but for near misses with a price."""

    reference: Numbers
    """Row by row."""
    shape: tuple[int, ...] = ()
    """``()``: one number; (n,): a vector; (m, n): a matrix."""
    names: tuple[str, ...] = ()
    """Of the numbers, as the question calls them; empty: none."""
    tolerance: float = 0.0
    """Largest difference of each number, absolute."""
    near: tuple[NearMiss, ...] = ()

    kind: ClassVar[str] = "numbers"
    slip: ClassVar[str] = "A slip: a digit or the sign of one number is wrong."

    @property
    def offered(self) -> str:
        """The names of the numbers."""
        return f"Numbers: {', '.join(self.names)}" if self.names else ""

    @property
    def credit(self) -> str:
        """How points are given."""
        within = f" within {self.tolerance:g}" if self.tolerance else ""
        count = len(self.reference)
        all_points = "The number earns" if count == 1 else f"The {count} numbers together earn"
        return " ".join([f"{all_points} all points{within}.", *(miss.sentence for miss in self.near)])

    def read(self, given: object) -> Numbers:
        """Read a number, or lists of them."""
        if given in ("", [], None):
            raise NotCheckedError("the answer is empty")
        if not self.shape:
            return (read_entry(given, takes_comma=True),)
        return tuple(self._read(given, self.shape))

    def _read(self, given: object, shape: tuple[int, ...], first: int = 0) -> list[Number]:
        if not shape:
            with placed(self._place(first)):
                return [read_entry(given)]
        if not isinstance(given, list) or len(given) != shape[0]:
            got = f"{len(given)}" if isinstance(given, list) else type(given).__name__
            noun = "numbers" if len(shape) == 1 else "rows"
            raise NotCheckedError(f"expected a list of {shape[0]} {noun}, got {got}")
        step = prod(shape[1:])
        return [
            number
            for k, entry in enumerate(given)
            for number in self._read(entry, shape[1:], first + k * step)
        ]

    def check(self, response: Numbers) -> Verdict:
        """Score numbers, all or nothing."""
        right = [self._close(mine, its) for mine, its in zip(response, self.reference, strict=True)]
        count = f"{sum(right)} of {len(right)} numbers right"
        shares = [float(miss.share) for miss in self.near if self._is_near(miss, response)]
        wrong = [k for k, is_right in enumerate(right) if not is_right]
        return Verdict(1.0 if all(right) else max(shares, default=0.0), count, {"wrong": wrong})

    def _is_near(self, miss: NearMiss, response: Numbers) -> bool:
        return any(self.is_same(response, numbers) for numbers in miss.answers)

    def _close(self, one: Number, other: Number) -> bool:
        return are_close(one, other, self.tolerance)

    def is_same(self, one: Numbers, other: Numbers) -> bool:
        """Compare number by number, within the tolerance."""
        return all(self._close(mine, its) for mine, its in zip(one, other, strict=True))

    def is_slip(self, response: Numbers) -> bool:
        """One number alone is wrong, by a digit or its sign."""
        off = [
            (mine, its)
            for mine, its in zip(response, self.reference, strict=True)
            if not self._close(mine, its)
        ]
        return len(off) == 1 and is_one_digit_off(*off[0])

    def reason(self, response: Numbers) -> str:
        """Return what earns a near miss its share."""
        near = (miss.sentence for miss in self.near if self._is_near(miss, response))
        return next(near, "")

    def text(self, response: Numbers) -> str:
        """Return the numbers, one on a line where they have names."""
        texts = [number_text(number) for number in response]
        if self.names:
            return "\n".join(f"{name} = {text}" for name, text in zip(self.names, texts, strict=True))
        return ", ".join(texts)

    def first_wrong(self, response: Numbers) -> str:
        """Name the first number that is wrong, or its row and column; nothing where there is only one."""
        wrong = self.check(response).marks["wrong"]
        if not wrong or not (self.names or self.shape):
            return ""
        return f"The first number that is wrong: {self._place(wrong[0])}."

    def _place(self, number: int) -> str:
        if self.names:
            return self.names[number]
        if len(self.shape) == 1:
            return f"number {number + 1}"
        row, column = divmod(number, self.shape[1])
        return f"row {row + 1}, column {column + 1}"

    def random(self, draws: Draws) -> Numbers:
        """Guess numbers of the size and the fineness of the right ones."""
        return tuple(random_number(draws, self.reference) for _ in self.reference)

    def extremes(self) -> list[Numbers]:
        """Answer nothing but zeros, unless that is right."""
        zeros = (Fraction(0),) * len(self.reference)
        return [] if self.is_same(zeros, self.reference) else [zeros]


def random_number(draws: Draws, like: Numbers) -> Number:
    """Return a guess among numbers up to twice as large as those of ``like``; whole if all of them are."""
    finite = [number for number in like if not is_infinite(number)]
    reach = 2 * max((int(max(number, -number)) for number in finite), default=0) + 10
    if all(isinstance(number, Fraction) and number.denominator == 1 for number in finite):
        return Fraction(draws.whole(-reach, reach))
    return Fraction(draws.whole(-100 * reach, 100 * reach), 100)
