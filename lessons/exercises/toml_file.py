"""TOML files that people write: read with the line of what is wrong."""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

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
            raise ValueError(f"{path}: expected TOML, got a number or a list too long to read") from None

    @property
    def _last_line(self) -> int:
        return self._text.rstrip("\n").count("\n") + 1

    def checked(self, model: type[Model]) -> Model:
        """Return the content as a record, or raise ValueError with file, line and what was expected."""
        try:
            return model.model_validate(self.values)
        except ValidationError as problem:
            first = problem.errors(include_url=False)[0]
            raise self.error(first["loc"], _sentence(dict(first))) from None

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


def _sentence(error: Mapping[str, Any]) -> str:
    """Return what pydantic found, as what was expected and what came."""
    kind, message, last = error["type"], str(error["msg"]), error["loc"][-1] if error["loc"] else ""
    if kind == "missing":
        return f"expected {last} here, which is missing"
    if kind == "extra_forbidden":
        return f"unknown {_shown(last)}"
    if kind == "value_error":
        return message.removeprefix("Value error, ")
    if kind.startswith("union_tag"):
        context: Mapping[str, Any] = error.get("ctx", {})
        return f"expected type to be one of {context.get('expected_tags', 'the answer types')}"
    wanted = message.replace("Input should be", "expected").replace("should have", "must have")
    return f"{wanted}, got {_shown(error['input'])}"


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 40 else f"{text[:40]}..."
