"""A trial of shaders off the GUI thread: they are read, stepped and drawn before the document takes them over."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.session.document import Document
from app.session.tracing import trace_now
from core import Trace, render
from core.records.arrays import Singles
from core.records.words import joined
from core.scene import Scene
from core.shaders.record import ShaderProgram

TRIAL_SECONDS = 3.0
"""Seconds that stepping and drawing may take before what was typed is taken over."""
RECOGNISED = (96, 72)
"""Largest size, in pixels, of a picture that is compared with those of the mistakes."""

Make = Callable[[], ShaderProgram]
"""Reads shaders; raises ValueError where they cannot be read."""


@dataclass(frozen=True, eq=False)
class Tried:
    """Shaders that have run."""

    beside: Document
    """What was open when they were tried."""
    document: Document
    """The same with these shaders."""
    trace: Trace
    said: str
    """What is said of them: a mistake of the shelf that makes their picture, and notes."""


def try_shaders(beside: Document, stage: str, make: Make, is_cancelled: Callable[[], bool]) -> Tried:
    """Read shaders, step them as far as a stage, and draw both pictures of the scene by them.

    Raises ValueError (`core.shaders.record.ShaderProblem` with a place) where they cannot be read, do not end, or are
    too many to step.
    """
    from core.lanes.run import bounded

    assert isinstance(beside.scene, Scene)
    with bounded(TRIAL_SECONDS, is_cancelled):
        program = make()
        document = replace(beside, scene=replace(beside.scene, program=program))
        trace = trace_now(document, stage)
        if document.traced_scene is not document.scene:
            render(document.scene, document.settings)
    said = _accepted(document, program, [*_unset(trace, stage)], is_cancelled)
    return Tried(beside, document, trace, said)


def _unset(trace: Trace, stage: str) -> Iterator[str]:
    """Yield what is said of the first statement of the stage that reads a variable without a value."""
    traced = trace.stage(stage)
    rows = np.flatnonzero(traced.extra.get("unset", ()))
    if not len(rows):
        return
    row = int(rows[0])
    explanation = traced.explain(traced.steps.position_after(row))
    assert explanation is not None
    assert explanation.step is not None
    line, what = explanation.step.line, "vertices" if stage == "transform" else "fragments"
    same = rows[traced.columns["line"][rows] == line]
    count = len(np.unique(traced.columns["lane"][same]))
    names = joined(explanation.step.unset)
    yield f"Line {line} reads {names} before it has a value, for {count:,} {what}. Here it is 0, GLSL leaves it open."


def _accepted(
    document: Document,
    program: ShaderProgram,
    unset: Sequence[str],
    is_cancelled: Callable[[], bool],
) -> str:
    """Return what is said of shaders that run."""
    from core.lanes.problem import Problem
    from core.lanes.run import bounded
    from lessons.shader_mistakes import recognised

    assert isinstance(document.scene, Scene)
    width, height = document.scene.size
    scale = min(1.0, RECOGNISED[0] / width, RECOGNISED[1] / height)
    small = (max(round(scale * width), 1), max(round(scale * height), 1))
    scene = replace(document.scene, size=small)
    try:
        with bounded(TRIAL_SECONDS, is_cancelled):
            mistake = recognised(program, replace(scene, program=None), document.settings)
            if mistake is not None and mistake.wrong not in getattr(program, mistake.stage):
                # Pictures of one colour are alike whatever made them.
                mistake = None if _is_plain(render(scene, document.settings).color) else mistake
    except Problem:
        mistake = None  # A mistake takes too long to draw: none is named.
    said = f"Both shaders run. {mistake.says}" if mistake is not None else ""
    said = said or ("Both shaders run." if unset else "")
    return " ".join(filter(None, (said, notes_of(program), *unset)))


def _is_plain(picture: Singles) -> bool:
    """Return whether a picture (H, W, 4) has one colour."""
    return bool((picture == picture[0, 0]).all())


def notes_of(program: ShaderProgram) -> str:
    """Return what is worth a sentence although both shaders run."""
    return " ".join(note for shader in program.shaders for note in shader.notes)
