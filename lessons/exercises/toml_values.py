"""Values in TOML files that people write: numbers, ranges to draw from, texts, names of what there is."""

import re
from fractions import Fraction
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field

from core import STAGES
from core.setting_texts import settings_from_texts
from lessons.exercises.answers.marked import SIDE_LIMIT
from lessons.exercises.numbers import LARGEST, Draws, Number, is_infinite, read_number
from lessons.lectures.scenes import scene_named
from lessons.mistakes.shelf import RULES, twin_named

COORDINATE_LIMIT = 4096
"""Farthest place of a corner in pixels."""
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


def _exact(given: object) -> Fraction:
    number = _number(given)
    if not isinstance(number, Fraction) or not 0 <= number <= COORDINATE_LIMIT:
        raise ValueError(f"expected a number from 0 to {COORDINATE_LIMIT}, got {given}")
    return number


def _known_mistake(given: object) -> str:
    return twin_named(given if isinstance(given, str) else repr(given)).name


def _known_rule_or_mistake(given: object) -> str:
    return str(given) if given in RULES else _known_mistake(given)


def _known_scene(given: object) -> str:
    return scene_named(given if isinstance(given, str) else repr(given)).name


def _known_stage(given: object) -> str:
    if given not in STAGES:
        raise ValueError(f"expected a stage of {', '.join(STAGES)}, got {given!r:.60}")
    return str(given)


def _printable(text: str) -> str:
    if not text.replace("\n", "").isprintable():
        raise ValueError(f"expected text without control characters, got {text!a:.60}")
    return text


def _one_line(text: str) -> str:
    if "\n" in text:
        raise ValueError(f"expected text of one line, got {text!a:.60}")
    return _printable(text)


def _settings(given: object) -> dict[str, str]:
    if not isinstance(given, dict):
        raise ValueError('expected methods by family, such as fill_rule = "inclusive"')
    texts = {str(name): str(value) for name, value in given.items()}
    settings_from_texts(texts)
    return texts


MistakeName = Annotated[str, BeforeValidator(_known_mistake)]
AnyMistake = Annotated[str, BeforeValidator(_known_rule_or_mistake)]
"""A faulty run or a wrong formula."""
SceneName = Annotated[str, BeforeValidator(_known_scene)]
StageName = Annotated[str, BeforeValidator(_known_stage)]
SettingTexts = Annotated[dict[str, str], BeforeValidator(_settings)]
Coordinate = Annotated[Range, BeforeValidator(_range)]
AnyNumber = Annotated[Any, BeforeValidator(_number)]
ExactNumber = Annotated[Any, BeforeValidator(_exact)]
"""A fraction from 0."""
Tolerance = Annotated[float, BeforeValidator(_finite_positive)]
Text = Annotated[str, Field(min_length=1, max_length=TEXT_LIMIT), AfterValidator(_printable)]
Word = Annotated[str, Field(min_length=1, max_length=80), AfterValidator(_one_line)]
Side = Annotated[int, Field(ge=1, le=SIDE_LIMIT)]


class Part(BaseModel):
    """What all tables of a file share: no unknown field, no conversion of types."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, defer_build=True)
