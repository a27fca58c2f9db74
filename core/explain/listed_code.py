"""What the marked line of a listing computes, in symbols and numbers: read from the line itself."""

import ast
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from core.explain.digits import number_latex, signed_latex
from core.explain.equation import Part, fraction
from core.explain.step_values import StepValues
from core.explain.variable_text import held_values
from core.methods import table
from core.records.listing import source_listing

BEFORE = r"_{\mathrm{before}}"
NAMES = {"major": "x", "minor": "y"}
"""Columns that the table of variables has other names for where a listing has swapped x and y."""
Values = Mapping[str, float]
"""Name in the listing to its number."""


@cache
def _code(function: Callable[..., Any], label: str) -> ast.stmt | None:
    """Return the statement on a labelled line of a function, without its body; ``None``: it has no such line."""
    shown = source_listing(function)
    if label not in shown.lines:
        return None
    line = shown.source.splitlines()[shown.lines[label] - 1].strip()
    return ast.parse(f"{line} pass" if line.endswith(":") else line).body[0]


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


def symbols_latex(code: ast.expr) -> str:
    """Write an expression as formulas do, in symbols."""
    return " ".join(part if isinstance(part, str) else part[0] for part in _sum(code, {}))


def assignment(step: StepValues) -> tuple[list[Part], str, float]:
    """Return what a step's line computes.

    Returns
    -------
    parts : list of Part
        Of the equation ``D = D_before - 2 dx``.
    added : str
        What the line adds or takes off in symbols; of a plain assignment the whole right side.
    value : float
        Its number.
    """
    code = code_of(step)
    name = assigned_name(code)
    assert isinstance(code, ast.Assign | ast.AugAssign), f"{step.explanation.key} assigns nothing"
    values, now = _values(step, name)
    symbol = _latex(name)
    made = _sum(code.value, values)
    made = [(symbol + BEFORE, part[1]) if part[0] == symbol else part for part in made]
    added, value = symbols(code.value), number_of(code.value, values)
    if isinstance(code, ast.AugAssign):
        made = _sum(ast.BinOp(ast.Name(name + BEFORE), code.op, code.value), values)
    return [(symbol, now), "=", *made], added, value


def used_values(step: StepValues) -> Values:
    """Return the numbers that a step's line computes with."""
    code = code_of(step)
    assert isinstance(code, ast.Assign | ast.AugAssign), f"{step.explanation.key} assigns nothing"
    values, _ = _values(step, assigned_name(code))
    return {node.id: values[node.id] for node in ast.walk(code.value) if isinstance(node, ast.Name)}


def number_of(code: ast.expr, values: Values) -> float:
    """Return the number of an expression."""
    if isinstance(code, ast.BinOp):
        first, second = number_of(code.left, values), number_of(code.right, values)
        if isinstance(code.op, ast.Add):
            return first + second
        if isinstance(code.op, ast.Sub):
            return first - second
        return first * second if isinstance(code.op, ast.Mult) else first / second
    if isinstance(code, ast.Name):
        return values.get(code.id, float("nan"))
    if isinstance(code, ast.UnaryOp):
        return -number_of(code.operand, values)
    if isinstance(code, ast.Call):
        return number_of(code.args[0], values)
    assert isinstance(code, ast.Constant)
    return float(code.value)  # type: ignore[arg-type]


def _values(step: StepValues, assigned: str) -> tuple[dict[str, float], float]:
    """Return the numbers before a step, and the one that it gives to a name."""
    values: dict[str, float] = {}
    now = float("nan")
    for held in held_values(step):
        name = NAMES.get(held.column.removesuffix("_before"), held.label)
        if not isinstance(held.now, int | float):
            continue
        if name == assigned:
            now = float(held.now)
            if held.before is not None:
                values |= dict.fromkeys((name, name + BEFORE), float(held.before))
        else:
            values[name] = float(held.now)
    return values, now


def _sum(code: ast.expr, values: Values) -> list[Part]:
    """Return the parts of an expression as a sum of products, without brackets."""
    parts: list[Part] = []
    for sign, term in _terms(code, 1):
        if parts or sign < 0:
            parts.append("+" if sign > 0 else "-")
        parts += _product(term, values)
    return parts


def _terms(code: ast.expr, sign: int) -> list[tuple[int, ast.expr]]:
    if isinstance(code, ast.BinOp) and isinstance(code.op, ast.Add | ast.Sub):
        second = sign if isinstance(code.op, ast.Add) else -sign
        return [*_terms(code.left, sign), *_terms(code.right, second)]
    if isinstance(code, ast.UnaryOp):
        return _terms(code.operand, -sign)
    if isinstance(code, ast.Call):
        # Rounding to float32, which the sign of equality shows.
        return _terms(code.args[0], sign)
    return [(sign, code)]


def _product(code: ast.expr, values: Values) -> list[Part]:
    if isinstance(code, ast.BinOp) and isinstance(code.op, ast.Add | ast.Sub):
        parts = _sum(code, values)
        symbols = " ".join(part if isinstance(part, str) else part[0] for part in parts)
        numbers = " ".join(part if isinstance(part, str) else _number(part[1]) for part in parts)
        return [(f"({symbols})", f"({numbers})")]
    if isinstance(code, ast.BinOp) and isinstance(code.op, ast.Mult):
        return [*_product(code.left, values), r"\cdot", *_product(code.right, values)]
    if isinstance(code, ast.BinOp):
        above, below = (
            (_latex(ast.unparse(side)), number_of(side, values)) for side in (code.left, code.right)
        )
        return [fraction(above, below)]
    if isinstance(code, ast.Name):
        return [(_latex(code.id), values.get(code.id, float("nan")))]
    return [number_latex(number_of(code, values))]


def _number(value: float | str) -> str:
    return value if isinstance(value, str) else signed_latex(value)


def _latex(name: str) -> str:
    stem, found, rest = name.partition("_")
    return name if not found or rest.startswith("{") else rf"{stem}_{{\mathrm{{{rest}}}}}"
