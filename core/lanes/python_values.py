"""Values of listings, whole numbers up to 2^53, lists and tables of them, and the operators on them.

A list is as long in every lane (`Many`), or lanes have put unlike numbers of values to it (`Log`).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.lanes.problem import LARGEST, LARGEST_EXPONENT, Place, Problem
from core.lanes.run import Rule, Some
from core.records.arrays import Floats, Integers

# Tables of numbers that lanes read at places of their own: the texels of a texture, and of its mipmap
# levels.


LEVEL, ROW, COLUMN, CHANNEL = range(4)
"""What an index chooses, in this order."""


@dataclass(frozen=True, eq=False)
class Table:
    """Numbers ``[level][row][column][channel]`` of which some indices are chosen; each a number or (L,)."""

    numbers: Floats
    """(N, C) float64, the texels of all levels, row by row."""
    begins: Integers
    """(K,) int64, the first texel of every level."""
    heights: Integers
    """(K,) int64."""
    widths: Integers
    """(K,) int64."""
    chosen: tuple[Any, ...] = ()

    @property
    def length(self) -> Any:
        """How many elements there are to choose from: a whole number, or (L,) where that differs by lane."""
        place = len(self.chosen)
        if place == LEVEL:
            return len(self.begins)
        if place == CHANNEL:
            return self.numbers.shape[1]
        return _as_number((self.heights if place == ROW else self.widths)[self.chosen[LEVEL]])

    @property
    def is_texel(self) -> bool:
        """Whether only a channel is left to choose."""
        return len(self.chosen) == CHANNEL

    def part(self, index: Any) -> Any:
        """Return an element, a number or another table; the index is a whole number or (L,), and inside."""
        if len(self.chosen) < CHANNEL:
            return replace(self, chosen=(*self.chosen, index))
        level, row, column = self.chosen
        texel = self.begins[level] + row * self.widths[level] + column
        return _as_number(self.numbers[texel, index])

    def inside(self, index: Any) -> Any:
        """Return indices (L,) moved inside, for lanes that a branch leaves out."""
        return np.clip(index, 0, np.asarray(self.length) - 1)

    def __str__(self) -> str:
        names = ("levels", "rows", "texels", "channels")
        return f"a table of {np.max(self.length)} {names[len(self.chosen)]}"


def _as_number(value: Any) -> Any:
    return value if np.ndim(value) else value.item()


def table_of(levels: Sequence[np.ndarray]) -> Table:
    """Return the table of levels, an array (H, W, C) each."""
    sizes = np.array([level.shape[:2] for level in levels], np.int64).reshape(-1, 2)
    counts = sizes.prod(axis=1)
    numbers = np.concatenate([level.reshape(-1, level.shape[2]) for level in levels])
    return Table(numbers.astype(np.float64), np.cumsum(counts) - counts, sizes[:, 0], sizes[:, 1])


# Values of listings: numbers where all lanes agree, else arrays (L,); lists of these; ranges.


KINDS = {"b": "true or false", "i": "a whole number", "f": "a number"}
"""What is said of an array's kind."""


class Many(list[Any]):
    """A list that is as long in every lane, how many numbers it has with those in its lists, and how deep it is."""

    def __init__(self, parts: Sequence[Any]) -> None:
        super().__init__(parts)
        self.leaves: int = sum(part.leaves if isinstance(part, Many) else 1 for part in parts)
        self.depth: int = 1 + max((part.depth for part in parts if isinstance(part, Many)), default=0)


class Log:
    """A list to which lanes put values, each for a mask of them; so it may be longer in some lanes."""

    def __init__(self, entries: Sequence[tuple[Some, Any]] = (), place: Place | None = None) -> None:
        self.entries = list(entries)
        self.place = place
        """Where the last one was put."""

    def seen(self, mask: Some, place: Place) -> list[Any]:
        """Return the values that the lanes of a mask have put, if all have put as many; the mask is (L,)."""
        found = []
        for lanes, value in self.entries:
            if lanes is not None:
                here = lanes if mask is None else lanes & mask
                if not here.any():
                    continue
                if not here.all() if mask is None else (here != mask).any():
                    raise Problem(
                        place, "this list is not as long in every lane: it can only be put to, and returned"
                    )
            found.append(value)
        return found


@dataclass(frozen=True, eq=False)
class Range:
    """The whole numbers from ``start`` up to ``stop``; each of the three a number or (L,)."""

    start: Any
    stop: Any
    step: Any

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same in every lane."""
        return not any(np.ndim(part) for part in (self.start, self.stop, self.step))


def is_number(value: Any) -> bool:
    """Return whether a value is a number or a flag, or an array of them."""
    return isinstance(value, int | float | np.ndarray | np.generic)


def number_kind(value: Any) -> str:
    """Return NumPy's letter for the kind of a number: b, i or f."""
    if isinstance(value, bool):
        return "b"
    if isinstance(value, int):
        return "i"
    return "f" if isinstance(value, float) else str(value.dtype.kind)


def is_flag(value: Any) -> bool:
    """Return whether a value is true or false, in one or in many lanes."""
    return is_number(value) and number_kind(value) == "b"


def kind_of(value: Any) -> str:
    """Return what a value is called in a sentence."""
    if is_number(value):
        return KINDS.get(number_kind(value), "this")
    if isinstance(value, Range):
        return "a range"
    if isinstance(value, str):
        return "a text"
    if isinstance(value, Table):
        return "a table"
    return "None" if value is None else "a list"


def largest(value: Any) -> float:
    """Return the largest size of a number, 0 for no lane."""
    if isinstance(value, int | float):
        return float(abs(value))
    return float(np.abs(np.asarray(value).astype(np.float64)).max(initial=0))


def at_lane(value: Any, lane: int) -> Any:
    """Return the plain value of one lane: numbers, lists of these, None, a text or a range."""
    if isinstance(value, Log):
        entries = [made for lanes, made in value.entries if lanes is None or lanes[lane]]
        return [at_lane(made, lane) for made in entries]
    if isinstance(value, list):
        return [at_lane(part, lane) for part in value]
    if isinstance(value, Range):
        return range(*(int(at_lane(part, lane)) for part in (value.start, value.stop, value.step)))
    if isinstance(value, Table):
        is_texel = value.is_texel
        return [at_lane(value.part(k), lane) for k in range(value.length)] if is_texel else str(value)
    if isinstance(value, np.ndarray | np.generic):
        one = value[lane] if isinstance(value, np.ndarray) and value.ndim else value
        return one if one.dtype == np.float32 else one.item()
    return value


def rows_put(log: Log, lanes: int) -> tuple[Integers, list[tuple[Integers, Any]]]:
    """Return how many values each of L lanes has put, (L,) int64, and for each entry its lanes and its value."""
    every = np.arange(lanes)
    parts = [(every if mask is None else np.flatnonzero(mask), value) for mask, value in log.entries]
    count = np.zeros(lanes, np.int64)
    for found, _ in parts:
        count[found] += 1
    return count, parts


# The operators of listings: those of Python on numbers, whole numbers up to 2^53.


TOO_LARGE = "whole numbers go up to 2 to the power 53 here: this is larger"
_PLAIN: dict[str, Callable[[Any, Any], Any]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "<": lambda a, b: a < b,
    ">": lambda a, b: a > b,
    "<=": lambda a, b: a <= b,
    ">=": lambda a, b: a >= b,
}
_SAME: dict[str, Callable[[Any, Any], Any]] = {"==": lambda a, b: a == b, "!=": lambda a, b: a != b}
_BITS: dict[str, Callable[[Any, Any], Any]] = {
    "&": lambda a, b: a & b,
    "|": lambda a, b: a | b,
    "^": lambda a, b: a ^ b,
}
OPERATORS = (*_PLAIN, *_SAME, *_BITS, "*", "/", "//", "%", "**", "<<", ">>")


def operator_rule(operator: str, place: Place) -> Rule:
    """Return what an operator of two operands does."""
    if operator in _SAME:
        return _comparing(operator, place)
    if operator in _PLAIN:
        return _plain(operator, place)
    if operator in _BITS:
        return _joining_bits(operator, place)
    if operator == "*":
        return _multiplying(place)
    if operator in ("/", "//", "%"):
        return _dividing(operator, place)
    return _raising(place) if operator == "**" else _shifting(operator, place)


def _both_floats(a: Any, b: Any) -> bool:
    return type(a) is np.ndarray and type(b) is np.ndarray and a.dtype.kind == "f" == b.dtype.kind


def _need_numbers(a: Any, b: Any, operator: str, place: Place) -> None:
    if not (is_number(a) and is_number(b)):
        raise Problem(place, f"{kind_of(a)} {operator} {kind_of(b)} is not possible")


def _as_integers(value: Any) -> Any:
    """Return flags as the numbers 0 and 1, as Python counts them."""
    if number_kind(value) != "b":
        return value
    return value.astype(np.int64) if np.ndim(value) else int(value)


def _plain(operator: str, place: Place) -> Rule:
    plain, is_sum = _PLAIN[operator], operator in "+-"

    def numbers(a: Any, b: Any, mask: Some, run: Any) -> Any:
        if _both_floats(a, b):
            return plain(a, b)
        _need_numbers(a, b, operator, place)
        if is_sum:
            a, b = _as_integers(a), _as_integers(b)
        return plain(a, b)

    return numbers


def _comparing(operator: str, place: Place) -> Rule:
    plain = _SAME[operator]

    def same(a: Any, b: Any, mask: Some, run: Any) -> Any:
        if (is_number(a) and is_number(b)) or (isinstance(a, str) and isinstance(b, str)):
            return plain(a, b)
        raise Problem(place, f"{kind_of(a)} cannot be compared with {kind_of(b)}")

    return same


def _joining_bits(operator: str, place: Place) -> Rule:
    plain = _BITS[operator]

    def join(a: Any, b: Any, mask: Some, run: Any) -> Any:
        _need_numbers(a, b, operator, place)
        if "f" in (number_kind(a), number_kind(b)):
            raise Problem(place, f"{operator} takes whole numbers, or flags")
        return plain(a, b)

    return join


def _multiplying(place: Place) -> Rule:
    def product(a: Any, b: Any, mask: Some, run: Any) -> Any:
        if _both_floats(a, b):
            return a * b
        _need_numbers(a, b, "*", place)
        a, b = _as_integers(a), _as_integers(b)
        if number_kind(a) == number_kind(b) == "i" and largest(a) * largest(b) > LARGEST:
            sizes = np.abs(np.asarray(a, np.float64) * np.asarray(b, np.float64))
            if (sizes if mask is None or sizes.ndim == 0 else sizes[mask]).max(initial=0) > LARGEST:
                raise Problem(place, TOO_LARGE)
        return a * b

    return product


def _dividing(operator: str, place: Place) -> Rule:
    whole_of: Any = np.floor_divide if operator == "//" else np.mod

    def divide(a: Any, b: Any, mask: Some, run: Any) -> Any:
        if operator == "/" and _both_floats(a, b):
            return a / b
        _need_numbers(a, b, operator, place)
        a, b = _as_integers(a), _as_integers(b)
        if operator == "/":
            made = np.true_divide(a, b)
            is_single = isinstance(a, np.generic) or isinstance(b, np.generic)
            return made if np.ndim(made) or is_single else float(made)
        is_whole = number_kind(a) == number_kind(b) == "i"
        if is_whole:
            is_zero = np.asarray(b == 0)
            if (is_zero if mask is None or is_zero.ndim == 0 else is_zero & mask).any():
                raise Problem(place, f"a whole number {operator} 0: this is division by 0")
            b = np.where(is_zero, 1, b) if is_zero.ndim else b
        if np.ndim(a) or np.ndim(b) or not is_whole:
            made = whole_of(a, b)
            return made if np.ndim(made) or isinstance(made, np.float32) else made.item()
        return a // b if operator == "//" else a % b

    return divide


def _raising(place: Place) -> Rule:
    def power(a: Any, b: Any, mask: Some, run: Any) -> Any:
        if not is_number(a):
            raise Problem(place, f"{kind_of(a)} ** {kind_of(b)} is not possible")
        if type(b) is not int or not 0 <= b <= LARGEST_EXPONENT:
            raise Problem(place, f"an exponent must be a whole number from 0 to {LARGEST_EXPONENT}")
        a = _as_integers(a)
        if number_kind(a) == "i":
            if largest(a) ** b > LARGEST:
                raise Problem(place, TOO_LARGE)
            return a**b
        made = np.power(a, b)
        return made if np.ndim(made) or isinstance(made, np.float32) else float(made)

    return power


def _shifting(operator: str, place: Place) -> Rule:
    def shift(a: Any, b: Any, mask: Some, run: Any) -> Any:
        _need_numbers(a, b, operator, place)
        if number_kind(a) == "f" or number_kind(b) == "f":
            raise Problem(place, f"{operator} takes whole numbers")
        a, b = _as_integers(a), _as_integers(b)
        if np.ndim(b) or not 0 <= b <= 52:
            raise Problem(place, f"{operator} shifts by 0 to 52 places, the same in every lane")
        if operator == ">>":
            return a >> b
        if largest(a) * 2.0**b > LARGEST:
            raise Problem(place, TOO_LARGE)
        return a << b

    return shift
