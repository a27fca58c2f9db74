"""Measuring a plan: never trust a prediction."""

from copy import copy
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from core.fast_path.draw import draw_picture
from core.records.arrays import Floats, Integers
from core.records.words import capitalized
from core.scene import AnyScene
from core.settings import Settings
from core.study.planner.planning import plan
from core.study.planner.records import (
    Decision,
    Outcome,
    Plan,
    PlanReport,
    Tolerance,
    Watch,
    in_bytes,
    phrase,
    unwatched,
)
from core.study.planner.trials import difference, shown
from core.study.record import collector_off

ROUNDS = 5


def measure_plan(
    scene: AnyScene, chosen: Plan, rounds: int = ROUNDS, watch: Watch = unwatched, times_each: bool = False
) -> PlanReport:
    """Draw a scene with the reference settings, with a plan's settings, and with each of its decisions alone.

    Parameters
    ----------
    rounds : int
        Timed drawings of each, in turn, from 1 on.
    watch : callable, optional
        Called with what is drawn, see `Watch`.
    times_each : bool
        Whether each decision alone is timed too.

    Notes
    -----
    Errors are those of all buffers (`render`) as bytes on the screen, the largest of red, green and blue. Times are
    those of `draw_picture`, each of a scene that nothing is known of.
    """
    steps = _Steps(watch, _comparisons(chosen) + _timings(chosen, rounds, times_each))
    outcomes, differences = _compare(scene, chosen, {}, steps)
    return _report(scene, chosen, outcomes, differences, rounds, (), steps, times_each)


def plan_and_check(
    scene: AnyScene, tolerance: Tolerance | None = None, base: Settings | None = None, rounds: int = ROUNDS
) -> PlanReport:
    """Plan, measure, and where the tolerance does not hold put decisions back until it does, see `check_plan`."""
    return check_plan(scene, plan(scene, tolerance, base), rounds)


def check_plan(
    scene: AnyScene, chosen: Plan, rounds: int = ROUNDS, watch: Watch = unwatched, times_each: bool = False
) -> PlanReport:
    """Measure a plan as `measure_plan` does, and where the tolerance does not hold put decisions back until it does.

    Notes
    -----
    The decision whose own measured error is largest goes back first; the reference settings are within any tolerance.
    """
    steps = _Steps(watch, _comparisons(chosen) + _timings(chosen, rounds, times_each))
    pictures: dict[Settings, Integers] = {}
    fallen_back: list[str] = []
    while True:
        outcomes, differences = _compare(scene, chosen, pictures, steps)
        if np.count_nonzero(differences > chosen.tolerance.bytes) <= chosen.tolerance.pixels:
            break
        worst = max(outcomes, key=lambda outcome: (outcome.measured_pixels, outcome.measured_error))
        fallen_back.append(worst.decision.setting)
        chosen = put_back(chosen, worst.decision.setting)
    return _report(scene, chosen, outcomes, differences, rounds, tuple(fallen_back), steps, times_each)


def _compare(
    scene: AnyScene, chosen: Plan, pictures: dict[Settings, Integers], steps: "_Steps"
) -> tuple[list[Outcome], Integers]:
    """Return how each decision turned out, and how far (H, W) the chosen settings are from the reference settings.

    What is drawn is kept in ``pictures``.
    """

    def drawn(settings: Settings, name: str) -> Integers:
        steps.next(f"Comparing: {name}")
        if settings not in pictures:
            pictures[settings] = shown(scene, settings)
        return pictures[settings]

    differences = difference(
        drawn(chosen.everything, "the reference settings"), drawn(chosen.settings, "the whole choice")
    )
    outcomes = []
    for decision in _cheaper(chosen):
        name = phrase(decision.setting, decision.chosen)
        before, alone = (drawn(settings, name) for settings in alone_settings(chosen, decision))
        outcomes.append(_outcome(decision, difference(alone, before)))
    return outcomes, differences


def _cheaper(chosen: Plan) -> list[Decision]:
    return [decision for decision in chosen.decisions if decision.chosen != decision.dearest]


def _comparisons(chosen: Plan) -> int:
    return 2 + 2 * len(_cheaper(chosen))


def _timings(chosen: Plan, rounds: int, times_each: bool) -> int:
    return (2 + times_each * len(_cheaper(chosen))) * (1 + max(rounds, 1))


def _report(
    scene: AnyScene,
    chosen: Plan,
    outcomes: list[Outcome],
    differences: Integers,
    rounds: int,
    fallen_back: tuple[str, ...],
    steps: "_Steps",
    times_each: bool,
) -> PlanReport:
    """Time the settings and say what all comes to."""
    timed = [chosen.everything, chosen.settings]
    if times_each:
        timed += [with_choices(chosen, (decision.setting,)) for decision in _cheaper(chosen)]
    times = _times(scene, timed, max(rounds, 1), steps)
    for place, seconds in enumerate(times[2:]):
        outcomes[place] = replace(outcomes[place], seconds=seconds)
    beyond = int(np.count_nonzero(differences > chosen.tolerance.bytes))
    is_within = beyond <= chosen.tolerance.pixels
    ratio = float(np.median(times[0]) / np.median(times[1]))
    largest = int(differences.max(initial=0))
    text = (
        f"{'Within' if is_within else 'Beyond'} the tolerance: measured {largest}/255 at most, {beyond:,} pixels "
        f"beyond {chosen.tolerance.bytes}/255, {chosen.tolerance.pixels:,} allowed; {ratio:.3g} times as fast as "
        "the reference settings."
    )
    return PlanReport(
        scene, chosen, tuple(outcomes), largest, beyond, is_within, times[0], times[1], text, fallen_back
    )


@dataclass(eq=False)
class _Steps:
    """Calls a `Watch` with what is drawn next."""

    watch: Watch
    count: int
    done: int = 0

    def next(self, doing: str) -> None:
        self.watch(min(self.done / self.count, 1.0), doing)
        self.done += 1


def with_choices(chosen: Plan, names: tuple[str, ...]) -> Settings:
    """Return the reference settings but for a plan's choices of the settings ``names``."""
    return replace(chosen.everything, **{name: getattr(chosen.settings, name) for name in names})


def alone_settings(chosen: Plan, decision: Decision) -> tuple[Settings, Settings]:
    """Return what a decision's prediction is about: settings with what it rests on, and those with the decision too."""
    rest = decision.rests_on
    return with_choices(chosen, rest), with_choices(chosen, (*rest, decision.setting))


def put_back(chosen: Plan, setting: str) -> Plan:
    """Return a plan that keeps the dearest method of one stage."""
    decisions = []
    for decision in chosen.decisions:
        if decision.setting == setting:
            cheaper, dearest = (phrase(setting, name) for name in (decision.chosen, decision.dearest))
            reason = f"{capitalized(cheaper)} was too inaccurate in the whole picture, so {dearest} stays."
            decision = replace(
                decision,
                chosen=decision.dearest,
                reason=reason,
                predicted_error=0.0,
                predicted_pixels=0,
                is_needed=True,
            )
        decisions.append(decision)
    settings = replace(chosen.settings, **{setting: getattr(chosen.everything, setting)})
    return replace(chosen, decisions=tuple(decisions), settings=settings)


def _outcome(decision: Decision, differences: Integers) -> Outcome:
    """Compare one decision's prediction with the (H, W) differences that it alone makes."""
    allowed = int(np.ceil(decision.predicted_error))
    beyond = int(np.count_nonzero(differences > allowed))
    ranked = np.sort(differences.ravel())[::-1]
    place = min(decision.predicted_pixels, len(ranked) - 1)
    measured = float(ranked[place])
    is_right = beyond <= decision.predicted_pixels
    pixels = f" except for {decision.predicted_pixels:,} pixels" if decision.predicted_pixels else ""
    text = f"predicted {in_bytes(decision.predicted_error)}{pixels}, measured {measured:g}/255"
    if decision.predicted_pixels:
        text += f" and {beyond:,} pixels"
    verdict = "the prediction held" if is_right else "the prediction was wrong"
    return Outcome(decision, measured, beyond, is_right, f"{text}: {verdict}")


def _times(scene: AnyScene, choices: list[Settings], rounds: int, steps: _Steps) -> list[Floats]:
    """Return for each settings the seconds (R,) of drawings, taken in turn after one that does not count."""
    times: list[list[float]] = [[] for _ in choices]
    for number, settings in enumerate(choices):
        steps.next(f"Warming up: {number + 1} of {len(choices)}")
        draw_picture(copy(scene), settings)
    for number in range(rounds):
        for turn in range(len(choices)):
            place = (turn + number) % len(choices)
            steps.next(f"Timing: round {number + 1} of {rounds}, {turn + 1} of {len(choices)}")
            fresh = copy(scene)
            with collector_off():
                start = perf_counter()
                draw_picture(fresh, choices[place])
                times[place].append(perf_counter() - start)
    return [np.array(each) for each in times]
