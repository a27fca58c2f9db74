r"""What a line of a typed listing computes, as a formula.

An element 0, 1 or 2 of a list of three, and a name with such an index, belongs to a vertex: it has its colour.
"""

import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from core.explain.formulas import Conclusion, Stated
from core.explain.statements import Chain
from core.explain.term_latex import LONGEST_LIST, TermLatex, Written, escaped
from core.lanes.terms import Equality
from core.records.terms import Gathered, Leaf, ListOf, Term

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
    return rf"\mathrm{{{escaped(name)}}}"


def symbol_latex(symbol: str, now: Mapping[str, Any] | None) -> str:
    """Write a variable, or an element of a list, in the colour of its vertex.

    ``now`` are the variables of the step; ``None``: those of a shader, which belong to no vertex whatever their index.
    """
    if now is None:
        return symbol if len(symbol) == 1 else rf"\mathrm{{{escaped(symbol)}}}"
    found = _ELEMENT.match(symbol)
    if found is None:
        text = name_latex(symbol) if symbol.isidentifier() else rf"\mathrm{{{escaped(symbol)}}}"
        named = _INDEXED.match(symbol)
        return rf"\vertex{{{named['index']}}}{{{text}}}" if named and int(named["index"]) < 3 else text
    index: Any = found["index"]
    index = int(index) if index.isdigit() else now.get(index)
    is_known = isinstance(index, int) and not isinstance(index, bool)
    text = f"{name_latex(found['name'])}_{{{index if is_known else found['index']}}}"
    held = now.get(found["name"])
    is_vertex = is_known and index in (0, 1, 2) and isinstance(held, list) and len(held) == 3
    return rf"\vertex{{{index}}}{{{text}}}" if is_vertex else text


def in_latex(term: Term, now: Mapping[str, Any] | None) -> Term:
    """Return a term with its names as formulas write them; ``now`` as in `symbol_latex`."""
    match term:
        case Leaf(symbol, value):
            return Leaf(symbol and symbol_latex(symbol, now), value)
        case Gathered(_, target, _, (_, *_) as written):
            return ListOf(tuple(in_latex(part, {**(now or {}), target: k}) for k, part in enumerate(written)))
        case Gathered(element, target, things):
            one_of, among = (TermLatex(False).text(in_latex(part, now)) for part in (element, things))
            rule = rf"({one_of} \text{{ for }} {name_latex(target)} \in {among})"
            return Written(rule, rule)
    return term.mapped(lambda part: in_latex(part, now))


def stated(equality: Equality, kind: str, now: Mapping[str, Any] | None) -> Stated:
    """Return what a step computes; ``kind`` is that of its `LaneStep`, ``now`` as in `symbol_latex`."""
    right, result = in_latex(equality.right, now), equality.result
    shown = _result("", result)
    if kind in ("set", "for") and equality.symbol:
        return Chain((_result(symbol_latex(equality.symbol, now), result), right), ("=",))
    numbers = TermLatex(True)
    if kind not in ("if", "while") and numbers.cells(right) == numbers.cells(shown):
        return right
    if kind in ("if", "while") or isinstance(result, bool | np.bool_):
        return Conclusion((Chain((right,)),), shown)
    return Chain((right, shown), ("=",))


def _result(symbol: str, value: Any) -> Term:
    """Return what came out; of a long list only how long it is."""
    if isinstance(value, list) and len(value) > LONGEST_LIST:
        length = rf"\text{{{len(value)} values}}"
        return Written(symbol or length, length)
    return Leaf(symbol, value)
