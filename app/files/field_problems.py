"""What is wrong with a file of named fields, as one sentence: which field, what was wanted, what came."""

import re
from typing import Any

from pydantic import ValidationError

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
    message = first["msg"].removeprefix("Value error, ").removeprefix("Assertion failed, ")
    message = re.sub(r"^\w+ should ", "must ", message)
    message = message[:1].lower() + message[1:]
    if first["type"] in ("value_error", "assertion_error"):
        return f"{where}: {message}{more}"
    return f"{where} {message}, got {_shown(first.get('input'))}{more}"


def _shown(value: Any) -> str:
    text = "nothing" if value is None else repr(value)
    return text if len(text) <= SHOWN else f"{text[: SHOWN - 1]}…"
