"""Which rows of a trace the tests execute the listings on, when two numbers are the same, and which lines ran."""

import ast
import inspect
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from textwrap import dedent
from types import CodeType, FrameType

import numpy as np

import core
from core.trace.stage_trace import StageTrace
from tests.covering import is_everything

ROW_LIMIT = 150 if is_everything() else 60
"""Rows of a kind that are executed: all of them, or these many of them spread over the trace."""
FOLLOWED_ROWS = 25 if is_everything() else 10
"""Those of them that are followed line by line, at least."""

Ran = dict[CodeType, list[list[int]]]
"""Function to the lines of its listing of each of its calls, in the order in which they ran, from 1."""


def rows_of_kind(found: StageTrace, kind: str) -> Iterator[int]:
    """Yield rows, and check what is executed before the next: the line that an operation marks is one that ran."""
    rows = np.flatnonzero(found.steps.kind == found.steps.kinds.index(kind))
    executed = rows[:: max(len(rows) // ROW_LIMIT, 1)].tolist()
    every = max(len(executed) // FOLLOWED_ROWS, 1)
    for number, row in enumerate(executed):
        if number % every:
            yield row
            continue
        with lines_that_run() as ran:
            yield row
        check_marks(found, row, ran)


@cache
def _lines_joined(code: CodeType) -> int:
    """Return how many lines signature and docstring have beyond the one of the signature in a listing."""
    if code.co_name.startswith("<"):
        return 0
    source = inspect.getsource(code)
    (function,) = ast.parse(dedent(source)).body
    return function.body[ast.get_docstring(function) is not None].lineno - 2


@contextmanager
def lines_that_run() -> Iterator[Ran]:
    """Note the lines of all functions of the program that are called inside."""
    ran: Ran = {}
    folder = str(Path(core.__file__).parent)

    def called(frame: FrameType, event: str, argument: object) -> object:
        if not frame.f_code.co_filename.startswith(folder):
            return None
        lines: list[int] = []
        first = frame.f_code.co_firstlineno + _lines_joined(frame.f_code)
        ran.setdefault(frame.f_code, []).append(lines)

        def stepped(frame: FrameType, event: str, argument: object) -> object:
            if event == "line":
                lines.append(frame.f_lineno - first + 1)
            return stepped

        return stepped

    before = sys.gettrace()
    sys.settrace(called)  # type: ignore[arg-type]
    try:
        yield ran
    finally:
        sys.settrace(before)


def check_marks(found: StageTrace, row: int, ran: Ran) -> None:
    """Check that every operation of a row whose listing was called marks a line that ran."""
    start, end = found.steps.starts[row : row + 2].tolist()
    for position in range(start + 1, end + 1):
        made = found.explain(position)
        calls = ran.get(made.listing.function.__code__) if made.listing is not None else None
        if calls is None or not made.line:
            continue
        lines = made.listing.source.splitlines()
        shown = lines[made.line - 1].strip()
        assert any(made.line in call for call in calls), (made.key, shown, calls)


def equal(found: object, wanted: object) -> bool:
    if isinstance(found, float) and isinstance(wanted, float):  # most are, and comparing arrays takes long
        return found == wanted or (found != found and wanted != wanted)
    return np.array_equal(np.asarray(found), np.asarray(wanted), equal_nan=True)
