"""A watched plan: what is told while it is made and measured, that it can be ended, and times of each choice alone."""

import pytest

from core.study import Tolerance, check_plan, measure_plan, plan
from core.study.accuracy.workloads import sphere_scene
from core.study.planner.choices.costs import LectureOrder
from core.study.planner.measuring import alone_settings
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
    # Each is drawn once to be compared, once to warm up, and in both rounds.
    assert len(measuring) == (2 + cheaper) * 4


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


@pytest.mark.parametrize("part", [2, 5, 8])
def test_a_look_asks_between_its_parts_whether_to_go_on(part: int) -> None:
    told: list[str] = []

    def watch(done: float, doing: str) -> None:
        told.append(doing)
        if len(told) == part:
            raise EndedError

    with pytest.raises(EndedError):
        plan(sphere_scene(12, 200), watch=watch)
    assert told == ["Looking at the scene"] * part


@pytest.mark.parametrize("step", ["Choosing how what is seen is found", "Choosing how it is coloured"])
def test_a_choice_asks_between_its_parts_whether_to_go_on(step: str) -> None:
    told: list[str] = []
    plan(sphere_scene(12, 48), costs=LectureOrder(), watch=lambda done, doing: told.append(doing))
    assert told.count(step) > 3


def test_a_watch_ends_measuring() -> None:
    def watch(done: float, doing: str) -> None:
        if "Timing" in doing:
            raise EndedError

    scene = built_in_scene("shared-edge").make()
    with pytest.raises(EndedError):
        check_plan(scene, plan(scene), 1, watch)


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


def test_a_watch_ends_the_trial_of_costs() -> None:
    told: list[str] = []

    def watch(done: float, doing: str) -> None:
        told.append(doing)
        if told.count("Choosing how it is coloured") > 2:
            raise EndedError

    with pytest.raises(EndedError):
        plan(built_in_scene("shared-edge").make(), Tolerance(255.0), watch=watch)
    assert told[-1] == "Choosing how it is coloured"
