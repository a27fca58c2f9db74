"""The record of an exercise: what a TOML file holds, field by field."""

import re
from fractions import Fraction
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, model_validator

from core import STAGES
from core.scene import CORNER_COUNTS
from core.settings import settings_from_texts
from lessons.exercises.answers.pixels import SIDE_LIMIT, read_art
from lessons.exercises.draws import Draws
from lessons.exercises.numbers import LARGEST, Number, is_infinite, read_number
from lessons.mistakes.shelf import twin_named
from lessons.scenes import built_in_scene

VERSION: Literal[1] = 1
"""Of the format; files of later versions are refused."""
COORDINATE_LIMIT = 4096
"""Farthest place of a corner in pixels."""
PRIMITIVE_LIMIT = 64
"""Most triangles or segments of a scene."""
TEXT_LIMIT = 2000
"""Longest text in characters."""
_RANGE = re.compile(r"(.+?)\.\.(.+?) step (.+)")


def _number(given: object) -> Number:
    if isinstance(given, bool) or not isinstance(given, int | str):
        raise ValueError(f"expected a number, got {type(given).__name__}")
    if isinstance(given, int) and abs(given) > LARGEST:
        raise ValueError("expected a number up to 1e300, got a larger one")
    return read_number(str(given))


class Range(BaseModel):
    """One coordinate, or an even row of them to draw from: ``"0.5..8.5 step 1/2"``."""

    model_config = ConfigDict(frozen=True, extra="forbid", arbitrary_types_allowed=True)

    low: Fraction
    high: Fraction
    step: Fraction

    def draw(self, draws: Draws) -> Fraction:
        """Draw one; a single coordinate draws nothing."""
        return self.low if self.low == self.high else draws.step(self.low, self.high, self.step)


def _range(given: object) -> Range:
    parts = _RANGE.fullmatch(given) if isinstance(given, str) else None
    numbers = [_number(part) for part in parts.groups()] if parts else [_number(given)] * 2 + [Fraction(1)]
    exact = [number for number in numbers if isinstance(number, Fraction)]
    if len(exact) < 3 or max(map(abs, exact)) > COORDINATE_LIMIT:
        raise ValueError(f"expected a coordinate from -{COORDINATE_LIMIT} to {COORDINATE_LIMIT}, got {given}")
    low, high, step = exact
    if high < low or step <= 0:
        raise ValueError(f'expected a range such as "0.5..8.5 step 1", got {given}')
    return Range(low=low, high=high, step=step)


def _finite_positive(given: object) -> float:
    number = _number(given)
    if is_infinite(number) or number < 0:
        raise ValueError(f"expected a number from 0, got {given}")
    return float(number)


def _known_mistake(given: object) -> str:
    return twin_named(given if isinstance(given, str) else repr(given)).name


def _known_scene(given: object) -> str:
    return built_in_scene(given if isinstance(given, str) else repr(given)).name


def _known_stage(given: object) -> str:
    if given not in STAGES:
        raise ValueError(f"expected a stage of {', '.join(STAGES)}, got {given!r:.60}")
    return str(given)


def _printable(text: str) -> str:
    if not text.replace("\n", "").isprintable():
        raise ValueError(f"expected text without control characters, got {text!a:.60}")
    return text


def _settings(given: object) -> dict[str, str]:
    if not isinstance(given, dict):
        raise ValueError('expected methods by family, such as fill_rule = "inclusive"')
    texts = {str(name): str(value) for name, value in given.items()}
    settings_from_texts(texts)
    return texts


Coordinate = Annotated[Range, BeforeValidator(_range)]
Place = tuple[Coordinate, Coordinate]
AnyNumber = Annotated[Any, BeforeValidator(_number)]
Tolerance = Annotated[float, BeforeValidator(_finite_positive)]
Text = Annotated[str, Field(min_length=1, max_length=TEXT_LIMIT), AfterValidator(_printable)]
Word = Annotated[str, Field(min_length=1, max_length=80), AfterValidator(_printable)]
Side = Annotated[int, Field(ge=1, le=SIDE_LIMIT)]


class Part(BaseModel):
    """What all tables of a file share: no unknown field, no conversion of types."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)


class ScenePart(Part):
    """What is drawn: a built-in scene, or triangles or segments in the window."""

    builtin: Annotated[str, BeforeValidator(_known_scene)] | None = None
    size: list[Side] = Field(default_factory=lambda: [16, 12], min_length=2, max_length=2)
    """Columns and rows; a built-in scene is drawn at this size, too."""
    triangles: list[list[list[Coordinate]]] = Field(default_factory=list, max_length=PRIMITIVE_LIMIT)
    segments: list[list[list[Coordinate]]] = Field(default_factory=list, max_length=PRIMITIVE_LIMIT)

    @model_validator(mode="after")
    def _has_one_content(self) -> "ScenePart":
        if sum(map(bool, (self.builtin, self.triangles, self.segments))) != 1:
            raise ValueError("expected either builtin, triangles or segments")
        for kind, primitives in (("triangles", self.triangles), ("segments", self.segments)):
            count = CORNER_COUNTS[kind]
            for number, corners in enumerate(primitives):
                if len(corners) != count or any(len(place) != 2 for place in corners):
                    raise ValueError(f"expected {count} corners [x, y] in {kind}[{number}]")
        return self


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
            raise ValueError(f"expected {len(self.labels)} rows of {len(self.columns)} cells")
        return self


class OrderPart(Part):
    """Things, listed in the right order."""

    type: Literal["order"]
    items: list[Word] = Field(min_length=3, max_length=8)


class ChoicePart(Part):
    """Options of which one is right, or several are."""

    type: Literal["choice"]
    options: list[Word] = Field(min_length=2, max_length=10)
    right: list[Word] = Field(min_length=1)
    several: bool = False

    @model_validator(mode="after")
    def _is_known(self) -> "ChoicePart":
        for option in self.right:
            if option not in self.options:
                raise ValueError(f"expected one of the options, got {option}")
        return self


class Exercise(Part):
    """A whole file."""

    version: Literal[1]
    title: Word
    stage: Annotated[str, BeforeValidator(_known_stage)]
    question: Text
    """What is asked, with the rule that decides."""
    points: Annotated[int, Field(ge=1, le=100)] = 1
    hints: list[Text] = Field(default_factory=list, max_length=8)
    mistakes: list[Annotated[str, BeforeValidator(_known_mistake)]] = Field(default_factory=list)
    """Twins that must show in every question that is drawn."""
    scene: ScenePart | None = None
    settings: Annotated[dict[str, str], BeforeValidator(_settings)] = Field(default_factory=dict)
    answer: Annotated[
        PixelPart | NumberPart | TablePart | OrderPart | ChoicePart, Field(discriminator="type")
    ]
