"""Laws of credit and feedback over all templates: named mistakes, slips, reasons, and what no question gives away."""

import re

import pytest

from lessons.exercises.answers.answer import NotCheckedError
from lessons.exercises.answers.fields import Column, NumberAnswer, TableAnswer, number_rows
from lessons.exercises.asked import RULE_NUMBERS, numbers_in, topics
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import ask, judge
from tests.covering import every_nth, is_everything
from tests.lessons.exercises.first_questions import first_question


def test_a_known_mistake_earns_at_most_half_of_a_pixel_question() -> None:
    asked = [
        question for question in map(first_question, TEMPLATES) if question.draft.answer.kind == "pixels"
    ]
    assert len(asked) > 20
    for question in asked:
        assert "a known mistake gives earns at most half" in question.draft.answer.credit
        for name, wrong in question.draft.mistakes.items():
            judgement = judge(question, wrong)
            assert name in judgement.mistakes
            assert judgement.points <= question.template.points / 2, question.mark
    # Other wrong answers keep their share.
    coverage = first_question("triangle-coverage")
    right = coverage.draft.answer.reference
    slip = judge(coverage, right | {(11, 0)})
    assert slip.verdict.score > 0.9
    assert slip.is_slip


def test_what_credit_says_never_depends_on_the_answer() -> None:
    for name, template in every_nth(TEMPLATES.items(), 3):
        if first_question(name).draft.answer.kind in ("pixels", "choice", "spot"):
            credit = first_question(name).draft.answer.credit
            assert ask(template, 2).draft.answer.credit == credit, name
            assert not any(letter.isdigit() for letter in credit), name


def test_a_wrong_choice_of_one_is_given_a_reason_and_the_right_one_is_not_marked() -> None:
    for name, question in ((name, first_question(name)) for name in TEMPLATES):
        answer = question.draft.answer
        if answer.kind != "choice" or answer.is_several:
            continue
        assert judge(question, answer.reference).sentences == []
        for k in range(len(answer.options)):
            chosen = frozenset({k})
            if chosen != answer.reference:
                judgement = judge(question, chosen)
                assert judgement.sentences, (name, answer.options[k])
                assert judgement.verdict.counts == "wrong"
                assert not judgement.verdict.marks["missing"]


def test_a_slip_is_said_in_the_words_of_its_answer() -> None:
    """`All but one is right` beside `0 of 1 right` contradicts itself."""
    for question in map(first_question, TEMPLATES):
        answer = question.draft.answer
        if isinstance(answer, NumberAnswer) and len(answer.reference) == 1:
            minus = judge(question, (-answer.reference[0],))
            assert not minus.is_slip or minus.sentences == [
                "A slip: a digit or the sign of one number is wrong."
            ]


@pytest.mark.parametrize("turn", [1, 2])
def test_weights_moved_on_by_one_vertex_earn_a_third_in_both_directions(turn: int) -> None:
    question = first_question("barycentric-weights")
    right = question.draft.answer.reference
    judgement = judge(question, (*right[turn:], *right[:turn]))
    assert judgement.points == question.template.points / 3
    assert judgement.sentences[-1] in question.draft.answer.credit


def test_stages_whose_order_pipelines_do_not_share_are_not_asked_together() -> None:
    for seed in range(60):
        options = set(ask(TEMPLATES["stage-order"], seed).draft.answer.options)
        for pair in ({"cull", "clip"}, {"shade", "depth"}, {"interpolate", "depth"}):
            assert not pair <= options


def test_each_mistake_that_a_template_knows_is_recognised_at_some_seed() -> None:
    """Also those that only some draws show; those of all draws are checked at the first seed of every template."""
    sometimes = {(name, topic.name) for topic in topics()["mistakes"] for name in topic.templates}
    always = {("place-ndc", "window-one-less"), ("vertex-pixels", "window-one-less")}
    for name, mistake in sorted(sometimes | always):
        asked = (ask(TEMPLATES[name], seed) for seed in range(30))
        assert any(
            mistake in judge(question, question.draft.mistakes[mistake]).mistakes
            if mistake in question.draft.mistakes
            else mistake.replace("-", " ") in question.draft.answer.offered
            for question in asked
        ), (name, mistake)


def test_a_decimal_comma_is_taken_alone_and_told_with_its_cell_elsewhere() -> None:
    one = NumberAnswer((0.5,), tolerance=0.01)
    assert one.read("0,5") == one.read("0.5")
    vector = NumberAnswer((0.5, 1), (2,), ("alpha", "beta"))
    with pytest.raises(NotCheckedError, match=r"^beta: expected a decimal point, as in 0\.5, got '0,5'$"):
        vector.read(["1", "0,5"])
    matrix = NumberAnswer((1, 2, 3, 4), (2, 2))
    with pytest.raises(NotCheckedError, match=r"^row 2, column 1: expected a decimal point"):
        matrix.read([["1", "2"], ["0,5", "1"]])
    table = TableAnswer((Column("D"),), ("at x = 1", "at x = 2"), number_rows([[1], [2]]))
    with pytest.raises(NotCheckedError, match=r"^D, at x = 2: expected a decimal point, as in -2\.5"):
        table.read(["1", "-2,5"])


ONE_ANSWER: dict[str, str] = {}
"""Questions of a choice or an order with one right answer at every seed, by name: why they may have it. None does."""


def test_the_right_choice_or_order_varies_with_the_seed() -> None:
    """A question whose right answer never changes is answered once and for all."""
    for name, template in every_nth(TEMPLATES.items(), 2):
        if first_question(name).draft.answer.kind not in ("choice", "order"):
            continue
        asked = [ask(template, seed).draft.answer for seed in range(30 if is_everything() else 12)]
        right = {answer.text(answer.reference) for answer in asked}
        assert (len(right) == 1) == (name in ONE_ANSWER), (name, right)
        # Where the right option is a sentence and not a label, its place tells nothing either.
        if not template.path:
            continue
        places = {answer.offered for answer in asked}
        assert len(places) > 5, name


def test_no_question_gives_the_count_of_what_must_be_marked_or_chosen() -> None:
    """Neither in its text nor beside it: at some of the seeds no number there, but those of rules, is the count."""
    for name, template in TEMPLATES.items():
        answer = first_question(name).draft.answer
        if answer.kind != "pixels" and not (answer.kind == "choice" and answer.is_several):
            continue
        drafts = (ask(template, seed).draft for seed in range(6))
        assert any(
            str(len(draft.answer.reference)) not in numbers_in(draft.text, draft.answer.credit) - RULE_NUMBERS
            for draft in drafts
        ), name


def test_the_divide_that_is_asked_changes_its_numbers() -> None:
    """With w = 1 the result of the divide stood in the question."""
    for seed in range(30):
        draft = ask(TEMPLATES["next-transform"], seed).draft
        before = re.search(r"position before = \((.*)\)", draft.given)
        (right,) = draft.answer.reference
        for text in before[1].replace("−", "-").split(", "):
            assert abs(float(text) - float(right)) > draft.answer.tolerance
