r"""Formulas cell by cell: every symbol has its number, so that the number stands under it.

A part of an equation is an operator, the same in both lines, or a pair of symbol and number. Symbols of
corners and edges 0, 1, 2 get their colours from `FormulaView`, which knows them by their subscript or by
``\vertex{k}{...}``.
"""

import math
from collections.abc import Sequence

from widgets.formula import Formula
from widgets.typed_value import number_text

Part = str | tuple[str, float | str]
"""An operator, or a symbol with its number (or with LaTeX to stand under it)."""

EXACT_DIGITS = 7
"""Numbers that are exact with so many digits are written out, so that a sum on the board comes out."""
RELATIONS = {"=", "<", ">", r"\le", r"\ge", r"\quad", r"\land", r"\lor", r"\Rightarrow"}


def number_latex(value: float) -> str:
    """Write a number: exactly where it is short, else with four significant digits."""
    if math.isnan(value):
        return r"\mathrm{NaN}"
    if math.isinf(value):
        return r"\infty" if value > 0 else r"-\infty"
    text = repr(float(value) + 0.0).removesuffix(".0")
    if "e" in text or len(text.replace(".", "").lstrip("-0")) > EXACT_DIGITS:
        text = number_text(value).replace("−", "-")
    if "e" in text:
        mantissa, exponent = text.split("e")
        return rf"{{{mantissa} \cdot 10^{{{exponent}}}}}"
    return text


def signed_latex(value: float) -> str:
    """Write a number as it stands behind an operator: in brackets where it is negative."""
    text = number_latex(value)
    return f"({text})" if text.removeprefix("{").startswith("-") else text


def vector_latex(values: Sequence[float]) -> str:
    """Write numbers in brackets."""
    return f"({', '.join(map(number_latex, values))})"


def equation(*parts: Part) -> Formula:
    """Put an equation together.

    Parameters
    ----------
    *parts : str or tuple
        Operators, and pairs of symbol and number.

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
            numbers.append(number_latex(value) if previous in RELATIONS else signed_latex(value))
        previous = ""
    return Formula(" & ".join(symbols), " & ".join(numbers))


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


def conclusion(wanted: str, found: str) -> list[Part]:
    """Return the arrow, what is asked, and what was found."""
    return [r"\Rightarrow", (rf"\text{{{wanted}}}", rf"\text{{{found}}}")]
