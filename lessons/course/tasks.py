"""What a step of a lesson asks: conditions of what is open, or a question as the exercises ask it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import TypeVar

import numpy as np

from core import Settings, render
from core.scene import AnyScene, ClipScene
from lessons.course.catalogue import Lesson
from lessons.course.quoted import Situation, flags_of, is_right
from lessons.course.record import KEPT, FailsPart, UntilPart
from lessons.course.state import State, States
from lessons.exercises.answers.answer import Response
from lessons.exercises.answers.listings import CodeAnswer
from lessons.exercises.drafting import different_pixels
from lessons.exercises.exercise_file import wrong_pixels
from lessons.exercises.file_answers import answer_of
from lessons.exercises.numbers import Draws
from lessons.exercises.question import Draft, Judgement, Question, Template, judge
from lessons.exercises.record import ChoicePart
from lessons.scene_edits import window_of_clip

# When a task is done: the conditions of a lesson, asked of what is open. They know no window.


ROUNDING = 1e-6
"""Pixels by which a corner may lie outside of the window and still count as in it."""


def is_done(until: UntilPart, situation: Situation, start: Situation) -> bool:
    """Return whether a task is done: everything that it names holds. What the stage does not have does not hold."""
    try:
        return not first_open(until, situation, start)
    except ValueError:
        return False


def first_open(until: UntilPart, situation: Situation, start: Situation) -> str:
    """Return the first key of a task that does not hold yet; empty: all do.

    Parameters
    ----------
    start : Situation
        Where the step began.

    Raises
    ------
    ValueError
        If a condition cannot be read, or names what the stage does not have.
    """
    for key in _ORDER:
        if key in until.model_fields_set and not _HOLDS[key](until, situation, start):
            return key
    return ""


def _rows(situation: Situation, condition: str) -> int:
    return int(np.count_nonzero(flags_of(condition, situation.trace)))


def _some(until: UntilPart, situation: Situation, start: Situation) -> bool:
    return all(_rows(situation, condition) for condition in until.some)


def _none(until: UntilPart, situation: Situation, start: Situation) -> bool:
    return not any(_rows(situation, condition) for condition in until.none)


def _count(until: UntilPart, situation: Situation, start: Situation) -> bool:
    assert until.count is not None
    condition, number = until.count
    return _rows(situation, condition) == int(number)


def _least(until: UntilPart, situation: Situation, start: Situation) -> bool:
    assert until.least is not None
    condition, number = until.least
    return _rows(situation, condition) >= int(number)


def _most(until: UntilPart, situation: Situation, start: Situation) -> bool:
    assert until.most is not None
    condition, number = until.most
    return _rows(situation, condition) <= int(number)


def _here(until: UntilPart, situation: Situation, start: Situation) -> bool:
    assert until.here is not None
    row, _ = situation.trace.steps.row_at(situation.position)
    return row >= 0 and bool(flags_of(until.here, situation.trace)[row])


def _settings(until: UntilPart, situation: Situation, start: Situation) -> bool:
    chosen = _names(situation.settings)
    return all(chosen.get(family) == method for family, method in until.settings.items())


def _fails(until: UntilPart, situation: Situation, start: Situation) -> bool:
    assert until.fails is not None
    part = until.fails
    return fails_on(part, situation, part.weak) and not fails_on(part, situation, part.robust)


def fails_on(part: FailsPart, situation: Situation, chosen: Mapping[str, str]) -> bool:
    """Return whether methods fail on the open scene."""
    frame = situation.frame(chosen)
    if part.by == "twice":
        return bool((frame.cover_count > 1).any())
    if part.by == "nothing":
        return not frame.cover_count.any()
    return bool(different_pixels(frame, situation.frame(part.robust)))


def _pixels(until: UntilPart, situation: Situation, start: Situation) -> bool:
    return int(np.count_nonzero(situation.frame().cover_count)) == until.pixels


def _tested(until: UntilPart, situation: Situation, start: Situation) -> bool:
    return is_right(f"tested <= {until.tested}", situation)


def _decisions(until: UntilPart, situation: Situation, start: Situation) -> bool:
    return is_right(f"decisions <= {until.decisions}", situation)


def _same(until: UntilPart, situation: Situation, start: Situation) -> bool:
    return not different_pixels(situation.frame(), situation.frame(until.same))


def _right(until: UntilPart, situation: Situation, start: Situation) -> bool:
    return all(is_right(text, situation) for text in until.holds)


def _stage(until: UntilPart, situation: Situation, start: Situation) -> bool:
    return situation.stage == until.stage


def _pixel(until: UntilPart, situation: Situation, start: Situation) -> bool:
    return situation.pixel == tuple(until.pixel or ())


def _keeps(until: UntilPart, situation: Situation, start: Situation) -> bool:
    return all(is_kept(name, situation, start) for name in until.keeps)


def check_kept(names: list[str]) -> None:
    """Raise ValueError for what cannot be kept."""
    families = [field.name for field in fields(Settings)]
    for name in names:
        if name not in KEPT and name not in families:
            raise ValueError(f"expected one of {', '.join(KEPT)} or a family of methods, got {name!r:.40}")


def is_kept(name: str, situation: Situation, start: Situation) -> bool:
    """Return whether what a task keeps is as the step gave it."""
    if name == "scene":
        return _is_same_scene(situation.scene, start.scene)
    if name == "size":
        return situation.scene.size == start.scene.size
    if name == "settings":
        return _names(situation.settings) == _names(start.settings)
    if name == "window":
        return _is_in_window(situation)
    if name == "camera":
        return _has_same_camera(situation.scene, start.scene)
    return _names(situation.settings)[name] == _names(start.settings)[name]


def _names(settings: Settings) -> dict[str, str]:
    """Return methods by family: a table of depths runs a function of its own, which has a method's name."""
    return {name: str(value) for name, value in vars(settings).items()}


def _has_same_camera(one: AnyScene, other: AnyScene) -> bool:
    if isinstance(one, ClipScene) or isinstance(other, ClipScene):
        return isinstance(one, ClipScene) and isinstance(other, ClipScene)
    mine, its = vars(one.camera), vars(other.camera)
    return all(np.array_equal(mine[name], its[name]) for name in mine)


def _is_same_scene(one: AnyScene, other: AnyScene) -> bool:
    if one is other:
        return True
    if isinstance(one, ClipScene) and isinstance(other, ClipScene):
        return bool(one.clip.shape == other.clip.shape and np.allclose(one.clip, other.clip))
    return bool(np.array_equal(render(one).color, render(other).color))


def _is_in_window(situation: Situation) -> bool:
    """Return whether every corner lies in the window."""
    scene = situation.scene
    clip = scene.clip if isinstance(scene, ClipScene) else situation.run.source.geometry.vertices.clip
    window = window_of_clip(np.asarray(clip, float), scene.size)
    is_in = (window[..., :2] >= -ROUNDING) & (window[..., :2] <= np.array(scene.size) + ROUNDING)
    return bool(is_in.all() and (window[..., 3] > 0).all())


_HOLDS: dict[str, Callable[[UntilPart, Situation, Situation], bool]] = {
    "stage": _stage,
    "pixel": _pixel,
    "settings": _settings,
    "keeps": _keeps,
    "here": _here,
    "some": _some,
    "none": _none,
    "count": _count,
    "least": _least,
    "most": _most,
    "pixels": _pixels,
    "tested": _tested,
    "decisions": _decisions,
    "same": _same,
    "fails": _fails,
    "holds": _right,
}
"""By key of `UntilPart`, what it asks; what is asked first costs least."""
_ORDER = tuple(_HOLDS)


# What a step of a lesson asks, as a question of the exercises: with the same kinds of answer and the same
# judge.


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
