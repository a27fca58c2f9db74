"""What the four lectures show: every heading, with the lessons and steps that cover it, or the reason why none does."""

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from lessons.course.lesson_file import Lesson

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
