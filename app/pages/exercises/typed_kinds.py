"""Answers in fields and lists: numbers, tables, orders, choices, and the line of a listing."""

from app.pages.exercises.answer_kind import AnswerKind, number_of, plain_number, understood
from core.records.sketch import Place
from lessons.exercises.answers.amounts import NumberAnswer, read_entry
from lessons.exercises.answers.answer import Response, Verdict
from lessons.exercises.answers.choices import ChoiceAnswer, OrderAnswer
from lessons.exercises.answers.listings import LineAnswer
from lessons.exercises.answers.tables import TableAnswer, cell_text
from lessons.exercises.numbers import Number, number_text
from lessons.exercises.question import Question
from widgets.exercises.records import (
    ChoiceForm,
    FieldForm,
    FieldMarks,
    ItemMarks,
    ListingForm,
    OrderForm,
    Understood,
)

FARTHEST = 100.0
"""Farthest coordinate that a sketch of the plane shows."""


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

    def place(self, answer: NumberAnswer, given: list[list[str]]) -> Place | None:
        """Return x and y where both are numbers that can be shown."""
        numbers = [number_of(row[0]) for row in given]
        if answer.names != ("x", "y") or any(n is None or abs(n) > FARTHEST for n in numbers):
            return None
        x, y = (n for n in numbers if n is not None)
        return x, y

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


class LineKind(AnswerKind):
    """A list of lines."""

    def form(self, answer: LineAnswer) -> ListingForm:
        """Return the lines."""
        return ListingForm(answer.lines)

    def given(self, answer: LineAnswer, response: Response) -> str:
        """Return the number of the line."""
        del answer
        return str(response + 1)

    def marks(self, question: Question, response: Response, verdict: Verdict) -> ItemMarks:
        """Return the chosen line."""
        del question, response
        marks = verdict.marks
        return ItemMarks(marks.get("right", frozenset()), marks.get("wrong", frozenset()))
