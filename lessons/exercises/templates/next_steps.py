"""What comes next: the questions of Predict, asked of a run that is drawn from a seed."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from core import Settings, trace
from core.explain.number_text import DIGITS, exact_text, number_text
from core.explain.records import Value, Variable
from core.explain.steps import variables
from core.trace import StageTrace
from lessons.exercises.answers.answer import Answer
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.drawn_scene import window_text
from lessons.exercises.draws import Draws, NoQuestionError, reject
from lessons.exercises.next_step import row_draft
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.drafting import listed
from lessons.small_scenes import triangle_scene

SIZE = (12, 9)
SETTINGS = Settings(fill="bounding-box")
ROW_LIMIT = 40
"""Most rows that are tried to find one that is asked about."""
HIDDEN = ("column", "row", "number")
"""Variables that the question names by itself."""
HINTS = {
    "transform": (
        "Which space does the step lead to?",
        "A divide is by w; the viewport maps [-1, 1] to W and H.",
        "From {position before} the divide gives x/w and y/w, the viewport (x + 1)/2 * {W} and (y + 1)/2 * {H}.",
    ),
    "edges": (
        "The edge function is a x + b y + c.",
        "a is how much it changes from one pixel to the next.",
        "E is 0 at the edge's start {edge start} and at its end {edge end}: a x + b y + c is 0 with both.",
    ),
    "raster": (
        "Which side of each edge is the centre (i + 1/2, j + 1/2) on?",
        "All three edges must agree.",
        "E0 = {a0} * {x} + {b0} * {y} + {c0}; E1 and E2 likewise.",
    ),
    "interpolate": (
        "Put the centre into the three edge functions.",
        "A weight is its value over their sum.",
        "E0 = {a0} * {x} + {b0} * {y} + {c0}, E1 and E2 likewise; λk = Ek / (E0 + E1 + E2).",
    ),
    "depth": (
        "Compare the depth of the fragment with the depth in the buffer.",
        "Smaller is nearer, and a tie keeps what is there.",
        "Is {z new} smaller than what the buffer holds?",
    ),
}
"""By the stages that are asked about; the last one with variables of the step."""
RULES = {
    "transform": "NDC x and y run from -1 to 1; y points up.",
    "edges": "Edge k lies opposite to corner k; every E is made positive inside of the triangle.",
    "raster": "Inside all three E = a x + b y + c are positive; where E is 0, the edge decides: does it own ties?",
    "interpolate": "Edge k lies opposite to corner k, with E = a x + b y + c; all w are 1.",
    "depth": "Smaller is nearer, and a tie keeps what is there.",
}
"""What decides, by stage."""


def _corners(draws: Draws) -> list[tuple[int, int]]:
    return [(draws.whole(0, 11), draws.whole(0, 8)) for _ in range(3)]


def _text(value: Value) -> str:
    if isinstance(value, tuple):
        return f"({', '.join(map(number_text, value))})"
    return str(value) if value is None or isinstance(value, str | bool) else number_text(value)


def step_variables(stage: StageTrace, row: int) -> Sequence[Variable]:
    """Return the variables of a row; all that its first operation is the first to show count as changed."""
    explanation = stage.explain(int(stage.steps.starts[row]) + 1)
    if explanation is None:
        return ()
    first = stage.steps.operations[stage.kind_of(row)][0]
    return variables(replace(explanation, changed=first.shows))


def known_text(shown: Sequence[Variable]) -> str:
    """Return what is known before a row."""
    known = [one for one in shown if not one.is_changed() and one.name not in HIDDEN]
    return "\n".join(f"{one.name} = {_text(one.now)}" for one in known)


def hints_with(hints: Sequence[str], shown: Sequence[Variable]) -> tuple[str, ...]:
    """Return hints with the variables that they name, what is negative in brackets."""
    texts = {
        one.name: exact_text(one.now, one.digits.get(one.now, DIGITS))
        if isinstance(one.now, float)
        else _text(one.now)
        for one in shown
    }
    named = {name: f"({text})" if text.startswith("−") else text for name, text in texts.items()}
    return tuple(hint.format_map(named) for hint in hints)


def is_shown(answer: Answer, shown: Sequence[Variable]) -> bool:
    """Return whether a number that is asked for is a coordinate before the step."""
    before = next(one.now for one in shown if one.name == "position before")
    assert isinstance(before, tuple)
    return any(answer.is_same((float(coordinate),), answer.reference) for coordinate in before)


def draw_step(stage_name: str, draws: Draws) -> Draft:
    """A step of a run with two triangles."""
    corners = [_corners(draws), _corners(draws)]
    depths = [[draws.whole(1, 9) / 10 for _ in range(3)] for _ in corners]
    reject(min(abs(np.linalg.det(np.diff(np.array(one, float), axis=0))) for one in corners) < 12)
    # With w = 1 the divide would change nothing, and its result would stand in the question.
    w = [[draws.item((2, 4, 5)) for _ in range(3)] for _ in corners] if stage_name == "transform" else 1.0
    scene = triangle_scene(corners, SIZE, depth=depths, w=w)
    stage = trace(scene, SETTINGS).stage(stage_name)
    rows = (draws.whole(0, stage.steps.row_count - 1) for _ in range(ROW_LIMIT))
    asked = ((row, draft) for row in rows if (draft := row_draft(stage, row)) is not None)
    row, draft = next(asked, (-1, None))
    if draft is None:
        raise NoQuestionError(f"nothing is asked about {ROW_LIMIT} rows")
    # Nothing is there yet: every fragment passes.
    reject(isinstance(draft.answer, ChoiceAnswer) and stage_name == "depth" and "holds 1 " in draft.text)
    shown_variables = step_variables(stage, row)
    reject(stage_name == "transform" and is_shown(draft.answer, shown_variables))
    places = listed("Triangle {k}: {}, depth {}", corners, depths)
    # Where the corners lie in the window is what the transform finds.
    shown = [window_text(SIZE), *([] if stage_name == "transform" else [places])]
    given = "\n".join([RULES[stage_name], *shown, "Before the step:", known_text(shown_variables)])
    return Draft(
        draft.text,
        given,
        draft.answer,
        hints_with(HINTS[stage_name], shown_variables),
        {},
        None if stage_name == "transform" else scene,
        SETTINGS,
        draft.pixel,
        draft.reveal,
    )


for _stage in HINTS:
    _version = 1 + (_stage == "transform")
    template(f"next-{_stage}", _version, f"What comes next: {_stage}", _stage, 1)(partial(draw_step, _stage))
