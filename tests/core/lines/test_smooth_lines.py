"""Xiaolin Wu's and Gupta and Sproull's lines: pictures, sums of intensities, symmetries, ends."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.lines.drawing import draw_lines
from core.lines.line_method import COORDINATE_LIMIT
from core.lines.measured import line_areas
from core.lines.smooth import FILTER_TABLE, cone_intensity
from tests.core.lines.test_lines_pictures import centers

SMOOTH = ["wu", "gupta-sproull"]
COORDINATE = st.one_of(
    st.integers(-20, 20).map(float), st.integers(-40, 40).map(lambda n: n / 2), st.floats(-20, 20)
)
SEGMENT = st.tuples(*[COORDINATE] * 4)
SHIFT, SIZE = 32, 64


def intensities(segments, line: str) -> np.ndarray:
    """Sum of the intensities at every pixel of a raster that holds the segments whole, centres on whole numbers."""
    segments = np.asarray(segments, float).reshape(-1, 2, 2) + SHIFT
    pixels, shown, _ = draw_lines(segments, SIZE, SIZE, line=line, pixel_center="integer")
    picture = np.zeros((SIZE, SIZE))
    np.add.at(picture, (pixels[:, 1], pixels[:, 0]), shown)
    return picture


def digits(segments, width: int, height: int, line: str) -> list[str]:
    """Rows from top to bottom: tenths of the intensity, ``#`` for 1."""
    rows = np.full((height, width), ".")
    pixels, shown, _ = draw_lines(segments, width, height, line=line)
    for (column, row), intensity in zip(pixels.tolist(), shown.tolist(), strict=True):
        rows[row, column] = "#" if intensity == 1 else str(int(intensity * 10 + 1e-9))
    return ["".join(row) for row in rows[::-1]]


def test_pictures_of_wu():
    assert digits(centers([0, 0, 5, 2]), 6, 3, "wu") == ["...265", ".4884.", "562..."]
    # Level on the centres, level between them, diagonal.
    assert digits(centers([0, 1, 5, 1]), 6, 3, "wu") == ["......", "5####5", "......"]
    assert digits([[[0.0, 1.0], [4.0, 1.0]]], 5, 2, "wu") == ["5555.", "5555."]
    assert digits(centers([0, 0, 3, 3]), 4, 4, "wu") == ["...5", "..#.", ".#..", "5..."]


def test_pictures_of_gupta_and_sproull():
    assert digits(centers([0, 0, 5, 2]), 6, 4, "gupta-sproull") == ["....00", "..0263", "047740", "3620.."]
    assert digits(centers([0, 1, 5, 1]), 6, 3, "gupta-sproull") == ["011110", "377773", "011110"]
    assert digits(centers([0, 0, 3, 3]), 4, 4, "gupta-sproull") == ["..33", ".371", "173.", "33.."]


@pytest.mark.parametrize("line", SMOOTH)
@pytest.mark.parametrize("mirror", [(1, 1), (-1, 1), (1, -1), (-1, -1)])
@pytest.mark.parametrize("swaps", [False, True])
def test_all_octants_are_mirror_images(line, mirror, swaps):
    # The coordinates are short binary fractions and the slope 1/4: nothing is rounded.
    def move(points):
        points = np.asarray(points) * mirror
        return points[..., ::-1] if swaps else points

    segments = np.array([[[-11.5, -2.25], [12.5, 3.75]]])
    pixels, shown, _ = draw_lines(segments + SHIFT, SIZE, SIZE, line=line, pixel_center="integer")
    wanted = np.zeros((SIZE, SIZE))
    moved = move(pixels - SHIFT) + SHIFT
    wanted[moved[:, 1], moved[:, 0]] = shown
    np.testing.assert_array_equal(intensities(move(segments), line), wanted)


@pytest.mark.parametrize("line", SMOOTH)
@given(ends=SEGMENT)
def test_backwards_it_is_the_same_line(line, ends):
    segment = np.array(ends).reshape(2, 2)
    forward, backward = intensities(segment, line), intensities(segment[::-1], line)
    # The table's entries are a sixteenth of a pixel apart, up to 0.06 in intensity: rounding may take the next one.
    tolerance = 1e-12 if line == "wu" else 0.06
    np.testing.assert_allclose(forward, backward, atol=tolerance)


def line_distance(pixels: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Return how far centres on whole numbers (P, 2) are from the unlimited line through ends (2, 2), or a point."""
    way, offset = ends[1] - ends[0], pixels - ends[0]
    length = np.hypot(*way)
    if length == 0:
        return np.hypot(*offset.T)
    return np.abs(way[0] * offset[:, 1] - way[1] * offset[:, 0]) / length


@given(SEGMENT)
def test_intensities_of_wu_add_up_to_what_the_segment_spans(ends):
    segment = np.array(ends).reshape(2, 2)
    length = np.abs(segment[1] - segment[0])
    along = int(length[1] <= length[0])
    drawn = draw_lines(segment[None] + SHIFT, SIZE, SIZE, line="wu", pixel_center="integer")
    of_columns = intensities(segment, "wu").sum(axis=1 - along if along == 0 else 0)
    low, high = sorted(segment[:, 1 - along] + SHIFT)
    columns = np.arange(SIZE)
    spans = np.clip(np.minimum(columns + 0.5, high) - np.maximum(columns - 0.5, low), 0, None)
    np.testing.assert_allclose(of_columns, spans, atol=1e-12)
    assert ((drawn.intensities > 0) & (drawn.intensities <= 1)).all()
    # Within one column the two are exactly 1 together.
    inner = drawn.steps.share == 1
    column = drawn.pixels[inner, 1 - along]
    assert set(np.bincount(column, weights=drawn.intensities[inner]).tolist()) <= {0.0, 1.0}


@pytest.mark.parametrize("line", SMOOTH)
@given(
    start=st.tuples(COORDINATE, COORDINATE),
    steps=st.integers(1, 6),
    way=st.tuples(*[st.integers(-12, 12)] * 2),
)
def test_lines_that_continue_each_other_add_up_to_the_undivided_one(line, start, steps, way):
    # Every way is longer in x or in y for all pieces alike; the table may take the neighbouring entry.
    joints = np.rint(np.array(start) * 4) / 4 + np.arange(steps + 1)[:, None] * np.array(way) / 4
    pieces = np.stack([joints[:-1], joints[1:]], axis=1)
    tolerance = 1e-9 if line == "wu" else 0.06
    np.testing.assert_allclose(intensities(pieces, line), intensities(joints[[0, -1]], line), atol=tolerance)


@given(SEGMENT)
def test_gupta_and_sproull_look_up_the_distance_from_the_line(ends):
    segment = np.array(ends).reshape(1, 2, 2)
    drawn = draw_lines(segment + SHIFT, SIZE, SIZE, line="gupta-sproull", pixel_center="integer")
    distance = line_distance(drawn.pixels, segment[0] + SHIFT)
    inner = drawn.steps.share == 1
    np.testing.assert_allclose(drawn.steps.line_distance[inner], distance[inner], atol=1e-9)
    wanted = cone_intensity(distance[inner])
    assert (np.abs(drawn.intensities[inner] - wanted) <= 0.03).all()


@given(st.integers(-160, 160), st.integers(-10, 10))
def test_level_lines_have_one_unit_in_every_column(height, rise):
    # Sixteenths are entries of the table; with the fourth row out of reach the filter's volume is complete.
    segment = [[-15.0, height / 16], [15.0, height / 16]]
    np.testing.assert_allclose(
        intensities(segment, "gupta-sproull")[:, SHIFT - 10 : SHIFT + 10].sum(axis=0), 1
    )
    # Sloping lines are brighter in a column by as much as they are longer in it.
    sloping = [[-20.0, -rise], [20.0, rise]]
    sums = intensities(sloping, "gupta-sproull")[:, SHIFT - 19 : SHIFT + 19].sum(axis=0)
    np.testing.assert_allclose(sums.mean(), np.hypot(20, rise) / 20, rtol=0.03)


def test_the_filter_is_the_volume_over_the_line():
    # A second derivation: the cone summed over a fine grid.
    n = 2000
    place = (np.arange(n) + 0.5) / n * 2 - 1
    x, y = np.meshgrid(place, place)
    height = np.maximum(1 - np.hypot(x, y), 0) * 3 / np.pi
    for distance in (0.0, 0.25, 0.5, 0.9, 1.3):
        strip = np.abs(x - distance) < 0.5
        assert abs(height[strip].sum() * (2 / n) ** 2 - cone_intensity(np.array([distance]))[0]) < 1e-3
    assert cone_intensity(np.array([0.5, 1.5, 2.0])).tolist() == [0.5, 0.0, 0.0]
    assert FILTER_TABLE[8] == 0.5
    assert (np.diff(FILTER_TABLE) < 0).all()


@given(st.floats(0, 1))
def test_filters_side_by_side_see_everything(fraction):
    distances = np.abs(fraction + np.arange(-3, 4))
    assert abs(cone_intensity(distances).sum() - 1) < 1e-12


@pytest.mark.parametrize("line", SMOOTH)
@given(ends=SEGMENT)
def test_the_ideal_line_is_near(line, ends):
    # Nothing is drawn where the ideal line is far, and all the length is there. (Both methods cut ends along an axis.)
    segment = np.array(ends).reshape(1, 2, 2) + SHIFT
    pixels, shown, _ = draw_lines(segment, SIZE, SIZE, line=line, pixel_center="integer")
    away = line_distance(pixels, segment[0])
    assert (away < 1.6).all()
    *_, area = line_areas(segment + 0.5, (SIZE, SIZE))
    most = np.abs(segment[0, 1] - segment[0, 0]).max()
    wanted = most if line == "wu" else area.sum()
    assert abs(shown.sum() - wanted) <= (1e-9 if line == "wu" else 0.1 * wanted)


@pytest.mark.parametrize("line", SMOOTH)
def test_degenerate_and_far_segments(line):
    point = centers([2, 1, 2, 1])
    for last_pixel in (False, True):
        assert draw_lines(point, 4, 3, line=line, last_pixel=last_pixel).pixels.tolist() == []
    assert draw_lines(np.zeros((0, 2, 2)), 4, 3, line=line).pixels.shape == (0, 2)
    far = COORDINATE_LIMIT
    through = draw_lines([[[-far, -far], [far, far]]], 8, 8, line=line)
    strongest = through.pixels[through.intensities >= 0.5]
    assert strongest.tolist() == [[i, i] for i in range(8)]
    beside = np.tile([[[-far, 40.0], [far, 30.0]]], (1000, 1, 1))
    assert len(draw_lines(beside, 8, 8, line=line).pixels) == 0


@pytest.mark.parametrize("line", SMOOTH)
def test_a_dot_within_a_pixel_has_the_intensity_of_its_length(line):
    drawn = draw_lines([[[2.375, 1.5], [2.625, 1.5]]], 5, 3, line=line)
    at = dict(zip(map(tuple, drawn.pixels.tolist()), drawn.intensities.tolist(), strict=True))
    assert at[2, 1] == (0.25 if line == "wu" else 0.25 * FILTER_TABLE[0])
    assert drawn.steps.share.tolist() == [0.25] * len(drawn.pixels)
