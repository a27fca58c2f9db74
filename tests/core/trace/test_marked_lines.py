"""The law of the marked line: it gives a value to every variable that the step changes, or it decides."""

from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from core import STAGES
from core.explain.steps import load_subjects
from core.explain.variable_text import VARIABLES
from core.records.listing import Listing
from core.records.operation import Operation, Variables
from core.trace import StageTrace
from tests.core.explain.explained_steps import traces


class Mark(NamedTuple):
    """An operation of a kind of rows, and a line of its listing that it marks."""

    key: str
    operation: Operation
    listing: Listing
    line: int
    changed: frozenset[str]
    """What the listing calls the variables that get a value in any of the rows."""

    @property
    def name(self) -> str:
        shown = self.listing.source.splitlines()[self.line - 1].strip()
        return f"{self.key} marks {shown!r} of {self.listing.name}"


OF_LINES = "core.raster.lines."
"""Where listings stand whose variables are not named yet as their steps name them."""


def names(variables: Variables) -> dict[str, str]:
    """Return variables and what the listing calls them, one name or several."""
    return {name: name for name in variables} if isinstance(variables, tuple) else dict(variables)


def changes(stage: StageTrace, name: str, rows: NDArray[np.int64]) -> bool:
    """Return whether a variable gets a value in any of these rows, another one than it had."""
    text = VARIABLES[stage.stage].get(name)
    values = stage.columns[name][rows]
    if text is not None and text.previous in stage.columns:
        return not np.array_equal(
            values, stage.columns[text.previous][rows], equal_nan=values.dtype.kind == "f"
        )
    return values.dtype.kind != "f" or not np.isnan(values).all()


def marks_of(stage: StageTrace, kind: str, rows: NDArray[np.int64]) -> Iterator[Mark]:
    """Yield what the rows of a kind mark, by every outcome."""
    for operation in stage.steps.operations[kind]:
        listing = stage.listings.get(f"{kind}.{operation.name}", stage.listings.get(kind))
        ran = np.full(len(rows), operation.label) if isinstance(operation.label, str) else None
        ran = operation.label(stage.columns, rows) if ran is None else ran
        for label in np.unique(ran).tolist() if listing is not None else ():
            if label and not listing.function.__module__.startswith(OF_LINES):
                found = names(operation.sets).items()
                changed = [
                    called.split() for name, called in found if changes(stage, name, rows[ran == label])
                ]
                line, key = listing.lines[label], f"{stage.stage}.{kind}.{operation.name}"
                yield Mark(key, operation, listing, line, frozenset().union(*changed))


@cache
def all_marks() -> tuple[Mark, ...]:
    """Return what any row of any trace marks."""
    load_subjects()
    found = {}
    for traced in (trace for group in traces().values() for trace in group):
        for stage in map(traced.stage, STAGES):
            for number, kind in enumerate(stage.steps.kinds):
                rows = np.flatnonzero(stage.steps.kind == number)
                for mark in marks_of(stage, kind, rows) if rows.size else ():
                    found.setdefault((mark.key, mark.listing.function, mark.line, mark.changed), mark)
    return tuple(found.values())


def test_a_marked_line_gives_each_changed_variable_its_value() -> None:
    wrong = [
        (mark.name, sorted(mark.changed))
        for mark in all_marks()
        if not mark.changed <= mark.listing.assigned(mark.line)
    ]
    assert wrong == []


def test_a_step_that_changes_nothing_marks_a_decision() -> None:
    wrong = [
        mark.name for mark in all_marks() if not mark.operation.sets and not mark.listing.decides(mark.line)
    ]
    assert wrong == []


def test_what_a_listing_computes_is_set_by_its_line() -> None:
    wrong = [
        (mark.name, taken)
        for mark in all_marks()
        for taken in names(mark.operation.takes).values()
        if taken in mark.listing.everywhere
    ]
    assert wrong == []
