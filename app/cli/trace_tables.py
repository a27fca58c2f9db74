"""The trace of a stage as text and JSON, with a sentence and a formula for every operation, as CSV, and as arrays."""

import csv
import json
import math
from collections.abc import Callable, Iterable, Iterator
from io import StringIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.explain.latex import plain_text, without_macros
from core.explain.steps import account
from core.records.arrays import Flags
from core.trace.conditions import symbols_of
from core.trace.stage_trace import Explanation, StageTrace

Header = dict[str, Any]
BATCH = 4096
"""Rows of a CSV table that are written together."""


def table_parts(stage: StageTrace, header: Header, form: str) -> Iterator[tuple[int, str]]:
    """Yield the pieces of a trace as a text, each with the rows that are written with it and those before.

    Parameters
    ----------
    header : dict
        What was traced, values that JSON has.
    form : str
        ``text``, ``json`` or ``csv``.
    """
    if form == "csv":
        yield from csv_parts(stage)
        return
    head, row_text, end = text_rows(stage, header) if form == "text" else json_rows(stage, header)
    yield 0, head
    for row in range(stage.steps.row_count):
        yield row + 1, row_text(row)
    yield stage.steps.row_count, end


def explanations(stage: StageTrace, row: int) -> Iterator[tuple[int, Explanation]]:
    """Yield the operations of a row with their positions."""
    start, end = (int(position) for position in stage.steps.starts[row : row + 2])
    for position in range(start + 1, end + 1):
        explanation = stage.explain(position)
        assert explanation is not None
        yield position, explanation


def text_rows(stage: StageTrace, header: Header) -> tuple[str, Callable[[int], str], str]:
    """Return the trace for reading: its beginning, what writes a row, and its end.

    A row has the sentence of each of its operations, and the formula below it.
    """

    def row_text(row: int) -> str:
        triangle, pixel = int(stage.triangle[row]), pixel_of(stage, row)
        about = [f"triangle {triangle}"] if triangle >= 0 else []
        about += [f"pixel {pixel}"] if pixel is not None else []
        lines = ["", f"Row {row}, {', '.join([stage.kind_of(row), *about])}"]
        for position, explanation in explanations(stage, row):
            sentence, made = account(explanation, triangle, pixel)
            lines.append(f"{position:>6}  {sentence}")
            if made is not None:
                formulas = (line for line in (made.symbolic, made.substituted) if line)
                lines += [f"          {plain_text(line)}" for line in formulas]
        return "\n".join([*lines, ""])

    return (
        f"{header['scene']}, stage {stage.stage}{f', {stage.method}' if stage.method else ''}\n",
        row_text,
        "",
    )


def json_rows(stage: StageTrace, header: Header) -> tuple[str, Callable[[int], str], str]:
    """Return a JSON object: what was traced, what writes a row on a line of its own, and its end.

    NaN (no value) is ``null``, infinities are the texts ``"Infinity"`` and ``"-Infinity"``.
    """
    steps = stage.steps
    known = {
        **header,
        "stage": stage.stage,
        "method": stage.method,
        "constants": {name: plain(value) for name, value in stage.constants.items()},
        "row_count": steps.row_count,
        "operation_count": steps.count,
        "triangle_ends": steps.triangle_ends.tolist(),
        "group_ends": steps.group_ends.tolist(),
    }

    def row_text(row: int) -> str:
        text = json.dumps(row_record(stage, row), allow_nan=False)
        return f"  {text}{',' if row + 1 < steps.row_count else ''}\n"

    fields = [f" {json.dumps(name)}: {json.dumps(value, allow_nan=False)}," for name, value in known.items()]
    return "\n".join(["{", *fields, ' "rows": [', ""]), row_text, " ]\n}\n"


def row_record(stage: StageTrace, row: int) -> dict[str, Any]:
    """Return everything that is known of one row, in values that JSON has."""
    triangle, pixel, symbols = int(stage.triangle[row]), pixel_of(stage, row), symbols_of(stage)
    operations = []
    for position, explanation in explanations(stage, row):
        listing, line = explanation.listing, explanation.line
        sentence, made = account(explanation, triangle, pixel)
        operations.append(
            {
                "position": position,
                "key": explanation.key,
                "sentence": sentence,
                "formula": {
                    "symbolic": without_macros(made.symbolic),
                    "substituted": without_macros(made.substituted),
                }
                if made is not None
                else None,
                "changed": [symbols.get(name, name) for name in explanation.changed],
                "function": listing.function.__name__ if listing is not None and line else None,
                "line": line or None,
                "code": listing.source.splitlines()[line - 1].strip() if listing and line else None,
            }
        )
    return {
        "row": row,
        "kind": stage.kind_of(row),
        "triangle": triangle if triangle >= 0 else None,
        "pixel": pixel,
        "marks": [name for name, flags in stage.marks.items() if flags[row]],
        "columns": {symbols.get(name, name): plain(column[row]) for name, column in stage.columns.items()},
        "operations": operations,
    }


def csv_parts(stage: StageTrace) -> Iterator[tuple[int, str]]:
    """Yield a CSV table, names first: a line for each row, a column for each element of an array."""
    names, parts = ["row_number", "row_kind", "row_triangle", "pixel_column", "pixel_row"], []
    symbols = symbols_of(stage)
    for name, column in stage.columns.items():
        names += column_names(symbols.get(name, name), column.shape[1:])
        parts += list(column.reshape(len(column), math.prod(column.shape[1:])).T)
    names += [f"is_{mark.replace('-', '_')}" for mark in stage.marks]
    parts += list(stage.marks.values())
    yield 0, csv_text([names])
    kinds = np.array(stage.steps.kinds)
    for first in range(0, stage.steps.row_count, BATCH):
        rows = slice(first, min(first + BATCH, stage.steps.row_count))
        triangle, pixel = stage.triangle[rows], stage.pixel[rows]
        columns = [
            list(range(rows.start, rows.stop)),
            kinds[stage.steps.kind[rows]].tolist(),
            csv_cells(triangle, triangle >= 0),
            *(csv_cells(pixel[:, axis], np.all(pixel >= 0, axis=1)) for axis in (0, 1)),
            *(csv_cells(part[rows]) for part in parts),
        ]
        yield rows.stop, csv_text(zip(*columns, strict=True))


def column_names(name: str, shape: tuple[int, ...]) -> list[str]:
    """Return the names of an array's elements, as ``weights[2]``; a single number keeps its name."""
    if not shape:
        return [name]
    return [f"{name}[{','.join(map(str, index))}]" for index in np.ndindex(*shape)]


def arrays(stage: StageTrace) -> dict[str, NDArray[Any]]:
    """Return the columns by their symbols or names, what the rows are, their marks, and the buffers after the last row.

    Returns
    -------
    dict
        Each column (R, ...); ``row_kind`` (R,) texts; ``row_triangle`` (R,) and ``row_pixel`` (R, 2) int64,
        -1: none; ``triangle_ends``, ``group_ends``; ``mark_NAME`` (R,) bool; ``buffer_NAME`` (h, w) or (h, w, C),
        row 0 at the bottom.
    """
    steps = stage.steps
    symbols = symbols_of(stage)
    found: dict[str, NDArray[Any]] = {symbols.get(name, name): of for name, of in stage.columns.items()}
    found |= {
        "row_kind": np.array(steps.kinds)[steps.kind],
        "row_triangle": stage.triangle,
        "row_pixel": stage.pixel,
        "triangle_ends": steps.triangle_ends,
        "group_ends": steps.group_ends,
    }
    found |= {f"mark_{name.replace('-', '_')}": flags for name, flags in stage.marks.items()}
    buffers = stage.state(steps.count)
    return found | {f"buffer_{name.replace(' ', '_')}": buffer for name, buffer in buffers.items()}


def pixel_of(stage: StageTrace, row: int) -> tuple[int, int] | None:
    """Return column and row of the pixel that a row is about, if it is about one."""
    column, line = (int(number) for number in stage.pixel[row])
    return (column, line) if column >= 0 and line >= 0 else None


def plain(value: Any) -> Any:
    """Return a value, or an array as nested lists, as JSON has it."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list):
        return [plain(part) for part in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else ("Infinity" if value > 0 else "-Infinity")
    return value


def csv_cells(column: NDArray[Any], is_known: Flags | None = None) -> list[Any]:
    """Return values (R,) as CSV has them: flags as 0 and 1, no value (NaN, or not ``is_known``) as an empty cell."""
    if column.dtype.kind == "b":
        column = column.astype(np.int8)
    found: list[Any] = column.tolist()
    if is_known is None:
        is_known = ~np.isnan(column) if column.dtype.kind == "f" else np.ones(len(column), bool)
    for row in np.flatnonzero(~is_known).tolist():
        found[row] = ""
    return found


def csv_text(rows: Iterable[Iterable[Any]]) -> str:
    """Return lines of CSV."""
    text = StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()
