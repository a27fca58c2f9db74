r"""Formulas cell by cell: every symbol has its number, so that the number stands under it.

A part of an equation is an operator, the same in both lines, or a pair of symbol and number. Symbols of
corners and edges 0, 1, 2 get their colours from `FormulaView`, which knows them by their subscript or by
``\vertex{k}{...}``.
"""

from collections.abc import Sequence
from math import isnan

from core.explain.digits import in_latex, number_latex, signed_latex
from core.explain.number_text import position_text
from core.explain.records import Formula
from core.explain.statements import BREAKS, about_equal, checkable_digits, placed_statements
from core.explain.statements import RELATIONS as STATED
from core.raster.edges.snapping import SUBPIXELS

Part = str | tuple[str, float | str]
"""An operator, or a symbol with its number (or with LaTeX to stand under it)."""

RELATIONS = {*STATED, *BREAKS}


def grid_latex(value: float) -> str:
    """Write a position on the 1/256-pixel grid exactly: as a short decimal or a mixed fraction."""
    text = position_text([value])[1:-1]
    if "/" not in text:
        return number_latex(value)
    sign = "-" if value < 0 else ""
    *whole, fraction = text.removeprefix("−").split(" ")
    return rf"{sign}{''.join(whole)}\frac{{{fraction.split('/')[0]}}}{{{SUBPIXELS}}}"


def vector_latex(values: Sequence[float]) -> str:
    """Write numbers in brackets."""
    return f"({', '.join(map(number_latex, values))})"


def equation(*parts: Part) -> Formula:
    r"""Put an equation together.

    Parameters
    ----------
    *parts : str or tuple
        Operators, and pairs of symbol and number.

    Returns
    -------
    Formula
        Two lines of equally many cells. The numbers have the fewest digits with which all that is stated can be
        checked; between sides that are equal only about, ``=`` becomes ``\approx`` in the line of numbers.
    """
    symbols, numbers = [], []
    previous = "="
    for part in parts:
        if isinstance(part, str):
            symbols.append(part)
            numbers.append(part)
            previous = part
            continue
        symbol, value = part
        symbols.append(symbol)
        write = number_latex if previous in RELATIONS else signed_latex
        numbers.append(value if isinstance(value, str) else write(value))
        previous = ""
    stated = placed_statements(numbers)
    digits = checkable_digits([statement for statement, _ in stated])
    for statement, places in stated:
        for k in about_equal(statement, digits):
            numbers[places[k]] = r"\approx"
    symbolic, substituted = (in_latex(" & ".join(cells), digits) for cells in (symbols, numbers))
    return Formula(symbolic, substituted, digits)


def linear(
    symbol: str, value: float, coefficients: Sequence[tuple[str, float]], *units: tuple[str, float]
) -> Formula:
    """Return ``value = first * unit + second * unit + ...``; a coefficient without a unit stands alone."""
    return equation(*linear_parts(symbol, value, coefficients, *units))


def linear_parts(
    symbol: str, value: float, coefficients: Sequence[tuple[str, float]], *units: tuple[str, float]
) -> list[Part]:
    """Return the parts of `linear`."""
    parts: list[Part] = [(symbol, value), "="]
    for place, coefficient in enumerate(coefficients):
        parts += [] if place == 0 else ["+"]
        parts.append(coefficient)
        parts += [r"\cdot", units[place]] if place < len(units) else []
    return parts


def relation(value: float, limit: float = 0.0) -> str:
    """Return the relation that holds between a number and a limit."""
    if isnan(value) or isnan(limit):
        return r"\ne"
    return "<" if value < limit else ">" if value > limit else "="


def comparison(symbol: str, wanted: str, value: float, limit: float = 0.0) -> list[Part]:
    """Return what is asked of a number over what holds: ``E_0 > 0`` over ``-3 < 0``."""
    return [(symbol, value), (wanted, relation(value, limit)), number_latex(limit)]


def all_of(comparisons: Sequence[Sequence[Part]], *conclusion: Part, word: str = r"\land") -> Formula:
    """Join comparisons by a word, and conclude."""
    parts: list[Part] = []
    for place, compared in enumerate(comparisons):
        parts += [word] if place else []
        parts += compared
    return equation(*parts, *conclusion)


def beside(*equations: Sequence[Part]) -> list[Part]:
    """Set equations beside each other."""
    parts: list[Part] = []
    for found in equations:
        parts += [r"\quad"] if parts else []
        parts += found
    return parts


def fraction(
    above: tuple[str, float | str], below: tuple[str, float | str], vertex: int | None = None
) -> tuple[str, str]:
    """Return a fraction of two symbols over that of their numbers, in the colour of a ``vertex``."""
    symbols = rf"\frac{{{above[0]}}}{{{below[0]}}}"
    texts = [text if isinstance(text, str) else number_latex(text) for _, text in (above, below)]
    numbers = rf"\frac{{{texts[0]}}}{{{texts[1]}}}"
    return (symbols if vertex is None else rf"\vertex{{{vertex}}}{{{symbols}}}"), numbers


def difference(first: tuple[str, float], second: tuple[str, float]) -> tuple[str, str]:
    """Return a difference of two symbols, and that of their numbers."""
    numbers = f"{number_latex(first[1])} - {signed_latex(second[1])}"
    return f"{first[0]} - {second[0]}", numbers


def conclusion(wanted: str, found: str) -> list[Part]:
    """Return the arrow, what is asked, and what was found."""
    return [r"\Rightarrow", (rf"\text{{{wanted}}}", rf"\text{{{found}}}")]


CHANNEL_LETTERS = "rgba"


def outstanding(values: Sequence[float]) -> int:
    """Return the index of the value of greatest size; NaN is never the greatest."""
    return max(range(len(values)), key=lambda k: -1.0 if isnan(values[k]) else abs(values[k]))


def channel_symbol(name: str, channel: int) -> str:
    """Write the name of one channel of a colour."""
    return rf"\mathrm{{{name}}}_{{{CHANNEL_LETTERS[channel]}}}"
