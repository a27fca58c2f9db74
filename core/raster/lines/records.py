"""What all line methods share: the segments, the way along their longer axis, the record of the pixels.

Every method runs along the *major* axis, the one on which the segment is longer, one pixel per step, and
chooses a pixel on the other, the *minor* axis. ``u`` is the major and ``v`` the minor coordinate; a segment
whose major axis is y is *steep*.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from core.records.arrays import Flags, Floats, Integers, checked, checked_size, read_only
from core.records.cached import cached_property
from core.scene import SIZE_LIMIT

COORDINATE_LIMIT = 2.0**20
"""Farthest end of a segment, in pixels from the window's origin: all integer decisions then fit 64 bits."""
STEP_LIMIT = 2**16
"""Most steps of the methods whose numbers are added up one after the other, each rounded from the one before."""
BLENDING = "blending"
"""What methods need whose pixels have intensities: they are mixed with what is there."""
MINOR_MARGIN = 2.0
"""Pixels beyond the raster that `visible_range` keeps, more than any rounding of a minor coordinate."""


@dataclass(frozen=True, eq=False)
class LineSteps:
    """Every number that took part in choosing the P pixels, in drawing order."""

    index: Integers
    """(P,) int64, number of the pixel along its whole line, from 0; pixels outside the raster are counted. Methods
    with n pixels in a column count n for every column."""
    t: Floats
    """(P,) float64, place of the pixel's centre on the segment: 0 at the first end, 1 at the second. See
    `core.raster.lines.drawing.segment_parameter`."""
    decision: Floats
    """(P,) float64, the value that chose this pixel (D, e + m, minor coordinate ...; each method says which);
    NaN where nothing had to be decided."""
    has_stepped: Flags
    """(P,) bool, whether the minor coordinate changed since the pixel before on this line."""
    is_tie: Flags
    """(P,) bool, whether the decision fell exactly between two pixels."""
    exit_start: Floats
    """(P,) float64, diamond-exit only (else NaN): how far the first end is through the pixel's diamond."""
    exit_end: Floats
    """(P,) float64, the same of the second end. Drawn if ``exit_start`` < 1/2 <= ``exit_end``."""
    along: Floats
    """(P,) float64, rectangle only (else NaN): how far along the segment the centre lies, in pixels."""
    line_distance: Floats
    """(P,) float64, gupta-sproull only (else NaN): distance of the centre from the line, in pixels, 0 or more."""
    share: Floats
    """(P,) float64, part of the pixel's column (steep: row) that the segment spans, from 0 to 1; 1 for methods
    without intensities."""
    intensity: Floats
    """(P,) float64, share of the line's colour that the pixel gets, above 0 to 1."""
    sum_before: Floats
    """(P,) float64, methods that add up from pixel to pixel (else NaN): the sum (D, e, y) before this pixel."""
    sum_corrected: Floats
    """(P,) float64, the sum after what a step of the minor coordinate takes off it; NaN without such a step."""
    sum_advanced: Floats
    """(P,) float64, the sum after what the step to this pixel adds to it."""

    def select(self, index: Integers) -> "LineSteps":
        """Return the numbers of the pixels ``index``, (Q,) int64."""
        return LineSteps(*(read_only(getattr(self, field.name).take(index)) for field in fields(self)))


@dataclass(frozen=True, eq=False)
class LinePixels:
    """Where lines are drawn; unpacks as ``pixels, intensities, owner``."""

    pixels: Integers
    """(P, 2) int64 columns and rows inside the raster, segment by segment in drawing order."""
    intensities: Floats
    """(P,) float64 share of the line's colour, 1 for methods without antialiasing."""
    owner: Integers
    """(P,) int64 segment that the pixel belongs to, ascending."""
    find_steps: Callable[[], LineSteps]
    """Finds ``steps``; a picture never asks for them."""

    @cached_property
    def steps(self) -> LineSteps:
        """The numbers that chose the pixels."""
        return self.find_steps()

    def __iter__(self) -> Iterator[Any]:
        return iter((self.pixels, self.intensities, self.owner))


@dataclass(frozen=True, eq=False)
class Segments:
    """L segments and the raster that they are drawn on, checked."""

    ends: Floats
    """(L, 2, 2) float64 first and second end, window x and y in pixels."""
    width: int
    height: int
    center: float
    """Coordinate of the centre of pixel 0: 0.5 or 0."""

    @property
    def pixel_indices(self) -> Integers:
        """(L, 2, 2) int64 pixels that the ends lie in; a left or bottom border belongs to the pixel."""
        below = np.floor(self.ends)
        if self.center == 0.0:
            below += self.ends - below >= 0.5
        return below.astype(np.int64)

    @property
    def centered_ends(self) -> Floats:
        """(L, 2, 2) float64 ends in coordinates where pixel centres are whole numbers."""
        return self.ends - self.center


@dataclass(frozen=True, eq=False)
class LineRun:
    """What a method returns: P visited pixels, which may still lie outside the raster."""

    owner: Integers
    """(P,) int64 segment."""
    index: Integers
    """(P,) int64 number along the whole line."""
    column: Integers
    row: Integers
    decision: Floats
    has_stepped: Flags
    is_tie: Flags
    exit_start: Floats | None = None
    exit_end: Floats | None = None
    along: Floats | None = None
    line_distance: Floats | None = None
    share: Floats | None = None
    intensity: Floats | None = None
    """(P,) float64 above 0; ``None``: 1 everywhere."""
    sum_before: Floats | None = None
    sum_corrected: Floats | None = None
    sum_advanced: Floats | None = None

    def seen(self, segments: Segments) -> Integers:
        """Return which of the pixels are on the raster, (Q,) int64."""
        is_seen = (self.column >= 0) & (self.column < segments.width)
        is_seen &= (self.row >= 0) & (self.row < segments.height)
        return np.flatnonzero(is_seen)


def check_segments(segments: Any, width: int, height: int, center: float) -> Segments:
    """Check what `draw_lines` was given, or say what was wanted and what came (ValueError).

    ``center`` is where in a pixel its centre lies.
    """
    ends = checked("segments", segments, ("L", 2, 2))
    width, height = checked_size("raster", (width, height), SIZE_LIMIT)
    too_far = (np.abs(ends) > COORDINATE_LIMIT).any(axis=(1, 2))
    if too_far.any():
        segment = int(np.argmax(too_far))
        raise ValueError(
            f"segments must stay within {COORDINATE_LIMIT:.0f} pixels of the window's origin, "
            f"got {ends[segment].tolist()} (segment {segment}): clip it first"
        )
    return Segments(ends, width, height, center)


def major_first(points: Any, is_steep: Flags) -> Any:
    """Swap the axes of steep segments. (L, 2, 2) ends x, y and (L,) bool to (L, 2, 2) ends u, v."""
    return np.where(is_steep[:, None, None], points[..., ::-1], points)


def round_half_up(values: Any) -> Any:
    """Round to the nearest whole number, half up (the lectures' ``Math.round``). Any shape, float64 to int64.

    NumPy's ``round`` takes halves to the even neighbour, and ``floor(x + 0.5)`` rounds 0.5 - 2**-54 up to 1.
    """
    below = np.floor(values)
    return (below + (values - below >= 0.5)).astype(np.int64)


def limited_steps(method: str, first: Integers, last: Integers) -> tuple[Integers, int]:
    """Return where the steps first <= k < last, (L,) int64 each, end, not before they begin, and the largest end.

    Raises ValueError if one of them is beyond `STEP_LIMIT`: ``method`` adds step by step from 0.
    """
    end = np.where(first < last, last, 0)
    longest = int(end.max(initial=0))
    if longest > STEP_LIMIT:
        raise ValueError(
            f"{method} takes at most {STEP_LIMIT} steps, got {longest} up to the end of the raster "
            f"(segment {int(np.argmax(end))}): clip it first"
        )
    return np.maximum(first, last), longest


def enumerate_steps(first: Integers, last: Integers) -> tuple[Integers, Integers]:
    """List the steps first <= k < last, (L,) int64 each: (P,) int64 segment and (P,) int64 k."""
    counts = np.maximum(last - first, 0)
    owner = np.repeat(np.arange(len(counts)), counts)
    before = np.cumsum(counts) - counts
    return owner, np.arange(len(owner)) + (first - before)[owner]


def visible_range(
    segments: Segments,
    is_steep: Flags,
    u: Integers,
    u_step: Integers,
    v: Floats,
    v_step: Floats,
    count: Integers,
    margin: Floats | float = MINOR_MARGIN,
) -> tuple[Integers, Integers]:
    """Find the steps k at which pixel ``u + k u_step``, ``v + k v_step`` is on the raster or just beside it.

    Parameters
    ----------
    is_steep : (L,) bool
    u, u_step : (L,) int64
        First major pixel, and 1 or -1.
    v, v_step : (L,) float64
        First minor coordinate, and its change per step; may be off by less than ``margin``.
    count : (L,) int64
        Steps of the whole line.
    margin : (L,) float64 or float
        Pixels beyond the raster that are kept, 2 by default.

    Returns
    -------
    first, last : (L,) int64
        0 <= first <= last <= count; the pixels that are on the raster have first <= k < last.
    """
    u_size = np.where(is_steep, segments.height, segments.width)
    v_size = np.where(is_steep, segments.width, segments.height)
    first = np.where(u_step > 0, -u, u - u_size + 1)
    last = np.where(u_step > 0, u_size - u, u + 1)

    # Where the minor coordinate enters and leaves; a level line is inside for all steps or for none.
    is_level = v_step == 0
    slope = np.where(is_level, 1.0, v_step)
    low, high = (-margin - v) / slope, (v_size + margin - v) / slope
    low, high = np.minimum(low, high), np.maximum(low, high)
    is_outside = is_level & ((v < -margin) | (v > v_size + margin))
    low = np.where(is_level, 0.0, np.clip(np.floor(low), 0, count))
    high = np.where(is_level, count, np.clip(np.ceil(high) + 1, 0, count))

    first = np.clip(np.maximum(first, low.astype(np.int64)), 0, count)
    last = np.clip(np.minimum(last, high.astype(np.int64)), 0, count)
    last = np.where(is_outside, first, np.maximum(first, last))
    return first, last
