"""Tables of whole-number depths: patches drawn in an order into a buffer of infinities, as lectures print them.

References
----------
M. I. Jubair, *Computer Graphics*, "Z-buffer Algorithm": tables of depths with infinities.
F. Pellacini, *Computer Graphics*, "hidden surface elimination using Z-buffer".
LMU, *Computer Graphics 1*, tutorial 5, "Frame and Depth Buffers".
"""

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from core.records.arrays import Floats, checked, read_only
from core.records.words import counted

MOST_DEPTH = 9999
"""Largest depth of a cell that is a number."""
MOST_CELLS, MOST_PATCHES = 32, 16
"""Cells each way, and patches."""
DEPTH_TESTS = {"less": "<", "less-equal": "≤", "greater": ">", "greater-equal": "≥"}
"""Names of the tests, and how a fragment's depth must compare with the buffer's to pass."""
NOTHING, INFINITY = ("-", "–", "−", "."), ("∞", "inf", "oo")
"""How a cell is written that the patch does not cover, and one that is infinitely far."""
_WANTED = f"a whole number from 0 to {MOST_DEPTH}, ∞ (or inf), or - for none"


@dataclass(frozen=True, eq=False)
class DepthTable:
    """P patches, drawn one after another, each a grid of depths."""

    depths: Floats
    """(P, H, W) float64: a whole number, infinity, or NaN where the patch has no fragment; row 0 is the bottom row."""
    colors: Floats
    """(P, 4) float64, linear."""
    test: str = "less"
    """One of `DEPTH_TESTS`. Where larger numbers pass, they stand for 1/w."""

    def __post_init__(self) -> None:
        depths = np.array(self.depths, float)
        if depths.ndim != 3 or min(depths.shape) < 1:
            raise ValueError(f"depths must be (P, H, W) and not empty, got {depths.shape}")
        if len(depths) > MOST_PATCHES or max(depths.shape[1:]) > MOST_CELLS:
            raise ValueError(
                f"a table has at most {MOST_PATCHES} patches of {MOST_CELLS} x {MOST_CELLS} cells, "
                f"got {len(depths)} of {depths.shape[2]} x {depths.shape[1]}"
            )
        finite = depths[np.isfinite(depths)]
        is_bad = (finite < 0) | (finite > MOST_DEPTH) | (finite != np.floor(finite))
        if is_bad.any() or (depths == -np.inf).any():
            bad = finite[is_bad][0] if is_bad.any() else -np.inf
            raise ValueError(f"a depth must be {_WANTED}, got {bad:g}")
        colors = checked("colors", self.colors, ("P", 4))
        if len(colors) != len(depths):
            raise ValueError(f"colors must be ({len(depths)}, 4), got {colors.shape}")
        if self.test not in DEPTH_TESTS:
            raise ValueError(f"the depth test must be one of {', '.join(DEPTH_TESTS)}, got {self.test}")
        if np.isnan(depths).all():
            raise ValueError("a table needs at least one depth: all cells are empty")
        object.__setattr__(self, "depths", read_only(depths))
        object.__setattr__(self, "colors", colors)

    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows."""
        return self.depths.shape[2], self.depths.shape[1]

    @property
    def cleared(self) -> float:
        """What the empty buffer holds, see `cleared_for`."""
        return cleared_for(self.test)


def cleared_for(test: str) -> float:
    """Return what the empty buffer of a depth test holds, so that nothing is farther: infinity, or 1/w = 0."""
    return np.inf if test.startswith("less") else 0.0


def depths_of_text(text: str) -> Floats:
    r"""Read a grid of depths (H, W) as people type it: a line for each row, the top row first, cells apart by gaps.

    Raises
    ------
    ValueError
        For a cell that is no depth, and for rows of different lengths; the message names row and cell.

    Examples
    --------
    >>> depths_of_text("- 5\n7 inf").tolist()
    [[7.0, inf], [nan, 5.0]]
    """
    lines = [re.split(r"[\s,;|]+", line.strip(" \t,;|")) for line in text.splitlines() if line.strip()]
    if not lines:
        raise ValueError("a patch needs at least one row of cells")
    for number, line in enumerate(lines, start=1):
        if len(line) != len(lines[0]):
            raise ValueError(
                f"row {number} has {counted(len(line), 'cell')}, row 1 has {len(lines[0])}: all need as many"
            )
    rows = [
        [_depth(cell, f"row {number}, cell {place}: ") for place, cell in enumerate(line, start=1)]
        for number, line in enumerate(lines, start=1)
    ]
    return np.array(rows[::-1])


def depth_of_text(text: str) -> float:
    """Read one cell: a whole number, infinity, or NaN for none; ValueError says what is wanted."""
    return _depth(text.strip() or "-", "")


def depth_text(depth: float) -> str:
    """Write one cell, as `depth_of_text` reads it."""
    if np.isnan(depth):
        return "–"
    return str(int(depth)) if np.isfinite(depth) else "∞" if depth > 0 else "−∞"


def text_of_depths(depths: ArrayLike) -> str:
    """Write a grid of depths (H, W), the top row first, as `depths_of_text` reads it."""
    rows = np.asarray(depths, float)[::-1].tolist()
    return "\n".join("\t".join(map(depth_text, row)) for row in rows) + "\n"


def _depth(text: str, where: str) -> float:
    if text in NOTHING:
        return np.nan
    if text.lower().lstrip("+") in INFINITY:
        return np.inf
    if not re.fullmatch(r"[0-9]{1,6}", text) or int(text) > MOST_DEPTH:
        raise ValueError(f"{where}expected {_WANTED}, got {text}")
    return float(text)
