r"""Formulas: written once, as statements about terms, and printed in symbols and in numbers.

Each number has the fewest digits with which all that is stated can be checked from what is shown.

A row writes arithmetic on named numbers, ``D.equals(2 * dy - dx)``, and its sentence the same numbers. Symbols of
corners and edges 0, 1, 2 get their colours from `FormulaView`, which knows them by their subscript or by
``\vertex{k}{...}``.
"""

import math
import operator
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isnan

from core.explain.number_text import DIGITS, MOST_DIGITS, digit_count, position_text, shown_value, spoken
from core.explain.records import Formula
from core.explain.term_latex import (
    Count,
    Number,
    TermLatex,
    Written,
    is_arithmetic,
    is_rounded,
    lone_number,
    numbers_in,
    work_out,
)
from core.records.terms import Applied, Leaf, Operation, Term, term

# What a formula states: sides with relations between them, as ``42 = -6 \cdot 0.5 + 45`` or ``-3 < 0``.


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
        if relation not in ("=", r"\approx", r"\equiv", r"\to"):
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


# Formulas: written once, as statements about terms, and printed in symbols and in numbers, cell under cell.


@dataclass(frozen=True)
class Named(Leaf):
    """A number with the symbol that formulas have for it; in a sentence it is the number."""

    def __str__(self) -> str:
        return spoken(self.value)

    def equals(self, *others: Term | float) -> "Chain":
        """Return the statement that it equals the others."""
        return Chain((self, *map(term, others)), ("=",) * len(others))

    def compared(self, wanted: str = "", limit: Leaf | float = 0) -> Chain:
        """Return what is asked of it in symbols, over what holds in numbers: ``E_0 > 0`` over ``-3 < 0``.

        Without a relation that is wanted, what holds stands in both lines.
        """
        limit = limit if isinstance(limit, Leaf) else named("", limit)
        holds = relation(self.value, limit.value)
        return Chain((self, limit), ((wanted or holds, holds),))

    def of_vertex(self, k: int | None) -> "Named":
        """Return it with its symbol in the colour of a corner."""
        return self if k is None else Named(rf"\vertex{{{k}}}{{{self.symbol}}}", self.value)


@dataclass(frozen=True)
class Conclusion:
    """What follows from statements."""

    chains: tuple[Chain, ...]
    then: Term


Stated = Chain | Term | Conclusion


def concludes(wanted: str, found: str, *chains: Chain) -> Conclusion:
    """Return what is asked of all statements together, over what was found."""
    return Conclusion(chains, Written(rf"\text{{{wanted}}}", rf"\text{{{found}}}"))


def formula_of(*stated: Stated) -> Formula:
    r"""Print statements side by side.

    Parameters
    ----------
    *stated : Chain, Term or Conclusion
        What the step computes, or compares and concludes.

    Returns
    -------
    Formula
        Two lines of equally many cells. The numbers have the fewest digits with which all that is stated can be
        checked; between sides that are equal only about, ``=`` becomes ``\approx`` in the line of numbers.
    """
    pieces = list(_pieces(stated))
    digits = checkable_digits([piece for piece in pieces if isinstance(piece, Chain) and piece.is_arithmetic])
    symbols, numbers = (
        " & ".join(cell for piece in pieces for cell in _cells(piece, TermLatex(puts_in, digits)))
        for puts_in in (False, True)
    )
    return Formula(symbols, numbers, digits)


def _pieces(stated: Sequence[Stated]) -> Iterator[Chain | Term | str]:
    """Yield statements and terms, and what stands between them."""
    for place, piece in enumerate(stated):
        if place:
            yield r"\quad"
        if not isinstance(piece, Conclusion):
            yield piece
            continue
        for number, chain in enumerate(piece.chains):
            if number:
                yield r"\land"
            yield chain
        yield r"\Rightarrow"
        yield piece.then


def _cells(piece: Chain | Term | str, printer: TermLatex) -> list[str]:
    if isinstance(piece, str):
        return [piece]
    if isinstance(piece, Term):
        return printer.cells(piece)
    about = about_equal(piece, printer.digits) if printer.puts_in and piece.is_arithmetic else ()
    made = printer.cells(piece.sides[0])
    for place, (sign, side) in enumerate(zip(piece.relations, piece.sides[1:], strict=True)):
        shown = sign if isinstance(sign, str) else sign[printer.puts_in]
        made += [r"\approx" if place in about else shown, *printer.cells(side)]
    if piece.modulus:
        made += [r"\quad", rf"(\mathrm{{mod}} \, 2^{{{piece.modulus}}})"]
    return made


def named(symbol: str, value: float | list[float]) -> Named:
    """Return a number, or a vector, with its symbol."""
    return Named(symbol, value)


def limited(bound: str, wanted: Term, nominal: float, limit: str, value: float) -> Term:
    """Return what is wanted, or the limit that holds in its place: ``bound`` is ``min`` or ``max``.

    ``nominal`` is the whole number that is wanted, which stands in the numbers beside that of the limit.
    """
    if value == nominal:
        return wanted
    return call(bound, named(TermLatex(False).text(wanted), nominal), named(upright(limit), value))


def upright(word: str) -> str:
    """Write a word as a symbol."""
    return rf"\mathrm{{{word}}}"


def below(symbol: str, word: str) -> str:
    """Write a symbol with a word below it."""
    return rf"{symbol}_{{{upright(word)}}}"


def total(terms: Iterable[Term]) -> Term:
    """Return the sum of terms."""
    first, *others = terms
    for other in others:
        first = first + other
    return first


def first_of(summands: Sequence[Term], most: int) -> Term:
    """Return a sum of which at most so many summands are written out."""
    dots = [Written(r"\dots")] if len(summands) > most else []
    return total([*summands[:most], *dots])


def slash(above: Term | float, under: Term | float) -> Operation:
    """Return a fraction in one line: ``a / b``."""
    return Operation("÷", term(above), term(under))


def call(function: str, *arguments: Term | float) -> Applied:
    """Return a function of terms."""
    return Applied(function, tuple(map(term, arguments)))


HALF = term(1) / 2


def on_grid(symbol: str, value: float) -> Named:
    """Return a position on the 1/256-pixel grid, written exactly: as a short decimal or a mixed fraction."""
    return Named(symbol, Fraction(value)) if "/" in position_text([value]) else named(symbol, value)


def relation(value: float, limit: float = 0.0) -> str:
    """Return the relation that holds between a number and a limit."""
    if isnan(value) or isnan(limit):
        return r"\ne"
    return "<" if value < limit else ">" if value > limit else "="


# Channels of colours in formulas, which have the one that is strongest; the others follow the same law.


CHANNEL_LETTERS = "rgba"


def outstanding(values: Sequence[float]) -> int:
    """Return the index of the value of greatest size; NaN is never the greatest."""
    return max(range(len(values)), key=lambda k: -1.0 if isnan(values[k]) else abs(values[k]))


def in_channel(name: str, color: Sequence[float], channel: int) -> Named:
    """Return one channel of a colour, with the name of the colour."""
    return named(rf"{upright(name)}_{{{CHANNEL_LETTERS[channel]}}}", color[channel])


def letter_of(color: Sequence[float], channel: int, word: str = "") -> Named:
    """Return one channel of a colour with its letter, above a word that says which colour."""
    letter = CHANNEL_LETTERS[channel]
    return named(below(letter, word) if word else letter, color[channel])
