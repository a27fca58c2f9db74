"""Laws of lines: listing and rows agree, clipping is restriction, connected, symmetric where promised."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from core.lines.drawing import draw_lines
from core.lines.line_method import has_intensities
from core.methods import table
from core.records.listing import listing
from tests.covering import in_one

ON_PIXELS = ["bresenham", "bresenham-lecture", "bresenham-float"]
ANY_ENDS = ["midpoint", "dda", "dda-float32", "diamond-exit"]
METHODS = ON_PIXELS + ANY_ENDS
"""Methods with one pixel in a column."""
SEVERAL = ["rectangle", "wu", "gupta-sproull"]
"""Methods with more."""

PIXEL = st.integers(-20, 40)
COORDINATE = st.one_of(
    st.integers(-20, 40).map(float),
    st.integers(-40, 80).map(lambda n: n / 2),
    st.integers(-5120, 10240).map(lambda n: n / 256),
    st.floats(-20, 40, width=32),
    st.floats(-20, 40),
)
PIXEL_SEGMENTS = st.lists(st.tuples(PIXEL, PIXEL, PIXEL, PIXEL), min_size=1, max_size=6)
SEGMENTS = st.lists(st.tuples(*[COORDINATE] * 4), min_size=1, max_size=6)
SLACK = dict.fromkeys(("bresenham-float", "midpoint", "dda"), Fraction(1, 10**9)) | {
    "dda-float32": Fraction(1, 1000)
}
"""Pixels by which methods in floats may miss the nearest pixel: their rounding."""
BIG = 128
"""A raster of this size, moved by SHIFT, holds every segment of the strategies whole."""
SHIFT = 32


def as_segments(ends) -> np.ndarray:
    return np.array(ends, float).reshape(-1, 2, 2)


def whole(segments, **options):
    """Pixels on an unlimited raster."""
    drawn = draw_lines(segments + SHIFT, BIG, BIG, **options)
    return drawn.pixels - SHIFT, drawn


def line_by_line(pixels, owner, count) -> list[np.ndarray]:
    return [pixels[owner == segment] for segment in range(count)]


@given(ends=SEGMENTS, last_pixel=st.booleans())
@example(ends=[(0.0, 0.0, 0.3, 29.7)], last_pixel=True)
@in_one(line=METHODS + SEVERAL)
def test_the_listing_executed_gives_the_rows(line, ends, last_pixel):
    # With centres on whole numbers the listing gets the very numbers of the segment.
    segments = as_segments(ends)
    drawn = draw_lines(segments + SHIFT, BIG, BIG, line=line, last_pixel=last_pixel, pixel_center="integer")
    assert (drawn.owner == np.sort(drawn.owner)).all()
    for segment, (x0, y0, x1, y1) in enumerate((segments + SHIFT).reshape(-1, 4).tolist()):
        if line in ON_PIXELS:
            x0, y0, x1, y1 = (int(np.floor(end)) + (end - np.floor(end) >= 0.5) for end in (x0, y0, x1, y1))
        listed = table.get("line", line).listing(x0, y0, x1, y1, last_pixel)
        mine = drawn.owner == segment
        assert [pixel[:2] for pixel in listed] == list(map(tuple, drawn.pixels[mine].tolist()))
        number = drawn.steps.sum_advanced if line.startswith("bresenham") else drawn.steps.decision
        np.testing.assert_array_equal([pixel[2] for pixel in listed], number[mine])
        if has_intensities(line):
            assert [pixel[3] for pixel in listed] == drawn.intensities[mine].tolist()
        if line in METHODS:
            assert drawn.steps.index[mine].tolist() == list(range(len(listed)))


@pytest.mark.parametrize("line", METHODS + SEVERAL)
def test_every_listing_names_the_line_that_draws(line):
    assert {"octant", "draw"} <= listing(table.get("line", line).listing).lines.keys()


@given(ends=SEGMENTS, last_pixel=st.booleans(), size=st.tuples(st.integers(1, 24), st.integers(1, 24)))
@example(ends=[(0.0, 0.0, 0.0, 2.225073858507e-311)], last_pixel=True, size=(1, 1))
@in_one(line=METHODS + SEVERAL)
def test_clipping_is_restriction(line, ends, last_pixel, size):
    segments = as_segments(ends)
    clipped = draw_lines(segments, *size, line=line, last_pixel=last_pixel)
    # The same coordinates on a raster that reaches as far right and up; what is left or below stays outside.
    complete = draw_lines(segments, BIG, BIG, line=line, last_pixel=last_pixel)
    inside = (complete.pixels < size).all(axis=1)
    np.testing.assert_array_equal(clipped.pixels, complete.pixels[inside])
    np.testing.assert_array_equal(clipped.owner, complete.owner[inside])
    np.testing.assert_array_equal(clipped.intensities, complete.intensities[inside])
    for name, values in vars(clipped.steps).items():
        np.testing.assert_array_equal(values, getattr(complete.steps, name)[inside])


@given(ends=SEGMENTS, last_pixel=st.booleans())
@in_one(line=["bresenham", "bresenham-lecture", "bresenham-float", "diamond-exit", "rectangle"])
def test_what_lies_left_and_below_is_cut_off_too(line, ends, last_pixel):
    # Moved by whole pixels, ends on the grid are decided the same: the whole line can be seen.
    segments = np.rint(as_segments(ends) * 256) / 256
    pixels, complete = whole(segments, line=line, last_pixel=last_pixel)
    clipped = draw_lines(segments, 17, 13, line=line, last_pixel=last_pixel)
    inside = ((pixels >= 0) & (pixels < (17, 13))).all(axis=1)
    np.testing.assert_array_equal(clipped.pixels, pixels[inside])
    np.testing.assert_array_equal(clipped.steps.index, complete.steps.index[inside])
    np.testing.assert_array_equal(clipped.steps.decision, complete.steps.decision[inside])


@given(ends=PIXEL_SEGMENTS)
@in_one(line=METHODS)
def test_one_pixel_per_major_step_connected_and_nearest(line, ends):
    segments = as_segments(ends) + 0.5
    pixels, drawn = whole(segments, line=line, last_pixel=True)
    for segment, (x0, y0, x1, y1) in enumerate(ends):
        mine = pixels[drawn.owner == segment]
        du = max(abs(x1 - x0), abs(y1 - y0))
        assert len(mine) == du + 1
        assert {tuple(mine[0]), tuple(mine[-1])} == {(x0, y0), (x1, y1)}
        if line != "bresenham-lecture":
            assert tuple(mine[0]) == (x0, y0)
        assert (np.abs(np.diff(mine, axis=0)).max(axis=1, initial=0) <= 1).all()
        major = int(abs(y1 - y0) > abs(x1 - x0))
        assert (np.abs(np.diff(mine[:, major])) == 1).all()
        # Never farther than half a pixel from the line, but for the rounding of the float versions.
        if du:
            direction = Fraction((x1 - x0, y1 - y0)[1 - major], (x1 - x0, y1 - y0)[major])
            for pixel in mine.tolist():
                exact = (x0, y0)[1 - major] + (pixel[major] - (x0, y0)[major]) * direction
                slack = SLACK.get(line, 0)
                assert abs(exact - pixel[1 - major]) <= Fraction(1, 2) + slack


def mirror_x(points):
    return points * (-1, 1)


def mirror_y(points):
    return points * (1, -1)


def swap_axes(points):
    return points[..., ::-1]


SYMMETRIES = [mirror_x, mirror_y, swap_axes]


@given(ends=st.lists(st.tuples(*[st.integers(-20, 20)] * 4), min_size=1, max_size=4))
@in_one(line=["bresenham", "bresenham-float"])
@in_one(move=SYMMETRIES)
def test_these_methods_keep_every_symmetry_of_the_square(line, move, ends):
    segments = as_segments(ends)
    pixels, _ = whole(segments, line=line, pixel_center="integer")
    moved, _ = whole(move(segments), line=line, pixel_center="integer")
    np.testing.assert_array_equal(moved, move(pixels))


@pytest.mark.parametrize(
    ("line", "mirror"),
    [
        ("bresenham-lecture", (-1, 1)),
        ("midpoint", (1, -1)),
        ("dda", (1, -1)),
        ("dda-float32", (1, -1)),
        ("diamond-exit", (-1, -1)),
    ],
)
def test_these_methods_are_not_mirror_symmetric(line, mirror):
    segments = as_segments([(0, 0, 4, 2)])
    pixels, _ = whole(segments, line=line, last_pixel=True, pixel_center="integer")
    moved, _ = whole(segments * mirror, line=line, last_pixel=True, pixel_center="integer")
    assert sorted((pixels * mirror).tolist()) != sorted(moved.tolist())


def drawn_sets(segments, line):
    pixels, drawn = whole(segments, line=line, last_pixel=True, pixel_center="integer")
    return [set(map(tuple, mine.tolist())) for mine in line_by_line(pixels, drawn.owner, len(segments))]


@given(ends=PIXEL_SEGMENTS)
@in_one(line=["bresenham-lecture", "diamond-exit"])
def test_these_methods_draw_the_same_backwards(line, ends):
    segments = as_segments(ends)
    assert drawn_sets(segments, line) == drawn_sets(segments[:, ::-1], line)


@pytest.mark.parametrize("line", ["bresenham", "bresenham-float"])
def test_these_methods_do_not_draw_the_same_backwards(line):
    segments = as_segments([(0, 0, 4, 2)])
    assert drawn_sets(segments, line) != drawn_sets(segments[:, ::-1], line)


@given(ends=PIXEL_SEGMENTS)
def test_integer_methods_differ_only_at_ties(ends):
    segments = as_segments(ends)
    steps = {}
    for line in ("bresenham", "bresenham-lecture", "diamond-exit"):
        pixels, drawn = whole(segments, line=line, last_pixel=True, pixel_center="integer")
        steps[line] = [
            set(map(tuple, mine.tolist())) for mine in line_by_line(pixels, drawn.owner, len(ends))
        ]
    for segment, (x0, y0, x1, y1) in enumerate(ends):
        major = int(abs(y1 - y0) > abs(x1 - x0))
        delta = (x1 - x0, y1 - y0)
        differing = (steps["bresenham"][segment] ^ steps["bresenham-lecture"][segment]) | (
            steps["bresenham"][segment] ^ steps["diamond-exit"][segment]
        )
        for pixel in differing:
            along = pixel[major] - (x0, y0)[major]
            exact = (x0, y0)[1 - major] + Fraction(along * delta[1 - major], delta[major])
            assert exact.denominator == 2


@example(start=(1.25, 3.0), end=(7.5, 3.0), last_pixel=False)
@example(start=(7.5, 3.0), end=(1.25, 3.0), last_pixel=True)
@example(start=(3.0, 1.25), end=(3.0, 7.5), last_pixel=False)
@example(start=(3.0, 7.5), end=(3.0, 1.25), last_pixel=True)
@given(start=st.tuples(*[COORDINATE] * 2), end=st.tuples(*[COORDINATE] * 2), last_pixel=st.booleans())
def test_diamond_exit_obeys_its_definition(start, end, last_pixel):
    # Snapped ends, so that both see the same line; the definition is tried on all pixels around.
    segment = np.rint(np.array([start, end]) * 256) / 256
    pixels, _ = whole(segment[None], line="diamond-exit", last_pixel=last_pixel)
    assert sorted(map(tuple, pixels.tolist())) == sorted(exits(segment, last_pixel))


def exits(segment, last_pixel) -> list[tuple[int, int]]:
    """Pixels whose open diamond meets the segment, moved by (-eps, -eps^2), but not its second end.

    The segment is cut by the four half planes of every diamond around it, in exact fractions.
    """
    (x0, y0), (x1, y1) = [[Fraction(c) for c in point] for point in segment.tolist()]
    columns = range(int(min(x0, x1)) - 2, int(max(x0, x1)) + 2)
    rows = range(int(min(y0, y1)) - 2, int(max(y0, y1)) + 2)
    # eps as a number so small that no tie of 1/256-pixel grids over 64 pixels is decided wrongly.
    eps = Fraction(1, 2**80)
    a, b = (x0 - eps, y0 - eps**2), (x1 - eps, y1 - eps**2)
    found = []
    for column in columns:
        for row in rows:
            center = (column + Fraction(1, 2), row + Fraction(1, 2))
            low, high = Fraction(0), Fraction(1)
            for sx in (-1, 1):
                for sy in (-1, 1):
                    # f(t) = sx (x - xc) + sy (y - yc) - 1/2 < 0 from end a (t = 0) to b (t = 1).
                    at_a = sx * (a[0] - center[0]) + sy * (a[1] - center[1]) - Fraction(1, 2)
                    at_b = sx * (b[0] - center[0]) + sy * (b[1] - center[1]) - Fraction(1, 2)
                    if at_a < 0 and at_b < 0:
                        continue
                    if at_a >= 0 and at_b >= 0:
                        low, high = Fraction(2), Fraction(1)
                        continue
                    crossing = at_a / (at_a - at_b)
                    low, high = (max(low, crossing), high) if at_a >= 0 else (low, min(high, crossing))
            ends_inside = abs(b[0] - center[0]) + abs(b[1] - center[1]) < Fraction(1, 2)
            meets = low < high or (a == b and ends_inside)
            if meets and (last_pixel or not ends_inside):
                found.append((column, row))
    return found


@given(start=st.tuples(COORDINATE, COORDINATE), step=st.tuples(*[st.integers(-600, 600)] * 2))
def test_a_line_drawn_in_pieces_draws_each_pixel_once(start, step):
    # The joints lie exactly on the line: diamond-exit needs no rule for the pixel that two pieces share.
    joints = (np.rint(np.array(start) * 256) + np.arange(6)[:, None] * step) / 256 + SHIFT
    pieces = np.stack([joints[:-1], joints[1:]], axis=1)
    together = draw_lines(pieces, BIG, BIG, line="diamond-exit").pixels
    at_once = draw_lines(joints[None, [0, -1]], BIG, BIG, line="diamond-exit").pixels
    np.testing.assert_array_equal(together, at_once)


@given(ends=SEGMENTS)
@in_one(line=METHODS + SEVERAL)
def test_segments_do_not_depend_on_their_company(line, ends):
    segments = as_segments(ends)
    together, drawn = whole(segments, line=line)
    for segment in range(len(segments)):
        alone, _ = whole(segments[segment : segment + 1], line=line)
        np.testing.assert_array_equal(alone, together[drawn.owner == segment])
