"""Rows, strips and bands of large triangles: the pixels of their spans, and values that no block's place changes."""

import numpy as np
import pytest

from core.coverage.pixel_runs import make_raster
from core.numeric.large_arrays import ScratchBuffers
from core.spans.bands import bands, rows_of_triangles, strips
from core.spans.lanes import Carried, bounds_of_rows, set_up_lanes, tie_owners
from tests.covering import in_turns

TRIANGLES = {
    "slanted both ways": [(3.0, 2.0), (400.5, 180.25), (20.0, 390.0)],
    "level below": [(10.0, 5.0), (380.0, 5.0), (390.0, 380.0)],
    "beyond the raster": [(-300.0, -40.0), (900.0, 100.0), (100.0, 800.0)],
    "hardly wider than a pixel at its ends": [(0.0, 0.0), (399.0, 201.0), (399.5, 399.0)],
    "between pixel centres": [(10.6, 0.0), (11.4, 0.0), (11.0, 300.0)],
    "without area": [(1.0, 1.0), (100.0, 100.0), (200.0, 200.0)],
}
REGIONS = {"whole": None, "right part": (150, 0, 250, 400), "a few columns and rows": (37, 90, 60, 101)}


def corners(names):
    x, y = np.moveaxis(np.array([TRIANGLES[name] for name in names]), 0, 2).transpose(1, 0, 2)
    return x, y, (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])


def rows_of(names, region=None):
    raster, owners = make_raster((400, 400), "half", region), tie_owners("shared-edge")
    return raster, rows_of_triangles(*corners(names), raster, owners, ScratchBuffers())


def pixels_of(rows):
    return {
        (int(row), column)
        for row, start, stop in zip(rows.row, rows.start, rows.stop, strict=True)
        for column in range(start, stop)
    }


@in_turns(region=list(REGIONS), names=[list(TRIANGLES), *([name] for name in TRIANGLES)])
def test_rows_of_triangles_have_the_pixels_that_walking_their_lanes_finds(names, region):
    raster, found = rows_of(names, REGIONS[region])
    owners = tie_owners("shared-edge")
    lanes = set_up_lanes(*corners(names), raster, owners, ScratchBuffers())
    first = lanes.first_row.astype(np.int64)
    carried = (Carried(np.arange(len(first)), 0), Carried(first, 1))
    (lane, row), start, length = bounds_of_rows(lanes, raster, owners, carried, ScratchBuffers())
    expected = {name: set() for name in names}
    for which, at, begin, count in zip(lane, row, start.tolist(), length.tolist(), strict=True):
        name = names[lanes.triangle[which]]
        expected[name] |= {(int(at), begin + k) for k in range(count)}
    for name, rows in zip(names, found, strict=True):
        assert pixels_of(rows) == expected[name]
        assert rows.pixel_count == len(expected[name])
        if len(rows):
            assert rows.row.tolist() == list(range(rows.row[0], rows.row[-1] + 1))


@pytest.mark.parametrize("region", list(REGIONS))
@pytest.mark.parametrize("name", ["slanted both ways", "level below", "beyond the raster"])
def test_blocks_have_the_columns_of_the_window_counted_from_where_rows_begin_in_it(name, region):
    origins = dict(
        zip(rows_of([name])[1][0].row.tolist(), rows_of([name])[1][0].origin.tolist(), strict=True)
    )
    raster, (rows,) = rows_of([name], REGIONS[region])
    assert [origins[row] for row in rows.row.tolist()] == rows.origin.tolist()
    for block in (*strips(rows), *bands(rows, raster)):
        steps = block.steps
        columns = block.inside.origin[:, None] + np.broadcast_to(
            steps.spread(steps.number), (len(block.inside), steps.width)
        )
        first = block.column[0] if hasattr(block, "column") else block.inside.start[:, None]
        assert np.array_equal(columns, first + np.zeros_like(columns) + np.arange(steps.width))


@pytest.mark.parametrize("region", list(REGIONS))
def test_strips_and_bands_of_a_triangle_are_its_rows_in_turn(region):
    for name in TRIANGLES:
        raster, (rows,) = rows_of([name], REGIONS[region])
        for blocks in (list(strips(rows)), list(bands(rows, raster))):
            for field in ("row", "start", "stop", "origin"):
                parts = [getattr(block.inside, field) for block in blocks] or [np.zeros(0)]
                assert np.array_equal(np.concatenate(parts), getattr(rows, field))
        for strip in strips(rows):
            assert strip.width == (strip.inside.stop - strip.inside.start).max()
