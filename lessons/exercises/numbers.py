"""Numbers: drawn from a seed, the same on every machine; and as a learner writes them, ``1/3`` or ``sqrt(2)``.

Only ``random.Random(seed).random()`` is used, whose numbers Python keeps the same for ever; everything else that the
standard library draws may change between versions.
"""

import re
from collections.abc import Sequence
from fractions import Fraction
from math import inf, isclose, isqrt, sqrt
from random import Random
from typing import TypeVar

# Draws of a seed: the same on every machine and every Python.


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


# Numbers as a learner writes them: ``1/3``, ``sqrt(2)``, ``-inf``, ``1e-3``, and products and quotients of
# these.


Number = Fraction | float
"""Exact wherever it can be; a float for roots of other than squares, and for infinities."""

LENGTH_LIMIT = 60
"""Longest number in characters."""
LARGEST = 10**300
"""Largest number that is finite."""
_DECIMAL = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?"
_FACTOR = rf"(?:{_DECIMAL}|sqrt\({_DECIMAL}(?:/{_DECIMAL})?\)|inf)"
_NUMBER = re.compile(rf"([+-]?)({_FACTOR})((?:[*/]{_FACTOR})*)")
_COMMA = re.compile(r"\s*([+\-−]?[0-9]*),([0-9]+)\s*")
_NEXT = re.compile(rf"([*/])({_FACTOR})")


def read_number(text: str) -> Number:
    """Return the number that ``text`` stands for.

    Raises
    ------
    ValueError
        If it is no number, not a number (NaN), or beyond ``LARGEST``; the message is one sentence.

    Examples
    --------
    >>> read_number("-2/6"), read_number("sqrt(9/4)"), read_number("1e-3")
    (Fraction(-1, 3), Fraction(3, 2), Fraction(1, 1000))
    """
    plain = text.strip().replace("−", "-").replace(" ", "")
    found = _NUMBER.fullmatch(plain) if len(plain) <= LENGTH_LIMIT else None
    if _COMMA.fullmatch(plain):
        raise ValueError(f"expected a decimal point, as in {with_point(plain)}, got {plain[:20]!a}")
    if found is None:
        shown = f"{plain[:20]}..." if len(plain) > 20 else plain
        raise ValueError(f"expected a number such as 5, 1/3, sqrt(2), -inf or 1e-3, got {shown!a}")
    sign, first, rest = found.groups()
    value = _factor(first)
    for operator, factor in _NEXT.findall(rest):
        value = _combined(value, operator, _factor(factor), plain)
    if plain not in ("inf", "+inf", "-inf") and not -LARGEST <= value <= LARGEST:
        raise ValueError(f"expected a number up to 1e300, got {plain}; infinity is written inf")
    return -value if sign == "-" else value


def with_point(text: str) -> str:
    """Return a number written with a decimal comma with a point instead; any other text unchanged."""
    return _COMMA.sub(r"\1.\2", text) if _COMMA.fullmatch(text) else text


def is_infinite(value: Number) -> bool:
    """Return whether a number is infinite; `math.isinf` fails on large fractions."""
    return value in (inf, -inf)


def _factor(text: str) -> Number:
    if text == "inf":
        return inf
    if not text.startswith("sqrt"):
        number = Fraction(text)
        if number > LARGEST:
            raise ValueError(f"expected a number up to 1e300, got {text}; infinity is written inf")
        return number
    numerator, _, denominator = text[5:-1].partition("/")
    if denominator and not Fraction(denominator):
        raise ValueError(f"division by zero in {text}")
    square = Fraction(numerator) / Fraction(denominator or "1")
    root = Fraction(isqrt(square.numerator), isqrt(square.denominator))
    if root * root == square:
        return root
    if not 1 / LARGEST < square < LARGEST:
        raise ValueError(f"expected the root of a number up to 1e300, got {text}")
    return sqrt(square)


def _combined(value: Number, operator: str, factor: Number, text: str) -> Number:
    if is_infinite(value) or is_infinite(factor):
        raise ValueError(f"infinity stands alone, as inf or -inf, got {text}")
    if operator == "/" and factor == 0:
        raise ValueError(f"division by zero in {text}")
    result: Number = value * factor if operator == "*" else value / factor
    return result


def number_text(value: Number) -> str:
    """Return a number as it was understood: exact fractions with their decimals behind them.

    Examples
    --------
    >>> number_text(Fraction(1, 3)), number_text(Fraction(-4)), number_text(inf)
    ('1/3 (0.3333)', '-4', 'inf')
    """
    if isinstance(value, float):
        return f"{value:.6g}"
    if value.denominator == 1 and abs(value) < 10**12:
        return str(value.numerator)
    decimals = f"{float(value):.4g}"
    if value.denominator > 10**6 or abs(value.numerator) > 10**12 or Fraction(decimals) == value:
        return decimals
    return f"{value} ({decimals})"


def plain_number(value: Number) -> str:
    """Return a number as somebody would type it."""
    if not isinstance(value, Fraction):
        return f"{value:.6g}"
    decimals = f"{float(value):.6g}"
    return decimals if Fraction(decimals) == value else str(value)


def are_close(one: Number, other: Number, tolerance: float) -> bool:
    """Return whether two numbers differ by no more than ``tolerance``, absolute; 0: exact but for rounded roots."""
    if is_infinite(one) or is_infinite(other):
        return one == other
    if isinstance(one, Fraction) and isinstance(other, Fraction):
        return abs(one - other) <= Fraction(tolerance)
    return abs(float(one) - float(other)) <= tolerance or isclose(one, other, rel_tol=1e-12)


def is_one_digit_off(one: Number, other: Number, least: int = 1) -> bool:
    """Return whether two numbers of ``least`` digits differ in one, or in the sign alone, as they are written."""
    if is_infinite(one) or is_infinite(other) or one == other:
        return False
    if one == -other:
        return True
    first, second = (
        f"{float(value):.12g}" if isinstance(value, Fraction) else f"{value:.6g}" for value in (one, other)
    )
    if len(first) != len(second) or len(second.replace(".", "").lstrip("-0")) < least:
        return False
    return sum(a != b for a, b in zip(first, second, strict=True)) == 1
