"""Rows of a stage that are each about one primitive, and depend on no other: what an edit elsewhere leaves as it is."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Flags, Integers
from core.records.steps import ends_of


@dataclass(frozen=True, eq=False)
class StageRows:
    """R rows in drawing order: of a trace, what is decided before the pixels of several primitives meet."""

    columns: Mapping[str, NDArray[Any]]
    """Name to (R, ...) array; ``primitive`` (R,) int64, not decreasing, is one of them."""
    kind: Integers
    """(R,) int64, see ``Steps``."""
    ends_group: Flags
    """(R,) bool, a step of the level GROUP ends with the row; every last row of a primitive does so."""
    pixel: Integers
    """(R, 2) int64, see ``StageTrace``."""
    marks: Mapping[str, Flags]
    """Kind of mark to (R,) bool."""

    @property
    def group_ends(self) -> Integers:
        """Numbers of rows after which a group is done, as ``Steps`` has them."""
        ends: Integers = np.flatnonzero(self.ends_group) + 1
        return ends if len(ends) else np.zeros(1, np.int64)


def is_last_of(*keys: Integers) -> Flags:
    """Return (R,) bool, rows after which any of the keys (R,) changes, or that are the last."""
    is_last = np.zeros(len(keys[0]), bool)
    if len(is_last):
        is_last[ends_of(*keys) - 1] = True
    return is_last
