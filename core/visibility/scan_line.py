"""Scan-line visible surfaces: in each row the spans of the active triangles, compared where spans begin and end.

A span is a run of pixels of one row that one triangle covers, by the coverage of every other method. Between two
neighbouring ends of spans the same triangles are live. One alone is seen; of several, the nearest is looked for at the
first and at the last centre of the segment, exactly, as ray casting does. The nearness of a plane is linear along a
row: what is nearest at both centres, with ties for the triangle drawn first, is nearest at all between. Otherwise the
segment is halved.

No depth buffer of the picture is needed: row after row, a program holds the spans of one row.

References
----------
C. Wylie, G. Romney, D. Evans, A. Erdahl, *Half-tone perspective drawings by computer*, 1967.
J. Bouknight, *A procedure for generation of three-dimensional half-toned computer graphics presentations*, 1970.
G. Watkins, *A real time visible surface algorithm*, 1970.
I. Sutherland, R. Sproull, R. Schumacker, *A characterization of ten hidden-surface algorithms*, 1974.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from core.coverage.pixel_runs import expand
from core.depth.depth import stack_fragments
from core.methods import method
from core.records.arrays import Flags, Floats, Integers, cached_property
from core.records.primitives import DrawingOrder
from core.visibility.ray_casting import RayPlanes, RayTests, compare_hits, run_ray_tests

ALONE, SAME, PAIR, HALVED = 0, 1, 2, 3
"""What becomes of a segment: one triangle is live, the same is nearest at both ends, two pixels with a nearest
each, or it is halved."""


@dataclass(frozen=True, eq=False)
class Spans:
    """S spans, by row, and in a row by drawing order, then from left to right."""

    row: Integers
    """(S,) int64."""
    left: Integers
    """(S,) int64, the first column."""
    right: Integers
    """(S,) int64, the column after the last."""
    triangle: Integers
    """(S,) int64, number of the triangle in the scene."""
    primitive: Integers
    """(S,) int64, what is drawn of it; -1: the picture before, where a part of a scene is drawn over it."""
    bottom: Integers
    """(S,) int64, where the fragments of each span begin in ``fragment``."""
    fragment: Integers
    """(F + U,) int64, fragments by span, from left to right; -1: a pixel of the picture before."""


@dataclass(frozen=True, eq=False)
class Segments:
    """G segments and halves of segments, by row, from left to right, each before its halves; and their L live spans."""

    row: Integers
    """(G,) int64."""
    left: Integers
    """(G,) int64."""
    right: Integers
    """(G,) int64, the column after the last."""
    depth: Integers
    """(G,) int64, how often it was halved."""
    verdict: Integers
    """(G,) int64: ``ALONE``, ``SAME``, ``PAIR`` or ``HALVED``."""
    nearest: Integers
    """(G, 2) int64, the span that is nearest at the first and at the last centre."""
    live_start: Integers
    """(G + 1,) int64, where the live spans of each begin in ``live``, and L."""
    live: Integers
    """(L,) int64, spans that are live in the segments, in drawing order."""
    tests: tuple[RayTests, RayTests]
    """(L,) each: every live span at the first and at the last centre against the nearest before it in the list."""

    def __len__(self) -> int:
        return len(self.row)

    @property
    def live_count(self) -> Integers:
        """(G,) int64."""
        return np.diff(self.live_start)

    @property
    def compared_ends(self) -> Integers:
        """(G,) int64: at how many centres depths are compared; none of one triangle alone, one of a single pixel."""
        ends = np.minimum(self.right - self.left, 2)
        return np.where(self.live_count > 1, ends, 0)

    @property
    def evaluations(self) -> int:
        """How many depths are computed: every live triangle at every centre that is compared at."""
        return int((self.compared_ends * self.live_count).sum())


@dataclass(frozen=True, eq=False)
class ScanLines:
    """What the method decides of F fragments."""

    spans: Spans
    segments: Segments
    passes: Flags
    """(F,) bool, the nearest at its pixel: one of a pixel, or none where the picture before stays."""
    seen: Integers
    """(F,) int64, number of the triangle that is seen at the fragment's pixel."""
    planes: RayPlanes
    triangle: Integers
    """(F,) int64, of the fragments."""
    m: Floats
    """(F,) float64, of the rays that meet the fragments."""
    n: Floats
    """(F,) float64."""

    @cached_property
    def sign(self) -> Integers:
        """(F,) int64: 1 seen, -1 farther than what is seen, 0 equally near."""
        sign, _ = compare_hits(self.planes, self.triangle, self.seen, self.m, self.n)
        return np.where(self.passes, 1, np.minimum(sign, 0))


def find_scan_lines(
    planes: RayPlanes,
    triangle: Integers,
    primitive: Integers,
    column: Integers,
    row: Integers,
    pixel: Integers,
    initial: Integers,
    center: float,
) -> ScanLines:
    """Decide of F fragments in drawing order which is seen at every pixel.

    Parameters
    ----------
    triangle, primitive : (F,) int64
        Number of the triangle in the scene, and of what is drawn of it.
    column, row : (F,) int64
    pixel : (F,) int64
        Index of the fragment's pixel in ``initial``.
    initial : (U,) int64
        The triangle that is seen at pixels before, -1: none.
    center : float
        Where in a pixel its centre lies: 0 or 1/2.
    """
    spans = find_spans(triangle, primitive, column, row, pixel, initial)
    segments = find_segments(spans, planes, center)

    # The pixels of segments that are decided: each end has half of a pair, the whole of any other.
    done = np.flatnonzero(segments.verdict != HALVED)
    is_pair = segments.verdict[done] == PAIR
    middle = np.where(is_pair, segments.left[done] + 1, segments.right[done])
    left = np.stack([segments.left[done], middle], axis=1)
    right = np.stack([middle, segments.right[done]], axis=1)
    part, place = expand((right - left).ravel())
    span = segments.nearest[done].ravel()[part]
    seen = spans.fragment[spans.bottom[span] + left.ravel()[part] + place - spans.left[span]]
    passes = np.zeros(len(triangle), bool)
    passes[seen[seen >= 0]] = True
    there = initial.copy()
    there[pixel[passes]] = triangle[passes]
    m, n = planes.rays(column, row, center)
    return ScanLines(spans, segments, passes, there.take(pixel), planes, triangle, m, n)


def find_spans(
    triangle: Integers,
    primitive: Integers,
    column: Integers,
    row: Integers,
    pixel: Integers,
    initial: Integers,
) -> Spans:
    """Return the spans of fragments (F,), and before them those of the picture that is there; see `find_scan_lines`."""
    fragment = np.arange(len(triangle))
    is_held = initial.take(pixel) >= 0
    if is_held.any():
        _, first = np.unique(np.where(is_held, pixel, -1), return_index=True)
        held = first[is_held[first]]
        triangle = np.concatenate([initial[pixel[held]], triangle])
        # Runs of one triangle in the picture before: what lies between them is another span of it.
        primitive = np.concatenate([-1 - initial[pixel[held]], primitive])
        column, row = np.concatenate([column[held], column]), np.concatenate([row[held], row])
        fragment = np.concatenate([np.full(len(held), -1), fragment])
    order = np.lexsort((column, primitive, row))
    triangle, primitive, column, row = (values[order] for values in (triangle, primitive, column, row))
    begins = np.ones(len(order), bool)
    begins[1:] = (row[1:] != row[:-1]) | (primitive[1:] != primitive[:-1]) | (column[1:] != column[:-1] + 1)
    bottom = np.flatnonzero(begins)
    count = np.diff(bottom, append=len(order))
    return Spans(
        row[bottom],
        column[bottom],
        column[bottom] + count,
        triangle[bottom],
        np.maximum(primitive[bottom], -1),
        bottom,
        fragment[order],
    )


def find_segments(spans: Spans, planes: RayPlanes, center: float) -> Segments:
    """Return the segments between the ends of spans (S,), halved until one span is nearest at both ends."""
    row, left, right, live_start, live = _between_ends(spans)
    depth = np.zeros(len(row), np.int64)
    found: list[tuple[Integers, ...]] = []
    of_live: list[tuple[Integers, ...]] = []
    while len(row):
        count = np.diff(live_start)
        which = np.repeat(np.arange(len(row)), count)
        nearest, tests = _nearest_at_ends(spans, planes, center, row, left, right, which, live)
        is_same = nearest[:, 0] == nearest[:, 1]
        verdict = np.where(is_same, SAME, np.where(right - left == 2, PAIR, HALVED))
        verdict[count == 1] = ALONE
        found.append((row, left, right, depth, verdict, nearest, count))
        of_live.append((live, *tests))

        # Both halves have the same live spans.
        half = np.flatnonzero(verdict == HALVED)
        middle = (left[half] + right[half]) // 2
        row, depth = np.repeat(row[half], 2), np.repeat(depth[half] + 1, 2)
        left, right = (
            np.stack(ends, axis=1).ravel() for ends in ((left[half], middle), (middle, right[half]))
        )
        part, place = expand(np.repeat(count[half], 2))
        live = live[np.repeat(live_start[:-1][half], 2)[part] + place]
        live_start = np.concatenate([[0], np.cumsum(np.repeat(count[half], 2))])
    return _in_order(found, of_live)


def _between_ends(spans: Spans) -> tuple[Integers, ...]:
    """Return row, left and right of segments (G,) between neighbouring ends where some span is live, and these."""
    width = int(spans.right.max(initial=0)) + 1
    starts, stops = spans.row * width + spans.left, spans.row * width + spans.right
    ends = np.unique(np.concatenate([starts, stops]))
    first = np.searchsorted(ends, starts)
    span, place = expand(np.searchsorted(ends, stops) - first)
    segment = first[span] + place
    order = np.argsort(segment, kind="stable")
    segment, live = segment[order], span[order]
    begins = np.flatnonzero(np.diff(segment, prepend=-1))
    chosen = segment[begins]
    row, left = np.divmod(ends[chosen], width)
    return row, left, ends[chosen + 1] - row * width, np.append(begins, len(live)), live


def _nearest_at_ends(
    spans: Spans,
    planes: RayPlanes,
    center: float,
    row: Integers,
    left: Integers,
    right: Integers,
    which: Integers,
    live: Integers,
) -> tuple[Integers, tuple[Integers, ...]]:
    """Return the nearest (G, 2) of the live spans (L,) of segments, and before, sign and how (L, 2) of each span."""
    triangle = spans.triangle[live]
    nearest = np.empty((len(row), 2), np.int64)
    numbers = np.empty((3, len(live), 2), np.int64)
    stacks = stack_fragments(which)
    nothing = np.full(len(row), -1)
    for end, column in enumerate((left, right - 1)):
        m, n = planes.rays(column[which], row[which], center)
        tests = run_ray_tests(planes, triangle, m, n, stacks.layers(), nothing)
        # Of those that were nearer than all before, the last.
        passing = np.flatnonzero(tests.passes)
        nearest[which[passing], end] = live[passing]
        numbers[:, :, end] = tests.before, tests.sign, tests.how
    return nearest, tuple(numbers)


def _in_order(found: Sequence[tuple[Integers, ...]], of_live: Sequence[tuple[Integers, ...]]) -> Segments:
    """Return all segments row by row from left to right, each before its halves."""
    if not found:
        nothing = np.empty(0, np.int64)
        no_tests = RayTests(nothing, nothing > 0, nothing, nothing)
        none = np.empty((0, 2), np.int64)
        start = np.zeros(1, np.int64)
        return Segments(
            nothing, nothing, nothing, nothing, nothing, none, start, nothing, (no_tests, no_tests)
        )
    row, left, right, depth, verdict, nearest, count = (
        np.concatenate(parts) for parts in zip(*found, strict=True)
    )
    live, before, sign, how = (np.concatenate(parts) for parts in zip(*of_live, strict=True))
    order = np.lexsort((-right, left, row))
    starts = np.cumsum(count) - count
    part, place = expand(count[order])
    pair = starts[order][part] + place
    before, sign, how = before[pair], sign[pair], how[pair]
    tests = [RayTests(before[:, end], sign[:, end] > 0, how[:, end], sign[:, end]) for end in (0, 1)]
    return Segments(
        row[order],
        left[order],
        right[order],
        depth[order],
        verdict[order],
        nearest[order],
        np.concatenate([[0], np.cumsum(count[order])]),
        live[pair],
        (tests[0], tests[1]),
    )


def draw_rows(
    spans: Mapping[int, Mapping[int, tuple[int, int]]],
    rows: range,
    nearest: Callable[[list[int], int, int], int],
) -> list[tuple[int, int, int, int]]:
    """Listing of the method: triangle to its rows' spans; ``nearest`` of some triangles at column and row, exactly."""
    table: dict[int, list[int]] = {}
    for t in spans:
        table.setdefault(min(spans[t]), []).append(t)
    active: list[int] = []
    drawn: list[tuple[int, int, int, int]] = []
    for row in rows:
        for t in table.get(row, []):  #: enter
            active.append(t)
        here = {t: spans[t][row] for t in active if row in spans[t]}  #: span
        ends = sorted({end for span in here.values() for end in span})  #: sort
        parts = list(zip(ends[-2::-1], ends[:0:-1], strict=True))
        while parts:
            left, right = parts.pop()
            live = [t for t in active if t in here and here[t][0] <= left and right <= here[t][1]]  #: live
            if not live:
                continue
            if len(live) == 1:
                drawn.append((row, left, right, live[0]))  #: alone
                continue
            first = nearest(live, left, row)  #: first
            last = first if right - left == 1 else nearest(live, right - 1, row)  #: last
            if first == last:
                drawn.append((row, left, right, first))  #: same
            elif right - left == 2:
                drawn += [(row, left, left + 1, first), (row, left + 1, right, last)]  #: pair
            else:
                middle = (left + right) // 2  #: halve
                parts += [(middle, right), (left, middle)]
        for t in list(active):
            if row == max(spans[t]):  #: leave
                active.remove(t)
    return drawn


@method(
    "visibility",
    "scan-line",
    "Scan line",
    source="Wylie, Romney, Evans and Erdahl 1967; Watkins 1970; Pellacini, hidden surface removal: scan-line",
    exact_for="opaque triangles in any order, crossing ones too: depths are compared exactly where spans begin and end",
    breaks_where="blended triangles: only the nearest surface of a pixel is drawn, so nothing shows through it",
    listing=draw_rows,
    traits="scan-lines",
)
def scan_line(clip: Floats) -> DrawingOrder:
    """Take the triangles as given; of each pixel the nearest alone is kept."""
    return DrawingOrder(np.arange(len(clip)), True, casts_rays=True)
