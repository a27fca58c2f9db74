"""Traces of the stages that a scene's shaders run: one row for each statement of each vertex or fragment."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np

from core.lanes.nodes import Declare, Name
from core.lanes.notes import LaneStep
from core.lanes.run import Watch
from core.records.arrays import Flags, Integers
from core.records.listing import ShaderListing
from core.records.operation import Columns, Operation
from core.shaders.glsl_types import GlslValue
from core.shaders.lane_steps import words_of
from core.shaders.scopes import typed_name
from core.shaders.shader import Shader, walk
from core.shaders.steps import Recorder, stored_name
from core.trace.stage_trace import Explanation, StageTrace, Value

LANE_STEP_LIMIT = 4_000_000
"""Statements times lanes of a stage that is traced: each is a row, or waits in one."""


_VECTOR = re.compile(r"(?<![\w)\]])\[([^\[\]]*)\]")
"""The numbers of a vector in brackets, which are no index."""


def _line_labels(columns: Columns, rows: Any) -> Any:
    return columns["line"][rows].astype(str)


STATEMENT: dict[str, tuple[Operation, ...]] = {
    "statement": (Operation("run", _line_labels, ("result",), ("live", "lanes")),)
}


@lru_cache(maxsize=8)
def shader_listing(source: str, stage: str) -> ShaderListing:
    """Return a shader's source as a listing whose labels are its lines."""
    lines = source.rstrip("\n").splitlines()
    labels = {str(number): number for number in range(1, len(lines) + 1)}
    return ShaderListing(
        shader_listing, "\n".join(lines), labels, f"The {stage} shader of the scene.", f"{stage} shader"
    )


@dataclass(frozen=True, eq=False)
class LaneRows:
    """Statements of N lanes, one lane after the other: R rows."""

    lane: Integers
    """(R,) int64, the lane's number, 0 to N - 1."""
    step: Integers
    """(R,) int64, its statement among those of its lane, from 0."""
    line: Integers
    """(R,) int64."""
    live: Integers
    """(R,) int64, how many lanes run the statement together."""
    result: Any
    """(R, 4) float64: what it stored, tested or returned; NaN beyond its components."""
    lanes: Integers
    """(R,) int64, how many lanes there are."""
    stored: Mapping[str, tuple[Integers, Any]]
    """Variable as typed to rows that give it a value, and its components (rows, n)."""
    undefined: Flags
    """(R,) bool, the value has a component that is not a number."""


def record_rows(lane_count: int, lanes: Integers, run: Callable[[Watch], object], shader: Shader) -> LaneRows:
    """Run a shader on L lanes together, and return the rows of some ``lanes`` (N,) of them.

    Raises ValueError where these are too many to step.
    """
    recorder = Recorder(lane_count)
    run(recorder)
    prelude = {node.place for node in shader.syntax.prelude if isinstance(node, Declare)}
    steps = [step for step in recorder.steps if step.node.place not in prelude]
    if len(steps) * max(len(lanes), 1) > LANE_STEP_LIMIT:
        raise ValueError(
            f"{len(steps):,} statements of {len(lanes):,} lanes are too many to step: trace one triangle, or a region"
        )
    live = np.array([step.live[lanes] for step in steps]).reshape(len(steps), len(lanes))
    lane, number = np.nonzero(live.T)
    begins = np.searchsorted(lane, np.arange(len(lanes)))
    counts = np.array([int(step.live.sum()) for step in steps], np.int64)
    result = np.full((len(lane), 4), np.nan)
    undefined = np.zeros(len(lane), bool)
    stored: dict[str, list[tuple[Integers, Any]]] = {}
    for k, step in enumerate(steps):
        rows = np.flatnonzero(number == k)
        values = _components(step.value, lanes[lane[rows]])
        if values is not None:
            result[rows, : values.shape[1]] = values[:, :4]
            undefined[rows] = np.isnan(values).any(axis=1)
            for name in filter(None, (stored_name(step.node),)):
                whole = _components(step.whole if step.whole is not None else step.value, lanes[lane[rows]])
                if whole is not None:
                    stored.setdefault(typed_name(name), []).append((rows, whole))
    lines = np.array([step.line for step in steps], np.int64)
    return LaneRows(
        lane,
        np.arange(len(lane)) - begins[lane],
        lines[number] if len(lines) else np.zeros(0, np.int64),
        counts[number] if len(counts) else np.zeros(0, np.int64),
        result,
        np.full(len(lane), lane_count),
        {name: join_rows(parts) for name, parts in stored.items()},
        undefined,
    )


def join_rows(parts: list[tuple[Integers, Any]]) -> tuple[Integers, Any]:
    """Join rows (R,) of a variable, and its components (R, n), in their order."""
    width = min(values.shape[1] for _, values in parts)
    rows = np.concatenate([of for of, _ in parts])
    values = np.concatenate([found[:, :width] for _, found in parts])
    order = np.argsort(rows, kind="stable")
    return rows[order], values[order]


def _components(value: Any, lanes: Integers) -> Any:
    """Return the components (N, n) of a value in some lanes; ``None`` of a matrix, a sampler, or nothing."""
    if value is None:
        return None
    parts = value.parts if isinstance(value, GlslValue) else (value,)
    if isinstance(value, GlslValue) and (value.of.startswith(("mat", "sampler")) or not parts):
        return None
    columns = [np.asarray(part) if np.ndim(part) == 0 else np.asarray(part)[lanes] for part in parts]
    return np.stack([np.broadcast_to(column, len(lanes)) for column in columns], axis=1).astype(float)


@dataclass(frozen=True, eq=False)
class ShaderStageTrace(StageTrace):
    """A stage that runs a shader: the variables of a row are those of the shader, and its words its own line."""

    lane_rows: LaneRows | None = None
    steps_of: Callable[[int], tuple[LaneStep, ...]] | None = field(default=None)
    """The steps of a lane, run again."""
    names: frozenset[str] = frozenset()
    """Own names of the variables that occur in the shader."""

    def step_at(self, row: int) -> LaneStep | None:
        """Return the step of a row; ``None`` of rows that run no statement."""
        if self.steps_of is None or self.kind_of(row) != "statement":
            return None
        found = self.steps_of(int(self.columns["lane"][row]))
        return found[int(self.columns["lane_step"][row])]

    def _done(self, row: int, values: Mapping[str, Value], operation: int) -> Explanation:
        """Explain a statement by its own line and variables."""
        step = self.step_at(row)
        if step is None:
            return super()._done(row, values, operation)
        explanation = super()._done(row, values, operation)
        held = _shown_variables(step.after, self.names)
        before = {
            f"{name} before": value for name, value in _shown_variables(step.before, self.names).items()
        }
        changed = tuple(map(typed_name, filter(None, (stored_name(step.statement),))))
        said = _sentence(step, int(self.columns["live"][row]), int(self.columns["lanes"][row]))
        return Explanation(
            key=explanation.key,
            values={**values, **before, **held, "said": said},
            known=(*explanation.known, *held),
            changed=changed,
            listing=explanation.listing,
            line=explanation.line,
        )


def _sentence(step: LaneStep, live: int, lanes: int) -> str:
    words = words_of(step)
    while (changed := _VECTOR.sub(r"(\1)", words)) != words:
        words = changed
    together = "" if lanes <= 1 or live == lanes else f"; {live:,} of {lanes:,} lanes run this line"
    return f"Line {step.line}: {words}{together}."


def _shown_variables(names: Mapping[str, Any], occurring: frozenset[str]) -> dict[str, Any]:
    """Return variables by the names that were typed; of several with one name the innermost, which came last."""
    found: dict[str, Any] = {}
    for name, value in names.items():
        if value is None or name not in occurring:
            continue
        found[typed_name(name)] = np.array(value, float).T if isinstance(value, list) else value
    return found


def occurring_names(shader: Shader) -> frozenset[str]:
    """Return the own names of the variables that a shader reads or stores."""
    nodes = [node for function in shader.syntax.functions.values() for node in walk(function)]
    nodes += [node for statement in shader.syntax.prelude for node in walk(statement)]
    found = {node.name for node in nodes if isinstance(node, Name)}
    return frozenset(found | {node.name for node in nodes if isinstance(node, Declare)})


def remembered(steps_of: Callable[[int], tuple[LaneStep, ...]]) -> Callable[[int], tuple[LaneStep, ...]]:
    """Return the same, which keeps the lanes that were asked for last."""
    return lru_cache(maxsize=8)(steps_of)
