"""What the maps of an experiment show: cells of a few kinds over two axes, one map for each method."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

UNKNOWN = 255
"""Kind of a cell that has not been run."""


@dataclass(frozen=True)
class CellKind:
    """How cells of one outcome look: a fill and a character, in light and in dark."""

    title: str
    """What it means, in words."""
    mark: str
    """One character, so that no outcome depends on colour alone."""
    fills: tuple[str, str]
    """``#rrggbb`` on a light and on a dark background."""
    inks: tuple[str, str]
    """Colours of the character."""


@dataclass(frozen=True)
class AtlasAxis:
    """One parameter."""

    title: str
    """What a person reads, with the unit."""
    texts: tuple[str, ...]
    """Its values."""
    is_logarithmic: bool = False


@dataclass(frozen=True, eq=False)
class AtlasMap:
    """The cells of one method."""

    key: str
    """What signals name it by."""
    title: str
    cells: NDArray[np.uint8]
    """(rows, columns) uint8, index of the kind or `UNKNOWN`; row 0 is the lowest."""


@dataclass(frozen=True, eq=False)
class AtlasRecord:
    """All maps of one experiment; they have one shape."""

    kinds: tuple[CellKind, ...]
    across: AtlasAxis
    up: AtlasAxis | None
    """``None``: there is one parameter, and each map is a strip."""
    maps: tuple[AtlasMap, ...]

    @property
    def columns(self) -> int:
        """Cells of a map from left to right."""
        return len(self.across.texts)

    @property
    def rows(self) -> int:
        """Cells of a map from bottom to top."""
        return 1 if self.up is None else len(self.up.texts)

    def count(self, kind: int) -> int:
        """Return how many cells of all maps are of a kind."""
        return sum(int(np.count_nonzero(each.cells == kind)) for each in self.maps)


@dataclass(frozen=True)
class CellPlace:
    """One cell: a map, a column and a row."""

    key: str
    column: int
    row: int
