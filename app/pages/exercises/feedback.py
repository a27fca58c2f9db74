"""What is said of a check: points, counts, the mistake by name, whether it counts; and where the answer is marked."""

from collections.abc import Callable, Sequence

from app.pages.exercises.answers import Checked, Tried, are_marks_shown
from app.pages.exercises.evidence import EXPLAIN
from core.records.words import counted
from lessons.attempts.practice import MISSES_IN_A_ROW, first_tries, is_correction, misses_in_a_row
from lessons.attempts.record import Attempt
from lessons.exercises.question import Question
from widgets.exercises.answer_forms import problem_text
from widgets.exercises.mark_grid import AnswerView
from widgets.exercises.question_view import QuestionView
from widgets.exercises.records import Feedback

SHOWN = "What is right was shown before, so this earns nothing."
CORRECTED = "A new variant earns points of its own."


EXPLAINED = (
    f"Missed {MISSES_IN_A_ROW} times in a row. Choose {EXPLAIN}: it opens the right run at the step that decides.",
    f"Missed {MISSES_IN_A_ROW} times in a row. Model answer shows what is right.",
)
"""What is said of an exercise with a scene, and of one without."""


def not_checked_text(problem: Exception) -> str:
    """Return why an answer is not checked, as a sentence."""
    said = f"Not checked yet: {problem}"
    return said if said.endswith("?") else f"{said}."


def show_tried(view: AnswerView, tried: Tried) -> str:
    """Mark where a listing that is typed cannot run, and return why as a sentence; empty: it can."""
    problem = tried.problem
    view.show_problem(None if problem is None else (*problem.place, problem.sentence))
    return "" if problem is None else problem_text((*problem.place, problem.sentence))


def marks_are_shown(question: Question, checked: Checked, *, is_corrected: bool) -> bool:
    """Return whether the answer is marked: where the first one is in pixels, and wrong, words say less."""
    is_first = checked.attempt is not None and not is_corrected
    is_right = checked.judgement.verdict.score == 1
    return are_marks_shown(question.draft, is_right=is_right, is_first=is_first)


def feedback_of(
    question: Question, checked: Checked, *, first: Attempt | None, is_explained: bool = False
) -> Feedback:
    """Return what is said.

    ``first``: the earlier check that counts, if there was one; ``is_explained``: its step is offered.
    """
    judgement, double = checked.judgement, checked.marks.get("double")
    heading = f"{judgement.points:.3g} of {counted(question.template.points, 'point')}"
    if first is not None:
        heading += f" now; the first check counted, with {first.points:.3g}"
    is_right = judgement.verdict.score == 1
    counts = judgement.verdict.counts
    if double:
        counts += f", {len(double)} of these double"
    reveal = (question.draft.reveal,) if is_right and question.draft.reveal else ()
    is_marked = marks_are_shown(question, checked, is_corrected=first is not None)
    where = () if is_marked else (question.draft.answer.first_wrong(checked.response),)
    before = (SHOWN,) if checked.attempt is None else (CORRECTED,) if first is not None else ()
    offer = (EXPLAINED[question.draft.scene is None],) if is_explained else ()
    return Feedback(heading, counts, (*judgement.sentences, *where, *reveal, *before, *offer), is_right)


class LastCheck:
    """What the last check of a question found, and what counts of it."""

    def __init__(self, attempts: Callable[[], Sequence[Attempt]]) -> None:
        """Begin without a check; ``attempts`` returns those of the learner so far."""
        self._attempts = attempts
        self._question: Question | None = None
        self.checked: Checked | None = None
        """What the last check found; ``None``: nothing was checked since the question was asked."""
        self._first: Attempt | None = None
        """The check that counts, where the last one corrects it."""
        self.is_explained = False
        """Whether the exercise was missed so often in a row that the step which decides is offered."""

    def begin(self, question: Question) -> None:
        """Forget what was found of another question."""
        self._question, self.checked, self._first, self.is_explained = question, None, None, False

    def take(self, checked: Checked) -> None:
        """Keep what a check found, and find whether its attempt counts."""
        attempt, tries = checked.attempt, self._attempts()
        self.checked, self._first, self.is_explained = checked, None, False
        if attempt is not None:
            if is_correction(tries, attempt):
                question = (attempt.template, attempt.version, attempt.seed)
                self._first = next(
                    each
                    for each in reversed(first_tries(tries))
                    if (each.template, each.version, each.seed) == question
                )
            misses = misses_in_a_row(first_tries((*tries, attempt)))[attempt.template]
            self.is_explained = attempt.score < 1 and misses >= MISSES_IN_A_ROW

    def show(self, view: QuestionView) -> None:
        """Show what was found; of an answer that was changed since, the points alone."""
        if self.checked is None or self._question is None or view.answer is None:
            return
        is_stale = view.answer.given() != self.checked.given
        are_shown = marks_are_shown(self._question, self.checked, is_corrected=self._first is not None)
        view.answer.show_marks(self.checked.marks if are_shown and not is_stale else None)
        feedback = feedback_of(
            self._question, self.checked, first=self._first, is_explained=self.is_explained
        )
        view.show_feedback(feedback, is_stale=is_stale)
