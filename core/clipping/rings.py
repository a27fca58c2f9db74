"""Polygons against a clip window: rings in exact arithmetic, what is left of them, and Sutherland-Hodgman.

The region is moved to the right by e and up by e * e, where e is above 0 and smaller than any number. Then no corner
lies on a side of the other polygon, and no two sides lie on one line: each case of touching has become one of crossing
or of passing by. As e goes to 0 the area is that of the region where it was.

What lies outside a side is cut off, and the new corners are joined along it. Of a concave polygon that falls apart this
leaves one ring with connecting edges, which run to and fro along the region's border: they enclose nothing, so both
rules of filling give the right pixels, but they are sides of the result, and Weiler-Atherton has none.

References
----------
I. Sutherland, G. Hodgman, *Reentrant polygon clipping*, 1974.
F. Pellacini, *Computer Graphics*, "polygon clipping".
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any

import numpy as np

from core.methods import method
from core.records.arrays import Floats
from core.records.clip_region import check_convex
from core.records.listing import Operation

# Rings in exact arithmetic: whole numbers for corners, with the region moved by an infinitely small step.


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


# What methods that clip polygons share: what is left of a polygon, the steps that made it, and no clipping
# at all.


Row = dict[str, Any]
"""``kind``, and the numbers of a step by their names in `COLUMNS`."""

COLUMNS: Mapping[str, Any] = {
    "of_region": False,
    "ring": -1,
    "edge": -1,
    "region_ring": -1,
    "region_edge": -1,
    "is_hole": False,
    "is_turned": False,
    "t": float("nan"),
    "region_t": float("nan"),
    "point": (float("nan"), float("nan")),
    "start": (float("nan"), float("nan")),
    "end": (float("nan"), float("nan")),
    "region_start": (float("nan"), float("nan")),
    "region_end": (float("nan"), float("nan")),
    "start_side": float("nan"),
    "end_side": float("nan"),
    "is_entering": False,
    "is_kept": False,
    "node": -1,
    "next_node": -1,
    "crossing": -1,
    "on_region": False,
    "result_ring": -1,
    "corner_count": -1,
}
"""The numbers of a row, and what stands where it has none."""


@dataclass(frozen=True)
class RingClipTraits:
    """What else is known of a method."""

    listings: Mapping[str, Callable[..., Any]]
    """Kinds of rows with a listing of their own."""


@dataclass(frozen=True, eq=False)
class ClippedPolygon:
    """What is left of one polygon."""

    rings: Sequence[Floats]
    """Rings (K, 2) float64, in pixels."""
    rows: Sequence[Row]
    """Every step, in order."""


@method(
    "polygon_clipping",
    "none",
    "None (scissoring)",
    source="Pellacini, polygon clipping: only clip when necessary",
    exact_for="every polygon in the raster; it ignores the clip window of the scene",
)
def no_polygon_clipping(rings: Sequence[Floats], region: Sequence[Floats]) -> ClippedPolygon:
    """Leave the rings (K, 2) of a polygon as they are."""
    return ClippedPolygon(rings, ())


# Sutherland-Hodgman in the window: each ring of a polygon against every side of a convex region, one after
# the other.


Place = tuple[Fraction, Fraction]
CASES = {
    (False, False): "sh-out-out",
    (False, True): "sh-out-in",
    (True, False): "sh-in-out",
    (True, True): "sh-in-in",
}
"""By whether start and end of an edge are inside."""


def clip_side_listing(ring: Sequence[Place], a: Place, b: Place) -> list[Place]:
    """Listing of one ring against the side of a region from a to b, whose inside lies to its left."""
    left = []
    for k, end in enumerate(ring):
        start = ring[k - 1]
        d0, d1 = _side(a, b, start), _side(a, b, end)  #: distances
        if (d0 >= 0) != (d1 >= 0):
            t = d0 / (d0 - d1)  #: t
            x, y = start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1])  #: corner
            left.append((x, y))
        if d1 >= 0:  #: drop
            left.append(end)  #: keep
    return left


def _side(a: Place, b: Place, place: Place) -> Fraction:
    """Return on which side of a line a place lies, times the line's length: above 0 to the left."""
    return (b[0] - a[0]) * (place[1] - a[1]) - (b[1] - a[1]) * (place[0] - a[0])


_DISTANCES = Operation("sides", "distances", {"start_side": "d0", "end_side": "d1"})
_CORNER = (Operation("t", "t", ("t",)), Operation("crossing", "corner", {"point": "x y"}))
_KEEP = Operation("keep", "keep", {"is_kept": "left"})


@method(
    "polygon_clipping",
    "sutherland-hodgman",
    "Sutherland-Hodgman, ring by ring",
    source="Sutherland and Hodgman 1974; Pellacini, polygon clipping",
    exact_for="the area inside a convex region, in rational arithmetic",
    breaks_where="a concave polygon that falls apart: its parts stay joined by edges along the border. A region that "
    "is not convex is refused",
    needs=("convex-window",),
    listing=clip_side_listing,
    operations={
        "sh-in-in": (_DISTANCES, _KEEP),
        "sh-out-out": (_DISTANCES, Operation("keep", "drop", (), ("is_kept",))),
        "sh-in-out": (_DISTANCES, *_CORNER),
        "sh-out-in": (_DISTANCES, *_CORNER, _KEEP),
    },
)
def sutherland_hodgman(rings: Sequence[Floats], region: Sequence[Floats]) -> ClippedPolygon:
    """Cut the rings (K, 2) of a polygon at the sides of a convex region, both in pixels; clockwise ones are turned."""
    if len(region) > 1:
        raise ValueError("sutherland-hodgman needs a convex clip window, got one with holes")
    corners = [(Fraction(x), Fraction(y)) for x, y in region[0].tolist()]
    if sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(corners, [*corners[1:], *corners[:1]], strict=True)) < 0:
        corners.reverse()
    check_convex(np.array(corners, float))
    found: list[Floats] = []
    rows: list[Row] = []
    for number, ring in enumerate(rings):
        left = [(Fraction(x), Fraction(y)) for x, y in ring.tolist()]
        for m, (a, b) in enumerate(zip(corners, [*corners[1:], *corners[:1]], strict=True)):
            rows += _rows_of_side(left, a, b, {"ring": number, "region_edge": m})
            left = clip_side_listing(left, a, b)
        if len(left) > 2:
            found.append(np.array([[float(x), float(y)] for x, y in left]))
    return ClippedPolygon(found, rows)


def _rows_of_side(ring: Sequence[Place], a: Place, b: Place, common: Row) -> list[Row]:
    """Return a row for every edge of a ring, from the corner before to each corner."""
    rows = []
    for k, end in enumerate(ring):
        start = ring[k - 1]
        first, last = _side(a, b, start), _side(a, b, end)
        row = {
            "kind": CASES[first >= 0, last >= 0],
            **common,
            "edge": (k - 1) % len(ring),
            "is_kept": last >= 0,
        }
        row |= {
            "start": _pixels(start),
            "end": _pixels(end),
            "region_start": _pixels(a),
            "region_end": _pixels(b),
        }
        row |= {"start_side": float(first), "end_side": float(last)}
        if (first >= 0) != (last >= 0):
            t = first / (first - last)
            place = start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1])
            row |= {"t": float(t), "point": _pixels(place)}
        rows.append(row)
    return rows


def _pixels(place: Place) -> tuple[float, float]:
    return float(place[0]), float(place[1])
