"""What a line method has beside its rule: how its trace is set up, what its rows do, how it is found faster."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np

from core.methods import table
from core.raster.lines.records import BLENDING, Segments, major_first
from core.records.arrays import Floats, Integers
from core.records.operation import Columns, Operation

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
