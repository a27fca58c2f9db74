"""Conditions of breakpoints: ``E0 < 0.5 and not covered``, read safely, in the symbols of formulas.

A symbol that holds for an element of a column ends in its number, as ``a0`` for ``a[0]``. The names of the columns
themselves stay known to conditions.

Only names of a trace's variables, numbers, texts in quotes, arithmetic, comparisons, and / or / not are known; where
a reader offers functions, calls of these, too. The text is parsed, never executed as Python.
"""

import ast
import operator
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from core.lines.line_method import minor_name
from core.records.arrays import Flags
from core.records.listing import read_expression
from core.trace.stage_trace import StageTrace, Value

# One name for one thing: the symbols of formulas, which conditions and exported files use for a trace's
# columns too.


OF_FILLS = {f"value_{k}": f"E{k}" for k in range(3)}
OF_LINES = {
    **{"slope": "m", "intercept": "b", "intensity": "I", "length": "L", "along": "s"},
    **{"cosine": "c", "share": "g", "fraction": "f", "line_distance": "d", "filtered": "T"},
}
"""Column of the raster stage to its symbol, where triangles are filled and where lines are drawn."""
OF_STAGES = {
    "interpolate": {"total": "n", "fraction": "t"},
    "shade": {"lod": "λ", "level": "l", "level_fraction": "f"},
    "depth": {"depth": "z", "nearness": "v", "error": "e"},
}
"""Stage to its columns that have a symbol."""
SUMS = {"bresenham-float": "e"}
"""Line method to the symbol of its sum before the decision, where that is another number."""
DECISIONS = {"bresenham": "D", "bresenham-lecture": "D", "rectangle": "a"}
"""Line method to the symbol of the number that chooses the pixel, where it has one of its own."""
OF_ELEMENTS = {"weights": "λ", "numerators": "n", "corner_w": "w"}
"""Column with a number for every corner or edge to its letter, where that is not its name."""
_NUMBERED = re.compile(r"(?P<letter>[^\W\d]+)(?P<number>\d)")


def symbols_of(trace: StageTrace) -> dict[str, str]:
    """Return the columns of a trace that have a symbol, and the symbol of each."""
    family, _, method = trace.method.partition("=")
    found = OF_STAGES.get(trace.stage, {})
    if trace.stage == "raster":
        found = OF_FILLS if family == "fill" else OF_LINES
    if family == "line":
        found = found | {"column": "x", "row": minor_name(method)}
        named = {"decision": DECISIONS.get(method), "sum_before": SUMS.get(method)}
        found = found | {column: symbol for column, symbol in named.items() if symbol}
    return {name: symbol for name, symbol in found.items() if name in trace.columns}


def column_of(name: str, trace: StageTrace) -> Value | None:
    """Return the column (R, ...) of a name or symbol, the column of an element, or a constant; ``None``: unknown."""
    if name in trace.columns:
        return trace.columns[name]
    for column, symbol in symbols_of(trace).items():
        if symbol == name:
            return trace.columns[column]
    if name == "D" and "decision" in trace.columns:
        return trace.columns["decision"]
    if name in trace.constants:
        return np.asarray(trace.constants[name])
    numbered = _NUMBERED.fullmatch(name)
    if numbered is None:
        return None
    letters = {symbol: column for column, symbol in OF_ELEMENTS.items()}
    values = trace.columns.get(letters.get(numbered["letter"], numbered["letter"]))
    if values is None or values.ndim != 2 or int(numbered["number"]) >= values.shape[1]:
        return None
    return values[:, int(numbered["number"])]


# Conditions of breakpoints: ``E0 < 0.5 and not covered``, read safely, evaluated on all rows at once.


TEXT_LIMIT = 300
"""Longest condition in characters."""

_ARITHMETIC: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Mod: operator.mod,
}
_COMPARISONS: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}
_METHOD = re.compile(r"[\w.-]+")
_WANTED = "a condition compares variables and numbers, as E0 < 0.5 and not covered"


class Names(Protocol):
    """What the names in a condition stand for, on R rows."""

    @property
    def row_count(self) -> int:
        """R."""

    def value(self, name: str) -> Any:
        """Return (R, ...) or a single value; ValueError where there is no such name."""

    def is_of_kind(self, kind: str) -> Flags:
        """Return (R,) bool, the rows of a kind; ValueError where the stage has none such."""

    def call(self, name: str, given: Sequence[ast.expr], chosen: Mapping[str, str]) -> Any:
        """Return what a function gives for checked nodes, and methods by family; ValueError where it gives none."""


@dataclass(frozen=True)
class Condition:
    """A condition that has been read; whether its names exist depends on the trace."""

    text: str
    tree: ast.expr

    def holds(self, trace: StageTrace) -> Flags:
        """Return (R,) bool, the rows that meet it.

        Raises ValueError for a name that the stage does not have, a list without an index, or a result that is no flag.
        """
        return self.holds_of(TraceNames(trace))

    def holds_of(self, names: Names) -> Flags:
        """Return (R,) bool, the rows on which it holds where the names stand for this; ValueError as `holds`."""
        with np.errstate(all="ignore"):
            found = np.asarray(evaluate(self.tree, names))
        if found.dtype != np.bool_:
            raise ValueError(f"{_WANTED}; {self.text} is not true or false")
        return np.broadcast_to(found, (names.row_count,))


@dataclass(frozen=True, eq=False)
class TraceNames:
    """The variables of a stage, on all of its rows."""

    trace: StageTrace

    @property
    def row_count(self) -> int:
        """R."""
        return self.trace.steps.row_count

    def value(self, name: str) -> Any:
        """Return a column or an element of it, a constant, ``kind`` or ``triangle``."""
        return _column(name, self.trace)

    def is_of_kind(self, kind: str) -> Flags:
        """Return the rows of a kind; those of a line's pixels include the ones to which it steps, and those beside."""
        kinds, stage = self.trace.steps.kinds, self.trace.stage
        numbers = [
            number for number, name in enumerate(kinds) if name in {kind, f"{kind}-step", f"{kind}-beside"}
        ]
        if not numbers:
            raise ValueError(f"the stage {stage} has no rows of the kind {kind}; it has {', '.join(kinds)}")
        return np.isin(self.trace.steps.kind, numbers)

    def call(self, name: str, given: Sequence[ast.expr], chosen: Mapping[str, str]) -> Any:
        """Refuse: the conditions of a trace have no functions."""
        raise ValueError(f"{_WANTED}; {name} is no function here")


def parse_condition(text: str, functions: Collection[str] = ()) -> Condition:
    """Read a condition.

    Parameters
    ----------
    text : str
        For example ``E0 < 0.5``, ``weights[2] >= 0 and covered``, ``verdict == "outside"``.
    functions : collection of str
        Names that may be called, as ``drawn(3, 4)`` or ``differs(depth="z-16")``.

    Raises
    ------
    ValueError
        With one sentence that says what is wrong.

    Examples
    --------
    >>> from core import ClipScene, trace
    >>> scene = ClipScene([[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]]], size=(2, 2))
    >>> raster = trace(scene).stage("raster")
    >>> parse_condition("covered and row == 0").holds(raster).tolist()
    [True, False, False, False]
    """
    if not text.strip():
        raise ValueError(f"{_WANTED}; this one is empty")
    if len(text) > TEXT_LIMIT:
        raise ValueError(f"a condition must be at most {TEXT_LIMIT} characters, got {len(text)}")
    try:
        tree = read_expression(text.strip())
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise ValueError(f"{_WANTED}; {text.strip()} cannot be read") from None
    _check(tree, functions)
    return Condition(text.strip(), tree)


def _check(node: ast.expr, functions: Collection[str]) -> None:
    """Refuse everything but names, numbers, texts, arithmetic, comparisons, logic and calls of ``functions``."""
    match node:
        case ast.Name():
            return
        case ast.Constant(value=bool() | int() | float() | str()):
            return
        case ast.Subscript(value=ast.Name(), slice=ast.Constant(value=int(index))) if index is not True:
            return
        case ast.UnaryOp(op=ast.USub() | ast.UAdd() | ast.Not(), operand=operand):
            return _check(operand, functions)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _ARITHMETIC:
            parts = [left, right]
        case ast.BoolOp(values=parts):
            pass
        case ast.Compare(left=left, ops=ops, comparators=others) if all(
            type(op) in _COMPARISONS for op in ops
        ):
            parts = [left, *others]
        case ast.Call(func=ast.Name(id=name), args=parts, keywords=keywords) if name in functions:
            for keyword in keywords:
                if keyword.arg is None or not _METHOD.fullmatch(spelled(keyword.value)):
                    raise ValueError(f"{_WANTED}; expected {name}(depth=z-16), got {ast.unparse(node)}")
        case _:
            raise ValueError(f"{_WANTED}; {ast.unparse(node)} is neither")
    for part in parts:
        _check(part, functions)


def spelled(node: ast.expr) -> str:
    """Return a method or a mark as it is spelled, in quotes or without: ``z-16`` reads as a difference."""
    return str(node.value) if isinstance(node, ast.Constant) else ast.unparse(node).replace(" ", "")


def evaluate(node: ast.expr, names: Names) -> Any:
    """Return the value of a checked node on all rows; ValueError as `Condition.holds`."""
    match node:
        case ast.Name(id=name):
            return _single(name, names.value(name))
        case ast.Constant(value=value):
            return np.asarray(value) if isinstance(value, bool | str) else np.asarray(value, np.float64)
        case ast.Subscript(value=ast.Name(id=name), slice=ast.Constant(value=int(index))):
            return _element(name, names.value(name), index)
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return ~_flags(operand, names)
        case ast.UnaryOp(op=op, operand=operand):
            value = _numbers(operand, names)
            return -value if isinstance(op, ast.USub) else value
        case ast.BinOp(left=left, op=op, right=right):
            return _ARITHMETIC[type(op)](_numbers(left, names), _numbers(right, names))
        case ast.BoolOp(op=op, values=parts):
            found = [_flags(part, names) for part in parts]
            return np.logical_and.reduce(found) if isinstance(op, ast.And) else np.logical_or.reduce(found)
        case (
            ast.Compare(left=ast.Name(id="kind"), ops=[op], comparators=[ast.Constant(value=str(kind))])
            | ast.Compare(left=ast.Constant(value=str(kind)), ops=[op], comparators=[ast.Name(id="kind")])
        ) if isinstance(op, ast.Eq | ast.NotEq):
            return names.is_of_kind(kind) ^ isinstance(op, ast.NotEq)
        case ast.Compare(left=left, ops=ops, comparators=others):
            values = [evaluate(part, names) for part in (left, *others)]
            pairs = zip(values, ops, values[1:], strict=False)
            return np.logical_and.reduce([_compare(first, op, second) for first, op, second in pairs])
        case ast.Call(func=ast.Name(id=name), args=parts, keywords=keywords):
            chosen = {str(each.arg): spelled(each.value) for each in keywords}
            return np.asarray(names.call(name, parts, chosen))
    raise ValueError(f"{_WANTED}; {ast.unparse(node)} is neither")


def _compare(first: Any, op: ast.cmpop, second: Any) -> Any:
    """Compare numbers with numbers, or texts for being equal."""
    is_text = [np.asarray(value).dtype.kind == "U" for value in (first, second)]
    if any(is_text) and not (all(is_text) and isinstance(op, ast.Eq | ast.NotEq)):
        raise ValueError("a text can only be equal (==) or not equal (!=) to another text")
    return _COMPARISONS[type(op)](first, second)


def _numbers(node: ast.expr, names: Names) -> Any:
    """Return numbers to calculate with; yes counts as 1."""
    value = np.asarray(evaluate(node, names))
    if value.dtype.kind not in "fiub":
        raise ValueError(f"{ast.unparse(node)} is a text and has no arithmetic")
    return value.astype(np.float64)


def _flags(node: ast.expr, names: Names) -> Any:
    """Return yes or no, to be joined by and, or, not."""
    value = np.broadcast_to(evaluate(node, names), (names.row_count,))
    if value.dtype != np.bool_:
        raise ValueError(f"{ast.unparse(node)} is not true or false; compare it with something")
    return value


def variable_names(trace: StageTrace) -> tuple[str, ...]:
    """Return the names that a condition on this stage may use."""
    symbols = symbols_of(trace)
    names = {symbols.get(name, name) for name in trace.columns} | {*trace.constants, "kind", "triangle"}
    return tuple(sorted(names, key=str.lower))


def _column(name: str, trace: StageTrace) -> Any:
    """Return a variable of all rows: a column or an element of it, a constant, ``kind`` or ``triangle``."""
    found = column_of(name, trace)
    if found is not None:
        return found
    if name == "kind":
        return np.array(trace.steps.kinds)[trace.steps.kind]
    if name == "triangle":
        return trace.triangle
    raise ValueError(
        f"the stage {trace.stage} has no variable {name}; it has {', '.join(variable_names(trace))}"
    )


def _single(name: str, values: Any) -> Any:
    if values.ndim > 1:
        shown = "x".join(map(str, values.shape[1:]))
        raise ValueError(f"{name} has {shown} numbers in a row: choose one, as {name}[0]")
    return values


def _element(name: str, values: Any, index: int) -> Any:
    """Return one number of a list of numbers."""
    if values.ndim != 2:
        raise ValueError(f"{name} is not a list of numbers, {name}[{index}] has no meaning")
    if not 0 <= index < values.shape[1]:
        raise ValueError(f"{name} has the numbers 0 to {values.shape[1] - 1}, got {name}[{index}]")
    return values[:, index]
