"""Traces of the stages that a scene's shaders run: one row for each statement of each vertex or fragment."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np

from core.lanes.nodes import Block, Declare, Discard, Name, Nothing, Statement
from core.lanes.program import LaneStep
from core.lanes.run import Watch
from core.records.arrays import Flags, Integers, cached_property
from core.records.listing import Columns, Operation, ShaderListing
from core.shaders.glsl_types import GlslValue, typed_name
from core.shaders.lane_steps import Recorder, stored_name
from core.shaders.parser import walk
from core.shaders.shader import Shader
from core.trace.stage_trace import Explanation, StageTrace, Value

LANE_STEP_LIMIT = 4_000_000
"""Statements times lanes of a stage that is traced: each is a row, or waits in one."""


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
    number: Integers
    """(R,) int64, its statement among those of all lanes: lanes with the same number run it together."""
    line: Integers
    """(R,) int64."""
    result: Any
    """(R, 4) float64: what it stored, tested or returned; NaN beyond its components."""
    stored: Mapping[str, tuple[Integers, Any]]
    """Variable as typed to rows that give it a value, and its components (rows, n)."""
    undefined: Flags
    """(R,) bool, the value has a component that is not a number."""
    discards: Flags
    """(R,) bool, the lane is discarded."""
    unset: Flags
    """(R,) bool, the lane reads a variable before it has a value."""

    def ordered(self, order: Integers) -> "LaneRows":
        """Return the rows in another order (R,)."""
        back = np.empty(len(order), np.int64)
        back[order] = np.arange(len(order))
        arrays = {name: getattr(self, name)[order] for name in _ARRAYS}
        stored = {name: join_rows([(back[at], values)]) for name, (at, values) in self.stored.items()}
        return LaneRows(stored=stored, **arrays)


_ARRAYS = ("lane", "step", "number", "line", "result", "undefined", "discards", "unset")
"""Arrays (R, ...) of `LaneRows`."""


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
    result = np.full((len(lane), 4), np.nan)
    undefined, unset = np.zeros(len(lane), bool), np.zeros(len(lane), bool)
    stored: dict[str, list[tuple[Integers, Any]]] = {}
    by_number = np.argsort(number, kind="stable")
    ends = np.searchsorted(number[by_number], np.arange(len(steps) + 1))
    for k, step in enumerate(steps):
        rows = by_number[ends[k] : ends[k + 1]]
        for _, reading in step.unset:
            unset[rows] |= reading[lanes[lane[rows]]]
        values = _components(step.value, lanes[lane[rows]])
        if values is not None:
            result[rows, : values.shape[1]] = values[:, :4]
            undefined[rows] = np.isnan(values).any(axis=1)
            for name in filter(None, (stored_name(step.node),)):
                whole = _components(step.whole if step.whole is not None else step.value, lanes[lane[rows]])
                if whole is not None:
                    stored.setdefault(typed_name(name), []).append((rows, whole))
    lines = np.array([step.line for step in steps], np.int64)
    discards = np.array([isinstance(step.node, Discard) for step in steps], bool)
    return LaneRows(
        lane,
        np.arange(len(lane)) - begins[lane],
        number,
        lines[number],
        result,
        {name: join_rows(parts) for name, parts in stored.items()},
        undefined,
        discards[number],
        unset,
    )


def side_by_side(parts: Sequence[tuple[Integers, LaneRows]]) -> LaneRows:
    """Join the rows of the lanes of several meshes, lane by lane; each part has the numbers (L,) int64 of its lanes."""
    if len(parts) == 1:
        return parts[0][1]
    stored: dict[str, list[tuple[Integers, Any]]] = {}
    first = 0
    for _, rows in parts:
        for name, (of, values) in rows.stored.items():
            stored.setdefault(name, []).append((first + of, values))
        first += len(rows.lane)
    arrays = {name: np.concatenate([getattr(rows, name) for _, rows in parts]) for name in _ARRAYS}
    arrays["lane"] = np.concatenate([at[rows.lane] for at, rows in parts])
    joined = LaneRows(stored={name: join_rows(found) for name, found in stored.items()}, **arrays)
    return joined.ordered(np.argsort(joined.lane, kind="stable"))


def live_lanes(number: Integers, triangle: Integers, lanes_of: Integers) -> tuple[Integers, Integers]:
    """Return how many lanes (R,) run each row's statement together, and how many (R,) its triangle has.

    ``number`` and ``triangle`` are those of the rows (R,), ``lanes_of`` (L,) the triangle of every lane.
    """
    key = triangle * (int(number.max(initial=0)) + 1) + number
    _, place, counts = np.unique(key, return_inverse=True, return_counts=True)
    of_triangle = np.bincount(lanes_of, minlength=1)
    return counts[place.reshape(-1)], of_triangle[triangle]


def order_together(triangle: Integers, number: Integers, lane: Integers) -> Integers:
    """Return rows (R,), lane by lane, in the order in which the lanes of each triangle run together."""
    rank = np.cumsum(np.append(0, triangle[1:] != triangle[:-1])) if len(triangle) else triangle
    return np.lexsort((np.arange(len(lane)), lane, number, rank))


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
    lines: frozenset[int] = frozenset()
    """Lines (from 1) of the shader that have a statement."""

    def step_at(self, row: int) -> LaneStep | None:
        """Return the step of a row; ``None`` of rows that run no statement."""
        if self.steps_of is None or self.kind_of(row) != "statement":
            return None
        found = self.steps_of(int(self.columns["lane"][row]))
        return found[int(self.columns["lane_step"][row])]

    def _rows_of_triangle(self, row: int) -> slice:
        """Return the rows of the triangle that a row is about."""
        number = int(np.searchsorted(self.steps.triangle_ends, row, "right"))
        return slice(
            int(np.append(0, self.steps.triangle_ends)[number]), int(self.steps.triangle_ends[number])
        )

    def line_shares(self, row: int) -> Mapping[int, float]:
        """Return the lines (from 1), each with the share of its triangle's lanes that run it at some time."""
        if self.kind_of(row) != "statement":
            return {}
        of = self._rows_of_triangle(row)
        if of.start not in self._shares:
            lane, line = (self.columns[name][of] for name in ("lane", "line"))
            ran, width = line >= 0, int(lane.max()) + 1
            counts = np.bincount(np.unique(line[ran] * width + lane[ran]) // width)
            self._shares[of.start] = {
                k: float(counts[k]) / int(self.columns["lanes"][row]) if k < len(counts) else 0.0
                for k in self.lines
            }
        return self._shares[of.start]

    def waiting_at(self, row: int) -> tuple[Integers, Integers] | None:
        """Return which fragments of its triangle do not run a row's statement, both (n,).

        Those that wait or have ended, and those that were discarded; ``None`` for a row without a fragment.
        """
        if self.pixel[row, 0] < 0:
            return None
        of = self._rows_of_triangle(row)
        lane, number = (self.columns[name][of] for name in ("lane", "lane_number"))
        if of.start not in self._lanes:
            self._lanes[of.start] = np.unique(lane)
        lanes, at = self._lanes[of.start], self.columns["lane_number"][row]
        assert self.lane_rows is not None
        gone = self.lane_rows.discards[of] & (number < at)
        live, discarded = np.zeros(len(lanes), bool), np.zeros(len(lanes), bool)
        live[np.searchsorted(lanes, lane[number == at])] = True
        discarded[np.searchsorted(lanes, lane[gone])] = True
        return lanes[~live & ~discarded], lanes[discarded]

    @cached_property
    def _lanes(self) -> dict[int, Integers]:
        """First row of a triangle to its lanes (n,), rising."""
        return {}

    @cached_property
    def _shares(self) -> dict[int, Mapping[int, float]]:
        """First row of a triangle to its `line_shares`."""
        return {}

    def _live_before(self, row: int) -> int:
        """Return how many lanes ran the statement before with this row's lane."""
        of = self._rows_of_triangle(row)
        lane, step = (self.columns[name] for name in ("lane", "lane_step"))
        earlier = of.start + np.flatnonzero((lane[of] == lane[row]) & (step[of] == step[row] - 1))
        return int(self.columns["live"][earlier[0]] if len(earlier) else self.columns["lanes"][row])

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
        return Explanation(
            key=explanation.key,
            values={**values, **before, **held, "lanes earlier": self._live_before(row)},
            known=(*explanation.known, *held),
            changed=changed,
            listing=explanation.listing,
            line=explanation.line,
            step=step,
        )


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


def statement_lines(shader: Shader) -> frozenset[int]:
    """Return the lines (from 1) on which a statement of some function begins."""
    nodes = [node for function in shader.syntax.functions.values() for node in walk(function)]
    return frozenset(
        node.place.line
        for node in nodes
        if isinstance(node, Statement) and not isinstance(node, Block | Nothing)
    )


def remembered(steps_of: Callable[[int], tuple[LaneStep, ...]]) -> Callable[[int], tuple[LaneStep, ...]]:
    """Return the same, which keeps the lanes that were asked for last."""
    return lru_cache(maxsize=8)(steps_of)
