"""A segment made smaller: shorter, in a smaller picture, with fewer digits.

What opens in the stepper and is saved is a triangle in outlines, of which the segment is the first edge.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from core.raster.edges.snapping import window_position
from core.records.arrays import Floats
from core.scene import AnyScene, ClipScene
from core.study.accuracy.workloads import outline_scene
from core.study.stability.minimization.kind import Kind
from core.study.stability.minimization.numbers import DIGITS, digit_count

FINEST = 10
"""Ends are tried at multiples of 1/2, 1/4 ... 1/1024 pixel."""
INSIDE = ((0.25, 0.125), (0.75, 0.125), (0.25, 0.875))
"""Places in the picture for the third corner, in widths and heights: one of them is on no line with a segment."""


@dataclass(frozen=True, eq=False)
class Segment:
    """A segment and the picture that it is drawn in."""

    ends: Floats
    """(2, 2) float64, pixels."""
    size: tuple[int, int]

    def moved(self, end: int | slice, axis: int, value: float | Floats) -> "Segment":
        """Return the same with one coordinate of one end, or of both (then perhaps two values, (2,)), changed."""
        ends = self.ends.copy()
        ends[end, axis] = value
        return replace(self, ends=ends)


def first_edge(scene: ClipScene) -> Floats:
    """Return the first edge (2, 2) of the first triangle in pixels; ValueError where it lies behind the eye."""
    ends = window_position(scene.clip[0, :2], scene.size)
    if not np.isfinite(ends).all():
        raise ValueError("the first edge must lie in front of the eye")
    return ends


def take_apart(scene: AnyScene) -> Segment:
    """Return the first edge of the first triangle of a scene in clip space."""
    if not isinstance(scene, ClipScene):
        raise ValueError("a segment must be given as a triangle in clip space, got a scene of meshes")
    return Segment(first_edge(scene), scene.size)


def put_together(segment: Segment) -> ClipScene:
    """Return a triangle whose first edge is the segment, and whose third corner is in the picture.

    Raises
    ------
    ValueError
        If the ends are no numbers that clip space holds without rounding: what opens has to be what was judged.
    """
    scene = outline_scene(segment.ends, segment.size, _third_corner(segment))
    found = first_edge(scene)
    if not np.array_equal(found, segment.ends):
        raise ValueError(f"the ends must be exact in clip space, got {segment.ends.tolist()}")
    return scene


def _third_corner(segment: Segment) -> Floats:
    """Return the first place (2,) of `INSIDE` that lies beside the segment."""
    (x0, y0), (x1, y1) = ([Fraction(value) for value in end] for end in segment.ends.tolist())
    corners = [np.array(place) * segment.size for place in INSIDE]
    for corner in corners:
        x, y = (Fraction(value) for value in corner.tolist())
        if (x1 - x0) * (y - y0) != (x - x0) * (y1 - y0):
            return corner
    # A point is on a line with all of them.
    return corners[0]


def shorter(segment: Segment) -> Iterator[Segment]:
    """Yield the segment without its first or last half, quarter, eighth ..., in whole pixels, but no point."""
    way = segment.ends[1] - segment.ends[0]
    part = 2.0
    while np.abs(way).max() >= part:
        step = np.rint(way / part)
        for turn in (np.array([step, 0 * step]), np.array([0 * step, -step])):
            ends = segment.ends + turn
            if (ends[0] != ends[1]).any():
                yield replace(segment, ends=ends)
        part *= 2


def with_smaller_picture(segment: Segment) -> Iterator[Segment]:
    """Yield the same with one half of the picture cut off, the segment staying where it is or moving along."""
    for axis, side in enumerate(segment.size):
        if side < 2:
            continue
        kept = side // 2
        size = (kept, segment.size[1]) if axis == 0 else (segment.size[0], kept)
        yield replace(segment, size=size)
        ends = segment.ends.copy()
        ends[:, axis] -= side - kept
        yield Segment(ends, size)


def with_simpler_ends(segment: Segment) -> Iterator[Segment]:
    """Yield the same with one coordinate, or the one that both ends have, written in fewer digits; none is longer."""
    counts = [(-digit_count(value), k) for k, value in enumerate(segment.ends.ravel().tolist())]
    for _, place in sorted(counts):
        end, axis = divmod(place, 2)
        value = float(segment.ends[end, axis])
        is_one = segment.ends[0, axis] == segment.ends[1, axis]
        for simpler in simpler_coordinates(value):
            for moved in (slice(None), end) if is_one else (end,):
                candidate = segment.moved(moved, axis, simpler)
                if 0 < _pixel_count(candidate) <= _pixel_count(segment):
                    yield candidate


def elsewhere(segment: Segment) -> Iterator[Segment]:
    """Yield the same moved along an axis to where the first end is simpler to write, and the second no harder."""
    for axis in (0, 1):
        first, second = segment.ends[:, axis].tolist()
        for simpler in simpler_coordinates(first):
            there = second + (simpler - first)
            if _effort(there) <= _effort(second) and there - simpler == second - first:
                yield segment.moved(slice(None), axis, np.array([simpler, there]))


def _pixel_count(segment: Segment) -> int:
    """Return the length along the longer axis in pixels, rounded up; 0 for a point."""
    return int(np.ceil(np.abs(segment.ends[1] - segment.ends[0]).max()))


def simpler_coordinates(value: float) -> Iterator[float]:
    """Yield places near ``value`` that are simpler to write, the simplest first: also in the middle of a pixel."""
    middle = np.floor(value) + 0.5
    seen = {value}
    candidates = [0.0, 0.5, 1.0]
    for count in range(1, DIGITS):
        candidates += [float(f"{value:.{count}g}"), float(f"{middle - 0.5:.{count}g}") + 0.5]
    candidates += [round(value * 2**power) / 2**power for power in range(FINEST + 1)]
    for candidate in candidates:
        if candidate not in seen and _effort(candidate) < _effort(value):
            seen.add(candidate)
            yield candidate


def _effort(value: float) -> tuple[int, int]:
    """Return how many characters a number takes, and how many of them are not a nought."""
    return digit_count(value), len(f"{abs(value):.17g}".replace("0", ""))


def in_words(segment: Segment) -> str:
    """Return that it is a segment, and in how large a picture."""
    return f"a segment in {segment.size[0]}x{segment.size[1]} pixels"


SEGMENTS = Kind(
    take_apart, put_together, (shorter, with_smaller_picture, elsewhere, with_simpler_ends), in_words
)
"""One segment, the first edge of an outlined triangle."""
