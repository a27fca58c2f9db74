import numpy as np
import pytest

from widgets.space.orbit import Orbit, ViewDepth, refocused, turned, zoomed

ANGLE = 0.7
ORBIT = Orbit(0.3, 0.2, (1.0, 2.0, -3.0), 4.0)


def distance_of(orbit: Orbit) -> float:
    """Return how far the target is from the eye."""
    return float(np.linalg.norm(orbit.eye(ANGLE) - orbit.target))


def test_another_focus_keeps_the_eye_and_the_direction():
    orbit = refocused(ORBIT, 2.5, ANGLE)
    assert orbit.eye(ANGLE) == pytest.approx(ORBIT.eye(ANGLE))
    assert (orbit.azimuth, orbit.elevation) == (ORBIT.azimuth, ORBIT.elevation)
    assert distance_of(orbit) == pytest.approx(2.5)


@pytest.mark.parametrize("distance", [0.0, -1.0, np.nan, np.inf, 1e-14, 1e300])
def test_a_distance_of_no_use_changes_nothing(distance):
    assert refocused(ORBIT, distance, ANGLE) == ORBIT


def test_the_target_goes_as_far_as_what_is_seen_at_a_place():
    sight = ViewDepth(ORBIT, ANGLE, np.array([[2.0, 20.0], [np.nan, 5.0]]))
    assert distance_of(sight.focused(ORBIT, 0.4, 0.1)) == pytest.approx(2.0)
    assert distance_of(sight.focused(ORBIT, 0.9, 0.1)) == pytest.approx(20.0)
    assert distance_of(sight.focused(ORBIT, 0.9, 0.9)) == pytest.approx(5.0)
    assert sight.focused(ORBIT, 0.4, 0.9) == ORBIT
    assert sight.focused(ORBIT, 1.0, 0.1) == ORBIT
    assert sight.focused(ORBIT, 0.4, -0.1) == ORBIT


def test_an_older_picture_tells_distances_from_where_the_eye_is_now():
    sight = ViewDepth(ORBIT, ANGLE, np.full((1, 1), 15.0))
    nearer = zoomed(ORBIT, 1.2, 0, 0, 100)
    gone = distance_of(ORBIT) - distance_of(nearer)
    assert distance_of(sight.focused(nearer, 0.5, 0.5)) == pytest.approx(15.0 - gone)
    elsewhere = turned(ORBIT, 10, 0)
    assert sight.focused(elsewhere, 0.5, 0.5) == elsewhere


def test_distances_are_a_grid():
    with pytest.raises(ValueError, match=r"distance must be \(R, C\)"):
        ViewDepth(ORBIT, ANGLE, np.zeros(3))


def test_what_is_seen_is_covered_row_by_row():
    empty, seen = np.nan, 3.0
    sight = ViewDepth(
        ORBIT, ANGLE, np.array([[empty] * 4, [empty, seen, empty, seen], [seen, empty, empty, empty]])
    )
    assert sight.covered == [(0.25, 1 / 3, 1.0, 2 / 3), (0.0, 2 / 3, 0.25, 1.0)]
