"""What is said of a text that cannot be read or run: a place in it, and one sentence."""

from typing import NamedTuple


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
