"""What is wrong with a file of named fields, as one sentence: which field, what was wanted, what came."""

from typing import Any

from pydantic import ValidationError

SHOWN = 60
"""Characters of a wrong value that are shown."""


def field_problem(error: ValidationError) -> str:
    """Return the first problem of a validation as a sentence without its full stop."""
    problems = error.errors(include_url=False)
    first = problems[0]
    where = ".".join(str(part) for part in first["loc"]) or "the file"
    more = f" (and {len(problems) - 1} more)" if len(problems) > 1 else ""
    if first["type"] == "missing":
        return f"{where} is missing{more}"
    if first["type"] == "extra_forbidden":
        return f"{where} is not a known field{more}"
    message = first["msg"].removeprefix("Value error, ").removeprefix("Assertion failed, ")
    message = message.replace("Input should be", "must be")
    message = message[:1].lower() + message[1:]
    if first["type"] in ("value_error", "assertion_error"):
        return f"{where}: {message}{more}"
    return f"{where} {message}, got {_shown(first.get('input'))}{more}"


def _shown(value: Any) -> str:
    text = "nothing" if value is None else repr(value)
    return text if len(text) <= SHOWN else f"{text[: SHOWN - 1]}…"
