"""Coverage in other numbers: the referee is exact, the grid formats agree, and each weak one fails where it says."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from core.coverage.binning import bound
from core.coverage.edge_formats import invert
from core.coverage.edges import nearest_float, unit_shift, whole_numbers
from core.coverage.fills import cover, effective_fill, examine_pixels
from core.coverage.pixel_runs import make_raster
from core.methods import table
from tests.core.drawing import cover_each, edges_of, runs_of, text
from tests.core.exact_reference import determinant, exact_coverage, homogeneous_window
from tests.core.strategies import (
    ANY_TRIANGLES,
    clip_of_window,
    grid_triangles,
    homogeneous_triangles,
    perspective_triangles,
    slivers,
)

FORMATS = list(table.names("coverage"))
UNSNAPPED = ["float64", "float32", "float16", "inverse", "exact"]
RULES = list(table.names("fill_rule"))
FILL = "bounding-box"


def exact_each(
    clip, size, rule: str = "shared-edge", snaps: bool = False, doubled_center: int = 1
) -> np.ndarray:
    return np.stack([exact_coverage(triangle, size, rule, doubled_center, snaps) for triangle in clip])


def fan(hub: tuple[float, float], rim: list[tuple[float, float]]) -> list[list[tuple[float, float]]]:
    """Return the triangles around a point, whose edges all but the outer ones are shared."""
    return [[hub, start, end] for start, end in zip(rim, [*rim[1:], rim[0]], strict=True)]


# The referee.


@given(st.one_of(ANY_TRIANGLES, perspective_triangles()), st.sampled_from(RULES), st.sampled_from([0, 1]))
def test_exact_is_rational_arithmetic(case, rule: str, doubled_center: int) -> None:
    clip, size = case
    center = "half" if doubled_center else "integer"
    drawn = cover_each(clip, size, FILL, coverage="exact", fill_rule=rule, pixel_center=center) > 0
    assert np.array_equal(drawn, exact_each(clip, size, rule, False, doubled_center))


@given(
    st.lists(st.floats(-1e3, 1e3), min_size=12, max_size=12),
    st.sampled_from([(5, 4), (16, 16), (33, 7)]),
    st.sampled_from(["bounding-box", "brute-force", "blocks", "hierarchy", "incremental", "spans"]),
)
@example([1.0, 2.0, 0.0, -1e-9, 0.3, 1e3, 0.0, 1e-9, -7.0, 0.1, 0.0, 3.0], (16, 16), "blocks")
@example([1.0, 2.0, 0.0, 5e-324, 0.3, 1e3, 0.0, 1e-200, -7.0, 0.1, 0.0, 3.0], (16, 16), "hierarchy")
def test_exact_on_any_numbers_with_any_fill(numbers: list[float], size: tuple[int, int], fill: str) -> None:
    clip = np.reshape(numbers, (1, 3, 4))
    drawn = cover_each(clip, size, effective_fill(fill, "exact"), coverage="exact") > 0
    assert np.array_equal(drawn, exact_each(clip, size))


def thin_fan(generator: np.random.Generator, size: tuple[int, int]) -> np.ndarray:
    """Return triangles around a pixel centre, the rim within rounding of other pixel centres, any w in front."""
    hub = generator.integers(0, size, 2) + 0.5
    rim = generator.integers(-3, np.array(size) + 3, (9, 2)) + 0.5
    rim += generator.choice([0, 1, -1, 3], (9, 2)) * 2.0**-48
    points = np.array(fan(tuple(hub), [tuple(point) for point in rim]))
    w = generator.choice([0.5, 1, 3, 7], points.shape[:2])
    return clip_of_window(points, size, w)


@pytest.mark.parametrize("seed", range(6))
def test_exact_decides_centres_within_rounding_of_edges(seed: int) -> None:
    size = (13, 11)
    clip = thin_fan(np.random.default_rng(seed), size)
    drawn = cover_each(clip, size, FILL, coverage="exact") > 0
    assert np.array_equal(drawn, exact_each(clip, size))


@given(st.one_of(slivers(), homogeneous_triangles(), perspective_triangles()))
def test_the_filter_decides_as_whole_numbers_do(case) -> None:
    # The picture looks at floats first, the trace does not.
    clip, size = case
    edges, raster = edges_of(clip, size, "exact"), make_raster(size, "half")
    runs = runs_of(edges, raster, FILL)
    tests = examine_pixels(edges, runs, raster)
    found = np.zeros((len(edges), size[1], size[0]), bool)
    for fragments, _ in cover(edges, runs, raster):
        found[fragments.primitive, fragments.row, fragments.column] = True
    assert np.array_equal(found[tests.primitive, tests.row, tests.column], tests.covered)


@given(homogeneous_triangles())
def test_exact_values_are_the_determinants(case) -> None:
    clip, size = case
    edges = edges_of(clip, size, "exact")
    for t, triangle in enumerate(clip):
        rows = [homogeneous_window(corner, size) for corner in triangle]
        area = determinant(*rows)
        assert edges.doubled_area[t] == float(area)
        turn = (area > 0) - (area < 0)
        for k in range(3):
            pixel = (Fraction(3, 2), Fraction(5, 2), Fraction(1))
            value = edges.a[t, k] * 3 + (edges.b[t, k] * 5 + edges.c[t, k])
            shown = edges.numbers.shown_values(np.array([value], object))[0]
            assert shown == float(turn * determinant(rows[k - 2], rows[k - 1], pixel))


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1, max_size=6))
def test_floats_are_whole_numbers_of_a_small_enough_unit(values: list[float]) -> None:
    numbers = np.array(values)
    shift = unit_shift(numbers)
    for value, whole in zip(values, whole_numbers(numbers, shift), strict=True):
        assert Fraction(whole) == Fraction(value) * 2**shift
        assert nearest_float(whole, -shift) == value


def test_a_whole_number_too_small_for_a_float_is_not_shown_as_zero() -> None:
    assert nearest_float(1, -5000) > 0
    assert nearest_float(-1, -5000) < 0
    assert nearest_float(-1, 5000) == -np.inf
    assert nearest_float(0, -5000) == 0


# Whole numbers.


@given(ANY_TRIANGLES, st.sampled_from(RULES), st.sampled_from(["bounding-box", "blocks", "incremental"]))
def test_int64_is_snapped_where_all_corners_are(case, rule: str, fill: str) -> None:
    clip, size = case
    edges = edges_of(clip, size)
    clip = clip[edges.corners.is_projected.all(axis=1)]
    if len(clip):
        drawn = cover_each(clip, size, fill, coverage="int64", fill_rule=rule)
        assert np.array_equal(drawn, cover_each(clip, size, fill, fill_rule=rule))


@given(grid_triangles(), st.sampled_from(RULES))
def test_fixed_point_is_snapped_as_long_as_values_fit(case, rule: str) -> None:
    clip, size = case
    edges = edges_of(clip, size)
    place = np.concatenate(
        [edges.corners.decided, np.broadcast_to([[[0, 0]], [size]], (2, 1, 2)).repeat(3, 1)]
    )
    near = np.array(
        [np.ptp(np.concatenate([place[t], [[0, 0], size]]), axis=0).max() < 128 for t in range(len(edges))]
    )
    clip = clip[near & edges.corners.is_projected.all(axis=1)]
    if len(clip):
        drawn = cover_each(clip, size, FILL, coverage="fixed-24.8", fill_rule=rule)
        assert np.array_equal(drawn, cover_each(clip, size, FILL, fill_rule=rule))


def test_fixed_point_wraps_around_in_a_triangle_of_200_pixels() -> None:
    size = (200, 200)
    clip = clip_of_window([[(0, 0), (200, 0), (0, 200)]], size)
    raster, found = make_raster(size, "half"), {}
    for name in ("snapped", "fixed-24.8"):
        edges = edges_of(clip, size, name)
        found[name] = edges, examine_pixels(edges, runs_of(edges, raster, FILL), raster)
    (_, right), (edges, wrapped) = found.values()
    assert (right.covered & ~wrapped.covered).any()
    assert (wrapped.covered & ~right.covered).any()
    # What wraps forgets whole multiples of 2^16 square pixels; and the area, 40,000, comes out as -25,536.
    assert edges.doubled_area[0] == 200 * 200 - 2**16
    assert np.array_equal(-wrapped.values % 2**16, right.values % 2**16)


@pytest.mark.parametrize(
    ("reach", "is_right"), [(2.0**21, True), (4_000_000, True), (10_066_330, False), (110_000_000, False)]
)
def test_int64_is_right_up_to_millions_of_pixels_and_then_wraps(reach: float, is_right: bool) -> None:
    # The hypotenuse runs through the middle of the raster; all coordinates are whole pixels.
    size = (8, 8)
    clip = clip_of_window([[(-reach, 8 + reach), (-reach, -reach), (8 + reach, -reach)]], size)
    drawn = cover_each(clip, size, FILL, coverage="int64") > 0
    assert np.array_equal(drawn, exact_each(clip, size)) == is_right


@pytest.mark.parametrize("name", ["fixed-24.8", "int64"])
def test_a_corner_that_whole_numbers_do_not_have_is_not_drawn(name: str) -> None:
    clip = np.array(
        [[[-1, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, -1]], [[-1, -1, 0, 1], [1, -1, 0, 1], [0, 1e17, 0, 1]]]
    )
    assert not cover_each(clip, (8, 8), "brute-force", coverage=name).any()


# Rounding.


@pytest.mark.parametrize("name", ["float32", "float16", "inverse"])
def test_formats_that_round_miss_pixels_of_rational_coverage(name: str) -> None:
    size = (40, 30)
    generator = np.random.default_rng(11)
    rim = [tuple(point) for point in generator.integers(-20, 60, (12, 2)) + 0.5]
    clip = clip_of_window(fan((20.5, 15.5), rim), size, generator.choice([0.7, 1.1, 3.3], (12, 3)))
    wrong = (cover_each(clip, size, FILL, coverage=name) > 0) != exact_each(clip, size)
    assert wrong.any(), text(wrong.any(axis=0))


@pytest.mark.parametrize("name", ["float32", "float16", "inverse"])
def test_formats_that_round_break_shared_edges(name: str) -> None:
    size = (16, 16)
    generator = np.random.default_rng(5)
    broken = 0
    for _ in range(60):
        rim = generator.uniform(-30, 46, (7, 2))
        rim = rim[np.argsort(np.arctan2(rim[:, 1] - 8.3, rim[:, 0] - 8.1))]
        hub = (8.5, 8.5)
        clip = clip_of_window(fan(hub, [tuple(point) for point in rim]), size)
        count = cover_each(clip, size, FILL, coverage=name)
        right = cover_each(clip, size, FILL, coverage="exact")
        broken += int((count.sum(axis=0) != right.sum(axis=0)).sum())
    assert broken > 0


def test_float16_overflows_to_what_ieee_says() -> None:
    # 2000 x 2000 is beyond 65,504: c is the difference of infinities, no number, and nothing is inside.
    size = (4096, 8)
    clip = clip_of_window([[(-2000, -2000), (4000, -2000), (-2000, 3000)]], size)
    edges = edges_of(clip, size, "float16")
    assert not np.isfinite(edges.c.astype(float)).all()
    assert not cover_each(clip, size, FILL, coverage="float16").any()
    assert cover_each(clip, size, FILL, coverage="float32").any()


@given(ANY_TRIANGLES, st.sampled_from(FORMATS), st.sampled_from(RULES))
def test_every_format_has_numbers_of_its_own_type(case, name: str, rule: str) -> None:
    clip, size = case
    edges, raster = edges_of(clip, size, name, rule), make_raster(size, "half")
    kinds = {
        "float32": np.float32,
        "float16": np.float16,
        "fixed-24.8": np.int32,
        "int64": np.int64,
        "exact": object,
    }
    for numbers in (edges.a, edges.b, edges.c):
        assert numbers.dtype == kinds.get(name, np.float64)
    tests = examine_pixels(edges, runs_of(edges, raster, FILL), raster)
    assert tests.values.dtype == np.float64
    if rule != "shared-edge":
        assert (edges.owns_tie == (rule == "inclusive")).all()


@given(
    ANY_TRIANGLES,
    st.sampled_from(FORMATS),
    st.sampled_from(RULES),
    st.sampled_from(["brute-force", "bounding-box", "blocks", "incremental"]),
)
def test_picture_and_trace_decide_alike_in_every_format(case, name: str, rule: str, fill: str) -> None:
    clip, size = case
    edges, raster = edges_of(clip, size, name, rule), make_raster(size, "half")
    runs = runs_of(edges, raster, fill, 2)
    tests = examine_pixels(edges, runs, raster)
    wanted = np.zeros((len(edges), size[1], size[0]), int)
    np.add.at(
        wanted, (tests.primitive[tests.covered], tests.row[tests.covered], tests.column[tests.covered]), 1
    )
    assert np.array_equal(cover_each(clip, size, fill, coverage=name, fill_rule=rule, block_size=2), wanted)


@given(ANY_TRIANGLES, st.sampled_from(UNSNAPPED))
def test_boxes_of_corners_that_are_not_snapped_hold_the_triangle(case, name: str) -> None:
    clip, size = case
    edges, raster = edges_of(clip, size, name), make_raster(size, "half")
    boxes = bound(edges, raster)
    for t, covered in enumerate(exact_each(clip, size)):
        row, column = np.nonzero(covered)
        if edges.doubled_area[t] != 0 and len(row):
            assert boxes.column[t] <= column.min()
            assert column.max() < boxes.column_end[t]
            assert boxes.row[t] <= row.min()
            assert row.max() < boxes.row_end[t]


# The inverse.


def test_the_inverse_of_a_matrix_without_one_draws_nothing() -> None:
    clip = clip_of_window([[(1, 1), (3, 3), (6, 6)], [(0, 0), (4, 0), (8, 0)]], (8, 8))
    assert (edges_of(clip, (8, 8), "inverse").doubled_area == 0).all()
    assert not cover_each(clip, (8, 8), "brute-force", coverage="inverse", fill_rule="inclusive").any()


def test_inverse_of_a_well_behaved_matrix() -> None:
    matrix = np.array([[[2.0, 0, 0], [0, 0, 4], [1, 5, 0]]])
    inverse, area = invert(matrix)
    assert np.allclose(inverse[0] @ matrix[0], np.eye(3))
    assert area[0] == pytest.approx(np.linalg.det(matrix[0]))


# Spans.


@pytest.mark.parametrize("name", FORMATS)
def test_spans_are_drawn_only_in_numbers_that_suit_them(name: str) -> None:
    suits = name in ("snapped", "float64")
    for fill in table.names("fill"):
        wanted = "bounding-box" if fill in ("spans", "scanline") and not suits else fill
        assert effective_fill(fill, name) == wanted
