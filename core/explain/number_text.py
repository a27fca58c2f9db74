"""How numbers are read and written: as people type them, with four significant digits, in full, or in 1/256ths.

Everything that shows numbers uses these functions, sentences too, so one value reads the same everywhere.
"""

import math
import re
from collections.abc import Sequence

from core.raster.edges.snapping import SUBPIXELS

EXACT_DIGITS = 7
"""Formulas and variables write numbers out that are exact with so many digits."""

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


def number_text(value: float, digits: int = 4) -> str:
    """Write four significant digits with a true minus sign; whole numbers keep up to six."""
    if not math.isfinite(value):
        return _non_finite(value)
    if value == int(value) and abs(value) < 1e6:
        text = str(int(value))
        return (
            ("\u2212" + text) if value == 0 and math.copysign(1.0, value) < 0 else text.replace("-", "\u2212")
        )
    text = f"{value:.{digits}g}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        text = f"{mantissa}e{int(exponent)}"
    return text.replace("-", "\u2212")


def is_short(value: float, digits: int = EXACT_DIGITS) -> bool:
    """Return whether a number is exact with so many digits, without a power of ten."""
    text = repr(float(value))
    return "e" not in text and len(text.removesuffix(".0").replace(".", "").lstrip("-0")) <= digits


def exact_text(value: float) -> str:
    """Write a number in full where that is short, as formulas do, else with four significant digits."""
    return full_text(value) if math.isfinite(value) and is_short(value) else number_text(value)


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


def spoken(value: float) -> str:
    """Write a number with four significant digits; the zero of sentences has no sign."""
    return number_text(value + 0.0)


def vector_text(values: Sequence[float]) -> str:
    """Write numbers in brackets, four significant digits each."""
    return f"({', '.join(map(spoken, values))})"


def position_text(values: Sequence[float]) -> str:
    """Write a position on the 1/256-pixel grid exactly: ``(22.5, 41 77/256)``."""
    return f"({', '.join(map(_grid_text, values))})"


def _grid_text(value: float) -> str:
    if not math.isfinite(value) or value * 10**EXACT_DECIMALS == round(value * 10**EXACT_DECIMALS):
        return number_text(value + 0.0, 9)
    return fraction_text(value).removeprefix("~")


def pair_text(first: float, second: float) -> tuple[str, str]:
    """Write two numbers with as many digits, from four on, as it takes to tell them apart."""
    texts = spoken(first), spoken(second)
    for digits in range(5, 18):
        if first == second or texts[0] != texts[1]:
            break
        texts = number_text(first, digits), number_text(second, digits)
    return texts
