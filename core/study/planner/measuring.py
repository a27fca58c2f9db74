"""Measuring a plan: never trust a prediction."""

from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import replace
from time import perf_counter

import numpy as np

from core.arrays import Floats, Integers
from core.framebuffer.display import to_display
from core.picture import draw_picture
from core.pipeline import render
from core.scene import AnyScene
from core.settings import Settings
from core.study.planner.planning import plan
from core.study.planner.records import Decision, Outcome, Plan, PlanReport, Tolerance
from core.study.speed_accuracy import collector_off

ROUNDS = 5
Watch = Callable[[float, str], None]
"""Told before every drawing the part that is done and what comes next; whatever it raises ends the measuring."""


def unwatched(done: float, doing: str) -> None:
    """Let everything be drawn."""


def measure_plan(
    scene: AnyScene,
    chosen: Plan,
    rounds: int = ROUNDS,
    fallen_back: tuple[str, ...] = (),
    watch: Watch = unwatched,
) -> PlanReport:
    """Draw a scene with everything on, with a plan's settings, and with each of its decisions alone.

    Parameters
    ----------
    scene : Scene or ClipScene
    chosen : Plan
    rounds : int
        Timed drawings of each, in turn, from 1 on.
    fallen_back : tuple of str
        As `PlanReport.fallen_back`.
    watch : callable, optional
        Told what is drawn, see `Watch`.

    Notes
    -----
    Errors are those of all buffers (`render`) as bytes on the screen, the largest of red, green and blue. Times are those
    of `draw_picture`, each of a scene that nothing is known of.
    """
    cheaper = [decision for decision in chosen.decisions if decision.chosen != decision.dearest]
    alone = [replace(chosen.everything, **{each.setting: each.chosen}) for each in cheaper]
    titles = ["everything on", "the chosen settings", *(f"{each.setting} {each.chosen} alone" for each in cheaper)]
    count = (2 + max(rounds, 1)) * len(titles)
    drawn = 0

    def next_drawing(place: int, what: str) -> None:
        nonlocal drawn
        watch(drawn / count, f"{what} {titles[place]}")
        drawn += 1

    next_drawing(0, "Comparing")
    reference = shown(scene, chosen.everything)
    next_drawing(1, "Comparing")
    differences = difference(shown(scene, chosen.settings), reference)
    beyond = int(np.count_nonzero(differences > chosen.tolerance.bytes))
    found = []
    for place, settings in enumerate(alone):
        next_drawing(2 + place, "Comparing")
        found.append(difference(shown(scene, settings), reference))
    times = _times(scene, (chosen.everything, chosen.settings, *alone), max(rounds, 1), next_drawing)
    outcomes = [
        replace(_outcome(decision, differs), seconds=seconds)
        for decision, differs, seconds in zip(cheaper, found, times[2:], strict=True)
    ]
    is_within = beyond <= chosen.tolerance.pixels
    ratio = float(np.median(times[0]) / np.median(times[1]))
    largest = int(differences.max(initial=0))
    text = (
        f"{'Within' if is_within else 'Beyond'} the tolerance: measured {largest}/255 at most, {beyond:,} pixels beyond "
        f"{chosen.tolerance.bytes}/255, {chosen.tolerance.pixels:,} allowed; {ratio:.3g} times as fast as everything on."
    )
    return PlanReport(
        scene, chosen, tuple(outcomes), largest, beyond, is_within, times[0], times[1], text, fallen_back
    )


def plan_and_check(
    scene: AnyScene, tolerance: Tolerance | None = None, base: Settings | None = None, rounds: int = ROUNDS
) -> PlanReport:
    """Plan, measure, and where the tolerance does not hold put decisions back until it does, see `check_plan`."""
    return check_plan(scene, plan(scene, tolerance, base), rounds)


def check_plan(scene: AnyScene, chosen: Plan, rounds: int = ROUNDS, watch: Watch = unwatched) -> PlanReport:
    """Measure a plan, and where the tolerance does not hold put decisions back until it does.

    Notes
    -----
    The decision whose own measured error is largest goes back first; everything on is within any tolerance.
    """
    report = measure_plan(scene, chosen, rounds, watch=watch)
    fallen_back: list[str] = []
    while not report.is_within:
        worst = max(report.outcomes, key=lambda outcome: (outcome.measured_pixels, outcome.measured_error))
        fallen_back.append(worst.decision.setting)
        chosen = put_back(chosen, worst.decision.setting)
        report = measure_plan(scene, chosen, rounds, tuple(fallen_back), watch)
    return report


def put_back(chosen: Plan, setting: str) -> Plan:
    """Return a plan that keeps the dearest method of one stage."""
    decisions = []
    for decision in chosen.decisions:
        if decision.setting == setting:
            reason = f"{decision.chosen} was measured to be too far off, so {decision.dearest} is kept."
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


def shown(scene: AnyScene, settings: Settings) -> Integers:
    """Return the red, green and blue bytes of a picture, (H, W, 3) int64."""
    return to_display(render(copy(scene), settings).color).pixels[..., :3].astype(np.int64)


def difference(first: Integers, second: Integers) -> Integers:
    """Return the difference of the channel that differs most, (H, W) int64, of pictures (H, W, 3)."""
    return np.asarray(np.abs(first - second).max(axis=2, initial=0))


def _outcome(decision: Decision, differences: Integers) -> Outcome:
    """Compare one decision's prediction with the (H, W) differences that it alone makes."""
    allowed = int(np.ceil(decision.predicted_error))
    beyond = int(np.count_nonzero(differences > allowed))
    ranked = np.sort(differences.ravel())[::-1]
    place = min(decision.predicted_pixels, len(ranked) - 1)
    measured = float(ranked[place])
    is_right = beyond <= decision.predicted_pixels
    pixels = f" but for {decision.predicted_pixels:,} pixels" if decision.predicted_pixels else ""
    text = f"predicted {decision.predicted_error:.3g}/255{pixels}, measured {measured:g}/255"
    if decision.predicted_pixels:
        text += f" and {beyond:,} pixels"
    verdict = "the prediction held" if is_right else "the prediction was wrong"
    return Outcome(decision, measured, beyond, is_right, f"{text}: {verdict}")


def _times(
    scene: AnyScene, choices: Sequence[Settings], rounds: int, next_drawing: Callable[[int, str], None]
) -> list[Floats]:
    """Return for each settings the seconds (R,) of drawings, taken in turn after one that does not count."""
    times: list[list[float]] = [[] for _ in choices]
    for place, settings in enumerate(choices):
        next_drawing(place, "Warming up")
        draw_picture(copy(scene), settings)
    for number in range(rounds):
        for turn in range(len(choices)):
            place = (turn + number) % len(choices)
            next_drawing(place, f"Round {number + 1} of {rounds},")
            fresh = copy(scene)
            with collector_off():
                start = perf_counter()
                draw_picture(fresh, choices[place])
                times[place].append(perf_counter() - start)
    return [np.array(each) for each in times]
