"""Shared edges: which fill rules and number formats leave cracks or draw twice, and which draw every pixel once."""

import numpy as np
import pytest

from core import ClipScene, Settings
from core.coverage.measured_cover import count_cover
from core.coverage.measured_triangles import SIDE, scene_of_window, through_the_eye, uneven_grid
from core.records.arrays import Integers
from core.study.family import settings_of
from core.study.record import Outcome
from core.study.stability import experiments
from core.study.workloads import on_grid, random_source
from tests.stability.maps import is_right_everywhere, outcomes, wrong_at_random

PLAIN = Settings(fill="bounding-box")


def fan(spokes: int, steps: int, seed: int) -> ClipScene:
    """Return triangles around one corner in the middle, on a pixel centre if ``steps`` is even."""
    turn = (np.arange(spokes) + random_source(seed).uniform(-0.3, 0.3, spokes)) * (2 * np.pi / spokes)
    middle = np.array([SIDE / 2, SIDE / 2]) + np.floor(steps / 2) / steps
    rim = on_grid(middle + 2 * SIDE * np.stack([np.cos(turn), np.sin(turn)], axis=1), steps)
    corners = np.stack([np.broadcast_to(middle, rim.shape), rim, np.roll(rim, -1, axis=0)], axis=1)
    return scene_of_window(corners, (SIDE, SIDE))


MESHES = {
    "grid on pixel centres": lambda seed: uneven_grid(8, 2, seed),
    "grid between them": lambda seed: uneven_grid(8, 1024, seed),
    "fan on a pixel centre": lambda seed: fan(24, 2, seed),
    "plane through the eye": lambda seed: through_the_eye(0.5, 8, seed),
}
"""Meshes whose triangles cover every pixel of the window exactly once, for a seed."""


def audit(mesh: str, settings: Settings, seed: int = 0) -> Integers:
    """Return how often a mesh covers each pixel: 0 is a crack, 1 is right, 2 is a double hit."""
    return count_cover(MESHES[mesh](seed), settings)[0]


def test_exclusive_edges_leave_cracks_and_inclusive_ones_are_drawn_twice() -> None:
    for mesh in ("grid on pixel centres", "fan on a pixel centre"):
        exclusive = audit(mesh, settings_of(PLAIN, "fill_rule=exclusive"))
        inclusive = audit(mesh, settings_of(PLAIN, "fill_rule=inclusive"))
        assert exclusive.min() == 0
        assert exclusive.max() == 1
        assert inclusive.min() == 1
        assert inclusive.max() > 1
        # The very pixels that one rule leaves out are those that the other draws too often.
        assert ((exclusive == 0) == (inclusive > 1)).all()


@pytest.mark.parametrize("mesh", MESHES)
@pytest.mark.parametrize("method", ["fill_rule=shared-edge", "coverage=exact", "fill=spans"])
def test_the_shared_edge_rule_draws_every_pixel_once(mesh: str, method: str) -> None:
    for seed in range(3):
        assert (audit(mesh, settings_of(PLAIN, method), seed) == 1).all()


def test_the_printed_scanline_fill_draws_shared_edges_twice() -> None:
    assert set(outcomes("shared-edges", "fill=scanline-lecture", every=2).values()) == {Outcome.DOUBLE_HIT}


def test_ties_make_the_difference() -> None:
    found = outcomes("shared-edges", "fill_rule=inclusive")
    assert all(outcome == Outcome.DOUBLE_HIT for (steps, _), outcome in found.items() if steps <= 4)
    assert all(
        outcome == Outcome.RIGHT for (steps, cells), outcome in found.items() if steps > 64 and cells < 16
    )


def test_the_inverse_divides_a_shared_edge_apart() -> None:
    found = outcomes("shared-edges", "coverage=inverse")
    assert {Outcome.HOLE, Outcome.DOUBLE_HIT} <= set(found.values())


@pytest.mark.parametrize(
    "method", ["coverage=float64", "fill_rule=shared-edge", "fill=spans", "coverage=exact"]
)
def test_edges_with_one_value_hold(method: str) -> None:
    assert is_right_everywhere("shared-edges", method, every=3)


@pytest.mark.slow
def test_projecting_first_draws_the_wrong_part_of_a_mesh_behind_the_eye() -> None:
    for method in ("clipping=project-first", "clipping=after-divide"):
        found = outcomes("mesh-through-the-eye", method)
        assert all(outcome == Outcome.RIGHT for (tilt, _), outcome in found.items() if tilt <= 0.2)
        assert sum(outcome != Outcome.RIGHT for outcome in found.values()) > 10


@pytest.mark.parametrize(
    "method", ["clipping=sutherland-hodgman", "clipping=homogeneous", "coverage=float64", "coverage=exact"]
)
def test_meshes_through_the_eye_have_no_gaps(method: str) -> None:
    assert is_right_everywhere("mesh-through-the-eye", method, every=3)
    assert wrong_at_random("mesh-through-the-eye", method, 6) == []


def test_an_audit_counts_every_triangle() -> None:
    cover = audit("fan on a pixel centre", settings_of(PLAIN, "fill_rule=inclusive"))
    # All spokes meet in the centre of one pixel.
    assert cover.max() == 24
    assert np.count_nonzero(cover == 24) == 1


def test_a_seed_makes_another_mesh() -> None:
    experiment = experiments.get("shared-edges")
    first = experiment.opening("fill=spans", (4.0, 8.0), 0)
    other = experiment.opening("fill=spans", (4.0, 8.0), 1)
    assert (first.scene.clip != other.scene.clip).any()
