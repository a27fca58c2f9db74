"""Attempts of another file are judged again where that is possible, and marked where it is not."""

from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import get_args

import pytest

from lessons.attempts.imports import judged_again, responses_of
from lessons.attempts.practice import progress
from lessons.attempts.record import Attempt, attempt_of
from lessons.attempts.store import FILE_NAME, AttemptFile
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.numbers import Draws
from lessons.exercises.question import ask, judge
from lessons.exercises.record import AnswerPart
from tests.covering import is_everything
from tests.lessons.exercises.first_questions import first_question

NOW = datetime(2026, 11, 23, 12, tzinfo=UTC)


def made(name: str = "triangle-coverage", seed: int = 7, mistake: str = "") -> Attempt:
    question = ask(TEMPLATES[name], seed)
    response = question.draft.mistakes[mistake] if mistake else question.draft.answer.reference
    return attempt_of("me", question, response, judge(question, response), 9, NOW - timedelta(days=1))


def test_every_answer_can_be_read_again_from_its_text() -> None:
    kinds = set()
    for template in TEMPLATES.values():
        question = first_question(template.name)
        answer = question.draft.answer
        if answer.kind in kinds and not is_everything():
            continue
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


def test_an_attempt_kept_unchecked_is_judged_by_a_later_import(tmp_path: Path) -> None:
    wrong = made(mistake="y-down")
    sent = wrong.model_copy(update={"score": 1.0, "points": 4.0, "mistakes": ()})
    file = AttemptFile(tmp_path / FILE_NAME)
    assert file.add_all(judged_again([sent], {}, NOW).attempts) == 1
    (kept,) = file.attempts()
    assert not kept.is_checked
    # The exercise is known by now; what has been judged is never overwritten.
    assert file.add_all(judged_again([sent], TEMPLATES, NOW).attempts) == 1
    assert file.attempts() == (wrong,)
    assert file.add_all(judged_again([sent], {}, NOW).attempts) == 0
    assert file.attempts() == (wrong,)
