"""Attempts of another file are judged again where that is possible, and marked where it is not."""

from datetime import UTC, datetime, timedelta
from typing import get_args

import pytest

from lessons.attempts.imports import judged_again, responses_of
from lessons.attempts.practice import progress
from lessons.attempts.record import Attempt, attempt_of
from lessons.exercises.answer_parts import AnswerPart
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.draws import Draws
from lessons.exercises.question import ask, judge

NOW = datetime(2026, 11, 23, 12, tzinfo=UTC)


def made(name: str = "triangle-coverage", seed: int = 7, mistake: str = "") -> Attempt:
    question = ask(TEMPLATES[name], seed)
    response = question.draft.mistakes[mistake] if mistake else question.draft.answer.reference
    return attempt_of("me", question, response, judge(question, response), 9, NOW - timedelta(days=1))


def test_every_answer_can_be_read_again_from_its_text() -> None:
    kinds = set()
    for template in TEMPLATES.values():
        question = ask(template, 3)
        answer = question.draft.answer
        kinds.add(answer.kind)
        guess = [] if answer.kind in ("steps", "pixels") else [answer.random(Draws(5))]
        for response in (answer.reference, *question.draft.mistakes.values(), *guess):
            scores = [
                judge(question, one).verdict.score for one in responses_of(question, answer.text(response))
            ]
            assert judge(question, response).verdict.score in scores, (template.name, answer.text(response))
    parts = get_args(AnswerPart)
    assert kinds == {get_args(part.model_fields["type"].annotation)[0] for part in parts}, (
        "a type of answer that no exercise has is not tested"
    )


def test_honest_attempts_stay_as_they_are() -> None:
    given = [made(), made(mistake="y-down"), made("bresenham-steps", 3), made("weight-steps", 3)]
    imported = judged_again(given, TEMPLATES, NOW)
    assert imported.attempts == tuple(given)
    assert imported.sentences == ("4 answers judged again.",)


def test_a_forged_attempt_is_judged_again_and_told() -> None:
    wrong = made(mistake="y-down")
    forged = wrong.model_copy(update={"score": 1.0, "points": 500.0, "most": 500, "mistakes": ()})
    imported = judged_again([forged], TEMPLATES, NOW)
    assert imported.attempts == (wrong,)
    assert imported.sentences == (
        "1 answer judged again, 1 with another result.",
        "1 answer had more points than there are.",
    )


@pytest.mark.parametrize(
    "changes",
    [
        {"template": "of-a-teacher"},
        {"version": 99},
        {"answer": "no such answer"},
        {"template": "ask/nothing"},
    ],
)
def test_what_cannot_be_judged_is_kept_and_marked(changes: dict[str, object]) -> None:
    given = made().model_copy(
        update={**changes, "points": 500.0, "at": datetime(2099, 1, 1, tzinfo=UTC), "verdict": "13 right"}
    )
    imported = judged_again([given], TEMPLATES, NOW)
    (kept,) = imported.attempts
    assert (kept.is_checked, kept.verdict, kept.points) == (False, "not checked: 13 right", given.most)
    assert imported.sentences == (
        f"1 answer not checked: exercise, version or answer is not known ({given.template}).",
        "1 answer had more points than there are.",
        "1 answer dated later than now.",
    )
    reached = progress([made("facing", 1), kept])
    assert reached.points_text == f"{reached.points:.3g} points, {given.most:.3g} of them not checked"
    assert judged_again([kept], TEMPLATES, NOW).attempts == (kept,)
