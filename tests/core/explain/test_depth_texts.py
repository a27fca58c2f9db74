"""Every depth method says what its buffer holds: unit, cleared value, and which of two numbers is nearer."""

from dataclasses import replace

import numpy as np
import pytest

from core.explain.stage_texts import NEARNESS, depth_text
from core.explain.steps import formula
from core.methods import table
from core.trace.stage_trace import Explanation


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


def test_a_failed_test_keeps_its_inequality_when_it_stores_nothing() -> None:
    compare = compared(0.5, 0.25)
    earlier = (replace(compare, key="depth.test.depth"), replace(compare, key="depth.test.compare"))
    made = replace(compare, key="depth.test.write", earlier=earlier)
    assert formula(made) == formula(compare)
