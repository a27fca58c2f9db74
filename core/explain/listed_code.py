"""What the marked line of a listing computes, in symbols and numbers: read from the line itself."""

import ast
import math
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from core.explain.arithmetic import work_out
from core.explain.formulas import Named, named
from core.explain.statements import Chain
from core.explain.step_values import StepValues
from core.explain.term_latex import TermLatex
from core.explain.variable_text import held_values
from core.methods import table
from core.records.listing import source_listing
from core.records.python_text import read_statements
from core.records.terms import Term, term

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
