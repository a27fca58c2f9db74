"""The lessons that ship with the program, in the order of learning: files, minutes, and the slides that they cover."""

import json
import re
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache, cached_property
from hashlib import sha256
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

from core import STAGES
from lessons.exercises.toml_file import TomlFile
from lessons.named_files import read_files, read_folders

if TYPE_CHECKING:
    from lessons.course.record import LessonPart, StepPart

# A lesson as it is read from its file.


NAME_LIMIT = 60
"""Longest name of a file, without its ending."""
REVISIONS = 1_000_000


@dataclass(frozen=True, eq=False)
class Lesson:
    """One lesson; a step of it is named by its number, from 0.

    To be listed, a lesson that ships with the program is read to its first step; the rest is read and checked when it
    is first asked for: ValueError and OSError as `read_lesson`.
    """

    name: str
    """Of the file."""
    path: Path
    """The file."""
    head: Mapping[str, Any]
    """What it says before its first step, at least."""
    step_count: int

    @cached_property
    def file(self) -> TomlFile:
        """What is written; it knows the line of what is wrong."""
        return TomlFile(self.path)

    @cached_property
    def part(self) -> "LessonPart":
        """What is written, as a record."""
        return _checked(self.file)

    @property
    def title(self) -> str:
        """What it is called."""
        return str(self.head["title"])

    @property
    def question(self) -> str:
        """What one wants to know."""
        return str(self.head["question"]).strip()

    @property
    def minutes(self) -> int:
        """How long it takes, roughly."""
        return int(self.head["minutes"])

    @property
    def steps(self) -> "list[StepPart]":
        """From the first to the last."""
        return self.part.step

    def written_steps(self) -> list[dict[str, Any]]:
        """Return the steps as they stand in the file, which takes no check."""
        return list(self.file.values["step"])

    @property
    def stage(self) -> str:
        """The first stage that it shows."""
        return self.head.get("state", {}).get("stage") or self.steps[0].state.stage or STAGES[0]

    @property
    def revision(self) -> int:
        """A number that differs where another step is asked, and stays where only texts change."""
        asked = [
            [step["kind"], json.dumps(step.get("answer"), sort_keys=True)] for step in self.written_steps()
        ]
        digest = sha256(json.dumps(asked).encode()).digest()
        return 1 + int.from_bytes(digest[:8], "big") % (REVISIONS - 1)

    def step_name(self, number: int) -> str:
        """Return the name under which a step stands among the attempts."""
        return f"{STEP_PREFIX}{self.name}/{number + 1}"


STEP_PREFIX = "lesson/"


def read_lesson(path: Path) -> Lesson:
    """Return the lesson of a file, read whole.

    Raises ValueError for what is no lesson: one sentence with file, line and what was expected; OSError if the file
    cannot be read. Whether its scenes, events, answers and numbers hold is said by `lessons.course.validation`.
    """
    stem = path.stem
    if not stem or len(stem) > NAME_LIMIT or not all(c.isascii() and (c.isalnum() or c == "-") for c in stem):
        raise ValueError(
            f"{str(path)!a}: expected a name of letters, digits and hyphens, up to {NAME_LIMIT} of them"
        )
    file = TomlFile(path)
    if "step" not in file.values:
        raise ValueError(f"{path}: line 1: expected a lesson, with [[step]]")
    part = _checked(file)
    lesson = Lesson(stem, path, file.values, len(part.step))
    vars(lesson).update(file=file, part=part)  # What is asked for later is here already.
    return lesson


def _checked(file: TomlFile) -> "LessonPart":
    """Return a lesson as a record; ValueError for what is none."""
    from lessons.course.record import LessonPart  # With all that its names are compared with: not for a list.

    part = file.checked(LessonPart)
    for number, (one, other) in enumerate(pairwise(part.step), 1):
        if one.kind == other.kind == "look":
            raise file.error(
                ("step", number, "kind"), "expected a task after a step to look at, got another look"
            )
    return part


_STEP = re.compile(r"^\[\[step\]\]$", re.MULTILINE)


def _listed(path: Path) -> Lesson:
    """Return a lesson that ships with the program, read to its first step."""
    head, *steps = _STEP.split(path.read_text(encoding="utf-8"))
    return Lesson(path.stem, path, tomllib.loads(head, parse_float=str), len(steps))


# How long a lesson takes: a plain sum over its steps, so that the minutes of all lessons mean the same.


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


def _seconds(step: "StepPart") -> float:
    from lessons.course.record import word_count

    words = sum(word_count(text) for text in (step.text, step.task, step.after) if text)
    seconds = LOOK + 60 * words / WORDS_A_MINUTE
    if step.answer is not None:
        count = len(step.answer.values) if step.answer.type == "numbers" else 1
        return seconds + ANSWERS.get(step.answer.type, NUMBER + EACH * count)
    return seconds + {"do": TASK, "break": TASK, "measure": MEASURE}.get(step.kind, 0)


# What the four lectures show: every heading, with the lessons and steps that cover it, or the reason why
# none does.


PATH = Path(__file__).with_name("slides.toml")


@dataclass(frozen=True)
class Slide:
    """A heading of a lecture."""

    name: str
    """As lessons name it: ``Zwicker: Shared edges``."""
    reason: str = ""
    """Why no lesson covers it."""


@cache
def slides() -> tuple[Slide, ...]:
    """Return all headings, lecture by lecture."""
    with PATH.open("rb") as file:
        lectures = tomllib.load(file)
    return tuple(
        Slide(f"{lecture}: {heading}", value if isinstance(value, str) else "")
        for lecture, rows in lectures.items()
        for heading, value in rows.items()
    )


@cache
def headings() -> frozenset[str]:
    """Return the names of all headings."""
    return frozenset(slide.name for slide in slides())


def coverage(lessons: Iterable[Lesson]) -> dict[str, list[str]]:
    """Return by heading where lessons cover it: ``shared-edges``, or a step as ``shared-edges/3``."""
    found: dict[str, list[str]] = {slide.name: [] for slide in slides()}
    for lesson in lessons:
        for name in lesson.part.covers:
            found.setdefault(name, []).append(lesson.name)
        for number, step in enumerate(lesson.steps, 1):
            for name in step.covers:
                found.setdefault(name, []).append(f"{lesson.name}/{number}")
    return found


# The lessons that ship with the program, in the order of learning, and those of a lecturer's own folders.


FOLDER = Path(__file__).parent
DATA = ("order.toml", "slides.toml")
"""Files of the folder that are no lessons."""
FILE_LIMIT = 100
"""Most lessons of a folder."""


@dataclass(frozen=True, eq=False)
class Course:
    """Lessons by name in the order in which they are listed, and what could not be read."""

    lessons: dict[str, Lesson]
    problems: tuple[str, ...] = ()
    """A sentence for each file or folder that was skipped: which one, where, and what was expected."""

    def named(self, name: str) -> Lesson:
        """Return a lesson; ValueError where there is none."""
        if name not in self.lessons:
            near = get_close_matches(name, self.lessons) or list(self.lessons)[:1]
            raise ValueError(f"expected a lesson such as {', '.join(near)}, got {name!r:.60}")
        return self.lessons[name]

    def after(self, lesson: Lesson) -> Lesson | None:
        """Return the lesson that follows: the one that it names, or the next of the list; ``None``: there is none."""
        if "next" in lesson.head:
            return self.lessons.get(lesson.head["next"]["lesson"])
        names = list(self.lessons)
        place = names.index(lesson.name) + 1 if lesson.name in self.lessons else len(names)
        return self.lessons[names[place]] if place < len(names) else None

    def recalled(self, lesson: Lesson) -> Lesson | None:
        """Return the lesson that the exercise before a lesson is about; ``None``: none is known."""
        if "recall_of" in lesson.head:
            return self.lessons.get(lesson.head["recall_of"])
        asked = lesson.head.get("recall")
        others = (each for each in self.lessons.values() if each is not lesson)
        return next((each for each in others if asked in each.head.get("exercises", ())), None)

    @property
    def by_stage(self) -> dict[str, list[Lesson]]:
        """All lessons under the stage in which each begins, in the order of the stages."""
        found: dict[str, list[Lesson]] = {stage: [] for stage in STAGES}
        for lesson in self.lessons.values():
            found[lesson.stage].append(lesson)
        return {stage: lessons for stage, lessons in found.items() if lessons}


def chapters() -> dict[str, list[str]]:
    """Return the names of the lessons in the order of learning, chapter by chapter."""
    order: dict[str, list[str]] = _ordered()["order"]
    return dict(order)


@dataclass(frozen=True)
class Exploration:
    """A step that surprises on its own."""

    title: str
    lesson: str
    """Name of the lesson."""
    step: int
    """From 0."""


def explorations() -> tuple[Exploration, ...]:
    """Return the steps to be tried with two minutes to spend."""
    places = {title: place.split("/") for title, place in _ordered()["explorations"].items()}
    return tuple(Exploration(title, name, int(step) - 1) for title, (name, step) in places.items())


@cache
def _ordered() -> dict[str, Any]:
    return tomllib.loads((FOLDER / "order.toml").read_text(encoding="utf-8"))


@cache
def shipped() -> Course:
    """Return the lessons that ship with the program, listed once; those that are not in the order come last."""
    paths = [path for path in sorted(FOLDER.glob("*.toml")) if path.name not in DATA]
    found, problems = read_files(paths, _listed, "a lesson", {})
    order = [name for names in chapters().values() for name in names]
    names = [name for name in order if name in found] + [name for name in found if name not in order]
    return Course({name: found[name] for name in names}, tuple(problems))


def with_folders(folders: Iterable[Path]) -> Course:
    """Return the shipped lessons, then those of folders, whose ``.toml`` files all are lessons."""
    course = shipped()
    found, problems = read_folders(folders, read_lesson, "a lesson", FILE_LIMIT, course.lessons)
    return Course(course.lessons | found, (*course.problems, *problems))
