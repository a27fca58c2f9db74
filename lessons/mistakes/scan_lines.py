"""Mistakes of scan-line visible surfaces: a row worked out by hand, span by span."""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from lessons.mistakes.transforms import Vector
from lessons.mistakes.twin import wrong_rule


class HandSpan(NamedTuple):
    """The span of a surface in one row: a smaller depth is nearer."""

    left: int
    right: int
    """The column after the last one."""
    depth: int
    """At the first column."""
    slope: int
    """Change of the depth per column."""

    def depth_at(self, column: int) -> int:
        """Return the depth at a column."""
        return self.depth + (column - self.left) * self.slope


def segments_of(spans: Sequence[HandSpan]) -> list[tuple[int, int, list[int]]]:
    """Return first column, column after the last, and the live surfaces, between neighbouring ends of spans."""
    ends = sorted({end for span in spans for end in (span.left, span.right)})
    pairs = pairwise(ends)
    found = [
        (left, right, [k for k, span in enumerate(spans) if span.left <= left and right <= span.right])
        for left, right in pairs
    ]
    return [segment for segment in found if segment[2]]


def nearest_of(spans: Sequence[HandSpan], live: Sequence[int], column: int) -> int:
    """Return the surface with the least depth at a column; of equal ones the first."""
    return min(live, key=lambda k: (spans[k].depth_at(column), k))


def pixels_seen(spans: Sequence[HandSpan]) -> Vector:
    """Return how many pixels of the row show each surface."""
    seen = [0] * len(spans)
    for left, right, live in segments_of(spans):
        for column in range(left, right):
            seen[nearest_of(spans, live, column)] += 1
    return tuple(seen)


def row_work(spans: Sequence[HandSpan]) -> Vector:
    """Return how many segments have a live surface, and how many depths their ends need if none is halved."""
    segments = segments_of(spans)
    depths = (len(live) * min(right - left, 2) if len(live) > 1 else 0 for left, right, live in segments)
    return len(segments), sum(depths)


CROSSING = (HandSpan(0, 10, 2, 1), HandSpan(2, 10, 8, -1))
SLOPING = (HandSpan(0, 8, 20, -1), HandSpan(2, 9, 19, -2))
APART = (HandSpan(0, 5, 2, 0), HandSpan(5, 9, 3, 0))
ONE = (HandSpan(0, 5, 2, 0),)


@wrong_rule(pixels_seen, shows=(CROSSING,), hides=(APART,))
def nearest_at_left(spans: Sequence[HandSpan]) -> Vector:
    """Only the first centre of each segment was asked. Where two surfaces cross, the last one shows another."""
    seen = [0] * len(spans)
    for left, right, live in segments_of(spans):
        seen[nearest_of(spans, live, left)] += right - left
    return tuple(seen)


@wrong_rule(pixels_seen, shows=(SLOPING,), hides=(APART,))
def nearest_at_own_start(spans: Sequence[HandSpan]) -> Vector:
    """Each span was judged by the depth at its own start. Depths are compared at the same centre."""
    order = sorted(range(len(spans)), key=lambda k: (spans[k].depth, k))
    seen = [0] * len(spans)
    for left, right, live in segments_of(spans):
        seen[min(live, key=order.index)] += right - left
    return tuple(seen)


@wrong_rule(row_work, shows=(APART,), hides=(ONE,))
def closed_spans(spans: Sequence[HandSpan]) -> Vector:
    """The spans were closed at both ends, so neighbours share a pixel. A span ends before its right end."""
    return row_work([span._replace(right=span.right + 1) for span in spans])


@wrong_rule(row_work, shows=(CROSSING,), hides=((HandSpan(0, 1, 2, 0), HandSpan(0, 1, 3, 0)),))
def depth_at_each_pixel(spans: Sequence[HandSpan]) -> Vector:
    """A depth was computed at every pixel of every span, as a z-buffer does. The ends of segments are enough."""
    return len(segments_of(spans)), sum(span.right - span.left for span in spans)
