"""Corners behind the eye, and edges clipped in both directions: who fails and who holds."""

import pytest

from core import Settings, render
from core.clipping.measured import CLIPPINGS, signs_of_w
from core.study.record import Outcome
from core.study.stability import experiments
from tests.covering import every_nth
from tests.stability.maps import is_right_everywhere, outcomes, wrong_at_random

CLIP_FIRST = ("clipping=sutherland-hodgman-lecture", "clipping=sutherland-hodgman", "clipping=homogeneous")


@pytest.mark.parametrize("method", every_nth(["clipping=project-first", "clipping=after-divide"], 2))
def test_projecting_first_needs_all_w_above_0(method: str) -> None:
    for (second, third), outcome in outcomes("signs-of-w", method, every=2).items():
        if second > 0 and third > 0:
            assert outcome == Outcome.RIGHT
        elif second < 0 < third or second > 0 > third or 0 in (second, third):
            assert outcome != Outcome.RIGHT


@pytest.mark.parametrize("method", CLIP_FIRST)
def test_clipping_first_holds_for_all_signs_of_w(method: str) -> None:
    assert is_right_everywhere("signs-of-w", method, every=4)
    assert wrong_at_random("signs-of-w", method, 25) == []


def test_dividing_first_is_right_however_small_w_is() -> None:
    found = outcomes("clip-after-divide", "clipping=after-divide")
    assert {outcome for (_, side), outcome in found.items() if side > 0} == {Outcome.RIGHT}
    assert Outcome.RIGHT not in {outcome for (_, side), outcome in found.items() if side <= 0}


@pytest.mark.parametrize("method", CLIP_FIRST)
def test_clipping_first_holds_near_the_eye(method: str) -> None:
    assert is_right_everywhere("clip-after-divide", method, every=3)


def test_a_shared_edge_clipped_in_order_falls_apart() -> None:
    found = outcomes("clip-order", "clipping=sutherland-hodgman-lecture")
    assert {Outcome.HOLE, Outcome.DOUBLE_HIT} <= set(found.values())


@pytest.mark.parametrize("method", ["clipping=sutherland-hodgman", "clipping=homogeneous"])
def test_a_shared_edge_clipped_from_inside_holds(method: str) -> None:
    assert is_right_everywhere("clip-order", method)


def test_all_clippings_are_tried_and_run_in_the_pipeline() -> None:
    assert {method.partition("=")[2] for method in CLIPPINGS} == {
        "project-first",
        "after-divide",
        "sutherland-hodgman-lecture",
        "sutherland-hodgman",
        "homogeneous",
    }
    scene = signs_of_w((-1.0, 0.5), 0)
    wrong = render(scene, Settings(clipping="project-first")).cover_count
    right = render(scene, Settings(clipping="homogeneous")).cover_count
    assert (wrong != right).any()
    opened = experiments.get("signs-of-w").opening("clipping=project-first", (-1.0, 0.5), 0)
    assert opened.stage == "raster"
