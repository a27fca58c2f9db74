"""A stability experiment as text: one map of characters for every method, with a legend and the counts."""

import numpy as np

from app.pages.words import digits, time_text
from core.study.stability import Atlas, Axis, Outcome, StabilityMap, count_outcomes

MARKS = {
    Outcome.RIGHT: ".",
    Outcome.HOLE: "o",
    Outcome.DOUBLE_HIT: "2",
    Outcome.WRONG_ORDER: "<",
    Outcome.NOT_A_NUMBER: "N",
    Outcome.OVERFLOW: "V",
    Outcome.WRONG_PICTURE: "x",
    Outcome.REFUSED: "-",
}
"""What stands for an outcome in a map."""
WORDS = {
    Outcome.RIGHT: "right",
    Outcome.HOLE: "hole",
    Outcome.DOUBLE_HIT: "drawn twice or outside",
    Outcome.WRONG_ORDER: "farther one visible",
    Outcome.NOT_A_NUMBER: "not a number",
    Outcome.OVERFLOW: "overflow",
    Outcome.WRONG_PICTURE: "wrong picture",
    Outcome.REFUSED: "refused, with a reason",
}


def atlas_text(atlas: Atlas) -> list[str]:
    """Return the maps of all methods, the second axis up, and below them the legend and the counts."""
    info = atlas.experiment
    lines = [info.title, info.question, ""]
    for each in atlas.maps:
        lines += [each.method, *map_text(each), ""]
    lines += [axis_text("across", info.axes[0])]
    if len(info.axes) > 1:
        lines.append(axis_text("up", info.axes[1]))
    seen = [outcome for outcome in Outcome if any(each.count(outcome) for each in atlas.maps)]
    lines += ["  ".join(f"{MARKS[outcome]} {WORDS[outcome]}" for outcome in seen), "", *counts_text(atlas)]
    return [*lines, "", f"Claim: {info.claim}"]


def map_text(each: StabilityMap) -> list[str]:
    """Return the rows of one map from the top, a character for each cell."""
    return ["    " + "".join(MARKS[Outcome(value)] for value in row) for row in each.outcome[::-1].tolist()]


def axis_text(direction: str, axis: Axis) -> str:
    """Return what runs in one direction, from where to where."""
    unit = f" {axis.unit}" if axis.unit else ""
    return f"{direction}: {axis.title}, {digits(axis.values[0])} to {digits(axis.values[-1])}{unit}"


def _times(each: StabilityMap) -> str:
    """Return the shortest and the longest run of a map that was timed."""
    seconds = each.seconds[~np.isnan(each.seconds)]
    return f"; {time_text(seconds.min())} to {time_text(seconds.max())} a run" if seconds.size else ""


def counts_text(atlas: Atlas) -> list[str]:
    """Return how many cells of each method ended in which way."""
    width = max(len(each.method) for each in atlas.maps)
    return [
        f"{method.ljust(width)}  "
        + ", ".join(f"{count} {WORDS[Outcome[name]]}" for name, count in counts.items())
        + _times(each)
        for each, (method, counts) in zip(atlas.maps, count_outcomes(atlas).items(), strict=True)
    ]
