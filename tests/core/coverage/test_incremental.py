"""Additions in the place of products: the same pixels where sums are exact, drifting edges where they are not."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.coverage.fills import add_up, cover, examine_pixels, stepped_values
from core.coverage.pixel_runs import ADDED_A, ADDED_B, EVALUATED, make_raster
from tests.core.drawing import cover_each, edges_of, runs_of
from tests.core.strategies import ANY_TRIANGLES, REGIONS, clip_of_window

FORMATS = ["snapped", "float64", "float32", "float16", "inverse", "fixed-24.8", "int64", "exact"]


@given(ANY_TRIANGLES, st.sampled_from(["int64", "exact", "fixed-24.8"]), st.sampled_from(["half", "integer"]))
def test_exact_sums_draw_the_same_pixels(case, coverage: str, center: str) -> None:
    clip, size = case
    drawn = cover_each(clip, size, "incremental", coverage=coverage, pixel_center=center)
    assert np.array_equal(
        drawn, cover_each(clip, size, "bounding-box", coverage=coverage, pixel_center=center)
    )


def added_one_by_one(
    edges, t: int, box: tuple[int, int, int, int], center: float
) -> dict[tuple[int, int], list]:
    """Return the values at the pixels of a box, walked by a loop as it would be programmed."""
    column, row, column_end, row_end = box
    one = edges.numbers.of_pixels(np.ones(1))[0]
    x, y = (edges.numbers.of_pixels(np.array([place + center]))[0] for place in (column, row))
    a, b, c = ([numbers[t, k] for k in range(3)] for numbers in (edges.a, edges.b, edges.c))
    of_row = [a[k] * x + (b[k] * y + c[k]) for k in range(3)]
    found = {}
    for j in range(row, row_end):
        value = list(of_row)
        for i in range(column, column_end):
            found[i, j] = list(value)
            value = [value[k] + a[k] * one for k in range(3)]
        of_row = [of_row[k] + b[k] * one for k in range(3)]
    return found


@given(ANY_TRIANGLES, st.sampled_from(FORMATS), REGIONS)
def test_values_are_those_of_a_loop_whatever_region_is_drawn(case, coverage: str, region) -> None:
    clip, size = case
    edges, raster = edges_of(clip, size, coverage), make_raster(size, "half", region)
    runs = runs_of(edges, raster, "incremental")
    tests, held = examine_pixels(edges, runs, raster), stepped_values(edges, runs)
    whole = runs_of(edges, make_raster(size, "half"), "incremental")
    for t in range(len(edges)):
        mine = whole.triangle == t
        if not mine.any():
            assert not (tests.primitive == t).any()
            continue
        box = (
            whole.start[mine].min(),
            whole.row[mine].min(),
            whole.stop[mine].max(),
            whole.row[mine].max() + 1,
        )
        with np.errstate(all="ignore"):
            wanted = added_one_by_one(edges, t, tuple(int(n) for n in box), 0.5)
        for q in np.flatnonzero(tests.primitive == t).tolist():
            assert np.array_equal(
                np.array(held[q], float),
                np.array(wanted[tests.column[q], tests.row[q]], float),
                equal_nan=True,
            )


@given(ANY_TRIANGLES, st.sampled_from(FORMATS))
def test_every_pixel_says_what_was_added_to_what(case, coverage: str) -> None:
    clip, size = case
    edges, raster = edges_of(clip, size, coverage), make_raster(size, "half")
    runs = runs_of(edges, raster, "incremental")
    tests = examine_pixels(edges, runs, raster)
    value_at = {
        (t, i, j): value
        for t, i, j, value in zip(
            tests.primitive.tolist(), tests.column.tolist(), tests.row.tolist(), tests.values, strict=True
        )
    }
    for q in range(len(tests.run)):
        t, i, j = tests.primitive[q], tests.column[q], tests.row[q]
        if tests.added[q] == EVALUATED:
            assert np.isnan(tests.before[q]).all()
            continue
        reached_from = (t, i - 1, j) if tests.added[q] == ADDED_A else (t, i, j - 1)
        assert np.array_equal(tests.before[q], value_at[reached_from], equal_nan=True)
    first = np.flatnonzero(np.diff(tests.primitive, prepend=-1))
    assert (tests.added[first] == EVALUATED).all()
    assert np.count_nonzero(tests.added == EVALUATED) == len(first)
    assert np.count_nonzero(tests.added == ADDED_B) == len(runs) - len(first)


@given(
    st.lists(st.tuples(st.floats(-9, 9), st.floats(-1, 1), st.integers(0, 40)), min_size=1, max_size=6),
    st.sampled_from([np.float64, np.float32, np.float16]),
)
def test_sums_are_rounded_one_after_the_other(cases, number) -> None:
    value, step, count = (np.array(column) for column in zip(*cases, strict=True))
    found, before = add_up(np.array(value, number)[:, None], np.array(step, number)[:, None], count)
    for k in range(len(cases)):
        total = earlier = number(value[k])
        for _ in range(count[k]):
            total, earlier = total + number(step[k]), total
        assert found[k, 0] == total
        assert before[k, 0] == earlier


@pytest.mark.slow
@pytest.mark.parametrize("coverage", ["float64", "float32", "float16", "inverse"])
def test_rounded_sums_drift(coverage: str) -> None:
    # Sides with slopes that no binary number has; far along the rows the sum has lost its way.
    size = (1000, 40)
    generator = np.random.default_rng(2)
    points = np.stack([generator.uniform(0, 1000, (30, 3)), generator.uniform(0, 40, (30, 3))], axis=2)
    edges, raster = edges_of(clip_of_window(points, size), size, coverage), make_raster(size, "half")
    evaluated, added = (
        examine_pixels(edges, runs_of(edges, raster, fill), raster).values
        for fill in ("bounding-box", "incremental")
    )
    assert np.nanmax(np.abs(added - evaluated)) > 0
    # Where no drift is, none is seen.
    exact = edges_of(clip_of_window(points, size), size, "snapped")
    evaluated, added = (
        examine_pixels(exact, runs_of(exact, raster, fill), raster).values
        for fill in ("bounding-box", "incremental")
    )
    assert np.array_equal(evaluated, added)


@pytest.mark.parametrize("coverage", ["float32", "float16"])
def test_drift_misclassifies_pixels_that_products_get_right(coverage: str) -> None:
    size = (800, 60) if coverage == "float32" else (60, 60)
    generator = np.random.default_rng(7)
    points = np.stack([generator.uniform(0, size[0], (60, 3)), generator.uniform(0, 60, (60, 3))], axis=2)
    # Corners on whole numbers, which the format has exactly, so that rounding is all there is.
    clip = clip_of_window(np.rint(points), size)
    products, sums = misclassified_counts(clip, size, coverage)
    assert sums >= products
    products, sums = misclassified_counts(clip_of_window(points, size), size, coverage)
    assert sums > products


def misclassified_counts(clip: np.ndarray, size: tuple[int, int], coverage: str) -> list[int]:
    """Return how many pixels products and sums decide otherwise than rational arithmetic."""
    wanted = cover_each(clip, size, "bounding-box", coverage="exact")
    drawn = (cover_each(clip, size, fill, coverage=coverage) for fill in ("bounding-box", "incremental"))
    return [int(np.abs(each - wanted).sum()) for each in drawn]


@given(ANY_TRIANGLES, REGIONS, st.sampled_from(FORMATS))
def test_a_region_shows_its_part_of_the_picture(case, region, coverage: str) -> None:
    clip, size = case
    whole = cover_each(clip, size, "incremental", coverage=coverage)
    column, row, columns, rows = region
    window = np.zeros(whole.shape[1:], bool)
    window[row : row + rows, column : column + columns] = True
    part = cover_each(clip, size, "incremental", coverage=coverage, region=region)
    assert np.array_equal(part, whole * window)


def test_batches_of_runs_continue_where_they_should(monkeypatch) -> None:
    monkeypatch.setattr("core.coverage.fills.BATCH", 7)
    clip = clip_of_window([[(0, 0), (30, 3), (5, 20)], [(3, 1), (9, 19), (2, 11)]], (32, 20))
    edges, raster = edges_of(clip, (32, 20), "float32"), make_raster((32, 20), "half")
    runs = runs_of(edges, raster, "incremental")
    batches = list(cover(edges, runs, raster))
    assert len(batches) > 10
    tests = examine_pixels(edges, runs, raster)
    drawn = [
        pixel
        for found, _ in batches
        for pixel in zip(found.primitive.tolist(), found.column.tolist(), found.row.tolist(), strict=True)
    ]
    kept = tests.covered
    assert drawn == list(
        zip(
            tests.primitive[kept].tolist(), tests.column[kept].tolist(), tests.row[kept].tolist(), strict=True
        )
    )
