"""Values of listings: numbers where all lanes agree, else arrays (L,); lists of these; ranges.

A list is as long in every lane (`Many`), or lanes have put unlike numbers of values to it (`Log`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from core.lanes.masks import Some
from core.lanes.problem import Place, Problem
from core.lanes.tables import Table
from core.records.arrays import Integers

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
