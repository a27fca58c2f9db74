import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from widgets.space.orbit import STEEPEST, Orbit, fitted, framed, framed_from_eye, panned, turned, zoomed

ANGLES = st.floats(-3.0, 3.0)
ORBITS = st.builds(
    Orbit,
    azimuth=ANGLES,
    elevation=st.floats(-1.5, 1.5),
    target=st.tuples(*[st.floats(-10, 10)] * 3),
    extent=st.floats(0.01, 100),
)


def seen(orbit: Orbit, point: np.ndarray, height: float) -> np.ndarray:
    return orbit.axes()[:2] @ (point - np.array(orbit.target)) * height / (2 * orbit.extent)


def test_at_rest_it_looks_along_minus_z():
    assert Orbit(0.0, 0.0).axes().tolist() == np.eye(3).tolist()
    assert np.allclose(Orbit(0.0, 0.0, extent=2.0).eye(np.pi / 2), [0, 0, 2])


@given(ORBITS)
def test_axes_are_orthonormal_and_right_handed(orbit):
    axes = orbit.axes()
    assert np.allclose(axes @ axes.T, np.eye(3))
    assert np.isclose(np.linalg.det(axes), 1.0)


@given(ORBITS, st.floats(-500, 500), st.floats(-500, 500))
def test_turning_stops_before_the_poles(orbit, right, down):
    assert abs(turned(orbit, right, down).elevation) <= STEEPEST


@given(ORBITS, st.floats(-100, 100), st.floats(-100, 100))
def test_panning_moves_the_space_with_the_pointer(orbit, right, down):
    point = np.array([1.0, 2.0, 3.0])
    moved = seen(panned(orbit, right, down, 400.0), point, 400.0) - seen(orbit, point, 400.0)
    assert np.allclose(moved, [right, -down], atol=1e-6 * (1 + 400 / orbit.extent))


@given(ORBITS, st.floats(0.2, 5.0), st.floats(-100, 100), st.floats(-100, 100))
def test_zooming_keeps_what_is_under_the_pointer(orbit, factor, right, down):
    axes = orbit.axes()
    point = np.array(orbit.target) + (right * axes[0] - down * axes[1]) * 2 * orbit.extent / 400
    assert np.allclose(
        seen(zoomed(orbit, factor, right, down, 400.0), point, 400.0), [right, -down], atol=1e-5
    )


def test_zooming_stays_finite():
    orbit = Orbit()
    for _ in range(500):
        orbit = zoomed(orbit, 10.0, 3.0, 4.0, 100.0)
    assert 0 < orbit.extent < 1e-5
    assert (orbit.eye(0.7) != np.array(orbit.target)).any()
    assert np.isfinite(orbit.target).all()


@given(ORBITS, st.floats(0.3, 3.0))
def test_framed_points_fill_the_view_and_stay_inside(orbit, aspect):
    points = np.array([[0.0, 0, 0], [3, 0, 1], [1, 2, -1], [np.nan, 0, 0]])
    placed = np.stack([seen(framed(orbit, points, aspect, 1.0), point, 2.0) for point in points[:3]])
    inside = np.abs(placed) / [aspect, 1.0]
    assert inside.max() <= 1 + 1e-9
    assert np.isclose(inside.max(), 1.0)


@given(ORBITS, st.floats(0.3, 3.0))
def test_points_framed_in_perspective_fill_the_view_and_stay_inside(orbit, aspect):
    points = np.array([[0.0, 0, 0], [3, 0, 1], [1, 2, -1], [np.nan, 0, 0]])
    framed = framed_from_eye(orbit, points, 0.7, aspect, 1.0)
    assert (framed.azimuth, framed.elevation) == (orbit.azimuth, orbit.elevation)
    right, up, back = ((points[:3] - framed.eye(0.7)) @ framed.axes().T).T
    assert (back < 0).all()
    aside = np.abs([right / aspect, up]) / (-back * np.tan(0.35))
    assert aside.max() <= 1 + 1e-6
    assert np.isclose(aside.max(), 1.0, atol=1e-6)


def test_fitting_a_radius_that_is_not_finite_shows_something():
    assert fitted(Orbit(), (0.0, 0.0, 0.0), float("nan")).extent > 0
    assert fitted(Orbit(target=(1.0, 1.0, 1.0)), (np.nan, 0.0, 0.0), 2.0).target == (1.0, 1.0, 1.0)
