"""Strips: a large triangle as slanted blocks has the pixels of its spans, and values where the columns have them."""

import numpy as np
import pytest

from core.raster.schedule import make_raster
from core.raster.spans.arena import Arena
from core.raster.spans.bands import spans_by_row, strips
from core.raster.spans.lanes import set_up_lanes, tie_owners

TRIANGLES = {
    "slanted both ways": [(3.0, 2.0), (400.5, 180.25), (20.0, 390.0)],
    "level below": [(10.0, 5.0), (380.0, 5.0), (390.0, 380.0)],
    "beyond the raster": [(-300.0, -40.0), (900.0, 100.0), (100.0, 800.0)],
    "hardly wider than a pixel at its ends": [(0.0, 0.0), (399.0, 201.0), (399.5, 399.0)],
}


@pytest.mark.parametrize("name", list(TRIANGLES))
def test_strips_have_the_spans_of_the_rows_and_their_columns(name):
    raster, owners = make_raster((400, 400), "half"), tie_owners("shared-edge")
    x, y = np.array(TRIANGLES[name]).T[:, :, None]
    area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])

    def lanes():
        return set_up_lanes(x, y, area, raster, owners, Arena())

    bottom, start, stop = spans_by_row(lanes(), raster, owners, Arena())
    found = list(strips(lanes(), raster, owners, Arena()))
    assert np.concatenate([strip.row for strip in found]).tolist() == list(range(bottom, bottom + len(start)))
    assert np.array_equal(np.concatenate([strip.start for strip in found]), start)
    assert np.array_equal(np.concatenate([strip.stop for strip in found]), stop)
    for strip in found:
        assert strip.width == (strip.stop - strip.start).max()
        columns = strip.spread(strip.column)
        assert np.array_equal(columns, strip.start[:, None] + np.arange(strip.width))
