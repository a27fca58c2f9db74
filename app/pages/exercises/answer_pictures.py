"""What is drawn of an answer: the raster it is given on, its picture while it is given, and its marks."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.pages.exercises.scene_outline import scene_outline
from core import render
from core.framebuffer.display import to_display
from core.records.cells import Marks
from core.records.frame import Frame
from core.records.sketch import Place
from lessons.exercises.answers.answer import Response, Verdict
from lessons.exercises.answers.code import CodeAnswer
from lessons.exercises.answers.fields import NumberAnswer
from lessons.exercises.answers.pixels import PixelAnswer
from lessons.exercises.answers.places import PlaceAnswer
from lessons.exercises.answers.spots import SpotAnswer
from lessons.exercises.answers.trials import BreakAnswer
from lessons.exercises.drawn_scene import frame_art
from lessons.exercises.numbers import read_number
from lessons.exercises.question import Draft, Question
from widgets.grid.buffer import GridBuffer
from widgets.grid.geometry import GridGeometry
from widgets.grid.overlay import Mark, MaskOverlay, Overlay

FARTHEST = 100.0
"""Farthest coordinate that a sketch of the plane shows."""


@dataclass(frozen=True, eq=False)
class Live:
    """What is drawn of an answer while it is given."""

    outline: GridGeometry | None
    picture: GridBuffer | None = None
    overlays: Sequence[Overlay] = ()


def size_of(draft: Draft) -> tuple[int, int] | None:
    """Return columns and rows of the picture, whose cells may be blocks; ``None``: the question has none."""
    answer = draft.answer
    if isinstance(answer, PixelAnswer | SpotAnswer | PlaceAnswer):
        return answer.size
    if isinstance(answer, CodeAnswer) and answer.picture is not None:
        rows, columns = answer.picture.primitive.shape
        return columns, rows
    if isinstance(answer, BreakAnswer):
        return answer.scene_of(answer.start).size
    return None if draft.scene is None else draft.scene.size


def shown_frame(draft: Draft) -> Frame | None:
    """Return the picture that the question gives as text; ``None``: it gives none."""
    answer = draft.answer
    if isinstance(answer, SpotAnswer | CodeAnswer):
        return answer.picture
    if not isinstance(answer, PlaceAnswer) or answer.scene_of is None or answer.is_right is None:
        return None
    frame = render(answer.scene_of(answer.reference), draft.settings)
    return frame if frame_art(frame) in draft.given else None


def numbers_of(draft: Draft) -> str:
    """Return the numbers of a question as text, but for the picture that the grid shows."""
    frame = shown_frame(draft)
    return draft.given if frame is None else draft.given.replace(frame_art(frame), "").strip("\n")


def place_of(draft: Draft, given: Any) -> Place | None:
    """Return the point of the plane that is in the form; ``None``: it is none, or not typed yet."""
    answer = draft.answer
    if not isinstance(answer, NumberAnswer) or answer.names != ("x", "y"):
        return None
    try:
        x, y = (float(read_number(text)) for (text,) in given)
    except ValueError:
        return None
    return (x, y) if max(abs(x), abs(y)) <= FARTHEST else None


def is_live(draft: Draft) -> bool:
    """Return whether an answer is drawn while it is given."""
    answer = draft.answer
    return isinstance(answer, BreakAnswer) or (
        isinstance(answer, PlaceAnswer) and answer.scene_of is not None
    )


def live(draft: Draft, response: Response | None) -> Live:
    """Return what is drawn of a response, or before there is one.

    Of points, the outlines over the picture that is to be covered; of dials, the picture of the weak method, marked
    where the other one draws another or it draws twice.
    """
    answer = draft.answer
    if isinstance(answer, PlaceAnswer):
        assert answer.scene_of is not None
        frame = shown_frame(draft)
        picture = None if frame is None else coverage_of(frame, "to be covered")
        return Live(None if response is None else scene_outline(answer.scene_of(response)), picture)
    assert isinstance(answer, BreakAnswer)
    scene = answer.scene_of(answer.start if response is None else response)
    weak, robust = render(scene, answer.weak), render(scene, answer.robust)
    differs = np.asarray(weak.primitive != robust.primitive)
    overlays = (
        MaskOverlay("differs", Mark.DIFFERENCE, differs, title="the other method draws otherwise"),
        MaskOverlay("double", Mark.DOUBLE, np.asarray(weak.cover_count > 1), title="drawn twice"),
    )
    return Live(scene_outline(scene), coverage_of(weak, "weak method"), overlays)


def marks_of(question: Question, verdict: Verdict) -> Marks:
    """Return the marks; where one primitive's pixels are asked, an extra one that another covers is double."""
    marks, draft, scene = verdict.marks, question.draft, question.draft.scene
    asks_coverage = isinstance(draft.answer, PixelAnswer) and question.template.stage == "raster"
    if not asks_coverage or not marks["extra"] or scene is None or scene.size != size_of(draft):
        return marks
    primitive = render(scene, draft.settings).primitive
    asked = {int(primitive[row, column]) for column, row in draft.answer.reference}
    if len(asked) != 1:
        return marks
    is_other = (primitive >= 0) & (primitive != asked.pop())
    double = {(column, row) for column, row in marks["extra"] if is_other[row, column]}
    return {**marks, "extra": frozenset(marks["extra"]) - double, "double": frozenset(double)}


def are_marks_shown(draft: Draft, *, is_right: bool, is_first: bool) -> bool:
    """Return whether marks are shown: those of a first answer in pixels would tell the whole solution."""
    return is_right or not (is_first and isinstance(draft.answer, PixelAnswer))


def coverage_of(frame: Frame, title: str) -> GridBuffer:
    """Return what a frame covers: its primitives where it has several, else where anything is."""
    primitive = frame.primitive
    if int(primitive.max(initial=-1)) > 0:
        return GridBuffer("picture", primitive, "ids", title=title)
    return GridBuffer("picture", primitive >= 0, "bool", title=title)


def picture_of(frame: Frame) -> GridBuffer:
    """Return the colours of a frame, or the pixels it covers where all have one colour."""
    colors = frame.color[frame.primitive >= 0]
    if len(colors) and (colors != colors[0]).any():
        return GridBuffer("picture", to_display(frame.color).pixels, "color", title="the picture")
    return coverage_of(frame, "the picture")
