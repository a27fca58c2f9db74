"""Scenes that need one expensive thing keep it, and the plan drops the others."""

from collections.abc import Callable
from dataclasses import replace

import pytest

import tests.core.study.planner.needy_scenes as scenes
from core.scene import AnyScene
from core.study.planner.measuring import measure_plan
from core.study.planner.planning import plan
from core.study.planner.records import Tolerance
from core.study.planner.reference_settings import reference_settings
from core.study.planner.trials import Costs, difference, shown
from tests.covering import every_nth

CHEAP = {
    "cull": ("back",),
    "clipping": ("homogeneous",),
    "interpolation": ("flat", "affine"),
    "texture_filter": ("nearest", "bilinear"),
    "shading": ("unlit", "flat", "gouraud"),
    "visibility": ("last-drawn", "painters"),
    "depth": ("z-16",),
    "blend": ("opaque",),
    "antialiasing": ("none",),
}
NEEDS: list[tuple[Callable[[], AnyScene], str, tuple[str, ...]]] = [
    (scenes.near_plane, "clipping", ("antialiasing",)),
    (scenes.steep, "interpolation", ()),
    (scenes.crossing, "visibility", ()),
    (scenes.tight_gap, "depth", ("visibility",)),
    (scenes.minified, "texture_filter", ()),
    (scenes.magnified, "texture_filter", ()),
    (scenes.highlight, "shading", ()),
    (scenes.edge, "antialiasing", ()),
    (scenes.transparent, "blend", ()),
    (scenes.inside, "cull", ()),
]
"""Scene, what it needs, and what goes with that.

Two things cannot be needed alone. A depth format is one of a depth buffer, so the fine one keeps the buffer. And
clipping differs from homogeneous rasterization by no more than where it snaps new corners, 1/256 pixel: a sample that
this moves across an edge is seen only where the edge has a contrast that one sample of the pixel could not show either.
"""


@pytest.mark.parametrize(("make", "needed", "with_it"), every_nth(NEEDS, 3))
def test_what_is_needed_is_kept_and_the_rest_is_dropped(
    make: Callable[[], AnyScene], needed: str, with_it: tuple[str, ...]
) -> None:
    chosen = plan(make(), Tolerance(), costs=Costs())
    assert measure_plan(make(), chosen, 1).is_within
    for decision in chosen.decisions:
        if decision.setting == "texture_filter" and make is scenes.magnified:
            assert decision.chosen == "bilinear"
        elif decision.setting == needed:
            assert decision.chosen not in CHEAP[needed], decision
        elif decision.setting not in with_it:
            assert decision.chosen in (*CHEAP[decision.setting], "affine-n"), decision


@pytest.mark.parametrize(("make", "needed", "with_it"), NEEDS, ids=[make.__name__ for make, _, _ in NEEDS])
def test_without_it_the_picture_is_beyond_the_tolerance(
    make: Callable[[], AnyScene], needed: str, with_it: tuple[str, ...]
) -> None:
    cheapest = {"clipping": "project-first", "depth": "z-16", "interpolation": "affine", "shading": "gouraud"}
    scene = make()
    everything = reference_settings(scene)
    name = cheapest.get(needed, "nearest" if make is scenes.magnified else CHEAP[needed][-1])
    poorer = replace(everything, **{needed: name})
    assert difference(shown(scene, poorer), shown(scene, everything)).max() > 2
