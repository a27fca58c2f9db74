"""Reasons are sentences that a student can read: names of the field, plain numbers, nothing of the code."""

import re
from collections.abc import Sequence

import pytest

from core.methods import table
from core.study import Tolerance, plan
from core.study.accuracy.workloads import sphere_scene
from core.study.planner.choices.costs import LectureOrder
from core.study.planner.choices.surface_choice import DEPTHS, FEWER, ORDERS
from core.study.planner.choices.value_choice import FILTERS, INTERPOLATIONS, SHADINGS
from core.study.planner.corpus import corpus_scene
from core.study.planner.planning import STAGES
from core.study.planner.words.phrases import PHRASES, bound, counted, figure, listed

CHOICES = {
    "cull": ("back",),
    "clipping": ("homogeneous",),
    "interpolation": INTERPOLATIONS,
    "texture_filter": FILTERS,
    "shading": SHADINGS,
    "visibility": ORDERS,
    "depth": DEPTHS,
    "blend": ("opaque",),
    "antialiasing": FEWER,
}
CODED = sorted({name for family in STAGES for name in table.names(family) if "-" in name})
"""Names of methods that are no words."""


@pytest.mark.parametrize("seed", range(0, 70, 3))
def test_reasons_are_sentences(seed: int) -> None:
    for tolerance in (Tolerance(), Tolerance(8, 40), Tolerance.exact()):
        for decision in plan(corpus_scene(seed)[1], tolerance, costs=LectureOrder()).decisions:
            reason = decision.reason
            assert re.fullmatch(r"[A-Z].*\.", reason), reason
            assert not any(name in reason.split() for name in CODED), reason
            assert "e+" not in reason, reason
            assert "  " not in reason, reason
            assert "255/255 off" not in reason, reason


def test_what_was_chosen_is_told_with_its_bound_or_that_it_is_none() -> None:
    chosen = plan(sphere_scene(24, 96), Tolerance(8), costs=LectureOrder())
    for decision in chosen.decisions:
        if decision.setting in ("interpolation", "shading") and decision.chosen != decision.dearest:
            assert bound(decision.predicted_error) in decision.reason or "no difference" in decision.reason
    assert chosen.decisions[2].setting == "interpolation"
    assert chosen.decisions[2].chosen == "affine"


@pytest.mark.parametrize("family", STAGES)
def test_every_method_that_may_be_chosen_has_a_name_for_sentences(family: str) -> None:
    assert set(CHOICES[family]) <= set(PHRASES[family]) <= set(table.names(family))


@pytest.mark.parametrize(
    ("value", "text"),
    [(5186.0, "5,190"), (0.8234, "0.823"), (0.00002, "0.001"), (12.0, "12"), (0.0, "0"), (1e6, "1,000,000")],
)
def test_numbers_have_no_exponents(value: float, text: str) -> None:
    assert figure(value) == text


@pytest.mark.parametrize(
    ("parts", "text"), [(["a"], "a"), (["a", "b"], "a and b"), (["a", "b", "c"], "a, b and c")]
)
def test_lists_are_joined_as_in_a_sentence(parts: Sequence[str], text: str) -> None:
    assert listed(parts) == text
    assert [counted(count, "pixel") for count in (1, 1200)] == ["1 pixel", "1,200 pixels"]
