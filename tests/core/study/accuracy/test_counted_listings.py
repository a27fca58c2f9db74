"""Counted work of the line methods: the same pixels, and as many operations as the listings can be seen to do."""

from collections import Counter

import pytest

from core.methods import table
from core.settings import Settings
from core.study.counted_listings import (
    CountedNumber,
    count_line_operations,
    counting_listing,
    line_listing,
    listing_ends,
    plain,
)
from core.study.workloads import random_lines

SIZE = (64, 64)
SEGMENTS = random_lines(SIZE, 12, 24.0, 3, False)
COUNTED = table.names("line")


def level_line(line: str, length: int) -> dict[str, int]:
    """Count a level line between pixel centres."""
    segment = [[[2.5, 8.5], [2.5 + length, 8.5]]]
    return count_line_operations(segment, SIZE, Settings(line=line))


@pytest.mark.parametrize("line", COUNTED)
def test_counting_changes_no_pixel(line: str) -> None:
    listing, tally = line_listing(line), Counter[str]()
    for ends in listing_ends(SEGMENTS, SIZE, Settings(line=line)):
        found = counting_listing(listing, tally)(*(CountedNumber(end, tally) for end in ends), False)
        assert repr([tuple(map(plain, row)) for row in found]) == repr(listing(*ends, False))
    assert tally.total() > 100


@pytest.mark.parametrize("line", COUNTED)
def test_work_grows_in_proportion_to_the_length(line: str) -> None:
    short, middle, long = (sum(level_line(line, length).values()) for length in (10, 20, 30))
    assert long - middle == middle - short > 0


@pytest.mark.parametrize(
    ("line", "name", "for_each_column"),
    [
        ("dda", "float additions", 3),  # y - floor(y), y += m x_step, and x1 - x of the loop.
        ("dda-float32", "roundings to float32", 1),
        ("wu", "float multiplications", 3),  # m x, and part x share twice.
        ("wu", "roundings", 3),
        ("gupta-sproull", "table look-ups", 3),
        ("gupta-sproull", "float multiplications", 10),  # m x, and distance, entry and intensity three times.
        (
            "rectangle",
            "integer multiplications",
            23,
        ),  # 256 u, its way across, and seven for each of three pixels.
        (
            "rectangle",
            "float divisions",
            3,
        ),  # The nearest row twice, and the distance of the pixel that is drawn.
    ],
)
def test_operations_of_a_column_are_those_of_the_listing(line: str, name: str, for_each_column: int) -> None:
    assert level_line(line, 30)[name] - level_line(line, 20)[name] == 10 * for_each_column


@pytest.mark.parametrize(
    ("line", "name"), [("gupta-sproull", "float square roots"), ("rectangle", "integer square roots")]
)
def test_a_root_is_taken_once_for_a_line(line: str, name: str) -> None:
    assert count_line_operations(SEGMENTS, SIZE, Settings(line=line))[name] == len(SEGMENTS)
