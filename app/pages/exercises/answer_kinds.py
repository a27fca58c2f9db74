"""What each type of answer is on the page: the form that takes it, what is in the form, and its marks."""

import re
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from core import render
from lessons.exercises.answers.amounts import NumberAnswer, read_entry
from lessons.exercises.answers.answer import NotCheckedError, Response, Verdict
from lessons.exercises.answers.choices import ChoiceAnswer, OrderAnswer
from lessons.exercises.answers.pixels import PixelAnswer
from lessons.exercises.answers.tables import TableAnswer, cell_text
from lessons.exercises.numbers import Number, number_text
from lessons.exercises.question import Question
from widgets.exercises.records import (
    AnswerForm,
    AnswerMarks,
    ChoiceForm,
    FieldForm,
    FieldMarks,
    ItemMarks,
    OrderForm,
    PixelForm,
    PixelMarks,
    Understood,
)

_RUN = re.compile(r"\s*(\d{1,3})(?:\s*[-–]\s*(\d{1,3}))?\s*", re.ASCII)


class AnswerKind:
    """How one type of answer is given and marked."""

    def form(self, answer: Any) -> AnswerForm:
        """Return the form that takes an answer."""
        raise NotImplementedError

    def given(self, answer: Any, response: Response) -> object:
        """Return what is in the form where it says a response."""
        raise NotImplementedError

    def read(self, answer: Any, given: Any) -> object:
        """Return what the answer reads of what is in the form."""
        del answer
        return given

    def marks(self, question: Question, response: Response, verdict: Verdict) -> AnswerMarks:
        """Return what is right in a response, and what is not."""
        raise NotImplementedError


def read_columns(columns: int, text: str) -> frozenset[int]:
    """Return the columns of a text such as ``3-7, 9``; ValueError where it means nothing."""
    found: set[int] = set()
    for part in text.split(",") if text.strip() else ():
        run = _RUN.fullmatch(part)
        if run is None:
            raise ValueError(f"expected columns such as 3-7, 9; got {part.strip()[:20]!r}")
        first, last = int(run[1]), int(run[2] or run[1])
        if not first <= last < columns:
            raise ValueError(f"expected columns from 0 to {columns - 1}, got {part.strip()}")
        found.update(range(first, last + 1))
    return frozenset(found)


def plain_number(value: Number) -> str:
    """Return a number as somebody would type it."""
    return str(value) if isinstance(value, Fraction) else f"{value:.6g}"


def understood(read: Callable[[str], str], text: str) -> Understood:
    """Return how a text is read, or why it means nothing."""
    try:
        return Understood(read(text), is_readable=True)
    except NotCheckedError as problem:
        return Understood(str(problem), is_readable=False)


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
        """Return the marks; an extra pixel that another primitive covers is double."""
        del response
        marks, scene = verdict.marks, question.draft.scene
        double: frozenset[tuple[int, int]] = frozenset()
        size = getattr(question.draft.answer, "size", None)
        if marks["extra"] and scene is not None and scene.size == size:
            is_covered = render(scene, question.draft.settings).primitive >= 0
            double = marks["extra"] & {(column, row) for row, column in np.argwhere(is_covered).tolist()}
        return PixelMarks(marks["right"], marks["missing"], marks["extra"] - double, double)


class NumberKind(AnswerKind):
    """One field for each number: in rows as a matrix has them, else one below the other."""

    def form(self, answer: NumberAnswer) -> FieldForm:
        """Return the fields."""

        def understand(column: int, text: str) -> Understood:
            return understood(lambda text: number_text(read_entry(text)), text)

        if len(answer.shape) == 2:
            labels = tuple(f"row {number}" for number in range(answer.shape[0]))
            return FieldForm(("",) * answer.shape[1], labels, understand)
        return FieldForm(("",), answer.names or ("",) * len(answer.reference), understand)

    def _columns(self, answer: NumberAnswer) -> int:
        return answer.shape[1] if len(answer.shape) == 2 else 1

    def given(self, answer: NumberAnswer, response: Response) -> list[list[str]]:
        """Return the numbers as texts."""
        texts, columns = [plain_number(number) for number in response], self._columns(answer)
        return [texts[place : place + columns] for place in range(0, len(texts), columns)]

    def read(self, answer: NumberAnswer, given: list[list[str]]) -> object:
        """Return the texts in the shape of the answer; of empty fields, nothing."""
        if not any(text.strip() for row in given for text in row):
            return ""
        if len(answer.shape) == 2:
            return given
        return [row[0] for row in given] if answer.shape else given[0][0]

    def marks(self, question: Question, response: Response, verdict: Verdict) -> FieldMarks:
        """Return the wrong fields."""
        del response
        answer = question.draft.answer
        assert isinstance(answer, NumberAnswer)
        return FieldMarks(frozenset(divmod(place, self._columns(answer)) for place in verdict.marks["wrong"]))


class TableKind(AnswerKind):
    """A field for each cell."""

    def form(self, answer: TableAnswer) -> FieldForm:
        """Return the fields."""

        def understand(column: int, text: str) -> Understood:
            return understood(lambda text: cell_text(answer.columns[column].read(text)), text)

        return FieldForm(tuple(column.name for column in answer.columns), answer.labels, understand)

    def given(self, answer: TableAnswer, response: Response) -> list[list[str]]:
        """Return the cells as texts."""
        del answer
        return [[self._text(cell) for cell in row] for row in response]

    def _text(self, cell: tuple[str, Number | None] | None) -> str:
        word, number = cell or ("", None)
        return " ".join(part for part in (word, "" if number is None else plain_number(number)) if part)

    def marks(self, question: Question, response: Response, verdict: Verdict) -> FieldMarks:
        """Return the wrong cells."""
        del question, response
        return FieldMarks(frozenset(verdict.marks["wrong"]))


class OrderKind(AnswerKind):
    """A list whose items move."""

    def form(self, answer: OrderAnswer) -> OrderForm:
        """Return the items as the question lists them."""
        return OrderForm(answer.shown)

    def given(self, answer: OrderAnswer, response: Response) -> list[str]:
        """Return the items in order."""
        return [answer.options[place] for place in response]

    def marks(self, question: Question, response: Response, verdict: Verdict) -> ItemMarks:
        """Return the longest run of right neighbours as what is right."""
        del question, verdict
        best = run = [0]
        for place in range(1, len(response)):
            run = [*run, place] if response[place] == response[place - 1] + 1 else [place]
            best = max(best, run, key=len)
        right = frozenset(best if len(best) > 1 else ())
        return ItemMarks(right, frozenset(range(len(response))) - right)


class ChoiceKind(AnswerKind):
    """A button for each option."""

    def form(self, answer: ChoiceAnswer) -> ChoiceForm:
        """Return the options."""
        return ChoiceForm(answer.options, answer.is_several)

    def given(self, answer: ChoiceAnswer, response: Response) -> list[str]:
        """Return the names of the options."""
        return [answer.options[place] for place in sorted(response)]

    def marks(self, question: Question, response: Response, verdict: Verdict) -> ItemMarks:
        """Return what is chosen rightly, wrongly, or missing."""
        del question, response
        return ItemMarks(verdict.marks["right"], verdict.marks["extra"], verdict.marks["missing"])


KINDS: dict[str, AnswerKind] = {
    PixelAnswer.kind: PixelKind(),
    NumberAnswer.kind: NumberKind(),
    TableAnswer.kind: TableKind(),
    OrderAnswer.kind: OrderKind(),
    ChoiceAnswer.kind: ChoiceKind(),
}
"""By `Answer.kind`."""
