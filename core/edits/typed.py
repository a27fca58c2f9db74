"""A typed text as a rule: compiled once, run on lanes in blocks, and what it returns checked."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from inspect import isfunction, signature
from typing import Any

import numpy as np

from core.lanes.problem import LISTING, Limits, Place, Problem, counted
from core.lanes.program import Program, compile_listing
from core.lanes.python_values import Log, Many, Table, at_lane, is_flag, is_number, kind_of
from core.records.listing import TypedText, listing

BLOCK = 16_384
"""Lanes that run at once: enough to make the calls cheap, few enough for the processor's cache."""
TABLE_LIMIT = 256
"""Longest table of numbers that a listing may know by name."""

Shape = str | tuple["Shape", ...]
"""What must be returned: ``number``, ``flag``, ``list`` (as lanes put it), or as many of these."""


@dataclass(frozen=True)
class Typed(TypedText):
    """A text in place of the listing of a function, that runs; equal texts of one function are equal."""

    def __call__(self, *values: Any) -> Any:
        """Run the text on one lane, with plain numbers, and return plain numbers."""
        return at_lane(self.program.run(values, 1), 0)

    @property
    def program(self) -> Program:
        """The text, compiled; raises `Problem`."""
        return _compiled(self.of, self.text)

    def checked(self, values: Sequence[Any], shape: Shape, words: str) -> None:
        """Raise `Problem` for a text that cannot run: through all branches, on no lanes."""
        self._check_parameters()
        program = self.program
        program.check(values, accept=lambda value, place: returned(value, shape, words, place))

    def run(
        self, values: Sequence[Any], lanes: int, shape: Shape, words: str, limits: Limits = LISTING
    ) -> Any:
        """Return what the text makes of values, which must have a shape that ``words`` describe."""
        self._check_parameters()
        return self.program.run(
            values, lanes, limits=limits, accept=lambda value, place: returned(value, shape, words, place)
        )

    def run_blocks(
        self, values: Callable[[slice], Sequence[Any]], lanes: int, shape: Shape, words: str
    ) -> Any:
        """Run blocks of L lanes, with the ``values`` of each; return arrays (L,), and (n, L) for n values alike."""
        made = _unfilled(shape, lanes)
        for first in range(0, lanes, BLOCK):
            part = slice(first, min(first + BLOCK, lanes))
            _fill(made, part, self.run(values(part), part.stop - part.start, shape, words))
        return made

    def _check_parameters(self) -> None:
        wanted, function = parameters_of(self.of), self.program.functions[self.program.name]
        if len(function.parameters) != len(wanted):
            given = f"{counted(len(wanted), 'value')} ({', '.join(wanted)})"
            raise Problem(
                function.place, f"{function.name} is given {given}, and takes {len(function.parameters)}"
            )


def _unfilled(shape: Shape, lanes: int) -> Any:
    if isinstance(shape, str):
        return np.empty(lanes, bool if shape == "flag" else float)
    parts = [_unfilled(part, lanes) for part in shape]
    are_alike = len(set(shape)) == 1 and isinstance(parts[0], np.ndarray)
    return np.empty((len(parts), *parts[0].shape), parts[0].dtype) if are_alike else parts


def _fill(made: Any, part: slice, found: Any) -> None:
    if isinstance(made, np.ndarray) and made.ndim == 1:
        made[part] = found
        return
    for array, value in zip(made, found, strict=True):
        _fill(array, part, value)


@lru_cache(maxsize=64)
def _compiled(of: Callable[..., Any], text: str) -> Program:
    constants, helpers = surroundings(of)
    return compile_listing(text, constants, helpers)


@lru_cache(maxsize=256)
def parameters_of(function: Callable[..., Any]) -> tuple[str, ...]:
    """Return the names of a function's parameters."""
    return tuple(signature(function).parameters)


def surroundings(function: Callable[..., Any]) -> tuple[dict[str, Any], dict[str, Program]]:
    """Return what a listing knows by name beside its language: numbers of its file, and other listings of the program.

    Functions that are no listings in this language are left out: a listing that calls one cannot be edited.
    """
    constants: dict[str, Any] = {}
    helpers: dict[str, Program] = {}
    for name in function.__code__.co_names:
        value = function.__globals__.get(name)
        if isinstance(value, int | float) and not isinstance(value, bool):
            constants[name] = value
        elif isinstance(value, np.ndarray | tuple | list) and _is_table(value):
            constants[name] = Many([float(number) for number in value])
        elif isfunction(value) and _package(value) in ("core", _package(function)):
            known = surroundings(value)
            try:
                helpers[name] = compile_listing(listing(value).source, *known)
            except Problem:
                continue
            # The text that is edited has that function, too.
            constants, helpers = {**known[0], **constants}, {**known[1], **helpers}
    return constants, helpers


def _package(function: Callable[..., Any]) -> str:
    return function.__module__.partition(".")[0]


def with_called(function: Callable[..., Any]) -> str:
    """Return the source of a listing, and below it those of all listings that it calls: what is edited."""
    _, helpers = surroundings(function)
    called = [listing(value).source for name, value in _called_by(function).items() if name in helpers]
    return "\n\n".join([listing(function).source, *called])


def _called_by(function: Callable[..., Any]) -> dict[str, Callable[..., Any]]:
    """Return the functions of the core that a function calls, and those that these call, by name."""
    found: dict[str, Callable[..., Any]] = {}
    for name in function.__code__.co_names:
        value = function.__globals__.get(name)
        if isfunction(value) and value.__module__.startswith("core."):
            found |= {name: value, **_called_by(value)}
    return found


def _is_table(value: Any) -> bool:
    numbers = np.asarray(value)
    return numbers.ndim == 1 and numbers.dtype.kind in "if" and 0 < len(numbers) <= TABLE_LIMIT


def returned(value: Any, shape: Shape, words: str, place: Place) -> Any:
    """Return a value in the form that is needed, or say what it must be; see `Shape`."""
    if shape == "list":
        if not isinstance(value, Log | Many):
            raise Problem(place, f"return must give {words}, not {kind_of(value)}")
        return value
    if isinstance(shape, str):
        if not is_number(value) or (shape == "flag" and not is_flag(value)):
            meant = ": true or false, " if shape == "flag" else ": "
            raise Problem(place, f"return must give {words}{meant}not {kind_of(value)}")
        return value
    if isinstance(value, Log):
        value = value.seen(None, place)
    if isinstance(value, Table) and not np.ndim(value.length) and value.length == len(shape):
        value = [value.part(k) for k in range(value.length)]
    if not isinstance(value, list) or len(value) != len(shape):
        count = len(value) if isinstance(value, list) else 1
        raise Problem(place, f"return must give {words}: here it gives {counted(count, 'value')}")
    return [returned(part, of, words, place) for part, of in zip(value, shape, strict=True)]
