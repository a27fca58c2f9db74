r"""Arithmetic in LaTeX: the plain part of it that formulas use is read, and worked out without any error.

Known are decimals, marked numbers (`core.explain.digits`), sums, products, fractions, powers, roots, logarithms to base
2, rounding, least and greatest values, sizes and the product of two vectors.
"""

import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial, reduce

import numpy as np

from core.explain.digits import MARK

Number = Fraction | float
"""A finite number without error, or a float where it is not rational: a root, a logarithm, infinite, NaN."""
Leaf = Callable[[float], Number]
"""What a marked number counts as: the value of its digits."""
_TOKEN = re.compile(
    rf"\s+|\\[,;! ]|(?P<mark>{MARK.pattern})|(?P<number>\d+\.?\d*|\.\d+)|(?P<word>\\[A-Za-z]+)|(?P<sign>.)"
)
_SCRIPTED = re.compile(r"\\mathrm\{([a-z][a-z0-9]*)\}|\\log_(?:\{\{2\}\}|\{2\}|2)")
_ROUNDING = {"floor", "ceil", "round"}


class UnreadError(ValueError):
    """A side is no arithmetic."""


@dataclass(frozen=True)
class Term:
    """An operation on terms, a vector of them, or a number."""

    name: str
    """``mark``, ``number`` or the operation."""
    parts: tuple["Term", ...] = ()
    value: float | Fraction = 0.0
    digits: int = 0
    """Significant digits of a number that is written out."""

    def every(self) -> Iterator["Term"]:
        """Yield the term and all of its parts, to any depth."""
        yield self
        for part in self.parts:
            yield from part.every()

    @property
    def is_alone(self) -> bool:
        """Whether it is one number, with or without its sign."""
        return self.name in ("mark", "number") or (self.name == "negative" and self.parts[0].is_alone)

    @property
    def number(self) -> "Term":
        """The number of a side that is one, without its sign."""
        return self.parts[0].number if self.name == "negative" else self

    @property
    def is_rounded(self) -> bool:
        """Whether a part of it is rounded to a whole number, so that nothing is left to be about equal."""
        return any(term.name in _ROUNDING for term in self.every())

    def marks(self) -> set[float]:
        """Return the finite ones of its marked numbers."""
        return {
            float(term.value) for term in self.every() if term.name == "mark" and math.isfinite(term.value)
        }


def in_full(value: float) -> Number:
    """Return a number without error; infinities and NaN as they are."""
    return Fraction(value) if math.isfinite(value) else value


def read(text: str) -> Term:
    """Read arithmetic in LaTeX; UnreadError for anything else."""
    reader = _Reader(text)
    found = reader.sum()
    if reader.place < len(reader.tokens) or found.name == "vector":
        raise UnreadError(text)
    return found


def _made(name: str, *parts: Term) -> Term:
    """Return an operation; vectors are only multiplied with each other, as the sum of their products."""
    vectors = [part for part in parts if part.name == "vector"]
    if not vectors:
        return Term(name, parts)
    if name != "times" or len(vectors) != len(parts):
        raise UnreadError(name)
    products = [Term("times", pair) for pair in zip(*(vector.parts for vector in vectors), strict=True)]
    return reduce(partial(_made, "plus"), products)


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
            name = "plus" if self.take() == "+" else "minus"
            found = _made(name, found, self.product())
        return found

    def product(self) -> Term:
        found = self.power()
        while True:
            if self.next() in (r"\cdot", r"\times"):
                self.take()
                found = _made("times", found, self.power())
            elif self.next() == "/":
                self.take()
                found = _made("over", found, self.power())
            elif self.next() in ("(", r"\frac", r"\lfloor", r"\sqrt"):
                found = _made("times", found, self.power())
            else:
                return found

    def power(self) -> Term:
        if self.next() == "-":
            self.take()
            return _made("negative", self.power())
        found = self.one()
        if self.next() == "^":
            self.take()
            found = _made("power", found, self.one())
        return found

    def one(self) -> Term:
        start = self.place
        token = self.take()
        group = self.tokens[start].lastgroup
        if group == "mark":
            return Term("mark", value=float(self.tokens[start]["value"]))
        if group == "number":
            number = Term("number", value=Fraction(token), digits=len(token.replace(".", "").lstrip("0")))
            # A mixed fraction stands without a space: 382 250/256.
            if self.next() == r"\frac" and self.tokens[self.place].start() == self.tokens[start].end():
                return _made("plus", number, self.one())
            return number
        match token:
            case "(":
                return self.bracketed(")")
            case "{":
                return _with_power_of_ten(self.bracketed("}"))
            case "|":
                found = self.sum()
                self.take("|")
                return _made("size", found)
            case r"\frac":
                return _made("over", self.one(), self.one())
            case r"\lfloor" | r"\lceil":
                found = self.sum()
                self.take(rf"\r{token[2:]}")
                return _made(token[2:], found)
            case r"\infty":
                return Term("number", value=math.inf)
            case r"\vertex":
                self.one()
                return self.one()
            case r"\min" | r"\max" | r"\sqrt" | r"\round" | r"\sign" | r"\log" | r"\float":
                found = self.power()
                return _made(token[1:], *(found.parts if found.name == "vector" else (found,)))
        raise UnreadError(token)

    def bracketed(self, end: str) -> Term:
        parts = [self.sum()]
        while self.next() == ",":
            self.take()
            parts.append(self.sum())
        self.take(end)
        return parts[0] if len(parts) == 1 else Term("vector", tuple(parts))


def _with_power_of_ten(found: Term) -> Term:
    r"""Return a term, or the number that is written as ``{1.5 \cdot 10^{-3}}``."""
    match found:
        case Term("times", (Term("number" | "negative") as mantissa, Term("power", (Term(value=10), _)))):
            value = Fraction(work_out(found)[0])
            number = Term("number", value=abs(value), digits=max(term.digits for term in mantissa.every()))
            return Term("negative", (number,)) if value < 0 else number
    return found


def work_out(term: Term, leaf: Leaf = in_full) -> tuple[Number, Fraction]:
    """Return the value of a term, and the largest number that takes part in it."""
    if term.name == "mark":
        value = leaf(float(term.value))
        return value, _size(value)
    if term.name == "number":
        return term.value, _size(term.value)
    parts = [work_out(part, leaf) for part in term.parts]
    found = _apply(term.name, [value for value, _ in parts])
    return found, max(_size(found), *(size for _, size in parts))


def _size(value: Number) -> Fraction:
    if isinstance(value, Fraction):
        return abs(value)
    return abs(Fraction(value)) if math.isfinite(value) else Fraction(0)


def _apply(name: str, values: Sequence[Number]) -> Number:
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


_OPERATIONS: dict[str, Callable[..., Number]] = {
    "plus": lambda a, b: a + b,
    "minus": lambda a, b: a - b,
    "times": lambda a, b: a * b,
    "over": lambda a, b: a / b,
    "negative": lambda a: -a,
    "power": _power,
    "size": abs,
    "floor": math.floor,
    "ceil": math.ceil,
    "round": round,
    "sign": lambda a: (a > 0) - (a < 0),
    "float": lambda a: Fraction(float(np.float32(float(a)))),
    "sqrt": lambda a: math.sqrt(a),
    "log": lambda a: math.log2(a) if a else -math.inf,
    "min": min,
    "max": max,
}
