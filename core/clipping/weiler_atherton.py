"""Weiler-Atherton: a polygon with holes against a region that may be concave and have holes, by walking both.

Sides of the two polygons cross where the polygon enters the region or leaves it. From each entry the walk follows the
polygon; at the next crossing, where the polygon leaves, it goes on along the region, until that leaves the polygon's
outside again; and so on, until it is back. Rings without crossings are kept where they lie inside the other polygon.

The interior lies to the left of all rings here: outlines are turned counter-clockwise, holes clockwise, by how many
rings they lie in, so it does not matter which way they come.

Where the two polygons touch (a corner on a side, a common side, equal polygons), the region counts as moved by an
infinitely small step to the right and up (`core.clipping.rings`). Rings without area that this would
leave are dropped, so the result has the area of the exact intersection.

References
----------
K. Weiler, P. Atherton, *Hidden surface removal using polygon area sorting*, 1977.
M. Zwicker, *Computergrafik*, lecture "Clipping": Weiler-Atherton, for concave polygons.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from core.clipping.rings import (
    ClippedPolygon,
    Near,
    Ring,
    RingClipTraits,
    Row,
    Share,
    depth_of,
    doubled_area,
    is_above,
    is_in_region,
    is_moved_inside,
    sides_of,
    turn_about_moved,
    turn_of_moved,
    whole_rings,
)
from core.methods import method
from core.records.arrays import Floats
from core.records.listing import Operation

Place = tuple[Fraction, Fraction]
Node = int
"""Corners of the polygon, then those of the region, then crossings, are numbered on."""
SUBJECT, REGION = 0, 1


def walk_listing(
    after: Sequence[dict[Node, Node]], entries: Sequence[Node], crossings: set[Node]
) -> list[list[Node]]:
    """Listing of the walk: which node comes after each one on the polygon and on the region; returns rings."""
    rings, left = [], list(entries)
    while left:
        first = node = left.pop(0)  #: start
        ring, on = [], SUBJECT
        while True:
            ring.append(node)
            node = after[on][node]  #: next
            if node in crossings:
                on = 1 - on  #: switch
            if node in left:
                left.remove(node)
            if node == first:  #: close
                break
        rings.append(ring)
    return rings


@dataclass(frozen=True)
class Crossing:
    """Where a side of the polygon crosses one of the region."""

    edge: tuple[int, int]
    """Ring and side of the polygon."""
    region_edge: tuple[int, int]
    """Ring and side of the region."""
    t: Share
    """Where it lies on the side of the polygon, from 0 to 1."""
    region_t: Share
    """Where it lies on the side of the region."""
    is_entering: bool
    """Whether the polygon comes into the region."""
    place: Place


def turned(rings: list[Ring]) -> list[tuple[Ring, bool, bool]]:
    """Return rings with the interior to their left; for each, whether it is a hole, and was turned round."""
    found = []
    for index, ring in enumerate(rings):
        is_hole = depth_of(index, rings) % 2 == 1  #: direction
        is_turned = (doubled_area(ring) > 0) == is_hole  #: turn
        found.append((ring[::-1] if is_turned else ring, is_hole, is_turned))
    return found


def find_crossings(rings: Sequence[Ring], region: Sequence[Ring]) -> list[Crossing]:
    """Return all crossings of the sides of two polygons."""
    found = []
    for r, ring in enumerate(rings):
        for k, (p, q) in enumerate(sides_of(ring)):
            for s, other in enumerate(region):
                for m, (a, b) in enumerate(sides_of(other)):
                    if max(p[0], q[0]) < min(a[0], b[0]):
                        continue
                    if max(a[0], b[0]) < min(p[0], q[0]):
                        continue
                    start = turn_about_moved(a, b, p)
                    end = turn_about_moved(a, b, q)
                    if is_above(start) == is_above(end):
                        continue
                    first = turn_of_moved(p, q, a)
                    last = turn_of_moved(p, q, b)
                    if is_above(first) == is_above(last):
                        continue
                    t, u = _share(start, end), _share(first, last)  #: place
                    place = _between(p, q, t)  #: point
                    entering = is_above(end)  #: way
                    found.append(Crossing((r, k), (s, m), t, u, entering, place))
    return found


def _between(p: Place, q: Place, t: Share) -> Place:
    """Return the point at a share of the way, without the parts of it that are infinitely small."""
    return p[0] + t[0] * (q[0] - p[0]), p[1] + t[0] * (q[1] - p[1])


def _share(start: Near, end: Near) -> Share:
    """Return start / (start - end), whose denominator has no part that is infinitely small."""
    whole = start[0] - end[0]
    return Fraction(start[0], whole), Fraction(start[1], whole), Fraction(start[2], whole)


def _linked(
    rings: Sequence[Ring], first: Node, of_side: dict[tuple[int, int], list[tuple[Share, Node]]]
) -> dict[Node, Node]:
    """Return which node comes after each one on the rings, whose corners are numbered from ``first`` on."""
    after: dict[Node, Node] = {}
    for r, ring in enumerate(rings):
        nodes = []
        for k in range(len(ring)):
            nodes += [first + k, *(node for _, node in sorted(of_side.get((r, k), [])))]
        after |= dict(zip(nodes, [*nodes[1:], nodes[0]], strict=True))
        first += len(ring)
    return after


_NEXT = Operation("next", "next", {"next_node": "node"}, ("point",))


@method(
    "polygon_clipping",
    "weiler-atherton",
    "Weiler-Atherton",
    source="Weiler and Atherton 1977; Zwicker 2016, Clipping",
    exact_for="polygons and regions with holes, convex or not, that touch in any way: rational arithmetic",
    breaks_where="rings that cross or touch each other or themselves: refused",
    needs=("simple-rings",),
    listing=walk_listing,
    traits=RingClipTraits({"wa-ring": turned, "wa-crossing": find_crossings, "wa-whole": is_in_region}),
    operations={
        "wa-ring": (
            Operation("direction", "direction", ("is_hole",)),
            Operation("turn", "turn", ("is_turned",)),
        ),
        "wa-crossing": (
            Operation("place", "place", {"t": "t", "region_t": "u"}),
            Operation("point", "point", {"point": "place"}),
            Operation("way", "way", {"is_entering": "entering"}),
        ),
        "wa-whole": (Operation("verdict", "verdict", {"is_kept": "inside"}),),
        "wa-start": (Operation("start", "start", ("node",), ("point",)),),
        "wa-corner": (_NEXT,),
        "wa-switch": (_NEXT, Operation("switch", "switch", {"on_region": "on"})),
        "wa-close": (_NEXT, Operation("close", "close", (), ("corner_count",))),
    },
)
def weiler_atherton(rings: Sequence[Floats], region: Sequence[Floats]) -> ClippedPolygon:
    """Cut the rings (K, 2) of a polygon at those of a region, both in pixels; `core.stages.needs` has checked them."""
    (given, given_region), scale = whole_rings([rings, region])
    subject, window = turned(given), turned(given_region)
    subject_rings, window_rings = [ring for ring, *_ in subject], [ring for ring, *_ in window]
    crossings = find_crossings(subject_rings, window_rings)

    # Both polygons as lists of nodes, with the crossings in their places.
    corners = [place for ring in [*subject_rings, *window_rings] for place in ring]
    region_first, first = sum(map(len, subject_rings)), len(corners)
    on_subject: dict[tuple[int, int], list[tuple[Share, Node]]] = {}
    on_region: dict[tuple[int, int], list[tuple[Share, Node]]] = {}
    for number, crossing in enumerate(crossings, first):
        on_subject.setdefault(crossing.edge, []).append((crossing.t, number))
        on_region.setdefault(crossing.region_edge, []).append((crossing.region_t, number))
    after = _linked(subject_rings, 0, on_subject), _linked(window_rings, region_first, on_region)
    entries = [number for number, crossing in enumerate(crossings, first) if crossing.is_entering]
    walks = walk_listing(after, entries, set(range(first, first + len(crossings))))

    places = [(Fraction(x), Fraction(y)) for x, y in corners] + [crossing.place for crossing in crossings]
    pixels = np.array([[float(x / scale), float(y / scale)] for x, y in places]).reshape(-1, 2)
    rows = [*_ring_rows(subject, False), *_ring_rows(window, True)]
    rows += [_crossing_row(crossing, subject_rings, window_rings, scale) for crossing in crossings]
    whole = []
    for of_region, own, crossed in ((False, subject_rings, on_subject), (True, window_rings, on_region)):
        for number, ring in enumerate(own):
            if any((number, k) in crossed for k in range(len(ring))):
                continue
            is_kept = (
                is_moved_inside(ring[0], subject_rings) if of_region else is_in_region(ring[0], window_rings)
            )
            rows.append({"kind": "wa-whole", "of_region": of_region, "ring": number, "is_kept": is_kept})
            whole += [ring] if is_kept else []
    rows += _walk_rows(walks, after, pixels, first)
    found = [_without_repeats([places[node] for node in walk]) for walk in walks]
    found += [[(Fraction(x), Fraction(y)) for x, y in ring] for ring in whole]
    left = [[(float(x / scale), float(y / scale)) for x, y in ring] for ring in found if _has_area(ring)]
    return ClippedPolygon([np.array(ring) for ring in left], rows)


def _without_repeats(ring: Sequence[Place]) -> list[Place]:
    """Return a ring without corners at the place of the one before."""
    return [place for k, place in enumerate(ring) if place != ring[k - 1]]


def _has_area(ring: Sequence[Place]) -> bool:
    """Return whether a ring encloses anything: one that only touching has left does not."""
    pairs = zip(ring, [*ring[1:], *ring[:1]], strict=True)
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in pairs) != 0


def _ring_rows(rings: Sequence[tuple[Ring, bool, bool]], of_region: bool) -> list[Row]:
    return [
        {
            "kind": "wa-ring",
            "of_region": of_region,
            "ring": number,
            "is_hole": is_hole,
            "is_turned": is_turned,
            "corner_count": len(ring),
        }
        for number, (ring, is_hole, is_turned) in enumerate(rings)
    ]


def _crossing_row(crossing: Crossing, rings: Sequence[Ring], region: Sequence[Ring], scale: int) -> Row:
    (r, k), (s, m) = crossing.edge, crossing.region_edge
    (start, end), (region_start, region_end) = sides_of(rings[r])[k], sides_of(region[s])[m]

    def pixels(place: tuple[int, int] | Place) -> tuple[float, float]:
        return float(Fraction(place[0]) / scale), float(Fraction(place[1]) / scale)

    return {
        "kind": "wa-crossing",
        "ring": r,
        "edge": k,
        "region_ring": s,
        "region_edge": m,
        "t": float(crossing.t[0]),
        "region_t": float(crossing.region_t[0]),
        "point": pixels(crossing.place),
        "start": pixels(start),
        "end": pixels(end),
        "region_start": pixels(region_start),
        "region_end": pixels(region_end),
        "is_entering": crossing.is_entering,
    }


def _walk_rows(
    walks: Sequence[Sequence[Node]], after: Sequence[dict[Node, Node]], pixels: Floats, first: Node
) -> list[Row]:
    """Return the steps of all walks; nodes from ``first`` on are crossings."""
    rows: list[Row] = []
    for number, walk in enumerate(walks):
        on = SUBJECT
        common = {"result_ring": number}
        rows.append(
            {
                "kind": "wa-start",
                **common,
                "node": walk[0],
                "crossing": walk[0] - first,
                "point": pixels[walk[0]],
            }
        )
        for node, following in zip(walk, [*walk[1:], walk[0]], strict=True):
            assert after[on][node] == following
            is_last, is_crossing = following == walk[0], following >= first
            kind = "wa-close" if is_last else "wa-switch" if is_crossing else "wa-corner"
            row = {"kind": kind, **common, "node": node, "next_node": following, "on_region": on == REGION}
            row |= {"point": pixels[following], "start": pixels[node], "end": pixels[following]}
            row |= {"crossing": following - first if is_crossing else -1, "corner_count": len(walk)}
            on = 1 - on if is_crossing else on
            rows.append(row)
    return rows
