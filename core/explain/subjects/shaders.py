"""Statements of shaders: each is told by its own line, which the trace has put into words."""

from core.explain.rows import Said, explains
from core.explain.step_values import StepValues


@explains("transform.statement.run")
def vertex_statement(step: StepValues) -> Said:
    """A statement of the vertex shader."""
    return str(step.explanation.values["said"])


@explains("shade.statement.run")
def fragment_statement(step: StepValues) -> Said:
    """A statement of the fragment shader."""
    return str(step.explanation.values["said"])
