"""Line clippers against rational arithmetic: ends, decisions, ties, degenerate segments, any convex polygon."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClippedLines, clip_lines
from core.lines.line_clipping import LINE_CLIP_LIMIT
from core.methods import table
from tests.covering import in_turn, in_turns, is_everything

WINDOW = (0.0, 0.0, 16.0, 11.0)
CLIPPERS = ["cohen-sutherland", "liang-barsky", "cyrus-beck", "exact"]
OF_POLYGONS = ["cyrus-beck", "exact"]
ULPS = 4
"""Units in the last place of the largest coordinate by which a new end may be off."""

Point = tuple[Fraction, Fraction]
Border = tuple[Point, Point]
"""A point on an edge and its outward normal."""


def rectangle(left, bottom, right, top) -> list[Border]:
    left, bottom, right, top = (Fraction(value) for value in (left, bottom, right, top))
    zero, one = Fraction(0), Fraction(1)
    return [
        ((left, bottom), (-one, zero)),
        ((right, top), (one, zero)),
        ((left, bottom), (zero, -one)),
        ((right, top), (zero, one)),
    ]


def polygon(corners) -> list[Border]:
    exact = [(Fraction(float(x)), Fraction(float(y))) for x, y in corners]
    return [(a, (b[1] - a[1], a[0] - b[0])) for a, b in zip(exact, exact[1:] + exact[:1], strict=True)]


def exactly(segment, borders: list[Border]) -> list[Point] | None:
    """Return the ends of what is left of a segment in exact arithmetic, derived from half planes one by one."""
    (x0, y0), (x1, y1) = [[Fraction(float(value)) for value in end] for end in segment]
    low, high = Fraction(0), Fraction(1)
    for (px, py), (nx, ny) in borders:
        first, second = ((x - px) * nx + (y - py) * ny for x, y in ((x0, y0), (x1, y1)))
        if first > 0 and second > 0:
            return None
        if first > 0:
            low = max(low, first / (first - second))
        elif second > 0:
            high = min(high, first / (first - second))
    if low > high:
        return None
    return [(x0 + t * (x1 - x0), y0 + t * (y1 - y0)) for t in (low, high)]


def largest(segments, window=WINDOW) -> np.ndarray:
    return np.maximum(np.abs(segments).max(axis=(1, 2)), np.abs(window).max())


def decision_is_clear(segment, margin: Fraction) -> bool:
    """Tell whether windows larger and smaller by ``margin`` decide alike."""
    left, bottom, right, top = (Fraction(value) for value in WINDOW)
    wide = rectangle(left - margin, bottom - margin, right + margin, top + margin)
    narrow = rectangle(left + margin, bottom + margin, right - margin, top - margin)
    return (exactly(segment, wide) is None) == (exactly(segment, narrow) is None)


def passes_a_corner(segment, margin: Fraction) -> bool:
    """Tell whether the segment's line crosses the line of an edge within ``margin`` of a corner."""
    (x0, y0), (x1, y1) = [[Fraction(float(value)) for value in end] for end in segment]
    left, bottom, right, top = (Fraction(value) for value in WINDOW)
    found = []
    if x0 != x1:
        ys = [y0 + (y1 - y0) * (x - x0) / (x1 - x0) for x in (left, right)]
        found += [min(abs(y - bottom), abs(y - top)) for y in ys]
    if y0 != y1:
        xs = [x0 + (x1 - x0) * (y - y0) / (y1 - y0) for y in (bottom, top)]
        found += [min(abs(x - left), abs(x - right)) for x in xs]
    return any(distance <= margin for distance in found)


def check_against_fractions(segments: np.ndarray, clipper: str) -> None:
    clipped = clip_lines(segments, WINDOW, clipper)
    borders = rectangle(*WINDOW)
    for k, (segment, unit) in enumerate(zip(segments, np.spacing(largest(segments)), strict=True)):
        wanted, margin = exactly(segment, borders), ULPS * Fraction(float(unit))
        if clipper == "exact":
            check_exact(clipped, k, wanted)
            continue
        if (wanted is not None) != clipped.is_kept[k]:
            assert not decision_is_clear(segment, margin), segment
            continue
        if wanted is None:
            assert np.isnan(clipped.segments[k]).all()
            continue
        off = max(
            abs(Fraction(float(value)) - exact)
            for end, point in zip(clipped.segments[k], wanted, strict=True)
            for value, exact in zip(end, point, strict=True)
        )
        # Cohen-Sutherland decides on the rounded new end: beside a corner the other edge may cut.
        may_choose = clipper == "cohen-sutherland" and passes_a_corner(segment, margin)
        assert off <= margin or may_choose, (segment, float(off / margin))


def check_exact(clipped: ClippedLines, k: int, wanted: list[Point] | None) -> None:
    assert clipped.is_kept[k] == (wanted is not None)
    if wanted is not None:
        assert clipped.segments[k].tolist() == [[float(x), float(y)] for x, y in wanted]


def random_segments(count: int, scale: float, seed: int) -> np.ndarray:
    """Return segments around the window, a third of them aimed at a corner from both sides."""
    generator = np.random.default_rng(seed)
    segments = generator.uniform(-1.5, 1.5, (count, 2, 2)) * 12 * scale + 6
    aimed = count // 3
    corner = np.array([[0, 0], [16, 0], [0, 11], [16, 11.0]])[generator.integers(0, 4, aimed)]
    way = generator.uniform(-1, 1, (aimed, 2)) * 15 * scale
    segments[:aimed, 0] = corner - way * generator.uniform(0.1, 1, (aimed, 1))
    segments[:aimed, 1] = corner + way * generator.uniform(0.1, 1, (aimed, 1))
    return segments


@in_turns(scale=[1.0, 50.0, 1e9], clipper=CLIPPERS)
def test_many_random_segments(clipper: str, scale: float) -> None:
    check_against_fractions(random_segments(10_000 if is_everything() else 400, scale, 7), clipper)


X = [-3.0, 0.0, 5.5, 16.0, 19.0]
Y = [-2.0, 0.0, 4.25, 11.0, 13.0]
DEGENERATE = np.array([[(a, b), (c, d)] for a in X for b in Y for c in X for d in Y])
"""Ends outside, on every border, in corners and inside: level, upright, zero length, along borders, through corners."""


@pytest.mark.parametrize("clipper", CLIPPERS)
def test_all_degenerate_segments(clipper: str) -> None:
    check_against_fractions(DEGENERATE, clipper)
    # These have short coordinates: no method has a rounding to excuse itself with.
    clipped = clip_lines(DEGENERATE, WINDOW, clipper)
    wanted = [exactly(segment, rectangle(*WINDOW)) is not None for segment in DEGENERATE]
    if clipper in ("exact", "cyrus-beck", "liang-barsky"):
        assert clipped.is_kept.tolist() == wanted


@pytest.mark.parametrize("clipper", CLIPPERS)
def test_points_on_the_border_are_kept_and_points_beside_it_are_not(clipper: str) -> None:
    point = np.array([[[x, y]] * 2 for x in X for y in Y])
    clipped = clip_lines(point, WINDOW, clipper)
    inside = [0 <= x <= 16 and 0 <= y <= 11 for x in X for y in Y]
    assert clipped.is_kept.tolist() == inside
    assert np.array_equal(clipped.segments[inside], point[inside])
    assert (clipped.cut_by == -1).all()


@pytest.mark.parametrize("clipper", CLIPPERS)
def test_a_segment_and_its_reverse_leave_the_same_on_short_coordinates(clipper: str) -> None:
    there, back = clip_lines(DEGENERATE, WINDOW, clipper), clip_lines(DEGENERATE[:, ::-1], WINDOW, clipper)
    if clipper == "exact":
        assert np.array_equal(there.segments, back.segments[:, ::-1], equal_nan=True)
    tolerance = ULPS * np.spacing(19.0)
    both = there.is_kept & back.is_kept
    assert np.abs(there.segments - back.segments[:, ::-1])[both].max() <= 3 * tolerance
    assert both.sum() > 300


def test_the_exact_signs_are_right_where_rounding_is_not() -> None:
    # Through the corner (16, 11) but for 2**-51: float64 cannot tell.
    ends = [[[15.0, 12.0 + k * 2.0**-49], [17.0, 10.0]] for k in (-1, 0, 1)]
    assert clip_lines(ends, WINDOW, "exact").is_kept.tolist() == [True, True, False]
    aimed = random_segments(3000, 1.0, 3)[:1000]
    exact = clip_lines(aimed, WINDOW, "exact").is_kept
    for clipper in ("cohen-sutherland", "liang-barsky", "cyrus-beck"):
        assert (clip_lines(aimed, WINDOW, clipper).is_kept != exact).any(), clipper


@pytest.mark.parametrize("clipper", CLIPPERS)
def test_what_is_inside_stays_bit_for_bit(clipper: str) -> None:
    generator = np.random.default_rng(1)
    segments = generator.random((200, 2, 2)) * [16, 11]
    assert np.array_equal(clip_lines(segments, WINDOW, clipper).segments, segments)


@pytest.mark.parametrize("clipper", ["cohen-sutherland", "liang-barsky", "exact"])
def test_new_ends_lie_on_the_edge_that_cut_them(clipper: str) -> None:
    clipped = clip_lines(random_segments(2000, 3.0, 5), WINDOW, clipper)
    borders = [0.0, 16.0, 0.0, 11.0]
    for edge, border in enumerate(borders):
        cut = clipped.cut_by == edge
        assert cut.any()
        assert (clipped.segments[cut][:, edge // 2] == border).all()


@given(st.lists(st.floats(-1e6, 1e6), min_size=4, max_size=4), st.sampled_from(CLIPPERS))
def test_any_segment(numbers: list[float], clipper: str) -> None:
    check_against_fractions(np.reshape(numbers, (1, 2, 2)), clipper)


# Any convex polygon


def convex_polygon(generator: np.random.Generator, steps: int | None) -> np.ndarray:
    """Return corners on an ellipse, counter-clockwise; on a grid of 1/steps those that stay convex."""
    count = int(generator.integers(3, 9))
    while True:
        angle = np.sort(generator.uniform(0, 2 * np.pi, count))
        corners = np.stack([8 + 7 * np.cos(angle), 6 + 5 * np.sin(angle)], axis=1)
        corners = corners if steps is None else np.rint(corners * steps) / steps
        try:
            clip_lines(np.zeros((1, 2, 2)), corners, "exact")
        except ValueError:
            continue
        return corners


@pytest.mark.parametrize("clipper", OF_POLYGONS)
def test_random_convex_polygons_on_a_grid(clipper: str) -> None:
    # Coordinates of few bits: N . D is exact, t has one rounding.
    generator = np.random.default_rng(11)
    for _ in range(60 if is_everything() else 10):
        corners = convex_polygon(generator, 256)
        segments = np.rint(generator.uniform(-4, 20, (50, 2, 2)) * 256) / 256
        clipped = clip_lines(segments, corners, clipper)
        for k, segment in enumerate(segments):
            wanted = exactly(segment, polygon(corners))
            if clipper == "exact":
                check_exact(clipped, k, wanted)
            elif wanted is not None and clipped.is_kept[k]:
                off = np.abs(clipped.segments[k] - np.array(wanted, float)).max()
                assert off <= ULPS * np.spacing(20.0)
            elif wanted is None:
                assert not clipped.is_kept[k]


def test_cyrus_beck_on_any_polygon_is_as_good_as_the_angle_allows() -> None:
    generator = np.random.default_rng(12)
    checked = 0
    for _ in range(60):
        corners = convex_polygon(generator, None)
        segments = generator.uniform(-4, 20, (50, 2, 2))
        clipped = clip_lines(segments, corners, "cyrus-beck")
        exact = clip_lines(segments, corners, "exact")
        length = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1)
        normals = clipped.window.normals
        for end in (0, 1):
            cut = np.flatnonzero(
                (exact.cut_by[:, end] >= 0) & (exact.cut_by[:, end] == clipped.cut_by[:, end])
            )
            normal = normals[exact.cut_by[cut, end]]
            along = np.abs((normal * (segments[cut, 1] - segments[cut, 0])).sum(axis=1))
            worse = np.linalg.norm(normal, axis=1) * length[cut] / along
            off = np.abs(clipped.segments[cut, end] - exact.segments[cut, end]).max(axis=1)
            assert (off <= ULPS * np.spacing(20.0) * np.maximum(worse, 1)).all()
            checked += len(cut)
    assert checked > 1000


def test_a_rectangle_given_as_a_polygon_is_the_same_window() -> None:
    corners = [(0, 0), (16, 0), (16, 11), (0, 11)]
    segments = random_segments(500, 1.0, 9)
    ours, theirs = clip_lines(segments, corners, "exact"), clip_lines(segments, WINDOW, "exact")
    assert np.array_equal(ours.segments, theirs.segments, equal_nan=True)


# As printed


def test_cyrus_beck_as_printed_keeps_a_parallel_segment_outside() -> None:
    outside = [[[2.0, 12.0], [14.0, 12.0]], [[-1.0, 3.0], [-1.0, 8.0]]]
    assert not clip_lines(outside, WINDOW, "cyrus-beck").is_kept.any()
    printed = clip_lines(outside, WINDOW, "cyrus-beck-lecture")
    assert printed.is_kept.all()
    assert printed.segments.tolist() == outside


def test_cyrus_beck_as_printed_clips_points_as_points_and_the_rest_as_the_right_one() -> None:
    points = np.array([[[x, y]] * 2 for x in X for y in Y])
    segments = np.concatenate([points, random_segments(1000, 1.0, 2)])
    printed = clip_lines(segments, WINDOW, "cyrus-beck-lecture")
    right = clip_lines(segments, WINDOW, "cyrus-beck")
    assert np.array_equal(printed.segments, right.segments, equal_nan=True)


# Records and refusals


def test_none_leaves_everything() -> None:
    segments = random_segments(20, 2.0, 1)
    clipped = clip_lines(segments, WINDOW, "none")
    assert np.array_equal(clipped.segments, segments)
    assert clipped.rows is None
    assert clipped.is_kept.all()


@pytest.mark.parametrize("clipper", table.names("line_clipping")[1:])
def test_a_rule_does_not_depend_on_its_batch(clipper: str) -> None:
    segments = random_segments(200, 2.0, 4)
    together = clip_lines(segments, WINDOW, clipper)
    for k, segment in enumerate(segments):
        alone = clip_lines(segment[None], WINDOW, clipper)
        assert alone.segments.tobytes() == together.segments[k : k + 1].tobytes()


@pytest.mark.parametrize("clipper", table.names("line_clipping"))
def test_no_segments(clipper: str) -> None:
    clipped = clip_lines(np.empty((0, 2, 2)), WINDOW, clipper)
    assert clipped.segments.shape == (0, 2, 2)
    assert clipped.rows is None or len(clipped.rows.segment) == 0


@pytest.mark.parametrize(
    ("value", "clipper"),
    in_turn([np.nan, np.inf, -np.inf, 2 * LINE_CLIP_LIMIT], table.names("line_clipping")),
)
def test_what_is_not_finite_is_refused(clipper: str, value: float) -> None:
    with pytest.raises(ValueError, match=r"segments must be (finite|at most)"):
        clip_lines([[[0, 0], [1, value]]], WINDOW, clipper)


@pytest.mark.parametrize(
    ("window", "message"),
    [
        ((3, 0, 1, 2), r"window must be \(left, bottom, right, top\), got \[3.0, 0.0, 1.0, 2.0\]"),
        ((0, 0, np.nan, 2), "window must be finite"),
        ([(0, 0), (1, 0)], "window must have at least three corners, got 2"),
        (
            [(0, 0), (0, 1), (1, 0)],
            "window must be convex and counter-clockwise, got corner 2 outside the edge",
        ),
        ([(0, 0), (4, 0), (1, 1), (0, 4)], "window must be convex"),
        ([(0, 0), (1, 0), (1, 0), (0, 1)], "no two equal corners"),
        ([(0, 0), (1, 1), (2, 2)], "window must have an area"),
        ([(0, 0, 0)], r"window must be \(M, 2\)"),
    ],
)
def test_windows_that_are_none_are_refused(window, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        clip_lines([[[0, 0], [1, 1]]], window, "cyrus-beck")


@pytest.mark.parametrize("clipper", ["cohen-sutherland", "liang-barsky"])
def test_methods_for_rectangles_refuse_a_polygon(clipper: str) -> None:
    with pytest.raises(ValueError, match=f"{clipper} needs a rectangle .* got a polygon of 3 corners"):
        clip_lines([[[0, 0], [1, 1]]], [(0, 0), (1, 0), (0, 1)], clipper)
