"""A listing: the algorithm of a step as a short scalar function that a student can read and the tests execute.

A line of the function is named by a comment at its end, ``#: name``; a step says the name, the window marks the line.
"""

import inspect
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from textwrap import dedent
from typing import Any

_LABEL = re.compile(r"\s*#: (?P<name>[\w-]+)\s*$")


@dataclass(frozen=True, eq=False)
class Listing:
    """Source of a scalar function without its labels, and the line each label stands on."""

    function: Callable[..., Any]
    source: str
    lines: dict[str, int]
    """Label to line number, counted from 1."""


@cache
def listing(function: Callable[..., Any]) -> Listing:
    """Read the source of ``function`` and take its labels out."""
    lines, labels = [], {}
    for number, line in enumerate(dedent(inspect.getsource(function)).splitlines(), start=1):
        label = _LABEL.search(line)
        if label:
            labels[label["name"]] = number
            line = line[: label.start()]
        lines.append(line)
    return Listing(function, "\n".join(lines), labels)
