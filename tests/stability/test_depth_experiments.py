"""Z-fighting: where each depth format fails by its spacing, and that the others hold there."""

from math import log

import numpy as np
import pytest

from core.depth.measured import FAR, facing_walls, orthographic_walls
from core.pipeline import render
from core.settings import Settings
from core.study.record import Outcome
from core.study.stability import experiments
from tests.covering import every_nth

BY_DISTANCE = experiments.get("z-fighting-distance")
BY_RANGE = experiments.get("z-fighting-range")
ORTHOGRAPHIC = experiments.get("orthographic-depth")
SQUARE = {
    "depth=z-16": (2.0**-16, 2.0**-18),
    "depth=z-24": (2.0**-24, 2.0**-26),
    "depth=z-float32": (2.0**-24, 2.0**-26),
    # Rounded slopes over up to 64 pixels, rather than the step of 2^-38, decide.
    "depth=fixed-38": (2.0**-31, 2.0**-42),
}
"""The gap that is surely enough, and one that is not, over the square of the distance."""
LINEAR = {"depth=inverse-w": 2.0**-23, "depth=reversed-z": 2.0**-23, "depth=logarithmic": log(FAR) * 2.0**-24}
"""The largest step, as a part of the distance."""
SOURCE = np.random.default_rng(11)
DISTANCES = [float(value) for value in np.exp(SOURCE.uniform(np.log(10), np.log(1e4), 4))]
SURE = 1.3
"""The walls lean by up to a fifth."""


@pytest.mark.parametrize("distance", every_nth(DISTANCES, 4))
@pytest.mark.parametrize("method", SQUARE)
def test_z_needs_a_gap_that_grows_with_the_square_of_the_distance(method: str, distance: float) -> None:
    enough, too_small = (share * distance**2 for share in SQUARE[method])
    if SURE * enough < distance / 2:
        assert BY_DISTANCE.run(method, (distance, SURE * enough), 1).outcome == Outcome.RIGHT
    failed = BY_DISTANCE.run(method, (distance, min(too_small, distance / 2)), 1)
    assert failed.outcome == Outcome.WRONG_ORDER
    assert failed.severity > 0


@pytest.mark.parametrize("distance", DISTANCES)
@pytest.mark.parametrize("method", LINEAR)
def test_others_need_a_gap_that_grows_with_the_distance(method: str, distance: float) -> None:
    gap = SURE * LINEAR[method] * distance
    assert BY_DISTANCE.run(method, (distance, gap), 1).outcome == Outcome.RIGHT
    assert BY_DISTANCE.run(method, (distance, gap / 64), 1).outcome == Outcome.WRONG_ORDER


def test_far_away_they_hold_where_z_fails() -> None:
    place = (5000.0, 0.05)
    for method in ("depth=z-16", "depth=z-24", "depth=z-float32"):
        assert BY_DISTANCE.run(method, place, 1).outcome == Outcome.WRONG_ORDER
    for method in LINEAR:
        assert BY_DISTANCE.run(method, place, 1).outcome == Outcome.RIGHT


@pytest.mark.parametrize("distance", DISTANCES)
def test_ray_casting_needs_none(distance: float) -> None:
    settings = Settings(visibility="ray-casting", shading="unlit")
    for gap in (2.0**-36 * distance, 2.0**-28 * distance, 0.1 * distance):
        # The nearer wall is the triangles 1 and 2.
        frame = render(facing_walls(distance, gap, 0.15), settings)
        assert set(np.unique(frame.primitive)) == {1, 2}
    frame = render(orthographic_walls(0.3, 2.0**-40, 0.15), settings)
    assert set(np.unique(frame.primitive)) == {1, 2}


@pytest.mark.parametrize("gap", every_nth([1e-6, 3e-6, 1e-4], 4))
@pytest.mark.parametrize("method", [*LINEAR, "depth=fixed-38", "visibility=ray-casting"])
def test_formats_of_the_distance_hold_at_any_range(method: str, gap: float) -> None:
    for far in (10.0, 777.0, 1e6):
        assert BY_RANGE.run(method, (far, gap), 0).outcome == Outcome.RIGHT


def test_z_loses_pixels_as_the_range_grows() -> None:
    for method, far, gap in (
        ("depth=z-16", 1e4, 1e-2),
        ("depth=z-16", 1e3, 1e-3),
        ("depth=z-24", 1e6, 1e-3),
        ("depth=z-24", 1e4, 1e-4),
        ("depth=z-float32", 1e6, 1e-3),
        ("depth=z-float32", 1e4, 1e-4),
    ):
        assert BY_RANGE.run(method, (10.0, gap), 0).outcome == Outcome.RIGHT
        assert BY_RANGE.run(method, (far, gap), 0).outcome == Outcome.WRONG_ORDER


@pytest.mark.parametrize("seed", every_nth(range(2), 3))
@pytest.mark.parametrize("distance", [0.013, 0.4, 0.79])
def test_without_perspective_every_format_has_its_step(distance: float, seed: int) -> None:
    for method, step in (
        ("depth=z-16", 2.0**-16),
        ("depth=z-24", 2.0**-24),
        ("depth=z-float32", 2.0**-24),
        ("depth=reversed-z", 2.0**-24),
    ):
        assert ORTHOGRAPHIC.run(method, (distance, SURE * step), seed).outcome == Outcome.RIGHT
        # Float32 is finer where numbers are small: near the eye.
        too_small = step / 64 * (distance if method == "depth=z-float32" else 1)
        assert ORTHOGRAPHIC.run(method, (distance, too_small), seed).outcome == Outcome.WRONG_ORDER
    for method in ("depth=fixed-38", "visibility=ray-casting"):
        assert ORTHOGRAPHIC.run(method, (distance, 2.0**-30), seed).outcome == Outcome.RIGHT


@pytest.mark.parametrize("method", ["depth=inverse-w", "depth=logarithmic"])
def test_without_perspective_w_says_nothing(method: str) -> None:
    verdict = ORTHOGRAPHIC.run(method, (0.3, 0.01), 0)
    assert verdict.outcome == Outcome.REFUSED
    assert "needs a perspective camera" in verdict.remark
    assert ORTHOGRAPHIC.opening(method, (0.3, 0.01), 0) is None
