"""Channels of colours in formulas, which have the one that is strongest; the others follow the same law."""

from collections.abc import Sequence
from math import isnan

from core.explain.formulas import Named, below, named, upright

CHANNEL_LETTERS = "rgba"


def outstanding(values: Sequence[float]) -> int:
    """Return the index of the value of greatest size; NaN is never the greatest."""
    return max(range(len(values)), key=lambda k: -1.0 if isnan(values[k]) else abs(values[k]))


def in_channel(name: str, color: Sequence[float], channel: int) -> Named:
    """Return one channel of a colour, with the name of the colour."""
    return named(rf"{upright(name)}_{{{CHANNEL_LETTERS[channel]}}}", color[channel])


def letter_of(color: Sequence[float], channel: int, word: str = "") -> Named:
    """Return one channel of a colour with its letter, above a word that says which colour."""
    letter = CHANNEL_LETTERS[channel]
    return named(below(letter, word) if word else letter, color[channel])
