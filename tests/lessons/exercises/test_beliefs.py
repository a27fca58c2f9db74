"""Beliefs: each is among the choices, and choosing it is answered by a sentence and a step that refute it."""

import pytest

from core import trace
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import Template, ask, judge

ALL = [template for name, template in TEMPLATES.items() if name.startswith("belief-")]


def refuted(template: Template, seed: int) -> None:
    """Choose the beliefs of a question, and look at the step that refutes them."""
    question = ask(template, seed)
    draft = question.draft
    assert draft.refutations
    for belief, refutation in draft.refutations.items():
        judgement = judge(question, belief)
        assert judgement.points == 0
        assert judgement.sentences == [refutation.sentence]
        position = refutation.position()
        assert position <= trace(refutation.scene, refutation.settings).stage(refutation.stage).steps.count
    assert judge(question, draft.answer.reference).refutation is None
    guesses = set(map(frozenset, ({k} for k in range(len(draft.answer.options)))))
    assert guesses - {draft.answer.reference} - set(draft.refutations), "a choice that is neither"


def test_there_are_26_of_them_in_the_catalogue() -> None:
    assert len({template.name for template in ALL}) == 26
    assert all(TEMPLATES[template.name] is template for template in ALL)


@pytest.mark.parametrize("template", ALL, ids=lambda template: template.name)
def test_a_belief_is_refuted_by_a_step(template: Template) -> None:
    refuted(template, 0)


@pytest.mark.slow
@pytest.mark.parametrize("template", ALL, ids=lambda template: template.name)
def test_a_belief_is_refuted_at_many_seeds(template: Template) -> None:
    for seed in range(1, 60):
        refuted(template, seed)


def test_a_step_that_nothing_meets_is_an_error() -> None:
    refutation = next(iter(ask(TEMPLATES["belief-tie"], 0).draft.refutations.values()))
    assert refutation.position() > 0
    with pytest.raises(ValueError, match="no step of raster meets x < -9"):
        type(refutation)("", refutation.scene, "raster", "x < -9").position()
