"""The dialect of listings: the part of Python that they are written in."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from difflib import get_close_matches
from typing import Any

import numpy as np

from core.lanes.problem import LARGEST, Place, Problem, counted
from core.lanes.python_functions import NATIVE, ROUNDING, ListFunctions, applied, rounded
from core.lanes.python_values import (
    TOO_LARGE,
    Log,
    Many,
    Range,
    Table,
    is_flag,
    is_number,
    kind_of,
    number_kind,
    operator_rule,
)
from core.lanes.run import NOBODY, Mask, Rule, Run, Some, Turn, split

CHECKED_TURNS = 64
"""Rounds of a loop that a check on no lanes looks at."""
MOST_ARGUMENTS = 9
FEW_LETTERS = 4
"""Names up to so long are proposed only where one letter differs."""


class PythonDialect:
    """Values and rules of listings; ``constants`` are numbers that a listing knows by name."""

    nothing = None
    is_typed = False

    def __init__(self, constants: Mapping[str, Any] | None = None) -> None:
        self._names = {"nan": float("nan"), "inf": float("inf"), **(constants or {})}
        self._lists = ListFunctions(self)

    @property
    def functions(self) -> tuple[str, ...]:
        """Names of all functions that may be typed."""
        return (*self._lists.typed, *NATIVE, *ROUNDING)

    def names(self) -> Mapping[str, Any]:
        """Return the numbers that a listing knows by name."""
        return self._names

    def constant(self, value: Any, place: Place) -> Any:
        """Return what was typed: it is a value already."""
        return value

    def unknown(self, name: str, known: Iterable[str]) -> str:
        """Say that a name has no value, and which one may be meant."""
        return f"{name} has no value{meant(name, [*known, *self.functions])}"

    def flag(self, truth: Any) -> Any:
        """Return a condition as a value: it is one already."""
        return truth

    def truth(self, value: Any, place: Place) -> Any:
        """Return a condition, one bool or flags (L,); nothing but true and false is one."""
        if is_flag(value):
            return value
        hint = ": compare it, as x != 0" if is_number(value) else ""
        raise Problem(place, f"a condition must be true or false, not {kind_of(value)}{hint}")

    def uniform(self, value: Any, place: Place) -> bool:
        """Return a condition that must be the same in all lanes."""
        truth = self.truth(value, place)
        if np.ndim(truth):
            raise Problem(place, "this condition must be the same in every lane")
        return bool(truth)

    def rule(self, operator: str, place: Place) -> Rule:
        """Return what an operator does with two operands."""
        return operator_rule(operator, place)

    def prefix(self, operator: str, place: Place) -> Callable[[Any], Any]:
        """Return what an operator does with one operand."""

        def run(value: Any) -> Any:
            if operator == "not":
                truth = self.truth(value, place)
                return ~truth if isinstance(truth, np.ndarray) else not truth
            if not is_number(value):
                raise Problem(place, f"{operator} {kind_of(value)} is not possible")
            if is_flag(value):
                raise Problem(place, f"{operator} takes a number, this is true or false: write not")
            return -value if operator == "-" else value

        return run

    def check_stored(self, value: Any, mask: Some, place: Place, run: Run) -> None:
        """Refuse whole numbers beyond 2^53, in a list too; the mask is (L,)."""
        if type(value) is np.ndarray:
            if value.dtype.kind == "i" and value.size:
                is_large = np.abs(value) > LARGEST
                if (is_large if mask is None else is_large & mask).any():
                    raise Problem(place, TOO_LARGE)
        elif type(value) is int and abs(value) > LARGEST:
            raise Problem(place, TOO_LARGE)
        elif isinstance(value, Many):
            for part in value:
                self.check_stored(part, mask, place, run)

    def check_kept(self, name: str, old: Any, new: Any, place: Place) -> None:
        """Python lets a variable change its type."""

    def size(self, value: Any) -> int:
        """Return how many numbers a variable takes up; those that lanes put to a list are counted when they do."""
        if isinstance(value, np.ndarray):
            return value.size
        return sum(map(self.size, value)) if isinstance(value, Many) else 1

    def zero(self, of: Any) -> Any:
        """Return what a variable without a value would have: listings declare none."""
        return 0

    def typed(self, of: Any, value: Any, place: Place, name: str) -> Any:
        """Return the value itself: listings have no types."""
        return value

    def merged(self, flags: Any, new: Any, old: Any, place: Place, run: Run, returned: int = 0) -> Any:
        """Return ``new`` where ``flags`` (L,) hold, else ``old``; lists element by element.

        Lists in what is returned may be longer in some lanes.
        """
        if new is old or (isinstance(new, str) and isinstance(old, str) and new == old):
            return new
        if isinstance(new, Log) or isinstance(old, Log):
            return self._merged_logs(flags, new, old, place, run)
        if isinstance(new, list) and isinstance(old, list) and len(new) == len(old):
            run.check_room(place, run.lanes * len(new))
            pairs = zip(new, old, strict=True)
            return Many([self.merged(flags, a, b, place, run, 2 * returned) for a, b in pairs])
        if returned > 1 and isinstance(new, list) and isinstance(old, list):
            return self._merged_logs(flags, new, old, place, run)
        if isinstance(new, list) or isinstance(old, list):
            many = [len(value) if isinstance(value, list) else 1 for value in (new, old)]
            raise Problem(place, f"this gives {counted(many[0], 'value')} here and {many[1]} elsewhere")
        if isinstance(new, Range) and isinstance(old, Range):
            ends = ((new.start, old.start), (new.stop, old.stop), (new.step, old.step))
            return Range(*(np.where(flags, a, b) for a, b in ends))
        if not (is_number(new) and is_number(old)):
            raise Problem(place, f"this is {kind_of(new)} in some lanes and {kind_of(old)} in others")
        return np.where(flags, new, old)

    def _merged_logs(self, flags: Any, new: Any, old: Any, place: Place, run: Run) -> Log:
        found = []
        for value, where in ((old, ~flags), (new, flags)):
            entries = value.entries if isinstance(value, Log) else [(None, part) for part in value or ()]
            # Their masks are made anew, a byte a lane.
            run.make_room(place, run.lanes * len(entries) // 8)
            found += [(where if mask is None else mask & where, part) for mask, part in entries]
        return Log(found, place)

    def many(self, parts: Sequence[Any], starred: Sequence[bool], mask: Some, place: Place, run: Run) -> Any:
        """Return a list; an empty one is a `Log`, to which each lane may put values of its own."""
        made: list[Any] = []
        for part, is_star in zip(parts, starred, strict=True):
            made += self.elements(part, mask, place, run) if is_star else [part]
            if len(made) > run.limits.numbers:
                break
        if not made:
            return Log()
        found = self._limited(Many(made), place, run)
        run.check_room(place, self.size(found))
        return found

    def _limited(self, made: Many, place: Place, run: Run) -> Many:
        if made.leaves > run.limits.numbers:
            raise Problem(place, f"a list has at most {run.limits.numbers:,} numbers here")
        if made.depth > run.limits.calls:
            raise Problem(place, f"lists stand at most {run.limits.calls} deep in each other here")
        return made

    def elements(self, value: Any, mask: Some, place: Place, run: Run) -> list[Any]:
        """Return the elements of a list or a range that is the same in all lanes; the mask is (L,)."""
        if isinstance(value, Log):
            return value.seen(mask, place)
        if isinstance(value, list):
            return value
        if isinstance(value, Table):
            return self._elements_of_table(value, place, run)
        if isinstance(value, Range):
            if not value.is_uniform:
                raise Problem(place, "this range is not the same in every lane: write a for loop")
            made = range(value.start, value.stop, value.step)
            if len(made) > run.limits.numbers:
                most = run.limits.numbers
                raise Problem(
                    place, f"a list has at most {most:,} numbers here, this range has {_length_of(made)}"
                )
            return list(made)
        raise Problem(place, f"{kind_of(value)} has no elements")

    def _elements_of_table(self, value: Table, place: Place, run: Run) -> list[Any]:
        length = value.length
        if np.ndim(length) or length > run.limits.numbers:
            raise Problem(place, "this table is too long to be a list, or not as long in every lane")
        return [value.part(k) for k in range(length)]

    def unpacked(self, value: Any, starred: Sequence[bool], mask: Some, place: Place, run: Run) -> list[Any]:
        """Return a value for each of several names; the mask is (L,)."""
        parts = [value] if is_number(value) else self.elements(value, mask, place, run)
        if sum(starred) == 1 and len(parts) >= len(starred) - 1:
            first, rest = starred.index(True), len(parts) - len(starred) + 1
            middle = Many(parts[first : first + rest]) if rest else Log()
            return [*parts[:first], middle, *parts[first + rest :]]
        if any(starred) or len(parts) != len(starred):
            on_right = counted(len(parts), "value")
            raise Problem(place, f"{counted(len(starred), 'name')} on the left of =, {on_right} on its right")
        return parts

    def turns(self, value: Any, mask: Some, place: Place, run: Run) -> Turn:
        """Return the rounds of a for loop; the mask is (L,)."""
        if isinstance(value, Range) and not value.is_uniform:
            return self._unequal_turns(value, run)
        if is_number(value):
            raise Problem(
                place, f"{kind_of(value)} has no elements: a loop over numbers takes range(first, end)"
            )
        made: Sequence[Any]
        if isinstance(value, Range):
            made = range(value.start, value.stop, value.step)
        else:
            made = tuple(self.elements(value, mask, place, run))
        most = CHECKED_TURNS if run.is_checking else run.limits.rounds

        def turn(here: Some, number: int) -> tuple[Mask, Mask, Any]:
            if run.is_checking and number >= most:
                return NOBODY, here, None
            # Longer than any list may be: len() has no answer.
            is_there = number <= most and bool(made[number : number + 1])
            return (here, NOBODY, made[number]) if is_there else (NOBODY, here, None)

        return turn

    def _unequal_turns(self, value: Range, run: Run) -> Turn:
        def turn(here: Some, number: int) -> tuple[Mask, Mask, Any]:
            thing = value.start + number * value.step
            if run.is_checking:
                return (here, NOBODY, thing) if number == 0 else (NOBODY, here, thing)
            goes_on = np.where(np.asarray(value.step) > 0, thing < value.stop, thing > value.stop)
            return *split(here, np.broadcast_to(goes_on, (run.lanes,)), run.lanes), thing

        return turn

    def put(self, whole: Any, value: Any, mask: Some, place: Place, run: Run) -> None:
        """Put a value at the end of a list; the mask is (L,)."""
        if not isinstance(whole, Log | Many):
            raise Problem(place, f".append needs a list, not {kind_of(whole)}")
        if isinstance(value, Log):
            raise Problem(place, "a list that is still growing cannot be put into a list")
        self.check_stored(value, mask, place, run)
        leaves = value.leaves if isinstance(value, Many) else 1
        run.make_room(place, self.size(value))
        if isinstance(whole, Log):
            whole.entries.append((mask, value))
            whole.place = place
            return
        if value is whole or mask is not None or whole.leaves + leaves > run.limits.numbers:
            raise Problem(
                place,
                f"to this list only all lanes can put values, up to {run.limits.numbers:,} numbers, and not itself: "
                "begin with []",
            )
        whole.append(value)
        whole.leaves += leaves
        whole.depth = max(whole.depth, (value.depth if isinstance(value, Many) else 0) + 1)
        self._limited(whole, place, run)

    def part(self, whole: Any, index: Any, mask: Some, place: Place, run: Run) -> Any:
        """Return an element; the index may differ by lane, and never counts from the end then; the mask is (L,)."""
        if not is_number(index) or number_kind(index) != "i":
            raise Problem(place, f"an index must be a whole number, not {kind_of(index)}")
        if is_number(whole) or isinstance(whole, str) or whole is None:
            raise Problem(place, f"{kind_of(whole)} has no elements [ ]")
        if isinstance(whole, Table):
            is_alike = not np.ndim(index) and not np.ndim(whole.length)
            if is_alike and -whole.length <= index < 0:
                index += whole.length
            check_inside(np.asarray(index), whole.length, mask, place)
            return whole.part(whole.inside(index) if np.ndim(index) else index)
        parts = self.elements(whole, mask, place, run)
        if np.ndim(index):
            check_inside(index, len(parts), mask, place)
            if not all(is_number(part) for part in parts):
                # Lanes that have left a loop may hold another index.
                here = np.unique(index if mask is None else index[mask])
                if len(here) == 1:
                    return parts[here[0]]
                raise Problem(place, "an index that is not the same in every lane takes numbers only")
            chosen = np.clip(index, 0, len(parts) - 1)
            made = np.stack(np.broadcast_arrays(chosen, *parts)[1:])
            return np.take_along_axis(made, chosen[None], axis=0)[0]
        if not -len(parts) <= index < len(parts):
            raise Problem(place, f"index {index} is outside of 0 to {len(parts) - 1}")
        return parts[index]

    def with_part(self, whole: Any, index: Any, new: Any, mask: Some, place: Place, run: Run) -> Any:
        """Return a list with another element; the mask is (L,)."""
        parts = list(self.elements(whole, mask, place, run))
        if isinstance(new, Log):
            raise Problem(place, "a list that is still growing cannot be put into a list")
        if isinstance(index, np.ndarray) and index.dtype.kind == "i":
            check_inside(index, len(parts), mask, place)
            for k, part in enumerate(parts):
                here = index == k if mask is None else (index == k) & mask
                parts[k] = self.merged(here, new, part, place, run) if here.any() else part
            return self._limited(Many(parts), place, run)
        if type(index) is not int or not -len(parts) <= index < len(parts):
            raise Problem(place, f"an index must be a whole number from 0 to {len(parts) - 1}")
        parts[index] = new if mask is None else self.merged(mask, new, parts[index], place, run)
        return self._limited(Many(parts), place, run)

    def field(self, whole: Any, name: str, place: Place) -> Any:
        """Refuse all attributes."""
        raise Problem(place, f".{name} is not in the language of listings")

    def arguments(
        self, name: str, parameters: Sequence[str], values: Sequence[Any], place: Place
    ) -> Sequence[Any]:
        """Return the values that a function of the program is called with, as many as it takes."""
        if len(values) != len(parameters):
            wanted = f"{counted(len(parameters), 'value')} ({', '.join(parameters)})"
            raise Problem(place, f"{name} takes {wanted}, got {len(values)}")
        return values

    def call(self, name: str, values: Sequence[Any], mask: Some, place: Place, run: Run) -> Any:
        """Return what a function of the table makes of values; the mask is (L,)."""
        if name in ROUNDING or name in NATIVE:
            return self._number(name, values, mask, place, run)
        if name not in self._lists:
            raise Problem(place, f"there is no function {name}{meant(name, self.functions)}")
        return self._lists.call(name, values, mask, place, run)

    def _number(self, name: str, values: Sequence[Any], mask: Some, place: Place, run: Run) -> Any:
        if name in ("min", "max") and len(values) == 1:
            values = self.elements(values[0], mask, place, run)[: MOST_ARGUMENTS + 1]
        fewest, most = (1, 1) if name in ROUNDING else (NATIVE[name].fewest, NATIVE[name].most)
        if not fewest <= len(values) <= most:
            wanted = counted(fewest, "value") if fewest == most else f"{fewest} to {most} values"
            raise Problem(place, f"{name} takes {wanted}, got {len(values)}")
        for value in values:
            if not is_number(value):
                raise Problem(place, f"{name} of {kind_of(value)} is not possible")
        return rounded(name, values[0], mask, place) if name in ROUNDING else applied(name, values, place)


def check_inside(index: Any, count: Any, mask: Some, place: Place) -> None:
    """Refuse indices (L,) outside of 0 to ``count - 1``; the mask is (L,)."""
    is_outside = (index < 0) | (index >= count)
    most = int(np.max(count, initial=0))
    if (is_outside if mask is None else is_outside & mask).any() or not (most or np.ndim(count)):
        raise Problem(place, f"an index is outside of 0 to {most - 1}")


def _length_of(numbers: range) -> str:
    """Return how many numbers a range has; ``len`` refuses the longest."""
    return f"{max((numbers.stop - numbers.start) // numbers.step, 0):,}"


def meant(name: str, known: Iterable[str]) -> str:
    """Return ``: did you mean ...?`` for a name that is close to one that there is, else nothing."""
    others = [one for one in known if one != name]
    found = [one for one in others if one.lower() == name.lower()]
    found += [one for one in others if len(name) > 1 and is_one_slip(name, one)]
    if len(name) > FEW_LETTERS:
        found += get_close_matches(name, others, 1, 0.6)
    return f": did you mean {found[0]}?" if found else ""


def is_one_slip(first: str, second: str) -> bool:
    """Return whether two names differ by one letter more, less or other."""
    short, long = sorted((first, second), key=len)
    if len(short) == len(long):
        return sum(a != b for a, b in zip(short, long, strict=True)) == 1 and len(long) > 1
    return len(long) - len(short) == 1 and any(long[:k] + long[k + 1 :] == short for k in range(len(long)))
