"""The operators of listings: those of Python on numbers, whole numbers up to 2^53."""

from collections.abc import Callable
from typing import Any

import numpy as np

from core.lanes.dialect import Rule
from core.lanes.limits import LARGEST, LARGEST_EXPONENT
from core.lanes.masks import Some
from core.lanes.problem import Place, Problem
from core.lanes.python_values import is_number, kind_of, largest, number_kind

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
