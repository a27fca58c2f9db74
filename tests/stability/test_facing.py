"""Culling beside the centre: the camera's direction is no vector to the face."""

from core.study.record import Outcome
from core.study.stability import experiments
from tests.stability.maps import is_right_everywhere, outcomes


def test_only_the_direction_of_the_camera_loses_fronts() -> None:
    for method in experiments.get("facing-off-axis").info.methods[1:]:
        assert is_right_everywhere("facing-off-axis", method, every=2)
    found = outcomes("facing-off-axis", "cull=back-axis", every=2)
    assert all((outcome == Outcome.HOLE) == (0 < tilt < angle) for (angle, tilt), outcome in found.items())
