"""Runs of a listing with a note for every labelled line: what it was when, and which value it gave its variable."""

import ast
from collections.abc import Callable
from functools import cache
from math import nan
from typing import Any

from core.records.listing import source_listing
from core.records.python_text import read_statements

Note = tuple[str, Any]
"""A label, and the value that its line gave a variable; ``None``: it gave none."""
Sums = tuple[float, float, float]
"""Of one pixel: the sum that decides before it, after it was corrected, and after it was advanced; NaN: it was not."""
_ADVANCED = ("first-sum", "advance", "advance-step", "evaluate")


class _Noting(ast.NodeTransformer):
    """Puts a note behind each labelled assignment and each drawn pixel."""

    def __init__(self, labels: dict[int, str]) -> None:
        self.labels = labels

    def visit_Assign(self, node: ast.Assign) -> list[ast.stmt]:
        return self._noted(node, node.targets[0])

    def visit_AugAssign(self, node: ast.AugAssign) -> list[ast.stmt]:
        return self._noted(node, node.target)

    def visit_Expr(self, node: ast.Expr) -> list[ast.stmt]:
        return self._noted(node, ast.Constant(None))

    def _noted(self, node: ast.stmt, target: ast.expr) -> list[ast.stmt]:
        label = self.labels.get(node.lineno)
        if label is None:
            return [node]
        note = read_statements(f"_notes.append(({label!r}, {ast.unparse(target)}))").body[0]
        return [node, note]


@cache
def _noting(function: Callable[..., Any]) -> Any:
    """Return the code of a function that appends to a list ``_notes``."""
    shown = source_listing(function)
    labels = {number: label for label, number in shown.lines.items()}
    tree = _Noting(labels).visit(read_statements(shown.source))
    return compile(ast.fix_missing_locations(tree), "<listing>", "exec")


def recorded(function: Callable[..., Any], *arguments: Any) -> tuple[Any, list[Sums]]:
    """Run a listing of a line.

    Returns
    -------
    result
        What it returns.
    sums : list of Sums
        Of every pixel that it draws.
    """
    notes: list[Note] = []
    names = {**function.__globals__, "_notes": notes}
    exec(_noting(function), names)
    result = names[function.__name__](*arguments)
    found, held = [], nan
    before, corrected, advanced = nan, nan, nan
    for label, value in notes:
        if label == "draw":
            found.append((before, corrected, advanced))
            before, corrected, advanced = held, nan, nan
        elif label == "correct":
            held = corrected = float(value)
        elif label in _ADVANCED:
            held = advanced = float(value)
    return result, found
