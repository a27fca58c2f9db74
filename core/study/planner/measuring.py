"""Measuring a plan: never trust a prediction."""

from copy import copy
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from core.fast_path import draw_picture
from core.framebuffer.display import to_display
from core.pipeline import render
from core.records.arrays import Floats, Integers
from core.scene import AnyScene
from core.settings import Settings
from core.study.accuracy.speed_accuracy import collector_off
from core.study.planner.planning import plan
from core.study.planner.progress import Watch, unwatched
from core.study.planner.records import Decision, Outcome, Plan, PlanReport, Tolerance
from core.study.planner.words.phrases import capitalized, in_bytes, phrase

ROUNDS = 5


def measure_plan(
    scene: AnyScene,
    chosen: Plan,
    rounds: int = ROUNDS,
    fallen_back: tuple[str, ...] = (),
    watch: Watch = unwatched,
    times_each: bool = False,
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
    times_each : bool
        Whether each decision alone is timed too.

    Notes
    -----
    Errors are those of all buffers (`render`) as bytes on the screen, the largest of red, green and blue. Times are
    those of `draw_picture`, each of a scene that nothing is known of.
    """
    cheaper = [decision for decision in chosen.decisions if decision.chosen != decision.dearest]
    timed = [chosen.everything, chosen.settings]
    if times_each:
        timed += [with_choices(chosen, (decision.setting,)) for decision in cheaper]
    steps = _Steps(watch, 2 + len(cheaper) + len(timed) * (1 + max(rounds, 1)))
    steps.next("Comparing: everything on")
    reference = shown(scene, chosen.everything)
    steps.next("Comparing: the whole choice")
    differences = difference(shown(scene, chosen.settings), reference)
    beyond = int(np.count_nonzero(differences > chosen.tolerance.bytes))
    outcomes = []
    for decision in cheaper:
        steps.next(f"Comparing: {phrase(decision.setting, decision.chosen)}")
        before, alone = alone_settings(chosen, decision)
        drawn_before = reference if before == chosen.everything else shown(scene, before)
        outcomes.append(_outcome(decision, difference(shown(scene, alone), drawn_before)))
    times = _times(scene, timed, max(rounds, 1), steps)
    for place, seconds in enumerate(times[2:]):
        outcomes[place] = replace(outcomes[place], seconds=seconds)
    is_within = beyond <= chosen.tolerance.pixels
    ratio = float(np.median(times[0]) / np.median(times[1]))
    largest = int(differences.max(initial=0))
    text = (
        f"{'Within' if is_within else 'Beyond'} the tolerance: measured {largest}/255 at most, {beyond:,} pixels "
        f"beyond {chosen.tolerance.bytes}/255, {chosen.tolerance.pixels:,} allowed; {ratio:.3g} times as fast as "
        "everything on."
    )
    return PlanReport(
        scene, chosen, tuple(outcomes), largest, beyond, is_within, times[0], times[1], text, fallen_back
    )


@dataclass(eq=False)
class _Steps:
    """Tells a `Watch` what is drawn next."""

    watch: Watch
    count: int
    done: int = 0

    def next(self, doing: str) -> None:
        self.watch(min(self.done / self.count, 1.0), doing)
        self.done += 1


def with_choices(chosen: Plan, names: tuple[str, ...]) -> Settings:
    """Return everything on but for a plan's choices of the settings ``names``."""
    return replace(chosen.everything, **{name: getattr(chosen.settings, name) for name in names})


def alone_settings(chosen: Plan, decision: Decision) -> tuple[Settings, Settings]:
    """Return what a decision's prediction is about: settings with what it rests on, and those with the decision too."""
    rest = decision.rests_on
    return with_choices(chosen, rest), with_choices(chosen, (*rest, decision.setting))


def plan_and_check(
    scene: AnyScene, tolerance: Tolerance | None = None, base: Settings | None = None, rounds: int = ROUNDS
) -> PlanReport:
    """Plan, measure, and where the tolerance does not hold put decisions back until it does, see `check_plan`."""
    return check_plan(scene, plan(scene, tolerance, base), rounds)


def check_plan(
    scene: AnyScene,
    chosen: Plan,
    rounds: int = ROUNDS,
    watch: Watch = unwatched,
    times_each: bool = False,
) -> PlanReport:
    """Measure a plan as `measure_plan` does, and where the tolerance does not hold put decisions back until it does.

    Notes
    -----
    The decision whose own measured error is largest goes back first; everything on is within any tolerance.
    """
    report = measure_plan(scene, chosen, rounds, (), watch, times_each)
    fallen_back: list[str] = []
    while not report.is_within:
        worst = max(report.outcomes, key=lambda outcome: (outcome.measured_pixels, outcome.measured_error))
        fallen_back.append(worst.decision.setting)
        chosen = put_back(chosen, worst.decision.setting)
        report = measure_plan(scene, chosen, rounds, tuple(fallen_back), watch, times_each)
    return report


def put_back(chosen: Plan, setting: str) -> Plan:
    """Return a plan that keeps the dearest method of one stage."""
    decisions = []
    for decision in chosen.decisions:
        if decision.setting == setting:
            cheaper, dearest = (phrase(setting, name) for name in (decision.chosen, decision.dearest))
            reason = f"{capitalized(cheaper)} was measured to be too far off, so {dearest} stays."
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
