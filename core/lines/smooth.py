"""Lines with intensities: every pixel gets a share of the line's colour, so that steps are no longer seen.

Both methods run along the major axis and evaluate the line's equation in every column (steep: row), as ``midpoint``
does, so that a line may begin anywhere. Xiaolin Wu divides one unit of intensity between the two pixels that the line
passes between: the nearer it is to a pixel, the more that gets. Gupta and Sproull ask how much of a line one pixel wide
a round filter sees that is centred on the pixel and reaches one pixel far: only the distance matters, so it is looked
up in a table.

**Ends** may lie anywhere. The columns that the segment reaches only in part get their share of it: with the first end
on a pixel centre the first column has one half. So lines that continue each other add up to the undivided one, and
``last_pixel`` has nothing to decide. (Gupta and Sproull have more tables for ends; here this share does for both.)

References
----------
X. Wu, *An efficient antialiasing technique*, SIGGRAPH 1991.
S. Gupta, R. F. Sproull, *Filtering edges for gray-scale displays*, SIGGRAPH 1981.
J. D. Foley, A. van Dam, S. K. Feiner, J. F. Hughes, *Computer Graphics*, 1990, 3.17.4 (the cone filter).
"""

from dataclasses import dataclass
from math import ceil, floor, sqrt

import numpy as np

from core.lines.dda import LineColumns, ends_by_column, line_equation
from core.lines.line_method import (
    BLENDING,
    COLUMN,
    DIRECTION,
    EVALUATE,
    INTERCEPT,
    OCTANT,
    PIXEL,
    PLOT,
    SHARE,
    SLOPE,
    LineRun,
    LineTraits,
    Segments,
    enumerate_steps,
    line_coefficients,
    line_cosine,
    line_rows,
    round_half_up,
)
from core.methods import method
from core.records.arrays import Flags, Floats, Integers, read_only
from core.records.listing import Columns, Operation

TABLE_STEPS = 16
"""Entries of the filter table in one pixel of distance, as in the paper."""
FILTER_REACH = 1.5
"""Distance from which on the filter sees nothing of the line: its radius and half the line's width."""

Listed = list[tuple[int, int, float, float]]
"""Column, row, minor coordinate of the line and intensity of each pixel, from a listing."""

_SET_UP = (OCTANT, SLOPE, INTERCEPT, DIRECTION)
_COLUMN = (COLUMN, EVALUATE, SHARE)
_FRACTION = Operation("fraction", "fraction", {"fraction": "f"}, ("is_tie",))
_DIVIDED = (PIXEL, Operation("divide", "intensity", {"intensity": "I"}), PLOT)
_FILTERED = (
    PIXEL,
    Operation("distance", "distance", {"line_distance": "d"}, ("is_tie",)),
    Operation("entry", "entry", ("entry",)),
    Operation("look-up", "look-up", {"filtered": "T"}),
    Operation("filter", "intensity", {"intensity": "I"}),
    PLOT,
)


def cone_intensity(distance: Floats) -> Floats:
    """Volume that a line one pixel wide cuts from a cone of volume 1 on the circle of radius 1 around a pixel's centre.

    Parameters
    ----------
    distance : (N,) float64
        Of the centre from the line, in pixels, 0 or more.

    Returns
    -------
    (N,) float64
        From 0.780 on the line to 0 at 1.5 pixels; exactly 1/2 at half a pixel. Lines side by side add up to 1.

    Notes
    -----
    A plane at x cuts the cone 1 - r, r <= 1, in the area s - x**2 arsech|x| with s = sqrt(1 - x**2). Its
    antiderivative is (2 x s + asin x - x**3 arsech|x|) / 3; the whole volume is pi / 3.
    """

    def volume_up_to(x: Floats) -> Floats:
        x = np.clip(x, -1.0, 1.0)
        s = np.sqrt(1 - x * x)
        size = np.where(x == 0, 1.0, np.abs(x))
        return np.asarray((2 * x * s + np.arcsin(x) - x * x * x * np.log((1 + s) / size)) / 3)

    between = volume_up_to(distance + 0.5) - volume_up_to(distance - 0.5)
    return np.asarray(between / (np.pi / 3))


FILTER_TABLE = read_only(cone_intensity(np.arange(int(FILTER_REACH * TABLE_STEPS) + 1) / TABLE_STEPS))
"""(25,) float64, `cone_intensity` at 0, 1/16 ... 24/16 pixels. Looked up at the nearest entry: off by at most 0.03."""


@dataclass(frozen=True, eq=False)
class _Reach(LineColumns):
    """The columns that L lines reach, from the one that the first end lies in up to that of the second."""

    low: Floats
    """(L,) float64 left (steep: lower) end."""
    high: Floats
    """(L,) float64 the other end."""


@dataclass(frozen=True, eq=False)
class _Passage:
    """A line in P of its columns, ``n`` rows for each."""

    owner: Integers
    k: Integers
    u: Integers
    v: Floats
    """(P,) float64 minor coordinate of the line at the centre of the column."""
    v_before: Floats
    """(P,) float64 the same one column before."""
    share: Floats
    """(P,) float64 part of the column that the segment spans."""
    which: Integers
    """(P,) int64, 0 to n - 1: which pixel of the column."""


def _reach(segments: Segments) -> _Reach:
    ends, is_steep = ends_by_column(segments)
    u, u_end = ends[:, 0, 0], ends[:, 1, 0]
    # An end between two columns reaches into the one that the line is in.
    is_backward = u_end < u
    start = np.where(is_backward, -round_half_up(-u), round_half_up(u))
    stop = np.where(is_backward, round_half_up(u_end), -round_half_up(-u_end))
    step = np.where(is_backward, -1, 1)
    count = np.maximum(step * (stop - start) + 1, 0)
    slope, intercept = line_coefficients(ends)
    return _Reach(is_steep, start, step, count, slope, intercept, np.minimum(u, u_end), np.maximum(u, u_end))


def _pass_columns(reach: _Reach, segments: Segments, n: int) -> _Passage:
    """List the columns that are on the raster or just beside it."""
    first, last = reach.visible(segments, reach.first_minor, reach.minor_step)
    owner, k = enumerate_steps(first, last)
    which = np.tile(np.arange(n), len(owner))
    owner, k = owner.repeat(n), k.repeat(n)
    step, slope, intercept = reach.step[owner], reach.slope[owner], reach.intercept[owner]
    u = reach.start[owner] + step * k
    share = np.minimum(u + 0.5, reach.high[owner]) - np.maximum(u - 0.5, reach.low[owner])
    return _Passage(
        owner,
        k,
        u,
        line_equation(u, slope, intercept),
        line_equation(u - step, slope, intercept),
        np.maximum(share, 0.0),
        which,
    )


def _run(
    reach: _Reach,
    passage: _Passage,
    minor: Integers,
    intensity: Floats,
    has_stepped: Flags,
    is_tie: Flags,
    n: int,
    distance: Floats | None = None,
) -> LineRun:
    """Return the pixels (P,) that get something."""
    drawn = np.flatnonzero(intensity > 0)
    owner, minor = passage.owner[drawn], minor[drawn]
    is_steep, major = reach.is_steep[owner], passage.u[drawn]
    return LineRun(
        owner,
        (n * passage.k + passage.which)[drawn],
        np.where(is_steep, minor, major),
        np.where(is_steep, major, minor),
        passage.v[drawn],
        (has_stepped & (passage.k > 0))[drawn],
        is_tie[drawn],
        line_distance=None if distance is None else distance[drawn],
        share=passage.share[drawn],
        intensity=intensity[drawn],
        sum_before=np.where(passage.k == 0, np.nan, passage.v_before)[drawn],
    )


def _pixel_before(columns: Columns, last: Floats | Integers, order: Integers) -> dict[str, Floats | Integers]:
    """Return the minor coordinate (P,) that was looked at before each pixel.

    ``last`` (P,) is the last one in the column before, ``order`` (n,) the way back from each pixel of a column to the
    one before.
    """
    which = columns["index"] % len(order)
    return {"minor_before": np.where(which == 0, last, columns["minor"] + order[which]).astype(float)}


def _before_divided(columns: Columns) -> dict[str, Floats | Integers]:
    return _pixel_before(columns, np.floor(columns["sum_before"]) + 1, np.array([0, -1]))


def wu_listing(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """List the pixels of ``wu`` on one segment; pixel centres are whole numbers."""
    del last_pixel
    is_steep = abs(y1 - y0) > abs(x1 - x0)  #: octant
    if is_steep:
        x0, y0, x1, y1 = y0, x0, y1, x1
    m = (y1 - y0) / (x1 - x0) if x1 != x0 else 0.0  #: slope
    b = y0 - m * x0  #: intercept
    sx = -1 if x1 < x0 else 1  #: directions
    low, high = min(x0, x1), max(x0, x1)
    first = floor(low) + (low - floor(low) >= 0.5)
    last = ceil(high) - (ceil(high) - high >= 0.5)
    pixels = []
    for x in range(first, last + 1)[::sx]:  #: column
        y = m * x + b  #: evaluate
        g = max(min(x + 0.5, high) - max(x - 0.5, low), 0.0)  #: share
        f = y - floor(y)  #: fraction
        for Y, part in ((floor(y), 1 - f), (floor(y) + 1, f)):  #: pixel
            I = part * g  #: intensity
            if I > 0:
                pixels.append((Y, x, y, I) if is_steep else (x, Y, y, I))  #: draw
    return pixels


@method(
    "line",
    "wu",
    "Xiaolin Wu, two intensities",
    source="X. Wu, An efficient antialiasing technique, 1991; LMU, Computer Graphics 1, Task 1 h)",
    exact_for="the sum of intensities: 1 in a full column, and the spanned part of a column at the ends. "
    "Horizontal, vertical and diagonal lines from pixel centre to pixel centre are crisp",
    breaks_where="brightness: the sum is 1 at every angle, so diagonals, which are longer per column, look paler "
    "and thinner. Horizontal lines look sharp or blurred, depending on their position between pixels",
    needs=(BLENDING,),
    listing=wu_listing,
    operations=line_rows(
        "wu", (*_SET_UP, *_COLUMN, _FRACTION, *_DIVIDED), (*_COLUMN, _FRACTION, *_DIVIDED), beside=_DIVIDED
    ),
    traits=LineTraits(reach=0.5, pixels_in_column=2, columns=_before_divided),
)
def wu(segments: Segments, last_pixel: bool) -> LineRun:
    """Divide the line between the two pixels of a column; ``decision`` is its minor coordinate (centres whole).

    ``last_pixel`` has no influence: see the notes on ends above.
    """
    del last_pixel
    reach = _reach(segments)
    passage = _pass_columns(reach, segments, 2)
    below = np.floor(passage.v)
    fraction = passage.v - below
    part = np.where(passage.which == 0, 1 - fraction, fraction)
    return _run(
        reach,
        passage,
        below.astype(np.int64) + passage.which,
        part * passage.share,
        below != np.floor(passage.v_before),
        fraction == 0.5,
        n=2,
    )


def gupta_sproull_listing(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """List the pixels of ``gupta-sproull`` on one segment; pixel centres are whole numbers."""
    del last_pixel
    is_steep = abs(y1 - y0) > abs(x1 - x0)  #: octant
    if is_steep:
        x0, y0, x1, y1 = y0, x0, y1, x1
    m = (y1 - y0) / (x1 - x0) if x1 != x0 else 0.0  #: slope
    b = y0 - m * x0  #: intercept
    c = 1 / sqrt(1 + m * m)  #: cosine
    sx = -1 if x1 < x0 else 1  #: directions
    low, high = min(x0, x1), max(x0, x1)
    first = floor(low) + (low - floor(low) >= 0.5)
    last = ceil(high) - (ceil(high) - high >= 0.5)
    pixels = []
    for x in range(first, last + 1)[::sx]:  #: column
        y = m * x + b  #: evaluate
        left, right = max(x - 0.5, low), min(x + 0.5, high)
        g = max(right - left, 0.0)  #: share
        near = floor(y) + (y - floor(y) >= 0.5)
        for Y in (near, near + 1, near - 1):  #: pixel
            d = abs(Y - y) * c  #: distance
            entry = floor(d * TABLE_STEPS + 0.5)  #: entry
            T = float(FILTER_TABLE[entry])  #: look-up
            I = T * g  #: intensity
            if I > 0:
                pixels.append((Y, x, y, I) if is_steep else (x, Y, y, I))  #: draw
    return pixels


def filter_entry(distance: Floats) -> Integers:
    """Return (P,) int64, which entry of `FILTER_TABLE` is nearest to a distance (P,) in pixels."""
    return np.floor(distance * TABLE_STEPS + 0.5).astype(np.int64)


def _filter_columns(columns: Columns) -> dict[str, Floats | Integers]:
    entry = filter_entry(columns["line_distance"])
    found: dict[str, Floats | Integers] = {"entry": entry, "filtered": FILTER_TABLE.take(entry)}
    return found | _pixel_before(
        columns, round_half_up(np.nan_to_num(columns["sum_before"])) - 1, np.array([0, -1, 2])
    )


@method(
    "line",
    "gupta-sproull",
    "Gupta-Sproull, cone filter",
    source="S. Gupta and R. F. Sproull, Filtering edges for gray-scale displays, 1981",
    exact_for="the cone filter of a one-pixel-wide line, at distances in whole sixteenths of a pixel. "
    "Brightness is equal at every angle within 3 %",
    breaks_where="other distances: they are rounded to the nearest sixteenth. Sloping lines: a fourth pixel within"
    " reach is left out. Ends are cut along the axis",
    needs=(BLENDING,),
    listing=gupta_sproull_listing,
    operations=line_rows(
        "gupta-sproull",
        (
            OCTANT,
            SLOPE,
            INTERCEPT,
            Operation("cosine", "cosine", {"cosine": "c"}),
            DIRECTION,
            *_COLUMN,
            *_FILTERED,
        ),
        (*_COLUMN, *_FILTERED),
        beside=_FILTERED,
    ),
    traits=LineTraits(reach=1.0, pixels_in_column=3, columns=_filter_columns),
)
def gupta_sproull(segments: Segments, last_pixel: bool) -> LineRun:
    """Look up the distances of the three nearest pixels of a column; ``decision`` is the line's minor coordinate.

    ``last_pixel`` has no influence: see the notes on ends above.
    """
    del last_pixel
    reach = _reach(segments)
    passage = _pass_columns(reach, segments, 3)
    nearest = round_half_up(passage.v)
    # The nearest first, then the one above it and the one below.
    minor = nearest + np.array([0, 1, -1])[passage.which]
    cosine = line_cosine(reach.slope)[passage.owner]
    distance = np.abs(minor - passage.v) * cosine
    return _run(
        reach,
        passage,
        minor,
        FILTER_TABLE.take(filter_entry(distance)) * passage.share,
        nearest != round_half_up(passage.v_before),
        passage.v - np.floor(passage.v) == 0.5,
        n=3,
        distance=distance,
    )
