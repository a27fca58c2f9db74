"""Split and dice: patches into micropolygons of a size in pixels, whatever their own size is.

References
----------
R. Cook, L. Carpenter, E. Catmull, *The Reyes image rendering architecture*, SIGGRAPH 1987.
"""

import numpy as np

from core.methods import method
from core.records.arrays import Floats
from core.tessellation.bezier import halves
from core.tessellation.segments import MOST_HALVINGS, CurveSteps

GRID_SIDE = 16
"""Pixels that a grid of micropolygons is long at most: a longer piece is split."""


def dice_or_split(longest: list[float], side: float, halvings: int) -> int:
    """Listing of one step: into how many parts a piece is diced, 0: it is split in two.

    ``longest`` are the lengths of the longest of 1, 2, 4 ... parts.
    """
    if longest[0] > GRID_SIDE and halvings < MOST_HALVINGS:  #: split
        return 0
    parts = 1
    for size in longest:
        if size <= side:
            break
        parts = 2 * parts  #: dice
    return parts


@method(
    "tessellation",
    "reyes",
    "Split and dice (REYES)",
    source="R. Cook, L. Carpenter, E. Catmull 1987; Pellacini, REYES",
    exact_for="the side: no curve along a row or column of control points is longer in a micropolygon, where all w > 0",
    breaks_where="neighbours may be split differently along one edge: a crack; colours between shaded points are mixed",
    takes=("curve_tolerance",),
    listing=dice_or_split,
)
def reyes(rows: Floats, segments: int, tolerance: float) -> CurveSteps:
    """Cut curves (R, D + 1, 3), homogeneous x w, y w, w in pixels, into parts at most ``tolerance`` pixels long.

    Notes
    -----
    A curve is at most as long as its control polygon. Parts are counted in powers of two, so that pieces that were
    split alike are cut in the same places.
    """
    waiting, ends, tests = [(0, 0, rows)], [0.0], []
    while waiting:
        first, depth, piece = waiting.pop()
        longest, width = lengths_of_parts(piece, tolerance), 0.5**depth
        parts = dice_or_split(longest, tolerance, depth)
        if parts == 0:
            left, right = halves(piece)
            waiting += [(2 * first + 1, depth + 1, right), (2 * first, depth + 1, left)]
        else:
            ends += (first * width + width * np.arange(1, parts + 1) / parts).tolist()
        size = {"piece_length": longest[0], "part_length": longest[-1], "micro_side": tolerance}
        tests.append({**size, "halvings": depth, "parts": parts, "place": first})
    # All ends are halves of halves: in whole steps of the shortest.
    steps = int(1 / np.diff(ends).min())
    return CurveSteps(np.rint(np.array(ends) * steps).astype(np.int64), steps, tuple(tests))


def control_length(rows: Floats) -> float:
    """Return the length in pixels of the longest control polygon of curves (R, D + 1, 3); infinite across w = 0."""
    w = rows[..., 2]
    if (w <= 0).all():
        return 0.0
    if not (w > 0).all():
        return float("inf")
    sides = np.diff(rows[..., :2] / w[..., None], axis=1)
    return float(np.sqrt((sides * sides).sum(axis=2)).sum(axis=1).max())


def lengths_of_parts(rows: Floats, side: float) -> list[float]:
    """Return the length in pixels of the longest of 1, 2, 4 ... parts of curves (R, D + 1, 3), until none is too long.

    A piece that is too long for a grid has the first alone.
    """
    parts, found = rows, [control_length(rows)]
    while side < found[-1] <= GRID_SIDE and len(found) <= MOST_HALVINGS:
        parts = np.concatenate(halves(parts))
        found.append(control_length(parts))
    return found
