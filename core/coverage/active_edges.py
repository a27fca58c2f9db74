"""Scan-line fill of polygons: an edge table, an active edge table for each row, and a rule that says what is inside.

An edge is active in the rows whose centres lie on it, its lower end included, its upper end not. In each row the
active edges are sorted by where they cross it, and the rule decides between every two neighbours. A pixel whose centre
lies on an edge belongs to what lies right of it, and above it: as with triangles, neighbours share no pixel.

Corners are snapped to 1/256 pixel and all decisions are made in whole numbers, so the pixels are exactly those of the
polygon with snapped corners.

References
----------
C. Wylie, G. Romney, D. Evans, A. Erdahl, *Half-tone perspective drawings by computer*, 1967.
J. Foley, A. van Dam, S. Feiner, J. Hughes, *Computer Graphics: Principles and Practice*, 2nd ed., 1990, 3.6.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil

import numpy as np

from core.coverage.pixel_runs import Raster, Runs, expand
from core.coverage.snapping import SUBPIXELS
from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import Operation
from core.records.primitives import Rings

Rule = Callable[[Integers, Integers], Flags]
"""Of how many edges lie to the left (N,), and the sum of their directions (N,): whether it is inside there (N,)."""
Place = tuple[Fraction, Fraction]
"""x and y in pixels."""
Listed = list[tuple[int, int, int]]
"""Row, first column, column after the last, of every span of a listing."""


@dataclass(frozen=True, eq=False)
class EdgeTable:
    """E edges of polygons, each from its lower to its upper end."""

    polygon: Integers
    """(E,) int64, not falling."""
    corner: Integers
    """(E,) int64, the corner that the edge starts from, counted over all rings of all polygons."""
    following: Integers
    """(E,) int64, the corner where it ends."""
    lower: Integers
    """(E, 2) int64, x and y of the lower end, in 1/256 pixel."""
    upper: Integers
    """(E, 2) int64, likewise of the upper end."""
    direction: Integers
    """(E,) int64, 1 where the ring runs upwards, -1 downwards."""
    first_row: Integers
    """(E,) int64, first row of the raster whose centres the edge may cross."""
    end_row: Integers
    """(E,) int64, the row after the last; not above ``first_row`` where it crosses none."""
    center: int
    """Where in a pixel its centre lies, in 1/256 pixel."""

    def numerators(self, edge: Integers, row: Integers) -> tuple[Integers, Integers]:
        """Return where rows (N,) cross edges (N,), as x = numerator / denominator (N,) in 1/256 pixel."""
        x, y = self.lower[edge].T
        run, rise = (self.upper[edge] - self.lower[edge]).T
        return x * rise + (SUBPIXELS * row + self.center - y) * run, rise

    def crossing(self, edge: Integers, row: Integers) -> Floats:
        """Return x (N,) float64 pixels, where rows (N,) cross edges (N,)."""
        numerator, rise = self.numerators(edge, row)
        return np.asarray(numerator / rise / SUBPIXELS)

    @property
    def slope(self) -> Floats:
        """(E,) float64, how far to the right an edge goes from row to row; infinite or NaN where it is level."""
        run, rise = (self.upper - self.lower).T
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(run / rise)


@dataclass(frozen=True, eq=False)
class Crossings:
    """N places where a row of pixels crosses an active edge: by polygon, row, and from left to right."""

    edge: Integers
    """(N,) int64."""
    row: Integers
    """(N,) int64."""
    column: Integers
    """(N,) int64, the first column whose centre lies on the edge or right of it."""
    x: Floats
    """(N,) float64, pixels."""
    crossed: Integers
    """(N,) int64, how many edges lie to the left by now, with this one."""
    winding: Integers
    """(N,) int64, the sum of their directions."""
    is_last: Flags
    """(N,) bool, the last crossing of its row."""
    is_inside: Flags
    """(N,) bool, from here to the next crossing it is inside; never after the last one."""

    @property
    def stop(self) -> Integers:
        """(N,) int64, column of the next crossing; the last one's own."""
        return np.where(self.is_last, self.column, np.append(self.column[1:], 0))


def edge_table(rings: Rings, raster: Raster) -> EdgeTable:
    """Return the edges of polygons, their corners snapped to 1/256 pixel (half to even)."""
    corners = np.rint(rings.corners * SUBPIXELS).astype(np.int64)
    start, end = corners, corners[rings.following]
    is_falling = (end[:, 1] < start[:, 1])[:, None]
    lower, upper = np.where(is_falling, end, start), np.where(is_falling, start, end)
    center = int(raster.center * SUBPIXELS)
    _, bottom, _, top = raster.bounds
    first, stop = (-((center - end[:, 1]) // SUBPIXELS) for end in (lower, upper))
    return EdgeTable(
        polygon=rings.polygon_of_corner,
        corner=np.arange(len(corners)),
        following=rings.following,
        lower=lower,
        upper=upper,
        direction=np.where(is_falling[:, 0], -1, 1),
        first_row=np.maximum(first, bottom),
        end_row=np.minimum(stop, top),
        center=center,
    )


def find_crossings(table: EdgeTable, rule: Rule) -> Crossings:
    """Return the crossings (N,) that the active edge table holds in all rows, and what the rule makes of them."""
    edge, place = expand(np.maximum(table.end_row - table.first_row, 0))
    row = table.first_row[edge] + place
    numerator, rise = table.numerators(edge, row)
    column, x = -((table.center * rise - numerator) // (SUBPIXELS * rise)), numerator / rise / SUBPIXELS

    # The column is exact. Where two crossings lie in the same one, their order changes no pixel.
    order = np.lexsort((x, column, row, table.polygon[edge]))
    edge, row, column, x = edge[order], row[order], column[order], x[order]
    polygon = table.polygon[edge]
    is_first = (np.diff(polygon, prepend=-1) != 0) | (np.diff(row, prepend=-1) != 0)
    first = np.maximum.accumulate(np.where(is_first, np.arange(len(edge)), 0))
    summed = np.cumsum(table.direction[edge])
    crossed = np.arange(len(edge)) - first + 1
    winding = summed - summed[first] + table.direction[edge[first]]
    is_last = np.append(is_first[1:], True)[: len(edge)]
    return Crossings(edge, row, column, x, crossed, winding, is_last, rule(crossed, winding) & ~is_last)


def fill_rings(rings: Rings, raster: Raster, rule: Rule) -> Runs:
    """Return the spans (R,) of pixels inside polygons, in drawing order; ``rule`` is a method of ``polygon_fill``."""
    table = edge_table(rings, raster)
    found = find_crossings(table, rule)
    left, _, right, _ = raster.bounds
    start, stop = np.clip(found.column, left, right), np.clip(found.stop, left, right)
    spans = np.flatnonzero(found.is_inside & (stop > start))
    return Runs(
        triangle=table.polygon[found.edge[spans]],
        row=found.row[spans],
        start=start[spans],
        stop=stop[spans],
        accepted=np.ones(len(spans), bool),
        group=np.arange(len(spans)),
    )


def fill_listing(
    sides: Sequence[tuple[Place, Place]], rows: range, center: Fraction, is_inside: Callable[[int, int], bool]
) -> Listed:
    """Listing of the fill of one polygon: both ends of its sides, in pixels; returns the spans."""
    table: dict[int, list[list[Fraction]]] = {}
    for (x0, y0), (x1, y1) in sides:
        way = 1 if y1 > y0 else -1
        if way < 0:
            x0, y0, x1, y1 = x1, y1, x0, y0
        first, end = max(ceil(y0 - center), rows.start), min(ceil(y1 - center), rows.stop)  #: rows
        if first >= end:
            continue  #: level
        shift = (x1 - x0) / (y1 - y0)  #: shift
        x = x0 + (first + center - y0) * shift  #: crossing
        bucket = table.setdefault(first, [])
        bucket.append([x, shift, Fraction(end), Fraction(way)])  #: bucket
    spans: Listed = []
    active: list[list[Fraction]] = []
    for row in rows:
        for e in list(active):
            if row >= e[2]:  #: leave
                active.remove(e)
        for e in active:
            e[0] += e[1]  #: advance
        for e in table.get(row, []):  #: enter
            active.append(e)
        active.sort(key=lambda e: e[0])
        winding = 0
        for k in range(len(active) - 1):
            winding += int(active[k][3])  #: count
            if is_inside(k + 1, winding):  #: decide
                left, right = active[k][0], active[k + 1][0]
                start, stop = ceil(left - center), ceil(right - center)  #: span
                spans.append((row, start, stop))  #: draw
    return spans


_ROWS = {"row_first": "first", "row_end": "end"}
_INTERVAL = (
    Operation("count", "count", ("winding",), ("crossed",)),
    Operation("decide", "decide", (), ("is_inside",)),
)
OPERATIONS = {
    "table-edge": (
        Operation("rows", "rows", _ROWS),
        Operation("shift", "shift", ("shift",)),
        Operation("crossing", "crossing", {"crossing": "x"}),
        Operation("bucket", "bucket", ("bucket",)),
    ),
    "table-level": (Operation("rows", "rows", _ROWS), Operation("skip", "level")),
    "active-leave": (Operation("leave", "leave", (), ("row_end",)),),
    "active-advance": (Operation("advance", "advance", {"crossing": "e"}),),
    "active-enter": (Operation("enter", "enter", {"crossing": "e"}),),
    "active-interval": _INTERVAL,
    "active-inside": (*_INTERVAL, Operation("span", "span", ("start", "stop"))),
    "active-pixel": (Operation("draw", "draw", {"covered": "spans"}),),
}
"""Kind of row to what it does: edges go into the table; in each row they leave, advance, enter; then intervals."""


@method(
    "polygon_fill",
    "even-odd",
    "Active edge table, even-odd rule",
    source="Wylie, Romney, Evans and Erdahl 1967; Foley, van Dam, Feiner and Hughes 1990, 3.6",
    exact_for="every polygon: inside is what an odd number of edges separates from the outside, so rings inside a "
    "ring are holes whichever way they run",
    breaks_where="a polygon that covers a part twice: that part is left out",
    listing=fill_listing,
    operations=OPERATIONS,
)
def even_odd(crossed: Integers, winding: Integers) -> Flags:
    """Return where (N,) bool an odd number of edges lies to the left."""
    return np.asarray(crossed % 2 == 1)


@method(
    "polygon_fill",
    "non-zero",
    "Active edge table, non-zero rule",
    source="Foley, van Dam, Feiner and Hughes 1990, 3.6; PostScript Language Reference 1985, fill",
    exact_for="every polygon: inside is what rings run around more often one way than the other",
    breaks_where="a hole that runs the same way as its outline: it is filled",
    listing=fill_listing,
    operations=OPERATIONS,
)
def non_zero(crossed: Integers, winding: Integers) -> Flags:
    """Return where (N,) bool the directions of the edges to the left do not cancel."""
    return np.asarray(winding != 0)
