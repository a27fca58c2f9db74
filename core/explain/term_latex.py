r"""The tree of terms of a typed line as LaTeX: in symbols, and with the numbers of its step, cell under cell.

An element 0, 1 or 2 of a list of three, and a name with such an index, belongs to a vertex: it has its colour.
"""

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from core.explain.digits import number_latex
from core.explain.equation import Part
from core.lanes.terms import (
    TIGHTNESS,
    Applied,
    Choice,
    Equality,
    Gathered,
    Joined,
    Leaf,
    ListOf,
    Operation,
    Prefix,
    Term,
)

LONGEST_LIST = 4
"""Elements of a list that are written out."""
LEAF, CHOICE = 20, 0
SIGNS = {
    "*": r"\cdot",
    "<=": r"\le",
    ">=": r"\ge",
    "==": "=",
    "!=": r"\ne",
    "%": r"\mathbin{\mathrm{mod}}",
    "&": r"\mathbin{\mathrm{and}}",
    "|": r"\mathbin{\mathrm{or}}",
    "^": r"\mathbin{\mathrm{xor}}",
    "<<": r"\ll",
    ">>": r"\gg",
}
AROUND = {
    "floor": (r"\lfloor ", r" \rfloor"),
    "ceil": (r"\lceil ", r" \rceil"),
    "abs": ("| ", " |"),
    "sqrt": (r"\sqrt{", "}"),
}
"""Functions that stand around what they take."""
FUNCTIONS = {"min": r"\min", "max": r"\max"}
_ELEMENT = re.compile(r"^(?P<name>\w+)\[(?P<index>\w+)\]$")
_INDEXED = re.compile(r"^(?P<name>[A-Za-z]+)(?P<index>\d)$")
_GREEK = {"alpha", "beta", "gamma", "delta", "lambda"}


def name_latex(name: str) -> str:
    """Write the name of a variable: one letter as in mathematics, a word upright, a digit behind it as an index."""
    found = _INDEXED.match(name)
    if found:
        return f"{name_latex(found['name'])}_{{{found['index']}}}"
    if len(name) == 1 and name.isalpha():
        return name
    if name in _GREEK:
        return rf"\{name}"
    return rf"\mathrm{{{_escaped(name)}}}"


def symbol_latex(symbol: str, now: Mapping[str, Any]) -> str:
    """Write a variable, or an element of a list, in the colour of its vertex; ``now`` are the variables of the step."""
    found = _ELEMENT.match(symbol)
    if found is None:
        text = name_latex(symbol) if symbol.isidentifier() else rf"\mathrm{{{_escaped(symbol)}}}"
        named = _INDEXED.match(symbol)
        return rf"\vertex{{{named['index']}}}{{{text}}}" if named and int(named["index"]) < 3 else text
    index: Any = found["index"]
    index = int(index) if index.isdigit() else now.get(index)
    is_known = isinstance(index, int) and not isinstance(index, bool)
    text = f"{name_latex(found['name'])}_{{{index if is_known else found['index']}}}"
    held = now.get(found["name"])
    is_vertex = is_known and index in (0, 1, 2) and isinstance(held, list) and len(held) == 3
    return rf"\vertex{{{index}}}{{{text}}}" if is_vertex else text


def _escaped(text: str) -> str:
    return text.replace("_", r"\_").replace("%", r"\%").replace("&", r"\&").replace(" ", r"\ ")


def value_latex(value: Any) -> str:
    """Write a value: a number with its mark, a flag as a word, a short list in brackets."""
    if isinstance(value, bool | np.bool_):
        return rf"\text{{{'true' if value else 'false'}}}"
    if isinstance(value, int | float | np.integer | np.floating):
        return number_latex(float(value))
    if isinstance(value, list):
        if len(value) > LONGEST_LIST:
            return rf"\text{{{len(value)} values}}"
        return rf"({', '.join(map(value_latex, value))})"
    return rf"\text{{{'nothing' if value is None else value}}}"


class TermLatex:
    """Prints the terms of one step, in symbols and in numbers at once."""

    def __init__(self, now: Mapping[str, Any]) -> None:
        self._now = now

    def pair(self, term: Term) -> tuple[str, str]:
        """Return a term in symbols, and with its numbers."""
        return self.text(term, False), self.text(term, True)

    def text(self, term: Term, puts_in: bool) -> str:
        """Return a term in symbols, or with its numbers put in."""
        return self._printed(term, puts_in)[0]

    def cells(self, term: Term) -> list[Part]:
        """Return a term as parts of an equation: the outermost sum, or conditions with and, or, in several."""
        match term:
            case Applied("bool", (condition,)):
                return self.cells(condition)
            case Operation("+" | "-" as operator, left, right):
                return [*self.cells(left), operator, self._operand(right, TIGHTNESS["+"] + 1)]
            case Joined(is_and, parts):
                found: list[Part] = []
                for part in parts:
                    found += [r"\land" if is_and else r"\lor"] if found else []
                    found.append(self._operand(part, TIGHTNESS["not"]))
                return found
        return [self.pair(term)]

    def _operand(self, term: Term, least: int) -> tuple[str, str]:
        symbols, numbers = (self._inner(term, least, puts_in) for puts_in in (False, True))
        return symbols, _signed(numbers)

    def _inner(self, term: Term, least: int, puts_in: bool) -> str:
        text, tight = self._printed(term, puts_in)
        return f"({text})" if tight < least else text

    def _printed(self, term: Term, puts_in: bool) -> tuple[str, int]:
        """Return the text of a term, and how tightly it holds together."""
        match term:
            case Leaf(symbol, value):
                is_short = not isinstance(value, list) or len(value) <= LONGEST_LIST
                if not symbol or (puts_in and value is not None and is_short):
                    return value_latex(value), LEAF
                return symbol_latex(symbol, self._now), LEAF
            case Operation("/", left, right):
                above, below = (self._inner(part, CHOICE, puts_in) for part in (left, right))
                return rf"\frac{{{above}}}{{{below}}}", LEAF
            case Operation("//", left, right):
                above, below = (self._inner(part, CHOICE, puts_in) for part in (left, right))
                return rf"\lfloor \frac{{{above}}}{{{below}}} \rfloor", LEAF
            case Operation("**", left, right):
                base = self._inner(left, LEAF, puts_in)
                base = f"({base})" if puts_in and base.startswith(r"\num{-") else base
                return f"{{{base}}}^{{{self._inner(right, CHOICE, puts_in)}}}", TIGHTNESS["**"]
            case Operation(operator, left, right):
                tight = TIGHTNESS[operator]
                after = _signed(self._inner(right, tight + 1, puts_in))
                return f"{self._inner(left, tight, puts_in)} {SIGNS.get(operator, operator)} {after}", tight
            case Prefix("not", operand):
                return rf"\lnot {self._inner(operand, LEAF, puts_in)}", TIGHTNESS["not"]
            case Prefix(operator, operand):
                sign = "-" if operator in "-+" and operator == "-" else operator
                return f"{sign}{_signed(self._inner(operand, LEAF, puts_in))}", TIGHTNESS["sign"]
            case Joined(is_and, parts):
                word, tight = (r"\land", TIGHTNESS["and"]) if is_and else (r"\lor", TIGHTNESS["or"])
                # Brackets that the language does not need: and in or is read wrongly without.
                inner = [self._inner(part, TIGHTNESS["not"], puts_in) for part in parts]
                return rf" \; {word} \; ".join(inner), tight
            case Choice(test, yes, no):
                first, condition, other = (self._inner(part, 1, puts_in) for part in (yes, test, no))
                return rf"{first} \text{{ if }} {condition} \text{{ else }} {other}", CHOICE
            case Applied(function, arguments):
                return self._applied(function, arguments, puts_in)
            case ListOf(parts):
                return rf"({', '.join(self._inner(part, CHOICE, puts_in) for part in parts)})", LEAF
            case Gathered(element, target, things, written):
                if written:
                    printers = (TermLatex({**self._now, target: k}) for k in range(len(written)))
                    each = (one.text(part, puts_in) for one, part in zip(printers, written, strict=True))
                    return f"({', '.join(each)})", LEAF
                one_of, among = (self._inner(part, CHOICE, False) for part in (element, things))
                return rf"({one_of} \text{{ for }} {name_latex(target)} \in {among})", LEAF
        raise AssertionError(f"{type(term).__name__} has no printer")

    def _applied(self, function: str, arguments: Sequence[Term], puts_in: bool) -> tuple[str, int]:
        texts = [self._inner(argument, CHOICE, puts_in) for argument in arguments]
        if function in AROUND and len(texts) == 1:
            before, after = AROUND[function]
            return f"{before}{texts[0]}{after}", LEAF
        if function in ("bool", "int", "float") and len(texts) == 1:
            return texts[0], self._printed(arguments[0], puts_in)[1]
        if function == "is None":
            return rf"{texts[0]} = \text{{nothing}}", TIGHTNESS["=="]
        if function == "in":
            return rf"{texts[0]} \in {texts[1]}", TIGHTNESS["=="]
        name = FUNCTIONS.get(function, rf"\mathrm{{{_escaped(function)}}}")
        return f"{name}({', '.join(texts)})", LEAF


def _signed(text: str) -> str:
    """Return what stands behind an operator: a lone negative number in brackets."""
    if text.startswith(r"\num{") and text.count(r"\num") == 1 and text.endswith("}") and " " not in text:
        return text.replace(r"\num{", r"\nums{", 1)
    return f"({text})" if text.startswith("-") else text


def equality_parts(equality: Equality, kind: str, now: Mapping[str, Any]) -> list[Part]:
    """Return the parts of an equation that says what a step computes; ``kind`` is that of its `LaneStep`."""
    printer, result = TermLatex(now), value_latex(equality.result)
    right = printer.cells(equality.right)
    if kind in ("if", "while"):
        return [*right, r"\Rightarrow", result]
    if kind in ("set", "for") and equality.symbol:
        return [(symbol_latex(equality.symbol, now), result), "=", *right]
    is_known = len(right) == 1 and isinstance(right[0], tuple) and right[0][1] == result
    return right if is_known else [*right, *_outcome(equality.result, result)]


def _outcome(value: Any, result: str) -> list[Part]:
    return [r"\Rightarrow", result] if isinstance(value, bool | np.bool_) else ["=", result]
