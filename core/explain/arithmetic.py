r"""Arithmetic on the tree of a formula: which terms are plain arithmetic, and what they come to, without any error.

Known are numbers, sums, products, fractions, powers, roots, logarithms to base 2, rounding, least and greatest values,
sizes and the product of two vectors.
"""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from core.explain.digits import MARK
from core.records.terms import Applied, Colored, Leaf, ListOf, Operation, Prefix, Term

Number = Fraction | float
"""A finite number without error, or a float where it is not rational: a root, a logarithm, infinite, NaN."""
Count = Callable[[float], Number]
"""What a number counts as: the value of its digits."""
_TOKEN = re.compile(
    rf"\s+|\\[,;! ]|(?P<mark>{MARK.pattern})|(?P<number>\d+\.?\d*|\.\d+)|(?P<word>\\[A-Za-z]+)|(?P<sign>.)"
)
_SCRIPTED = re.compile(r"\\mathrm\{([a-z][a-z0-9]*)\}|\\log_(?:\{\{2\}\}|\{2\}|2)")


class UnreadError(ValueError):
    """A side is no arithmetic."""


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


def read(text: str) -> Term:
    """Read arithmetic in LaTeX; UnreadError for anything else."""
    reader = _Reader(text)
    found = reader.sum()
    if reader.place < len(reader.tokens) or isinstance(found, ListOf) or not is_arithmetic(found):
        raise UnreadError(text)
    return found


@dataclass(frozen=True)
class ReadNumber(Leaf):
    """A number that was read, and its significant digits."""

    digits: int


class _Reader:
    """Reads tokens from left to right; every method takes what belongs to it."""

    def __init__(self, text: str) -> None:
        named = _SCRIPTED.sub(lambda found: rf"\{(found[1] or 'log').rstrip('0123456789')} ", text)
        self.tokens = [m for m in _TOKEN.finditer(named) if m.lastgroup is not None]
        self.place = 0

    def next(self) -> str:
        """Return the next token without taking it; at the end an empty text."""
        return self.tokens[self.place][0] if self.place < len(self.tokens) else ""

    def take(self, wanted: str = "") -> str:
        found = self.next()
        if not found or (wanted and found != wanted):
            raise UnreadError(found)
        self.place += 1
        return found

    def sum(self) -> Term:
        found = self.product()
        while self.next() in ("+", "-"):
            found = Operation(self.take(), found, self.product())
        return found

    def product(self) -> Term:
        found = self.power()
        while True:
            if self.next() in (r"\cdot", r"\times"):
                self.take()
                found = found * self.power()
            elif self.next() == "/":
                self.take()
                found = found / self.power()
            elif self.next() in ("(", r"\frac", r"\lfloor", r"\sqrt"):
                found = found * self.power()
            else:
                return found

    def power(self) -> Term:
        if self.next() == "-":
            self.take()
            return -self.power()
        found = self.one()
        if self.next() == "^":
            self.take()
            found = found ** self.one()
        return found

    def one(self) -> Term:
        start = self.place
        token = self.take()
        group = self.tokens[start].lastgroup
        if group == "mark":
            return Leaf(r"\num", float(self.tokens[start]["value"]))
        if group == "number":
            number = ReadNumber("", Fraction(token), len(token.replace(".", "").lstrip("0")))
            # A mixed fraction stands without a space: 382 250/256.
            if self.next() == r"\frac" and self.tokens[self.place].start() == self.tokens[start].end():
                return number + self.one()
            return number
        match token:
            case "(":
                return self.bracketed(")")
            case "{":
                return _with_power_of_ten(self.bracketed("}"))
            case "|":
                found = self.sum()
                self.take("|")
                return Applied("abs", (found,))
            case r"\frac":
                return self.one() / self.one()
            case r"\lfloor" | r"\lceil":
                found = self.sum()
                self.take(rf"\r{token[2:]}")
                return Applied(token[2:], (found,))
            case r"\infty":
                return Leaf("", math.inf)
            case r"\vertex":
                self.one()
                return self.one()
            case r"\min" | r"\max" | r"\sqrt" | r"\round" | r"\sign" | r"\log" | r"\float":
                found = self.power()
                name = {"log": "log2", "float": "float32"}.get(token[1:], token[1:])
                return Applied(name, found.parts if isinstance(found, ListOf) else (found,))
        raise UnreadError(token)

    def bracketed(self, end: str) -> Term:
        parts = [self.sum()]
        while self.next() == ",":
            self.take()
            parts.append(self.sum())
        self.take(end)
        return parts[0] if len(parts) == 1 else ListOf(tuple(parts))


def _with_power_of_ten(found: Term) -> Term:
    r"""Return a term, or the number that is written as ``{1.5 \cdot 10^{-3}}``."""
    match found:
        case Operation("*", Leaf() | Prefix() as mantissa, Operation("**", Leaf(_, 10), _)):
            value = Fraction(work_out(found)[0])
            digits = max(part.digits for part in mantissa.every() if isinstance(part, ReadNumber))
            number = ReadNumber("", abs(value), digits)
            return -number if isinstance(mantissa, Prefix) else number
    return found


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
