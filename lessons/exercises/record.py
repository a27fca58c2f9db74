"""The record of an exercise: what a TOML file holds, field by field, and of an answer type by type."""

from fractions import Fraction
from itertools import chain
from typing import Annotated, Literal, TypeVar

from pydantic import Field, model_validator

from core.records.depth_table import MOST_PATCHES
from core.records.words import counted
from core.scene import CORNER_COUNTS
from core.setting_texts import settings_from_texts
from lessons.exercises.answers.choices import CHOICE_LIMIT, ORDER_LIMIT
from lessons.exercises.answers.marked import SIDE_LIMIT, read_art
from lessons.exercises.numbers import SEED_LIMIT
from lessons.exercises.toml_values import (
    AnyNumber,
    Coordinate,
    ExactNumber,
    MistakeName,
    Part,
    SceneName,
    SettingTexts,
    Side,
    StageName,
    Text,
    Tolerance,
    Word,
)

# What a TOML file holds of an answer, type by type.


Index = Annotated[int, Field(ge=0, le=SIDE_LIMIT)]
Stepped = TypeVar("Stepped", "PlacePart", "BreakPart")


def _with_step(part: Stepped) -> Stepped:
    """Return a part whose step is above 0; ValueError where it is not."""
    if part.step <= 0:
        raise ValueError(f"expected a step above 0, got {part.step}")
    return part


class PixelPart(Part):
    """Pixels to mark: drawn as text art, or found by drawing the scene."""

    type: Literal["pixels"]
    art: Text | None = None
    noun: Literal["pixels", "blocks"] = "pixels"
    """What the art's marks are."""
    triangle: Annotated[int, Field(ge=0)] | None = None
    """Only the pixels where this triangle is seen; without it, all that are drawn."""

    @model_validator(mode="after")
    def _is_art(self) -> "PixelPart":
        if self.art is not None:
            read_art(self.art)
            if self.triangle is not None:
                raise ValueError("expected either art or triangle")
        elif self.noun != "pixels":
            raise ValueError("expected art that shows the blocks")
        return self


class NumberPart(Part):
    """A number, a vector or the rows of a matrix."""

    type: Literal["numbers"]
    values: list[AnyNumber] = Field(min_length=1, max_length=16)
    rows: Annotated[int, Field(ge=1, le=4)] = 1
    """Of a matrix, whose numbers are listed row by row."""
    names: list[Word] = Field(default_factory=list)
    tolerance: Tolerance = 0.0

    @model_validator(mode="after")
    def _is_complete(self) -> "NumberPart":
        if len(self.values) % self.rows:
            raise ValueError(f"expected {self.rows} rows of numbers, got {len(self.values)} numbers")
        if self.names and len(self.names) != len(self.values):
            raise ValueError(f"expected {len(self.values)} names, got {len(self.names)}")
        return self


class TablePart(Part):
    """A table of numbers."""

    type: Literal["table"]
    columns: list[Word] = Field(min_length=1, max_length=8)
    labels: list[Word] = Field(min_length=1, max_length=64)
    cells: list[list[AnyNumber]]
    tolerance: Tolerance = 0.0

    @model_validator(mode="after")
    def _is_complete(self) -> "TablePart":
        lengths = {len(row) for row in self.cells}
        if len(self.cells) != len(self.labels) or lengths != {len(self.columns)}:
            rows, cells = counted(len(self.labels), "row"), counted(len(self.columns), "cell")
            raise ValueError(f"expected {rows} of {cells}")
        return self


class OrderPart(Part):
    """Things, listed in the right order."""

    type: Literal["order"]
    items: list[Word] = Field(min_length=3, max_length=16)
    count: Annotated[int, Field(ge=3, le=ORDER_LIMIT)] | None = None
    """How many of them a question draws; left out: all."""

    @model_validator(mode="after")
    def _is_enough(self) -> "OrderPart":
        if (self.count or len(self.items)) > min(len(self.items), ORDER_LIMIT):
            raise ValueError(
                f"expected a count of up to {min(len(self.items), ORDER_LIMIT)}, got {self.count}"
            )
        return self


class CasePart(Part):
    """One of the cases that a choice is asked about."""

    ask: Text
    """Stands for ``{case}`` in the question and in the hints."""
    right: Word
    """The option that is right in this case."""
    hint: Text | None = None
    """The last hint, with the numbers of this case."""


class ChoicePart(Part):
    """Options of which one is right, or several are."""

    type: Literal["choice"]
    options: list[Word] = Field(min_length=2, max_length=24)
    right: list[Word] = Field(default_factory=list)
    several: bool = False
    cases: list[CasePart] = Field(default_factory=list, max_length=24)
    """A question draws one of them; without cases ``right`` says what is right."""
    count: Annotated[int, Field(ge=3, le=CHOICE_LIMIT)] | None = None
    """How many of the options a question with several right ones draws; left out: all."""
    notes: dict[str, Text] = Field(default_factory=dict)
    """By options, a sentence that tells why it is right or wrong, in whatever case."""

    @model_validator(mode="after")
    def _is_known(self) -> "ChoicePart":
        for option in (*self.right, *(case.right for case in self.cases), *self.notes):
            if option not in self.options:
                raise ValueError(f"expected one of the options, got {option}")
        if bool(self.right) == bool(self.cases):
            raise ValueError("expected either right or cases")
        if self.several and self.cases:
            raise ValueError("expected one right option in every case, got several = true")
        if self.count is not None and not self.several:
            raise ValueError("expected several = true where a count of the options is drawn")
        if (self.count or len(self.options)) > min(len(self.options), CHOICE_LIMIT):
            raise ValueError(f"expected a count of up to {min(len(self.options), CHOICE_LIMIT)}")
        return self


class PlacePart(Part):
    """Points to place: where they must lie, or a corner of a triangle that must cover what it covered."""

    type: Literal["places"]
    names: list[Word] = Field(default_factory=list, max_length=12)
    places: list[list[AnyNumber]] = Field(default_factory=list)
    size: list[Side] = Field(default_factory=lambda: [16, 12], min_length=2, max_length=2)
    """Columns and rows of the window; that of the scene where there is one."""
    corner: list[Index] = Field(default_factory=list)
    """Numbers of a triangle of the scene and of its corner, which the question hides."""
    tolerance: Tolerance = 0.0
    step: ExactNumber = Fraction(1, 2)

    @model_validator(mode="after")
    def _is_complete(self) -> "PlacePart":
        if bool(self.places) == bool(self.corner):
            raise ValueError("expected either places or corner")
        if self.places and (
            len(self.names) != len(self.places) or any(len(place) != 2 for place in self.places)
        ):
            raise ValueError("expected a place [x, y] for each of the names")
        if self.corner and (len(self.corner) != 2 or self.names):
            raise ValueError("expected the number of a triangle and of its corner, and no names")
        return _with_step(self)


class LinePart(Part):
    """A listing, one line of which is wrong."""

    type: Literal["line"]
    listing: Text
    wrong: Annotated[int, Field(ge=1)]
    """Number of the wrong line, from 1."""
    also: list[Annotated[int, Field(ge=1)]] = Field(default_factory=list)
    """Other lines that count as right."""

    @model_validator(mode="after")
    def _is_in_listing(self) -> "LinePart":
        count = len(self.listing.strip("\n").split("\n"))
        for line in (self.wrong, *self.also):
            if line > count:
                raise ValueError(f"expected a line from 1 to {count}, got {line}")
        return self


class CodePart(Part):
    """A listing to be repaired or written, checked on the hidden inputs of a task."""

    type: Literal["code"]
    task: Word
    """Name of what the listing must do, as ``bresenham-lecture``."""
    line: Annotated[int, Field(ge=1)] | None = None
    """Number of the line that is wrong, or missing, from 1; left out: the function is to be written."""
    wrong: Word | None = None
    """What stands there; left out: the line is missing."""
    listing: Text | None = None
    """What stands in the editor at first, where neither a line of the task's listing nor its head alone does."""
    right: Text | None = None
    """A listing that does something else than that of the task, which must be changed so."""

    @model_validator(mode="after")
    def _has_one_start(self) -> "CodePart":
        if self.wrong is not None and self.line is None:
            raise ValueError("expected line, the number of the wrong line, beside wrong")
        if self.listing is not None and self.line is not None:
            raise ValueError("expected either line or listing")
        return self


class SpotPart(Part):
    """The picture that a mistake makes of the scene, and mistakes to choose from."""

    type: Literal["spot"]
    mistake: MistakeName
    others: list[MistakeName] = Field(default_factory=list, max_length=9)
    """Mistakes that did not make it."""


class StepPart(Part):
    """One step: a number, a pixel, a place, or one of several options."""

    ask: Word
    number: AnyNumber | None = None
    pixel: list[Index] = Field(default_factory=list)
    place: list[AnyNumber] = Field(default_factory=list)
    options: list[Word] = Field(default_factory=list, max_length=10)
    right: Word | None = None
    tolerance: Tolerance = 0.0

    @model_validator(mode="after")
    def _has_one_kind(self) -> "StepPart":
        if (self.number is not None) + bool(self.pixel) + bool(self.place) + bool(self.options) != 1:
            raise ValueError("expected one of number, pixel, place or options")
        if any(pair and len(pair) != 2 for pair in (self.pixel, self.place)):
            raise ValueError("expected two numbers")
        if self.options and (self.right not in self.options or len(set(self.options)) != len(self.options)):
            raise ValueError("expected different options, and right to be one of them")
        return self


class StepsPart(Part):
    """Steps to do one after the other."""

    type: Literal["steps"]
    steps: list[StepPart] = Field(min_length=1, max_length=64)


class BreakPart(Part):
    """A corner to move until a weak method fails and a robust one does not."""

    type: Literal["break"]
    corner: list[Index] = Field(min_length=2, max_length=2)
    """Numbers of a triangle of the scene and of its corner."""
    step: ExactNumber = Fraction(1, 2)
    weak: SettingTexts
    robust: SettingTexts
    fails: Literal["differs", "twice"] = "differs"
    """Where the picture differs from that of the settings, or a pixel is drawn twice."""

    @model_validator(mode="after")
    def _has_step(self) -> "BreakPart":
        return _with_step(self)


class CheapestPart(Part):
    """Methods of several families with what they cost; the picture of the settings is the reference."""

    type: Literal["cheapest"]
    tolerance: ExactNumber
    """Largest difference of a colour channel of any pixel, of 255."""
    costs: dict[Word, dict[Word, ExactNumber]] = Field(min_length=1, max_length=8)

    @model_validator(mode="after")
    def _is_known(self) -> "CheapestPart":
        for family, costs in self.costs.items():
            for method in costs:
                settings_from_texts({family: method})
        return self


AnswerPart = (
    PixelPart
    | NumberPart
    | TablePart
    | OrderPart
    | ChoicePart
    | PlacePart
    | LinePart
    | CodePart
    | SpotPart
    | StepsPart
    | BreakPart
    | CheapestPart
)
"""Of any type."""


# The record of an exercise: what a TOML file holds, field by field.


VALUE_LIMIT = 8
"""Most values of a corner."""
PRIMITIVE_LIMIT = 64
"""Most triangles or segments of a scene."""


class ScenePart(Part):
    """What is drawn: a built-in scene, or triangles or segments in the window."""

    builtin: SceneName | None = None
    size: list[Side] = Field(default_factory=lambda: [16, 12], min_length=2, max_length=2)
    """Columns and rows; a built-in scene is drawn at this size, too."""
    background: list[Coordinate] | None = None
    """Red, green, blue and alpha, from 0 to 1; left out: transparent black, or that of the built-in scene."""
    triangles: list[list[list[Coordinate]]] = Field(default_factory=list, max_length=PRIMITIVE_LIMIT)
    """Corners [x, y], or [x, y, depth, w]."""
    segments: list[list[list[Coordinate]]] = Field(default_factory=list, max_length=PRIMITIVE_LIMIT)
    values: list[list[list[Coordinate]]] = Field(default_factory=list)
    """Of every corner of every triangle, what is interpolated: as many numbers as all others have."""
    alpha: list[list[Coordinate]] = Field(default_factory=list)
    """Of every corner of every triangle, from 0 to 1; the values before it are its red, green and blue."""
    patches: list[Text] = Field(default_factory=list, max_length=MOST_PATCHES)
    """Depths in whole numbers, patch by patch in the order of drawing, row by row from the top, ``-`` for none."""
    test: Literal["less", "less-equal", "greater", "greater-equal"] = "less"
    """How a depth of a patch must compare with the buffer's to pass."""

    @model_validator(mode="after")
    def _has_one_content(self) -> "ScenePart":
        if sum(map(bool, (self.builtin, self.triangles, self.segments, self.patches))) != 1:
            raise ValueError("expected either builtin, triangles, segments or patches")
        for kind, primitives in (("triangles", self.triangles), ("segments", self.segments)):
            count = CORNER_COUNTS[kind]
            for number, corners in enumerate(primitives):
                is_whole = {2: True, 4: kind == "triangles"}
                if len(corners) != count or not all(is_whole.get(len(place)) for place in corners):
                    more = " or [x, y, depth, w]" if kind == "triangles" else ""
                    raise ValueError(f"expected {count} corners [x, y]{more} in {kind}[{number}]")
                if any(w.low <= 0 <= w.high for place in corners for w in place[3:]):
                    raise ValueError(f"expected a w that is never 0 in {kind}[{number}]")
        return self

    @model_validator(mode="after")
    def _has_whole_corners(self) -> "ScenePart":
        for name, rows in (("values", self.values), ("alpha", self.alpha)):
            if rows and [len(row) for row in rows] != [3] * len(self.triangles):
                raise ValueError(f"expected {name} of the three corners of every triangle")
        counts = {len(values) for row in self.values for values in row}
        if self.values and (len(counts) != 1 or not 1 <= min(counts) <= VALUE_LIMIT):
            raise ValueError(f"expected the same count of values at every corner, from 1 to {VALUE_LIMIT}")
        if self.alpha and counts not in (set(), {3}):
            raise ValueError("expected values of red, green and blue beside alpha, or none")
        shares = [*(self.background or ()), *(alpha for row in self.alpha for alpha in row)]
        if any(share.low < 0 or share.high > 1 for share in shares):
            raise ValueError("expected alpha and background from 0 to 1")
        if self.background is not None and len(self.background) != 4:
            raise ValueError("expected red, green, blue and alpha of the background")
        return self

    @property
    def has_ranges(self) -> bool:
        """Whether anything is drawn from a range."""
        corners = [*chain(*self.triangles, *self.segments, *self.values), *self.alpha, self.background or []]
        return any(one.low < one.high for one in chain(*corners))


class Exercise(Part):
    """A whole file."""

    version: Literal[1]
    """Of the format; files of later versions are refused."""
    revision: Annotated[int, Field(ge=1, le=SEED_LIMIT)] | None = None
    """Of what is asked; left out: what is asked says it, so that no seed ever gives two questions."""
    title: Word
    stage: StageName
    question: Text
    """What is asked, with the rule that decides."""
    points: Annotated[int, Field(ge=1, le=100)] = 1
    hints: list[Text] = Field(default_factory=list, max_length=8)
    mistakes: list[MistakeName] = Field(default_factory=list)
    """Twins that must show in every question that is drawn."""
    scene: ScenePart | None = None
    settings: SettingTexts = Field(default_factory=dict)
    answer: Annotated[AnswerPart, Field(discriminator="type")]
