"""A plan of the open scene: made and measured off the GUI thread, and said in words."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from html import escape

import numpy as np

from app.background import Progress
from app.pages.experiment_page import DrawnPictures
from app.pages.page_bar import StepRequest
from app.pages.words import digits, time_text
from core.explain.stage_texts import family_title
from core.methods import table
from core.records.words import counted, joined, nouns
from core.scene import AnyScene
from core.settings import Settings
from core.study.planner.measuring import alone_settings, check_plan
from core.study.planner.planning import plan
from core.study.planner.records import (
    Decision,
    Findings,
    Outcome,
    Plan,
    PlanReport,
    Tessellation,
    Tolerance,
    in_bytes,
)
from core.study.planner.trials import difference, shown
from core.study.record import Opening, StudyCancelledError
from widgets.experiments.case_pictures import PicturesRecord
from widgets.experiments.plan import PlanRow, SummaryRecord, Verdict
from widgets.grid.layers import GridBuffer
from widgets.grid.linked_grids import Pixel

# What the Plan page does off the GUI thread: plans, measures the plan, draws the pictures of what was
# chosen.


@dataclass(frozen=True, eq=False)
class PlanShown:
    """A plan of a scene, and once it is measured its report."""

    scene: AnyScene
    title: str
    """What the scene is called."""
    plan: Plan
    report: PlanReport | None = None
    is_measuring: bool = False
    """Whether a report is to come."""


def planned(
    scene: AnyScene,
    title: str,
    settings: Settings,
    tolerance: Tolerance,
    rounds: int,
    progress: Progress,
    is_cancelled: Callable[[], bool],
    part_done: Callable[[PlanShown], None],
) -> PlanShown:
    """Plan, then measure; the plan comes before its numbers.

    Parameters
    ----------
    settings : Settings
        What is to be seen, not how well.
    rounds : int
        How often everything is timed; 0: nothing is measured.
    """

    def watch(done: float, doing: str) -> None:
        if is_cancelled():
            raise StudyCancelledError("The analysis was cancelled.")
        progress(done, doing)

    found = PlanShown(scene, title, plan(scene, tolerance, settings, watch))
    if not rounds:
        return found
    part_done(replace(found, is_measuring=True))
    return replace(found, report=check_plan(scene, found.plan, rounds, watch, times_each=True))


def drawn_choice(scene: AnyScene, chosen: Plan, setting: str) -> DrawnPictures:
    """Return what a plan chose at one stage alone, or with an empty ``setting`` all of it, beside the reference."""
    before, settings, title = chosen.everything, chosen.settings, "All choices together"
    if setting:
        decision = next(each for each in chosen.decisions if each.setting == setting)
        before, settings = alone_settings(chosen, decision)
        title = f"{family_title(setting)}: {table.get(setting, getattr(settings, setting)).title}"
    result, reference = shown(scene, settings), shown(scene, before)
    differs = difference(result, reference).astype(np.float32)
    count = int(np.count_nonzero(differs))
    amount = (
        f"{counted(count, 'pixel')} of {differs.size:,} differ, by {int(differs.max())}/255 at most."
        if count
        else f"none of {differs.size:,} pixels differs."
    )
    buffers = (
        GridBuffer("chosen", result.astype(np.uint8), "color"),
        GridBuffer("reference settings", reference.astype(np.uint8), "color"),
        # White is no difference at any size of it.
        GridBuffer("difference", differs, "signed", unit="/255"),
    )
    except_for = "" if before == chosen.everything else ", except what this choice needs"
    heads = title, f"Reference settings{except_for}", "Difference, in 1/255"
    row, column = np.unravel_index(int(differs.argmax()), differs.shape)
    request = partial(_request, scene, settings, before, title, (int(column), int(row)))
    return DrawnPictures(PicturesRecord(f"{title}: {amount}", buffers, heads, can_step=True), request)


def _request(
    scene: AnyScene, settings: Settings, before: Settings, title: str, worst: Pixel, pin: Pixel | None
) -> StepRequest:
    """Return the choice beside the reference settings, A | B, at the pinned pixel or where they differ most."""
    return StepRequest(Opening(scene, settings, "resolve", pin or worst), title, before)


# A plan in words: its rows, what it comes to, and what was seen in the scene.


EMPTY = (
    "The choices appear here, one for each stage, with the reason and the predicted error: clipping or none, a depth "
    "buffer or none, how many samples. Analyse (F5) measures them: a few seconds, longer for a large scene. Apply then "
    "uses the settings on the Step page."
)


REFERENCE = "The reference settings are the most accurate method of every stage, with 16 samples a pixel."


def about(title: str, size: tuple[int, int], tolerance: Tolerance) -> str:
    """Return what was analysed, and with which tolerance."""
    return f"{title}, {size[0]}×{size[1]} pixels, {tolerance_text(tolerance)}."


def tolerance_text(tolerance: Tolerance) -> str:
    """Return how much may differ."""
    if not tolerance.bytes:
        few = f" except for {counted(tolerance.pixels, 'pixel')}" if tolerance.pixels else ""
        return f"exact{few}"
    return f"within {tolerance.bytes}/255, {counted(tolerance.pixels, 'pixel')} beyond"


def summary_of(shown: PlanShown, applied: str, stale: str) -> SummaryRecord:
    """Return a plan in short: what applying it has changed, and why it is not of what is open, as they are given."""
    plan, report = shown.plan, shown.report
    return SummaryRecord(
        applied=applied,
        headline=headline(plan, report, is_measuring=shown.is_measuring),
        details="" if report is None else details(plan, report),
        is_within=None if report is None else report.is_within,
        about=about(shown.title, shown.scene.size, plan.tolerance),
        stale=stale,
        findings=findings_html(plan.findings),
        findings_note=f"({len(plan.findings.facts)})",
        advice=advice_html(plan.tessellations, plan.findings.corner_count),
        can_draw=report is not None,
    )


def rows_of(plan: Plan, report: PlanReport | None) -> tuple[PlanRow, ...]:
    """Return a row for every decision; without a report nothing has been measured yet."""
    outcomes = {} if report is None else {outcome.decision.setting: outcome for outcome in report.outcomes}
    return tuple(_row(each, outcomes.get(each.setting), report) for each in plan.decisions)


def _row(decision: Decision, outcome: Outcome | None, report: PlanReport | None) -> PlanRow:
    chosen = table.get(decision.setting, decision.chosen).title
    is_cheaper = decision.chosen != decision.dearest
    instead = f"instead of {table.get(decision.setting, decision.dearest).title}" if is_cheaper else ""
    if not is_cheaper:
        instead = (
            "kept: cheaper methods are too inaccurate" if decision.is_needed else "nothing cheaper will do"
        )
    verdict = Verdict.OPEN
    if outcome is not None:
        verdict = Verdict.HELD if outcome.is_right else Verdict.WRONG
    return PlanRow(
        decision.setting,
        family_title(decision.setting),
        chosen,
        instead,
        decision.reason,
        _numbers(decision, outcome, report) if is_cheaper else "",
        verdict,
        decision.is_needed,
        outcome is not None,
    )


def _numbers(decision: Decision, outcome: Outcome | None, report: PlanReport | None) -> str:
    """Return the predicted and the measured error, and what the choice saves by itself."""
    predicted = f"predicted {in_bytes(decision.predicted_error)}"
    if decision.predicted_pixels:
        predicted += f" except for {counted(decision.predicted_pixels, 'pixel')}"
    if outcome is None or report is None:
        return predicted
    measured = f"measured {in_bytes(outcome.measured_error)}"
    if outcome.measured_pixels:
        measured += f", {counted(outcome.measured_pixels, 'pixel')} beyond"
    lines = [predicted, measured]
    if len(outcome.seconds):
        alone, everything = float(np.median(outcome.seconds)), float(np.median(report.seconds_everything))
        lines.append(f"time alone {time_text(alone)} ({alone / everything:.0%} of the reference)")
    return "\n".join(lines)


def headline(plan: Plan, report: PlanReport | None, *, is_measuring: bool = False) -> str:
    """Return in one sentence what the plan comes to."""
    if report is None:
        end = "Measuring …" if is_measuring else "Analyse (F5) measures it."
        return f"Predicted: at most {in_bytes(plan.predicted_error)} off{predicted_time(plan, ', ')}. {end}"
    everything, chosen = (
        float(np.median(each)) for each in (report.seconds_everything, report.seconds_chosen)
    )
    within = "Within the tolerance" if report.is_within else "Beyond the tolerance"
    ratio = everything / chosen
    speed = f"{digits(ratio)} times as fast as" if ratio >= 1 else f"{digits(1 / ratio)} times as slow as"
    return f"{within}, {speed} the reference settings: {time_text(chosen)} instead of {time_text(everything)}"


def predicted_time(plan: Plan, start: str) -> str:
    """Return after ``start`` what pictures were predicted to take; nothing if nothing was timed."""
    if plan.predicted_seconds is None or plan.predicted_everything is None:
        return ""
    return f"{start}{time_text(plan.predicted_seconds)} instead of {time_text(plan.predicted_everything)}"


def details(plan: Plan, report: PlanReport) -> str:
    """Return what the reference is, the largest difference, the pixels beyond, and every prediction that was wrong."""
    parts = [
        REFERENCE,
        f"Largest difference {in_bytes(report.largest_error)}, predicted at most {in_bytes(plan.predicted_error)}; "
        f"{counted(report.pixels_beyond, 'pixel')} beyond {plan.tolerance.bytes}/255, "
        f"{plan.tolerance.pixels:,} allowed.",
    ]
    time = predicted_time(plan, "Predicted from smaller pictures: ")
    if time:
        parts.append(f"{time}.")
    wrong = [outcome for outcome in report.outcomes if not outcome.is_right]
    for outcome in wrong:
        parts.append(f"A prediction was wrong: {family_title(outcome.decision.setting)}, {outcome.text}.")
    if report.fallen_back:
        names = joined([family_title(name) for name in report.fallen_back])
        parts.append(f"The first plan was beyond the tolerance when measured. Restored: {names}.")
    changed = [
        f"{family_title(each.setting)}: {table.get(each.setting, each.chosen).title}"
        for each in plan.decisions
        if each.chosen != each.dearest and each.setting not in report.fallen_back
    ]
    parts.append(f"Changed: {'; '.join(changed)}." if changed else "Nothing is changed.")
    needed = [family_title(each.setting) for each in plan.decisions if each.is_needed]
    kept = f"Kept because cheaper methods are too inaccurate: {joined(needed)}."
    parts.append(kept if needed else "Nothing expensive is needed.")
    return " ".join(parts)


def applied_text(before: Settings, after: Settings) -> str:
    """Return which methods a plan has put in the place of which others."""
    changes = before.differences(after)
    parts = [
        f"{family_title(name)}: {_method_title(name, value)} instead of {_method_title(name, getattr(before, name))}"
        for name, value in changes.items()
    ]
    return f"Applied. {'; '.join(parts)}."


def _method_title(family: str, value: str | int) -> str:
    return table.get(family, value).title if isinstance(value, str) else str(value)


def findings_html(findings: Findings) -> str:
    """Return the facts as a table, as rich text."""
    rows = (
        f"<tr><td>{escape(fact.title)}&nbsp;&nbsp;</td><td align='right'>{escape(fact.text)}</td></tr>"
        for fact in findings.facts
    )
    return f"<table width='100%' cellspacing='2'>{''.join(rows)}</table>"


def advice_html(tessellations: tuple[Tessellation, ...], corner_count: int) -> str:
    """Return the advice on how fine meshes are, as rich text."""
    if not tessellations:
        return f"Separate {nouns(corner_count).many} do not describe a smooth surface."
    return "".join(f"<p style='margin:2px 0'>{escape(each.text)}</p>" for each in tessellations)
