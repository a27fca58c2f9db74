"""What the pane of a lesson shows of a step, of what comes before the first one, and of the end."""

import re
from collections.abc import Sequence

from app.pages.exercises.answer_pictures import numbers_of
from lessons.course.catalogue import Course
from lessons.course.lesson_file import Lesson
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import Question
from widgets.lessons.records import LessonStepRecord, Standing

TASKS = {
    "look": "",
    "predict": "Predict",
    "do": "Do it",
    "break": "Break it",
    "measure": "Measure",
}
"""What a step wants to be done, by its kind, where it has no sentence of its own for it."""
OPENS = {
    "compare": "Open it on the Compare page",
    "stability": "Open it on the Stability page",
    "plan": "Open the Plan page",
}
"""What a link of a step to be measured says, by the page that it leads to."""
COURSES = {
    "Zwicker": "Zwicker’s course",
    "Jubair": "Jubair’s course",
    "Pellacini": "Pellacini’s course",
    "LMU": "the course at the LMU",
}
"""Courses whose questions lessons answer, by how a lesson's file names them."""
_COURSE = re.compile(rf"\b({'|'.join(COURSES)})(?:, ([^:?]*))?: ")
_TOGETHER = re.compile(r"(?<=[\d,]) (?=-?[\d./]+\))| (?=[=<>≥≤≠])|(?<=[=<>≥≤≠]) ")
"""Spaces at which no line ends: in ``(2, 1)`` and in ``E0 = 0``."""


def paragraphs(text: str | None) -> str:
    """Return a text of a file, whose lines are those of its author, as paragraphs."""
    parts = (" ".join(part.split()) for part in (text or "").split("\n\n"))
    return _TOGETHER.sub("\N{NO-BREAK SPACE}", "\n".join(parts))


def step_record(
    lesson: Lesson, number: int, standings: Sequence[Standing], *, was_done: bool
) -> LessonStepRecord:
    """Return a step; ``was_done``: when it was opened, its task had been done already."""
    step = lesson.steps[number]
    return LessonStepRecord(
        title=lesson.title,
        text=paragraphs(step.text),
        number=number,
        standings=tuple(standings),
        lead=paragraphs(lesson.question) if number == 0 else "",
        task=paragraphs(step.task) or TASKS[step.kind],
        links=((step.show, OPENS[step.show.partition("/")[0]]),) if step.show else (),
        has_previous=number > 0 or lesson.part.recall is not None,
        was_done=was_done and bool(TASKS[step.kind]),
    )


def recall_record(
    lesson: Lesson, course: Course, question: Question, standings: Sequence[Standing]
) -> LessonStepRecord:
    """Return the exercise of an earlier lesson that is asked before the first step."""
    draft, template = question.draft, question.template
    others = (each for each in course.lessons.values() if each is not lesson)
    closed = next((each.title for each in others if template.name in each.part.exercises), "")
    whence = f"From the lesson “{closed}”" if closed else f"From the exercise “{template.title}”"
    return LessonStepRecord(
        title=lesson.title,
        text="\n".join(filter(None, (draft.text, numbers_of(draft)))),
        number=-1,
        standings=tuple(standings),
        lead=f"{whence}. You may skip it: choose Begin.",
        next_title="Begin",
        has_previous=False,
    )


def answered(text: str) -> str:
    """Return the questions that one can answer at the end, each with the course that asks it, as ``Zwicker:`` says."""
    before, *parts = _COURSE.split(text)
    if not parts or before:
        return text
    said = []
    for name, place, question in zip(parts[::3], parts[1::3], parts[2::3], strict=True):
        where = f", {place.rstrip(')')}" if place else ""
        question = question.strip()
        said.append(f"{question[:1].upper()}{question[1:]} (from {COURSES[name]}{where})")
    return "\n".join(said)


def end_record(lesson: Lesson, following: Lesson | None, standings: Sequence[Standing]) -> LessonStepRecord:
    """Return the end: what one can answer now, exercises, and the question of the next lesson."""
    part = lesson.part
    said = [f"You can now answer: {answered(paragraphs(part.answers))}" if part.answers else ""]
    if following is not None:
        said.append(f"Next lesson: {following.title}")
        said.append(paragraphs(following.question if part.next is None else part.next.text))
    return LessonStepRecord(
        title=lesson.title,
        text="\n".join(filter(None, said)) or "This is the end of the lesson.",
        number=len(lesson.steps),
        standings=tuple(standings),
        links=tuple((f"exercise/{name}", f"Exercise: {TEMPLATES[name].title}") for name in part.exercises),
        next_title="Next lesson",
        has_next=following is not None,
    )
