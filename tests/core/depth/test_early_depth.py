"""The early depth test: the same picture, and as many fragments shaded as the nearest depth of a pixel falls."""

from dataclasses import replace
from fractions import Fraction
from itertools import permutations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, render, trace
from core.depth.early_depth import mean_shaded, shade_if_left, shade_if_passed, shade_then_test
from core.depth.measured_early import make_layers
from core.methods import table
from core.pixel_history import why
from core.pixel_history.told import event_reason
from core.settings import no_effect
from core.stages.passes import planned_passes
from core.study.family import Assignment
from core.trace.source import TraceSource
from tests.core.strategies import perspective_triangles
from tests.core.trace.trace_cases import SCENES

LATE = Settings(cull="none")
EARLY = replace(LATE, depth_test_time="early")
PREPASS = replace(LATE, depth_test_time="prepass")
SIZE = (32, 24)
CHOICES = [
    ("clip", {}),
    ("clip", {"blend": "over"}),
    ("clip", {"visibility": "ray-casting"}),
    ("clip", {"depth": "fixed-38"}),
    ("lit", {"antialiasing": "msaa-4"}),
    ("intersecting", {"antialiasing": "ssaa-4"}),
    ("intersecting", {"polygon_mode": "wireframe", "line": "wu"}),
    ("intersecting", {"visibility": "painters"}),
]


def layers(depths) -> ClipScene:
    """Return triangles over the whole picture, each at one depth."""
    clip = [[[-1, -1, 2 * d - 1, 1], [3, -1, 2 * d - 1, 1], [-1, 3, 2 * d - 1, 1]] for d in depths]
    return ClipScene(np.array(clip), np.ones((len(clip), 3, 4)), SIZE)


def shaded(scene, settings) -> int:
    stage = trace(scene, settings).stage("shade")
    return int(np.count_nonzero([stage.kind_of(row) != "skipped" for row in range(stage.steps.row_count)]))


def test_four_full_layers() -> None:
    far_to_near = [0.9, 0.7, 0.5, 0.3]
    assert [shaded(layers(far_to_near), settings) for settings in (LATE, EARLY)] == [3072, 3072]
    assert [shaded(layers(far_to_near[::-1]), settings) for settings in (LATE, EARLY)] == [3072, 768]
    assert [shaded(SCENES["intersecting"], settings) for settings in (LATE, EARLY)] == [2060, 1762]


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_layers_in_every_order_shade_the_harmonic_number_on_average(count) -> None:
    clip = layers(np.arange(1, count + 1) / (count + 1)).clip
    orders = list(permutations(range(count)))
    each = [trace(ClipScene(clip[list(order)], size=(1, 1)), EARLY).fragment_counts[3] for order in orders]
    assert Fraction(sum(each), len(orders)) == mean_shaded(count)


@given(perspective_triangles(5), st.data())
def test_a_prepass_shades_each_covered_pixel_once(case, data) -> None:
    clip, size = case
    scene = ClipScene(clip, size=size)
    stage, frame = trace(scene, PREPASS).stage("shade"), render(scene, LATE)
    times = stage.state(stage.steps.count)["times shaded"]
    assert np.array_equal(times, frame.primitive >= 0)
    # Of one triangle in focus, what it is left with among all.
    focus = data.draw(st.integers(0, len(clip) - 1))
    alone = trace(scene, PREPASS, focus).stage("shade")
    assert np.array_equal(alone.state(alone.steps.count)["times shaded"], frame.primitive == focus)


def test_four_layers_in_any_order_take_768_after_a_prepass() -> None:
    for order in permutations([0.9, 0.7, 0.5, 0.3]):
        assert shaded(layers(order), PREPASS) == 768
    assert shaded(SCENES["intersecting"], PREPASS) == 1491
    assert shaded(layers([0.5, 0.5]), PREPASS) == 768, "of equal depths the first"
    assert shaded(layers([0.3, 0.5]), replace(PREPASS, blend="over")) == 768, "what is mixed is tested early"
    assert shaded(layers([0.5, 0.3]), replace(PREPASS, blend="over")) == 1536
    (planned,) = planned_passes(SCENES["intersecting"], PREPASS)
    assert np.array_equal(
        render(planned.scene, planned.settings).depth, render(SCENES["intersecting"], LATE).depth
    )


@given(perspective_triangles(5))
def test_a_pixel_is_shaded_as_often_as_its_nearest_depth_falls(case) -> None:
    clip, size = case
    source = TraceSource(ClipScene(clip, size=size), EARLY)
    _, keeps, stored = source.depths
    wanted = np.zeros(size[0] * size[1], np.int64)
    # What lies as far as the cleared buffer is no nearer.
    nearest = np.ones(len(wanted))
    for place, depth in zip(source.place[keeps].tolist(), stored[keeps].tolist(), strict=True):
        if depth < nearest[place]:
            wanted[place], nearest[place] = wanted[place] + 1, depth
    stage = trace(ClipScene(clip, size=size), EARLY).stage("shade")
    assert np.array_equal(stage.state(stage.steps.count)["times shaded"].ravel(), wanted)


@pytest.mark.parametrize("when", [EARLY, PREPASS], ids=["early", "prepass"])
@pytest.mark.parametrize(("name", "chosen"), CHOICES, ids=str)
def test_the_picture_and_what_is_shaded_stay(name, chosen, when) -> None:
    late, early = (replace(settings, **chosen) for settings in (LATE, when))
    one, other = render(SCENES[name], late), render(SCENES[name], early)
    assert all(np.array_equal(getattr(one, b), getattr(other, b)) for b in ("color", "depth", "primitive"))
    of_all, of_seen = (trace(SCENES[name], settings) for settings in (late, early))
    before, after = of_all.stage("shade"), of_seen.stage("shade")
    skipped = after.steps.kind == len(before.steps.kinds)
    assert of_seen.fragment_counts[3] == np.count_nonzero(~skipped)
    assert of_all.fragment_counts[3] == len(skipped)
    assert np.array_equal(before.columns["color"][~skipped], after.columns["color"][~skipped])
    assert not any(skipped[track.rows].any() for track in after.buffers)
    # Depth and blending do what they did.
    for stage in ("depth", "blend"):
        ends = [run.stage(stage).state(run.stage(stage).steps.count) for run in (of_all, of_seen)]
        assert all(np.array_equal(ends[0][n], ends[1][n], equal_nan=True) for n in ends[0])
    if chosen.get("visibility") == "painters":
        assert no_effect(early, "depth_test_time")
        assert not skipped.any()


def test_the_listings_give_one_colour_and_call_for_it_as_often_as_rows_are_shaded() -> None:
    stage = trace(SCENES["clip"], EARLY).stage("shade")
    passes = TraceSource(SCENES["clip"], EARLY).depth_tests.passes
    calls = {shade_then_test: 0, shade_if_passed: 0}
    for row in range(stage.steps.row_count):
        found = []
        for rule in calls:

            def shade(of=rule, at=row) -> list[float]:
                calls[of] += 1
                return stage.columns["color"][at].tolist()

            found.append(rule(lambda at=row: bool(passes[at]), shade))
        assert found[0] == found[1]
        assert (found[0] is None) == (stage.kind_of(row) == "skipped")
    assert list(calls.values()) == [stage.steps.row_count, np.count_nonzero(passes)]
    source = TraceSource(SCENES["clip"], PREPASS)
    stage, done = trace(SCENES["clip"], PREPASS).stage("shade"), set()
    stored, left = source.depths[2], source.picture.depth.ravel()[source.place]
    for row, place in enumerate(source.place.tolist()):
        color = shade_if_left(
            stored[row], left[row], lambda at=place: at in done, lambda at=place: done.add(at) or 1.0
        )
        assert (color is None) == (stage.kind_of(row) == "skipped")


def test_only_a_method_that_tests_depth_takes_the_time_of_the_test() -> None:
    clip = layers([0.5, 0.25]).clip
    for name in table.names("visibility"):
        method, settings = table.get("visibility", name), replace(EARLY, visibility=name)
        takes = "depth_test_time" in method.takes
        assert not takes or method.function(clip).uses_depth_test, name
        assert takes == (not no_effect(settings, "depth_test_time"))
        assert trace(layers([0.25, 0.5]), settings).fragment_counts[3] == (768 if takes else 1536)


def test_the_history_of_a_pixel_says_what_was_not_shaded() -> None:
    history = why(TraceSource(layers([0.25, 0.5]), EARLY), 3, 4)
    keys = {
        event.triangle: [link.key for link in event.chain if link.stage == "shade"]
        for event in history.events
    }
    assert keys[0] == ["color"]
    assert keys[1] == ["not-shaded"]
    history = why(TraceSource(layers([0.5, 0.25]), PREPASS), 3, 4)
    assert [event.link("shade").key for event in history.events[2:]] == ["not-left", "color"]
    assert "its depth was written" in event_reason(history.events[2]).lower()


def test_the_chart_counts_what_each_order_shades() -> None:
    def count(work: str, settings: Settings) -> int:
        task = make_layers(Assignment(work, {"layers": 4}, 3, settings))
        return task.counts(settings, render(task.scene, settings))["fragments shaded"]

    assert [count(work, LATE) for work in ("near-to-far", "random", "far-to-near")] == [3072] * 3
    assert count("near-to-far", EARLY) == 768 <= count("random", EARLY) <= count("far-to-near", EARLY) == 3072


@given(st.permutations([0.1, 0.3, 0.5, 0.7, 0.9]))
def test_sorted_orders_are_the_ends(depths) -> None:
    count = trace(replace(layers(depths), size=(1, 1)), EARLY).fragment_counts[3]
    assert count == sum(depth < min(depths[:k], default=1) for k, depth in enumerate(depths))
