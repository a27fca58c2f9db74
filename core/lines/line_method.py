"""What all line methods share: segments, the way along the longer axis, and what a method has beside its rule.

Every method runs along the *major* axis, the one on which the segment is longer, one pixel per step, and
chooses a pixel on the other, the *minor* axis. ``u`` is the major and ``v`` the minor coordinate; a segment
whose major axis is y is *steep*.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, fields
from functools import cache
from typing import Any

import numpy as np

from core.methods import table
from core.records.arrays import Flags, Floats, Integers, cached_property, checked, checked_size, read_only
from core.records.listing import Columns, Operation
from core.scene import SIZE_LIMIT

# What all line methods share: the segments, the way along their longer axis, the record of the pixels.


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
    `core.lines.drawing.segment_parameter`."""
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


# What a line method has beside its rule: how its trace is set up, what its rows do, how it is found faster.


OCTANT = Operation("octant", "octant", ("is_steep",), ("first_end", "second_end"))
DIRECTIONS = Operation("directions", "directions", ("sx", "sy"))
DIRECTION = Operation("directions", "directions", ("sx",))
SLOPE = Operation("slope", "slope", {"slope": "m"})
INTERCEPT = Operation("intercept", "intercept", {"intercept": "b"})
START = Operation("start", "start", {"major": "x", "minor": "y"})
FIRST_COLUMN = Operation("start", "start", {"major": "x"})
COLUMN = Operation("column", "column", {"major": "x"})
NEXT = Operation("next", "next", {"major": "x"})
PIXEL = Operation("pixel", "pixel", {"minor": "Y"})
EVALUATE = Operation("evaluate", "evaluate", {"decision": "y"})
ROUND = Operation("round", "round", {"minor": "Y"}, ("is_tie", "has_stepped"))
SHARE = Operation("share", "share", {"share": "g"})
PLOT = Operation("plot", "draw", {"covered": "pixels"}, ("t",))


def first_sum(name: str) -> Operation:
    """Return the operation that gives the sum that decides, called ``name`` by the listing, its first value."""
    return Operation("first-sum", "first-sum", {"sum_advanced": name})


def advance(name: str) -> Operation:
    """Return the operation that takes this sum to the next pixel."""
    return Operation("advance", "advance", {"sum_advanced": name})


def correct(name: str) -> Operation:
    """Return the operation that takes off it what a step of the minor coordinate has done."""
    return Operation("correct", "correct", {"sum_corrected": name})


Coefficients = tuple[Floats, Floats]
"""Slope m and intercept b (L,) of v = m u + b, NaN where a method has none."""
LineFinder = Callable[[Integers, tuple[int, int, int, int], bool], tuple[Integers, Integers, Integers]]
"""From pixels of the ends (L, 4), bounds and ``last_pixel`` to columns, rows and segments (P,)."""


def line_coefficients(ends: Floats) -> Coefficients:
    """Return m and b (L,) of v = m u + b through the ends (L, 2, 2) u, v; m is 0 where they coincide."""
    u, v, u_end, v_end = ends[:, 0, 0], ends[:, 0, 1], ends[:, 1, 0], ends[:, 1, 1]
    du = u_end - u
    slope = (v_end - v) / np.where(du == 0, 1.0, du)
    return slope, v - slope * u


def line_cosine(slope: Floats) -> Floats:
    """Return (L,) float64 by what a distance along the minor axis shrinks to that from the line."""
    return np.asarray(1 / np.sqrt(1 + slope * slope))


def _centered_ends(segments: Segments) -> Floats:
    return segments.centered_ends


def _no_columns(_: Columns) -> dict[str, Floats | Integers]:
    return {}


@dataclass(frozen=True, eq=False)
class LineTraits:
    """How a line method differs from evaluating the line's equation between any two ends."""

    takes_pixels: bool = False
    """Whether it moves the ends to pixels first."""
    ends: Callable[[Segments], Floats] = _centered_ends
    """Ends (L, 2, 2) that the others take, with pixel centres on whole numbers."""
    swaps_axes: bool = True
    """Whether its listing swaps x and y for a line that runs along y."""
    swaps_ends: bool = False
    """Whether its listing swaps the ends of a line that runs backwards along its longer axis."""
    is_diagonal_steep: bool = False
    """Whether a segment that is as long in x as in y runs along y."""
    coefficients: Callable[[Floats], Coefficients] = line_coefficients
    """Slope and intercept that it uses, of ends (L, 2, 2), the major axis first."""
    reach: float = 0.0
    """How far outside the raster a line may lie, in pixels, whose pixels still get something."""
    pixels_in_column: int = 1
    """How many numbers it counts for every column: the most pixels that it looks at in one."""
    columns: Callable[[Columns], dict[str, Floats | Integers]] = _no_columns
    """Further columns (P,) of its trace, from those that all methods have."""
    right: str = ""
    """Of a listing as printed: the method that is right."""
    find_pixels: LineFinder | None = None
    """Finds the same pixels faster, without the numbers that chose them."""


def line_rows(
    line: str,
    first: tuple[Operation, ...],
    later: tuple[Operation, ...],
    stepped: tuple[Operation, ...] = (),
    beside: tuple[Operation, ...] = (),
) -> Mapping[str, tuple[Operation, ...]]:
    """Return the kinds of rows of a line method: ``<line>-start`` for a line's first pixel, ``<line>`` for the others.

    Where they are given, ``<line>-step`` is one to which the minor coordinate has ``stepped``, and ``<line>-beside``
    one ``beside`` another pixel of the same column.
    """
    others = {f"{line}-step": stepped, f"{line}-beside": beside}
    return {f"{line}-start": first, line: later, **{kind: rows for kind, rows in others.items() if rows}}


OFF = "-off"
"""End of the kind of row that sets up a line whose first pixels lie off the raster."""


def line_of_kind(kind: str) -> str:
    """Return the line method of a kind of row."""
    return kind.removesuffix("-start").removesuffix("-step").removesuffix("-beside").removesuffix(OFF)


@cache
def minor_name(line: str) -> str:
    """Return what the listing of a method of the family ``line`` calls the pixel along the shorter axis."""
    done = (one for rows in table.get("line", line).operations.values() for one in rows)
    found = [one.sets["minor"] for one in done if isinstance(one.sets, Mapping) and "minor" in one.sets]
    return found[0] if found else "y"


def line_traits(line: str) -> LineTraits:
    """Return how a method of the family ``line`` differs."""
    traits = table.get("line", line).traits
    return traits if isinstance(traits, LineTraits) else LineTraits()


def has_intensities(line: str) -> bool:
    """Return whether a method of the family ``line`` gives its pixels shares of the line's colour."""
    return BLENDING in table.get("line", line).needs


def line_set_up(segments: Segments, line: str) -> dict[str, np.ndarray]:
    """Return what a line method works out once for each of L segments.

    Returns
    -------
    dict
        ``first_end``, ``second_end`` (L, 2): what the listing is called with; pixels, or positions where centres
        are whole. ``is_steep`` (L,): the longer axis is y. ``run``, ``rise`` (L,): lengths along the longer
        (major) and the other (minor) axis. ``sx``, ``sy`` (L,): the way in which the listing goes along
        them, 1 or -1. ``slope``, ``intercept`` (L,): the minor coordinate is slope times the major
        one plus intercept, NaN where the method has none. ``cosine`` (L,): by what a distance along the minor axis
        shrinks to that from the line. ``length`` (L,): of the segment, in pixels.
    """
    traits = line_traits(line)
    ends = segments.pixel_indices.astype(float) if traits.takes_pixels else traits.ends(segments)
    size = np.abs(ends[:, 1] - ends[:, 0])
    is_steep = size[:, 1] >= size[:, 0] if traits.is_diagonal_steep else size[:, 1] > size[:, 0]
    run, rise = np.where(is_steep[:, None], size[:, ::-1], size).T
    along = major_first(ends, is_steep)
    slope, intercept = traits.coefficients(along)
    steps = np.where(along[:, 1] < along[:, 0], -1, 1)
    if traits.swaps_ends:
        steps *= steps[:, :1]
    return {
        "first_end": ends[:, 0],
        "second_end": ends[:, 1],
        "is_steep": is_steep,
        "run": run,
        "rise": rise,
        "sx": steps[:, 0],
        "sy": steps[:, 1],
        "slope": slope,
        "intercept": intercept,
        "cosine": line_cosine(slope),
        "length": np.hypot(run, rise),
    }
