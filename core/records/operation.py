"""What a row of a trace does: methods name the operations of their rows, and wait for nothing else that steps."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Columns = Mapping[str, NDArray[Any]]
"""Every number of a trace: name to (R, ...) array."""
Labels = Callable[[Columns, Any], NDArray[np.str_]]
"""Takes columns and rows (C,) int64 or a slice; returns (C,) labels, where the outcome decides which line ran."""
Variables = tuple[str, ...] | Mapping[str, str]
"""Columns of the trace; or each column and what the listing calls it, where that is another name."""


@dataclass(frozen=True)
class Operation:
    """One thing that a row does."""

    name: str
    """Key of its sentence and formula, within the kind of its row."""
    label: str | Labels
    """Label of the line of the listing that ran; empty where no line of it did."""
    sets: Variables = ()
    """Variables that its line gives a value."""
    takes: Variables = ()
    """Variables that are shown from now on, though no line of the listing gives them a value."""

    @property
    def shows(self) -> tuple[str, ...]:
        """Columns that have a value once it is done."""
        return *self.sets, *self.takes

    def label_at(self, columns: Columns, row: int) -> str:
        """Return the label of the line that ran in one row."""
        if isinstance(self.label, str):
            return self.label
        return str(self.label(columns, slice(row, row + 1))[0])


@dataclass(frozen=True)
class Either:
    """`Labels` of an operation that does one thing or another."""

    flag: str
    """The column (R,) bool that decides."""
    when_set: str
    otherwise: str

    def __call__(self, columns: Columns, rows: Any) -> NDArray[np.str_]:
        """Return the labels (C,) of rows."""
        return np.where(columns[self.flag][rows], self.when_set, self.otherwise)
