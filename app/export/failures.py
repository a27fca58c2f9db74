"""Where methods fail, as text: one map of characters for every method, and a failing case made small."""

from pathlib import Path

import numpy as np

from app.files.file_access import write_file
from app.files.state_files import EXTENSION, State, save_state
from app.pages.words import digits, time_text
from app.session.document import document_at
from core.study.cases import Atlas, StabilityMap
from core.study.record import Axis, Outcome
from core.study.stability import count_outcomes
from core.study.stress import Shrunk

# A stability experiment as text: one map of characters for every method, with a legend and the counts.


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


# A failing case that was made small as files: a scene that opens in the window, and a Python test.


TEST_ENDING = ".py"


def shrunk_name(experiment: str, method: str) -> str:
    """Return what the files of a case are called, without an ending."""
    return f"{experiment}-{'-'.join(part.partition('=')[2] for part in method.split())}"


def save_shrunk(path: Path, shrunk: Shrunk, title: str) -> None:
    """Write a case as a Python test (``.py``) or as a state file (``.rasterscope``).

    Raises OSError or ValueError if it cannot be written, or for another ending; the message is one sentence.
    """
    if path.suffix == TEST_ENDING:
        write_file(path, shrunk.test.encode())
    elif path.suffix == EXTENSION:
        opening = shrunk.opening
        save_state(path, State(document_at(opening, title), opening.stage, pin=opening.pixel))
    else:
        raise ValueError(f"the file must end in {EXTENSION} or {TEST_ENDING}, got {path.name}")


def export_shrunk(shrunk: Shrunk, experiment: str, method: str, folder: Path) -> list[Path]:
    """Write a case into a folder as a Python test and as a state file; files of the same name are replaced.

    Raises OSError if a file cannot be written; the message is one sentence.
    """
    name = shrunk_name(experiment, method)
    paths = [folder / f"test_{name}{TEST_ENDING}".replace("-", "_"), folder / f"{name}{EXTENSION}"]
    for path in paths:
        save_shrunk(path, shrunk, f"{experiment}: {method}")
    return paths
