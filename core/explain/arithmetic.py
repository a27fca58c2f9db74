r"""Arithmetic on the tree of a formula: which terms are plain arithmetic, and what they come to, without any error.

Known are numbers, sums, products, fractions, powers, roots, logarithms to base 2, rounding, least and greatest values,
sizes and the product of two vectors.
"""

import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np

from core.records.terms import Applied, Colored, Leaf, ListOf, Operation, Prefix, Term

Number = Fraction | float
"""A finite number without error, or a float where it is not rational: a root, a logarithm, infinite, NaN."""
Count = Callable[[float], Number]
"""What a number counts as: the value of its digits."""


def is_constant(leaf: Leaf) -> bool:
    """Return whether a leaf is written in full: a fraction, or a whole number that is no variable."""
    return isinstance(leaf.value, Fraction) or (not leaf.symbol and type(leaf.value) is int)


def is_arithmetic(term: Term) -> bool:
    """Return whether a term can be worked out."""
    if isinstance(term, Leaf):
        return isinstance(term.value, int | float | Fraction) and not isinstance(term.value, bool)
    parts, name = term.inside(), _name(term)
    if name in _OF_VECTORS and all(_elements(part) is not None for part in parts):
        return True
    return name in _OPERATIONS and all(map(is_arithmetic, parts))


def _elements(term: Term) -> tuple[Term, ...] | None:
    """Return the elements of a vector; ``None``: it is none."""
    if isinstance(term, Leaf) and isinstance(term.value, list):
        return tuple(Leaf(term.symbol, value) for value in term.value)
    return term.parts if isinstance(term, ListOf) else None


def lone_number(term: Term) -> Leaf | None:
    """Return the number that a side is, without its sign; ``None``: it is more than one."""
    while isinstance(term, Prefix):
        term = term.operand
    return term if isinstance(term, Leaf) and not isinstance(term.value, list) else None


def is_rounded(term: Term) -> bool:
    """Return whether a part of it is rounded to a whole number, so that nothing is left to be about equal."""
    return any(_name(part) in ("floor", "ceil", "round", "//") for part in term.every())


def numbers_in(term: Term) -> set[float]:
    """Return the finite numbers of a term, without its constants."""
    found = [part for part in term.every() if isinstance(part, Leaf) and not is_constant(part)]
    values = [
        value for leaf in found for value in (leaf.value if isinstance(leaf.value, list) else [leaf.value])
    ]
    return {float(value) for value in values if math.isfinite(value)}


def numbers_are_finite(term: Term) -> bool:
    """Return whether no number of a term is infinite or NaN."""
    return all(math.isfinite(part.value) for part in term.every() if isinstance(part, Leaf))


def in_full(value: float) -> Number:
    """Return a number without error; infinities and NaN as they are."""
    return Fraction(value) if math.isfinite(value) else value


def work_out(term: Term, count: Count = in_full) -> tuple[Number, Fraction]:
    """Return the value of a term, and the largest number that takes part in it."""
    if isinstance(term, Leaf):
        value: Number = Fraction(term.value) if is_constant(term) else count(float(term.value))
        return value, _size(value)
    name, parts = _name(term), term.inside()
    if name in _OF_VECTORS and (vectors := list(filter(None, map(_elements, parts)))):
        name, parts = ("sum", tuple(map(_product, *vectors))) if name == "*" else (name, vectors[0])
    found = [work_out(part, count) for part in parts]
    result = _apply(name, [value for value, _ in found])
    return result, max(_size(result), *(size for _, size in found))


def _product(first: Term, second: Term) -> Term:
    return first * second


def _name(term: Term) -> str:
    """Return the name of an operation or function."""
    if isinstance(term, Operation):
        return term.operator
    if isinstance(term, Prefix) and term.operator == "-":
        return "negative"
    if isinstance(term, Colored):
        return "colored"
    return term.function if isinstance(term, Applied) else ""


def _size(value: Number) -> Fraction:
    if isinstance(value, Fraction):
        return abs(value)
    return abs(Fraction(value)) if math.isfinite(value) else Fraction(0)


def _apply(name: str, values: list[Number]) -> Number:
    """Return the result of an operation; that of undefined ones is NaN."""
    if not all(isinstance(value, Fraction) or math.isfinite(value) for value in values):
        values = [float(value) for value in values]
    try:
        return _OPERATIONS[name](*values)
    except (ArithmeticError, ValueError):
        return math.nan


def _power(base: Number, exponent: Number) -> Number:
    if isinstance(base, Fraction) and isinstance(exponent, Fraction) and exponent.denominator == 1:
        return base**exponent.numerator
    return math.pow(float(base), float(exponent))


_OF_VECTORS = ("*", "min", "max")
"""What takes vectors: the product of two, the least and the greatest element of one."""
_OPERATIONS: dict[str, Callable[..., Number]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "@": lambda a, b: a * b,
    **dict.fromkeys("/÷", lambda a, b: a / b),
    "//": lambda a, b: math.floor(a / b),
    "**": _power,
    "negative": lambda a: -a,
    "sum": lambda *values: sum(values),
    "abs": abs,
    **dict.fromkeys(("int", "bool", "colored"), lambda a: a),
    "floor": math.floor,
    "ceil": math.ceil,
    "round": round,
    "sign": lambda a: (a > 0) - (a < 0),
    "float32": lambda a: Fraction(float(np.float32(float(a)))),
    "sqrt": lambda a: math.sqrt(a),
    "log2": lambda a: math.log2(a) if a else -math.inf,
    "min": min,
    "max": max,
}
