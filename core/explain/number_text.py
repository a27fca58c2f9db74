"""Numbers in sentences and formulas: how they are written and read, and which digits they need.

Everything that shows numbers uses these functions, sentences too, so one value reads the same everywhere.

A row of a topic's ``told`` file writes numbers, not digits: `spoken` returns a mark that holds the full
value. `core.explain.formulas.formula_of` finds the fewest digits with which the formula can be checked from
what it shows, and the sentence and the variables of the step show the same numbers with the same digits.
"""

import math
import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import lru_cache

import numpy as np

from core.coverage.snapping import SUBPIXELS
from core.records.words import counted, joined

# How numbers are read and written: as people type them, with four significant digits, in full, or in
# 1/256ths.


DIGITS = 4
"""Significant digits of numbers that are not exact with a few more."""
EXACT_DIGITS = 7
"""Numbers are written out that are exact with so many digits."""
WHOLE_DIGITS = 12
"""Whole numbers are written out up to so many digits: depths of 2^38 steps, edge functions in whole numbers."""

_DECIMAL = r"(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?"
_NUMBER = re.compile(
    rf"^(?P<sign>[+\-]?)\s*(?:(?P<whole>\d+)\s+(?=\d+\s*/))?"
    rf"(?P<top>{_DECIMAL})?\s*(?:[*\u00b7]?\s*(?P<pi>pi|PI|Pi|\u03c0))?"
    rf"(?:\s*/\s*(?P<bottom>{_DECIMAL}))?$"
)
EXACT_DECIMALS = 3
"""Snapped positions with no more decimals are written as decimals, others in 1/256ths."""


def parse_number(text: str) -> float:
    """Read a number as people write it.

    Parameters
    ----------
    text : str
        A decimal (``-1.5``, ``1e-3``, ``0,25``), a fraction (``3/256``, ``1 1/2``), or multiple of pi
        (``pi/4``).

    Returns
    -------
    float
        The value; always finite.

    Raises
    ------
    ValueError
        With one plain sentence that says what was wanted.
    """
    found = _NUMBER.match(text.strip().replace("\u2212", "-"))
    if found is None or not (found["top"] or found["pi"]):
        raise ValueError("expected a number, such as 1.5, 3/256 or pi/4")
    value = float(found["top"].replace(",", ".")) if found["top"] else 1.0
    if found["pi"]:
        value *= math.pi
    if found["bottom"]:
        bottom = float(found["bottom"].replace(",", "."))
        if bottom == 0.0:
            raise ValueError("division by zero")
        value /= bottom
    value += float(found["whole"] or 0)
    if not math.isfinite(value):
        raise ValueError("the number is too large")
    return -value if found["sign"] == "-" else value


def full_text(value: float) -> str:
    """Return the shortest text that reads back to the same value, with a true minus sign."""
    if isinstance(value, int):
        return str(value).replace("-", "\u2212")
    if not math.isfinite(value):
        return _non_finite(value)
    text = repr(float(value))
    return text.removesuffix(".0").replace("-", "\u2212")


def number_text(value: float, digits: int = DIGITS) -> str:
    """Write four significant digits with a true minus sign; whole numbers keep up to six."""
    if not math.isfinite(value):
        return _non_finite(value)
    if value == int(value) and abs(value) < 1e6:
        text = str(int(value))
        return (
            ("\u2212" + text) if value == 0 and math.copysign(1.0, value) < 0 else text.replace("-", "\u2212")
        )
    text = rounded_text(value, digits)
    if "e" in text:
        mantissa, exponent = text.split("e")
        text = f"{mantissa}e{int(exponent)}"
    return text.replace("-", "\u2212")


def rounded_text(value: float, digits: int) -> str:
    """Return the text of a number as Python writes it, rounded to so many significant digits."""
    text = f"{value:.{digits}g}"
    return repr(float(value)).removesuffix(".0") if float(text) == value else text


def is_short(value: float, digits: int = EXACT_DIGITS) -> bool:
    """Return whether a number is exact with so many digits, or whole with up to `WHOLE_DIGITS`."""
    if not math.isfinite(value):
        return True
    if abs(value) < 10**WHOLE_DIGITS and value == int(value):
        return True
    text = repr(float(value))
    return "e" not in text and len(text.removesuffix(".0").replace(".", "").lstrip("-0")) <= digits


@lru_cache(maxsize=4096)
def exact_text(value: float, digits: int = DIGITS) -> str:
    """Write a number in full where that is short, as formulas do, else with so many significant digits."""
    if math.isfinite(value) and is_short(value, max(EXACT_DIGITS, digits)):
        return full_text(value + 0.0)
    return number_text(value + 0.0, digits)


def latex_text(value: float, digits: int = DIGITS) -> str:
    """Write the same number in LaTeX."""
    if math.isnan(value):
        return r"\mathrm{NaN}"
    if math.isinf(value):
        return r"\infty" if value > 0 else r"-\infty"
    text = exact_text(value, digits).replace("−", "-")
    if "e" in text:
        mantissa, exponent = text.split("e")
        return rf"{{{mantissa} \cdot 10^{{{exponent}}}}}"
    return text


@lru_cache(maxsize=4096)
def shown_value(value: float, digits: int = DIGITS) -> Fraction | float:
    """Return the value of what `exact_text` writes, without error; infinities and NaN as they are."""
    if not math.isfinite(value):
        return value
    is_in_full = is_short(value, max(EXACT_DIGITS, digits))
    return Fraction(repr(float(value)) if is_in_full else rounded_text(value, digits))


def digit_count(value: float, digits: int = DIGITS) -> int:
    """Return how many significant digits `exact_text` writes."""
    if not is_short(value, max(EXACT_DIGITS, digits)):
        return digits
    return len(repr(float(value)).removesuffix(".0").replace(".", "").lstrip("-0"))


def fraction_text(value: float) -> str:
    """Write an exact multiple of 1/256 as a mixed fraction; anything else rounded, with a leading ``~``."""
    if not math.isfinite(value):
        return _non_finite(value)
    scaled = value * SUBPIXELS
    if scaled != round(scaled):
        return "~" + number_text(value)
    whole, part = divmod(abs(round(scaled)), SUBPIXELS)
    sign = "\u2212" if value < 0 else ""
    if part == 0:
        return f"{sign}{whole}"
    lead = f"{whole} " if whole else ""
    return f"{sign}{lead}{part}/{SUBPIXELS}"


def _non_finite(value: float) -> str:
    if math.isnan(value):
        return "NaN"
    return "\u221e" if value > 0 else "\u2212\u221e"


def position_text(values: Sequence[float]) -> str:
    """Write a position on the 1/256-pixel grid exactly: ``(22.5, 41 77/256)``."""
    return f"({', '.join(map(_grid_text, values))})"


def _grid_text(value: float) -> str:
    if not math.isfinite(value) or value * 10**EXACT_DECIMALS == round(value * 10**EXACT_DECIMALS):
        return full_text(value + 0.0)
    return fraction_text(value).removeprefix("~")


def pair_text(first: float, second: float) -> tuple[str, str]:
    """Write two numbers with as many digits, from four on, as it takes to tell them apart."""
    for digits in range(DIGITS, 18):
        texts = exact_text(first, digits), exact_text(second, digits)
        if first == second or texts[0] != texts[1]:
            break
    return texts


FEW_STEPS = 1000
"""Steps of float32 up to which two numbers are close to each other."""


def steps_apart(first: float, second: float, is_whole: bool) -> str:
    """Return how far two stored depths are apart, in steps of their format; of float32 nothing where that is far.

    Parameters
    ----------
    first, second : float
        Whole numbers of steps, or numbers that float32 holds.
    is_whole : bool
        Whether the format stores whole numbers.
    """
    if not (math.isfinite(first) and math.isfinite(second)) or first == second:
        return ""
    if is_whole:
        return f"{counted(round(abs(first - second)), 'step')} apart"
    places = [int(np.float32(value).view(np.int32)) for value in (first, second)]
    steps = abs(places[0] - places[1])
    if math.copysign(1.0, first) != math.copysign(1.0, second) or steps > FEW_STEPS:
        return ""
    return f"{counted(steps, 'unit')} in the last place of float32 apart"


# Numbers of sentences and formulas: marks at first, which get their digits when all of a step is known.


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
