"""``rasterscope plan``: the cheapest methods that a scene needs, why, and what they were measured to do."""

import argparse

import numpy as np

from app.cli.arguments import FILE_HELP, add_settings, add_size, chosen_settings, open_file, sized
from app.cli.commands import MOST_ROUNDS, add_allow_outside, whole_number
from app.cli.study import aligned
from app.usage import UsageError
from core import Settings
from core.study.planner.measuring import ROUNDS, plan_and_check
from core.study.planner.records import PlanReport, Tolerance

DESCRIPTION = """Try cheaper methods at every stage and choose the cheapest whose error stays within a tolerance.
The error is the difference from the reference settings (16 samples a pixel, each lit and textured). The plan is
then measured."""
EXAMPLES = """examples:
  rasterscope plan teapot.obj
  rasterscope plan cube --tolerance 8 --pixels 500 --size 640x480

At most N pixels (--pixels) may differ by more than C (--tolerance, in 1/255 of the display's sRGB). A choice that is
measured to be too inaccurate is withdrawn.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    add_allow_outside(parser)
    parser.add_argument(
        *("--tolerance", "-t"),
        metavar="C",
        type=float,
        default=2.0,
        help="largest allowed colour difference, in 1/255 (2); 0 without --pixels is exact",
    )
    parser.add_argument(
        "--pixels", metavar="N", type=int, default=0, help="pixels that may differ by more (0)"
    )
    add_size(parser)
    parser.add_argument(
        "--rounds",
        metavar="N",
        type=whole_number(1, MOST_ROUNDS),
        default=ROUNDS,
        help=f"timed drawings ({ROUNDS})",
    )
    add_settings(parser, "what to draw, not its quality: wrap, polygon_mode, pixel_center, shading=unlit ...")


def run(options: argparse.Namespace) -> int:
    """Plan, measure and print."""
    try:
        tolerance = Tolerance(options.tolerance, options.pixels)
    except ValueError as problem:
        raise UsageError(str(problem)) from problem
    opened = open_file(options)
    scene, settings = sized(opened.document.scene, options), Settings()
    if opened.state is not None:
        settings = opened.document.settings
    report = plan_and_check(scene, tolerance, chosen_settings(settings, options.set), options.rounds)
    print("\n".join(report_text(report)))
    return 0


def report_text(report: PlanReport) -> list[str]:
    """Return what is printed of one plan: what was seen, chosen, predicted and measured."""
    chosen = report.plan
    lines = [f"{fact.title}: {fact.text}" for fact in chosen.findings.facts]
    measured = {outcome.decision.setting: outcome for outcome in report.outcomes}
    rows = [["setting", "chosen", "instead of", "predicted", "measured"]]
    for decision in chosen.decisions:
        if decision.setting in measured:
            prediction = f"{decision.predicted_error:.3g}/255"
            if decision.predicted_pixels:
                prediction += f", {decision.predicted_pixels:,} px"
            found = f"{measured[decision.setting].measured_error:.3g}/255"
            rows.append([decision.setting, decision.chosen, decision.dearest, prediction, found])
        else:
            rows.append([decision.setting, decision.chosen, "kept" if decision.is_needed else "", "", ""])
    lines += ["", *aligned(rows), ""]
    lines += [f"{decision.setting}: {decision.reason}" for decision in chosen.decisions]
    lines += ["", *(each.text for each in chosen.tessellations)]
    lines += [
        f"{outcome.decision.setting} {outcome.decision.chosen}: {outcome.text}."
        for outcome in report.outcomes
        if not outcome.is_right
    ]
    if report.fallen_back:
        lines.append(
            f"Restored because the first plan was beyond the tolerance: {', '.join(report.fallen_back)}."
        )
    times = [1000 * float(np.median(each)) for each in (report.seconds_everything, report.seconds_chosen)]
    lines.append(
        f"Reference settings {times[0]:,.4g} ms, chosen {times[1]:,.4g} ms, "
        f"analysis {1000 * chosen.findings.seconds:,.4g} ms."
    )
    if chosen.predicted_everything is not None and chosen.predicted_seconds is not None:
        predicted = [1000 * each for each in (chosen.predicted_everything, chosen.predicted_seconds)]
        lines.append(
            f"Predicted from smaller pictures: reference settings {predicted[0]:,.4g} ms, "
            f"chosen {predicted[1]:,.4g} ms."
        )
    return [*lines, report.text]
