"""What the Exercises page shows: its catalogue, a question, the forms of answers, and what a check found."""

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from core.records.sketch import Sketch
from widgets.grid.buffer import GridBuffer

Pixel = tuple[int, int]
"""Column and row; row 0 is the bottom row."""
Pixels = frozenset[Pixel]
Cell = tuple[int, int]
"""Row and column of a field in a form."""


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


# What an answer is given in.


@dataclass(frozen=True)
class Understood:
    """How a typed text is read."""

    text: str
    """As it was understood, or why it means nothing yet."""
    is_readable: bool


@dataclass(frozen=True)
class PixelForm:
    """Pixels of a raster, or blocks."""

    size: tuple[int, int]
    noun: str
    read_columns: Callable[[str], frozenset[int]]
    """Columns of a text such as ``3-7, 9``; ValueError with a sentence where it means nothing."""


@dataclass(frozen=True)
class FieldForm:
    """Fields in rows and columns: a number, a vector, a matrix, a table."""

    columns: tuple[str, ...]
    labels: tuple[str, ...]
    """Of the rows."""
    understand: Callable[[int, str], Understood]
    """From a column and a text to what it means."""


@dataclass(frozen=True)
class OrderForm:
    """Things to be put in order, as they are listed at first."""

    items: tuple[str, ...]


@dataclass(frozen=True)
class ChoiceForm:
    """Options."""

    options: tuple[str, ...]
    is_several: bool


@dataclass(frozen=True)
class PlaceForm:
    """Points to be placed in the window."""

    size: tuple[int, int]
    names: tuple[str, ...]
    snapped: Callable[[float], str]
    """The text of the nearest coordinate that a point can have."""
    number: Callable[[str], float | None]
    """The coordinate that a text means; ``None``: it means nothing."""
    understand: Callable[[int, str], Understood]


@dataclass(frozen=True)
class ListingForm:
    """Lines of a listing, of which one is pointed at."""

    lines: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class SpotForm:
    """A picture in which pixels are pointed at, and options of what is wrong with it."""

    pixels: PixelForm
    picture: GridBuffer
    options: tuple[str, ...]


@dataclass(frozen=True)
class StepLine:
    """One step of a run that the learner goes."""

    prompt: str
    tries: str
    """What was tried so far."""
    standing: str
    """``right``, ``wrong`` and tried again, ``fixed``, ``open`` or empty: it comes later."""


@dataclass(frozen=True)
class StepsState:
    """How far a run is."""

    lines: tuple[StepLine, ...]
    open: int | None
    """The step that is asked; ``None``: all are done."""
    kind: str = ""
    """What it asks for: ``pixel``, ``number``, ``choice`` or ``place``."""
    options: tuple[str, ...] = ()
    is_missed: bool = False
    """The last try at it was wrong."""
    pixels: Pixels = frozenset()
    """Pixels of the steps that are done."""


@dataclass(frozen=True)
class StepsForm:
    """A run gone by the learner, step by step."""

    state: Callable[[list[list[str]]], StepsState]
    """From the tries of every step so far; ValueError with a sentence where the last try means nothing."""


@dataclass(frozen=True)
class DialRecord:
    """One number that can be changed in steps."""

    name: str
    count: int
    """How many values it has."""
    text: Callable[[int], str]
    """The text of a value, by its place from 0."""
    place: Callable[[str], int]
    """The place of the value that a text means; ValueError with a sentence where it means none."""
    values: str
    """What it can be, as ``0 to 8 in steps of 1/4``."""


@dataclass(frozen=True)
class CornerRecord:
    """A corner on the picture whose coordinates are dials; ``None``: that coordinate stays."""

    name: str
    x: int | None
    y: int | None
    at: Callable[[list[str]], tuple[float, float]]
    """Its place in the window, from the texts of all dials."""


@dataclass(frozen=True)
class DialForm:
    """Numbers to be changed until something happens."""

    dials: tuple[DialRecord, ...]
    start: tuple[str, ...]
    corners: tuple[CornerRecord, ...]
    snapped: Callable[[int, float], str]
    """The text of the nearest value of a dial."""


@dataclass(frozen=True)
class FamilyRecord:
    """Methods to choose from."""

    name: str
    title: str
    methods: tuple[tuple[str, str], ...]
    """Name and text of each, with its cost."""


@dataclass(frozen=True)
class MethodForm:
    """One method of each family."""

    families: tuple[FamilyRecord, ...]
    cost: Callable[[dict[str, str]], str]
    """What some methods cost together."""


AnswerForm = (
    PixelForm
    | FieldForm
    | OrderForm
    | ChoiceForm
    | PlaceForm
    | ListingForm
    | SpotForm
    | StepsForm
    | DialForm
    | MethodForm
)


# What is right in an answer, and what is not.


@dataclass(frozen=True)
class PixelMarks:
    """Pixels of an answer."""

    right: Pixels = frozenset()
    missing: Pixels = frozenset()
    extra: Pixels = frozenset()
    double: Pixels = frozenset()
    """Extra ones that something else covers already."""


@dataclass(frozen=True)
class FieldMarks:
    """Fields of an answer; those that are not wrong are right."""

    wrong: frozenset[Cell] = field(default_factory=frozenset)


@dataclass(frozen=True)
class ItemMarks:
    """Items of a list by their place."""

    right: frozenset[int] = frozenset()
    wrong: frozenset[int] = frozenset()
    missing: frozenset[int] = frozenset()


@dataclass(frozen=True)
class SpotMarks:
    """Pixels that were pointed at, and whether the mistake has the right name."""

    pixels: PixelMarks
    option: bool | None


@dataclass(frozen=True)
class NoMarks:
    """What a check says in words alone."""


AnswerMarks = PixelMarks | FieldMarks | ItemMarks | SpotMarks | NoMarks
