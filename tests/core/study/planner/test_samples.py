"""How many samples a plan keeps: the bounds of fewer, and that each number is chosen where it is enough."""

from dataclasses import replace

import numpy as np
import pytest

from core.methods import table
from core.records.arrays import Floats
from core.scene import ClipScene
from core.settings import Settings
from core.study import Tolerance, everything_on, plan
from core.study.planner.bounds.color_ranges import color_ranges, joined_ranges
from core.study.planner.bounds.sample_errors import sample_error
from core.study.planner.bounds.translucency import alphas, is_translucent
from core.study.planner.choices.costs import LectureOrder
from core.study.planner.corpus import corpus_scene
from core.study.planner.measuring import difference, shown
from core.study.planner.scene_analysis.conservative_coverage import touch
from core.study.planner.scene_analysis.sample_patterns import PATTERNS
from core.study.planner.scene_analysis.surfaces import format_margin, surfaces

ALL = (255, 10**9)
"""A tolerance by which every pixel is looked at, and none is too far off."""


class WithoutMultisampling(LectureOrder):
    """A machine on which multisampling takes longer."""

    def is_slower(self, settings: Settings, others: Settings) -> bool:
        """Tell whether only the first multisamples."""
        return settings.antialiasing == "msaa-4" != others.antialiasing


@pytest.mark.parametrize("seed", range(21))
@pytest.mark.parametrize("name", ["none", "msaa-4", "ssaa-4"])
def test_fewer_samples_are_off_by_their_bound_at_most(name: str, seed: int) -> None:
    scene = corpus_scene(seed)[1]
    everything = everything_on(scene)
    touched = touch(scene, everything)
    blended = is_translucent(touched, scene)
    if blended and name == "msaa-4":
        pytest.skip("how much shines through is not bounded beyond the corners")
    pattern, margin = PATTERNS[name], format_margin(everything.depth)
    colors = color_ranges(touched, scene, everything, touched.is_drawn)
    own = colors
    if not pattern.stays_inside:
        own = color_ranges(touched, scene, everything, touched.is_drawn, stays_inside=False)
    seen = surfaces(touched, joined_ranges(colors, own), scene.background, margin, is_blended=blended)
    # Everything is looked into: no width is narrow enough to be taken for an answer.
    found = replace(seen, width=np.where(seen.width > 0, 255.0, 0.0))
    alpha = alphas(touched, scene) if blended else None
    for most in (0, 8, 40):
        error = sample_error(
            touched, (colors, own), found, scene.background, pattern, margin, (most, ALL[1]), alpha
        )
        apart = difference(shown(scene, everything), shown(scene, replace(everything, antialiasing=name)))
        assert np.count_nonzero(apart > np.ceil(error.error)) <= error.beyond
        assert error.error <= most


def halves(light: float) -> ClipScene:
    """Return a slanted edge between two greys that fills the picture."""
    corners = np.array([[-1.0, -1, 0, 1], [3.1, -1, 0, 1], [-1, 2.8, 0, 1], [3, 3, 0, 1]])
    clip = corners[[[0, 1, 2], [1, 3, 2]]] - np.array([0.4, 0.3, 0, 0])
    grey = np.array([0.4, 0.4, 0.4, 1.0])
    colors = np.stack([np.tile(grey, (3, 1)), np.tile([light, light, light, 1.0], (3, 1))])
    return ClipScene(clip, colors, (32, 32), background=tuple(grey))


def chosen_samples(light: float, tolerance: float, costs: LectureOrder) -> str:
    scene = halves(light)
    chosen = plan(scene, Tolerance(tolerance), costs=costs)
    apart = difference(shown(scene, chosen.settings), shown(scene, chosen.everything))
    assert apart.max() <= tolerance
    return chosen.settings.antialiasing


def test_the_contrast_of_an_edge_decides_how_many_samples_it_takes() -> None:
    found = [chosen_samples(light, 6.0, LectureOrder()) for light in (0.41, 0.47, 0.9)]
    assert found == ["none", "msaa-4", "ssaa-16"]
    assert chosen_samples(0.47, 6.0, WithoutMultisampling()) == "ssaa-4"


def test_a_method_that_would_do_but_takes_longer_is_told() -> None:
    chosen = plan(halves(0.47), Tolerance(6.0), costs=WithoutMultisampling())
    reason = next(each.reason for each in chosen.decisions if each.setting == "antialiasing")
    assert "Multisampling with 4 samples would do, but takes longer here." in reason


def test_every_method_with_samples_has_a_pattern() -> None:
    assert set(PATTERNS) <= set(table.names("antialiasing"))


def test_alpha_that_varies_is_not_interpolated_any_cheaper() -> None:
    clip = np.array([[[-1.0, -1, 0, 1], [9, -3, 0, 3], [-1, 3, 0, 1]]])
    colors: Floats = np.full((1, 3, 4), 0.5)
    colors[0, :, 3] = 0.1, 0.9, 0.4
    scene = ClipScene(clip, colors, (24, 24))
    chosen = plan(scene, Tolerance(2.0), costs=LectureOrder())
    assert chosen.settings.interpolation == "perspective"
    worse = shown(scene, replace(chosen.everything, interpolation="affine"))
    assert difference(worse, shown(scene, chosen.everything)).max() > 2
