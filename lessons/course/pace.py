"""How long a lesson takes: a plain sum over its steps, so that the minutes of all lessons mean the same."""

from lessons.course.lesson_file import Lesson
from lessons.course.record import StepPart, word_count

WORDS_A_MINUTE = 110
"""Reading that is thought about, with numbers, in a language that is not the reader's own."""
LOOK, TASK, MEASURE, RECALL = 20, 120, 120, 75
"""Seconds for a picture, for a change of the scene or the settings, for a measurement, and for the warm-up."""
ANSWERS = {"choice": 45, "pixels": 90, "order": 90, "code": 200, "table": 150}
"""Seconds for an answer, by its type."""
NUMBER, EACH = 45, 40
"""Seconds for an answer in numbers, and for each of them."""


def estimated_minutes(lesson: Lesson) -> float:
    """Return how many minutes a lesson takes, without its closing exercises."""
    seconds = sum(map(_seconds, lesson.steps)) + RECALL * (lesson.part.recall is not None)
    return seconds / 60


def _seconds(step: StepPart) -> float:
    words = sum(word_count(text) for text in (step.text, step.task, step.after) if text)
    seconds = LOOK + 60 * words / WORDS_A_MINUTE
    if step.answer is not None:
        count = len(step.answer.values) if step.answer.type == "numbers" else 1
        return seconds + ANSWERS.get(step.answer.type, NUMBER + EACH * count)
    return seconds + {"do": TASK, "break": TASK, "measure": MEASURE}.get(step.kind, 0)
