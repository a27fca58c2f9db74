"""Pixels of rows come row by row, triangle by triangle, as the rows do."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.coverage.pixel_runs import make_raster
from core.spans.fill import LaneRows, pixels_of_rows


@given(
    st.lists(
        st.tuples(st.integers(0, 3), st.integers(2, 6), st.integers(1, 8), st.integers(0, 4)), max_size=12
    )
)
def test_pixels_are_those_of_the_rows_in_their_order(drawn):
    raster = make_raster((13, 7), "half", (1, 2, 12, 5))
    drawn = sorted(drawn, key=lambda row: row[0])
    triangle, row, start, length = np.array(drawn, np.int64).reshape(-1, 4).T
    pixel, owner = pixels_of_rows(LaneRows(triangle, row, start, start + length), raster)
    expected = [
        (int(raster.index(np.array(column), np.array(y))), t)
        for t, y, first, count in drawn
        for column in range(first, first + count)
    ]
    assert list(zip(pixel.tolist(), owner.tolist(), strict=True)) == expected
