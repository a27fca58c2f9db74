"""What the Exercises page and the pane of a lesson show: catalogue, question, step, and what a check found."""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from core.records.cells import Sketch
from widgets.grid.layers import GridBuffer

# What the Exercises page shows: its catalogue, a question, and what a check found.


Pixel = tuple[int, int]
"""Column and row; row 0 is the bottom row."""
Pixels = frozenset[Pixel]


class ExerciseStanding(Enum):
    """How far somebody is with an exercise; the value is the word for it."""

    NEW = "not tried"
    BEGUN = "begun"
    MISSED = "missed"
    SOLVED = "solved"


@dataclass(frozen=True)
class ExerciseEntry:
    """One exercise of the catalogue."""

    name: str
    title: str
    points: str
    """As ``4 points``."""
    standing: ExerciseStanding = ExerciseStanding.NEW
    subject: str = ""
    """Heading under which it stands within its group, the same as that of its neighbours; empty: none."""


@dataclass(frozen=True)
class ExerciseGroup:
    """The exercises of one stage."""

    name: str
    title: str
    entries: tuple[ExerciseEntry, ...]

    @property
    def solved(self) -> int:
        """How many are solved."""
        return sum(entry.standing is ExerciseStanding.SOLVED for entry in self.entries)


@dataclass(frozen=True)
class QuestionRecord:
    """What is asked."""

    title: str
    mark: str
    """Name, version and seed: the line that gives the same question everywhere."""
    text: str
    given: str
    credit: str
    """The points, and how they are given."""
    sketch: Sketch | None = None
    """Of the plane that is asked about; ``None``: there is none."""


@dataclass(frozen=True)
class Feedback:
    """What a check found."""

    heading: str
    """As ``3.2 of 4 points``."""
    counts: str
    """As ``12 right, 1 missing, 2 extra``."""
    sentences: tuple[str, ...]
    """The mistakes by name."""
    is_right: bool


# What a picture of another program is.


@dataclass(frozen=True)
class FoundRun:
    """A mistake or a method that makes a picture."""

    sentence: str
    has_run: bool
    """Whether it can be stepped beside the right run."""


@dataclass(frozen=True, eq=False)
class DiagnosisRecord:
    """A picture that another program drew of a scene, and what makes it."""

    about: str
    """The file, and what it was compared with."""
    verdict: str
    is_right: bool
    found: tuple[FoundRun, ...]
    picture: GridBuffer
    differing: NDArray[np.bool_]
    """(H, W), the pixels that are marked; row 0 at the bottom."""


# What the pane of a lesson shows: a step, what came of its task, and the end of the lesson.


MOST_WRONG = 2
"""Wrong answers after which the step that refutes the last one is offered."""


class Standing(Enum):
    """How far somebody is with a step; the value is the word for it."""

    OPEN = "open"
    SEEN = "seen"
    DONE = "done"


@dataclass(frozen=True)
class LessonStepRecord:
    """One step of a lesson, or its end."""

    title: str
    """Of the lesson."""
    text: str
    number: int
    """Of the step, from 0; below: what comes before the first; the number of steps: the end."""
    standings: tuple[Standing, ...]
    """Of all steps."""
    lead: str = ""
    """What the lesson is about, where it begins; empty: nothing."""
    task: str = ""
    """What is to be done, as ``Predict`` or in a sentence; empty: nothing."""
    links: tuple[tuple[str, str], ...] = ()
    """Address and title of what can be opened from here: exercises, pages."""
    next_title: str = ""
    """What Next opens, where it is not the next step."""
    was_done: bool = False
    """Whether the task had been done before the step was opened."""
    has_previous: bool = True
    has_next: bool = True
    """Whether anything comes before, and whether anything follows."""

    @property
    def is_done(self) -> bool:
        """Whether the task has been done since the step was opened."""
        is_step = 0 <= self.number < len(self.standings)
        return is_step and self.standings[self.number] is Standing.DONE and not self.was_done

    @property
    def place(self) -> str:
        """Where the step is in the lesson."""
        if not 0 <= self.number < len(self.standings):
            return "end" if self.number > 0 else "before"
        before = ", done before" if self.was_done else ""
        return f"{self.number + 1} of {len(self.standings)}{before}"


@dataclass(frozen=True)
class LessonFeedback:
    """What came of a task."""

    sentences: tuple[str, ...]
    is_right: bool | None = None
    """Whether it is done; ``None``: neither right nor wrong."""
