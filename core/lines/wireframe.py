"""Outlines: triangles drawn as their edges.

An outline is made of line segments, drawn by any method of the family ``line`` without their last pixel, as closed
loops are. Edges that clipping made, and the diagonals of its fans, are no part of it. Two triangles that share an edge
both draw it.

Where the line method has intensities, its fragments have them: see `core.lines.wireframe_fragments`.

A segment that leaves the neighbourhood of the window is cut there, in homogeneous coordinates, so that corners may lie
anywhere in front of the eye. Depth is linear along the segment; a pixel whose centre lies beyond an end takes
the end's depth and values.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from core.coverage.fills import Fragments, join_fragments
from core.coverage.number_formats import CornerPositions
from core.coverage.pixel_runs import Raster
from core.lines.drawing import draw_cut_lines, interpolate_line, segment_parameter
from core.lines.line_method import LinePixels, LineSteps, has_intensities
from core.records.arrays import Flags, Floats, Integers
from core.records.primitives import Primitives, interpolation_form

MARGIN = 2.0**15
"""Pixels around the window within which segments keep their ends: every line method takes such long ones."""
RANGE_ROUNDING = 2.0**-40
"""Share of w by which an end that was clipped to the near or far plane may lie outside by rounding."""
BATCH = 1 << 20
"""Pixels of segments that are drawn in one go, about."""
SIDE_STARTS, SIDE_ENDS = np.array([0, 1, 2]), np.array([1, 2, 0])
"""The corners between which the sides of a triangle run, in drawing order."""
ONLY_EDGE = 2
"""The edge of a triangle that is all there is of a segment or point: from corner 0 to 1."""


@dataclass(frozen=True, eq=False)
class Outlines:
    """L line segments, the edges of primitives, in drawing order: from corner 0 to 1, 1 to 2, 2 to 0 of each."""

    primitive: Integers
    """(L,) int64, index of the primitive."""
    edge: Integers
    """(L,) int64, which edge of the scene's triangle it lies on: that opposite corner 0, 1 or 2."""
    window: Floats
    """(L, 2, 2) float64 ends in pixels, not snapped."""
    w: Floats
    """(L, 2) float64 clip w of the ends, positive."""
    depth: Floats
    """(L, 2) float64 window depth of the ends."""
    is_in_range: Flags
    """(L,) bool, both ends lie between the near and the far plane: depth is clamped, not tested."""
    shares: Floats
    """(L, 2, 3) float64, shares of the primitive's corners in the ends, in clip space."""
    window_shares: Floats
    """(L, 2, 3) float64, the same in the window: they differ where the segment was cut."""
    drawn: Floats
    """(L, 2, 2) float64, the part that the line method draws: all of ``window``, or what line clipping left of it."""
    draws_last: Flags
    """(L,) bool, the pixel of the second end is drawn: line clipping cut the line there, or no other begins there."""

    def __len__(self) -> int:
        return len(self.primitive)


@dataclass(frozen=True, eq=False)
class LineFragments(Fragments):
    """F pixels of outlines in drawing order."""

    segment: Integers
    """(F,) int64, index of the segment."""
    intensity: Floats | None = None
    """(F,) float64, share of the line's colour, above 0 to 1; ``None``: 1 for all, by a method without intensities."""

    def take(self, index: Integers) -> "LineFragments":
        """Return the fragments ``index``, (G,) int64."""
        primitive, column, row = (values.take(index) for values in (self.primitive, self.column, self.row))
        intensity = None if self.intensity is None else self.intensity.take(index)
        return LineFragments(primitive, column, row, self.segment.take(index), intensity)


def trace_sides(shares: Floats, fan: Integers) -> tuple[Flags, Integers]:
    """Find the sides of fan pieces that are parts of their triangle's edges.

    Parameters
    ----------
    shares : (P, 3, 3) float64
        Shares of the triangle's three corners in every corner of the pieces, as clipping made them.
    fan : (P,) int64
        What each is cut from as a part of one fan; pieces of one fan stand together.

    Returns
    -------
    is_drawn : (P, 3) bool
        Sides 0-1, 1-2, 2-0. A point of an edge has no share of the corner opposite: clipping keeps
        this 0 exact.
    edge : (P, 3) int64
        The edge that the side lies on, opposite corner 0, 1 or 2.
    """
    lies_on = (shares[:, SIDE_STARTS] == 0) & (shares[:, SIDE_ENDS] == 0)
    is_drawn = lies_on.any(axis=2)
    is_drawn[:, 0] &= np.diff(fan, prepend=-1) != 0
    is_drawn[:, 2] &= np.diff(fan, append=-1) != 0
    return is_drawn, lies_on.argmax(axis=2)


def set_up_outlines(
    primitives: Primitives,
    corners: CornerPositions,
    sides: tuple[Floats, Integers] | None,
    size: tuple[int, int],
    draws_last: Flags | None = None,
) -> Outlines:
    """Return the edges of primitives as segments that can be drawn.

    Parameters
    ----------
    sides : ((P, 3, 3) float64, (P,) int64), optional
        Shares and fans, see `trace_sides`; ``None``: nothing was clipped or cut.
    size : (width, height)
    draws_last : (P,) bool, optional
        The primitives are segments or points, each one line from its first corner to its second, and where this holds
        with its last pixel; ``None``: they are triangles.

    Notes
    -----
    Left out are segments outside the neighbourhood of the window and those that end in the eye (w = 0).
    """
    count = len(primitives)
    shares, fan = (np.broadcast_to(np.eye(3), (count, 3, 3)), np.arange(count)) if sides is None else sides
    if draws_last is None:
        is_drawn, edge = trace_sides(shares, fan)
    else:
        is_drawn, edge = np.broadcast_to(SIDE_STARTS == 0, (count, 3)), np.full((count, 3), ONLY_EDGE)
    primitive, side = np.nonzero(is_drawn)
    first, second = SIDE_STARTS[side], SIDE_ENDS[side]

    def ends(values: Floats) -> Floats:
        return np.stack([values[primitive, first], values[primitive, second]], axis=1)

    # Cut at the neighbourhood's borders: the part from t = cut[0] to t = cut[1] of the edge in clip space.
    homogeneous = ends(corners.homogeneous)
    z = ends(primitives.clip[..., 2])
    w = ends(primitives.clip[..., 3])
    cut = cut_to_window(homogeneous, size)
    with np.errstate(all="ignore"):
        at_cut = (1 - cut[..., None]) * homogeneous[:, :1] + cut[..., None] * homogeneous[:, 1:]
        cut_w = at_cut[..., 2]
        cut_z = (1 - cut) * z[:, :1] + cut * z[:, 1:]
        window = np.clip(at_cut[..., :2] / cut_w[..., None], -MARGIN, np.array(size) + MARGIN)
        depth = (cut_z / cut_w + 1) * 0.5
        window_cut = cut * w[:, 1:] / cut_w
    is_whole: Flags = cut == np.array([0.0, 1.0])
    window = np.where(is_whole[..., None], ends(corners.window), window)
    window_cut = np.where(is_whole, cut, window_cut)
    numbers = np.concatenate([window.reshape(-1, 4), depth, window_cut], axis=1)
    is_visible = (cut[:, 0] < cut[:, 1]) & (cut_w > 0).all(axis=1) & np.isfinite(numbers).all(axis=1)
    one_hot = np.eye(3)

    def of_corners(along: Floats) -> Floats:
        along = along[is_visible, :, None]
        return (1 - along) * one_hot[first[is_visible], None] + along * one_hot[second[is_visible], None]

    reach = cut_w * (1 + RANGE_ROUNDING)
    return Outlines(
        primitive=primitive[is_visible],
        edge=edge[primitive, side][is_visible],
        window=window[is_visible],
        w=cut_w[is_visible],
        depth=depth[is_visible],
        is_in_range=np.all(np.abs(cut_z) <= reach, axis=1)[is_visible],
        shares=of_corners(cut),
        window_shares=of_corners(window_cut),
        drawn=window[is_visible],
        draws_last=(np.zeros(count, bool) if draws_last is None else draws_last)[primitive[is_visible]],
    )


def cut_to_window(homogeneous: Floats, size: tuple[int, int]) -> Floats:
    """Cut segments at `MARGIN` pixels around the window, before anything is divided by w.

    Parameters
    ----------
    homogeneous : (L, 2, 3) float64
        x, y, w of both ends, any signs of w.
    size : (width, height)

    Returns
    -------
    (L, 2) float64
        The part that is kept, from 0 (first end) to 1 (second end) in clip space; nothing is left where it is empty.

    References
    ----------
    Y.-D. Liang, B. Barsky, *A new concept and method for line clipping*, 1984.
    """
    x, y, w = (homogeneous[..., k] for k in range(3))
    limits = np.array(size) + MARGIN
    distances = np.stack([x + MARGIN * w, limits[0] * w - x, y + MARGIN * w, limits[1] * w - y], axis=1)
    start, end = distances[..., 0], distances[..., 1]
    with np.errstate(all="ignore"):
        crossing = start / (start - end)
    enters = np.where((start < 0) & (end >= 0), crossing, 0.0).max(axis=1)
    leaves = np.where((start >= 0) & (end < 0), crossing, 1.0).min(axis=1)
    is_outside = ((start < 0) & (end < 0)).any(axis=1)
    return np.stack([np.where(is_outside, 1.0, enters), np.where(is_outside, 0.0, leaves)], axis=1)


def draw_outlines(
    outlines: Outlines, raster: Raster, line: str
) -> Iterator[tuple[LineFragments, Callable[[], LineSteps]]]:
    """Yield the pixels of segments in batches (at least one), in drawing order, and what finds how they were chosen.

    Parameters
    ----------
    line : str
        A method of the family ``line``.
    """
    length = np.abs(outlines.drawn[:, 1] - outlines.drawn[:, 0]).max(axis=1, initial=0.0)
    length = np.minimum(length, max(raster.width, raster.height)) + 1
    ends = np.flatnonzero(np.diff(np.cumsum(length) // BATCH, append=-1)) + 1
    ends = ends if len(ends) else np.zeros(1, np.int64)
    left, bottom, right, top = raster.bounds
    for first, end in zip([0, *ends][:-1], ends, strict=True):
        part = slice(int(first), int(end))
        drawn = draw_cut_lines(outlines.drawn[part], outlines.draws_last[part], raster, line)
        (column, row), segment = drawn.pixels.T, drawn.owner + first
        intensity = drawn.intensities if has_intensities(line) else None
        fragments = LineFragments(outlines.primitive.take(segment), column, row, segment, intensity)
        inside = np.flatnonzero((column >= left) & (column < right) & (row >= bottom) & (row < top))
        if len(inside) < len(segment):
            fragments = fragments.take(inside)
        yield fragments, partial(_steps_inside, drawn, inside)


def _steps_inside(drawn: LinePixels, inside: Integers) -> LineSteps:
    """Return the numbers that chose the pixels ``inside`` (F,) of lines."""
    return drawn.steps.select(inside)


def join_batches(
    batches: list[tuple[LineFragments, Callable[[], LineSteps]]],
) -> tuple[LineFragments, LineSteps]:
    """Return the batches of ``draw_outlines`` as one, with the numbers that chose the pixels."""
    fragments, finders = zip(*batches, strict=True)
    steps = tuple(find() for find in finders)
    names = vars(steps[0])
    joined = LineSteps(**{name: np.concatenate([getattr(s, name) for s in steps]) for name in names})
    return join_fragments(fragments), joined


def line_parameter(outlines: Outlines, fragments: LineFragments, center: float) -> Floats:
    """Return t (F,): where pixel centres lie on their segments, along the longer axis, from 0 to 1."""
    column, row, segment = fragments.column, fragments.row, fragments.segment
    return np.clip(segment_parameter(column, row, segment, outlines.window, center), 0.0, 1.0)


def line_depth(outlines: Outlines, fragments: LineFragments, center: float) -> Floats:
    """Return the window depth (F,) of fragments, linear along the segment in the window."""
    t = line_parameter(outlines, fragments, center)
    return interpolate_line(fragments.segment, t, outlines.depth[..., None])[:, 0]


def inverse_w_parts(outlines: Outlines, fragments: LineFragments, center: float) -> tuple[Floats, Floats]:
    """Return (1 - t)/w0 and t/w1 (F,), whose sum is 1/w."""
    t = line_parameter(outlines, fragments, center)
    first, second = outlines.w.T
    return (1 - t) / first.take(fragments.segment), t / second.take(fragments.segment)


def values_at_ends(outlines: Outlines, varyings: Floats, interpolation: str) -> Floats:
    """Return varyings (P, 3, K) at both ends of the segments, (L, 2, K): those of the corners, or mixed at a cut."""
    shares = outlines.window_shares if interpolation_form(interpolation) == "affine" else outlines.shares
    corners = varyings[outlines.primitive, None]
    first, second, third = (shares[:, :, k, None] * corners[:, :, k] for k in range(3))
    return np.asarray(first + second + third)


def interpolate_outlines(
    outlines: Outlines, varyings: Floats, fragments: LineFragments, center: float, interpolation: str
) -> tuple[Floats, Floats]:
    """Return weights of the primitive's corners (F, 3) and values (F, K) of varyings (P, 3, K) along segments.

    ``affine`` is linear in the window, any other ``interpolation`` perspective-correct.
    """
    t = line_parameter(outlines, fragments, center)
    is_affine = interpolation_form(interpolation) == "affine"
    shares = outlines.window_shares if is_affine else outlines.shares
    w = None if is_affine else outlines.w
    values = values_at_ends(outlines, varyings, interpolation)
    segment = fragments.segment
    return interpolate_line(segment, t, shares, w), interpolate_line(segment, t, values, w)


def interpolate_along(t: float, w0: float, w1: float, first: Floats, second: Floats) -> tuple[float, Floats]:
    """Listing of perspective-correct interpolation along a segment: 1/w and the value between two ends."""
    start, end = (1 - t) / w0, t / w1  #: parts
    total = start + end  #: total
    s = end / total  #: weight
    value = (1 - s) * first + s * second  #: value
    return total, value


def interpolate_affine_along(t: float, first: Floats, second: Floats) -> Floats:
    """Listing of affine interpolation along a segment: the value between two ends."""
    s = t  #: weight
    value = (1 - s) * first + s * second  #: value
    return value


def take_point_value(corner: Floats) -> Floats:
    """Listing of the values of a point: its pixel takes them."""
    value = corner  #: value
    return value
