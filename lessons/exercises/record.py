"""The record of an exercise: what a TOML file holds, field by field."""

from itertools import chain
from typing import Annotated, Literal

from pydantic import Field, model_validator

from core.records.depth_table import MOST_PATCHES
from core.scene import CORNER_COUNTS
from lessons.exercises.answer_parts import AnswerPart
from lessons.exercises.draws import SEED_LIMIT
from lessons.exercises.fields import (
    Coordinate,
    MistakeName,
    Part,
    SceneName,
    SettingTexts,
    Side,
    StageName,
    Text,
    Word,
)

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
