"""What is said of a check: points, counts, the mistake by name, and whether it counts."""

from app.pages.exercises.answer_pictures import are_marks_shown
from app.pages.exercises.evidence import EXPLAIN
from app.pages.exercises.work import Checked, Tried
from core.records.words import counted
from lessons.attempts.practice import MISSES_IN_A_ROW
from lessons.attempts.record import Attempt
from lessons.exercises.question import Question
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.code_answer import problem_text
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
