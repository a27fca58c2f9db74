"""Lines as drawings: octants, ties, ends, degenerate segments, and what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.lines.drawing import draw_lines, interpolate_line, segment_parameter
from core.lines.line_method import COORDINATE_LIMIT, round_half_up

METHODS = [
    "bresenham",
    "bresenham-lecture",
    "bresenham-float",
    "midpoint",
    "dda",
    "dda-float32",
    "diamond-exit",
]
"""Methods with one pixel in a column; the others are in test_smooth_lines.py and test_rectangle_lines.py."""


def centers(*segments) -> np.ndarray:
    """Segments between pixels, (column, row, column, row) each."""
    return np.array(segments, float).reshape(-1, 2, 2) + 0.5


def picture(segments, width, height, **options) -> list[str]:
    """Rows from top to bottom: the last digit of the segment's number, ``.`` for none, ``!`` for twice."""
    rows = np.full((height, width), ".")
    pixels, _, owner = draw_lines(segments, width, height, **options)
    for (column, row), segment in zip(pixels.tolist(), owner.tolist(), strict=True):
        rows[row, column] = str(segment % 10) if rows[row, column] == "." else "!"
    return ["".join(row) for row in rows[::-1]]


SLOPE_2_OF_5 = {
    "bresenham": ["....0.", "..00..", "00...."],
    "bresenham-lecture": ["....00", "..00..", "00...."],
    "bresenham-float": ["....0.", "..00..", "00...."],
    "midpoint": ["....0.", "..00..", "00...."],
    "dda": ["....0.", "..00..", "00...."],
    "dda-float32": ["....0.", "..00..", "00...."],
    "diamond-exit": ["....0.", "..00..", "00...."],
}


@pytest.mark.parametrize("line", METHODS)
def test_a_line_without_ties(line):
    assert picture(centers([0, 0, 5, 2]), 6, 3, line=line) == SLOPE_2_OF_5[line]


# Slope 1/2, every second column a tie: rising, drawn to the right and to the left; then falling.
RISING, RISING_BACK = centers([0, 0, 4, 2]), centers([4, 2, 0, 0])
FALLING, FALLING_BACK = centers([0, 2, 4, 0]), centers([4, 0, 0, 2])
TIES = [
    # Steps at a tie, whichever way it runs: every mirror image is right, but backwards it is another line.
    (
        "bresenham",
        ["...0.", ".00..", "0...."],
        ["....0", "..00.", ".0..."],
        ["0....", ".00..", "...0."],
        [".0...", "..00.", "....0"],
    ),
    # Runs left to right and stays at a tie: the same backwards.
    (
        "bresenham-lecture",
        ["....0", "..00.", "00..."],
        ["....0", "..00.", "00..."],
        ["00...", "..00.", "....0"],
        ["00...", "..00.", "....0"],
    ),
    # Stays at a tie in its own direction.
    (
        "bresenham-float",
        [".....", "..00.", "00..."],
        ["...00", ".00..", "....."],
        ["00...", "..00.", "....."],
        [".....", ".00..", "...00"],
    ),
    # A tie goes up.
    (
        "midpoint",
        ["...0.", ".00..", "0...."],
        ["...00", ".00..", "....."],
        ["00...", "..00.", "....."],
        [".0...", "..00.", "....0"],
    ),
    (
        "dda",
        ["...0.", ".00..", "0...."],
        ["...00", ".00..", "....."],
        ["00...", "..00.", "....."],
        [".0...", "..00.", "....0"],
    ),
    (
        "dda-float32",
        ["...0.", ".00..", "0...."],
        ["...00", ".00..", "....."],
        ["00...", "..00.", "....."],
        [".0...", "..00.", "....0"],
    ),
    # Up where the line rises and down where it falls, in both directions.
    (
        "diamond-exit",
        ["...0.", ".00..", "0...."],
        ["...00", ".00..", "....."],
        ["0....", ".00..", "...0."],
        [".....", ".00..", "...00"],
    ),
]


@pytest.mark.parametrize(("line", "rising", "rising_back", "falling", "falling_back"), TIES)
def test_what_each_method_does_at_ties(line, rising, rising_back, falling, falling_back):
    assert picture(RISING, 5, 3, line=line) == rising
    assert picture(RISING_BACK, 5, 3, line=line) == rising_back
    assert picture(FALLING, 5, 3, line=line) == falling
    assert picture(FALLING_BACK, 5, 3, line=line) == falling_back
    decided = draw_lines(RISING, 5, 3, line=line).steps
    assert decided.is_tie.tolist().count(True) == 2


def test_bresenham_draws_a_star_in_all_octants():
    ends = [(6, 3), (6, 5), (5, 6), (3, 6), (1, 6), (0, 5), (0, 3), (0, 1), (1, 0), (3, 0), (5, 0), (6, 1)]
    inward = centers(*[[column, row, 3, 3] for column, row in ends])
    assert picture(inward, 7, 7) == [
        ".4.3.2.",
        "5.432.1",
        ".5!3!1.",
        "666.000",
        ".7!9!1.",
        "7.890.1",
        ".8.9.0.",
    ]


@pytest.mark.parametrize("line", METHODS)
def test_level_upright_and_diagonal(line):
    segments = centers([0, 0, 4, 0], [4, 1, 4, 4], [0, 1, 3, 4])
    assert picture(segments, 5, 5, line=line, last_pixel=True) == [
        "...21",
        "..2.1",
        ".2..1",
        "2...1",
        "00000",
    ]


@pytest.mark.parametrize("line", METHODS)
def test_last_pixel_adds_the_pixel_of_the_second_end(line):
    segments = centers([1, 1, 5, 3])
    without = draw_lines(segments, 8, 8, line=line).pixels.tolist()
    complete = draw_lines(segments, 8, 8, line=line, last_pixel=True).pixels.tolist()
    if line == "bresenham-lecture":
        assert complete == without
        assert complete[-1] == [5, 3]
    else:
        assert complete == [*without, [5, 3]]


@pytest.mark.parametrize("line", METHODS)
def test_a_segment_without_length(line):
    point = centers([2, 1, 2, 1])
    drawn = draw_lines(point, 4, 3, line=line)
    expected = [[2, 1]] if line == "bresenham-lecture" else []
    assert drawn.pixels.tolist() == expected
    drawn = draw_lines(point, 4, 3, line=line, last_pixel=True)
    assert drawn.pixels.tolist() == [[2, 1]]
    assert drawn.steps.t.tolist() == [0.0]


@pytest.mark.parametrize("line", METHODS)
def test_one_step(line):
    if line != "bresenham-lecture":
        assert picture(centers([1, 1, 2, 1]), 4, 3, line=line) == ["....", ".0..", "...."]
        assert picture(centers([1, 1, 1, 0]), 4, 3, line=line) == ["....", ".0..", "...."]
    assert picture(centers([1, 1, 2, 1]), 4, 3, line=line, last_pixel=True) == ["....", ".00.", "...."]


@pytest.mark.parametrize("line", METHODS)
def test_no_segments(line):
    pixels, intensities, owner = draw_lines(np.zeros((0, 2, 2)), 4, 3, line=line)
    assert pixels.shape == (0, 2)
    assert intensities.shape == owner.shape == (0,)


def test_diamonds_decide_at_ends_between_centers():
    # Starts inside the diamond of pixel 0, ends in front of that of pixel 3.
    assert picture([[[0.7, 0.5], [3.1, 0.6]]], 5, 1, line="diamond-exit") == ["000.."]
    # Ends past the centre of pixel 3, but in its diamond; then through it.
    assert picture([[[0.7, 0.5], [3.8, 0.6]]], 5, 1, line="diamond-exit") == ["000.."]
    assert picture([[[0.7, 0.5], [3.95, 0.6]]], 5, 1, line="diamond-exit") == ["0000."]
    # Starts behind the centre of pixel 0, beyond its diamond.
    assert picture([[[0.95, 0.6], [3.1, 0.6]]], 5, 1, line="diamond-exit") == [".00.."]
    # Within one diamond, and through the corner between four.
    assert picture([[[2.3, 0.5], [2.7, 0.5]]], 5, 1, line="diamond-exit") == ["....."]
    assert picture([[[1.9, 0.9], [2.1, 1.1]]], 5, 2, line="diamond-exit") == [".....", "....."]


def test_the_numbers_behind_diamond_exit():
    steps = draw_lines([[[0.75, 0.5], [2.5, 1.0]]], 4, 2, line="diamond-exit").steps
    np.testing.assert_allclose(steps.exit_start, [0.25, -0.75], atol=1e-15)
    np.testing.assert_allclose(steps.exit_end, [2.5, 1.5], atol=1e-15)
    assert ((steps.exit_start < 0.5) & (steps.exit_end >= 0.5)).all()
    np.testing.assert_allclose(steps.decision, [-0.25 * 2 / 7, 0.75 * 2 / 7], atol=1e-15)


def test_the_numbers_behind_bresenham():
    steps = draw_lines(centers([0, 0, 5, 2]), 6, 3).steps
    np.testing.assert_array_equal(steps.decision, [np.nan, -1, 3, -3, 1])
    assert steps.has_stepped.tolist() == [False, False, True, False, True]
    assert steps.index.tolist() == [0, 1, 2, 3, 4]
    np.testing.assert_allclose(steps.t, [0, 0.2, 0.4, 0.6, 0.8], atol=1e-15)
    steps = draw_lines(centers([0, 0, 5, 2]), 6, 3, line="bresenham-float").steps
    np.testing.assert_allclose(steps.decision, [np.nan, 0.4, 0.8, 0.2, 0.6], atol=1e-15)


def test_the_dda_drifts_from_the_line_and_midpoint_does_not():
    # 2/5 is no binary fraction: row 0.5 is reached after 12.5 fives, and the sums miss it.
    segments = centers([0, 0, 2000, 200])
    exact = np.arange(2000) / 10
    drifted = draw_lines(segments, 2001, 201, line="dda").steps.decision
    direct = draw_lines(segments, 2001, 201, line="midpoint").steps.decision
    assert np.abs(direct - exact).max() < 1e-13
    assert 1e-12 < np.abs(drifted - exact).max() < 1e-9


def test_the_dda_in_float32_leaves_the_line_by_whole_pixels():
    # Rows near 10,000 have a spacing of 2**-10: every sum is rounded to it, always the same way.
    segments = centers([0, 10_000, 4000, 10_400])
    drawn = draw_lines(segments, 4001, 10_500, line="dda-float32")
    exact = 10_000 + np.arange(4000) / 10
    away = np.abs(drawn.steps.decision - exact)
    assert away[-1] > 1
    assert (np.abs(drawn.pixels[:, 1] - exact) > 1).sum() > 1000
    # It gets worse from column to column, and near the origin, where no tie tells, it is the same line.
    assert away[400] < away[2000] < away[3999]
    near = draw_lines(centers([0, 0, 41, 4]), 41, 5, line="dda-float32").pixels
    np.testing.assert_array_equal(near, draw_lines(centers([0, 0, 41, 4]), 41, 5, line="midpoint").pixels)


@given(st.tuples(st.integers(-3000, 3000), st.integers(-9000, 9000), st.integers(-300, 300)))
def test_the_pixels_of_a_drifting_line_are_found_where_it_drifts_to(case):
    # The raster is a window on a long line; what it shows are the pixels of all the line that lie in it.
    x, y, rise = case
    segment = np.array([[[x - 4000, y - rise], [x + 4000.0, y + rise]]])
    everything = draw_lines(segment, 16000, 16000, line="dda-float32", pixel_center="integer").pixels
    part = draw_lines(segment, 200, 100, line="dda-float32", pixel_center="integer").pixels
    inside = (everything < (200, 100)).all(axis=1)
    np.testing.assert_array_equal(part, everything[inside])


@pytest.mark.parametrize("line", METHODS)
def test_centers_on_integers_shift_everything_by_half(line):
    segments = np.array([[[0.25, 0.5], [9.0, 4.75]], [[7.0, 1.0], [2.5, 8.0]]])
    half = draw_lines(segments + 0.5, 10, 9, line=line)
    whole = draw_lines(segments, 10, 9, line=line, pixel_center="integer")
    np.testing.assert_array_equal(half.pixels, whole.pixels)
    np.testing.assert_array_equal(half.steps.t, whole.steps.t)


def test_ends_move_to_the_pixel_that_they_lie_in():
    assert draw_lines([[[1.0, 0.999], [1.999, 0.0]]], 4, 4, last_pixel=True).pixels.tolist() == [[1, 0]]
    integer = draw_lines([[[0.5, 0.25], [1.49, 0.49]]], 4, 4, last_pixel=True, pixel_center="integer")
    assert integer.pixels.tolist() == [[1, 0]]


def test_halves_round_up():
    values = np.array([-1.5, -0.5, 0.5, 1.5, 2.5, 0.49999999999999994, -0.25])
    assert round_half_up(values).tolist() == [-1, 0, 1, 2, 3, 0, 0]


def test_colour_and_depth_along_a_line():
    values = [[[1.0, 0.0], [0.0, 10.0]]]
    drawn = draw_lines(centers([0, 0, 4, 2]), 5, 3)
    mixed = interpolate_line(drawn.owner, drawn.steps.t, values)
    np.testing.assert_allclose(mixed, [[1, 0], [0.75, 2.5], [0.5, 5], [0.25, 7.5]])
    correct = interpolate_line(drawn.owner, drawn.steps.t, values, [[1.0, 3.0]])
    share = np.array([0, 0.25 / 3 / (0.75 + 0.25 / 3), 0.25, 0.25 / (0.25 + 0.25)])
    np.testing.assert_allclose(correct[:, 1], 10 * share)


def test_the_parameter_is_measured_along_the_longer_axis_between_the_given_ends():
    ends = np.array([[[0.25, 0.0], [4.25, 3.0]], [[0.0, 4.0], [1.0, 0.0]], [[1.0, 1.0], [1.0, 1.0]]])
    column, row, owner = np.array([2, 0, 1]), np.array([1, 3, 1]), np.arange(3)
    t = segment_parameter(column, row, owner, ends, 0.5)
    np.testing.assert_array_equal(t, [2.25 / 4, 0.5 / 4, 0])


@pytest.mark.parametrize(
    ("segments", "options", "message"),
    [
        ([[0, 0, 1, 1]], {}, r"segments must be \(L, 2, 2\), got \(1, 4\)"),
        ([[[0, 0], [np.nan, 1]]], {}, "segments must be finite"),
        ([[[0, 0], [2e6, 1]]], {}, r"within 1048576 pixels .* \(segment 0\)"),
        ([[[0, 0], [1, 1]]], {"line": "xiaolin"}, "line must be one of bresenham, .* got xiaolin"),
        ([[[0, 0], [1, 1]]], {"width": 0}, "raster must be 1 to"),
        ([[[0, 0], [1, 1]]], {"pixel_center": "corner"}, "pixel_center must be one of half, integer"),
        ([[[0, 0], [5e5, 0]]], {"line": "bresenham-float"}, None),
        (
            [[[-5e5, 0], [5e5, 0]]],
            {"line": "bresenham-float"},
            r"at most 65536 steps, got 500008 .*\(segment 0\)",
        ),
        ([[[0, 0], [5e5, 0]]], {"line": "dda-float32"}, None),
        (
            [[[-5e5, 0], [5e5, 0]]],
            {"line": "dda-float32"},
            r"at most 65536 steps, got 500008 .*\(segment 0\)",
        ),
    ],
)
def test_what_is_refused(segments, options, message):
    arguments = {"width": 8, "height": 8, **options}
    if message is None:
        assert len(draw_lines(segments, **arguments).pixels) == 8
        return
    with pytest.raises(ValueError, match=message):
        draw_lines(segments, **arguments)


@pytest.mark.parametrize(
    ("values", "w", "message"),
    [
        ([[1.0, 2.0]], None, r"values must be \(L, 2, K\)"),
        ([[[1.0], [2.0]]], [[1.0, 1.0], [1.0, 1.0]], r"w must be \(1, 2\)"),
        ([[[1.0], [2.0]]], [[1.0, 0.0]], "w must be positive"),
    ],
)
def test_what_interpolation_refuses(values, w, message):
    with pytest.raises(ValueError, match=message):
        interpolate_line(np.array([0]), np.array([0.5]), values, w)


@pytest.mark.parametrize("line", [name for name in METHODS if name not in ("bresenham-float", "dda-float32")])
def test_far_ends_need_no_far_loops(line):
    # Through the raster from one corner of the allowed square to the other, and a thousand that miss it.
    far = COORDINATE_LIMIT
    through = draw_lines([[[-far, -far], [far, far]]], 8, 8, line=line)
    assert through.pixels.tolist() == [[i, i] for i in range(8)]
    beside = np.tile([[[-far, 40.0], [far, 30.0]]], (1000, 1, 1))
    assert len(draw_lines(beside, 8, 8, line=line).pixels) == 0


def test_results_cannot_be_written():
    drawn = draw_lines(centers([0, 0, 5, 2]), 6, 3)
    for array in (*drawn, *vars(drawn.steps).values()):
        assert not array.flags.writeable
