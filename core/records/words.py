"""Counts and lists as sentences write them."""

from collections.abc import Sequence


def joined(words: Sequence[str]) -> str:
    """Join words as speech does: ``a``, ``a and b``, ``a, b and c``."""
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} and {words[-1]}"


def noun_of(count: int, noun: str, plural: str = "") -> str:
    """Return the noun that follows a count: ``pixel`` or ``pixels``."""
    return noun if count == 1 else plural or f"{noun}s"


def counted(count: int, noun: str, plural: str = "") -> str:
    """Write a count and its noun: ``1 pixel``, ``2 pixels``."""
    return f"{count:,} {noun_of(count, noun, plural)}"


def numbered(noun: str, numbers: Sequence[int]) -> str:
    """Write a noun and the numbers of what it means: ``edge 0``, ``edges 0 and 2``."""
    return f"{noun_of(len(numbers), noun)} {joined([str(number) for number in numbers])}"
