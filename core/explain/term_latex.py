"""Terms as LaTeX, in symbols and with the numbers of their step; and which of them are plain arithmetic.

Known are numbers, sums, products, fractions, powers, roots, logarithms to base 2, rounding, least and greatest values,
sizes and the product of two vectors.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from numbers import Real
from types import MappingProxyType
from typing import Any

import numpy as np

from core.coverage.snapping import SUBPIXELS
from core.explain.number_text import DIGITS, in_latex, latex_text
from core.records.terms import (
    CHOICE,
    LEAF,
    TIGHTNESS,
    Applied,
    Choice,
    Colored,
    Joined,
    Leaf,
    ListOf,
    Operation,
    Prefix,
    Term,
)

# Arithmetic on the tree of a formula: which terms are plain arithmetic, and what they come to, without any
# error.


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


# Terms as LaTeX: in symbols, and with the numbers of their step put in, cell under cell.


NO_DIGITS: Mapping[float, int] = MappingProxyType({})
LONGEST_LIST = 4
"""Elements of a list that are written out."""
SIGNS = {
    "*": r"\cdot",
    "×": r"\times",
    "÷": "/",
    "<=": r"\le",
    ">=": r"\ge",
    "==": "=",
    "!=": r"\ne",
    "%": r"\text{ mod }",
    "&": r"\text{ and }",
    "|": r"\text{ or }",
    "^": r"\text{ xor }",
    "<<": r"\text{ << }",
    ">>": r"\text{ >> }",
}
AROUND = {
    "floor": (r"\lfloor ", r" \rfloor"),
    "ceil": (r"\lceil ", r" \rceil"),
    "abs": ("|", "|"),
    "sqrt": (r"\sqrt{", "}"),
}
"""Functions that stand around what they take."""
FUNCTIONS = {"min": r"\min", "max": r"\max"}
UNSEEN = ("bool", "int", "float")
"""Functions that formulas leave out."""


@dataclass(frozen=True)
class Written(Term):
    """What is written out by hand, in symbols and with its numbers: it is no arithmetic."""

    symbols: str
    numbers: str = ""
    """Empty: the same as the symbols."""


def exact_latex(value: Fraction | int) -> str:
    """Write a whole number in full, and 1/256ths as a mixed fraction."""
    if value.denominator == 1:
        return str(value)
    sign, (whole, part) = "-" if value < 0 else "", divmod(round(abs(Fraction(value)) * SUBPIXELS), SUBPIXELS)
    return rf"{sign}{whole or ''}\frac{{{part}}}{{{SUBPIXELS}}}"


def escaped(text: str) -> str:
    """Return the name of something with the signs that LaTeX reads otherwise."""
    return text.replace("_", r"\_").replace("%", r"\%").replace("&", r"\&").replace(" ", r"\ ")


class TermLatex:
    """Prints terms in symbols, or with their numbers.

    Parameters
    ----------
    puts_in : bool
        Whether numbers stand in the place of their symbols.
    digits : mapping, optional
        Size of a number to its significant digits; others have four.
    """

    def __init__(self, puts_in: bool, digits: Mapping[float, int] = NO_DIGITS) -> None:
        self.puts_in, self.digits = puts_in, digits

    def cells(self, term: Term, *, is_first: bool = True) -> list[str]:
        """Return the cells of a term: sums, products, and conditions with and, or, in several."""
        match term:
            case Applied("bool", (condition,)):
                return self.cells(condition, is_first=is_first)
            case Operation("+" | "-" | "*" | "×" as operator, left, right):
                tight = TIGHTNESS[operator]
                sign = SIGNS.get(operator, operator)
                return [
                    *self._inner_cells(left, tight, is_first),
                    sign,
                    *self._inner_cells(right, tight + 1, False),
                ]
            case Prefix("-", operand) if is_first:
                inner = self._inner_cells(operand, TIGHTNESS["*"], False)
                return ["-", *inner] if len(inner) > 1 else [f"-{inner[0]}"]
            case Joined(is_and, parts):
                found: list[str] = []
                for part in parts:
                    found += [r"\land" if is_and else r"\lor"] if found else []
                    found.append(self._inner(part, TIGHTNESS["not"]))
                return found
        return [self._printed(term, is_first)]

    def _inner_cells(self, term: Term, least: int, is_first: bool) -> list[str]:
        return [self._inner(term, least)] if tightness(term) < least else self.cells(term, is_first=is_first)

    def text(self, term: Term) -> str:
        """Return a term in one cell."""
        return self._printed(term, True)

    def _inner(self, term: Term, least: int = CHOICE, is_first: bool = True) -> str:
        if tightness(term) < least:
            return f"({self._printed(term, True)})"
        return self._printed(term, is_first)

    def _printed(self, term: Term, is_first: bool) -> str:
        """Return the text of a term; one that is not first has brackets around its sign."""
        match term:
            case Leaf():
                return self._leaf(term, is_first)
            case Written(symbols, numbers):
                return in_latex(numbers, self.digits) if self.puts_in and numbers else symbols
            case Colored(corner, inner):
                text = self._printed(inner, is_first)
                return text if self.puts_in else rf"\vertex{{{corner}}}{{{text}}}"
            case Operation("/", left, right):
                return rf"\frac{{{self._inner(left)}}}{{{self._inner(right)}}}"
            case Operation("//", left, right):
                return rf"\lfloor \frac{{{self._inner(left)}}}{{{self._inner(right)}}} \rfloor"
            case Operation("**", left, right):
                base, exponent = self._inner(left, LEAF, False), self._inner(right)
                base = f"{{{base}}}" if base.startswith("\\") else base
                return f"{base}^{exponent}" if len(exponent) == 1 else f"{base}^{{{exponent}}}"
            case Operation("@", left, right):
                sign = r"\cdot " if self.puts_in else ""
                tight = TIGHTNESS["@"]
                return f"{self._inner(left, tight, is_first)} {sign}{self._inner(right, tight + 1, False)}"
            case Operation(operator, left, right):
                tight, sign = TIGHTNESS[operator], SIGNS.get(operator, operator)
                return f"{self._inner(left, tight, is_first)} {sign} {self._inner(right, tight + 1, False)}"
            case Prefix("not", operand):
                return rf"\lnot {self._inner(operand, LEAF)}"
            case Prefix(operator, operand):
                text = f"{operator}{self._inner(operand, LEAF, False)}"
                return text if is_first or operator != "-" else f"({text})"
            case Joined(is_and, parts):
                # Brackets that the language does not need: and in or is read wrongly without.
                word = r" \; \land \; " if is_and else r" \; \lor \; "
                return word.join(self._inner(part, TIGHTNESS["not"]) for part in parts)
            case Choice(test, yes, no):
                first, condition, other = (self._inner(part, 1) for part in (yes, test, no))
                return rf"{first} \text{{ if }} {condition} \text{{ else }} {other}"
            case Applied(function, arguments):
                return self._applied(function, arguments, is_first)
            case ListOf(parts):
                return f"({', '.join(map(self._inner, parts))})"
        raise AssertionError(f"{type(term).__name__} has no printer")

    def _leaf(self, leaf: Leaf, is_first: bool) -> str:
        symbol, value = leaf.symbol, leaf.value
        is_short = not isinstance(value, list) or len(value) <= LONGEST_LIST
        if symbol and not (self.puts_in and value is not None and is_short):
            return symbol
        text = exact_latex(value) if is_constant(leaf) else self.value(value)
        return f"({text})" if text.startswith(("-", "{-")) and not is_first else text

    def value(self, value: Any) -> str:
        """Write a value: a flag as a word, a short list in brackets."""
        if isinstance(value, bool | np.bool_):
            return rf"\text{{{'true' if value else 'false'}}}"
        if isinstance(value, list):
            if len(value) > LONGEST_LIST:
                return rf"\text{{{len(value)} values}}"
            return f"({', '.join(map(self.value, value))})"
        if not isinstance(value, Real):
            return rf"\text{{{'nothing' if value is None else value}}}"
        return latex_text(float(value) + 0.0, self.digits.get(abs(float(value)), DIGITS))

    def _applied(self, function: str, arguments: tuple[Term, ...], is_first: bool) -> str:
        if function in UNSEEN and len(arguments) == 1:
            return self._printed(arguments[0], is_first)
        texts = [self._inner(argument) for argument in arguments]
        if function in AROUND and len(texts) == 1:
            return texts[0].join(AROUND[function])
        if function == "is None":
            return rf"{texts[0]} = \text{{nothing}}"
        if function == "in":
            return rf"{texts[0]} \in {texts[1]}"
        if function == "log2":
            # In double brackets, since a single 2 below a symbol has the colour of corner 2.
            return rf"\log_{{{{2}}}} {self._inner(arguments[0], LEAF)}"
        name = FUNCTIONS.get(function, rf"\mathrm{{{escaped(function)}}}")
        return f"{name}({', '.join(texts)})"


def tightness(term: Term) -> int:
    """Return how tightly the text of a term holds together."""
    match term:
        case Operation("/" | "//"):
            return LEAF
        case Operation(operator):
            return TIGHTNESS[operator]
        case Prefix(operator):
            return TIGHTNESS["not" if operator == "not" else "sign"]
        case Joined(is_and):
            return TIGHTNESS["and" if is_and else "or"]
        case Choice():
            return CHOICE
        case Applied(function, (argument,)) if function in UNSEEN:
            return tightness(argument)
        case Applied("is None" | "in"):
            return TIGHTNESS["=="]
        case Colored(_, inner):
            return tightness(inner)
    return LEAF
