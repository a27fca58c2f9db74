r"""What a formula states: its line of numbers is read, worked out, and checked.

A line is cut into statements at ``\quad``, ``\land`` and ``\Rightarrow``. A statement is a chain of sides with
relations between them, as ``42 = -6 \cdot 0.5 + 45`` or ``-3 < 0``. A side that is no arithmetic (a name, a code,
words) leaves its statement unread.
"""

import math
import operator
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from core.explain.arithmetic import Leaf, Number, Term, UnreadError, in_full, read, work_out

RELATIONS = ("=", "<", ">", r"\le", r"\ge", r"\ne", r"\approx", r"\equiv")
MODULUS = r"(\mathrm{mod}"
"""How the modulus of a congruence begins."""
BREAKS = (r"\quad", r"\land", r"\lor", r"\Rightarrow")
"""What stands between statements."""
FLOAT_ERROR = Fraction(1, 2**44)
"""Error of float64 arithmetic, over the largest number that takes part."""
LEAST_DIGITS = 4
"""Digits to which the sides of an equation that is rounded agree at least."""

_COMPARISONS: dict[str, Callable[[Number, Number], bool]] = {
    "<": operator.lt,
    ">": operator.gt,
    r"\le": operator.le,
    r"\ge": operator.ge,
    r"\ne": operator.ne,
}


@dataclass(frozen=True)
class Statement:
    """Sides with relations between them."""

    sides: tuple[Term, ...]
    relations: tuple[str, ...]
    places: tuple[int, ...]
    """Index of the cell of each relation."""
    modulus: Fraction = Fraction(0)
    """Of a congruence."""

    def holds(
        self, leaf: Leaf = in_full, digits: Callable[[Term], int] = operator.attrgetter("digits")
    ) -> bool:
        """Return whether all relations hold, for numbers that count as ``leaf`` says.

        Parameters
        ----------
        leaf : callable
            Returns the value of a marked number.
        digits : callable
            Returns the significant digits of a side that is one number.
        """
        found = [work_out(side, leaf) for side in self.sides]
        return all(
            self._relates(place, relation, found, digits) for place, relation in enumerate(self.relations)
        )

    def _relates(
        self, place: int, relation: str, found: list[tuple[Number, Fraction]], digits: Callable[[Term], int]
    ) -> bool:
        (first, one), (second, other) = found[place : place + 2]
        if relation not in ("=", r"\approx", r"\equiv"):
            return bool(_COMPARISONS[relation](first, second))
        if is_same(first, second):
            return True
        if relation == r"\equiv" and self.modulus and math.isfinite(first - second):
            turns = round((Fraction(first) - Fraction(second)) / self.modulus)
            first, second = Fraction(first), Fraction(second) + turns * self.modulus
        sides = self.sides[place : place + 2]
        if not math.isfinite(first - second) or any(side.is_rounded for side in sides):
            return False
        unit = Fraction(0)
        for value, side in zip((first, second), sides, strict=True):
            if side.is_alone:
                unit = max(unit, last_unit(value, max(LEAST_DIGITS, digits(side.number))))
        return abs(Fraction(first) - Fraction(second)) <= unit + FLOAT_ERROR * max(one, other)

    def is_exact(self, place: int, leaf: Leaf) -> bool:
        """Return whether the sides beside a relation are equal to the last digit."""
        first, second = (work_out(side, leaf)[0] for side in self.sides[place : place + 2])
        return first == second or (is_nan(first) and is_nan(second))


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


def statements(cells: Sequence[str]) -> list[Statement]:
    """Return the statements of a line of numbers that can be read as arithmetic; marked numbers are read too."""
    found: list[Statement] = []
    start = 0
    for end in [*(k for k, cell in enumerate(cells) if cell in BREAKS), len(cells)]:
        part = [(place, cells[place]) for place in range(start, end)]
        start = end + 1
        try:
            if len(part) == 1 and part[0][1].startswith(MODULUS) and found:
                modulus, _ = work_out(read(part[0][1][len(MODULUS) : -1]))
                found[-1] = replace(found[-1], modulus=Fraction(modulus))
            elif (statement := _statement(part)) is not None:
                found.append(statement)
        except UnreadError:
            continue
    return found


def _statement(part: Sequence[tuple[int, str]]) -> Statement | None:
    """Return what neighbouring cells with their places state; ``None`` without a relation."""
    relations = [(place, cell) for place, cell in part if cell in RELATIONS]
    if not relations:
        return None
    sides: list[list[str]] = [[]]
    for _, cell in part:
        if cell in RELATIONS:
            sides.append([])
        else:
            sides[-1].append(cell)
    places, names = zip(*relations, strict=True)
    return Statement(tuple(read(" ".join(side)) for side in sides), names, places)
