r"""What a formula states: sides with relations between them, as ``42 = -6 \cdot 0.5 + 45`` or ``-3 < 0``.

Each number has the fewest digits with which all that is stated can be checked from what is shown.
"""

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from core.explain.arithmetic import (
    Count,
    Number,
    is_arithmetic,
    is_rounded,
    lone_number,
    numbers_in,
    work_out,
)
from core.explain.digits import MOST_DIGITS
from core.explain.number_text import DIGITS, digit_count, shown_value
from core.records.terms import Leaf, Term

FLOAT_ERROR = Fraction(1, 2**44)
"""Error of float64 arithmetic, over the largest number that takes part."""
LEAST_DIGITS = 4
"""Digits to which the sides of an equation that is rounded agree at least."""

Relation = str | tuple[str, str]
"""The sign between two sides; two signs: the one that is asked, and the one that holds."""
_COMPARISONS: dict[str, Callable[[Number, Number], bool]] = {
    "<": operator.lt,
    ">": operator.gt,
    r"\le": operator.le,
    r"\ge": operator.ge,
    r"\ne": operator.ne,
}


@dataclass(frozen=True)
class Chain:
    """Sides with relations between them."""

    sides: tuple[Term, ...]
    relations: tuple[Relation, ...] = ()
    modulus: int = 0
    """Of a congruence, as a power of 2."""

    @property
    def is_arithmetic(self) -> bool:
        """Whether it states something that can be checked."""
        return bool(self.relations) and all(map(is_arithmetic, self.sides))

    def holds(self, count: Count, digits: Callable[[Leaf], int]) -> bool:
        """Return whether all relations hold.

        Parameters
        ----------
        count : callable
            Returns what a number counts as.
        digits : callable
            Returns the significant digits of a side that is one number.
        """
        found = [work_out(side, count) for side in self.sides]
        return all(
            self._relates(place, relation, found, digits)
            for place, relation in enumerate(held(self.relations))
        )

    def _relates(
        self, place: int, relation: str, found: list[tuple[Number, Fraction]], digits: Callable[[Leaf], int]
    ) -> bool:
        (first, one), (second, other) = found[place : place + 2]
        if relation not in ("=", r"\approx", r"\equiv"):
            return bool(_COMPARISONS[relation](first, second))
        if is_same(first, second):
            return True
        if relation == r"\equiv" and self.modulus and math.isfinite(first - second):
            turns = round((Fraction(first) - Fraction(second)) / 2**self.modulus)
            first, second = Fraction(first), Fraction(second) + turns * 2**self.modulus
        sides = self.sides[place : place + 2]
        if not math.isfinite(first - second) or any(map(is_rounded, sides)):
            return False
        unit = Fraction(0)
        for value, side in zip((first, second), sides, strict=True):
            if (alone := lone_number(side)) is not None:
                unit = max(unit, last_unit(value, max(LEAST_DIGITS, digits(alone))))
        return abs(Fraction(first) - Fraction(second)) <= unit + FLOAT_ERROR * max(one, other)

    def is_exact(self, place: int, count: Count) -> bool:
        """Return whether the sides beside a relation are equal to the last digit."""
        return is_same(*(work_out(side, count)[0] for side in self.sides[place : place + 2]))


def held(relations: Sequence[Relation]) -> tuple[str, ...]:
    """Return the relations that hold."""
    return tuple(sign if isinstance(sign, str) else sign[1] for sign in relations)


def is_nan(value: Number) -> bool:
    """Return whether a number is none."""
    return isinstance(value, float) and math.isnan(value)


def is_same(first: Number, second: Number) -> bool:
    """Return whether two numbers are equal; NaN equals NaN here."""
    return bool(first == second) or (is_nan(first) and is_nan(second))


def last_unit(value: Number, digits: int) -> Fraction:
    """Return what one unit of the last of so many significant digits is worth."""
    if not math.isfinite(value) or value == 0:
        return Fraction(0)
    return Fraction(10) ** (math.floor(math.log10(abs(float(value)))) + 1 - digits)


def checkable_digits(stated: Sequence[Chain]) -> dict[float, int]:
    """Return the size of every number to its significant digits, as few as it takes for all statements to hold."""
    digits = {
        abs(value): DIGITS for statement in stated for side in statement.sides for value in numbers_in(side)
    }
    for _ in range(MOST_DIGITS * len(stated)):
        failing = [statement for statement in stated if not _holds(statement, digits)]
        grown = {value for statement in failing for value in _growing(statement, digits)}
        if not grown:
            break
        digits |= {value: digits[value] + 1 for value in grown}
    return digits


def _holds(statement: Chain, digits: dict[float, int]) -> bool:
    """Return whether a statement holds for the digits that its numbers have."""

    def digits_of(number: Leaf) -> int:
        value = float(number.value)
        return digit_count(value, digits.get(abs(value), DIGITS))

    return statement.holds(lambda value: _shown(value, digits), digits_of)


def _growing(statement: Chain, digits: dict[float, int]) -> set[float]:
    """Return the sizes of the numbers that get a digit more: a lone result only where no other number can."""
    found = [{abs(value) for side in statement.sides for value in numbers_in(side)}]
    if {*held(statement.relations)} <= {"=", r"\approx", r"\equiv"}:
        found.insert(
            0, {abs(v) for side in statement.sides if lone_number(side) is None for v in numbers_in(side)}
        )
    for values in found:
        inexact = {
            v for v in values if digits[v] < MOST_DIGITS and _shown(v, digits) != shown_value(v, MOST_DIGITS)
        }
        if inexact:
            return inexact
    return set()


def about_equal(statement: Chain, digits: Mapping[float, int]) -> set[int]:
    """Return the places of relations ``=`` between sides that are equal only about, as they are shown."""
    return {
        place
        for place, relation in enumerate(statement.relations)
        if relation == "=" and not statement.is_exact(place, lambda value: _shown(value, digits))
    }


def _shown(value: float, digits: Mapping[float, int]) -> Fraction | float:
    return shown_value(value, digits.get(abs(value), DIGITS))
