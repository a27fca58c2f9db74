"""Numbers of sentences and formulas: marks at first, which get their digits when all of a step is known.

A row of ``core.explain.subjects`` writes numbers, not digits: `spoken` returns a mark that holds the full
value. `core.explain.formulas.formula_of` finds the fewest digits with which the formula can be checked from
what it shows, and the sentence and the variables of the step show the same numbers with the same digits.
"""

import math
import re
from collections.abc import Mapping, Sequence

from core.explain.number_text import DIGITS, exact_text, latex_text
from core.records.words import joined

MARK = re.compile(r"\\num\{(?P<value>[^}]*)\}")
"""A marked number."""
MOST_DIGITS = 17
"""Digits that tell any two float64 apart."""


def spoken(value: float) -> str:
    """Return the mark of a number; its zero has no sign."""
    return rf"\num{{{float(value) + 0.0!r}}}"


def vector_text(values: Sequence[float]) -> str:
    """Return the marks of numbers in brackets."""
    return f"({', '.join(map(spoken, values))})"


def listed(values: Sequence[float]) -> str:
    """Return the marks of numbers as speech joins them."""
    return joined([spoken(value) for value in values])


REMAINDER = 2.0**-46
"""Up to this size beside 1, rounding alone keeps a number from 0: float64 has 52 bits, each operation rounds."""


def is_remainder(value: float, scale: float = 1.0) -> bool:
    """Return whether a number that is not 0 is 0 up to the rounding of numbers as large as ``scale``."""
    return 0 < abs(value) <= REMAINDER * scale


def remainder_note(values: Sequence[float]) -> str:
    """Return what is said of numbers that only rounding keeps from 0, as the end of a sentence; else nothing.

    It is meant for sums of float64 numbers as large as the largest of ``values``, never for numbers that decide.
    """
    scale = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
    found = list(dict.fromkeys(spoken(value) for value in values if is_remainder(value, scale)))
    return f"; {joined(found)} {'is' if len(found) == 1 else 'are'} 0 up to rounding" if found else ""


def in_words(text: str, digits: Mapping[float, int]) -> str:
    """Write the marked numbers of a sentence, with as many significant digits as ``digits`` has for their size."""
    return MARK.sub(lambda mark: exact_text(float(mark["value"]), _of(float(mark["value"]), digits)), text)


def in_latex(line: str, digits: Mapping[float, int]) -> str:
    """Write the marked numbers of a part of a formula."""
    return MARK.sub(lambda mark: latex_text(float(mark["value"]), _of(float(mark["value"]), digits)), line)


def _of(value: float, digits: Mapping[float, int]) -> int:
    return digits.get(abs(value), DIGITS)
