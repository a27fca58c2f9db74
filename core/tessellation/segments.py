"""Into how many straight pieces a curve is cut, and where: at equal steps, or by halving until they are flat.

References
----------
G. Wang, *The subdivision method for finding the intersection between two Bézier curves or surfaces*, 1984 (the bound).
J. Lane, R. Riesenfeld, *A theoretical development for the computer generation and display of piecewise polynomial
surfaces*, 1980 (halving until flat).
"""

from dataclasses import dataclass
from math import ceil, sqrt

import numpy as np

from core.methods import method
from core.records.arrays import Floats, Integers
from core.tessellation.bezier import halves

TOLERANCE_PARTS = 16
"""The number ``curve_tolerance`` counts parts of a pixel of which one has so many."""
MOST_HALVINGS = 10
"""How often a curve is halved at most: into 1,024 pieces."""


@dataclass(frozen=True, eq=False)
class CurveSteps:
    """Where curves that are cut together are cut: at t = ``step`` / ``steps``."""

    step: Integers
    """(m + 1,) int64, rising from 0 to ``steps``: m straight pieces."""
    steps: int
    tests: tuple[dict[str, float | int | bool], ...] = ()
    """What decided, in order: the numbers of the bound, or of each piece that was tested for flatness."""


def bound_of_segments(bend: float, w_bend: float, reach: float, least_w: float, tolerance: float) -> int:
    """Listing of the bound on segments.

    ``bend`` and ``w_bend`` are the largest second derivatives of x w and y w, and of w; ``reach`` is the distance of
    the farthest control point from the middle of all.
    """
    deviation = (bend + reach * w_bend) / (8 * least_w)  #: deviation
    return max(ceil(sqrt(deviation / tolerance)), 1)  #: count


def distance_from_chord(x: float, y: float, ax: float, ay: float, bx: float, by: float) -> float:
    """Listing of the distance of an inner control point from the chord between both ends."""
    dx, dy = bx - ax, by - ay
    length = dx * dx + dy * dy
    along = ((x - ax) * dx + (y - ay) * dy) / length if length > 0 else 0.0
    along = min(max(along, 0.0), 1.0)
    ex, ey = x - (ax + along * dx), y - (ay + along * dy)
    return sqrt(ex * ex + ey * ey)  #: distance


def is_flat(distance: float, tolerance: float, halvings: int) -> bool:
    """Listing of whether a piece is a straight one, or is halved."""
    return distance <= tolerance or halvings == MOST_HALVINGS  #: flat


def equal_steps(segments: int) -> list[float]:
    """Listing of equal steps: n segments have n + 1 ends."""
    return [step / segments for step in range(segments + 1)]  #: step


def _equal(segments: int, *tests: dict[str, float | int | bool]) -> CurveSteps:
    return CurveSteps(np.arange(segments + 1), segments, tests)


@method(
    "tessellation",
    "uniform",
    "Equal steps",
    source="Pellacini, Vertex processing: complex curves into line strips, curved surfaces into triangles",
    exact_for="points on the curve: the ends of all pieces, and no other point",
    breaks_where="the number is too small for the picture's size; equal steps of t are not equal lengths",
    takes=("segments",),
    listing=equal_steps,
)
def uniform(rows: Floats, segments: int, tolerance: float) -> CurveSteps:
    """Cut curves (R, D + 1, 3), homogeneous x w, y w, w in pixels, at ``segments`` equal steps of t."""
    return _equal(segments)


@method(
    "tessellation",
    "bound",
    "Equal steps to a tolerance",
    source="G. Wang 1984, a bound from second differences of the control points",
    exact_for="the tolerance in the window: no curve of constant u or v is farther from its pieces, where all w > 0",
    breaks_where="neighbours may get different numbers along one edge: a crack; behind the eye, as Equal steps",
    takes=("segments", "curve_tolerance"),
    listing=bound_of_segments,
)
def bound(rows: Floats, segments: int, tolerance: float) -> CurveSteps:
    """Cut curves (R, D + 1, 3), homogeneous x w, y w, w in pixels, into as many equal steps as the bound asks.

    Notes
    -----
    Of n equal steps, x w and w deviate from linear by at most 1 / (8 n^2) of their largest second derivative, so
    x deviates by (bend + reach w_bend) / (8 n^2 w). With equal w this is Wang's bound.
    """
    found = bound_numbers(rows)
    if found is None:
        return _equal(segments)
    count = bound_of_segments(**found, tolerance=tolerance)
    return _equal(count, {**found, "count": count})


def bound_numbers(rows: Floats) -> dict[str, float] | None:
    """Return what the bound on curves (R, D + 1, 3) is made from, by its listing's names; ``None``: some w <= 0."""
    w = rows[..., 2]
    if not (w > 0).all():
        return None
    places = rows[..., :2] / w[..., None]
    middle = places.mean(axis=(0, 1))
    degree = rows.shape[1] - 1
    second = np.zeros((len(rows), 1, 3)) if degree < 2 else np.diff(rows, n=2, axis=1) * degree * (degree - 1)
    aside = second[..., :2] - second[..., 2:] * middle
    return {
        "bend": float(_lengths(aside).max()),
        "w_bend": float(np.abs(second[..., 2]).max()),
        "reach": float(_lengths(places - middle).max()),
        "least_w": float(w.min()),
    }


@method(
    "tessellation",
    "adaptive",
    "Halve until flat",
    source="J. Lane, R. Riesenfeld 1980, halving by de Casteljau's scheme until the control points are on the chord",
    exact_for="the tolerance in the window, of the curves along rows and columns of control points",
    breaks_where="neighbours may be halved differently along one edge: a crack; the twist of a patch is not tested",
    takes=("curve_tolerance",),
    listing=distance_from_chord,
)
def adaptive(rows: Floats, segments: int, tolerance: float) -> CurveSteps:
    """Halve curves (R, D + 1, 3), homogeneous x w, y w, w in pixels, until no control point is farther from its chord.

    All R are halved together. A piece behind the eye is left; one that reaches through it is halved to the limit.
    """
    waiting, steps, ends = [(0, 0, rows)], 2**MOST_HALVINGS, [0]
    tests: list[dict[str, float | int | bool]] = []
    while waiting:
        first, depth, piece = waiting.pop()
        found = farthest_inner(piece)
        width, is_straight = steps >> depth, is_flat(found["distance"], tolerance, depth)
        place = {"first": first, "last": first + width, "halvings": depth}
        tests.append({**found, **place, "is_flat": is_straight})
        if is_straight:
            ends.append(first + width)
            continue
        left, right = halves(piece)
        waiting += [(first + width // 2, depth + 1, right), (first, depth + 1, left)]
    # In lowest terms: a curve that was halved twice is cut at quarters.
    common = int(np.gcd.reduce(ends))
    for test in tests:
        test["first"], test["last"] = test["first"] // common, test["last"] // common
    return CurveSteps(np.array(ends) // common, steps // common, tuple(tests))


def farthest_inner(rows: Floats) -> dict[str, float]:
    """Return the inner control point of curves (R, D + 1, 3) farthest from its chord, by the listing's names.

    The distance is infinite across w = 0.
    """
    names = ("x", "y", "ax", "ay", "bx", "by", "distance")
    w = rows[..., 2]
    if rows.shape[1] < 3 or (w <= 0).all():
        return dict.fromkeys(names, 0.0)
    if not (w > 0).all():
        return dict.fromkeys(names, float("inf"))
    places = rows[..., :2] / w[..., None]
    start, chord, inner = places[:, :1], places[:, -1:] - places[:, :1], places[:, 1:-1]
    dx, dy = chord[..., 0], chord[..., 1]
    x, y = inner[..., 0] - start[..., 0], inner[..., 1] - start[..., 1]
    length = dx * dx + dy * dy
    along = np.clip(np.where(length > 0, (x * dx + y * dy) / np.where(length > 0, length, 1), 0), 0, 1)
    aside = inner - (start + along[..., None] * chord)
    distance = _lengths(aside)
    row, k = np.unravel_index(distance.argmax(), distance.shape)
    numbers = (*inner[row, k], *places[row, 0], *places[row, -1], distance[row, k])
    return dict(zip(names, map(float, numbers), strict=True))


def _lengths(vectors: Floats) -> Floats:
    """Return the lengths (...,) of vectors (..., 2)."""
    x, y = vectors[..., 0], vectors[..., 1]
    return np.asarray(np.sqrt(x * x + y * y))
