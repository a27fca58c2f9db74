"""The trace of a stage as text and JSON, with a sentence and a formula for every operation, as CSV, and as arrays."""

import csv
import json
import math
from collections.abc import Iterator, Sequence
from io import StringIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.explain import account
from core.explain.latex import plain_text, without_macros
from core.trace import Explanation, StageTrace
from core.trace.symbols import symbols_of

Header = dict[str, Any]


def explanations(stage: StageTrace, row: int) -> Iterator[tuple[int, Explanation]]:
    """Yield the operations of a row with their positions."""
    start, end = (int(position) for position in stage.steps.starts[row : row + 2])
    for position in range(start + 1, end + 1):
        explanation = stage.explain(position)
        assert explanation is not None
        yield position, explanation


def text_lines(stage: StageTrace, header: Header) -> Iterator[str]:
    """Yield the trace for reading: every row, the sentence of each of its operations, and the formula below it."""
    yield f"{header['scene']}, stage {stage.stage}{f', {stage.method}' if stage.method else ''}"
    for row in range(stage.steps.row_count):
        triangle, pixel = int(stage.triangle[row]), pixel_of(stage, row)
        about = [f"triangle {triangle}"] if triangle >= 0 else []
        about += [f"pixel {pixel}"] if pixel is not None else []
        yield ""
        yield f"Row {row}, {', '.join([stage.kind_of(row), *about])}"
        for position, explanation in explanations(stage, row):
            sentence, made = account(explanation, triangle, pixel)
            yield f"{position:>6}  {sentence}"
            if made is not None:
                lines = (line for line in (made.symbolic, made.substituted) if line)
                yield from (f"          {plain_text(line)}" for line in lines)


def json_lines(stage: StageTrace, header: Header) -> Iterator[str]:
    """Yield the lines of a JSON object: what was traced, then every row on a line of its own.

    Parameters
    ----------
    stage : StageTrace
    header : dict
        What was traced, values that JSON has.

    Notes
    -----
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
    yield "{"
    for name, value in known.items():
        yield f" {json.dumps(name)}: {json.dumps(value, allow_nan=False)},"
    yield ' "rows": ['
    for row in range(steps.row_count):
        text = json.dumps(row_record(stage, row), allow_nan=False)
        yield f"  {text}{',' if row + 1 < steps.row_count else ''}"
    yield " ]"
    yield "}"


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


def csv_lines(stage: StageTrace) -> Iterator[str]:
    """Yield the lines of a CSV table, names first: a line for each row, a column for each element of an array."""
    names, parts = ["row_number", "row_kind", "row_triangle", "pixel_column", "pixel_row"], []
    symbols = symbols_of(stage)
    for name, column in stage.columns.items():
        flat = column.reshape(len(column), math.prod(column.shape[1:]))
        names += column_names(symbols.get(name, name), column.shape[1:])
        parts.append(flat)
    names += [f"is_{mark.replace('-', '_')}" for mark in stage.marks]
    yield csv_line(names)
    for row in range(stage.steps.row_count):
        pixel = pixel_of(stage, row)
        triangle = int(stage.triangle[row])
        values: list[Any] = [row, stage.kind_of(row), triangle if triangle >= 0 else ""]
        values += pixel if pixel is not None else ("", "")
        for part in parts:
            values += [csv_value(value) for value in part[row].tolist()]
        values += [int(flags[row]) for flags in stage.marks.values()]
        yield csv_line(values)


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


def csv_value(value: Any) -> Any:
    """Return a value as CSV has it: flags as 0 and 1, no value as an empty cell."""
    if isinstance(value, bool):
        return int(value)
    return "" if isinstance(value, float) and math.isnan(value) else value


def csv_line(values: Sequence[Any]) -> str:
    """Return a line of CSV without its end."""
    text = StringIO(newline="")
    csv.writer(text, lineterminator="").writerow(values)
    return text.getvalue()
