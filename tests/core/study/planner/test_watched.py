"""A watched plan: what is told while it is made and measured, that it can be ended, and times of each choice alone."""

import pytest

from core.study.planner.measuring import alone_settings, check_plan, measure_plan
from core.study.planner.planning import plan
from core.study.planner.records import Tolerance
from core.study.planner.trials import Costs
from core.study.workloads import sphere_scene
from lessons.scenes import built_in_scene


class EndedError(Exception):
    """Raised by a watch."""


def test_a_watch_is_told_everything_in_order() -> None:
    scene = built_in_scene("shared-edge").make()
    planning: list[float] = []
    chosen = plan(scene, watch=lambda done, doing: planning.append(done))
    assert planning == sorted(planning)
    measuring: list[float] = []
    measure_plan(scene, chosen, 2, watch=lambda done, doing: measuring.append(done), times_each=True)
    assert measuring == sorted(measuring)
    cheaper = sum(decision.chosen != decision.dearest for decision in chosen.decisions)
    # Two pictures of each are compared; each is drawn once to warm up, and in both rounds.
    assert len(measuring) == (2 + 2 * cheaper) + (2 + cheaper) * 3


@pytest.mark.parametrize("place", [0, 1, 2])
def test_a_watch_ends_planning(place: int) -> None:
    told: list[str] = []

    def watch(done: float, doing: str) -> None:
        told.append(doing)
        if len(told) > place:
            raise EndedError

    with pytest.raises(EndedError):
        plan(built_in_scene("shared-edge").make(), watch=watch)
    assert len(told) == place + 1


def test_a_watch_is_told_every_method_that_is_tried() -> None:
    told: list[str] = []
    plan(sphere_scene(12, 48), costs=Costs(), watch=lambda done, doing: told.append(doing))
    assert told[0] == "Analysing the scene"
    assert "Trying one sample a pixel" in told
    assert "Trying flat shading" in told
    assert told[-1] == "Predicting the time"


def test_a_watch_ends_measuring() -> None:
    def watch(done: float, doing: str) -> None:
        if "Timing" in doing:
            raise EndedError

    scene = built_in_scene("shared-edge").make()
    with pytest.raises(EndedError):
        check_plan(scene, plan(scene), 1, watch)


@pytest.mark.slow
def test_each_choice_alone_is_timed_on_demand() -> None:
    scene = built_in_scene("shared-edge").make()
    chosen = plan(scene)
    plain, timed = measure_plan(scene, chosen, 2), measure_plan(scene, chosen, 2, times_each=True)
    assert [len(outcome.seconds) for outcome in plain.outcomes] == [0] * len(plain.outcomes)
    assert [len(outcome.seconds) for outcome in timed.outcomes] == [2] * len(timed.outcomes)
    assert [outcome.text for outcome in plain.outcomes] == [outcome.text for outcome in timed.outcomes]


def test_a_choice_alone_differs_in_that_choice_only() -> None:
    chosen = plan(built_in_scene("shared-edge").make(), Tolerance(255.0))
    for decision in chosen.decisions:
        before, after = alone_settings(chosen, decision)
        changed = [name for name in vars(before) if getattr(before, name) != getattr(after, name)]
        assert changed == ([decision.setting] if decision.chosen != decision.dearest else [])
