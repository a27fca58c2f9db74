"""Tables that fill while a stage is stepped: each is read from the rows of the trace up to one step.

A topic's ``told`` file enters the maker of its table with `tabulates`, for the kinds of rows that the
table is about; `step_table` finds it for a position. `filled_table` makes the usual one: a row of the table for each
row of the trace, and a column for each number.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar
from weakref import WeakKeyDictionary

import numpy as np

from core.explain.number_text import exact_text, full_text, in_words
from core.explain.records import Value
from core.explain.step_values import StepValues
from core.explain.steps import load_subjects, sentence
from core.records.arrays import Integers
from core.records.steps import Level, StepTable, TableCell, TableColumn
from core.records.words import nouns
from core.trace.stage_trace import StageTrace

Maker = Callable[[StageTrace, Integers, int], StepTable]
"""Makes the table of rows (r,) of a trace, all those of one unit that are of its kinds, at a position."""
Make = TypeVar("Make", bound=Maker)
NONE = TableCell("–", "–", -1)
"""A row has no such number."""
WHOLE = ""
"""As ``after`` of a column: its cell is known when its row is done."""


@dataclass(frozen=True)
class Form:
    """A kind of table."""

    kinds: frozenset[str]
    """Kinds of rows that it is about."""
    make: Maker
    level: Level
    """One table for each step of this level."""


@dataclass(frozen=True)
class FilledColumn:
    """A column whose cells are read from the rows of a trace."""

    symbol: str
    meaning: str
    value: Callable[[StepValues], Value]
    """Reads the cell of one row; ``None``: it has none."""
    after: str = WHOLE
    """The variable of the trace that must be known."""
    vertex: int | None = None


_FORMS: dict[str, list[Form]] = {}
"""By stage."""
LARGEST = 4
"""Units of work with the most rows whose tables say how much room the others need."""
_KEPT: WeakKeyDictionary[StageTrace, list[StepTable]] = WeakKeyDictionary()
"""Their tables, by trace."""


def tabulates(stage: str, kinds: Sequence[str], level: Level = Level.GROUP) -> Callable[[Make], Make]:
    """Enter the maker of the table of these kinds of rows; one table for each unit of ``level``."""

    def enter(make: Make) -> Make:
        _FORMS.setdefault(stage, []).append(Form(frozenset(kinds), make, level))
        return make

    return enter


def first_in_table(trace: StageTrace) -> int:
    """Return the first row of a stage that stands in a table, or the number of its rows: none does."""
    load_subjects()
    kinds = {kind for form in _FORMS.get(trace.stage, ()) for kind in form.kinds}
    found = (trace.steps.kind == k for k, kind in enumerate(trace.steps.kinds) if kind in kinds)
    return min((int(rows.argmax()) for rows in found if rows.any()), default=trace.steps.row_count)


def step_table(trace: StageTrace, position: int) -> StepTable | None:
    """Return the table of the unit of work that a position is in, as far as it is filled; ``None``: it has none.

    Before the first step it is that of the first unit, and empty.
    """
    load_subjects()
    steps = trace.steps
    row = max(steps.row_at(position)[0], 0)
    kind = trace.kind_of(row) if steps.row_count else ""
    # Of several tables of one unit, that of the present row.
    for form in sorted(_FORMS.get(trace.stage, ()), key=lambda form: kind not in form.kinds):
        numbers = [k for k, kind in enumerate(steps.kinds) if kind in form.kinds]
        if not numbers:
            continue
        rows = _unit(trace, row, form.level)
        rows = rows[np.isin(steps.kind[rows], numbers)]
        if len(rows):
            return form.make(trace, rows, position)
    return None


def largest_tables(trace: StageTrace) -> list[StepTable]:
    """Return, filled to the end, the tables of the `LARGEST` units of work of a stage: made once, by any thread."""
    if trace not in _KEPT:
        _KEPT[trace] = _largest_tables(trace)
    return _KEPT[trace]


def _largest_tables(trace: StageTrace) -> list[StepTable]:
    load_subjects()
    steps, found = trace.steps, []
    for form in _FORMS.get(trace.stage, ()):
        numbers = [k for k, kind in enumerate(steps.kinds) if kind in form.kinds]
        rows = np.flatnonzero(np.isin(steps.kind, numbers))
        if not len(rows):
            continue
        ends = _unit_ends(trace, form.level)
        units = np.searchsorted(ends, rows, "right")
        largest = np.argsort(-np.bincount(units), kind="stable")[:LARGEST]
        for unit in np.intersect1d(largest, units).tolist():
            after = int(ends[unit]) if unit < len(ends) else steps.row_count
            of_unit = rows[units == unit]
            # A table may give way to another one once its own rows are done.
            for last in {int(of_unit[-1]), after - 1}:
                found.append(form.make(trace, of_unit, steps.position_after(last)))
    return found


def _unit_ends(trace: StageTrace, level: Level) -> Integers:
    """Return behind which rows the steps of a level end."""
    if level == Level.STAGE:
        return np.array([trace.steps.row_count])
    return trace.steps.triangle_ends if level == Level.TRIANGLE else trace.steps.group_ends


def _unit(trace: StageTrace, row: int, level: Level) -> Integers:
    """Return the rows of the step of a level that a row is part of."""
    ends = _unit_ends(trace, level)
    after = int(np.searchsorted(ends, row, "right"))
    first = int(ends[after - 1]) if after else 0
    return np.arange(first, int(ends[after]) if after < len(ends) else trace.steps.row_count)


def filled_table(
    trace: StageTrace,
    rows: Integers,
    position: int,
    title: str,
    row_title: str,
    labels: Sequence[str],
    columns: Sequence[FilledColumn],
    *,
    closing: int | None = None,
    note: str = "",
    grows: bool = False,
) -> StepTable:
    """Return a table with one row for each row of a trace.

    Parameters
    ----------
    rows : (r,) int64
        Rows of the trace, in order.
    labels : sequence of str
        Of the rows; more than r, where it is known that the work could have gone on.
    closing : int, optional
        The row of the trace that finishes the table; by default the last one of ``rows``.
    note : str
        What the finished table decides; by default what that row says.
    grows : bool
        Whether rows appear as they are begun: their number is not known before.
    """
    steps = trace.steps
    current, _ = steps.row_at(position)
    closing = int(rows[-1]) if closing is None else closing
    is_done = position >= steps.position_after(closing)
    if is_done:
        note = note or last_sentence(trace, closing)
    begun = rows[steps.starts[rows] < position] if grows else rows
    labels = labels[: len(begun)] if grows else labels
    cells = [_cells(trace, row, position, columns) for row in begun.tolist()]
    cells += [(None,) * len(columns)] * (len(labels) - len(cells))
    made = {
        (k, place)
        for k, line in enumerate(cells)
        for place, cell in enumerate(line)
        if cell is not None and cell.position == position
    }
    at = np.flatnonzero(begun == current)
    return StepTable(
        title,
        row_title,
        tuple(
            TableColumn(column.symbol, nouns(trace.corner_count).text(column.meaning), column.vertex)
            for column in columns
        ),
        tuple(labels),
        tuple(cells),
        frozenset(made),
        int(at[0]) if len(at) else -1,
        note if is_done else "",
    )


def primitive_name(trace: StageTrace, row: int) -> str:
    """Return what a row is about, as ``triangle 5``."""
    return f"{nouns(trace.corner_count).one} {int(trace.triangle[row])}"


def last_sentence(trace: StageTrace, row: int) -> str:
    """Return what a row says when it is done."""
    explanation = trace.explain(trace.steps.position_after(row))
    assert explanation is not None
    return sentence(explanation, int(trace.triangle[row]), None)


def _cells(
    trace: StageTrace, row: int, position: int, columns: Sequence[FilledColumn]
) -> tuple[TableCell | None, ...]:
    """Return the cells of a row whose numbers are known at a position."""
    start, end = int(trace.steps.starts[row]), trace.steps.position_after(row)
    if position <= start:
        return (None,) * len(columns)
    operations = trace.steps.operations[trace.kind_of(row)]
    explanation = trace.explain(min(position, end))
    assert explanation is not None
    step = StepValues(explanation, int(trace.triangle[row]))

    def cell(column: FilledColumn) -> TableCell | None:
        done = len(operations)
        if column.after != WHOLE:
            done = next((k for k, one in enumerate(operations, start=1) if column.after in one.shows), 0)
        if done == 0:
            return NONE if position >= end else None
        if position < start + done:
            return None
        value = column.value(step)
        return NONE if value is None else TableCell(*cell_texts(value), start + done)

    return tuple(cell(column) for column in columns)


def cell_texts(value: Value) -> tuple[str, str]:
    """Return a value as formulas write it, and with all digits."""
    if isinstance(value, tuple):
        parts = [cell_texts(part) for part in value]
        return f"({', '.join(text for text, _ in parts)})", f"({', '.join(full for _, full in parts)})"
    if isinstance(value, bool):
        return ("yes", "yes") if value else ("no", "no")
    if isinstance(value, str) or value is None:
        return in_words(value or "", {}), in_words(value or "", {})
    return exact_text(value), full_text(value)
