"""Barycentric coordinates three ways: within their rounding errors of fractions, and so of each other."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from core import ClipScene, Settings, render, trace
from core.interpolation.barycentric import NO_AREA, WAYS
from core.interpolation.interpolation import FEW_PRIMITIVES, Interpolator, interpolate, set_up_planes
from core.methods import table
from lessons.lectures.scenes import ALL_SCENES
from tests.core.strategies import clip_of_window

UNIT = 2.0**-53
PLACES = st.one_of(
    st.floats(-64, 64), st.integers(-20, 20).map(float), st.floats(-1, 1).map(lambda part: 4000 + part)
)
POINTS = st.tuples(PLACES, PLACES)
SLIVER = ((0.1, 0.1), (30.3, 20.2), (15.7, 10.5))
FAR = ((4000.1, 4000.2), (4000.9, 4000.3), (4000.4, 4000.7))


def exact_weights(corners, x: float, y: float) -> list[Fraction] | None:
    """Return the weights as the solution of the two equations in fractions; ``None`` where there is none."""
    (x0, y0), (x1, y1), (x2, y2) = [tuple(map(Fraction, corner)) for corner in corners]
    a, b, c, d = x1 - x0, x2 - x0, y1 - y0, y2 - y0
    if a * d == b * c:
        return None
    u, v = Fraction(x) - x0, Fraction(y) - y0
    first, second = (u * d - b * v) / (a * d - b * c), (a * v - c * u) / (a * d - b * c)
    return [1 - first - second, first, second]


def bounds(corners, x: float, y: float, exact: list[Fraction]) -> dict[str, float]:
    """Return how far each way may be off: its rounding errors, one unit for each operation, to first order."""
    p, size = np.array(corners), [abs(float(weight)) for weight in exact]
    sides = np.array([p[1] - p[0], p[2] - p[0]]).T
    condition = np.linalg.norm(np.linalg.inv(sides), np.inf) * np.linalg.norm(sides, np.inf)

    def area_terms(q, r, s) -> float:
        return abs((r - q)[0] * (s - q)[1]) + abs((s - q)[0] * (r - q)[1])

    def line_terms(q, r, at) -> float:
        parts = abs(q[0] * r[1]) + abs(r[0] * q[1])
        return abs((q - r)[1] * at[0]) + abs((r - q)[0] * at[1]) + parts

    area, point = abs(np.linalg.det(sides)), np.array([x, y])
    of_areas, of_distances = [], []
    for k in range(3):
        q, r = p[k - 2], p[k - 1]
        of_areas.append(4 * (area_terms(point, q, r) + size[k] * area_terms(*p)) / area + size[k])
        of_distances.append(5 * (line_terms(q, r, point) + size[k] * line_terms(q, r, p[k])) / area + size[k])
    return {
        "affine-equations": 1.01 * UNIT * 16 * condition * (1 + max(size)),
        "affine-areas": 1.01 * UNIT * max(of_areas),
        "affine-distances": 1.01 * UNIT * max(of_distances),
    }


def weights_by(way: str, corners, x: float, y: float) -> np.ndarray:
    corner = np.array(corners)[..., None]
    return WAYS[way](corner, np.array([x]), np.array([y]))["weights"][0]


@given(st.tuples(POINTS, POINTS, POINTS), POINTS)
@example(SLIVER, (15.5, 10.5))
@example(FAR, (4000.5, 4000.5))
def test_the_three_ways_are_exact_within_their_rounding_errors(corners, point) -> None:
    exact = exact_weights(corners, *point)
    sides = np.array(corners)[1:] - np.array(corners)[0]
    assume(exact is not None and abs(np.linalg.det(sides)) > 1e-6)
    allowed = bounds(corners, *point, exact)
    assume(max(allowed.values()) < 1e-3)
    for way, bound in allowed.items():
        found = weights_by(way, corners, *point)
        assert max(abs(Fraction(value) - wanted) for value, wanted in zip(found, exact, strict=True)) <= bound


def test_far_from_the_origin_distances_lose_digits_that_areas_keep() -> None:
    exact = exact_weights(FAR, 4000.5, 4000.5)
    error = {
        way: max(
            abs(float(Fraction(v) - w))
            for v, w in zip(weights_by(way, FAR, 4000.5, 4000.5), exact, strict=True)
        )
        for way in WAYS
    }
    assert error["affine-areas"] < 1e-15
    assert error["affine-equations"] < 1e-15
    assert error["affine-distances"] > 1e-10


@pytest.mark.parametrize("way", WAYS)
def test_jubairs_practice_problem(way: str) -> None:
    # P lies inside, Q outside of the triangle of the slides' example.
    corners = ((0.0, 0.0), (8.0, 0.0), (0.0, 4.0))
    assert weights_by(way, corners, 2.0, 1.0).tolist() == [0.5, 0.25, 0.25]
    assert weights_by(way, corners, 6.0, 3.0).tolist() == [-0.5, 0.75, 0.75]


@pytest.mark.parametrize("way", WAYS)
def test_the_picture_is_that_of_affine_interpolation(way: str) -> None:
    scene = ALL_SCENES["jubair-triangle"].make()
    wanted, found = (render(scene, Settings(interpolation=name)) for name in ("affine", way))
    assert np.array_equal(found.primitive, wanted.primitive)
    assert np.abs(found.color - wanted.color).max() <= 2.0**-24


@pytest.mark.parametrize("way", WAYS)
def test_corners_on_a_line_count_a_third_each(way: str) -> None:
    # Its corners lie on a line before snapping, and beside it afterwards.
    corners = np.array([[(5434, 4434), (5664, 3453), (6124, 1491)]]) / 1024
    scene = ClipScene(clip_of_window(corners, (8, 8)), np.eye(3)[None], (8, 8))
    found = trace(scene, Settings(interpolation=way)).stage("interpolate")
    assert [found.steps.kinds[kind] for kind in found.steps.kind] == [NO_AREA]
    assert found.columns["weights"].tolist() == [[1 / 3] * 3]


@pytest.mark.parametrize("way", WAYS)
def test_among_many_primitives_each_fragment_keeps_its_own_corners(way: str) -> None:
    rng = np.random.default_rng(5)
    count = FEW_PRIMITIVES + 8
    homogeneous = np.concatenate(
        [rng.uniform(0, 9, (count, 3, 2)), rng.uniform(0.5, 2, (count, 3, 1))], axis=2
    )
    planes, values = set_up_planes(homogeneous), rng.uniform(size=(count, 3, 2))
    chosen, x, y = np.array([count - 1, 7, 7, 500]), rng.uniform(0, 9, 4), rng.uniform(0, 9, 4)
    together = Interpolator(planes, values, table.get("interpolation", way).function, 2).weighted(
        chosen, x, y
    )
    for n, primitive in enumerate(chosen):
        one = slice(primitive, primitive + 1)
        alone = interpolate(
            set_up_planes(homogeneous[one]),
            values[one],
            np.zeros(1, np.int64),
            x[n : n + 1],
            y[n : n + 1],
            way,
            "last",
        )
        assert np.array_equal(together[0][n], alone[0][0])
        assert np.array_equal(together[1][n], alone[1][0])
