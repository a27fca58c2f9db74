"""TOML files that people write: values with their limits, read with the line of what is wrong."""

import re
import tomllib
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any, TypeVar, get_args

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from core import STAGES
from core.setting_texts import settings_from_texts
from lessons.exercises.answers.marked import SIDE_LIMIT
from lessons.exercises.numbers import LARGEST, Draws, Number, is_infinite, read_number
from lessons.lectures.scenes import scene_named
from lessons.mistakes.shelf import RULES, twin_named

# TOML files that people write: read with the line of what is wrong.


Model = TypeVar("Model", bound=BaseModel)
Location = tuple[str | int, ...]
"""Keys and indices that lead to a value."""

BYTE_LIMIT = 1 << 16
"""Largest file in bytes."""


class TomlFile:
    """The text of a file and what it says; numbers with a fraction stay text, so that none is rounded."""

    def __init__(self, path: Path) -> None:
        if path.exists() and not path.is_file():
            raise ValueError(f"{path}: expected a file")
        with path.open("rb") as file:
            content = file.read(BYTE_LIMIT + 1)
        self.path = path
        if len(content) > BYTE_LIMIT:
            raise ValueError(f"{path}: expected a file of up to {BYTE_LIMIT // 1024} KiB")
        try:
            self._text = content.decode("utf-8-sig").replace("\r\n", "\n")
        except UnicodeDecodeError as problem:
            line = content[: problem.start].count(b"\n") + 1
            raise ValueError(f"{path}: line {line}: expected text in UTF-8") from None
        try:
            self.values = _parsed(self._text)
        except tomllib.TOMLDecodeError as problem:
            reason, _, place = str(problem).rpartition(" (at ")
            has_line = place.startswith("line ")
            line = int(place.split(",")[0].removeprefix("line ")) if has_line else self._last_line
            raise ValueError(
                f"{path}: line {line}: expected TOML: {reason[:1].lower()}{reason[1:]}"
            ) from None
        except (ValueError, RecursionError):
            raise ValueError(
                f"{path}: line {self._unread_line}: expected TOML, got a number or a list too long to read"
            ) from None

    @property
    def _last_line(self) -> int:
        return self._text.rstrip("\n").count("\n") + 1

    @property
    def _unread_line(self) -> int:
        """The line with which reading fails for another reason than that it is no TOML."""
        lines = self._text.split("\n")
        for end in range(1, len(lines)):
            try:
                _parsed("\n".join(lines[:end]))
            except tomllib.TOMLDecodeError:
                continue
            except (ValueError, RecursionError):
                return end
        return len(lines)

    def checked(self, model: type[Model]) -> Model:
        """Return the content as a record, or raise ValueError with file, line and what was expected."""
        try:
            return model.model_validate(self.values)
        except ValidationError as problem:
            first = problem.errors(include_url=False)[0]
            raise self.error(first["loc"], _sentence(dict(first), model)) from None

    def error(self, location: Location, sentence: str) -> ValueError:
        """Return an error with the line of a value."""
        found = self._found(self.values, location)
        name = ".".join(map(str, found))
        where = f"{name}: " if name else ""
        return ValueError(f"{self.path}: line {self._line_of(found)}: {where}{sentence}")

    def _found(self, values: Any, location: Location) -> Location:
        """Return the part of a location that is in the file; names of alternatives are not."""
        found: list[str | int] = []
        for key in location:
            is_key = isinstance(values, dict) and key in values
            is_index = isinstance(values, list) and isinstance(key, int) and key < len(values)
            if is_key or is_index:
                values = values[key]
                found.append(key)
        return tuple(found)

    def _line_of(self, found: Location) -> int:
        """Return the first line of the statement that gives a value: that of the shortest beginning that has it."""
        lines = self._text.split("\n")
        begin = 0
        for end in range(1, len(lines) + 1 if found else 0):
            try:
                values = _parsed("\n".join(lines[:end]))
            except ValueError:
                continue
            if self._found(values, found) == found:
                statement = lines[begin:end]
                blank = next(k for k, line in enumerate(statement) if line.strip() and line.strip()[0] != "#")
                return begin + blank + 1
            begin = end
        return 1


def _parsed(text: str) -> dict[str, Any]:
    return tomllib.loads(text, parse_float=str)


def _sentence(error: Mapping[str, Any], model: type[BaseModel]) -> str:
    """Return what pydantic found, as what was expected and what came."""
    kind, message, last = error["type"], str(error["msg"]), error["loc"][-1] if error["loc"] else ""
    if kind == "missing":
        return f"expected {last} here, which is missing"
    if kind == "extra_forbidden":
        known = sorted(_fields(model, error["loc"][:-1]))
        near = get_close_matches(str(last), known, 1) or [f"one of {', '.join(known)}"]
        return f"unknown {_shown(last)}, expected {near[0]}"
    if kind == "value_error":
        return message.removeprefix("Value error, ")
    if kind == "union_tag_not_found":
        return (
            f"expected type here, one of {', '.join(map(repr, _tags(model, error['loc'])))}, which is missing"
        )
    if kind == "union_tag_invalid":
        return f"expected type to be one of {error['ctx']['expected_tags']}"
    if "at least" in message or "at most" in message:
        wanted = re.sub(r".* (at (?:least|most) \d+ \w+).*", r"expected \1", message)
    else:
        wanted = message.replace("Input should be", "expected").replace("a valid integer", "a whole number")
    return f"{wanted}, got {_shown(error['input'])}"


def _models(annotation: object) -> Iterator[type[BaseModel]]:
    """Yield the records that a field may hold."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _models(part)


def _at(model: type[BaseModel], location: Location) -> list[type[BaseModel]]:
    """Return the records that may stand at a location; names of alternatives choose among them."""
    found = [model]
    for key in location:
        inner = [
            each
            for one in found
            if key in one.model_fields
            for each in _models(one.model_fields[str(key)].annotation)
        ]
        found = inner or [one for one in found if key in _tags_of(one)] or found
    return found


def _tags_of(model: type[BaseModel]) -> tuple[Any, ...]:
    return get_args(model.model_fields["type"].annotation) if "type" in model.model_fields else ()


def _tags(model: type[BaseModel], location: Location) -> list[str]:
    return [tag for one in _at(model, location) for tag in _tags_of(one)]


def _fields(model: type[BaseModel], location: Location) -> set[str]:
    return {name for one in _at(model, location) for name in one.model_fields}


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 40 else f"{text[:40]}..."


# Values that stand in the file of an exercise: numbers, ranges to draw from, texts, names of what there is.


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
