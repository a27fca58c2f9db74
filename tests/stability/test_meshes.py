"""Shared edges: which fill rules and number formats leave cracks or draw twice, and which draw every pixel once."""

import numpy as np
import pytest

from core import Settings
from core.study.accuracy.family import settings_of
from core.study.stability import Outcome, experiments
from core.study.stability.coverage.meshes import MESHES, audit
from tests.stability.maps import is_right_everywhere, outcomes, wrong_at_random

PLAIN = Settings(fill="bounding-box")


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


def test_an_audit_names_its_meshes() -> None:
    with pytest.raises(ValueError, match="mesh must be one of grid on pixel centres"):
        audit("torus", PLAIN)


def test_a_seed_makes_another_mesh() -> None:
    experiment = experiments.get("shared-edges")
    first = experiment.opening("fill=spans", (4.0, 8.0), 0)
    other = experiment.opening("fill=spans", (4.0, 8.0), 1)
    assert (first.scene.clip != other.scene.clip).any()
