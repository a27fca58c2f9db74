import numpy as np
import pytest

from core.methods import table
from core.raster.line_records import COORDINATE_LIMIT, round_half_up
from core.raster.lines import LISTINGS, draw_lines, interpolate_line, segment_parameter

METHODS = ["bresenham", "bresenham-lecture", "bresenham-float", "midpoint", "dda", "diamond-exit"]


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


def test_the_family_has_its_methods_in_order():
    assert list(table.names("line"))[:6] == METHODS
    assert set(LISTINGS) == set(METHODS)


SLOPE_2_OF_5 = {
    "bresenham": ["....0.", "..00..", "00...."],
    "bresenham-lecture": ["....00", "..00..", "00...."],
    "bresenham-float": ["....0.", "..00..", "00...."],
    "midpoint": ["....0.", "..00..", "00...."],
    "dda": ["....0.", "..00..", "00...."],
    "diamond-exit": ["....0.", "..00..", "00...."],
}


@pytest.mark.parametrize("line", METHODS)
def test_a_line_without_ties(line):
    assert picture(centers([0, 0, 5, 2]), 6, 3, line=line) == SLOPE_2_OF_5[line]


# Slope 1/2: every second column is a tie. Drawn from left to right and from right to left, rising and falling.
TIES = {
    "bresenham": (["..00.", "00..."], ["...00", ".00.."], ["0....", ".00.."], ["00...", "..00."]),
}
RISING, RISING_BACK = centers([0, 0, 4, 2]), centers([4, 2, 0, 0])
FALLING, FALLING_BACK = centers([0, 2, 4, 0]), centers([4, 0, 0, 2])
TIE_PICTURES = [
    ("bresenham", RISING, [".....", ".00..", "0...."], ["...0."]),
]


@pytest.mark.parametrize(
    ("line", "rising", "rising_back", "falling", "falling_back"),
    [
        (
            "bresenham",  # steps at a tie, whichever way it runs: equivariant, but not the same backwards
            ["....0", ".00..", "0...."][0:0] + ["...0.", ".00..", "0...."],
            ["....0", "..00.", ".0..."],
            ["0....", ".00..", "...0."],
            [".0...", "..00.", "....0"],
        ),
        (
            "bresenham-lecture",  # runs left to right and stays at a tie: the same backwards, not mirrored
            ["...00"[0:0] + "....0", "..00.", "00..."][0:3],
            ["....0", "..00.", "00..."],
            ["00...", "..00.", "....0"],
            ["00...", "..00.", "....0"],
        ),
        (
            "bresenham-float",  # stays at a tie in its own direction
            [".....", "..00.", "00..."],
            ["...00", ".00..", "....."],
            ["00...", "..00.", "....."],
            [".....", ".00..", "...00"],
        ),
        (
            "midpoint",  # a tie goes up
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
            "diamond-exit",  # up where the line rises, down where it falls, in both directions
            ["...0.", ".00..", "0...."],
            ["...00", ".00..", "....."],
            ["0....", ".00..", "...0."],
            [".....", ".00..", "...00"],
        ),
    ],
)
def test_what_each_method_does_at_ties(line, rising, rising_back, falling, falling_back):
    assert picture(RISING, 5, 3, line=line) == rising
    assert picture(RISING_BACK, 5, 3, line=line) == rising_back
    assert picture(FALLING, 5, 3, line=line) == falling
    assert picture(FALLING_BACK, 5, 3, line=line) == falling_back
