"""One row for every kind of step and operation: what it says, its formula, and what can be asked about it.

A row is one function under `explains`, in the module of its subject in ``core.explain.subjects``. Its key is
``stage.kind.operation``; ``a|b`` stands for both, ``*`` as the kind for every kind of the stage that has no row of its
own. So a new method that uses the operations of others needs no row at all.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import TypeVar

from core.explain.records import Asked, Formula
from core.explain.step_values import StepValues
from core.records.arrays import Flags, Integers
from core.records.operation import Columns

Said = str | tuple[str, Formula | None]
"""A sentence, alone or with its formula."""
Say = TypeVar("Say", bound=Callable[[StepValues], Said])


@dataclass(frozen=True)
class Row:
    """The explanation of one operation."""

    say: Callable[[StepValues], Said]
    """Returns the sentence of a step, with its formula where the step computes something."""
    asks: Callable[[StepValues], Asked | None] | None = None
    """Returns a question about the step, with its answer; ``None`` where this step has none."""
    decides: bool = False
    """Whether it chooses what the later operations of its row do: a step of a whole row says it, too."""


ROWS: dict[str, Row] = {}
"""``stage.kind.operation`` to its row."""
Which = Callable[[Columns, Integers], Flags]
"""Takes columns and rows (R,) of a trace; returns which of these, (R,) bool."""
REMARKS: dict[str, Which] = {}
"""``stage.kind.operation``, ``a|b`` and ``*`` as in keys, to the rows of which larger steps repeat what it says."""


def explains(
    *keys: str, asks: Callable[[StepValues], Asked | None] | None = None, decides: bool = False
) -> Callable[[Say], Say]:
    """Enter a function as the row of these keys; ValueError for a key that has a row already."""

    def enter(say: Say) -> Say:
        for key in keys:
            for parts in product(*(part.split("|") for part in key.split("."))):
                name = ".".join(parts)
                if name in ROWS:
                    raise ValueError(f"{name} has a row already, in {ROWS[name].say.__module__}")
                ROWS[name] = Row(say, asks, decides)
        return say

    return enter


def find_row(key: str) -> Row | None:
    """Return the row of a key: its own, or that of any kind of the stage."""
    stage, _, operation = key.split(".", 2)
    return ROWS.get(key) or ROWS.get(f"{stage}.*.{operation}")
