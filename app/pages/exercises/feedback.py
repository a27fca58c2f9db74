"""What is said of a check: points, counts, the mistake by name, and whether it counts."""

from app.pages.exercises.work import Checked
from core.records.words import counted
from lessons.exercises.question import Question
from widgets.exercises.records import Feedback, PixelMarks

SHOWN = "What is right was shown before, so this earns nothing."
CORRECTED = "The first check of a question counts. A new variant earns points of its own."


def feedback_of(question: Question, checked: Checked, *, is_corrected: bool) -> Feedback:
    """Return what is said; ``is_corrected``: there was a check before."""
    judgement, marks = checked.judgement, checked.marks
    heading = f"{judgement.points:.3g} of {counted(question.template.points, 'point')}"
    is_right = judgement.verdict.score == 1
    counts = judgement.verdict.counts
    if isinstance(marks, PixelMarks) and marks.double:
        counts += f", {len(marks.double)} of these double"
    reveal = (question.draft.reveal,) if is_right and question.draft.reveal else ()
    before = (SHOWN,) if checked.attempt is None else (CORRECTED,) if is_corrected else ()
    return Feedback(heading, counts, (*judgement.sentences, *reveal, *before), is_right)
