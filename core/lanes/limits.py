"""The limits of typed programs, in one table that the help and the tests read."""

from dataclasses import dataclass, fields

LARGEST = 2**53
"""Largest whole number: up to here float64 and int64 hold every one, and the sums of a line fit 64 bits."""
LARGEST_EXPONENT = 16
NAME_LENGTH = 60
"""Longest name of a version of a listing, in characters."""


@dataclass(frozen=True)
class Limits:
    """How large a text may be, and how much a run of it may take."""

    characters: int = 6_000
    """Characters of a text."""
    brackets: int = 32
    """Brackets, signs and conditions that stand in each other."""
    line_length: int = 300
    """Characters of a line."""
    rounds: int = 1_000
    """Rounds of a loop."""
    numbers: int = 4_096
    """Numbers of a list, those of its inner lists counted."""
    calls: int = 8
    """Calls, and lists, that stand in each other."""
    stored: int = 1_500_000
    """Numbers that variables and lists of a run take up, those of all lanes counted."""
    steps: int = 20_000
    """Steps of a run that is recorded."""
    seconds: float = 3.0
    """Seconds of a run: those in which the processor works for it, so that a busy machine ends none."""


LISTING = Limits()
"""Of a listing; of a line's loops see `line_rounds`."""
SHADER = Limits(characters=20_000, brackets=64)
"""Of a shader."""
LIMIT_NAMES = tuple(field.name for field in fields(Limits))


def line_rounds(width: int, height: int) -> int:
    """Return how many rounds a loop of a line's listing may take in a raster of this size."""
    return 4 * (width + height)
