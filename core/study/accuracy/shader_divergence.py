"""Where two shaders part ways, or a shader and the built-in shading: the pixel, and the first variable that differs.

Two sources have other lines, so statements are compared by what they store: the k-th value of a variable in one shader
with the k-th value of the variable of that name in the other one.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Flags, Integers
from core.shaders.scopes import typed_name
from core.shaders.steps import stored_name
from core.study.accuracy.divergence import Divergence
from core.trace import StageTrace
from core.trace.shader_rows import ShaderStageTrace

CLOSE = 2e-5
"""Colours of a shader and of the built-in shading that differ by no more are alike: float32 and float64 round apart."""


def runs_shader(stage: StageTrace) -> bool:
    """Return whether the rows of a stage are statements of a shader."""
    return "statement" in stage.steps.kinds


def shader_divergence(first: StageTrace, second: StageTrace) -> Divergence | None:
    """Find where two traces of Transform or Shade come to other results, one of which, or both, run a shader.

    In Shade the first fragment whose colour differs, in Transform the first vertex. The rows are those of the first
    variable that differs there, which ``variable`` names; else they are the last ones of the fragment or vertex.
    """
    lanes = [_lanes(stage) for stage in (first, second)]
    if first.stage == "transform":
        return _first_vertex(first, second, lanes)
    keys = [_keys(stage, rows) for stage, rows in zip((first, second), lanes, strict=True)]
    _, at_ours, at_theirs = np.intersect1d(keys[0], keys[1], return_indices=True)
    ours, theirs = lanes[0][at_ours], lanes[1][at_theirs]
    close = 0.0 if runs_shader(first) and runs_shader(second) else CLOSE
    differs = _differ(first.columns["color"][ours], second.columns["color"][theirs], close)
    candidates: list[tuple[int | None, int | None]] = [
        *zip(ours[differs].tolist(), theirs[differs].tolist(), strict=True),
        *((int(row), None) for row in lanes[0][~np.isin(keys[0], keys[1])][:1]),
        *((None, int(row)) for row in lanes[1][~np.isin(keys[1], keys[0])][:1]),
    ]
    if not candidates:
        return None
    rows = min(candidates, key=lambda rows: next(row for row in rows if row is not None))
    return _refined(first, second, rows, ("color",) if None not in rows else ())


def _lanes(stage: StageTrace) -> Integers:
    """Return the last row (L,) of each lane, in their order."""
    if not runs_shader(stage):
        ends = stage.steps.group_ends
        return ends[ends > 0] - 1 if stage.stage == "transform" else np.arange(stage.steps.row_count)
    lane = stage.extra["corners"] if stage.stage == "transform" else stage.columns["lane"]
    _, before_end = np.unique(lane[::-1], return_index=True)
    return len(lane) - 1 - before_end


def _keys(stage: StageTrace, rows: Integers) -> Integers:
    """Return one number (R,) for triangle and pixel of rows."""
    side = 1 << 16
    keys: Integers = (stage.triangle[rows] * side + stage.pixel[rows, 1]) * side + stage.pixel[rows, 0]
    return keys


def _differ(ours: NDArray[Any], theirs: NDArray[Any], close: float) -> Flags:
    same = np.isclose(ours, theirs, rtol=0, atol=close, equal_nan=True)
    return cast(Flags, ~same.all(axis=tuple(range(1, same.ndim))))


def _first_vertex(first: StageTrace, second: StageTrace, lanes: list[Integers]) -> Divergence | None:
    """Find the first corner whose variables, or place in the window, differ."""
    count = min(map(len, lanes))
    both = runs_shader(first) and runs_shader(second)
    ours, theirs = (rows[:count] for rows in lanes)
    moved = _differ(first.columns["after"][ours], second.columns["after"][theirs], 0.0 if both else CLOSE)
    for corner in range(count) if both else np.flatnonzero(moved):
        rows = int(ours[corner]), int(theirs[corner])
        found = _refined(first, second, rows, ("after",) if moved[corner] else ())
        if found.names:
            return found
    return None


def _refined(
    first: StageTrace, second: StageTrace, rows: tuple[int | None, int | None], names: tuple[str, ...]
) -> Divergence:
    """Return the divergence of a fragment or vertex by a row of each, from its first variable that differs on."""
    variable, lines = "", (0, 0)
    row, other = rows
    values: tuple[dict[str, Any], dict[str, Any]] = (
        {} if row is None else first.variables(row),
        {} if other is None else second.variables(other),
    )
    if row is not None and other is not None and runs_shader(first) and runs_shader(second):
        theirs = {key: (at, line, value) for key, at, line, value in _stored(second, other)}
        for key, at, line, value in _stored(first, row):
            if key in theirs and repr(theirs[key][2]) != repr(value):
                variable, lines, rows = key[0], (line, theirs[key][1]), (at, theirs[key][0])
                values, names = ({variable: value}, {variable: theirs[key][2]}), (variable,)
                break
    holder, place = (first, row) if row is not None else (second, other)
    assert place is not None
    column, line = (int(number) for number in holder.pixel[place])
    pixel = None if column < 0 else (column, line)
    triangle = int(holder.triangle[place])
    return Divergence(first.stage, rows, triangle, pixel, names, values, variable, lines)


def _stored(stage: StageTrace, row: int) -> Iterator[tuple[tuple[str, int], int, int, Any]]:
    """Yield what the lane of a row stores: variable and which value of it that is, the row, the line, the value."""
    assert isinstance(stage, ShaderStageTrace)
    assert stage.steps_of is not None
    corners = stage.extra.get("corners")
    lane = int(stage.columns["lane"][row] if corners is None else corners[row])
    rows = np.flatnonzero(stage.columns["lane"] == lane)
    rows, steps = rows[np.argsort(stage.columns["lane_step"][rows])], stage.steps_of(lane)
    counts: Counter[str] = Counter()
    for k in _as_they_end([step.depth for step in steps]):
        if own := stored_name(steps[k].statement):
            name = typed_name(own)
            counts[name] += 1
            yield (name, counts[name]), int(rows[k]), steps[k].line, steps[k].after.get(own)


def _as_they_end(depths: Sequence[int]) -> Iterator[int]:
    """Yield the numbers of steps as they end: one that calls a function ends behind the steps of the call."""
    begun: list[int] = []
    for number, depth in enumerate(depths):
        while begun and depths[begun[-1]] >= depth:
            yield begun.pop()
        begun.append(number)
    yield from reversed(begun)
