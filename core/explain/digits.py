"""Numbers of sentences and formulas: marks at first, which get their digits when all of a step is known.

A row of ``core.explain.subjects`` writes numbers, not digits: `spoken` and `number_latex` return a mark that holds
the full value. `core.explain.equation.equation` finds the fewest digits with which the formula can be checked from what
it shows, and the sentence and the variables of the step show the same numbers with the same digits.
"""

import re
from collections.abc import Mapping, Sequence

from core.explain.number_text import DIGITS, exact_text, latex_text

MARK = re.compile(r"\\num(?P<signed>s?)\{(?P<value>[^}]*)\}")
"""A marked number; a signed one has brackets where it is negative."""
MOST_DIGITS = 17
"""Digits that tell any two float64 apart."""


def number_latex(value: float) -> str:
    """Return the mark of a number in a formula."""
    return rf"\num{{{float(value) + 0.0!r}}}"


def signed_latex(value: float) -> str:
    """Return the mark of a number that stands behind an operator: in brackets where it is negative."""
    return rf"\nums{{{float(value) + 0.0!r}}}"


def spoken(value: float) -> str:
    """Return the mark of a number in a sentence; its zero has no sign."""
    return number_latex(value)


def vector_text(values: Sequence[float]) -> str:
    """Return the marks of numbers in brackets."""
    return f"({', '.join(map(spoken, values))})"


def in_words(text: str, digits: Mapping[float, int]) -> str:
    """Write the marked numbers of a sentence, with as many significant digits as ``digits`` has for their size."""
    return MARK.sub(lambda mark: exact_text(float(mark["value"]), _of(float(mark["value"]), digits)), text)


def in_latex(line: str, digits: Mapping[float, int]) -> str:
    """Write the marked numbers of a formula."""

    def written(mark: re.Match[str]) -> str:
        value = float(mark["value"])
        text = latex_text(value, _of(value, digits))
        return f"({text})" if mark["signed"] and value < 0 else text

    return MARK.sub(written, line)


def _of(value: float, digits: Mapping[float, int]) -> int:
    return digits.get(abs(value), DIGITS)
