"""A lesson as it is read from its file."""

import json
from dataclasses import dataclass
from hashlib import sha256
from itertools import pairwise
from pathlib import Path

from core import STAGES
from lessons.course.record import LessonPart, StepPart
from lessons.exercises.toml_file import TomlFile

NAME_LIMIT = 60
"""Longest name of a file, without its ending."""
REVISIONS = 1_000_000


@dataclass(frozen=True, eq=False)
class Lesson:
    """One lesson; a step of it is named by its number, from 0."""

    name: str
    """Of the file."""
    part: LessonPart
    """What the file holds."""
    file: TomlFile
    """Knows the line of what is wrong."""

    @property
    def path(self) -> Path:
        """The file."""
        return self.file.path

    @property
    def title(self) -> str:
        """What it is called."""
        return self.part.title

    @property
    def question(self) -> str:
        """What one wants to know."""
        return self.part.question

    @property
    def minutes(self) -> int:
        """How long it takes, roughly."""
        return self.part.minutes

    @property
    def steps(self) -> list[StepPart]:
        """From the first to the last."""
        return self.part.step

    @property
    def stage(self) -> str:
        """The first stage that it shows."""
        return self.part.state.stage or self.steps[0].state.stage or STAGES[0]

    @property
    def revision(self) -> int:
        """A number that differs where another step is asked, and stays where only texts change."""
        asked = [
            [step.kind, json.dumps(self.file.values["step"][number].get("answer"), sort_keys=True)]
            for number, step in enumerate(self.steps)
        ]
        digest = sha256(json.dumps(asked).encode()).digest()
        return 1 + int.from_bytes(digest[:8], "big") % (REVISIONS - 1)

    def step_name(self, number: int) -> str:
        """Return the name under which a step stands among the attempts."""
        return f"{STEP_PREFIX}{self.name}/{number + 1}"


STEP_PREFIX = "lesson/"


def read_lesson(path: Path) -> Lesson:
    """Return the lesson of a file.

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
    lesson = Lesson(stem, file.checked(LessonPart), file)
    for number, (one, other) in enumerate(pairwise(lesson.steps), 1):
        if one.kind == other.kind == "look":
            raise file.error(
                ("step", number, "kind"), "expected a task after a step to look at, got another look"
            )
    return lesson
