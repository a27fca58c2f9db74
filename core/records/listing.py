"""A listing: the algorithm of a step as a short scalar function that a student can read and the tests execute.

A line of the function is named by a comment at its end, ``#: name``; a step says the name, the window marks the line.
"""

import ast
import inspect
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from textwrap import dedent
from typing import Any

_LABEL = re.compile(r"\s*#: (?P<name>[\w-]+)\s*$")


@dataclass(frozen=True, eq=False)
class Listing:
    """Source of a scalar function without labels and types, and the line each label stands on."""

    function: Callable[..., Any]
    source: str
    lines: dict[str, int]
    """Label to line number, counted from 1."""


_PRINTED: dict[Callable[..., Any], str] = {}


def print_as(function: Callable[..., Any], text: str) -> None:
    """Let ``text``, whose labels stand behind ``#:``, be shown as the listing of a function, as a book prints it."""
    _PRINTED[function] = text


def without_labels(text: str) -> str:
    """Return a text for `print_as` as it is shown."""
    return "\n".join(line.partition("#:")[0].rstrip() for line in text.splitlines())


@cache
def listing(function: Callable[..., Any]) -> Listing:
    """Return what is shown of ``function``: its source, or the text that it is printed as."""
    own, text = source_listing(function), _PRINTED.get(function)
    if text is None:
        return own
    lines = enumerate(text.splitlines(), start=1)
    labels = {label: number for number, line in lines for label in line.partition("#:")[2].split()}
    return replace(own, source=without_labels(text), lines=labels)


@cache
def source_listing(function: Callable[..., Any]) -> Listing:
    """Read the source of ``function`` as a textbook prints it: its labels and types are taken out."""
    lines, labels = [], {}
    for number, line in enumerate(_untyped(dedent(inspect.getsource(function))), start=1):
        label = _LABEL.search(line)
        if label:
            labels[label["name"]] = number
            line = line[: label.start()]
        lines.append(line)
    return Listing(function, "\n".join(lines), labels)


def _untyped(source: str) -> list[str]:
    """Return the lines of a function: signatures in one line and without types, every indent half as wide."""
    lines = source.splitlines()
    typed = [
        node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.FunctionDef | ast.AnnAssign)
    ]
    for node in sorted(typed, key=lambda node: -node.lineno):
        first, indent = node.lineno - 1, " " * node.col_offset
        if isinstance(node, ast.AnnAssign):
            line, end = lines[first], node.annotation.end_col_offset
            lines[first] = line[: node.target.end_col_offset] + line[end:]
            continue
        for argument in ast.walk(node.args):
            if isinstance(argument, ast.arg):
                argument.annotation = None
        last = next(k for k in range(first, len(lines)) if lines[k].endswith(":"))
        lines[first : last + 1] = [f"{indent}def {node.name}({ast.unparse(node.args)}):"]
    return [" " * ((len(line) - len(line.lstrip())) // 2) + line.lstrip() for line in lines]
