"""How sentences write numbers: four significant digits, snapped positions exactly, counts with their noun."""

import math
from collections.abc import Sequence

from widgets.typed_value import fraction_text, number_text

EXACT_DECIMALS = 3
"""Snapped positions with no more decimals are written as decimals, others in 1/256ths."""


def spoken(value: float) -> str:
    """Write a number with four significant digits; the zero of sentences has no sign."""
    return number_text(value + 0.0)


def vector_text(values: Sequence[float]) -> str:
    """Write numbers in brackets, four significant digits each."""
    return f"({', '.join(map(spoken, values))})"


def position_text(values: Sequence[float]) -> str:
    """Write a position on the lattice of 1/256 pixel exactly: ``(22.5, 41 77/256)``."""
    return f"({', '.join(map(_lattice_text, values))})"


def _lattice_text(value: float) -> str:
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


def joined(words: Sequence[str]) -> str:
    """Join words as speech does: ``a``, ``a and b``, ``a, b and c``."""
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} and {words[-1]}"


def counted(count: int, noun: str, plural: str = "") -> str:
    """Write a count and its noun: ``1 pixel``, ``2 pixels``."""
    return f"{count:,} {noun if count == 1 else plural or f'{noun}s'}"
