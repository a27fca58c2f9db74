"""The law of the marked line: it gives a value to every variable that the step changes, or it decides."""

from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import numpy as np

from core import STAGES
from core.records.listing import Listing
from core.records.operation import Operation, Variables
from tests.core.explain.explained_steps import traces


class Mark(NamedTuple):
    """An operation of a kind of rows, and a line of its listing that it marks."""

    key: str
    operation: Operation
    listing: Listing
    label: str

    @property
    def line(self) -> int:
        return self.listing.lines[self.label]

    @property
    def name(self) -> str:
        return f"{self.key} marks {self.listing.source.splitlines()[self.line - 1].strip()!r} of {self.listing.name}"


def marks_of_traces() -> Iterator[Mark]:
    """Yield what any row of any trace marks, by every outcome."""
    for traced in (trace for group in traces().values() for trace in group):
        for stage in map(traced.stage, STAGES):
            for number, kind in enumerate(stage.steps.kinds):
                rows = np.flatnonzero(stage.steps.kind == number)
                for operation in stage.steps.operations[kind] if rows.size else ():
                    listing = stage.listings.get(f"{kind}.{operation.name}", stage.listings.get(kind))
                    label = operation.label
                    labels = [label] if isinstance(label, str) else np.unique(label(stage.columns, rows)).tolist()
                    for label in labels if listing is not None else ():
                        if label:
                            yield Mark(f"{stage.stage}.{kind}.{operation.name}", operation, listing, label)


@cache
def all_marks() -> tuple[Mark, ...]:
    found = {}
    for mark in marks_of_traces():
        shown = tuple(mark.operation.shows)
        found.setdefault((mark.key, mark.listing.function, mark.label, shown), mark)
    return tuple(found.values())


def names(variables: Variables) -> set[str]:
    """Return what the listing calls variables."""
    return set(variables if isinstance(variables, tuple) else variables.values())


def test_a_marked_line_gives_each_changed_variable_its_value() -> None:
    wrong = {
        mark.name: names(mark.operation.sets) - mark.listing.assigned(mark.line)
        for mark in all_marks()
        if not names(mark.operation.sets) <= mark.listing.assigned(mark.line)
    }
    assert wrong == {}


def test_a_step_that_changes_nothing_marks_a_decision() -> None:
    wrong = [
        mark.name
        for mark in all_marks()
        if not mark.operation.sets and not mark.listing.decides(mark.line)
    ]
    assert wrong == []


def test_what_a_listing_computes_is_set_by_its_line() -> None:
    wrong = {
        mark.name: names(mark.operation.takes) & mark.listing.everywhere
        for mark in all_marks()
        if names(mark.operation.takes) & mark.listing.everywhere
    }
    assert wrong == {}
