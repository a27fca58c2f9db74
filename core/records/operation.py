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


@dataclass(frozen=True)
class Operation:
    """One thing that a row does."""

    name: str
    """Key of its sentence and formula, within the kind of its row."""
    label: str | Labels
    """Label of the line of the listing that ran; empty where no line of it did."""
    sets: tuple[str, ...] = ()
    """Variables that it gives a value."""

    def label_at(self, columns: Columns, row: int) -> str:
        """Return the label of the line that ran in one row."""
        if isinstance(self.label, str):
            return self.label
        return str(self.label(columns, slice(row, row + 1))[0])


def either(flag: str, when_set: str, otherwise: str) -> Labels:
    """Return the labels of an operation that does one thing or another: the column ``flag`` (R,) bool decides."""
    return lambda columns, rows: np.where(columns[flag][rows], when_set, otherwise)
