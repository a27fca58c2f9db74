r"""Terms as LaTeX: in symbols, and with the numbers of their step put in, cell under cell."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from numbers import Real
from types import MappingProxyType
from typing import Any

import numpy as np

from core.explain.arithmetic import is_constant
from core.explain.digits import in_latex
from core.explain.number_text import DIGITS, latex_text
from core.raster.edges.snapping import SUBPIXELS
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
