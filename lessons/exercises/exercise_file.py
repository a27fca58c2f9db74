"""Exercises that teachers write as TOML, one by one or in folders: read, checked, and drawn as questions."""

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

from core import Settings
from core.scene import AnyScene, ClipScene
from core.setting_texts import settings_from_texts
from lessons import named_files
from lessons.exercises.answers.listings import CodeAnswer
from lessons.exercises.answers.marked import Pixels
from lessons.exercises.drafting import Corner, draw_scene, factor_text, seen_pixels
from lessons.exercises.file_answers import answer_of
from lessons.exercises.numbers import Draws, NoQuestionError
from lessons.exercises.question import Draft, Template, ask
from lessons.exercises.record import AnswerPart, ChoicePart, Exercise, PixelPart, PlacePart
from lessons.exercises.toml_file import TomlFile
from lessons.mistakes.shelf import SHELF

# Exercises that teachers write as TOML: read, checked, and drawn as questions.


NAME_LIMIT = 100
"""Longest name of a file, without its ending."""
REVISIONS = 1_000_000
"""How many revisions a file can have that names none: short numbers, to be read out."""
ASKED = ("question", "mistakes", "scene", "settings", "answer")
"""What a seed draws from, and what is right: titles, points and hints may change."""
COORDINATE = r"\{([xy])([0-9])\}"
"""Stands in a hint for a coordinate of a corner of the first triangle or segment."""


def read_exercise(path: Path, revision: int | None = None) -> Template:
    """Return the exercise of a file, of a ``revision`` where it names none; ``None``: by what it asks.

    Raises ValueError for what is no exercise, or cannot draw its question; the message is one sentence with file, line
    and what was expected; OSError if the file cannot be read.
    """
    if not path.stem.isprintable() or path.stem != path.stem.strip() or len(path.stem) > NAME_LIMIT:
        raise ValueError(f"{str(path)!a}: expected a name of up to {NAME_LIMIT} printable characters")
    file = TomlFile(path)
    exercise = file.checked(Exercise)
    if exercise.mistakes and not (isinstance(exercise.answer, PixelPart) and exercise.answer.art is None):
        raise file.error(("mistakes",), "expected an answer that is found by drawing: pixels without art")
    for found in re.finditer(COORDINATE, "".join(exercise.hints)):
        if int(found[2]) not in _given_corners(exercise):
            raise file.error(("hints",), f"expected coordinates that the scene gives, got {found[0]}")
    if (
        isinstance(exercise.answer, ChoicePart)
        and exercise.answer.cases
        and "{case}" not in exercise.question
    ):
        raise file.error(("question",), "expected {case} where the cases of the answer stand")
    template = Template(
        path.stem,
        exercise.revision or revision or _revision_of(file.values),
        exercise.title,
        exercise.stage,
        exercise.points,
        lambda draws: draft_of(exercise, draws),
        is_fixed=not (has_ranges(exercise) or exercise.answer.type in ("order", "choice", "spot")),
        path=str(path.absolute()),
    )
    try:
        ask(template, 0)
    except ValueError as problem:
        raise file.error(
            ("mistakes",) if "cannot draw" in str(problem) else ("answer",), str(problem)
        ) from None
    return template


def _revision_of(values: Mapping[str, Any]) -> int:
    """Return a number that differs where something else is asked."""
    asked = json.dumps([values.get(name) for name in ASKED], sort_keys=True)
    return 1 + int.from_bytes(sha256(asked.encode()).digest()[:8], "big") % (REVISIONS - 1)


def has_ranges(exercise: Exercise) -> bool:
    """Return whether the scene is drawn from ranges."""
    return exercise.scene is not None and exercise.scene.has_ranges


def draft_of(exercise: Exercise, draws: Draws) -> Draft:
    """Draw the question of an exercise; NoQuestionError: this draw makes none, but another may."""
    drawn = None if exercise.scene is None else draw_scene(exercise.scene, draws)
    settings = settings_from_texts(exercise.settings, Settings())
    part, text, told = exercise.answer, exercise.question, exercise.hints
    if isinstance(part, ChoicePart) and part.cases:
        case = draws.item(part.cases)
        part = part.model_copy(update={"right": [case.right]})
        text, *told = (one.replace("{case}", case.ask) for one in (text, *told, *filter(None, [case.hint])))
    try:
        answer, given = answer_of(part, drawn, settings, draws)
    except NoQuestionError as problem:
        if has_ranges(exercise):
            raise
        raise ValueError(str(problem)) from None
    scene = None if drawn is None else drawn.scene
    mistakes: dict[str, Any] = {}
    if isinstance(answer, CodeAnswer):
        mistakes = answer.named_mistakes
    elif scene is not None:
        mistakes = dict(wrong_pixels(part, exercise.mistakes, scene, settings))
    # The outline of a scene is shown while its question is asked: not where it would show a corner to be placed.
    is_hidden = isinstance(exercise.answer, PlacePart) and bool(exercise.answer.corner)
    drawn_of = None if is_hidden else scene
    corners = drawn.places[0] if drawn and drawn.places else ()
    hints = tuple(_with_coordinates(hint, corners) for hint in told)
    reveal = part.notes.get(part.right[0], "") if isinstance(part, ChoicePart) and not part.several else ""
    return Draft(text, given, answer, hints, mistakes, drawn_of, settings, reveal=reveal)


def _given_corners(exercise: Exercise) -> set[int]:
    """Return which corners of the first triangle or segment the question shows."""
    scene, answer = exercise.scene, exercise.answer
    first = [] if scene is None else [*scene.triangles, *scene.segments, []][0]
    hidden = answer.corner[1:] if isinstance(answer, PlacePart) and answer.corner[:1] == [0] else []
    return {*range(len(first))} - {*hidden}


def _with_coordinates(hint: str, corners: Sequence[Corner]) -> str:
    """Return a hint with the coordinates that it names, such as ``{x0}``."""
    return re.sub(COORDINATE, lambda found: factor_text(corners[int(found[2])]["xy".index(found[1])]), hint)


def wrong_pixels(
    answer: AnswerPart, mistakes: Sequence[str], scene: AnyScene, settings: Settings
) -> dict[str, Pixels]:
    """Return what mistakes make of a scene whose pixels are to be marked; ValueError where they cannot be drawn."""
    if not mistakes:
        return {}
    if not isinstance(scene, ClipScene):
        raise ValueError("expected triangles or segments in the window where mistakes are named, got a mesh")
    if not isinstance(answer, PixelPart) or answer.art is not None:
        raise ValueError("expected an answer that is found by drawing: pixels without art")
    return {name: seen_pixels(SHELF[name].draw(scene, settings), answer.triangle) for name in mistakes}


# Folders of exercises that teachers write: TOML only, of which nothing runs as code.


FILE_LIMIT = 300
"""Most files of a folder: each is drawn once."""


def read_folders(
    folders: Iterable[Path], shipped: Mapping[str, Template]
) -> tuple[dict[str, Template], list[str]]:
    """Read the exercises of folders.

    Parameters
    ----------
    folders : iterable of Path
        Each holds ``.toml`` files; folders inside them are not looked into.
    shipped : mapping
        Templates that come with the program, whose names are taken.

    Returns
    -------
    dict
        Templates by name, which is that of the file, in the order of folders and names.
    list of str
        A sentence for each file or folder that was skipped: which one, where, and what was expected.
    """
    return named_files.read_folders(folders, read_exercise, "an exercise", FILE_LIMIT, shipped)
