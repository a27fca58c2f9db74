"""Practice asks what was missed and what is long ago, and progress counts it."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest

from lessons.attempts.practice import Choice, first_tries, misses_in_a_row, next_question, progress, recall
from lessons.attempts.record import Attempt, attempt_of
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.numbers import reject
from lessons.exercises.question import Question, Template, ask, judge

NOW = datetime(2026, 11, 23, 12, tzinfo=UTC)
PAIR = ("corner-for-center", "all-edges-inclusive")
SOME = {name: TEMPLATES[name] for name in ("triangle-coverage", "facing", "perspective-u")}


def answered(question: Question, mistakes: Sequence[str] | None, ago: timedelta) -> Attempt:
    """Return an attempt: right, or wrong by mistakes that may be none."""
    right = question.draft.answer.reference
    attempt = attempt_of("me", question, right, judge(question, right), 20, NOW - ago)
    if mistakes is None:
        return attempt
    return attempt.model_copy(update={"score": 0.25, "points": 1.0, "mistakes": tuple(mistakes)})


def chosen(attempts: Sequence[Attempt], templates=SOME, now: datetime = NOW, user: str = "me") -> Choice:
    return next_question(attempts, templates, user, now)


def test_new_ones_come_in_order_and_the_same_for_the_same_user() -> None:
    attempts: list[Attempt] = []
    for name in SOME:
        choice = chosen(attempts)
        assert (choice.question.template.name, choice.reason) == (name, "This one is new.")
        assert chosen(attempts).question.mark == choice.question.mark
        assert chosen(attempts, user="Ada").question.seed != choice.question.seed
        attempts.append(answered(choice.question, None, timedelta(minutes=2)))
    assert chosen(attempts).reason == "Nothing is due yet: this one is due first."
    later = chosen(attempts, now=NOW + timedelta(minutes=10))
    assert later.reason == "It was asked some time ago: do you still know it?"
    assert next_question([], {}, "me", NOW) is None


def test_what_is_most_forgotten_comes_first() -> None:
    first, second, third = (ask(template, 1) for template in SOME.values())
    attempts = [
        answered(second, None, timedelta(days=200)),
        answered(third, None, timedelta(days=190)),
        answered(third, None, timedelta(days=180)),
        answered(first, None, timedelta(days=1)),
    ]
    known = recall(attempts, NOW)
    assert known["facing"][0] < known["perspective-u"][0] < known["triangle-coverage"][0]
    assert chosen(attempts).question.template.name == "facing"


def test_at_most_one_in_three_questions_of_a_day_repeats() -> None:
    """Three templates that are never mastered, as on the day before, do not crowd out the others."""
    hard = list(TEMPLATES)[:3]
    attempts = [answered(ask(TEMPLATES[name], 1), (), timedelta(days=1)) for name in hard]
    repeated = 0
    for number in range(100):
        now = NOW + timedelta(minutes=number)
        choice = chosen(attempts, TEMPLATES, now)
        name = choice.question.template.name
        before = [attempt for attempt in attempts if attempt.template == name]
        repeated += bool(before) and (before[-1].score < 1 or before[-1].at.date() == NOW.date())
        assert 3 * repeated <= number + 1
        attempts.append(answered(choice.question, () if name in hard else None, NOW - now))
    asked = Counter(attempt.template for attempt in attempts[3:])
    assert repeated > 2
    # The misses of yesterday count: the third in a row is explained, and it is another day's question.
    assert [asked[name] for name in hard] == [2, 2, 2]


def test_a_third_miss_in_a_row_is_explained_and_not_asked_again_today() -> None:
    attempts = [
        answered(ask(SOME["triangle-coverage"], seed), (), timedelta(minutes=30 - 10 * seed))
        for seed in range(3)
    ]
    assert misses_in_a_row(attempts) == {"triangle-coverage": 3}
    choice = chosen(attempts)
    assert (choice.explained, choice.question.template.name) == (attempts[-1], "facing")
    assert chosen(attempts[:2]).explained is None
    right = [*attempts, answered(ask(SOME["triangle-coverage"], 3), None, timedelta(0))]
    assert misses_in_a_row(right) == {"triangle-coverage": 0}
    tomorrow = chosen(attempts, {"triangle-coverage": SOME["triangle-coverage"]}, NOW + timedelta(days=1))
    assert (tomorrow.explained, tomorrow.question.template.name) == (None, "triangle-coverage")


def test_what_is_dated_later_than_now_does_not_count() -> None:
    late = answered(ask(SOME["triangle-coverage"], 1), (), -timedelta(days=365 * 73))
    assert chosen([late]).reason == "This one is new."


@pytest.mark.parametrize("seed", [1, 2])
def test_the_next_variant_tells_two_mistakes_apart(seed: int) -> None:
    before = [
        answered(ask(SOME[name], 1), None, timedelta(minutes=5)) for name in ("facing", "perspective-u")
    ]
    missed = answered(ask(SOME["triangle-coverage"], seed), PAIR, timedelta(0))
    choice = chosen([*before, missed])
    draft = choice.question.draft
    names = " and ".join(PAIR)
    assert choice.reason == f"An answer of today can come from {names}: this question tells them apart."
    assert not draft.answer.is_same(*(draft.mistakes[name] for name in PAIR))
    assert choice.question.seed != seed
    alike = answered(ask(SOME["perspective-u"], seed), sorted(*SOME["perspective-u"].alike), timedelta(0))
    known = [answered(ask(SOME[name], 1), None, timedelta(minutes=5)) for name in list(SOME)[:2]]
    assert chosen([*known, alike]).reason == "A new variant of what was missed today."


def test_a_template_that_cannot_draw_is_passed_over() -> None:
    broken = Template("broken", 1, "Broken", "raster", 1, lambda draws: reject(True))
    assert chosen([], {"broken": broken} | SOME).question.template.name == "triangle-coverage"
    assert next_question([], {"broken": broken}, "me", NOW) is None


def test_a_correction_with_the_marks_in_sight_does_not_count() -> None:
    question = ask(SOME["triangle-coverage"], 1)
    attempts = [answered(question, (), timedelta(minutes=5)), answered(question, None, timedelta(minutes=4))]
    assert misses_in_a_row(first_tries(attempts)) == {"triangle-coverage": 1}
    assert (progress(attempts).points, progress(attempts).tried) == (1.0, {"triangle-coverage": 1})
    later = answered(question, None, -timedelta(minutes=7))
    assert progress([*attempts, later]).points == question.template.points


def test_a_fixed_question_does_not_come_again_at_once() -> None:
    fixed = replace(SOME["facing"], is_fixed=True)
    templates = {"facing": fixed, "perspective-u": SOME["perspective-u"]}
    missed = answered(ask(SOME["facing"], 1), (), timedelta(minutes=2))
    assert chosen([missed], templates).question.template.name == "perspective-u"
    other = answered(ask(SOME["perspective-u"], 1), None, timedelta(minutes=1))
    later = chosen([missed, other], templates, NOW + timedelta(minutes=10))
    assert later.question.template.name == "facing"


def test_points_never_fall_and_mistakes_are_counted() -> None:
    question = ask(SOME["triangle-coverage"], 1)
    attempts = [
        answered(question, PAIR[:1] if number < 3 else None, timedelta(9 - number)) for number in range(9)
    ]
    attempts.append(answered(question, (), timedelta(0)))
    reached = progress(attempts)
    (count,) = [each for each in reached.mistakes if each.mistake == PAIR[0]]
    assert (count.stage, count.made, count.asked) == ("raster", 3, 10)
    assert reached.points == reached.best["triangle-coverage"] == question.template.points
    assert (reached.correct, reached.tried) == ({"triangle-coverage": 6}, {"triangle-coverage": 10})
    points = [progress(attempts[:number]).points for number in range(11)]
    assert points == sorted(points)
