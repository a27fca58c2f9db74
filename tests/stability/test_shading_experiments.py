"""Highlights between vertices, and normals without a direction."""

import numpy as np
import pytest

from core.pipeline import render
from core.settings import Settings
from core.shading.measured import MATERIAL, flattened_tube, turned_normals
from core.study.record import Outcome
from core.study.stability import experiments
from tests.covering import every_nth
from tests.stability.tube import evenly_lit

HIGHLIGHT = experiments.get("lost-highlight")
NORMALS = experiments.get("opposite-normals")


@pytest.mark.parametrize("shininess", [128.0, 300.0])
def test_gouraud_loses_what_lies_between_vertices(shininess: float) -> None:
    missing = [HIGHLIGHT.run("shading=gouraud", (8.0, shininess), seed).severity for seed in range(4)]
    assert max(missing) > 0.5
    for seed in range(4):
        assert HIGHLIGHT.run("shading=flat", (8.0, shininess), seed).outcome == Outcome.WRONG_PICTURE
        assert HIGHLIGHT.run("shading=gouraud", (4.0, shininess), seed).outcome == Outcome.WRONG_PICTURE


@pytest.mark.parametrize("seed", range(3))
def test_phong_keeps_the_highlight(seed: int) -> None:
    source = np.random.default_rng(seed)
    for rings in (4, 7, 16):
        place = (float(rings), float(np.exp(source.uniform(np.log(4), np.log(512)))))
        verdict = HIGHLIGHT.run("shading=phong", place, seed)
        assert verdict.outcome == Outcome.RIGHT
        assert verdict.severity <= 0.1


def test_matte_spheres_suit_gouraud() -> None:
    assert HIGHLIGHT.run("shading=gouraud", (24.0, 4.0), 0).outcome == Outcome.RIGHT


def test_opposite_normals_have_no_direction_in_the_middle() -> None:
    color = render(flattened_tube(180.0, 1), Settings(shading="phong")).color[..., :3]
    assert np.isfinite(color).all()
    left, right = color[1, 0], color[1, -1]
    # A step: the left half is lit as the left end, the right half as the right end.
    assert (color[1, :32] == left).all()
    assert (color[1, 33:] == right).all()
    # The light comes from the left; the other side, and the middle if its normal is 0, has ambient light only.
    assert left[0] > right[0]
    assert right == pytest.approx([MATERIAL.ambient] * 3)
    middle = color[1, 32]
    assert any(middle == pytest.approx(each, abs=1e-6) for each in (left, right))
    assert evenly_lit(180.0)[1, 32, 0] > 0.8


@pytest.mark.parametrize("angle", every_nth([100.0, 133.0, 170.0, 179.9, 180.0], 3))
def test_one_part_is_wrong_and_three_are_right_for_phong(angle: float) -> None:
    for method in ("shading=flat", "shading=gouraud", "shading=phong"):
        assert NORMALS.run(method, (angle, 1.0), 0).outcome == Outcome.WRONG_PICTURE
    for parts in (3.0, 5.0, 7.0, 32.0):
        assert NORMALS.run("shading=phong", (angle, parts), 0).outcome == Outcome.RIGHT
    for parts in (16.0, 23.0):
        assert NORMALS.run("shading=gouraud", (angle, parts), 0).outcome == Outcome.RIGHT


def test_level_normals_are_right_for_all() -> None:
    for method in ("shading=flat", "shading=gouraud", "shading=phong"):
        assert NORMALS.run(method, (0.0, 1.0), 0).outcome == Outcome.RIGHT


def test_quarter_turns_are_exactly_opposite() -> None:
    assert np.array_equal(turned_normals(np.array([0.0, 1.0]), 180.0), [[-1, 0, 0], [1, 0, 0]])
