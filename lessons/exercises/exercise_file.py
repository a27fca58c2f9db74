"""Exercises that teachers write as TOML: read, checked, and drawn as questions."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from core import Settings, render
from core.records.frame import Frame
from core.scene import AnyScene, ClipScene
from core.settings import settings_from_texts
from lessons.exercises.answers.amounts import NumberAnswer
from lessons.exercises.answers.answer import Answer
from lessons.exercises.answers.choices import ChoiceAnswer, OrderAnswer
from lessons.exercises.answers.pixels import NothingToMarkError, PixelAnswer, Pixels, read_art
from lessons.exercises.answers.tables import Column, TableAnswer
from lessons.exercises.draws import Draws
from lessons.exercises.numbers import number_text
from lessons.exercises.question import Draft, Template, ask
from lessons.exercises.record import Exercise, PixelPart, ScenePart
from lessons.exercises.toml_file import TomlFile
from lessons.mistakes.shelf import SHELF
from lessons.scenes import make_scene
from lessons.small_scenes import segment_scene, triangle_scene

NAME_LIMIT = 100
"""Longest name of a file, without its ending."""


def read_exercise(path: Path) -> Template:
    """Return the exercise of a file.

    Raises
    ------
    ValueError
        For what is no exercise, or cannot draw its question; the message is one sentence with file, line and what was
        expected.
    OSError
        If the file cannot be read.
    """
    if not path.stem.isprintable() or path.stem != path.stem.strip() or len(path.stem) > NAME_LIMIT:
        raise ValueError(f"{str(path)!a}: expected a name of up to {NAME_LIMIT} printable characters")
    file = TomlFile(path)
    exercise = file.checked(Exercise)
    if exercise.mistakes and not (isinstance(exercise.answer, PixelPart) and exercise.answer.art is None):
        raise file.error(("mistakes",), "expected an answer that is found by drawing: pixels without art")
    if isinstance(exercise.answer, PixelPart) and exercise.answer.art is None and exercise.scene is None:
        raise file.error(("answer",), "expected art, or a scene to draw")
    template = Template(
        path.stem,
        exercise.version,
        exercise.title,
        exercise.stage,
        exercise.points,
        lambda draws: draft_of(exercise, draws),
        is_fixed=not has_ranges(exercise),
    )
    try:
        ask(template, 0)
    except ValueError as problem:
        raise file.error(
            ("mistakes",) if "cannot draw" in str(problem) else ("answer",), str(problem)
        ) from None
    return template


def has_ranges(exercise: Exercise) -> bool:
    """Return whether seeds give different questions."""
    if exercise.answer.type == "order":
        return True
    primitives = [] if exercise.scene is None else [*exercise.scene.triangles, *exercise.scene.segments]
    return any(one.low < one.high for corners in primitives for place in corners for one in place)


def draft_of(exercise: Exercise, draws: Draws) -> Draft | None:
    """Draw the question of an exercise; ``None``: this draw covers no pixel, or all."""
    scene, given = (None, "") if exercise.scene is None else drawn_scene(exercise.scene, draws)
    mistakes: dict[str, Pixels] = {}
    part = exercise.answer
    answer: Answer
    if isinstance(part, PixelPart):
        try:
            answer, mistakes = _pixel_answer(exercise, part, scene)
        except NothingToMarkError:
            if has_ranges(exercise):
                return None
            raise
    elif part.type == "numbers":
        count = len(part.values)
        shape = (part.rows, count // part.rows) if part.rows > 1 else (count,) if count > 1 else ()
        answer = NumberAnswer(tuple(part.values), shape, tuple(part.names), part.tolerance)
    elif part.type == "table":
        cells = tuple(tuple(("", number) for number in row) for row in part.cells)
        columns = tuple(Column(name) for name in part.columns)
        answer = TableAnswer(columns, tuple(part.labels), cells, tolerance=part.tolerance)
    elif part.type == "order":
        answer = OrderAnswer(tuple(part.items), draws.shuffled(part.items))
    else:
        right = frozenset(part.options.index(option) for option in part.right)
        answer = ChoiceAnswer(tuple(part.options), right, part.several)
    settings = settings_from_texts(exercise.settings, Settings())
    return Draft(exercise.question, given, answer, tuple(exercise.hints), mistakes, scene, settings)


def drawn_scene(part: ScenePart, draws: Draws) -> tuple[AnyScene, str]:
    """Draw the places of a scene; return it and its numbers as text."""
    columns, rows = part.size
    if part.builtin is not None:
        return replace(
            make_scene(part.builtin), size=(columns, rows)
        ), f"Scene {part.builtin}, {columns} x {rows} pixels."
    kind, primitives = ("Triangle", part.triangles) if part.triangles else ("Segment", part.segments)
    places = [[[one.draw(draws) for one in place] for place in corners] for corners in primitives]
    lines = [f"Window of {columns} x {rows} pixels, row 0 at the bottom."]
    for number, corners in enumerate(places):
        texts = ", ".join(f"({number_text(x)}, {number_text(y)})" for x, y in corners)
        lines.append(f"{kind} {number}: {texts}")
    corners_of = np.array(places, float)
    if part.triangles:
        return triangle_scene(corners_of, (columns, rows)), "\n".join(lines)
    return segment_scene([(tuple(a), tuple(b)) for a, b in corners_of.tolist()], (columns, rows)), "\n".join(
        lines
    )


def seen_pixels(frame: Frame, triangle: int | None = None) -> Pixels:
    """Return the pixels where anything, or one triangle, is seen."""
    is_seen = frame.primitive >= 0 if triangle is None else frame.primitive == triangle
    return frozenset((column, row) for row, column in np.argwhere(is_seen).tolist())


def _pixel_answer(
    exercise: Exercise, part: PixelPart, scene: AnyScene | None
) -> tuple[PixelAnswer, dict[str, Pixels]]:
    """Return the answer and those of the mistakes, from text art or by drawing the scene."""
    if part.art is not None:
        marks = read_art(part.art)
        columns, rows = (1 + max(place) for place in zip(*marks, strict=True))
        of = {mark: frozenset(pixel for pixel, its in marks.items() if its == mark) for mark in "#?"}
        return PixelAnswer((columns, rows), of["#"], of["?"], part.noun), {}
    assert scene is not None
    settings = settings_from_texts(exercise.settings, Settings())
    answer = PixelAnswer(scene.size, seen_pixels(render(scene, settings), part.triangle))
    if exercise.mistakes and not isinstance(scene, ClipScene):
        raise ValueError("expected triangles or segments in the window where mistakes are named, got a mesh")
    wrong = {
        name: seen_pixels(SHELF[name].draw(scene, settings), part.triangle)
        for name in exercise.mistakes
        if isinstance(scene, ClipScene)
    }
    return answer, wrong
