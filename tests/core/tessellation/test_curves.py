"""Bezier curves by exact arithmetic, and the deviation of their pieces by brute force."""

from fractions import Fraction
from math import comb

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Settings, render
from core.records.arrays import Floats
from core.records.curves import Curves
from core.scene import ClipScene
from core.stages.before_matrices import before_matrices, tessellated
from core.tessellation.bezier import de_casteljau, halves, levels, shares
from core.tessellation.segments import bound_of_segments
from lessons.curve_scenes import ARCH, arch, curve_in_depth, curve_scene

POINTS = st.lists(st.tuples(*[st.integers(-64, 64)] * 2), min_size=2, max_size=6)


def bernstein(points: list[tuple[int, int]], t: Fraction) -> tuple[Fraction, Fraction]:
    degree = len(points) - 1
    shares = [comb(degree, k) * t**k * (1 - t) ** (degree - k) for k in range(degree + 1)]
    return tuple(sum(s * p[k] for s, p in zip(shares, points, strict=True)) for k in (0, 1))  # type: ignore[return-value]


def point(points: list[tuple[int, int]], step: int, steps: int) -> Floats:
    return levels(*shares(np.array(step), np.array(steps)), np.array(points, float))[-1][0]


@given(POINTS, st.integers(1, 9), st.data())
def test_the_scheme_is_bernsteins_sum_and_its_listing(points, steps, data):
    step = data.draw(st.integers(0, steps))
    exact = bernstein(points, Fraction(step, steps))
    found = point(points, step, steps)
    assert np.allclose(found, np.array(exact, float), rtol=0, atol=1e-12)
    assert found.tolist() == [de_casteljau([float(p[k]) for p in points], step, steps) for k in (0, 1)]
    # Run backwards, and at both ends: the very same numbers.
    assert point(points[::-1], steps - step, steps).tolist() == found.tolist()
    assert point(points, 0, steps).tolist() == list(points[0])
    assert point(points, steps, steps).tolist() == list(points[-1])


def test_a_quarter_of_the_arch():
    assert bernstein([(2, 4), (10, 40), (50, 44), (60, 6)], Fraction(1, 4)) == (13.03125, 24.84375)
    assert point([(2, 4), (10, 40), (50, 44), (60, 6)], 1, 4).tolist() == [13.03125, 24.84375]


@given(POINTS, st.integers(0, 8))
def test_halves_are_the_same_curve(points, step):
    first, second = halves(np.array(points, float))
    at = point(points, step, 16)
    assert np.allclose(levels(*shares(np.array(step), np.array(8)), first)[-1][0], at, rtol=0, atol=1e-12)
    at = point(points, step + 8, 16)
    assert np.allclose(levels(*shares(np.array(step), np.array(8)), second)[-1][0], at, rtol=0, atol=1e-12)


def deviation(scene: ClipScene, settings: Settings) -> float:
    """Return how far points of the curve in the window are from its pieces, in pixels."""
    made = tessellated(scene, settings)
    size = np.array(scene.size)
    ends = (made.scene.clip[..., :2] / made.scene.clip[..., 3:] + 1) / 2 * size
    dense = levels(*shares(np.arange(4001), np.full(4001, 4000)), np.repeat(made.control[:1], 4001, axis=0))[
        -1
    ][:, 0]
    places = (dense[:, :2] / dense[:, 3:] + 1) / 2 * size
    nearest = np.full(len(places), np.inf)
    for a, b in ends:
        chord = b - a
        along = np.clip((places - a) @ chord / max(chord @ chord, 1e-300), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(places - a - along[:, None] * chord, axis=1))
    return float(nearest.max())


@pytest.mark.parametrize(
    ("tolerance", "count", "measured"), [(16, 7, 0.610), (8, 9, 0.370), (4, 13, 0.177)], ids=str
)
def test_the_catalogues_numbers(tolerance, count, measured):
    settings = Settings(tessellation="bound", curve_tolerance=tolerance)
    made = before_matrices(arch(), settings)
    assert len(made.clip) == count
    assert round(deviation(arch(), settings), 3) == measured
    assert bound_of_segments(6 * np.hypot(30, 42), 0.0, 30.0, 1.0, tolerance / 16) == count


CORNER = st.tuples(st.integers(0, 64), st.integers(0, 48), st.sampled_from((1, 1, 2, 5)))
CONTROL = st.lists(CORNER, min_size=4, max_size=4)


@pytest.mark.parametrize("method", ["bound", "adaptive"])
@given(control=CONTROL, tolerance=st.sampled_from((2, 8, 32)))
def test_no_curve_is_farther_than_the_tolerance(method, control, tolerance):
    places, w = np.array(control, float)[:, :2], np.array(control, float)[:, 2]
    if (places == places[0]).all() and (w == w[0]).all():
        return
    scene = curve_scene(places[None], (64, 48), w[None])
    assert deviation(scene, Settings(tessellation=method, curve_tolerance=tolerance)) <= tolerance / 16 + 1e-9


def test_a_curve_is_cut_before_w_divides():
    scene = curve_in_depth()
    divided = curve_scene(np.array([ARCH]), (64, 48))
    settings = Settings(segments=64)
    assert (render(scene, settings).primitive >= 0).sum() != (render(divided, settings).primitive >= 0).sum()
    # Their middles are 8 pixels apart and more, with the same control points in the window.
    middle = [levels(*shares(np.array(1), np.array(2)), s.curves.control[0])[-1][0] for s in (scene, divided)]
    one, other = ((p[:2] / p[3] + 1) / 2 * (64, 48) for p in middle)
    assert np.hypot(*(one - other)) > 8


def test_pieces_meet_and_ends_are_control_points():
    made = before_matrices(arch(), Settings(segments=5))
    assert (made.clip[1:, 0] == made.clip[:-1, 1]).all()
    assert len(np.unique(made.shared)) == 6
    assert (made.clip[[0, -1], [0, 1]] == arch().curves.control[0, [0, -1]]).all()
    # What is made is made once.
    assert before_matrices(made, Settings(segments=5)) is made


def test_behind_the_eye_the_bound_falls_back_and_halving_ends():
    control = np.array([[[-0.5, 0, 0, 1], [0, 1, 0, 1], [0.5, 1, 0, -1], [1, 0, 0, 2]]])
    scene = ClipScene(
        control[:, [0, 3]], size=(16, 12), kind="segments", curves=Curves(control, np.ones((1, 4)))
    )
    assert len(tessellated(scene, Settings(tessellation="bound", segments=3)).scene.clip) == 3
    assert 3 < len(tessellated(scene, Settings(tessellation="adaptive")).scene.clip) < 1024
    render(scene, Settings(tessellation="adaptive"))


@pytest.mark.parametrize(
    ("control", "wanted"),
    [
        ([[[0, 0, 0, 1]]], "a curve must have 2 to 9 control points, got 1"),
        ([[[0.5, 0, 0, 1]] * 4], r"curve 0 is one point: all its control points are \(0.5, 0, 0, 1\)"),
        ([[[0, 0, 0]] * 4], r"curves must be \(C, D \+ 1, 4\)"),
    ],
)
def test_a_curve_of_one_point_is_refused(control, wanted):
    with pytest.raises(ValueError, match=wanted):
        Curves(np.array(control, float), np.ones((1, 4)))


def test_too_many_segments_are_refused_with_what_they_would_take():
    with pytest.raises(
        ValueError, match=r"would make 100,000 segments, about 1.0 GiB; at most 20,000 are made"
    ):
        render(arch(), Settings(segments=100_000))
    with pytest.raises(ValueError, match="segments must be a whole number from 1 to 100000, got 0"):
        Settings(segments=0)
