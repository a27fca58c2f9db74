"""Reading checked files: JSON of this program, of a version it knows, checked field by field."""

import json
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from app.files.file_access import read_input
from lessons.os_errors import os_error_reason

Model = TypeVar("Model", bound=BaseModel)
SIZE_LIMIT = 1 << 26
"""Largest file in bytes."""


class SavedRecordError(ValueError):
    """A saved record cannot be read; the message is one sentence, or the end of one."""


def read_record(
    path: Path,
    model: type[Model],
    program: str,
    noun: str,
    version: int,
    *,
    limit: int = SIZE_LIMIT,
    union: str = "",
    migrations: Sequence[Callable[[dict[str, Any]], dict[str, Any]]] = (),
) -> Model:
    """Return what a file holds.

    Parameters
    ----------
    model : type
        What its content must be.
    program : str
        What the file must name as its ``program``.
    noun : str
        What such a file is called, with its article: ``a study``.
    version : int
        The present one.
    limit : int
        Its largest size in bytes.
    union : str
        As in `field_problem`.
    migrations : sequence of callable
        What turns a record of each earlier version that is read into one of the next version.

    Raises
    ------
    SavedRecordError
        If it cannot be read; the message says why and names the field.
    """
    content = _read(path, limit)
    try:
        found = json.loads(content)
    except (ValueError, RecursionError) as problem:
        raise SavedRecordError(f"it is not {noun}, or it is incomplete: it is not valid JSON") from problem
    if not isinstance(found, dict) or found.get("program") != program:
        raise SavedRecordError(f"it is not {noun} of Rasterscope")
    came, earliest = found.get("version"), version - len(migrations)
    if type(came) is not int or not earliest <= came <= version:
        known = f"version {version}" if earliest == version else f"versions {earliest} to {version}"
        raise SavedRecordError(f"it is of version {str(came)[:20]}, and this Rasterscope opens {known}")
    if came < version:
        for migrate in migrations[came - earliest :]:
            found = migrate(found)
        content = json.dumps(found | {"version": version}).encode()
    try:
        return model.model_validate_json(content)
    except ValidationError as problem:
        raise SavedRecordError(field_problem(problem, union)) from problem


def _read(path: Path, limit: int) -> bytes:
    try:
        if path.stat().st_size > limit:
            raise SavedRecordError(f"it is larger than {limit >> 20} MiB")
        return read_input(path, limit)
    except FileNotFoundError as problem:
        raise SavedRecordError(f"there is no file {path}") from problem
    except OSError as problem:
        raise SavedRecordError(os_error_reason(problem)) from problem


SHOWN = 60
"""Characters of a wrong value that are shown."""


def field_problem(error: ValidationError, union: str = "") -> str:
    """Return the first problem of a validation as a sentence without its full stop.

    Parameters
    ----------
    union : str
        Field of several kinds; pydantic names the kind behind it, as if it were a field.
    """
    problems = error.errors(include_url=False)
    first = problems[0]
    parts = [str(part) for part in first["loc"]]
    if union and union in parts:
        del parts[parts.index(union) + 1 : parts.index(union) + 2]
    where = ".".join(parts) or "the file"
    more = f" (and {len(problems) - 1} more)" if len(problems) > 1 else ""
    if first["type"] == "missing":
        return f"{where} is missing{more}"
    if first["type"] == "extra_forbidden":
        return f"{where} is not a known field{more}"
    if first["type"] == "union_tag_invalid":
        known = first["ctx"]
        name = known["discriminator"].strip("'")
        return f"{where}.{name} must be one of {known['expected_tags']}, got {_shown(known['tag'])}{more}"
    message = first["msg"].removeprefix("Value error, ").removeprefix("Assertion failed, ")
    message = re.sub(r"^\w+ should ", "must ", re.sub(r", unable to parse .*", "", message))
    message = re.sub(r"^Unable to parse input string as an integer.*", "must be a smaller integer", message)
    message = message[:1].lower() + message[1:]
    if first["type"] in ("value_error", "assertion_error"):
        return f"{where}: {message}{more}"
    return f"{where} {message}, got {_shown(first.get('input'))}{more}"


def _shown(value: Any) -> str:
    text = "nothing" if value is None else repr(value)
    return text if len(text) <= SHOWN else f"{text[: SHOWN - 1]}…"
