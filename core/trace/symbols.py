"""One name for one thing: the symbols of formulas, which conditions and exported files use for a trace's columns too.

A symbol that holds for an element of a column ends in its number, as ``a0`` for ``a[0]``. The names of the columns
themselves stay known to conditions.
"""

import re

import numpy as np

from core.raster.lines.traits import minor_name
from core.trace.stage_trace import StageTrace, Value

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
