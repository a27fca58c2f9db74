"""Every depth method says what its buffer holds: unit, cleared value, and which of two numbers is nearer."""

from dataclasses import replace

import numpy as np
import pytest

from core.explain import formula, sentence
from core.explain.history.sentences import link_sentence
from core.explain.stage_texts import NEARNESS, depth_text
from core.explain.step_values import StepValues
from core.explain.subjects.depth import passes
from core.methods import table
from core.pixel_history.records import Link
from core.trace import Explanation


@pytest.mark.parametrize("name", table.names("depth"))
def test_the_text_is_that_of_the_format(name: str) -> None:
    kept, text = table.get("depth", name).function(), depth_text("depth", name)
    assert text.description.endswith("larger is nearer." if kept.larger_is_nearer else "smaller is nearer.")
    assert bool(text.unit) == (kept.scale != 1)
    assert ("float32" in text.description) == (kept.scale == 1)
    if kept.scale in (65535.0, 16777215.0):
        assert f"1/{int(kept.scale):,}" in text.description
    assert kept.is_nearer(np.array([0.5]) * kept.scale, np.array([kept.cleared])).all()


def test_only_buffers_of_depths_have_one() -> None:
    assert depth_text("nearness", "z-24") is NEARNESS
    assert depth_text("primitive", "z-24") is None


def compared(stored: float, before: float, **constants: float) -> Explanation:
    """Return the depth test of a fragment that fails."""
    values = {"column": 5, "row": 6, "depth": 0.8857, "stored": stored, "before": before, "after": before}
    values |= {"passes": False, "larger_is_nearer": False, "quantity": "z", **constants}
    return Explanation("depth.test.compare", values, (), (), None, 0)  # type: ignore[arg-type]


def test_depths_in_whole_numbers_are_told_apart_by_one_step() -> None:
    made = compared(14860001.0, 14860000.0, scale=16777215.0)
    asked = passes(StepValues(made, 3))
    assert asked.text == "The buffer holds 14860000 at pixel (5, 6). Does 14860001 pass?"
    assert "14860001, is larger than the buffer's 14860000 (1 step apart)" in sentence(made, 3, (5, 6))
    assert "14860001 & > & 14860000" in formula(made).substituted


def test_neighbours_in_float32_are_told_apart() -> None:
    near = float(np.float32(0.88571429))
    far = float(np.nextafter(np.float32(near), np.float32(1)))
    said = sentence(compared(far, near), 3, (5, 6))
    assert "0.8857144, is larger than the buffer's 0.8857143" in said
    assert "(1 unit in the last place of float32 apart)" in said
    values = {"stored": far, "before": near, "against": 2, "scale": 1.0}
    assert link_sentence(Link("depth", "failed", values)) == (
        "Failed the depth test: 0.8857144 is not nearer than triangle 2 (0.8857143), "
        "1 unit in the last place of float32 apart."
    )


def test_a_failed_test_keeps_its_inequality_when_it_stores_nothing() -> None:
    compare = compared(0.5, 0.25)
    earlier = (replace(compare, key="depth.test.depth"), replace(compare, key="depth.test.compare"))
    made = replace(compare, key="depth.test.write", earlier=earlier)
    assert formula(made) == formula(compare)
