"""Answers on the picture: marked pixels, and what is wrong with a picture."""

import re
from functools import partial

import numpy as np

from app.pages.exercises.answer_kind import AnswerKind, coverage_of
from core import render
from core.framebuffer.display import to_display
from core.records.frame import Frame
from lessons.exercises.answers.answer import Response, Verdict
from lessons.exercises.answers.pixels import PixelAnswer
from lessons.exercises.answers.spots import Spot, SpotAnswer
from lessons.exercises.drawn_scene import frame_art
from lessons.exercises.question import Draft, Question
from widgets.exercises.records import PixelForm, PixelMarks, SpotForm, SpotMarks
from widgets.grid.buffer import GridBuffer

_RUN = re.compile(r"\s*(\d{1,3})(?:\s*[-–]\s*(\d{1,3}))?\s*", re.ASCII)


def read_columns(columns: int, text: str) -> frozenset[int]:
    """Return the columns of a text such as ``3-7, 9``; ValueError where it means nothing."""
    found: set[int] = set()
    for part in text.split(",") if text.strip() else ():
        run = _RUN.fullmatch(part)
        if run is None:
            raise ValueError(f"expected columns such as 3-7, 9; got {part.strip()[:20]!a}")
        first, last = int(run[1]), int(run[2] or run[1])
        if first > last:
            raise ValueError(f"expected the smaller column first, got {part.strip()}")
        if last >= columns:
            raise ValueError(f"expected columns from 0 to {columns - 1}, got {part.strip()}")
        found.update(range(first, last + 1))
    return frozenset(found)


class PixelKind(AnswerKind):
    """Marks on the picture."""

    def form(self, answer: PixelAnswer) -> PixelForm:
        """Return the raster."""
        return PixelForm(answer.size, answer.noun, partial(read_columns, answer.size[0]))

    def given(self, answer: PixelAnswer, response: Response) -> list[list[int]]:
        """Return the marked pixels."""
        del answer
        return sorted(map(list, response))

    def marks(self, question: Question, response: Response, verdict: Verdict) -> PixelMarks:
        """Return the marks; where one primitive's pixels are asked, an extra one that another covers is double."""
        del response
        marks, draft, scene = verdict.marks, question.draft, question.draft.scene
        double: frozenset[tuple[int, int]] = frozenset()
        asks_coverage = question.template.stage == "raster" and marks["extra"]
        if asks_coverage and scene is not None and scene.size == self.size(draft):
            primitive = render(scene, draft.settings).primitive
            asked = {int(primitive[row, column]) for column, row in draft.answer.reference}
            if len(asked) == 1:
                is_other = (primitive >= 0) & (primitive != asked.pop())
                double = marks["extra"] & {(column, row) for row, column in np.argwhere(is_other).tolist()}
        return PixelMarks(marks["right"], marks["missing"], marks["extra"] - double, double)

    def size(self, draft: Draft) -> tuple[int, int]:
        """Return the raster of the answer: its cells may be blocks."""
        answer = draft.answer
        assert isinstance(answer, PixelAnswer)
        return answer.size


class SpotKind(AnswerKind):
    """Marks on a picture with a mistake, and options."""

    def form(self, answer: SpotAnswer) -> SpotForm:
        """Return the picture and the options."""
        pixels = PixelForm(answer.size, "pixels", partial(read_columns, answer.size[0]))
        return SpotForm(pixels, picture_of(answer.picture), answer.options)

    def given(self, answer: SpotAnswer, response: Spot) -> dict[str, object]:
        """Return the pixels and the option."""
        option = "" if response.option is None else answer.options[response.option]
        return {"pixels": sorted(map(list, response.pixels)), "option": option}

    def marks(self, question: Question, response: Spot, verdict: Verdict) -> SpotMarks:
        """Return which pixels differ and which do not."""
        marks = verdict.marks
        is_named = marks["option"] if response.option is not None else None
        return SpotMarks(PixelMarks(marks["right"], extra=marks["extra"]), is_named)

    def numbers(self, draft: Draft) -> str:
        """Return the numbers without the picture."""
        answer = draft.answer
        assert isinstance(answer, SpotAnswer)
        return draft.given.replace(frame_art(answer.picture), "").strip("\n")

    def size(self, draft: Draft) -> tuple[int, int]:
        """Return the raster of the picture."""
        answer = draft.answer
        assert isinstance(answer, SpotAnswer)
        return answer.size


def picture_of(frame: Frame) -> GridBuffer:
    """Return the colours of a frame, or the pixels it covers where all have one colour."""
    colors = frame.color[frame.primitive >= 0]
    if len(colors) and (colors != colors[0]).any():
        return GridBuffer("picture", to_display(frame.color).pixels, "color", title="the picture")
    return coverage_of(frame, "the picture")
