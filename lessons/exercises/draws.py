"""Draws of a seed: the same on every machine and every Python.

Only ``random.Random(seed).random()`` is used, whose numbers Python keeps the same for ever; everything else that the
standard library draws may change between versions.
"""

from collections.abc import Sequence
from fractions import Fraction
from random import Random
from typing import TypeVar

Item = TypeVar("Item")

SEED_LIMIT = 10**9
"""Seeds are whole numbers from 0 up to this."""


class NoQuestionError(ValueError):
    """No question comes of one draw; another may make one."""


def reject(is_useless: bool) -> None:
    """Leave a draw of which no question comes, for the next one."""
    if is_useless:
        raise NoQuestionError("this draw makes no question")


class Draws:
    """What a template draws its question from."""

    def __init__(self, seed: int) -> None:
        if type(seed) is not int or not 0 <= seed <= SEED_LIMIT:
            raise ValueError(f"seed must be a whole number from 0 to {SEED_LIMIT}, got {seed!r}")
        self.seed = seed
        self._random = Random(seed)
        self.vain_searches = 0
        """How many long searches for a question have found none with these draws."""

    def fraction(self) -> float:
        """Draw a float from 0 to below 1."""
        return self._random.random()

    def whole(self, low: int, high: int) -> int:
        """Draw a whole number from ``low`` to ``high``, both included."""
        return low + int(self.fraction() * (high - low + 1))

    def step(self, low: Fraction, high: Fraction, step: Fraction) -> Fraction:
        """Draw one of ``low``, ``low + step`` ... up to ``high``, exactly."""
        return low + self.whole(0, (high - low) // step) * step

    def item(self, items: Sequence[Item]) -> Item:
        """Draw one of ``items``."""
        return items[self.whole(0, len(items) - 1)]

    def shuffled(self, items: Sequence[Item]) -> tuple[Item, ...]:
        """Draw an order of ``items`` (Fisher and Yates)."""
        mixed = list(items)
        for last in range(len(mixed) - 1, 0, -1):
            other = self.whole(0, last)
            mixed[last], mixed[other] = mixed[other], mixed[last]
        return tuple(mixed)
