"""The runs behind questions: each faulty run can be stepped beside the right one, up to their first difference."""

from dataclasses import replace

import pytest

from app.pages.exercises.answers import document_of
from app.pages.exercises.evidence import faulty_picture, faulty_run, is_pictured, is_stepped, refuting_step
from core.study.divergence import diverge
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import Question, ask, judge


def compare(question: Question, mistake: str) -> None:
    """Trace both runs, and search for where they differ."""
    request = faulty_run(question, mistake)
    assert request.other is not None
    assert request.other_scene is not None
    opened = replace(question.draft, scene=request.opening.scene, settings=request.opening.settings)
    document = document_of(opened, "")
    other = replace(document, settings=request.other, scene=request.other_scene)
    diverge(document.make_trace(), other.make_trace(), by_outcome=True)


@pytest.mark.parametrize(
    "name", ["cyrus-beck-verdict", "z-buffer-grid", "tree-order", "sorted-behind-the-eye", "octree-entries"]
)
def test_runs_that_are_hard_to_compare(name: str) -> None:
    """One had no listing to be stepped in, one enters the pipeline behind the raster; others ask without a scene."""
    question = next(
        found
        for found in (ask(TEMPLATES[name], seed) for seed in range(20))
        if any(is_stepped(found, mistake) for mistake in found.draft.mistakes)
    )
    for mistake in question.draft.mistakes:
        compare(question, mistake)


@pytest.mark.slow
@pytest.mark.parametrize("name", TEMPLATES)
def test_every_mistake_can_be_shown(name: str) -> None:
    question = ask(TEMPLATES[name], 7)
    for mistake in question.draft.mistakes:
        if is_stepped(question, mistake):
            compare(question, mistake)
        elif is_pictured(question, mistake):
            assert faulty_picture(question, mistake).picture is not None
    if question.draft.answer.kind == "choice":
        for place in range(len(question.draft.answer.options)):
            refutation = judge(question, frozenset({place})).refutation
            if refutation is not None:
                assert refuting_step(refutation, "").position
