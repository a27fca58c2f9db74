"""Every template at one seed, its questions everywhere the same, and two tables done by hand."""

import re
import subprocess
import sys
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from core import clip_lines, trace
from lessons.exercises.answers.answer import NotCheckedError
from lessons.exercises.asked import check_template, numbers_in, question_problems, question_text
from lessons.exercises.asked_text import parts_of
from lessons.exercises.catalogue import TEMPLATES, template_named
from lessons.exercises.numbers import Draws, NoQuestionError, reject
from lessons.exercises.question import Draft, Template, ask, hints_after, judge
from lessons.exercises.templates import clipping, fragments, interpolation, lines, mixing, placing, surfaces
from lessons.exercises.templates.clipping import outcode_table, parameter_table
from lessons.exercises.templates.lines import d_table
from lessons.mistakes.shelf import SHELF
from lessons.mistakes.twin import Twin
from tests.covering import every_nth
from tests.lessons.exercises.first_questions import first_question

ROOT = Path(__file__).parents[3]
SEGMENT = ((-1, -2), (9, 7))


def test_a_block_of_text_holds_a_question_and_its_hints() -> None:
    block = "What is D? It\n    begins at 1.\n    Hint: Add\n    2.\n    Hint: Look."
    assert parts_of(block) == ("What is D? It begins at 1.", ("Add 2.", "Look."))


@pytest.mark.parametrize("template", TEMPLATES.values(), ids=TEMPLATES)
def test_a_template_asks_fairly(template: Template) -> None:
    question = first_question(template.name)
    assert question_problems(question) == []
    assert len(question.draft.hints) >= 3


def test_the_last_hint_is_written_from_the_numbers_of_the_question() -> None:
    for name, template in every_nth(TEMPLATES.items(), 3):
        drafts = [first_question(name).draft, ask(template, 1).draft]
        if len({draft.hints[-1] for draft in drafts}) > 1:
            continue
        drafts.append(ask(template, 2).draft)
        # The numbers of a listing's lines are none of the question.
        offered = [draft.answer.offered * (draft.answer.kind not in ("line", "code")) for draft in drafts]
        asked = {
            frozenset(numbers_in(draft.text, draft.given, text))
            for draft, text in zip(drafts, offered, strict=True)
        }
        assert len(asked) == 1 or len({draft.hints[-1] for draft in drafts}) > 1, name


@pytest.mark.parametrize("template", TEMPLATES.values(), ids=TEMPLATES)
def test_the_scene_of_a_question_can_be_stepped_in_its_stage(template: Template) -> None:
    draft = first_question(template.name).draft
    if draft.scene is not None:
        assert trace(draft.scene, draft.settings).stage(template.stage).steps.row_count > 0


@pytest.mark.slow
@pytest.mark.parametrize("template", TEMPLATES.values(), ids=TEMPLATES)
def test_a_template_asks_fairly_at_many_seeds(template: Template) -> None:
    assert check_template(template, range(200)).problems == ()


RECORDED = Path(__file__).with_name("questions.txt")
"""The question of every template at seed 23."""


def test_questions_are_those_that_were_recorded() -> None:
    recorded = RECORDED.read_text(encoding="utf-8")
    asked = "\n".join(question_text(ask(template, 23)) for template in TEMPLATES.values())
    assert asked == recorded


@pytest.mark.slow  # a process has another hash seed every day
def test_questions_are_the_same_in_another_process_with_another_hash_seed() -> None:
    code = (
        "from lessons.exercises.catalogue import TEMPLATES\n"
        "from lessons.exercises.question import ask\n"
        "from lessons.exercises.asked import question_text\n"
        "print('\\n'.join(question_text(ask(template, 23)) for template in TEMPLATES.values()), end='')"
    )
    found = subprocess.run(
        [sys.executable, "-P", "-c", code],
        env={"PYTHONPATH": str(ROOT), "PYTHONHASHSEED": "77", "PYTHONIOENCODING": "utf-8"},
        capture_output=True,
        encoding="utf-8",
    )
    assert found.returncode == 0, found.stderr
    assert found.stdout == RECORDED.read_text(encoding="utf-8")


def test_one_slip_in_the_table_of_d_costs_one_cell() -> None:
    table = d_table(((1, 1), (9, 4)))
    right = ["-2", "4", "-6", "0", "6", "-4", "2", "-8"]
    assert table.read(right) == table.reference
    # Slip: 5 for 6; all that follows is computed from it.
    slip = ["-2", "4", "-6", "0", "5", "-5", "1", "-9"]
    verdict = table.check(table.read(slip))
    assert verdict.marks == {"wrong": [(4, 0)]}
    assert verdict.score == 7 / 8
    assert table.is_slip(table.read(slip))


def test_one_slip_in_the_table_of_p_q_t_costs_one_cell() -> None:
    table = parameter_table(SEGMENT)
    right = [["-10", "-1", "PE 1/10"], ["10", "9", "PL 9/10"], ["-9", "-2", "PE 2/9"], ["9", "8", "PL 8/9"]]
    assert table.is_same(table.read(right), table.reference)
    assert table.check(table.read(right)).score == 1
    slip = [*right[:2], ["-8", "-2", "PE 1/4"], right[3]]
    verdict = table.check(table.read(slip))
    assert verdict.marks == {"wrong": [(2, 0)]}
    assert verdict.score == 11 / 12
    exchanged = [[p, q, t.translate(str.maketrans("EL", "LE"))] for p, q, t in right]
    assert table.check(table.read(exchanged)).score == 8 / 12


def test_the_cuts_of_an_outcode_table_end_where_the_clipper_does() -> None:
    table = outcode_table(SEGMENT, 4)
    assert table.text(table.reference).splitlines()[1:] == [
        "cut 1  0101 1010  0             -1.1",
        "cut 2  0100 1010  11/9 (1.222)  0",
        "cut 3  0000 1010  8             6.1",
        "cut 4  0000 1000  71/9 (7.889)  6",
    ]
    (start, end) = clip_lines([SEGMENT], (0, 0, 8, 6), "cohen-sutherland").segments[0].tolist()
    places = [[float(row[1]), float(row[2])] for row in (table.reference[1], table.reference[3])]
    np.testing.assert_allclose(places, [start, end])
    # The outcode of the new end was not computed again: two cells are wrong, the rest follows.
    late = [
        ["0101 1010", "0", "-1.1"],
        ["0000 1010", "8", "6.1"],
        ["0000 1000", "71/9", "6"],
        ["0000 0000", "", ""],
    ]
    assert table.check(table.read(late)).marks["wrong"][0] == (1, 0)


def test_what_is_culled_is_what_the_determinant_says() -> None:
    question = ask(TEMPLATES["facing"], 3)
    assert (
        question.draft.mistakes["facing-exchanged"] == frozenset(range(4)) - question.draft.answer.reference
    )


def is_inside(corners: list[tuple[Fraction, Fraction]], x: Fraction, y: Fraction) -> bool:
    """Decide in exact numbers whether a counter-clockwise triangle owns a point: an independent reference."""
    for (x0, y0), (x1, y1) in zip(corners, [*corners[1:], corners[0]], strict=True):
        a, b = y0 - y1, x1 - x0
        value = a * (x - x0) + b * (y - y0)
        if not (value > 0 or (value == 0 and (a > 0 or (a == 0 and b > 0)))):
            return False
    return True


@pytest.mark.parametrize("name", ["triangle-coverage", "shared-edge"])
def test_pixels_are_those_of_exact_arithmetic(name: str) -> None:
    half = Fraction(1, 2)
    for seed in range(4):
        draft = ask(TEMPLATES[name], seed).draft
        texts = re.findall(r"\(([^,]+), ([^)]+)\)", draft.given.partition("Triangle B")[0])
        corners = [(Fraction(x), Fraction(y)) for x, y in texts]
        inside = {(i, j) for i in range(12) for j in range(9) if is_inside(corners, i + half, j + half)}
        assert inside == draft.answer.reference


class Faultless:
    """Stands for a shelf whose twins make no mistake."""

    def __getitem__(self, name: str):
        shows = SHELF[name].shows
        return Twin(name, "None.", shows, shows)


@pytest.mark.parametrize(
    ("module", "draw"),
    [
        (fragments, fragments.draw_weights),
        (fragments, fragments.draw_perspective),
        (fragments, fragments.draw_blend),
        (fragments, fragments.draw_depths),
        (lines, lines.draw_table),
        (clipping, clipping.draw_parameters),
        (placing, placing.draw_ends),
        (interpolation, interpolation.draw_color),
        (interpolation, interpolation.draw_sorted),
        (surfaces, surfaces.draw_nearest),
        (surfaces, surfaces.draw_repeated),
        (mixing, mixing.draw_alpha),
        (mixing, mixing.draw_straight),
        (mixing, mixing.draw_panes),
    ],
)
def test_exact_answers_are_those_of_a_run_without_a_mistake(module, draw, monkeypatch) -> None:
    monkeypatch.setattr(module, "SHELF", Faultless())
    draws, drafts = Draws(5), []
    for _ in range(12):
        with suppress(NoQuestionError):
            drafts.append(draw(draws))
    assert drafts
    for draft in drafts:
        for name, run in draft.mistakes.items():
            assert name == "corner-for-center" or draft.answer.is_same(run, draft.answer.reference)


def test_a_twin_wins_over_a_slip_and_equal_twins_are_both_named() -> None:
    question = ask(TEMPLATES["bresenham-pixels"], 1)
    lost = question.draft.mistakes["last-pixel-lost"]
    judgement = judge(question, lost)
    assert judgement.mistakes == ("last-pixel-lost",)
    assert not judgement.is_slip
    assert judgement.sentences == [SHELF["last-pixel-lost"].sentence]
    stray = question.draft.answer.reference | {(0, 8)}
    assert judge(question, stray).sentences == ["A slip: all but one is right."]
    perspective = ask(TEMPLATES["perspective-u"], 1)
    both = judge(perspective, perspective.draft.mistakes["w-overwritten"])
    assert both.mistakes == ("affine-for-perspective", "w-overwritten")


def test_hints_end_with_where_a_wrong_answer_goes_wrong() -> None:
    draft = ask(TEMPLATES["bresenham-table"], 1).draft
    assert hints_after(draft) == hints_after(draft, draft.answer.reference) == draft.hints
    wrong = hints_after(draft, draft.mistakes["start-not-doubled"])
    assert wrong[:-1] == draft.hints
    assert wrong[-1] == f"The first wrong cell: D, {draft.answer.labels[0]}."


def test_a_template_that_cannot_draw_its_question_says_so() -> None:
    numbers = TEMPLATES["blend-over"]
    never = Template("never", 1, "Never", "depth", 1, lambda draws: reject(True))
    with pytest.raises(ValueError, match="never cannot draw its question in 1000 tries: no draw makes"):
        ask(never, 0)
    draft = ask(numbers, 0).draft

    def hides(draws) -> Draft:
        return Draft("", "", draft.answer, (), {"order-reversed": draft.answer.reference})

    with pytest.raises(ValueError, match="order-reversed gives the right answer, or none"):
        ask(Template("hides", 1, "Hides", "depth", 1, hides), 0)
    with pytest.raises(ValueError, match=r"or an exercise such as triangle-coverage, got"):
        template_named("'; DROP TABLE exercises")


def test_a_hint_that_holds_a_number_of_the_answer_is_found() -> None:
    question = ask(TEMPLATES["bresenham-table"], 2)
    assert question_problems(question) == []
    telling = replace(question, draft=replace(question.draft, hints=("The third D is 77.",)))
    assert question_problems(telling) == [
        "the last hint has no number of the question",
        "a hint holds 77, which the question does not show",
    ]


def test_malformed_tables_are_not_checked() -> None:
    table = parameter_table(SEGMENT)
    for rows, wanted in (
        ([["1", "1", "1/10"]] * 4, "expected PE or PL and a number such as PE 1/2, or none, got '1/10'"),
        ([["1", "1e400", "PE 1"]] * 4, "expected a number up to 1e300"),
    ):
        with pytest.raises(NotCheckedError, match=wanted):
            table.read(rows)


def test_an_answer_of_zero_is_shown_as_zero() -> None:
    draft = ask(TEMPLATES["turn-by-degrees"], 77).draft
    assert draft.answer.text(draft.answer.reference).endswith("y = 0")
