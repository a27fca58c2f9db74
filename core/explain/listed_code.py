"""What a line of a listing computes, in symbols and numbers: the marked line of a method's, and a typed one.

An element 0, 1 or 2 of a list of three, and a name with such an index, belongs to a vertex: it has its colour.
"""

import ast
import math
import re
from collections.abc import Callable, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from core.explain.formulas import Chain, Conclusion, Named, Stated, named
from core.explain.step_values import StepValues
from core.explain.steps import held_values
from core.explain.term_latex import LONGEST_LIST, TermLatex, Written, escaped, work_out
from core.methods import table
from core.records.listing import read_statements, source_listing
from core.records.terms import Gathered, Leaf, ListOf, Term, term

if TYPE_CHECKING:
    from core.lanes.terms import Equality  # The evaluator is loaded with the first listing that is edited.

# What the marked line of a listing computes, in symbols and numbers: read from the line itself.


BEFORE = r"_{\mathrm{before}}"
NAMES = {"major": "x", "minor": "y"}
"""Columns that the table of variables has other names for where a listing has swapped x and y."""


@cache
def _code(function: Callable[..., Any], label: str) -> ast.stmt | None:
    """Return the statement on a labelled line of a function, without its body; ``None``: it has no such line."""
    shown = source_listing(function)
    if label not in shown.lines:
        return None
    line = shown.source.splitlines()[shown.lines[label] - 1].strip()
    return read_statements(f"{line} pass" if line.endswith(":") else line).body[0]


def code_of(step: StepValues, label: str = "") -> ast.stmt | None:
    """Return the statement that a step marks, or the one with a label, in the listing of the step."""
    shown, line = step.explanation.listing, step.explanation.line
    if shown is None:
        return None
    if not label:
        marked = [name for name, number in shown.lines.items() if number == line]
        label = step.operation if step.operation in marked else next(iter(marked), "")
    return _code(shown.function, label)


def assigned_name(code: ast.stmt | None) -> str:
    """Return the one name that a statement gives a value, empty: it is no such statement."""
    targets: list[ast.expr] = [code.target] if isinstance(code, ast.AugAssign) else []
    if isinstance(code, ast.Assign):
        targets = code.targets
    return targets[0].id if len(targets) == 1 and isinstance(targets[0], ast.Name) else ""


def tested(code: ast.stmt | None) -> ast.Compare | None:
    """Return the comparison that an ``if`` makes."""
    return code.test if isinstance(code, ast.If) and isinstance(code.test, ast.Compare) else None


def tested_name(line: str) -> str:
    """Return what the listing of a line method tests before a step, as ``D`` or ``e + m``; empty: it tests nothing."""
    function = table.get("line", line).listing
    found = None if function is None else tested(_code(function, "test"))
    return "" if found is None else symbols(found.left)


def symbols(code: ast.expr) -> str:
    """Write an expression as sentences do, without roundings: ``2 · dy − dx``."""
    code = code.args[0] if isinstance(code, ast.Call) else code
    return ast.unparse(code).replace("*", "·").replace(" - ", " − ")


def value_of(code: ast.expr) -> float:
    """Return the number of an expression without names."""
    return float(work_out(_sum(code, {}))[0])


def named_sum(code: ast.expr, value: float) -> Named:
    """Return an expression with its number, as one symbol."""
    return named(TermLatex(False).text(_sum(code, {})), value)


def assignment(step: StepValues) -> tuple[Chain, str, float]:
    """Return what a step's line computes.

    Returns
    -------
    equation : Chain
        As ``D = D_before - 2 dx``.
    added : str
        What the line adds or takes off in symbols; of a plain assignment the whole right side.
    value : float
        Its number.
    """
    code = code_of(step)
    name = assigned_name(code)
    assert isinstance(code, ast.Assign | ast.AugAssign), f"{step.explanation.key} assigns nothing"
    values, now = _values(step, name)
    names = {key: named(_latex(key), value) for key, value in values.items()}
    names[name] = named(_latex(name) + BEFORE, values.get(name, math.nan))
    added = _sum(code.value, names)
    right = added
    if isinstance(code, ast.AugAssign):
        right = _sum(code.value, names, names[name], 1 if isinstance(code.op, ast.Add) else -1)
    return named(_latex(name), now).equals(right), symbols(code.value), float(work_out(added)[0])


def _values(step: StepValues, assigned: str) -> tuple[dict[str, float], float]:
    """Return the numbers before a step, and the one that it gives to a name."""
    values: dict[str, float] = {}
    now = math.nan
    for held in held_values(step):
        name = NAMES.get(held.column.removesuffix("_before"), held.label)
        if not isinstance(held.now, int | float):
            continue
        if name == assigned:
            now = float(held.now)
            if held.before is not None:
                values[name] = float(held.before)
        else:
            values[name] = float(held.now)
    return values, now


def _sum(code: ast.expr, names: Mapping[str, Named], before: Term | None = None, sign: int = 1) -> Term:
    """Return an expression as a sum of products, added to what stands before it or taken off."""
    if isinstance(code, ast.BinOp) and isinstance(code.op, ast.Add | ast.Sub):
        before = _sum(code.left, names, before, sign)
        return _sum(code.right, names, before, sign if isinstance(code.op, ast.Add) else -sign)
    if isinstance(code, ast.UnaryOp):
        return _sum(code.operand, names, before, -sign)
    if isinstance(code, ast.Call):
        # Rounding to float32, which the sign of equality shows.
        return _sum(code.args[0], names, before, sign)
    factor = _factor(code, names)
    if before is None:
        return factor if sign > 0 else -factor
    return before + factor if sign > 0 else before - factor


def _factor(code: ast.expr, names: Mapping[str, Named]) -> Term:
    if isinstance(code, ast.BinOp) and isinstance(code.op, ast.Mult):
        return _factor(code.left, names) * _factor(code.right, names)
    if isinstance(code, ast.BinOp) and isinstance(code.op, ast.Div):
        return _factor(code.left, names) / _factor(code.right, names)
    if isinstance(code, ast.Name):
        return names.get(code.id) or named(_latex(code.id), math.nan)
    return term(code.value) if isinstance(code, ast.Constant) else _sum(code, names)  # type: ignore[arg-type]


def _latex(name: str) -> str:
    stem, found, rest = name.partition("_")
    return rf"{stem}_{{\mathrm{{{rest}}}}}" if found else name


# What a line of a typed listing computes, as a formula.


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


def stated(equality: "Equality", kind: str, now: Mapping[str, Any] | None) -> Stated:
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
