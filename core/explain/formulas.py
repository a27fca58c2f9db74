r"""Formulas: written once, as statements about terms, and printed in symbols and in numbers, cell under cell.

A row writes arithmetic on named numbers, ``D.equals(2 * dy - dx)``, and its sentence the same numbers. Symbols of
corners and edges 0, 1, 2 get their colours from `FormulaView`, which knows them by their subscript or by
``\vertex{k}{...}``.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isnan

from core.explain.digits import spoken
from core.explain.number_text import position_text
from core.explain.records import Formula
from core.explain.statements import Chain, about_equal, checkable_digits
from core.explain.term_latex import TermLatex, Written
from core.records.terms import Applied, Leaf, Operation, Term, term


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
