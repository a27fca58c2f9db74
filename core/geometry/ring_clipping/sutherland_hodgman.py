"""Sutherland-Hodgman in the window: each ring of a polygon against every side of a convex region, one after the other.

What lies outside a side is cut off, and the new corners are joined along it. Of a concave polygon that falls apart this
leaves one ring with connecting edges, which run to and fro along the region's border: they enclose nothing, so both
rules of filling give the right pixels, but they are sides of the result, and Weiler-Atherton has none.

References
----------
I. Sutherland, G. Hodgman, *Reentrant polygon clipping*, 1974.
F. Pellacini, *Computer Graphics*, "polygon clipping".
"""

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from core.geometry.ring_clipping.records import ClippedPolygon, Row
from core.methods import method
from core.records.arrays import Floats
from core.records.clip_region import check_convex
from core.records.operation import Operation

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
