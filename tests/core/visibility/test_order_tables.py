"""What is said of the order of drawing: Newell's tests against pictures, and the tables of sort and tree."""

import numpy as np
import pytest

from core import ClipScene, Settings, render, trace
from core.explain.step_tables import step_table
from core.explain.steps import variables
from core.pixel_history import why
from core.pixel_history.told import event_reason
from core.visibility.newell import examine_pairs, find_cycle
from lessons.scenes import make_scene
from tests.covering import every_nth

SIZE = (48, 36)


def wrong_pixels(clip: np.ndarray, order: tuple[int, int]) -> int:
    """Count the pixels that two triangles, painted in an order, show otherwise than exact rays."""
    chosen = clip[list(order)]
    pictures = [
        render(ClipScene(chosen, size=SIZE), Settings(visibility=name, cull="none")).primitive
        for name in ("last-drawn", "ray-casting")
    ]
    return int((pictures[0] != pictures[1]).sum())


@pytest.mark.parametrize("seed", every_nth(range(6), 3))
def test_a_test_that_holds_and_a_verdict_are_right_for_the_picture(seed: int) -> None:
    source = np.random.default_rng(seed)
    w = source.uniform(1, 3, (8, 3))
    place = source.uniform(-0.6, 0.6, (8, 1, 2)) + source.normal(0, 0.5, (8, 3, 2))
    clip = np.concatenate([place * w[..., None], (5 * w[..., None] - 8) / 3, w[..., None]], axis=2)
    verdicts = set()
    for pair in examine_pairs(clip, list(range(8))):
        first, second = (
            wrong_pixels(clip, order) for order in ((pair.first, pair.second), (pair.second, pair.first))
        )
        verdicts.add(pair.verdict)
        # A centre within the rounding of corners from an edge may differ.
        assert not pair.holds.any() or first <= 1
        assert not pair.reversed_holds.any() or second <= 1
        assert pair.verdict not in ("either", "right") or first <= 1
        assert pair.verdict not in ("either", "wrong") or second <= 1
        assert pair.verdict == "cut" or min(first, second) <= 1
    assert len(verdicts) > 2


def test_three_bars_have_a_cycle_and_two_layers_have_none() -> None:
    bars = make_scene("circle-of-bars").clip
    assert sorted(find_cycle(examine_pairs(bars, [0, 1, 2]))) == [0, 1, 2]
    layers = np.repeat(bars[:1], 3, axis=0)
    layers[:, :, 2] += np.arange(3)[:, None] / 10
    assert find_cycle(examine_pairs(layers, [2, 0, 1])) == []


def test_the_tables_say_why_the_sort_fails_and_what_the_tree_did() -> None:
    notes = {}
    for name in ("circle-of-bars", "intersecting"):
        for visibility in ("painters", "bsp"):
            found = trace(make_scene(name), Settings(visibility=visibility)).stage("depth")
            for position in range(0, found.steps.count, 7):
                assert step_table(found, position) is not None
            notes[name, visibility] = step_table(found, found.steps.count).note
    assert "overlap in a circle" in notes["circle-of-bars", "painters"]
    assert "pass through each other" in notes["intersecting", "painters"]
    assert "3 cuts made 9 pieces of 3 triangles" in notes["circle-of-bars", "bsp"]
    assert "1 cut made 4 pieces of 2 triangles" in notes["intersecting", "bsp"]


def test_the_first_of_an_order_has_nothing_before_it() -> None:
    found = trace(make_scene("circle-of-bars"), Settings(visibility="painters")).stage("depth")
    first = int(np.flatnonzero(found.steps.kind == found.steps.kinds.index("place"))[0])
    shown = variables(found.explain(int(found.steps.starts[first + 1])))
    assert [(each.name, each.now) for each in shown] == [("before it", "nothing"), ("D before", "nothing")]


def test_a_piece_is_painted_over_because_of_a_plane_with_the_eye_on_its_side() -> None:
    source = trace(make_scene("circle-of-bars"), Settings(visibility="bsp")).source
    said = [event_reason(event) for event in why(source, 33, 35).events if event.triangle == 0]
    assert any("Painted over piece 4 of triangle 2" in text for text in said)


@pytest.mark.parametrize("visibility", ["painters", "bsp"])
def test_one_triangle_has_those_rows_of_the_order_that_are_about_it(visibility: str) -> None:
    scene, settings = make_scene("circle-of-bars"), Settings(visibility=visibility)
    found = trace(scene, settings).stage("depth")
    for triangle in range(3):
        own = trace(scene, settings, triangle).stage("depth")
        whole, part = ((stage.pixel[:, 0] < 0) & (stage.triangle == triangle) for stage in (found, own))
        assert part.sum() == whole.sum() > 0
        for name in found.columns:
            numbers = found.columns[name].dtype.kind == "f"
            assert np.array_equal(found.columns[name][whole], own.columns[name][part], equal_nan=numbers), (
                name
            )
