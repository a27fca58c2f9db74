"""Questions about a run that is stepped: which pixels are covered, or what the next step gives."""

from fractions import Fraction

import numpy as np

from core.explain import question
from core.raster.pixel_runs import Raster
from core.records.words import counted
from core.trace import StageTrace
from lessons.exercises.answers.answer import Answer
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.answers.fields import NumberAnswer
from lessons.exercises.answers.pixels import NothingToMarkError, Pixel, PixelAnswer, Pixels
from lessons.exercises.question import Draft

TOLERANCE = 0.01
"""Relative error of a number that still counts as right."""
SMALLEST = 1e-9
"""Error of a number near 0 that still counts as right."""
COVERAGE = (
    "Click the covered pixels in the grid: each is checked at once. "
    "Or press Right to be asked about one pixel at a time."
)


def next_draft(trace: StageTrace, raster: Raster, position: int) -> Draft | None:
    """Ask about what comes after a position of a stage: its coverage as a whole, or its next row.

    Returns
    -------
    Draft or None
        ``None``: the stage is done, or its next row needs no prediction.
    """
    if position == 0 and trace.stage == "raster":
        asked = coverage_draft(trace, raster)
        if asked is not None:
            return asked
    row = trace.steps.rows_done(position)
    return row_draft(trace, row) if row < trace.steps.row_count else None


def row_draft(trace: StageTrace, row: int) -> Draft | None:
    """Ask about a row of a stage; ``None`` where there is nothing to predict."""
    asked = question(trace, row)
    if asked is None:
        return None
    answer: Answer
    if asked.choices:
        answer, text = ChoiceAnswer(asked.choices, frozenset({int(asked.answer)})), asked.text
    else:
        tolerance = max(TOLERANCE * abs(asked.answer), SMALLEST)
        answer = NumberAnswer((Fraction(asked.answer),), tolerance=tolerance)
        text = f"{asked.text} (within {TOLERANCE:.0%})".replace("%", " %")
    column, line = (int(number) for number in trace.pixel[row])
    pixel = (column, line) if column >= 0 else None
    return Draft(text, "", answer, pixel=pixel, reveal=asked.reveal)


def coverage_draft(trace: StageTrace, raster: Raster) -> Draft | None:
    """Ask for the covered pixels of a raster stage, counted from its first; ``None`` where none or all are."""
    rows, columns = raster.shape
    covered = np.zeros((rows, columns), bool)
    pixels = trace.pixel[trace.marks["covered"] & (trace.pixel[:, 0] >= 0)]
    covered.ravel()[raster.index(pixels[:, 0], pixels[:, 1])] = True
    try:
        answer = PixelAnswer(
            (columns, rows), frozenset((column, row) for row, column in np.argwhere(covered).tolist())
        )
    except NothingToMarkError:
        return None
    return Draft(COVERAGE, "", answer)


def pixel_sentence(answer: PixelAnswer, pixel: Pixel, raster: Raster) -> str:
    """Say whether a pixel that was clicked is covered."""
    first_column, first_row, _, _ = raster.bounds
    said = "covered" if pixel in answer.reference else "not covered"
    return f"({pixel[0] + first_column}, {pixel[1] + first_row}) is {said}."


def coverage_sentence(answer: PixelAnswer, clicked: Pixels) -> str:
    """Say how the clicked pixels compare with the covered ones."""
    marks = answer.check(clicked).marks
    right, missing, extra = (len(marks[name]) for name in ("right", "missing", "extra"))
    covered = counted(right + missing, "covered pixel")
    return f"{right} of {covered} right (tick), {extra} extra (cross), {missing} missing (square)."
