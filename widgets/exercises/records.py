"""What the Exercises page shows: its catalogue, a question, and what a check found."""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from core.records.sketch import Sketch
from widgets.grid.buffer import GridBuffer

Pixel = tuple[int, int]
"""Column and row; row 0 is the bottom row."""
Pixels = frozenset[Pixel]


class Standing(Enum):
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
    standing: Standing = Standing.NEW
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
        return sum(entry.standing is Standing.SOLVED for entry in self.entries)


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
