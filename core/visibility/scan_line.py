"""Scan-line visible surfaces: in each row the spans of the active triangles, compared where spans begin and end.

A span is a run of pixels of one row that one triangle covers, by the coverage of every other method. Between two
neighbouring ends of spans the same triangles are live. One alone is seen; of several, the nearest is looked for at the
first and at the last centre of the segment, exactly, as ray casting does. The nearness of a plane is linear along a
row: what is nearest at both centres, with ties for the triangle drawn first, is nearest at all between. Otherwise the
segment is halved.

Where fragments are mixed with what is there (``blend`` over or additive), all live triangles are drawn, from back to
front: the active list is sorted by depth at both centres, and a segment with the same order at both is drawn layer by
layer. Of two equally near triangles the one drawn first lies on top.

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
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from core.coverage.pixel_runs import expand
from core.depth.depth import stack_fragments
from core.methods import method
from core.records.arrays import Flags, Floats, Integers, cached_property
from core.records.primitives import DrawingOrder
from core.visibility.exact_case import ExactCase, ExactTests
from core.visibility.ray_casting import RayPlanes, RayTests, compare_hits, decide_hits, run_ray_tests

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
    compared: Integers
    """(L, 2) int64, the same at the first and at the last centre as they are compared there: in drawing order, or
    sorted from back to front where ``is_layered``."""
    tests: tuple[RayTests, RayTests]
    """(L,) each: every span in ``compared`` against the nearest before it, or the one behind it, -1: none."""
    is_layered: bool = False
    """Whether all that is live is drawn, from back to front."""

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

    tracer: ClassVar[str] = "core.visibility.traced_scan_line.trace_scan_lines"
    spans: Spans
    segments: Segments
    drawn: Integers
    """(D,) int64, the fragments that are drawn, segment by segment, in each layer by layer from back to front."""
    passes: Flags
    """(F,) bool, drawn: the nearest at its pixel alone, or every layer before what is there already."""
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

    @property
    def work(self) -> dict[str, int]:
        """``depths computed``, of every live triangle at every centre that is compared at; what is sorted for it."""
        return {
            "depths computed": self.segments.evaluations,
            "span ends sorted": 2 * len(self.spans.row),
            "segments": int((self.segments.depth == 0).sum()),
            "halvings": int((self.segments.verdict == HALVED).sum()),
        }

    @property
    def turn(self) -> Integers | None:
        """``drawn`` where several are drawn of one pixel."""
        return self.drawn if self.segments.is_layered else None

    def told(self) -> tuple[NDArray[Any], dict[str, Integers]]:
        """Return what is said of F fragments of one pixel: against the triangle that is seen, or the layer behind."""
        if self.segments.is_layered:
            behind = np.full(len(self.triangle), -1)
            behind[self.drawn[1:]] = self.triangle[self.drawn[:-1]]
            return np.where(behind >= 0, "scan-layer", "scan-farthest"), {"against": behind}
        return np.array(["scan-tied", "scan-nearest", "scan-farther"])[self.sign], {"against": self.seen}


def find_scan_lines(case: ExactCase) -> ScanLines:
    """Decide of F fragments which is seen at every pixel, and which are drawn.

    Where they are mixed with what is there, all that is live is drawn, from back to front.
    """
    triangle, pixel = case.triangle, case.pixel
    spans = find_spans(case)
    segments = find_segments(spans, case.planes, case.center, case.is_mixed)

    # The pixels of segments that are decided: each end has half of a pair, the whole of any other.
    done = np.flatnonzero(segments.verdict != HALVED)
    is_pair = segments.verdict[done] == PAIR
    middle = np.where(is_pair, segments.left[done] + 1, segments.right[done])
    left = np.stack([segments.left[done], middle], axis=1).ravel()
    right = np.stack([middle, segments.right[done]], axis=1).ravel()
    half, span = _layers_of(spans, segments, done)
    layer, place = expand((right - left)[half])
    half, span = half[layer], span[layer]
    drawn = spans.fragment[spans.bottom[span] + left[half] + place - spans.left[span]]
    drawn = drawn[drawn >= 0]
    passes = np.zeros(len(triangle), bool)
    passes[drawn] = True
    # Of several layers of a pixel, the last one's number stays.
    there = case.initial.copy()
    there[pixel[drawn]] = triangle[drawn]
    return ScanLines(spans, segments, drawn, passes, there.take(pixel), case.planes, triangle, *case.rays)


def _layers_of(spans: Spans, segments: Segments, done: Integers) -> tuple[Integers, Integers]:
    """Return what is drawn in both halves of segments ``done`` (N,): 2 i or 2 i + 1, and the span, from back to front.

    Of layers, none that lies behind the picture before: that is blended already.
    """
    if not segments.is_layered:
        return np.arange(2 * len(done)), segments.nearest[done].ravel()
    count = segments.live_count[done]
    half, place = expand(np.repeat(count, 2))
    slot = segments.live_start[done[half // 2]] + place
    span = segments.compared[slot, half % 2]
    held = np.full(2 * len(done), -1)
    is_held = spans.primitive[span] < 0
    held[half[is_held]] = place[is_held]
    is_drawn = place > held[half]
    return half[is_drawn], span[is_drawn]


def find_spans(case: ExactCase) -> Spans:
    """Return the spans of fragments (F,), and before them those of the picture that is there."""
    triangle, pixel, initial = case.triangle, case.pixel, case.initial
    primitive, column, row = case.fragments.primitive, case.fragments.column, case.fragments.row
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


def find_segments(spans: Spans, planes: RayPlanes, center: float, is_layered: bool = False) -> Segments:
    """Return the segments between the ends of spans (S,), halved until both ends show the same.

    That is the nearest span; where ``is_layered``, the order of all live ones.
    """
    row, left, right, live_start, live = _between_ends(spans)
    depth = np.zeros(len(row), np.int64)
    found: list[tuple[Integers, ...]] = []
    of_live: list[tuple[Any, ...]] = []
    while len(row):
        count = np.diff(live_start)
        which = np.repeat(np.arange(len(row)), count)
        find = _layers_at if is_layered else _nearest_at
        at_ends = [
            find(planes, spans.triangle[live], *planes.rays(column[which], row[which], center), which)
            for column in (left, right - 1)
        ]
        compared = live[np.stack([end.turn for end in at_ends], axis=1)]
        nearest = live[np.stack([end.nearest for end in at_ends], axis=1)]
        is_same = nearest[:, 0] == nearest[:, 1]
        if is_layered:
            is_same = np.logical_and.reduceat(compared[:, 0] == compared[:, 1], live_start[:-1])
        verdict = np.where(is_same, SAME, np.where(right - left == 2, PAIR, HALVED))
        verdict[count == 1] = ALONE
        found.append((row, left, right, depth, verdict, nearest, count))
        of_live.append((live, compared, *at_ends))

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
    return _in_order(found, of_live, is_layered)


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


@dataclass(frozen=True, eq=False)
class _End:
    """What is found at one centre of each of G segments with L live triangles."""

    turn: Integers
    """(L,) int64, which of them are compared, one after another."""
    tests: RayTests
    """(L,) of these."""
    nearest: Integers
    """(G,) int64, which of them is."""


def _nearest_at(planes: RayPlanes, triangle: Integers, m: Floats, n: Floats, which: Integers) -> _End:
    """Compare live triangles (L,) of segments ``which`` (L,) at their rays with the nearest of those before."""
    count = int(which[-1]) + 1
    tests = run_ray_tests(planes, triangle, m, n, stack_fragments(which).layers(), np.full(count, -1))
    # Of those that were nearer than all before, the last.
    passing = np.flatnonzero(tests.passes)
    nearest = np.empty(count, np.int64)
    nearest[which[passing]] = passing
    return _End(np.arange(len(triangle)), tests, nearest)


def _layers_at(planes: RayPlanes, triangle: Integers, m: Floats, n: Floats, which: Integers) -> _End:
    """Sort the same from back to front: by float64, then neighbours in the wrong order are exchanged, exactly."""
    value, _ = planes.values(triangle, m, n)
    turn = np.lexsort((-np.arange(len(triangle)), value, which))
    is_first = np.diff(which, prepend=-1) != 0
    odd = 0
    while True:
        behind = np.where(is_first, -1, triangle[np.roll(turn, 1)])
        sign, how = compare_hits(planes, triangle[turn], behind, m[turn], n[turn])
        later = turn > np.roll(turn, 1)
        wrong = np.flatnonzero(~is_first & ((sign < 0) | ((sign == 0) & later)))
        if not len(wrong):
            break
        chosen = wrong[wrong % 2 == odd]
        turn[chosen], turn[chosen - 1] = turn[chosen - 1], turn[chosen]
        odd = 1 - odd
    is_last = np.diff(which, append=int(which[-1]) + 1) != 0
    return _End(turn, RayTests(behind, sign > 0, how, sign), turn[is_last])


def _in_order(
    found: Sequence[tuple[Integers, ...]], of_live: Sequence[tuple[Any, ...]], is_layered: bool
) -> Segments:
    """Return all segments row by row from left to right, each before its halves."""
    if not found:
        nothing, none = np.empty(0, np.int64), np.empty((0, 2), np.int64)
        tests = RayTests(nothing, nothing > 0, nothing, nothing)
        of_none = nothing, nothing, nothing, nothing, nothing, none, np.zeros(1, np.int64), nothing, none
        return Segments(*of_none, (tests, tests), is_layered)
    row, left, right, depth, verdict, nearest, count = (
        np.concatenate(parts) for parts in zip(*found, strict=True)
    )
    order = np.lexsort((-right, left, row))
    starts = np.cumsum(count) - count
    part, place = expand(count[order])
    pair = starts[order][part] + place
    live, compared, *ends = zip(*of_live, strict=True)
    first, last = (
        RayTests(
            *(
                np.concatenate([getattr(end.tests, name) for end in of_end])[pair]
                for name in ("before", "passes", "how", "sign")
            )
        )
        for of_end in ends
    )
    return Segments(
        row[order],
        left[order],
        right[order],
        depth[order],
        verdict[order],
        nearest[order],
        np.concatenate([[0], np.cumsum(count[order])]),
        np.concatenate(live)[pair],
        np.concatenate(compared)[pair],
        (first, last),
        is_layered,
    )


def draw_rows(
    spans: Mapping[int, Mapping[int, tuple[int, int]]],
    rows: range,
    shown: Callable[[list[int], int, int], list[int]],
) -> list[tuple[int, int, int, int]]:
    """Listing of the method: triangle to its rows' spans; ``shown`` of some triangles at column and row, exactly.

    That is the nearest alone, or all from back to front where they are blended.
    """
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
            first = shown(live, left, row)  #: first
            last = first if right - left == 1 else shown(live, right - 1, row)  #: last
            if first == last:
                drawn += [(row, left, right, t) for t in first]  #: same
            elif right - left == 2:
                halves = (left, left + 1, first), (left + 1, right, last)
                drawn += [(row, begin, end, t) for begin, end, order in halves for t in order]  #: pair
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
    exact_for="opaque and blended triangles in any order, crossing ones too: exact depths where spans begin and end",
    breaks_where="blended triangles and exact areas: pieces of pixels are not sorted",
    listing=draw_rows,
    traits="exact",
)
def scan_line(clip: Floats) -> DrawingOrder:
    """Take the triangles as given; of each pixel the nearest alone is kept, or all from back to front where blended."""
    return DrawingOrder(np.arange(len(clip)), True, decide_by_rows)


def decide_by_rows(case: ExactCase) -> tuple[Flags, ExactTests]:
    """Decide row by row; lines have no spans: each of their pixels is compared for itself."""
    if case.is_outlined:
        return decide_hits(case)
    found = find_scan_lines(case)
    return found.passes, found
