"""Where two settings, or two shaders, first part ways on one scene: the stage, the row in drawing order, the pixel.

Where both traces list the same rows (the same triangles, pixels and kinds in the same order), rows are compared as
they stand. Where the schedules differ, as two fills look at pixels in different orders, only what comes of each pixel
of each triangle is compared: covered or not, its values, its colour, its depth. Two methods that do the same in another
order do not part ways.

Two sources have other lines, so statements are compared by what they store: the k-th value of a variable in one shader
with the k-th value of the variable of that name in the other one.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Flags, Integers
from core.scene import AnyScene
from core.settings import Settings
from core.shaders.glsl_types import typed_name
from core.shaders.lane_steps import stored_name
from core.shaders.traced import ShaderStageTrace
from core.stages.declared import STAGES, stage_of
from core.stages.fragment_color import has_program
from core.trace import Trace, trace
from core.trace.stage_trace import StageTrace, Value

# Where two settings first part ways on one scene: the stage, the row in drawing order, and the numbers that
# differ.


NAMES = ("primitive", "segment", "node")
"""Columns that are numbers of records, not values."""


@dataclass(frozen=True, eq=False)
class Divergence:
    """The first place at which two traces differ."""

    stage: str
    """A name of ``core.records.frame.STAGES``."""
    rows: tuple[int | None, int | None]
    """Row of each trace; ``None``: that trace has no row for it."""
    triangle: int
    """Number in the scene; -1: it is about no triangle."""
    pixel: tuple[int, int] | None
    """Column and row; ``None``: it is about no pixel."""
    names: tuple[str, ...]
    """Columns that differ; empty where one of the traces has no row."""
    values: tuple[Mapping[str, Value], Mapping[str, Value]]
    """All variables of each row; empty where there is none."""
    variable: str = ""
    """The variable of two shaders that differs first, whose values are in ``values``; empty: none does."""
    lines: tuple[int, int] = (0, 0)
    """The lines, from 1, that store it."""


def first_divergence(
    scene: AnyScene,
    first: Settings,
    second: Settings,
    *,
    triangle: int | None = None,
    region: tuple[int, int, int, int] | None = None,
) -> Divergence | None:
    """Find the first stage and row at which two settings differ on a scene; ``None``: they never do.

    Parameters
    ----------
    triangle, region : optional
        Trace only this triangle, or this part of the picture, see `core.trace.trace`.
    """
    return diverge(
        trace(scene, first, triangle, region, "cleared"), trace(scene, second, triangle, region, "cleared")
    )


def diverge(
    first: Trace, second: Trace, by_outcome: bool = False, since: str = STAGES[0]
) -> Divergence | None:
    """Find the first place at which two traces differ, from a stage on and at last in those before it.

    ``by_outcome``: as `stage_divergence`.
    """
    start = STAGES.index(since)
    stages = (*STAGES[start:], *STAGES[:start])
    if by_outcome and has_one_shader(first, second):
        # Behind these stages all numbers differ, by rounding.
        stages = tuple(stage for stage in stages if stage in ("transform", "shade"))
    for stage in stages:
        found = stage_divergence(first.stage(stage), second.stage(stage), by_outcome)
        if found is not None:
            return found
    return None


def has_one_shader(first: Trace, second: Trace) -> bool:
    """Return whether the scene of one trace has shaders, which compute in float32, and that of the other has none."""
    return has_program(first.source.scene) != has_program(second.source.scene)


def stage_divergence(first: StageTrace, second: StageTrace, by_outcome: bool = False) -> Divergence | None:
    """Find the first row at which two traces of one stage differ.

    ``by_outcome``: in what comes of a pixel, where the stage is about pixels, and not in numbers on the way there.
    """
    if by_outcome and any("statement" in stage.steps.kinds for stage in (first, second)):
        return shader_divergence(first, second)
    if is_same_schedule(first, second):
        outcomes = stage_of(first.stage).outcomes if by_outcome else ()
        # A scene that enters the pipeline later has no columns in the stages before.
        names = tuple(name for name in outcomes if name in first.columns) or tuple(
            name for name in first.columns if name in second.columns and name not in NAMES
        )
        differs = _differing(first, second, names, np.arange(first.steps.row_count), None)
        rows = np.flatnonzero(differs.any(axis=0))
        if not len(rows):
            return None
        row = int(rows[0])
        return _at_rows(first, second, row, row, names)
    stage = stage_of(first.stage)
    if stage.is_schedule:
        return None
    if stage.outcomes:
        return _pixel_divergence(first, second, stage.outcomes)
    return _triangle_divergence(first, second)


def is_same_schedule(first: StageTrace, second: StageTrace) -> bool:
    """Return whether two traces have rows of the same kinds about the same triangles and pixels, in the same order."""
    if first.steps.row_count != second.steps.row_count:
        return False
    kinds = [np.array(each.steps.kinds)[each.steps.kind] for each in (first, second)]
    return bool(
        (kinds[0] == kinds[1]).all()
        and (first.triangle == second.triangle).all()
        and (first.pixel == second.pixel).all()
    )


def _differing(
    first: StageTrace, second: StageTrace, names: tuple[str, ...], rows: Integers, others: Integers | None
) -> Flags:
    """Return (N, R) bool: where each of the N columns differs between ``rows`` and ``others`` (R,)."""
    others = rows if others is None else others
    found = np.zeros((len(names), len(rows)), bool)
    for number, name in enumerate(names):
        ours, theirs = first.columns[name][rows], second.columns[name][others]
        found[number] = (
            _differs(ours, theirs).any(axis=tuple(range(1, ours.ndim)))
            if ours.shape == theirs.shape
            else True
        )
    return found


def _differs(ours: NDArray[np.generic], theirs: NDArray[np.generic]) -> Flags:
    """Return where two arrays of one shape differ; two NaN are alike."""
    differs = np.asarray(ours != theirs)
    if ours.dtype.kind == "f" and theirs.dtype.kind == "f":
        differs &= ~(np.isnan(ours.astype(float)) & np.isnan(theirs.astype(float)))
    return differs


def _at_rows(
    first: StageTrace, second: StageTrace, row: int | None, other: int | None, names: tuple[str, ...]
) -> Divergence:
    """Return the divergence at one row of each trace, or of one of them."""
    holder, place = (first, row) if row is not None else (second, other)
    assert place is not None
    column, line = (int(number) for number in holder.pixel[place])
    differing: tuple[str, ...] = ()
    if row is not None and other is not None:
        differs = _differing(first, second, names, np.array([row]), np.array([other]))[:, 0]
        differing = tuple(name for name, is_other in zip(names, differs, strict=True) if is_other)
    return Divergence(
        stage=first.stage,
        rows=(row, other),
        triangle=int(holder.triangle[place]),
        pixel=None if column < 0 else (column, line),
        names=differing,
        values=(
            {} if row is None else first.variables(row),
            {} if other is None else second.variables(other),
        ),
    )


def _pixel_divergence(first: StageTrace, second: StageTrace, names: tuple[str, ...]) -> Divergence | None:
    """Compare what came of every pixel of every triangle, whatever the order and whatever else was looked at."""
    ours, our_rows = _outcome_rows(first)
    theirs, their_rows = _outcome_rows(second)
    candidates: list[tuple[int, int | None, int | None]] = []
    _, at_ours, at_theirs = np.intersect1d(ours, theirs, return_indices=True)
    both = our_rows[at_ours], their_rows[at_theirs]
    differs = _differing(first, second, names, *both).any(axis=0)
    if differs.any():
        place = int(np.flatnonzero(differs)[np.argmin(both[0][differs])])
        candidates.append((int(both[0][place]), int(both[0][place]), int(both[1][place])))
    only_ours, only_theirs = our_rows[~np.isin(ours, theirs)], their_rows[~np.isin(theirs, ours)]
    if len(only_ours):
        candidates.append((int(only_ours.min()), int(only_ours.min()), None))
    if len(only_theirs):
        candidates.append((int(only_theirs.min()), None, int(only_theirs.min())))
    if not candidates:
        return None
    _, row, other = min(candidates, key=lambda candidate: candidate[0])
    if row is None or other is None:
        row, other = _with_uncovered(first, second, row, other)
    return _at_rows(first, second, row, other, names)


def _outcome_rows(stage: StageTrace) -> tuple[Integers, Integers]:
    """Return keys (R,) of triangle and pixel, rising, and the last row (R,) of each that came to something."""
    counts = stage.pixel[:, 0] >= 0
    if "covered" in stage.columns:
        counts = counts & stage.columns["covered"].astype(bool)
    rows = np.flatnonzero(counts)[::-1]
    keys, last = np.unique(_keys(stage)[rows], return_index=True)
    return keys, rows[last]


def _keys(stage: StageTrace) -> Integers:
    """Return one number (R,) for triangle, row and column of every row."""
    side = 1 << 16
    return (stage.triangle.astype(np.int64) * side + stage.pixel[:, 1]) * side + stage.pixel[:, 0]


def _with_uncovered(
    first: StageTrace, second: StageTrace, row: int | None, other: int | None
) -> tuple[int | None, int | None]:
    """Find the row at which the other trace looked at the pixel and decided against it, if it looked."""
    if row is not None:
        found = np.flatnonzero(_keys(second) == _keys(first)[row])
        return row, int(found[0]) if len(found) else None
    assert other is not None
    found = np.flatnonzero(_keys(first) == _keys(second)[other])
    return (int(found[0]) if len(found) else None), other


def _triangle_divergence(first: StageTrace, second: StageTrace) -> Divergence | None:
    """Compare the rows of every triangle, in turn, of stages that are about no pixels."""
    seen = list(dict.fromkeys([*first.triangle.tolist(), *second.triangle.tolist()]))
    names = tuple(name for name in first.columns if name in second.columns and name not in NAMES)
    for number in seen:
        ours, theirs = (np.flatnonzero(each.triangle == number) for each in (first, second))
        common = min(len(ours), len(theirs))
        differs = _differing(first, second, names, ours[:common], theirs[:common]).any(axis=0)
        if differs.any():
            place = int(np.argmax(differs))
            return _at_rows(first, second, int(ours[place]), int(theirs[place]), names)
        if len(ours) != len(theirs):
            row = int(ours[common]) if len(ours) > common else None
            other = int(theirs[common]) if len(theirs) > common else None
            return _at_rows(first, second, row, other, names)
    return None


# Where two shaders part ways, or a shader and the built-in shading: the pixel, and the first variable that
# differs.


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
    keys = [_keys_of_steps(stage, rows) for stage, rows in zip((first, second), lanes, strict=True)]
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


def _keys_of_steps(stage: StageTrace, rows: Integers) -> Integers:
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
