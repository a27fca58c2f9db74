"""The record of an exercise: what a TOML file holds, field by field."""

from typing import Annotated, Literal

from pydantic import Field, model_validator

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

PRIMITIVE_LIMIT = 64
"""Most triangles or segments of a scene."""


class ScenePart(Part):
    """What is drawn: a built-in scene, or triangles or segments in the window."""

    builtin: SceneName | None = None
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
