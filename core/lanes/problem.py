"""What is said of a text that cannot be read or run, and the limits of such texts in one table."""

from dataclasses import dataclass, fields
from typing import NamedTuple

# What is said of a text that cannot be read or run: a place in it, and one sentence.


class Place(NamedTuple):
    """Where something stands in a text; both are counted from 1."""

    line: int
    column: int = 1


class Problem(ValueError):  # noqa: N818 - it is the word that the window says
    """A text that cannot be read, or a run of it that cannot go on."""

    def __init__(self, place: Place, sentence: str) -> None:
        super().__init__(place, sentence)
        self.place, self.sentence = place, sentence

    @property
    def line(self) -> int:
        """Line, from 1."""
        return self.place.line

    @property
    def column(self) -> int:
        """Column, from 1."""
        return self.place.column

    def __str__(self) -> str:
        return f"line {self.line}, column {self.column}: {self.sentence}"


def counted(count: int, noun: str) -> str:
    """Return a number with its noun, as ``1 value`` or ``3 values``."""
    return f"{count:,} {noun}{'' if count == 1 else 's'}"


# The limits of typed programs, in one table that the help and the tests read.


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
