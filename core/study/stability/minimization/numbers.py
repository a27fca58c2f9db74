"""Numbers in fewer digits."""

from collections.abc import Iterator

DIGITS = 17
"""Significant digits of a float64."""


def simpler_numbers(value: float, simplest: float, digits: int) -> Iterator[float]:
    """Yield numbers near ``value`` that are written with fewer than ``digits`` digits, the simplest first."""
    seen = {value}
    for candidate in (simplest, *(float(f"{value:.{count}g}") for count in range(1, DIGITS))):
        if candidate not in seen and (digit_count(candidate) < digits or candidate == simplest != value):
            seen.add(candidate)
            yield candidate


def digit_count(value: float) -> int:
    """Return how many characters a number takes but for its sign; 0 for 0."""
    return 0 if value == 0 else len(f"{abs(value):g}" if float(f"{value:g}") == value else repr(abs(value)))
