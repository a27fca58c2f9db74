"""``rasterscope slides``: the lectures' slides with numbers and listings, and whether they still come out."""

import argparse
import textwrap
from math import isnan
from typing import Any

from app.usage import UsageError
from core.records.listing import listing
from lessons.lectures.catalogue import NUMBERS, PRINTED, printed_listing
from lessons.lectures.printed import PrintedListing, first_divergence
from lessons.lectures.scenes import LECTURES

DESCRIPTION = """List the slides of the four lectures that have numbers or listings, or show one listing as printed.
Where a slide has a formula only, its number is the value at the points named."""
EXAMPLES = """examples:
  rasterscope slides
  rasterscope slides --check
  rasterscope slides pellacini-bresenham
  rasterscope slides lmu-naive --ends 0 0 6 5
"""
EXAMPLE = {True: (0, 0, 5, 2), False: (0, 0, 5, -2)}
"""Ends at which a line listing is compared where none are given, by whether it is printed for rising lines."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("listing", metavar="LISTING", nargs="?", help="show this listing as printed")
    parser.add_argument(
        "--ends",
        nargs=4,
        type=int,
        metavar=("X0", "Y0", "X1", "Y1"),
        help="pixels of the ends at which a line listing is compared with the right method",
    )
    parser.add_argument(
        "--check", action="store_true", help="compute every number again; exit 1 if one has changed"
    )


def run(options: argparse.Namespace) -> int:
    """Write the slides, the check, or one listing."""
    if options.check and options.listing:
        raise UsageError("argument --check: checks all slides, name no listing")
    if options.ends and not options.listing:
        raise UsageError("argument --ends: needs the name of a line listing")
    if options.check:
        return check()
    print(listing_text(printed_listing(options.listing), options.ends) if options.listing else slides_text())
    return 0


def slides_text() -> str:
    """Return the slides, lecture by lecture."""
    lines = []
    for lecture, title in LECTURES.items():
        lines += [title]
        slides = dict.fromkeys(number.slide for number in NUMBERS if number.lecture == lecture)
        slides |= dict.fromkeys(printed.slide for printed in PRINTED if printed.lecture == lecture)
        for slide in slides:
            count = sum(number.lecture == lecture and number.slide == slide for number in NUMBERS)
            names = [each.name for each in PRINTED if (each.lecture, each.slide) == (lecture, slide)]
            what = [f"{count} number{'s' * (count > 1)}"] * (count > 0)
            what += [f"listing{'s' * (len(names) > 1)} {', '.join(names)}"] * (len(names) > 0)
            lines.append(f"  {slide}: {', '.join(what)}")
    return "\n".join(lines)


def check() -> int:
    """Compute every number again, write a line for each, and return 1 if a verdict is not as recorded."""
    changed = 0
    lecture = ""
    for number in NUMBERS:
        if number.lecture != lecture:
            lecture = number.lecture
            print(LECTURES[lecture])
        ours = number.compute()
        verdict = number.verdict(ours)
        changed += verdict != number.recorded_verdict
        print(f"  {verdict:<8}{number.slide} | {number.what} | {shown(number.number)} | {shown(ours)}")
    verdicts = [number.recorded_verdict for number in NUMBERS]
    counts = ", ".join(f"{verdicts.count(name)} {meaning}" for name, meaning in VERDICTS.items())
    print(f"{len(NUMBERS)} numbers: {counts}; {changed} changed")
    return int(changed > 0)


VERDICTS = {
    "agrees": "agree with the slide",
    "slip": "are slips of the slide",
    "counted": "were counted with what the slide prints",
}
"""What each recorded verdict means."""


def shown(value: Any) -> str:
    """Return a number of a slide as a person reads it."""
    if isinstance(value, tuple):
        return f"({', '.join(map(shown, value))})"
    if isinstance(value, bool) or value is None:
        return {True: "yes", False: "no", None: "none"}[value]
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def listing_text(printed: PrintedListing, ends: list[int] | None) -> str:
    """Return a listing as printed, as it runs, and where it leaves the right method."""
    lines = [f"{printed.title}, {LECTURES[printed.lecture]}, slide {printed.slide}", ""]
    lines += [textwrap.indent(printed.text, "  "), ""]
    if printed.note:
        lines += [f"Note: {printed.note}", ""]
    if printed.registered:
        lines.append(f"It is the method {printed.family}={printed.registered}.")
    if printed.right:
        lines.append(f"Right: {printed.family}={printed.right}.")
    if printed.rule is None:
        if ends:
            raise UsageError(f"argument --ends: {printed.name} is no line listing")
        return "\n".join(lines).rstrip()
    x0, y0, x1, y1 = ends or EXAMPLE[printed.rule.rises]
    if not (x0 < x1 and abs(y1 - y0) <= x1 - x0 and (y1 >= y0 if printed.rule.rises else y1 <= y0)):
        slopes = "0 to 1" if printed.rule.rises else "-1 to 0"
        raise UsageError(f"argument --ends: {printed.name} is printed for x0 < x1 and slopes from {slopes}")
    for reading, function in printed.readings.items():
        lines += ["", f"Read {reading}:", textwrap.indent(listing(function).source.rstrip(), "  ")]
        found = first_divergence(function, printed.right, (x0, y0, x1, y1))
        where = f"({x0}, {y0})-({x1}, {y1})"
        if found is None:
            lines.append(f"On {where} it draws the pixels of {printed.right}.")
        else:
            both = f"it draws {pixel_text(found.printed)}, {printed.right} {pixel_text(found.right)}"
            lines.append(f"On {where} they differ first at step {found.step}: {both}.")
    return "\n".join(lines)


def pixel_text(pixel: tuple[int, int, float] | None) -> str:
    """Return a pixel and the decision that chose it."""
    if pixel is None:
        return "nothing"
    column, row, decision = pixel
    chosen = "" if isnan(decision) else f", chosen by {decision:.6g}"
    return f"({column}, {row}){chosen}"
