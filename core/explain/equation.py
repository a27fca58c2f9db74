r"""Formulas cell by cell: every symbol has its number, so that the number stands under it.

A part of an equation is an operator, the same in both lines, or a pair of symbol and number. Symbols of
corners and edges 0, 1, 2 get their colours from `FormulaView`, which knows them by their subscript or by
``\vertex{k}{...}``.
"""

import math
from collections.abc import Sequence

from core.explain.number_text import EXACT_DIGITS, is_short, number_text, position_text
from core.explain.records import Formula
from core.raster.edges.snapping import SUBPIXELS

Part = str | tuple[str, float | str]
"""An operator, or a symbol with its number (or with LaTeX to stand under it)."""

DIGITS = 4
"""Significant digits of numbers that are not exact with ``EXACT_DIGITS``."""
MOST_DIGITS = 12
"""Significant digits that a number gets at most, where a sum would not come out with fewer."""
RELATIONS = {"=", "<", ">", r"\le", r"\ge", r"\quad", r"\land", r"\lor", r"\Rightarrow"}


def number_latex(value: float, digits: int = DIGITS) -> str:
    """Write a number: exactly where it is short, else with so many significant digits."""
    if math.isnan(value):
        return r"\mathrm{NaN}"
    if math.isinf(value):
        return r"\infty" if value > 0 else r"-\infty"
    text = repr(float(value) + 0.0).removesuffix(".0")
    if not is_short(value, max(EXACT_DIGITS, digits)):
        text = number_text(value, digits).replace("−", "-")
    if "e" in text:
        mantissa, exponent = text.split("e")
        return rf"{{{mantissa} \cdot 10^{{{exponent}}}}}"
    return text


def signed_latex(value: float, digits: int = DIGITS) -> str:
    """Write a number as it stands behind an operator: in brackets where it is negative."""
    text = number_latex(value, digits)
    return f"({text})" if text.removeprefix("{").startswith("-") else text


def grid_latex(value: float) -> str:
    """Write a position on the 1/256-pixel grid exactly: as a short decimal or a mixed fraction."""
    text = position_text([value])[1:-1]
    if "/" not in text:
        return number_latex(value)
    sign = "-" if value < 0 else ""
    *whole, fraction = text.removeprefix("−").split(" ")
    return rf"{sign}{''.join(whole)}\frac{{{fraction.split('/')[0]}}}{{{SUBPIXELS}}}"


def digits_that_add_up(value: float, products: Sequence[Sequence[float]]) -> int:
    """Return with how many digits a sum of products comes out on the board, to three digits of its value."""
    if not math.isfinite(value):
        return DIGITS
    for digits in range(DIGITS, MOST_DIGITS):
        found = sum(math.prod(_shown(factor, digits) for factor in product) for product in products)
        if abs(found - value) <= 5e-4 * abs(value) + 1e-9:
            return digits
    return MOST_DIGITS


def digits_that_differ(first: float, second: float) -> int:
    """Return with how many digits two different numbers are shown as different ones."""
    for digits in range(DIGITS, MOST_DIGITS):
        if first == second or number_latex(first, digits) != number_latex(second, digits):
            return digits
    return MOST_DIGITS


def _shown(value: float, digits: int) -> float:
    """Return a number as `number_latex` writes it."""
    is_exact = not math.isfinite(value) or is_short(value, max(EXACT_DIGITS, digits))
    return value if is_exact else float(f"{value:.{digits}g}")


def vector_latex(values: Sequence[float]) -> str:
    """Write numbers in brackets."""
    return f"({', '.join(map(number_latex, values))})"


def equation(*parts: Part, digits: int = DIGITS) -> Formula:
    """Put an equation together.

    Parameters
    ----------
    *parts : str or tuple
        Operators, and pairs of symbol and number.
    digits : int
        Significant digits of the numbers.

    Returns
    -------
    Formula
        Two lines of equally many cells.
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
        if isinstance(value, str):
            numbers.append(value)
        else:
            write = number_latex if previous in RELATIONS else signed_latex
            numbers.append(write(value, digits))
        previous = ""
    return Formula(" & ".join(symbols), " & ".join(numbers))


def linear(
    symbol: str, value: float, coefficients: Sequence[tuple[str, float]], *units: tuple[str, float]
) -> Formula:
    """Return ``value = first * unit + second * unit + ...``; a coefficient without a unit stands alone."""
    return equation(
        *linear_parts(symbol, value, coefficients, *units), digits=linear_digits(value, coefficients, *units)
    )


def linear_digits(value: float, coefficients: Sequence[tuple[str, float]], *units: tuple[str, float]) -> int:
    """Return with how many digits the sum of `linear` comes out."""
    factors = [unit for _, unit in units] + [1.0] * (len(coefficients) - len(units))
    products = [(number, factor) for (_, number), factor in zip(coefficients, factors, strict=True)]
    return digits_that_add_up(value, products)


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
    if math.isnan(value) or math.isnan(limit):
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


def difference(first: tuple[str, float], second: tuple[str, float], digits: int = DIGITS) -> tuple[str, str]:
    """Return a difference of two symbols, and that of their numbers."""
    numbers = f"{number_latex(first[1], digits)} - {signed_latex(second[1], digits)}"
    return f"{first[0]} - {second[0]}", numbers


def conclusion(wanted: str, found: str) -> list[Part]:
    """Return the arrow, what is asked, and what was found."""
    return [r"\Rightarrow", (rf"\text{{{wanted}}}", rf"\text{{{found}}}")]


CHANNEL_LETTERS = "rgba"


def outstanding(values: Sequence[float]) -> int:
    """Return the index of the value of greatest size; NaN is never the greatest."""
    return max(range(len(values)), key=lambda k: -1.0 if math.isnan(values[k]) else abs(values[k]))


def channel_symbol(name: str, channel: int) -> str:
    """Write the name of one channel of a colour."""
    return rf"\mathrm{{{name}}}_{{{CHANNEL_LETTERS[channel]}}}"
