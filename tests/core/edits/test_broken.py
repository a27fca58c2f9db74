"""Mistakes in typing: each is told at its line, in a sentence that says what is wrong and mostly what to write."""

import re

import pytest

from core import Settings, render
from core.edits.edit import Edit, apply_edit, original
from core.lanes.problem import Problem
from lessons.scenes import make_scene
from tests.texts import cases_of

OF = {
    "line": "bresenham-lecture",
    "fill": "bounding-box",
    "fill_rule": "shared-edge",
    "depth_test": "z-float32",
    "interpolation": "perspective",
    "blend": "over",
}
PYTHONS_OWN = re.compile(
    r"invalid syntax|Error|Traceback|unexpected|EOF|None|object|ndarray|numpy", re.IGNORECASE
)
"""Words that no beginner should have to understand."""

BROKEN = cases_of(__file__, "broken.txt")
"""Part, what stands there, what is typed, and the line and the sentence that are told."""


def draw(part: str, text: str) -> None:
    """Apply an edit, and draw a scene with it."""
    settings = apply_edit(Settings(), Edit(part, OF[part], text))
    render(make_scene("segment" if part == "line" else "shared-edge"), settings)


@pytest.mark.parametrize(("part", "old", "new", "line", "sentence"), BROKEN)
def test_a_broken_edit_is_told_at_its_line(part, old, new, line, sentence):
    text = original(part, OF[part]).source.replace(old, new, 1)
    with pytest.raises(Problem) as caught:
        draw(part, text)
    problem = caught.value
    assert (problem.line, problem.sentence) == (int(line), sentence)
    assert 1 <= problem.column <= len(text.splitlines()[problem.line - 1]) + 1
    assert str(problem) == f"line {line}, column {problem.column}: {sentence}"
    assert not PYTHONS_OWN.search(sentence)
