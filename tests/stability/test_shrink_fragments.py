"""The shrinker on what pixels show: a few triangles on one or two pixels are left, and the test of them fails."""

import numpy as np
import pytest

from core import ClipScene, Settings
from core.antialiasing.measured import ThinCase, needle
from core.framebuffer.measured import LayersCase, layered_glass
from core.study.experiment import Experiment, in_clip_space
from core.study.fragment_cases import NearestCase
from core.study.record import Outcome
from core.study.stability import FRAGMENT_EXPERIMENTS, experiments
from core.study.workloads import flat_scene
from tests.covering import every_nth


@pytest.mark.parametrize(
    "experiment",
    every_nth([each for each in FRAGMENT_EXPERIMENTS if each.can_shrink], 3),
    ids=lambda each: each.name,
)
def test_the_truth_of_any_such_scene_is_that_of_the_cell(experiment: Experiment) -> None:
    place = tuple(axis.values[len(axis.values) // 2] for axis in experiment.info.axes)
    for method in experiment.info.methods:
        cell = experiment.run(method, place, 0)
        if cell.outcome != Outcome.REFUSED:
            assert experiment.judge(*experiment.case(method, place, 0)).outcome == cell.outcome, method


def test_of_triangles_that_are_as_near_either_may_be_seen() -> None:
    triangle = np.array([[-1.0, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]])
    level = flat_scene(np.stack([triangle, triangle]), (2, 2))
    last = Settings(visibility="last-drawn")
    assert NearestCase(level).run(last).verdict.outcome == Outcome.RIGHT
    behind = triangle + np.array([0, 0, 0.5, 0])
    assert NearestCase(flat_scene(np.stack([triangle, behind]), (2, 2))).run(last).wrong.all()


def test_of_formats_that_store_w_only_what_is_nearer_by_w_and_z_counts() -> None:
    near = np.array([[-2.0, -2, -1, 2], [6, -2, -1, 2], [-2, 6, -1, 2]])
    far = np.array([[-1.0, -1, 0.5, 1], [3, -1, 0.5, 1], [-1, 3, 0.5, 1]])
    scene = flat_scene(np.stack([near, far]), (1, 1))
    assert NearestCase(scene).run(Settings(depth="inverse-w")).verdict.outcome == Outcome.RIGHT
    assert NearestCase(scene).run(Settings(visibility="last-drawn")).wrong.all()


def test_layers_that_are_as_deep_have_no_right_colour() -> None:
    glass = layered_glass((0, 1), 0.5)
    clip = glass.clip.copy()
    clip[..., 2] = 0.0
    level = ClipScene(clip, glass.attributes, glass.size, background=glass.background)
    assert np.isnan(LayersCase(level).wanted(False)).all()


def test_layers_have_one_colour() -> None:
    glass = layered_glass((0, 1), 0.5)
    colors = glass.attributes.copy()
    colors[0, 1, 0] = 0.5
    with pytest.raises(ValueError, match="every triangle must have one colour"):
        LayersCase(ClipScene(glass.clip, colors, glass.size))


def test_triangles_that_no_truth_is_known_for_are_refused() -> None:
    white = needle(0.5, 0.25)
    with pytest.raises(ValueError, match="expected one triangle, got 2"):
        ThinCase(ClipScene(np.repeat(white.clip, 2, axis=0), size=white.size))
    behind = white.clip.copy()
    behind[0, 1, 3] = -1.0
    with pytest.raises(ValueError, match="between the near and the far plane, triangle 0 is not"):
        ThinCase(ClipScene(behind, size=white.size))
    turned = ThinCase(ClipScene(white.clip[:, ::-1], np.ones((1, 3, 4)), white.size))
    assert (turned.wanted == ThinCase(white).wanted).all()


def test_a_scene_with_a_camera_keeps_its_triangles_in_clip_space() -> None:
    experiment = experiments.get("z-fighting-range")
    scene, _ = experiment.case("depth=z-16", (1000.0, 1e-4), 0)
    assert in_clip_space(scene) is scene
    assert scene.clip.shape == (len(scene.clip), 3, 4)
    assert (scene.clip[..., 3] > 0).all()
