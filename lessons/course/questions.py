"""What a step of a lesson asks, as a question of the exercises: with the same kinds of answer and the same judge."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from lessons.course.lesson_file import Lesson
from lessons.course.state import State, States
from lessons.exercises.answer_parts import ChoicePart
from lessons.exercises.answers.answer import Response
from lessons.exercises.answers.code import CodeAnswer
from lessons.exercises.draws import Draws
from lessons.exercises.exercise_file import wrong_pixels
from lessons.exercises.file_answers import answer_of
from lessons.exercises.question import Draft, Judgement, Question, Template, judge

Item = TypeVar("Item")


class _AsWritten(Draws):
    """Leaves the options of a choice in the order of the file."""

    def shuffled(self, items: Sequence[Item]) -> tuple[Item, ...]:
        """Return the items."""
        return tuple(items)


@dataclass(frozen=True, eq=False)
class Outcome:
    """What an answer is worth, and the wrong answer of the file that it is."""

    judgement: Judgement
    wrong: int | None = None
    """Number of it; ``None``: none that the file knows."""

    @property
    def is_right(self) -> bool:
        """Whether nothing is wrong with it."""
        return self.judgement.verdict.score >= 1


def question_of(lesson: Lesson, number: int, states: States) -> Question:
    """Return what a step asks; ValueError with file and line where it cannot be drawn, or asks nothing."""
    step = lesson.steps[number]
    if step.answer is None:
        raise ValueError(f"step {number + 1} of {lesson.name} asks nothing")
    state = states.of_step(number)
    try:
        draft = _draft(lesson, number, state)
    except ValueError as problem:
        raise lesson.file.error(("step", number, "answer"), str(problem)) from None
    template = Template(
        lesson.step_name(number),
        lesson.revision,
        f"{lesson.title}, step {number + 1}",
        state.stage,
        1,
        lambda _: draft,
        is_fixed=True,
    )
    return Question(template, 0, draft)


def _draft(lesson: Lesson, number: int, state: State) -> Draft:
    step = lesson.steps[number]
    assert step.answer is not None
    draws = _AsWritten(0) if isinstance(step.answer, ChoicePart) else Draws(0)
    answer, given = answer_of(step.answer, state.drawn, state.settings, draws)
    mistakes: dict[str, Response] = answer.named_mistakes if isinstance(answer, CodeAnswer) else {}
    if step.mistakes:
        mistakes = {**wrong_pixels(step.answer, step.mistakes, state.scene, state.settings)}
    text = "\n\n".join(filter(None, (step.text, step.task)))
    return Draft(
        text,
        given,
        answer,
        mistakes=mistakes,
        scene=state.scene,
        settings=state.settings,
        pixel=state.pixel,
        reveal=step.after or "",
    )


def outcome_of(lesson: Lesson, number: int, question: Question, response: Response) -> Outcome:
    """Judge an answer that was read; a wrong answer of the file says what is wrong."""
    judgement, answer = judge(question, response), question.draft.answer
    if answer.is_same(response, answer.reference):
        return Outcome(judgement)
    for place, wrong in enumerate(lesson.steps[number].wrong):
        if answer.is_same(response, answer.read(wrong.given)):
            names = (wrong.mistake,) if wrong.mistake else judgement.mistakes
            return Outcome(replace(judgement, mistakes=names, reason=wrong.says), place)
    return Outcome(judgement)
