"""The lessons that ship with the program, in the order of learning, and those of a lecturer's own folders."""

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from pathlib import Path
from typing import Any

from core import STAGES
from lessons.course.lesson_file import Lesson, read_lesson
from lessons.named_files import read_files, read_folders

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
        if lesson.part.next is not None:
            return self.lessons.get(lesson.part.next.lesson)
        names = list(self.lessons)
        place = names.index(lesson.name) + 1 if lesson.name in self.lessons else len(names)
        return self.lessons[names[place]] if place < len(names) else None

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
    """Return the lessons that ship with the program, read once; those that are not in the order come last."""
    paths = [path for path in sorted(FOLDER.glob("*.toml")) if path.name not in DATA]
    found, problems = read_files(paths, read_lesson, "a lesson", {})
    order = [name for names in chapters().values() for name in names]
    names = [name for name in order if name in found] + [name for name in found if name not in order]
    return Course({name: found[name] for name in names}, tuple(problems))


def with_folders(folders: Iterable[Path]) -> Course:
    """Return the shipped lessons, then those of folders, whose ``.toml`` files all are lessons."""
    course = shipped()
    found, problems = read_folders(folders, read_lesson, "a lesson", FILE_LIMIT, course.lessons)
    return Course(course.lessons | found, (*course.problems, *problems))
