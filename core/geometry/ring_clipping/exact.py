"""Rings in exact arithmetic: whole numbers for corners, with the region moved by an infinitely small step.

The region is moved to the right by e and up by e * e, where e is above 0 and smaller than any number. Then no corner
lies on a side of the other polygon, and no two sides lie on one line: each case of touching has become one of crossing
or of passing by. As e goes to 0 the area is that of the region where it was.
"""

from collections.abc import Sequence
from fractions import Fraction
from math import lcm
from typing import Any

import numpy as np

from core.records.arrays import Floats

Point = tuple[int, int]
AnyPoint = tuple[Any, Any]
"""x and y as whole numbers or fractions."""
Ring = list[Point]
Near = tuple[int, int, int]
"""A number a + b e + c e e; they are compared as tuples are."""
Share = tuple[Fraction, Fraction, Fraction]
"""The same of a part of a side, from 0 to 1."""


def whole_rings(polygons: Sequence[Sequence[Floats]]) -> tuple[list[list[Ring]], int]:
    """Return the rings (K, 2) of polygons in whole numbers, and by what their pixels were multiplied.

    Corners at the place of the one before are left out.
    """
    exact = [[[(Fraction(x), Fraction(y)) for x, y in ring.tolist()] for ring in rings] for rings in polygons]
    scale = lcm(*(part.denominator for rings in exact for ring in rings for place in ring for part in place))
    whole = [[[(int(x * scale), int(y * scale)) for x, y in ring] for ring in rings] for rings in exact]
    distinct = [[[p for k, p in enumerate(ring) if p != ring[k - 1]] for ring in rings] for rings in whole]
    return [[ring for ring in rings if len(ring) > 2] for rings in distinct], scale


def turn(a: AnyPoint, b: AnyPoint, c: AnyPoint) -> Any:
    """Return twice the signed area of a triangle: above 0 where c lies to the left of the line from a to b."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def turn_of_moved(a: Point, b: Point, moved: Point) -> Near:
    """Return `turn` of a corner of the region, which is moved: 0 for none."""
    return turn(a, b, moved), a[1] - b[1], b[0] - a[0]


def turn_about_moved(a: Point, b: Point, place: Point) -> Near:
    """Return `turn` of a place about a side of the region, which is moved."""
    return turn(a, b, place), b[1] - a[1], a[0] - b[0]


def is_above(value: Near) -> bool:
    """Return whether a number is above 0."""
    return value > (0, 0, 0)


def sides_of(ring: Sequence[AnyPoint]) -> list[tuple[AnyPoint, AnyPoint]]:
    """Return both ends of the sides of a ring; side k begins at corner k."""
    return list(zip(ring, [*ring[1:], *ring[:1]], strict=True))


def doubled_area(ring: Ring) -> int:
    """Return twice the signed area inside a ring: above 0 where it runs counter-clockwise."""
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in sides_of(ring))


def is_in_region(place: Point, region: Sequence[Ring]) -> bool:
    """Return whether a place lies inside an odd number of rings of the moved region."""
    inside = False
    for ring in region:
        for a, b in sides_of(ring):
            # Moved up, an end at the height of the place lies above it.
            if (a[1] < place[1]) != (b[1] < place[1]):
                inside ^= is_above(turn_about_moved(a, b, place)) == (b[1] > a[1])  #: verdict
    return inside


def is_moved_inside(place: Point, rings: Sequence[Ring]) -> bool:
    """Return whether a corner of the region, which is moved, lies inside an odd number of rings."""
    inside = False
    for ring in rings:
        for a, b in sides_of(ring):
            if (a[1] <= place[1]) != (b[1] <= place[1]):
                inside ^= is_above(turn_of_moved(a, b, place)) == (b[1] > a[1])
    return inside


def depth_of(ring: int, rings: Sequence[Ring]) -> int:
    """Return how many other rings a ring lies in; they neither cross nor touch it."""
    return sum(is_in_region(rings[ring][0], [other]) for k, other in enumerate(rings) if k != ring)


def meeting_sides(rings: Sequence[Ring], name: str) -> str:
    """Return where the rings of a polygon, which has a name, cross or touch each other or themselves; "": nowhere."""
    meeting = sides_that_meet(rings)
    if meeting is None:
        return ""
    (r, k), (s, m) = meeting
    return f"side {k} of ring {r} of the {name} meets side {m} of ring {s}"


def sides_that_meet(rings: Sequence[Sequence[AnyPoint]]) -> tuple[tuple[int, int], tuple[int, int]] | None:
    """Return the first two sides, each as ring and side, with more in common than the corner between neighbours."""
    sides = [(r, k, a, b) for r, ring in enumerate(rings) for k, (a, b) in enumerate(sides_of(ring))]
    ends = np.array([(a, b) for _, _, a, b in sides], float).reshape(-1, 2, 2)
    low, high = ends.min(axis=1), ends.max(axis=1)
    # Rounding to float64 keeps the order of numbers, so it parts no boxes that have a point in common.
    is_near = np.all([low[:, None] <= high, low <= high[:, None]], axis=(0, 3))
    for first, second in np.argwhere(np.triu(is_near, 1)).tolist():
        (r, k, a, b), (s, m, c, d) = sides[first], sides[second]
        last = len(rings[r]) - 1
        if r == s and (m == k + 1 or (k, m) == (0, last)):
            shared, one, other = (b, a, d) if m == k + 1 else (a, b, c)
            along = sum((p - q) * (e - q) for p, e, q in zip(one, other, shared, strict=True))
            meets = turn(shared, one, other) == 0 and along > 0
        else:
            meets = _have_common_point(a, b, c, d)
        if meets:
            return (r, k), (s, m)
    return None


def _have_common_point(a: AnyPoint, b: AnyPoint, c: AnyPoint, d: AnyPoint) -> bool:
    """Return whether the segments from a to b and from c to d meet."""
    turns = turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b)
    if not any(turns):
        boxes = zip(zip(a, b, strict=True), zip(c, d, strict=True), strict=True)
        return all(bool(max(one) >= min(other) and max(other) >= min(one)) for one, other in boxes)
    return bool(turns[0] * turns[1] <= 0 and turns[2] * turns[3] <= 0)
