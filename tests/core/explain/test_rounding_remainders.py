"""A number that only rounding keeps from 0 is said to be 0 up to rounding; numbers that decide are never said so."""

import re
from collections.abc import Iterator

import pytest

from core import STAGES, Settings, trace
from core.explain.number_text import remainder_note
from core.explain.steps import sentence
from core.trace.stage_trace import StageTrace
from lessons.lectures.scenes import ALL_SCENES
from tests.core.explain.explained_steps import places_of, step_at

TINY = re.compile(r"e−1[4-9]\b")
"""A size that sums of numbers around 1 leave of a 0."""


def said(stage: StageTrace, operation: str) -> Iterator[str]:
    """Yield the sentences of all steps of an operation."""
    for row in range(stage.steps.row_count):
        names = [done.name for done in stage.steps.operations[stage.kind_of(row)]]
        if operation in names:
            explanation = stage.explain(int(stage.steps.starts[row]) + 1 + names.index(operation))
            assert explanation is not None
            column, line = stage.pixel[row].tolist()
            yield sentence(explanation, int(stage.triangle[row]), (column, line))


@pytest.mark.parametrize(
    ("scene", "stage", "operation", "settings"),
    [
        ("fan", "interpolate", "weights", {}),
        ("fan", "interpolate", "weights", {"interpolation": "affine-distances"}),
        ("jubair-backfaces", "cull", "normal", {"cull": "back-normal"}),
        ("single-triangle", "blend", "source", {"blend": "over"}),
        ("zwicker-perspective", "interpolate", "weights", {"interpolation": "affine-distances"}),
    ],
)
def test_a_remainder_is_said_to_be_one(scene, stage, operation, settings) -> None:
    texts = said(trace(ALL_SCENES[scene].make(), Settings(**settings)).stage(stage), operation)
    text = next(text for text in texts if TINY.search(text))
    assert "up to rounding" in text
    assert not re.search(r"is below 0|alpha is 1,", text)


def test_what_decides_is_never_a_remainder() -> None:
    # 64 e-15 pixels of area decide in the exact format as 64 pixels do.
    for name in ("shared-edge", "jubair-cyrus-beck"):
        traced = trace(ALL_SCENES[name].make(), Settings(coverage="exact"))
        for place in places_of(traced):
            if place[1].stage not in STAGES[: STAGES.index("interpolate")]:
                continue
            explanation, triangle, pixel = step_at(place)
            assert "up to rounding" not in sentence(explanation, triangle, pixel)
    assert remainder_note([1e-12, 1.0]) == remainder_note([1e-16]) == remainder_note([0.0, 5.0]) == ""
    assert "1" in remainder_note([1e-16, 1.0])
