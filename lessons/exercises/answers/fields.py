"""Numbers and tables: fields in rows and columns, right all together or each for its share."""

from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from math import prod
from typing import Any, ClassVar, Literal

from core.records.cells import Form
from core.records.words import counted
from lessons.exercises.answers.answer import (
    Answer,
    Entry,
    NotCheckedError,
    Value,
    Verdict,
    behind,
    exact,
    is_blank,
    placed,
    random_number,
    with_heads,
)
from lessons.exercises.numbers import Draws, Number, number_text

Numbers = tuple[Number, ...]
Row = tuple[Value, ...]
Rows = tuple[Row, ...]
Follow = Callable[[Sequence[Row], int, Row], Value]
"""From the rows before, the number of this row and its cells so far to the cell that is next: follow-through."""


class FieldAnswer(Answer):
    """Cells in rows and columns, each with its field."""

    noun: ClassVar[str]
    """What a cell is called."""

    @property
    @abstractmethod
    def cells(self) -> tuple[tuple[Entry, ...], ...]:
        """The cells, row by row."""

    def rows(self, response: Any) -> Rows:
        """Return a response row by row."""
        return tuple(response)

    def expected(self, response: Any) -> Rows:
        """Return the right cells, row by row."""
        return self.rows(self.reference)

    def given(self, response: Any) -> list[list[str]]:
        """Return the texts of the fields, row by row."""
        return [
            [cell.typed(value) for cell, value in zip(cells, row, strict=True)]
            for cells, row in zip(self.cells, self.rows(response), strict=True)
        ]

    def _differences(self, one: Rows, other: Rows) -> list[tuple[int, int]]:
        return [
            (row, column)
            for row, cells in enumerate(self.cells)
            for column, cell in enumerate(cells)
            if not cell.is_close(one[row][column], other[row][column])
        ]

    def wrong(self, response: Any) -> list[tuple[int, int]]:
        """Return the row and column of each cell that is wrong."""
        return self._differences(self.rows(response), self.expected(response))

    def check(self, response: Any) -> Verdict:
        """Count the right cells."""
        wrong, count = self.wrong(response), sum(map(len, self.cells))
        right = count - len(wrong)
        score = self.score(response, right / count)
        counts = f"{right} of {count} {self.noun}s right" if count > 1 else ("wrong", "right")[right]
        return Verdict(score, counts, {"wrong": wrong})

    def score(self, response: Any, share: float) -> float:
        """Return what an answer earns of which a share of the cells is right."""
        return share

    def is_same(self, one: Any, other: Any) -> bool:
        """Compare cell by cell, within the tolerance."""
        return not self._differences(self.rows(one), self.rows(other))

    def is_slip(self, response: Any) -> bool:
        """One cell alone is wrong, by a digit or a sign; of one number, 2 and 3 are two answers."""
        wrong = self.wrong(response)
        if len(wrong) != 1:
            return False
        ((row, column),) = wrong
        mine, right = self.rows(response)[row][column], self.expected(response)[row][column]
        return self.cells[row][column].is_digit_off(mine, right, 2 if sum(map(len, self.cells)) == 1 else 1)


@dataclass(frozen=True)
class NearMiss:
    """Wrong answers that earn something."""

    answers: tuple[Numbers, ...]
    share: Fraction
    """Of all points."""
    sentence: str
    """What earns this share, as the question states it."""


@dataclass(frozen=True, eq=False)
class NumberAnswer(FieldAnswer):
    """Numbers that are right all together or not at all, but for near misses with a price."""

    reference: Numbers
    """Row by row."""
    shape: tuple[int, ...] = ()
    """``()``: one number; (n,): a vector; (m, n): a matrix."""
    names: tuple[str, ...] = ()
    """Of the numbers, as the question calls them; empty: none."""
    tolerance: float = 0.0
    """Largest difference of each number, absolute."""
    near: tuple[NearMiss, ...] = ()

    kind: ClassVar[str] = "numbers"
    noun: ClassVar[str] = "number"
    slip: ClassVar[str] = "A slip: a digit or the sign of one number is wrong."

    @property
    def _columns(self) -> int:
        return self.shape[1] if len(self.shape) == 2 else 1

    @cached_property
    def cells(self) -> tuple[tuple[Entry, ...], ...]:
        """A field for each number: in rows as a matrix has them, else one below the other."""
        labels = map(self._place, range(len(self.reference)))
        pairs = zip(labels, self.reference, strict=True)
        return self.rows(
            Entry(label, "number", right, (), self.tolerance, not self.shape) for label, right in pairs
        )

    def rows(self, response: Any) -> Rows:
        """Return numbers, or their texts, in the rows of their fields."""
        numbers, columns = tuple(response), self._columns
        return tuple(numbers[place : place + columns] for place in range(0, len(numbers), columns))

    def _place(self, number: int) -> str:
        if not self.shape:
            return self.names[0] if self.names else ""
        if self.names:
            return self.names[number]
        if len(self.shape) == 1:
            return f"number {number + 1}"
        row, column = divmod(number, self._columns)
        return f"row {row + 1}, column {column + 1}"

    @property
    def form(self) -> Form:
        """The fields."""
        names = self.names or ("",) * len(self.reference)
        labels = tuple(f"row {row}" for row in range(self.shape[0])) if len(self.shape) == 2 else names
        return Form(self.kind, self.cells, ("",) * self._columns, labels)

    @property
    def offered(self) -> str:
        """The names of the numbers."""
        return f"Numbers: {', '.join(self.names)}" if self.names else ""

    @property
    def credit(self) -> str:
        """How points are given."""
        within = f" within {self.tolerance:g}" if self.tolerance else ""
        count = len(self.reference)
        all_points = "The number earns" if count == 1 else f"The {count} numbers together earn"
        return " ".join([f"{all_points} all points{within}.", *(miss.sentence for miss in self.near)])

    def read(self, given: object) -> Numbers:
        """Read a number, lists of them, or the texts of all fields row by row."""
        if is_blank(given):
            raise NotCheckedError("the answer is empty")
        if len(self.shape) < 2 and isinstance(given, list):
            given = [row[0] if isinstance(row, list) and len(row) == 1 else row for row in given]
            given = given if self.shape or len(given) > 1 else given[0]
        return tuple(self._read(given, self.shape))

    def _read(self, given: object, shape: tuple[int, ...], first: int = 0) -> list[Number]:
        if not shape:
            row, column = divmod(first, self._columns)
            cell = self.cells[row][column]
            if not self.shape:
                return [cell.read(given)]
            with placed(cell.label):
                return [cell.read(given)]
        if not isinstance(given, list) or len(given) != shape[0]:
            got = f"{len(given)}" if isinstance(given, list) else type(given).__name__
            noun = "numbers" if len(shape) == 1 else "rows"
            raise NotCheckedError(f"expected a list of {shape[0]} {noun}, got {got}")
        step = prod(shape[1:])
        return [
            number
            for k, entry in enumerate(given)
            for number in self._read(entry, shape[1:], first + k * step)
        ]

    def score(self, response: Numbers, share: float) -> float:
        """Give all or nothing, or the share of a near miss."""
        near = (float(miss.share) for miss in self.near if self._is_near(miss, response))
        return 1.0 if share == 1 else max(near, default=0.0)

    def _is_near(self, miss: NearMiss, response: Numbers) -> bool:
        return any(self.is_same(response, numbers) for numbers in miss.answers)

    def reason(self, response: Numbers) -> str:
        """Return what earns a near miss its share."""
        near = (miss.sentence for miss in self.near if self._is_near(miss, response))
        return next(near, "")

    def text(self, response: Numbers) -> str:
        """Return the numbers, one on a line where they have names."""
        texts = [number_text(number) for number in response]
        return with_heads(self._heads, texts) if self.names else ", ".join(texts)

    @property
    def _heads(self) -> list[str]:
        return [f"{name} = " for name in self.names]

    def said(self, text: str) -> list[list[str]]:
        """Return the numbers of a text in the rows of their fields."""
        texts = map(exact, behind(text, self._heads) if self.names else text.split(", "))
        return [[*row] for row in self.rows(texts)]

    def first_wrong(self, response: Numbers) -> str:
        """Name the first number that is wrong, or its row and column; nothing where there is only one."""
        wrong = self.wrong(response)
        if not wrong or not (self.names or self.shape):
            return ""
        row, column = wrong[0]
        label = self.cells[row][column].label
        return f"The first number that is wrong: {f'“{label}”' if self.names else label}."

    def random(self, draws: Draws) -> Numbers:
        """Guess numbers of the size and the fineness of the right ones."""
        return tuple(random_number(draws, self.reference) for _ in self.reference)

    def extremes(self) -> list[Numbers]:
        """Answer nothing but zeros, unless that is right."""
        zeros = (Fraction(0),) * len(self.reference)
        return [] if self.is_same(zeros, self.reference) else [zeros]


@dataclass(frozen=True)
class Column:
    """One column of a table."""

    name: str
    kind: Literal["number", "crossing", "codes"] = "number"
    """A number; PE or PL with a number, or ``none``; or two outcodes of four bits."""


@dataclass(frozen=True, eq=False)
class TableAnswer(FieldAnswer):
    """Cells with follow-through: a slip costs its own cell, not those that were computed from it."""

    columns: tuple[Column, ...]
    labels: tuple[str, ...]
    """Of the rows."""
    reference: Rows
    follow: Follow | None = None
    """The cell that follows from the learner's own numbers; ``None``: each cell stands for itself."""
    tolerance: float = 0.0
    """Largest difference of each number, absolute."""

    kind: ClassVar[str] = "table"
    noun: ClassVar[str] = "cell"
    slip: ClassVar[str] = "A slip: a digit or the sign of one cell is wrong, and the rest follows from it."

    @cached_property
    def cells(self) -> tuple[tuple[Entry, ...], ...]:
        """The cells, each named by its column and row."""
        return tuple(
            tuple(
                Entry(f"{column.name}, {label}", column.kind, right, (), self.tolerance, stands_alone=False)
                for column, right in zip(self.columns, row, strict=True)
            )
            for label, row in zip(self.labels, self.reference, strict=True)
        )

    @property
    def form(self) -> Form:
        """The fields."""
        return Form(self.kind, self.cells, tuple(column.name for column in self.columns), self.labels)

    @property
    def offered(self) -> str:
        """The empty table."""
        return self.text(self.extremes()[0])

    @property
    def credit(self) -> str:
        """How points are given."""
        count = len(self.labels) * len(self.columns)
        own = " Each cell is judged from your own cells before it." if self.follow else ""
        return f"Each of the {count} cells earns its share.{own}"

    def read(self, given: object) -> Rows:
        """Read a list of rows; with one column, its cells may stand for them."""
        rows = given if isinstance(given, list) else []
        if len(self.columns) == 1:
            rows = [row if isinstance(row, list) else [row] for row in rows]
        wanted = f"expected {len(self.labels)} rows of {len(self.columns)}"
        if len(rows) != len(self.labels):
            raise NotCheckedError(f"{wanted}, got {len(rows)} rows")
        for number, row in enumerate(rows, 1):
            if not isinstance(row, list) or len(row) != len(self.columns):
                got = f"{len(row)}" if isinstance(row, list) else type(row).__name__
                raise NotCheckedError(f"{wanted}, got {got} in row {number}")
        read = tuple(tuple(map(_read_cell, cells, row)) for cells, row in zip(self.cells, rows, strict=True))
        if not any(value is not None for row in read for value in row):
            raise NotCheckedError("the table is empty")
        return read

    def expected(self, response: Rows) -> Rows:
        """Return the right cells, each from the learner's own before it; an empty one counts as right there."""
        return self.reference if self.follow is None else followed(self.follow, response)

    def text(self, response: Rows) -> str:
        """Return the table with its heads."""
        lines = [["", *(column.name for column in self.columns)]]
        for label, cells, row in zip(self.labels, self.cells, response, strict=True):
            lines.append([label, *(cell.text(value) for cell, value in zip(cells, row, strict=True))])
        widths = [max(len(line[k]) for line in lines) for k in range(len(lines[0]))]
        padded = (
            "  ".join(text.ljust(width) for text, width in zip(line, widths, strict=True)) for line in lines
        )
        return "\n".join(line.rstrip() for line in padded)

    def said(self, text: str) -> list[list[str]]:
        """Cut the lines of a text where the heads of the columns begin."""
        head, *lines = text.split("\n")
        begins = [max(map(len, self.labels)) + 2]
        for column, following in pairwise(self.columns):
            begins.append(head.index(f"  {following.name}", begins[-1] + len(column.name)) + 2)
        ends = [*(begin - 2 for begin in begins[1:]), None]
        rows = [
            [exact(line[begin:end].strip()) for begin, end in zip(begins, ends, strict=True)]
            for line in lines
        ]
        return [["" if cell == "..." else cell for cell in row] for row in rows]

    def left_out(self, response: Rows) -> str:
        """Count the empty cells."""
        count = sum(value is None for row in response for value in row)
        return f"{counted(count, 'cell')} {'is' if count == 1 else 'are'} empty" if count else ""

    def first_wrong(self, response: Rows) -> str:
        """Name the first cell that is wrong."""
        wrong = self.wrong(response)
        return f"The first wrong cell: {self.cells[wrong[0][0]][wrong[0][1]].label}." if wrong else ""

    def random(self, draws: Draws) -> Rows:
        """Guess every cell."""
        like = list(zip(*self.reference, strict=True))
        return tuple(
            tuple(cell.guess(draws, like[column]) for column, cell in enumerate(cells))
            for cells in self.cells
        )

    def extremes(self) -> list[Rows]:
        """Leave every cell empty."""
        return [empty_rows(len(self.labels), len(self.columns))]


def _read_cell(cell: Entry, given: object) -> Value:
    """Return the value of a cell of a table; ``None``: it is empty."""
    text = given.strip() if isinstance(given, str) else given
    if text == "":
        return None
    with placed(cell.label):
        return cell.read(text)


def followed(follow: Follow, given: Rows) -> Rows:
    """Return the cells that follow, each from those given before it; an empty one counts as right there."""
    expected: list[Row] = []
    own: list[Row] = []
    for row, values in enumerate(given):
        wanted: Row = ()
        mine: Row = ()
        for value in values:
            right = follow(own, row, mine)
            wanted, mine = (*wanted, right), (*mine, right if value is None else value)
        expected.append(wanted)
        own.append(mine)
    return tuple(expected)


def empty_rows(rows: int, columns: int) -> Rows:
    """Return a table in which nothing is filled in."""
    return ((None,) * columns,) * rows


def number_rows(values: Sequence[Sequence[int | Fraction]]) -> Rows:
    """Return rows of numbers as cells."""
    return tuple(tuple(map(Fraction, row)) for row in values)
