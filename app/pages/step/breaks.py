"""Where a run stops: pixels, lines of listings, and a condition; and the steps that they stand for in a stage."""

from contextlib import suppress

import numpy as np

from app.files.state_models import Breakpoints
from core.records.arrays import Integers
from core.trace import StageTrace
from core.trace.conditions import Condition, parse_condition


class Breaks:
    """The breakpoints of the open scene."""

    def __init__(self, record: Breakpoints | None = None) -> None:
        record = record or Breakpoints()
        self.pixels: set[tuple[int, int]] = set(record.pixels)
        self.lines: set[tuple[str, int]] = set(record.lines)
        """Name of the listing's function and line."""
        self._condition: Condition | None = parse_condition(record.condition) if record.condition else None

    @property
    def condition(self) -> str:
        """Text of the condition, empty: none."""
        return self._condition.text if self._condition else ""

    def set_condition(self, text: str, trace: StageTrace) -> None:
        """Stop where a condition holds, as ``E0 < 0.5 and covered``; an empty text takes it away.

        Raises ValueError if the text is not a condition, or names what no stage has; the old condition stays.
        """
        condition = parse_condition(text) if text.strip() else None
        if condition is not None:
            condition.holds(trace)
        self._condition = condition

    def record(self) -> Breakpoints:
        """Return them as files keep them."""
        return Breakpoints(pixels=sorted(self.pixels), lines=sorted(self.lines), condition=self.condition)

    def positions(self, trace: StageTrace) -> Integers:
        """Return the positions, rising, just after a step that a breakpoint stands on."""
        found = np.zeros(trace.steps.row_count, bool)
        for pixel in self.pixels:
            found[trace.rows_at_pixel(*pixel)] = True
        if self._condition is not None:
            # A stage without the variables of the condition has no such row.
            with suppress(ValueError):
                found |= self._condition.holds(trace)
        of_rows = trace.steps.starts[1:][found]
        if not self.lines:
            return of_rows
        return np.unique(np.concatenate([of_rows, *(line_positions(trace, *line) for line in self.lines)]))


def line_positions(trace: StageTrace, function: str, line: int) -> Integers:
    """Return the positions, rising, just after a step of a line of a listing, which goes by its function's name."""
    steps = trace.steps
    found = [np.empty(0, np.int64)]
    for number, kind in enumerate(steps.kinds):
        for place, operation in enumerate(steps.operations[kind]):
            listing = trace.listings.get(f"{kind}.{operation.name}", trace.listings.get(kind))
            if listing is None or listing.name != function:
                continue
            rows = np.flatnonzero(steps.kind == number)
            if isinstance(operation.label, str):
                rows = rows[: len(rows) * (listing.lines.get(operation.label) == line)]
            else:
                ran = operation.label(trace.columns, rows)
                rows = rows[np.isin(ran, [name for name, at in listing.lines.items() if at == line])]
            found.append(steps.starts[:-1][rows] + place + 1)
    return np.unique(np.concatenate(found))
