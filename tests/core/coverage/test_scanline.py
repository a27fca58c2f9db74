"""Exact spans: one run a row, its listing, and the bisection where the proposed column is wrong."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.coverage.binning import bound
from core.coverage.pixel_runs import make_raster
from core.coverage.scanline import span, turning_column
from tests.core.drawing import edges_of, runs_of
from tests.core.strategies import ANY_TRIANGLES, REGIONS, clip_of_window


@given(ANY_TRIANGLES, REGIONS, st.sampled_from(["half", "integer"]))
def test_listing_of_one_row(case, region, center: str) -> None:
    clip, size = case
    edges, raster = edges_of(clip, size), make_raster(size, center, region)
    boxes = bound(edges, raster)
    runs = runs_of(edges, raster, "scanline")
    for r in range(len(runs)):
        t = runs.triangle[r]
        coefficients = list(zip(edges.a[t], edges.b[t], edges.c[t], edges.owns_tie[t], strict=True))
        first, end = int(boxes.column[t]), int(boxes.column_end[t])
        with np.errstate(all="ignore"):
            columns = span(coefficients, runs.row[r] + raster.center, first, end, raster.center)
        assert columns == list(range(runs.start[r], runs.stop[r]))


@given(
    st.sampled_from([1.0, -1.0, 3.0, -0.1, 1e-17, -1e-17, 1e13, -1e13]),
    st.floats(-1e3, 1e3),
    st.booleans(),
    st.integers(0, 40),
)
def test_turning_column_is_the_first_on_the_other_side(a: float, c: float, owns_tie: bool, stop: int) -> None:
    columns, _ = turning_column(
        np.array([a]),
        np.array([1.0]),
        np.array([c]),
        np.array([owns_tie]),
        np.array([0.5]),
        np.array([0]),
        np.array([stop]),
        0.5,
    )
    values = [a * (column + 0.5) + (0.5 + c) for column in range(stop)]
    inside = [value > 0 or (value == 0 and owns_tie) for value in values]
    turned = [flag == (a > 0) for flag in inside]
    assert columns[0] == (turned.index(True) if True in turned else stop)


def test_crossings_stand_on_the_edges() -> None:
    edges = edges_of(clip_of_window([[(1, 1), (7, 1), (1, 7)]], (8, 8)), (8, 8))
    runs = runs_of(edges, make_raster((8, 8), "half"), "scanline")
    # Edge 0 is the slanted side x + y = 8, edge 1 the left side x = 1, edge 2 the level bottom side.
    assert np.array_equal(runs.crossings[:, 0], 8 - (runs.row + 0.5))
    assert (runs.crossings[:, 1] == 1).all()
    assert np.isnan(runs.crossings[:, 2]).all()
