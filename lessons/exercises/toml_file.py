"""TOML files that people write: read with the line of what is wrong."""

import re
import tomllib
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ValidationError

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
