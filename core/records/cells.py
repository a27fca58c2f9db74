"""The cells that an answer is given in, what a check found of them, and what is sketched beside a question."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any, Literal

# The cells that an answer is given in, and what a check found of them: the same from the exercise to its
# form.


Marks = Mapping[str, Collection[Any]]
"""By ``right``, ``wrong``, ``missing``, ``extra`` or ``double``, what is so: pixels as (column, row), fields as (row,
column), items of a list by their number."""
CellKind = Literal["number", "crossing", "codes", "pixel", "place", "choice", "dial"]


@dataclass(frozen=True)
class Cell(ABC):
    """One value of an answer."""

    label: str
    """What is asked for, as ``the next pixel``; empty: the value stands alone."""
    kind: CellKind = "number"
    right: Any = None
    """The right value; ``None``: another one, or a run, decides."""
    options: tuple[str, ...] = ()
    """Of a choice."""
    tolerance: float = 0.0
    """Largest difference of each number, absolute."""

    @abstractmethod
    def read(self, given: object) -> Any:
        """Return the value that a text or an entry of a file means; ValueError with a sentence: it means none."""

    @abstractmethod
    def text(self, value: Any) -> str:
        """Return a value as it was understood: ``1/3 (0.3333)``."""

    @abstractmethod
    def typed(self, value: Any) -> str:
        """Return a value as somebody would type it."""

    def understood(self, given: str) -> str:
        """Return how an answer was read, as text; ValueError with a sentence where it means nothing."""
        return self.text(self.read(given))


@dataclass(frozen=True)
class Lattice(Cell):
    """A number that is changed in steps."""

    @property
    @abstractmethod
    def count(self) -> int:
        """How many values it has."""

    @property
    @abstractmethod
    def values(self) -> str:
        """What it can be, as ``0 to 8 in steps of 1/4``."""

    @abstractmethod
    def value(self, index: int) -> Any:
        """Return one of its values."""

    @abstractmethod
    def index(self, value: Any) -> int:
        """Return the index of one of its values."""

    @abstractmethod
    def nearest(self, value: float) -> int:
        """Return the index of its value that is nearest to a number."""


@dataclass(frozen=True)
class Corner:
    """A corner on the picture whose coordinates are cells; ``None``: that coordinate stays."""

    name: str
    x: int | None
    y: int | None
    at: Callable[[list[str]], tuple[float, float]]
    """Its place in the window, from the texts of all cells."""


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
    open: Cell | None
    """The step that is asked; ``None``: all are done."""
    number: int
    """Of the step that is asked, or of all steps."""
    is_missed: bool
    """The last try at it was wrong."""
    pixels: frozenset[tuple[int, int]]
    """Pixels of the steps that are done."""


@dataclass(frozen=True, eq=False)
class Form:
    """What an answer is given in: its cells, and how they are laid out."""

    kind: str
    """Of the answer, as files name it: it says which editor takes the cells."""
    cells: tuple[tuple[Cell, ...], ...] = ()
    """Row by row."""
    columns: tuple[str, ...] = ("",)
    """Heads of the columns."""
    labels: tuple[str, ...] = ()
    """Of the rows."""
    items: tuple[str, ...] = ()
    """The things to choose, sort or point at, in the order of the list."""
    is_several: bool = False
    """Whether several items may be chosen."""
    size: tuple[int, int] = (1, 1)
    """Columns and rows of the raster, or of the window in which points lie."""
    noun: str = "pixels"
    start: tuple[str, ...] = ()
    """What cells begin with."""
    corners: tuple[Corner, ...] = ()
    names: tuple[tuple[str, ...], ...] = ()
    """Of the options of each cell, where their titles are other."""
    snapped: Callable[[float], str] = str
    """The text of the nearest coordinate that a point can have."""
    told: Callable[[Any], str] | None = None
    """The sentence shown beside a complete answer before it is checked."""
    state: Callable[[Any], StepsState] | None = None
    """From the tries of every step so far; ValueError with a sentence where the last try means nothing."""


# Points and outlines in a plane or in space: what somebody would sketch beside a question.


Place = tuple[float, ...]
"""x and y, and z in space."""
LEAST_REACH = 4.0


@dataclass(frozen=True)
class Sketch:
    """A plane with both axes, x to the right and y up; or space, with z towards the viewer."""

    points: tuple[tuple[str, Place], ...] = ()
    """Each with its name."""
    outlines: tuple[tuple[Place, ...], ...] = ()
    """Closed; of two places, a segment."""

    @property
    def is_space(self) -> bool:
        """Whether the places have a z."""
        return any(len(place) == 3 for _, place in self.points)

    @property
    def reach(self) -> float:
        """How far the farthest coordinate is from an axis; in a plane at least as far as questions like to go."""
        places = [place for _, place in self.points] + [
            place for outline in self.outlines for place in outline
        ]
        return max([1.0 if self.is_space else LEAST_REACH, *(abs(c) for place in places for c in place)])

    def with_point(self, name: str, place: Place) -> "Sketch":
        """Return the sketch with one more point."""
        return Sketch((*self.points, (name, place)), self.outlines)

    @property
    def text(self) -> str:
        """What is drawn, in words."""
        said = [f"{name} at {_text(place)}" for name, place in self.points]
        said += [" to ".join(map(_text, outline)) for outline in self.outlines]
        return "; ".join(["space with three axes" if self.is_space else "a plane with both axes", *said])


def _text(place: Place) -> str:
    return f"({', '.join(f'{c:.4g}' for c in place)})"
