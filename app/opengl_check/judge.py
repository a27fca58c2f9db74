"""Which pixels OpenGL may draw otherwise where it clips: those beside an edge, in exact arithmetic.

Coverage is decided on corners snapped to 1/256 pixel, and a snapped corner lies up to sqrt(2)/512 pixel from its place.
OpenGL snaps the corners that clipping makes too, and computes all window positions in float32, which may put a corner
on the next step. So its edges and the core's both lie beside the given edge, together by at most a step's
diagonal, sqrt(2)/256 pixel: only centres nearer to an edge may show another triangle. Where near and far plane cut a
triangle are edges like the others.
"""

from fractions import Fraction

import numpy as np

from app.opengl_check.case import STEP, Case
from core.records.arrays import Floats, Integers
from core.study.exact.coverage import Corner, homogeneous_corner

BOUND = np.sqrt(2) * STEP
"""Pixels from an edge within which another triangle may be seen."""

Line = tuple[Fraction, Fraction, Fraction]


def edge_distances(case: Case, differing: Integers) -> Floats:
    """Return how far pixels that show different triangles are from the nearest edge that may decide it.

    Parameters
    ----------
    case : Case
        Its triangles are drawn in order, the last one stays.
    differing : (D, 4) int64
        Column, row, and the two triangles seen; -1: none.

    Returns
    -------
    (D,) float64
        Pixels, rounded once from a rational number. Of the two triangles the later one is covered in one picture and
        not in the other: the edges are its own.
    """
    lines: dict[int, list[Line]] = {}
    distances = []
    for column, row, ours, theirs in differing.tolist():
        triangle = max(ours, theirs)
        if triangle not in lines:
            lines[triangle] = edge_lines(case.clip[triangle].astype(float), case.size)
        x, y = Fraction(2 * column + 1, 2), Fraction(2 * row + 1, 2)
        squared = [(a * x + b * y + c) ** 2 / (a * a + b * b) for a, b, c in lines[triangle]]
        distances.append(float(min(squared)) ** 0.5 if squared else np.inf)
    return np.array(distances)


def edge_lines(corners: Floats, size: tuple[int, int]) -> list[Line]:
    """Return the lines a x + b y + c = 0 in the window of a triangle's edges (3, 4) and of its cuts by near and far."""
    placed = [homogeneous_corner(corner, size) for corner in corners]
    edges = [_line_through(placed[k - 2], placed[k - 1]) for k in range(3)]
    cuts = []
    for sign in (1, -1):
        beyond = [Fraction(float(w)) + sign * Fraction(float(z)) for _, _, z, w in corners]
        cuts.append(tuple(sum(f * edge[k] for f, edge in zip(beyond, edges, strict=True)) for k in range(3)))
    return [(Fraction(a), Fraction(b), Fraction(c)) for a, b, c in (*edges, *cuts) if a or b]


def _line_through(first: Corner, second: Corner) -> Line:
    (x1, y1, w1), (x2, y2, w2) = first, second
    return y1 * w2 - w1 * y2, w1 * x2 - x1 * w2, x1 * y2 - y1 * x2
