"""Lines as words: the pixels of the plain method, painted in order, wherever the ends lie."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from core.lines import many_lines
from core.lines.bresenham import bresenham, bresenham_listing
from core.lines.line_method import COORDINATE_LIMIT, Segments
from core.lines.many_lines import find_line_pixels, paint_lines, set_up_line_words

LIMIT = int(COORDINATE_LIMIT)
NEAR = st.integers(-6, 40)
FAR = st.one_of(NEAR, st.integers(-3000, 3000), st.integers(-LIMIT, LIMIT), st.sampled_from([-LIMIT, LIMIT]))
SIDE = st.one_of(st.integers(1, 33), st.sampled_from([1, 1024, 1920, 16383, 16384]))


def segments_of(coordinate) -> st.SearchStrategy:
    ends = st.tuples(*[coordinate] * 4)
    return st.lists(ends, min_size=1, max_size=12).map(np.array)


def plain(segments, size, last_pixel) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Column, row and line of the pixels that the method chooses."""
    ends = Segments(np.asarray(segments, float).reshape(-1, 2, 2), *size, 0.0)
    run = bresenham(ends, last_pixel)
    seen = run.seen(ends)
    return run.column[seen], run.row[seen], run.owner[seen]


def painted(segments, size, last_pixel) -> np.ndarray:
    """(H, W) number of the last line that covers each pixel, from 1."""
    column, row, owner = plain(segments, size, last_pixel)
    picture = np.zeros(size[::-1], np.uint32)
    for place in zip(row, column, owner, strict=True):
        picture[place[:2]] = place[2] + 1
    return picture


def assert_found(segments, size, last_pixel) -> None:
    found = find_line_pixels(np.asarray(segments), (0, 0, *size), last_pixel)
    for values, wanted in zip(found, plain(segments, size, last_pixel), strict=True):
        assert values.dtype == np.int64
        np.testing.assert_array_equal(values, wanted)


@given(segments=segments_of(NEAR), size=st.tuples(*[st.integers(1, 33)] * 2), last_pixel=st.booleans())
@example(segments=np.array([[0, 0, 0, 0], [0, 0, 1, 1]]), size=(1, 1), last_pixel=True)
def test_a_picture_is_painted_line_over_line(segments, size, last_pixel):
    wanted = painted(segments, size, last_pixel)
    found = np.zeros_like(wanted)
    count = paint_lines(found, segments, np.arange(1, len(segments) + 1), last_pixel=last_pixel)
    np.testing.assert_array_equal(found, wanted)
    assert count == len(plain(segments, size, last_pixel)[0])


@given(segments=segments_of(FAR), size=st.tuples(SIDE, SIDE), last_pixel=st.booleans())
@example(segments=np.array([[-LIMIT, -LIMIT, LIMIT, LIMIT - 1]]), size=(16384, 16384), last_pixel=True)
@example(segments=np.array([[LIMIT, LIMIT - 1, -LIMIT, -LIMIT]]), size=(16384, 16384), last_pixel=False)
@example(segments=np.array([[1 - LIMIT, -LIMIT, LIMIT, LIMIT]]), size=(16384, 16384), last_pixel=True)
@example(segments=np.array([[0, 0, 16383, 16382], [3, 16383, 9000, 0]]), size=(16384, 16384), last_pixel=True)
@example(segments=np.array([[0, 0, 1919, 1079], [1079, 0, 1, 1079]]), size=(1920, 1080), last_pixel=True)
def test_pixels_are_those_of_the_method_up_to_the_limits(segments, size, last_pixel):
    assert_found(segments, size, last_pixel)


@pytest.mark.parametrize(
    "size",
    [
        (1024, 1024),
        *(pytest.param(size, marks=pytest.mark.slow) for size in [(16384, 16384), (16384, 7), (1, 16384)]),
    ],
)
def test_many_long_lines(size):
    # One end in the raster, the other anywhere; pairs of numbers close together make the closest decisions.
    rng = np.random.default_rng(7)
    segments = rng.integers(-LIMIT, LIMIT + 1, (200, 4))
    segments[:, :2] = rng.integers(0, size, (200, 2))
    segments[::3, 3] = segments[::3, 1] + (segments[::3, 2] - segments[::3, 0]) + rng.integers(-3, 4, 67)
    segments = np.clip(segments, -LIMIT, LIMIT)
    for last_pixel in (False, True):
        assert_found(segments, size, last_pixel)
        assert_found(np.roll(segments, 2, axis=1), size, last_pixel)


def test_every_line_of_a_small_raster_is_its_listing():
    side = 9
    segments = np.stack(np.meshgrid(*[np.arange(side)] * 4, indexing="ij"), axis=-1).reshape(-1, 4)
    for last_pixel in (False, True):
        listed = [
            (x, y, line)
            for line, ends in enumerate(segments.tolist())
            for x, y, _ in bresenham_listing(*ends, last_pixel)
        ]
        found = find_line_pixels(segments, (0, 0, side, side), last_pixel)
        np.testing.assert_array_equal(np.transpose(found), listed)


@given(segments=segments_of(NEAR), bounds=st.tuples(*[st.integers(0, 20)] * 2, *[st.integers(1, 15)] * 2))
def test_bounds_cut_and_count_from_their_corner(segments, bounds):
    left, bottom, width, height = bounds
    column, row, owner = plain(segments, (64, 64), last_pixel=True)
    inside = (column >= left) & (column < left + width) & (row >= bottom) & (row < bottom + height)
    found = find_line_pixels(segments, (left, bottom, left + width, bottom + height), last_pixel=True)
    wanted = column[inside] - left, row[inside] - bottom, owner[inside]
    np.testing.assert_array_equal(found, wanted)


def test_both_layouts_of_words_are_used():
    def column_shift(segments, size):
        return set_up_line_words(np.array(segments), (0, 0, *size), size[0], True).layout.column_shift

    diagonals = [[0, 0, 1023, 1022], [1022, 0, 0, 1023]]
    assert column_shift(diagonals, (1024, 1024)) is not None
    assert column_shift(diagonals, (16384, 16384)) is None
    assert column_shift([[-LIMIT, 0, LIMIT, 9], [0, -LIMIT, 9, LIMIT]], (1024, 1024)) is None


@pytest.mark.parametrize("reach", [20, 400_000])
def test_rows_may_be_longer_than_the_picture(reach):
    rng = np.random.default_rng(3)
    segments = np.concatenate([rng.integers(0, 30, (50, 2)), rng.integers(-reach, reach, (50, 2))], axis=1)
    colors = np.arange(1, 51)
    found = np.zeros((30, 300), np.uint32)
    paint_lines(found, segments, colors, width=33, last_pixel=True)
    np.testing.assert_array_equal(found[:, :33], painted(segments, (33, 30), last_pixel=True))
    assert not found[:, 33:].any()


def test_blocks_do_not_matter(monkeypatch):
    rng = np.random.default_rng(5)
    segments, colors = rng.integers(-20, 90, (300, 4)), np.arange(1, 301)
    wanted, found = np.zeros((64, 64), np.uint32), np.zeros((64, 64), np.uint32)
    count = paint_lines(wanted, segments, colors)
    before = find_line_pixels(segments, (0, 0, 64, 64), last_pixel=False)
    monkeypatch.setattr(many_lines, "LINES", 7)
    monkeypatch.setattr(many_lines, "PIXELS", 50)
    assert paint_lines(found, segments, colors) == count
    np.testing.assert_array_equal(found, wanted)
    np.testing.assert_array_equal(find_line_pixels(segments, (0, 0, 64, 64), last_pixel=False), before)


def test_no_lines_and_none_in_sight_paint_nothing():
    pixels = np.zeros((4, 5), np.uint32)
    assert paint_lines(pixels, np.empty((0, 4), int), []) == 0
    assert paint_lines(pixels, [[9, 9, 20, 9], [2, 2, 2, 2]], [1, 2]) == 0
    assert not pixels.any()


@pytest.mark.parametrize(
    ("pixels", "segments", "colors", "message"),
    [
        (np.zeros((4, 4), np.int64), [[0, 0, 1, 1]], [1], r"pixels must be \(H, S\) uint32"),
        (np.zeros((4, 8), np.uint32)[:, ::2], [[0, 0, 1, 1]], [1], "row after row"),
        (np.zeros(16, np.uint32), [[0, 0, 1, 1]], [1], r"got \(16,\) uint32"),
        (np.zeros((4, 4), np.uint32), [[0, 0, 1]], [1], r"segments must be \(N, 4\), got \(1, 3\)"),
        (np.zeros((4, 4), np.uint32), [[0, 0, 1, 0.5]], [1], "segments must be whole numbers"),
        (np.zeros((4, 4), np.uint32), [[0, 0, 1, LIMIT + 1]], [1], "segments must be at most"),
        (np.zeros((4, 4), np.uint32), [[0, 0, 1, 1]], [1, 2], r"colors must be \(1,\), got \(2,\)"),
    ],
)
def test_what_is_refused(pixels, segments, colors, message):
    with pytest.raises(ValueError, match=message):
        paint_lines(pixels, segments, colors)


@pytest.mark.parametrize(
    ("shape", "width", "message"),
    [
        ((4, 4), 5, "at most 4"),
        ((4, 4), 0, "picture must be"),
        ((0, 4), 4, "picture must be"),
        ((1, 16385), None, "picture must be"),
    ],
)
def test_sizes_that_are_refused(shape, width, message):
    with pytest.raises(ValueError, match=message):
        paint_lines(np.zeros(shape, np.uint32), [[0, 0, 1, 1]], [1], width)
