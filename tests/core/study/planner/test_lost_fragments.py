"""No depth format is chosen that stores fragments as the cleared value, where they are lost."""

from dataclasses import replace

import numpy as np
import pytest

from core import STAGES, ClipScene, Settings, render
from core.methods import table
from core.records.frame import StageCount
from core.stages.vertices import process_geometry
from core.study.planner import trials
from core.study.planner import trials as lost_fragments
from core.study.planner.planning import plan
from core.study.planner.records import Decision, Plan
from core.study.planner.trials import Costs, bands, difference, far_triangles, loses_fragments, shown
from tests.core.strategies import clip_of_window

DEPTHS = table.names("depth")
FAR = 2 * 0.999995 - 1
"""Depth in clip space over w: half a step of 16 bits before the far plane."""


def random_scene(seed: int, side: int) -> ClipScene:
    """Return up to 40 triangles with corners of any depth, many of them next to the far plane."""
    source = np.random.default_rng(seed)
    count, size = int(source.integers(1, 41)), (side, side * 3 // 4)
    near_far = source.choice([1e-3, 1e-5, 1e-6, 1e-7], (count, 1)) * source.random((count, 3))
    kinds = (
        source.uniform(-1.2, 1.2, (count, 3)),
        source.uniform(-1, 1, (count, 3)),
        source.choice([-1, 0, 0.5, 0.99999, 1, 1.00001], (count, 3)),
        1 - near_far,
        1 - 10 ** source.uniform(-9, 0, (count, 3)),
    )
    points = source.uniform(-0.3, 1.3, (count, 3, 2)) * size
    clip = clip_of_window(points, size, source.uniform(0.5, 3, (count, 3)), kinds[source.integers(5)])
    colors = source.random((count, 1, 4)) * np.ones((1, 3, 1))
    colors[..., 3] = 1
    return ClipScene(clip, colors, size)


def geometry_of(scene: ClipScene):
    counts = {stage: StageCount() for stage in STAGES}
    return process_geometry(scene, Settings(clipping="sutherland-hodgman"), counts)


def check_bound(seed: int) -> None:
    """Check that what is not to be lost is seen, with every format, comparison and cleared value."""
    scene = random_scene(seed, 24)
    if seed % 3 == 0:
        scene = ClipScene(scene.clip[:1], scene.attributes[:1], scene.size)
    far = far_triangles(geometry_of(scene))
    for depth in DEPTHS:
        chosen = Settings(
            depth=depth,
            clipping=("homogeneous", "sutherland-hodgman")[seed % 2],
            antialiasing=("none", "msaa-4", "ssaa-4")[seed // 2 % 3],
        )
        frame = render(scene, chosen)
        seen = frame if frame.samples is None else frame.samples
        is_lost = ((seen.cover_count > 0) & (seen.primitive < 0)).any()
        loses = loses_fragments(scene, chosen, far[depth])
        # Of several triangles, another one may hide that a fragment is lost.
        assert loses == is_lost if len(scene.clip) == 1 else loses or not is_lost, (seed, depth)


def lossy_formats(clip: np.ndarray, size: tuple[int, int]) -> set[str]:
    """Return the formats with which some fragment of triangles is lost."""
    scene = ClipScene(clip, None, size)
    far = far_triangles(geometry_of(scene))
    return {depth for depth in DEPTHS if loses_fragments(scene, Settings(depth=depth), far[depth])}


def check_plan(seed: int, side: int) -> None:
    """Check that a plan keeps its tolerance before it is measured."""
    scene = random_scene(seed, side)
    chosen = plan(scene, costs=Costs())
    away = difference(shown(scene, chosen.settings), shown(scene, chosen.everything))
    assert away.max(initial=0) <= chosen.tolerance.bytes, seed


def test_what_may_not_be_lost_is_seen():
    for seed in range(25):
        check_bound(seed)


@pytest.mark.slow
def test_what_may_not_be_lost_is_seen_in_2000_scenes():
    for seed in range(2000):
        check_bound(seed)


def test_plans_of_pictures_that_are_tried_whole_are_within_the_tolerance():
    for seed in range(4):
        check_plan(seed, 16)


@pytest.mark.slow
def test_2000_plans_of_pictures_that_are_tried_whole_are_within_the_tolerance():
    for seed in range(2000):
        check_plan(seed, 28)


@pytest.mark.parametrize(
    ("z", "lossy"),
    [
        (0.0, set()),
        (0.9999, set()),
        (FAR, {"z-16"}),
        (1 - 2.0**-24, {"z-16", "z-24", "z-float32"}),
        (1.0, {"z-16", "z-24", "z-float32", "reversed-z", "fixed-38"}),
    ],
)
def test_the_formats_that_may_lose_fragments_at_a_depth(z: float, lossy: set[str]):
    assert lossy_formats(clip_of_window([[[1, 1], [7, 2], [3, 7]]], (8, 8), 1.0, z), (8, 8)) == lossy


def test_reversed_numbers_lose_what_is_infinitely_far():
    # 1/w of 10^46 is below the least float32.
    clip = clip_of_window([[[1, 1], [7, 2], [3, 7]]], (8, 8), 1e46, 0.0)
    assert {"inverse-w", "logarithmic"} <= lossy_formats(clip, (8, 8))
    assert (render(ClipScene(clip, None, (8, 8)), Settings(depth="inverse-w")).primitive < 0).all()


def test_an_edge_on_triangle_is_asked_for_its_fragments():
    # Its depth goes from plane to plane within 1/512 pixel: a bound alone would say that it may lose any.
    size = (8, 8)
    scene = ClipScene(
        clip_of_window([[[1, 2], [6, 5], [3.5, 3.502]]], size, 1.0, [-0.5, 0.2, 0.9]), None, size
    )
    far = far_triangles(geometry_of(scene))["z-16"]
    assert len(far) == 1
    assert not loses_fragments(scene, Settings(depth="z-16"), far)


def test_triangles_with_too_many_samples_are_taken_to_be_lost(monkeypatch):
    scene = ClipScene(clip_of_window([[[1, 1], [7, 2], [3, 7]]], (8, 8), 1.0, [0, 0, 1.0]), None, (8, 8))
    far = far_triangles(geometry_of(scene))["z-16"]
    assert not loses_fragments(scene, Settings(depth="z-16"), far)
    monkeypatch.setattr(lost_fragments, "SAMPLES", 35)
    assert loses_fragments(scene, Settings(depth="z-16"), far)


def far_between_the_bands() -> ClipScene:
    """Return a far triangle in rows 22 and 23, and two that pass through each other, for the depth test."""
    size = (20, 48)
    points = [[[1, 1], [19, 2], [10, 45]], [[1, 2], [19, 1], [9, 45]], [[1, 22], [8, 22], [4, 24]]]
    clip = clip_of_window(points, size, 1.0, [[-0.5, 0.5, 0], [0.5, -0.5, 0], [FAR, FAR, FAR]])
    colors = np.array([[1.0, 0.5, 0.2, 1], [0.1, 0.2, 0.9, 1], [0.9, 0.9, 0.1, 1]])[:, None] * np.ones((3, 1))
    return ClipScene(clip, colors, size)


def depth_decision(chosen: Plan) -> Decision:
    assert chosen.settings.visibility == "z-buffer"
    return next(each for each in chosen.decisions if each.setting == "depth")


def test_a_far_triangle_between_the_rows_that_are_tried(monkeypatch):
    monkeypatch.setattr(trials, "PIXELS", 20)
    monkeypatch.setattr(trials, "BANDS", 4)
    assert [first for _, first, _, _ in bands(20, 48)] == [0, 15, 31, 47]
    scene = far_between_the_bands()
    chosen = plan(scene, costs=Costs())
    decision = depth_decision(chosen)
    assert (decision.chosen, decision.dearest) == ("z-24", "reversed-z")
    assert "may store z = 0.999995, the farthest depth, as the cleared value" in decision.reason
    with_16_bits = replace(chosen.settings, depth="z-16")
    assert difference(shown(scene, with_16_bits), shown(scene, chosen.settings)).max() > 50


def test_pictures_that_are_tried_whole_ask_only_the_pixels():
    decision = depth_decision(plan(far_between_the_bands(), costs=Costs()))
    assert decision.chosen == "z-24"
    assert "Depth in 16 bits: 8 pixels change" in decision.reason
    assert "cleared value" not in decision.reason
