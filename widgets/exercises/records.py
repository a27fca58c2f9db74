"""What the Exercises page shows: its catalogue, a question, the forms of answers, and what a check found."""

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum

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


AnswerForm = PixelForm | FieldForm | OrderForm | ChoiceForm


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


AnswerMarks = PixelMarks | FieldMarks | ItemMarks
