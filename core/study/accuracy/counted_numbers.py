"""Numbers that count what is done with them: a listing is run on them, and its arithmetic is known.

This counts what the algorithm does, not what NumPy does: the same on every machine.
"""

from __future__ import annotations

import operator
from collections import Counter
from collections.abc import Callable
from math import ceil, floor
from typing import Any

import numpy as np

KINDS = {bool: "integer", int: "integer", float: "float", np.float32: "float"}


class CountedNumber:
    """A number that notes every operation in a tally: ``integer additions``, ``float divisions`` and so on."""

    __slots__ = ("tally", "value")

    def __init__(self, value: Any, tally: Counter[str]) -> None:
        self.value, self.tally = value, tally

    def _done(self, name: str, rule: Callable[[Any, Any], Any], first: Any, second: Any) -> CountedNumber:
        result = rule(plain(first), plain(second))
        written = [each for each in (first, second) if not isinstance(each, CountedNumber)]
        if rule is operator.mul and type(result) is int and written == [2]:
            name = "doublings"  # A shift or an addition: Bresenham (1965) counts no multiplication.
        self.tally[f"{KINDS[type(result)]} {name}"] += 1
        return CountedNumber(result, self.tally)

    def _compared(self, rule: Callable[[Any, Any], bool], other: Any) -> bool:
        kinds = {KINDS[type(value)] for value in (self.value, plain(other))}
        self.tally[f"{'float' if 'float' in kinds else 'integer'} comparisons"] += 1
        return rule(self.value, plain(other))

    def __add__(self, other: Any) -> CountedNumber:
        return self._done("additions", operator.add, self, other)

    def __radd__(self, other: Any) -> CountedNumber:
        return self._done("additions", operator.add, other, self)

    def __sub__(self, other: Any) -> CountedNumber:
        return self._done("additions", operator.sub, self, other)

    def __rsub__(self, other: Any) -> CountedNumber:
        return self._done("additions", operator.sub, other, self)

    def __mul__(self, other: Any) -> CountedNumber:
        return self._done("multiplications", operator.mul, self, other)

    def __rmul__(self, other: Any) -> CountedNumber:
        return self._done("multiplications", operator.mul, other, self)

    def __truediv__(self, other: Any) -> CountedNumber:
        return self._done("divisions", operator.truediv, self, other)

    def __rtruediv__(self, other: Any) -> CountedNumber:
        return self._done("divisions", operator.truediv, other, self)

    def __floordiv__(self, other: Any) -> CountedNumber:
        return self._done("divisions", operator.floordiv, self, other)

    def __mod__(self, other: Any) -> CountedNumber:
        return self._done("divisions", operator.mod, self, other)

    def __neg__(self) -> CountedNumber:
        return CountedNumber(-self.value, self.tally)

    def __abs__(self) -> CountedNumber:
        return CountedNumber(abs(self.value), self.tally)

    def __lt__(self, other: Any) -> bool:
        return self._compared(operator.lt, other)

    def __le__(self, other: Any) -> bool:
        return self._compared(operator.le, other)

    def __gt__(self, other: Any) -> bool:
        return self._compared(operator.gt, other)

    def __ge__(self, other: Any) -> bool:
        return self._compared(operator.ge, other)

    def __eq__(self, other: object) -> bool:
        return self._compared(operator.eq, other)

    def __hash__(self) -> int:
        return hash(self.value)

    def __bool__(self) -> bool:
        return bool(self.value)

    def __index__(self) -> int:
        return int(self.value)

    def __float__(self) -> float:
        return float(self.value)

    def __floor__(self) -> CountedNumber:
        return self._rounded(floor(self.value))

    def __ceil__(self) -> CountedNumber:
        return self._rounded(ceil(self.value))

    def __round__(self) -> CountedNumber:
        return self._rounded(round(self.value))

    def _rounded(self, result: int) -> CountedNumber:
        self.tally["roundings"] += 1
        return CountedNumber(result, self.tally)


def plain(number: Any) -> Any:
    """Return the value of a number, counted or not."""
    return number.value if isinstance(number, CountedNumber) else number
