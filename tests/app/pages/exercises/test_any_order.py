"""Whatever is done in whatever order: verdict, attempt kept and question shown belong together."""

from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random

import pytest
from PySide6.QtCore import QObject
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.files.user_folders import attempt_file
from app.pages.exercises.feedback import CORRECTED, SHOWN
from app.pages.exercises.page import ExercisesPage
from app.session.document import open_document
from app.session.session import Session
from lessons.attempts.practice import first_tries
from lessons.attempts.record import Attempt
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.numbers import Draws
from lessons.exercises.question import Question, judge
from lessons.scenes import built_in_scene
from tests.app.pages.exercises.acting import LEFT
from tests.covering import every_nth

NAMES = (
    *("triangle-coverage", "shared-edge", "barycentric-weights", "bresenham-table", "stage-order"),
    *("facing", "clip-ends", "wrong-line", "wrong-picture", "bresenham-steps"),
    *("break-inclusive", "cheapest-methods"),
)
"""An exercise of every type of answer."""


def line_of(name: str, seed: int) -> str:
    """Return the line that gives a question."""
    return f"{name} {TEMPLATES[name].version}, seed {seed}"


LINES = (
    "ask/shared-edge/16x12/fill=bounding-box/raster/step=5 1, seed 0",
    line_of("facing", 3),
    line_of("triangle-coverage", 5),
)


class Student(QObject):
    """Does one thing after the other on the page, and looks whether what it shows belongs together."""

    def __init__(self, page: ExercisesPage, seed: int) -> None:
        super().__init__(page)
        self.page, self.random = page, Random(seed)
        self.kept: list[Attempt] = []
        """Attempts in the order in which their verdicts were shown."""
        page.questions.checked.connect(self._take)
        self.actions = {
            self._answer: 8,
            self._check: 8,
            self._answer_and_check: 8,
            lambda: QTest.mouseClick(page.question_view.variant_button, LEFT): 3,
            lambda: QTest.mouseClick(page.question_view.again_button, LEFT): 1,
            lambda: QTest.mouseClick(page.question_view.model_button, LEFT): 0.5,
            lambda: QTest.mouseClick(page.question_view.hint_button, LEFT): 1,
            lambda: QTest.mouseClick(page.catalogue.next_button, LEFT): 2,
            lambda: page.catalogue.exercise_chosen.emit(self.random.choice(NAMES)): 4,
            lambda: page.open_line(self.random.choice(LINES)): 2,
            lambda: page.exercises.open_neighbour(1): 1,
            lambda: page.questions.go_back(self.random.choice((-1, 1))): 3,
            lambda: page.progress.user_changed.emit(self.random.choice(("me", "Ada"))): 1,
            lambda: page.unfinished.finish(): 1,
            QApplication.processEvents: 8,
            page.settle: 8,
        }

    def act(self) -> None:
        """Do something, and look."""
        self.random.choices([*self.actions], [*self.actions.values()])[0]()
        self.look()

    def _answer(self) -> None:
        question = self.page.question
        draft = question.draft
        answers = [draft.answer.reference, *draft.mistakes.values()]
        guess = draft.answer.random(Draws(self.random.randrange(100)))
        self.page.questions.answer(self.random.choice([*answers, guess]))

    def _answer_and_check(self) -> None:
        self._answer()
        self._check()

    def _check(self) -> None:
        QTest.mouseClick(self.page.question_view.check_button, LEFT)

    def _take(self, attempt: Attempt) -> None:
        """Compare the attempt with the question and the verdict that are shown with it."""
        page, question = self.page, self.page.question
        template = question.template
        assert (attempt.template, attempt.version, attempt.seed) == (
            template.name,
            template.version,
            question.seed,
        )
        assert attempt.user == page.questions.user == page.exercises.user == page.unfinished.answers.user
        verdict = page.question_view.verdict.text()
        assert f"{attempt.points:.3g} of {template.points} point" in verdict
        if not verdict.startswith("Last check: "):
            assert attempt.verdict in verdict
        self.kept.append(attempt)
        mine = [each for each in self.kept if each.user == attempt.user]
        is_corrected = len(first_tries(mine)) == len(first_tries(mine[:-1]))
        assert (CORRECTED in verdict) == (is_corrected and not verdict.startswith("Last check: "))

    def look(self) -> None:
        """Compare what is shown: the question, its form and the verdict."""
        page, question, view = self.page, self.page.question, self.page.question_view
        assert view.mark.text() == question.mark
        verdict = (
            "" if view.verdict.isHidden() or view.verdict.parentWidget().isHidden() else view.verdict.text()
        )
        if verdict and not verdict.startswith("Last check: ") and not page.questions._is_shown:
            judgement = judge(question, response_of(question, view.answer.given()))
            assert verdict.startswith(f"{judgement.points:.3g} of {question.template.points} point")
            assert judgement.verdict.counts in verdict
        kept = page.unfinished.answers
        begun = kept.answers[question.template.name]
        if not page.questions.is_working:
            assert (kept.current, begun.seed) == (question.template.name, question.seed)
            assert begun.given in (None, view.answer.given())


def response_of(question: Question, given: object) -> object:
    """Return what is in the form, as a check reads it."""
    return question.draft.answer.read(given)


@pytest.fixture
def page(qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[ExercisesPage]:
    """Return the page alone: to show it in a window takes most of the time."""
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path))
    scene = built_in_scene("shared-edge")
    made = ExercisesPage(Session(open_document(scene.make(), scene.title)))
    qtbot.addWidget(made)
    made.settle()
    yield made
    made.stop()


def test_another_question_waits_for_the_verdict_and_ends_the_one_before(page: ExercisesPage) -> None:
    """Whatever brings it: Check before it is drawn checks nothing; an answer that is being checked counts first."""
    student = Student(page, 1)
    ways: tuple[Callable[[], None], ...] = (
        lambda: page.question_view.variant_button.click(),
        lambda: page.catalogue.exercise_chosen.emit("facing"),
        lambda: page.catalogue.next_button.click(),
        lambda: page.open_line(LINES[0]),
        lambda: page.open_line(line_of("triangle-coverage", 9)),
        lambda: page.progress.user_changed.emit("Ada"),
    )
    for way in every_nth(ways, 5):
        page.open_line(line_of("triangle-coverage", 8))
        page.settle()
        question = page.question
        page.questions.answer(next(iter(question.draft.mistakes.values())))
        before = len(student.kept)
        way()
        page.question_view.check_button.click()
        page.settle()
        student.look()
        assert len(student.kept) == before
        assert page.question_view.verdict.parentWidget().isHidden()
        page.open_line(line_of("triangle-coverage", 8))
        page.settle()
        page.questions.answer(question.draft.answer.reference)
        page.question_view.check_button.click()
        way()
        page.settle()
        assert len(student.kept) == before + 1
        assert page.question is not question


def test_no_answer_is_checked_while_those_before_it_are_read(page: ExercisesPage) -> None:
    """Whether an attempt counts is known only beside them: here it corrects one that is read again."""
    page.open_line(line_of("facing", 3))
    page.settle()
    for is_read in (True, False, True):
        page.questions.answer(page.question.draft.answer.reference)
        if not is_read:
            page.exercises.set_user(page.exercises.user)
        page.question_view.check_button.click()
        assert page.questions.is_checking == is_read
        page.settle()
    assert page.question_view.verdict.text().endswith(CORRECTED)


def test_a_verdict_is_that_of_the_answer_that_was_checked(page: ExercisesPage) -> None:
    """An answer that is changed during its check has points, but no marks until the change is taken back."""
    student = Student(page, 1)
    page.open_line(line_of("facing", 3))
    page.settle()
    question, view = page.question, page.question_view
    page.questions.answer(question.draft.answer.reference)
    QTest.mouseClick(view.check_button, LEFT)
    page.questions.answer(frozenset())
    page.settle()
    assert view.verdict.text() == "Last check: 2 of 2 points. The answer has changed since."
    page.questions.go_back(-1)
    assert view.verdict.text().startswith("2 of 2 points: ")
    for said in (CORRECTED, SHOWN):
        page.questions.ask_again()
        page.questions.answer(question.draft.answer.reference)
        QTest.mouseClick(view.check_button, LEFT)
        page.questions.show_model()
        page.settle()
        assert view.verdict.text().endswith(said)
        assert ("now; the first check counted, with 2:" in view.verdict.text()) == (said == CORRECTED)
    assert len(student.kept) == 2


@pytest.mark.parametrize("count", [60, pytest.param(10_000, marks=pytest.mark.slow)])
def test_verdict_attempt_and_question_belong_together(page: ExercisesPage, count: int) -> None:
    student = Student(page, 32)
    for _ in range(count):
        student.act()
    page.settle()
    assert {*attempt_file().attempts()} == {*student.kept}
    assert len(student.kept) > count / 50
