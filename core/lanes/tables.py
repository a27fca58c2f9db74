"""Tables of numbers that lanes read at places of their own: the texels of a texture, and of its mipmap levels."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.records.arrays import Floats, Integers

LEVEL, ROW, COLUMN, CHANNEL = range(4)
"""What an index chooses, in this order."""


@dataclass(frozen=True, eq=False)
class Table:
    """Numbers ``[level][row][column][channel]`` of which some indices are chosen; each a number or (L,)."""

    numbers: Floats
    """(N, C) float64, the texels of all levels, row by row."""
    begins: Integers
    """(K,) int64, the first texel of every level."""
    heights: Integers
    """(K,) int64."""
    widths: Integers
    """(K,) int64."""
    chosen: tuple[Any, ...] = ()

    @property
    def length(self) -> Any:
        """How many elements there are to choose from: a whole number, or (L,) where that differs by lane."""
        place = len(self.chosen)
        if place == LEVEL:
            return len(self.begins)
        if place == CHANNEL:
            return self.numbers.shape[1]
        return _plain((self.heights if place == ROW else self.widths)[self.chosen[LEVEL]])

    @property
    def is_texel(self) -> bool:
        """Whether only a channel is left to choose."""
        return len(self.chosen) == CHANNEL

    def part(self, index: Any) -> Any:
        """Return an element, a number or another table; the index is a whole number or (L,), and inside."""
        if len(self.chosen) < CHANNEL:
            return replace(self, chosen=(*self.chosen, index))
        level, row, column = self.chosen
        texel = self.begins[level] + row * self.widths[level] + column
        return _plain(self.numbers[texel, index])

    def inside(self, index: Any) -> Any:
        """Return indices (L,) moved inside, for lanes that a branch leaves out."""
        return np.clip(index, 0, np.asarray(self.length) - 1)

    def __str__(self) -> str:
        names = ("levels", "rows", "texels", "channels")
        return f"a table of {np.max(self.length)} {names[len(self.chosen)]}"


def _plain(value: Any) -> Any:
    return value if np.ndim(value) else value.item()


def table_of(levels: Sequence[np.ndarray]) -> Table:
    """Return the table of levels, an array (H, W, C) each."""
    sizes = np.array([level.shape[:2] for level in levels], np.int64).reshape(-1, 2)
    counts = sizes.prod(axis=1)
    numbers = np.concatenate([level.reshape(-1, level.shape[2]) for level in levels])
    return Table(numbers.astype(np.float64), np.cumsum(counts) - counts, sizes[:, 0], sizes[:, 1])
