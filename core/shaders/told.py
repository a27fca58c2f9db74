"""Statements of shaders: each is told by its own line, with its numbers, in words and as a formula."""

import re
from dataclasses import replace

import numpy as np

from core.explain.formulas import formula_of
from core.explain.listed_code import stated
from core.explain.records import Formula
from core.explain.step_values import Said, StepValues, explains
from core.records.steps import Level
from core.records.words import joined
from core.trace.stage_trace import StageTrace

LONGEST_CELL = 60
"""Signs of a cell with its numbers: beyond them vectors keep their names."""
_VECTOR = re.compile(r"(?<![\w)\]])\[([^\[\]]*)\]")
"""The numbers of a vector in brackets, which are no index."""


@explains("transform.statement.run")
def vertex_statement(step: StepValues) -> Said:
    """A statement of the vertex shader."""
    return _told(step, "vertices")


@explains("shade.statement.run")
def fragment_statement(step: StepValues) -> Said:
    """A statement of the fragment shader."""
    return _told(step, "fragments")


def statements_summary(trace: StageTrace, first: int, row: int, level: Level) -> str:
    """Say what a step did that is larger than one row of a shader: its rows are from ``first`` to ``row``."""
    rows = first + np.flatnonzero(trace.steps.kind[first : row + 1] == trace.steps.kinds.index("statement"))
    what = ("vertex", "vertices") if trace.stage == "transform" else ("fragment", "fragments")
    triangles = np.unique(trace.triangle[first : row + 1])
    who = f"Triangle {triangles[0]}" if len(triangles) == 1 else "All triangles"
    if level == Level.STAGE:
        who = "Whole stage"
    if not len(rows):
        return f"{who}: a {what[0]} is divided by w and goes to the window."
    lanes = len(np.unique(trace.columns["lane"][rows]))
    numbers = np.unique(trace.columns["lane_number"][rows])
    if level == Level.GROUP and len(numbers) == 1 and lanes > 1:
        line, live, of_triangle = (int(trace.columns[name][rows[0]]) for name in ("line", "live", "lanes"))
        code = trace.listings["statement"].source.splitlines()[line - 1].strip()
        count = f"{live:,} of {of_triangle:,} {what[1]}"
        return f"Line {line} runs for {count} of triangle {triangles[0]} together: {code}"
    counts = f"{len(rows):,} statements of {lanes:,} {what[lanes != 1]}"
    return f"{who}: {counts}."


def _told(values: StepValues, what: str) -> Said:
    """Return what a statement did, and how many of a triangle's lanes did it together."""
    from core.shaders.lane_steps import words_of  # Wanted by few: it takes the evaluator.

    step = values.explanation.step
    assert step is not None
    words = words_of(step)
    while (changed := _VECTOR.sub(r"(\1)", words)) != words:
        words = changed
    live, lanes = (int(values.explanation.values[name]) for name in ("live", "lanes"))
    together = "" if live == lanes else f"; {live:,} of {lanes:,} {what} run this line"
    unset = (
        f" {joined(step.unset)}: read before it has a value. GLSL leaves it open, here it is 0."
        if step.unset
        else ""
    )
    said, made = f"Line {step.line}: {words}{together}.{unset}", _formula(values)
    return said if made is None else (said, made)


def _formula(values: StepValues) -> Formula | None:
    """Return the formula of a statement that computes something other than a matrix."""
    from core.shaders.lane_steps import computed, without_vectors

    step = values.explanation.step
    assert step is not None
    found = computed(step)
    if found is None:
        return None
    made = formula_of(stated(found, step.kind, None))
    if max(map(_length, made.substituted.split("&"))) > LONGEST_CELL:
        made = formula_of(stated(replace(found, right=without_vectors(found.right)), step.kind, None))
    return made


def _length(cell: str) -> int:
    """Return about how many signs a cell has once it is typeset."""
    return len(re.sub(r"\\[A-Za-z]+|[{}\\ ]", "", cell))
