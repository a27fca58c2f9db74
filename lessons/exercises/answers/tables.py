"""A table that is filled cell by cell; each row is judged from the learner's own rows before it."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import ClassVar, Literal

from core.records.words import counted
from lessons.exercises.answers.amounts import random_number, read_entry
from lessons.exercises.answers.answer import Answer, NotCheckedError, Verdict, placed
from lessons.exercises.draws import Draws
from lessons.exercises.numbers import Number, are_close, is_one_digit_off, number_text

Cell = tuple[str, Number | None] | None
"""The word and the number of a cell, of which one may be missing; ``None``: the cell is empty."""
Row = tuple[Cell, ...]
Rows = tuple[Row, ...]
Follow = Callable[[Sequence[Row], int, Row], Cell]
"""From the rows before, the number of this row and its cells so far to the cell that is next: follow-through."""

ENTERS, LEAVES = "PE", "PL"
_CODES = re.compile(r"[01]{4} [01]{4}")


@dataclass(frozen=True)
class Column:
    """One column of a table."""

    name: str
    kind: Literal["number", "crossing", "codes"] = "number"
    """A number; PE or PL with a number, or ``none``; or two outcodes of four bits."""

    @property
    def wanted(self) -> str:
        """What stands in a cell, for messages."""
        crossing = f"{ENTERS} or {LEAVES} and a number such as {ENTERS} 1/2, or none"
        return {"number": "a number", "crossing": crossing, "codes": "two outcodes such as 0101 0010"}[
            self.kind
        ]

    def read(self, given: object) -> Cell:
        """Return what a cell means; NotCheckedError where it means nothing."""
        text = given.strip() if isinstance(given, str) else given
        if text == "":
            return None
        if self.kind == "number":
            return "", read_entry(text)
        if self.kind == "crossing" and isinstance(text, str):
            word, _, number = text.partition(" ")
            if text == "none":
                return "none", None
            if word in (ENTERS, LEAVES):
                return word, read_entry(number)
        if self.kind == "codes" and isinstance(text, str) and _CODES.fullmatch(text):
            return text, None
        raise NotCheckedError(f"expected {self.wanted}, got {given!r:.40}")

    def random(self, draws: Draws, like: Sequence[Cell]) -> Cell:
        """Return a guess."""
        if self.kind == "codes":
            # The nine regions around a window, for both ends.
            sides = [[draws.item(("00", "01", "10")) for _ in range(2)] for _ in range(2)]
            return " ".join("".join(codes) for codes in sides), None
        number = random_number(draws, tuple(cell[1] for cell in like if cell and cell[1] is not None))
        return ("", number) if self.kind == "number" else (draws.item((ENTERS, LEAVES)), number)


def cell_text(cell: Cell) -> str:
    """Return a cell as it was understood; an empty one as ``...``."""
    if cell is None:
        return "..."
    word, number = cell
    return " ".join(text for text in (word, "" if number is None else number_text(number)) if text)


@dataclass(frozen=True, eq=False)
class TableAnswer(Answer):
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
    slip: ClassVar[str] = "A slip: a digit or the sign of one cell is wrong, and the rest follows from it."

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
        cells = tuple(self._read_row(label, row) for label, row in zip(self.labels, rows, strict=True))
        if not any(cell for row in cells for cell in row):
            raise NotCheckedError("the table is empty")
        return cells

    def _read_row(self, label: str, row: list[object]) -> Row:
        cells: list[Cell] = []
        for column, cell in zip(self.columns, row, strict=True):
            with placed(f"{column.name}, {label}"):
                cells.append(column.read(cell))
        return tuple(cells)

    def expected(self, response: Rows) -> Rows:
        """Return the right cells, each from the learner's own before it; an empty one counts as right there."""
        expected: list[Row] = []
        own: list[Row] = []
        for row, cells in enumerate(response):
            wanted: list[Cell] = []
            mine: list[Cell] = []
            for column, cell in enumerate(cells):
                right = self.follow(own, row, tuple(mine)) if self.follow else self.reference[row][column]
                wanted.append(right)
                mine.append(right if cell is None else cell)
            expected.append(tuple(wanted))
            own.append(tuple(mine))
        return tuple(expected)

    def check(self, response: Rows) -> Verdict:
        """Score the table cell by cell."""
        wrong = self._differences(response, self.expected(response))
        count = len(self.labels) * len(self.columns)
        right = count - len(wrong)
        return Verdict(right / count, f"{right} of {count} cells right", {"wrong": wrong})

    def _differences(self, one: Rows, other: Rows) -> list[tuple[int, int]]:
        return [
            (row, column)
            for row, (first, second) in enumerate(zip(one, other, strict=True))
            for column, (mine, its) in enumerate(zip(first, second, strict=True))
            if not self._close(mine, its)
        ]

    def _close(self, one: Cell, other: Cell) -> bool:
        if one is None or other is None:
            return False
        (word, number), (its_word, its_number) = one, other
        if number is None or its_number is None:
            return word == its_word and number is its_number
        return word == its_word and are_close(number, its_number, self.tolerance)

    def is_same(self, one: Rows, other: Rows) -> bool:
        """Compare cell by cell, within the tolerance."""
        return not self._differences(one, other)

    def is_slip(self, response: Rows) -> bool:
        """One cell alone is wrong, by a digit or a sign; the others follow from it."""
        expected = self.expected(response)
        wrong = self._differences(response, expected)
        if len(wrong) != 1:
            return False
        row, column = wrong[0]
        mine, right = response[row][column], expected[row][column]
        if mine is None or right is None or mine[1] is None or right[1] is None:
            return False
        return mine[0] == right[0] and is_one_digit_off(mine[1], right[1])

    def text(self, response: Rows) -> str:
        """Return the table with its heads."""
        lines = [["", *(column.name for column in self.columns)]]
        for label, row in zip(self.labels, response, strict=True):
            lines.append([label, *(cell_text(cell) for cell in row)])
        widths = [max(len(line[k]) for line in lines) for k in range(len(lines[0]))]
        padded = (
            "  ".join(text.ljust(width) for text, width in zip(line, widths, strict=True)) for line in lines
        )
        return "\n".join(line.rstrip() for line in padded)

    def left_out(self, response: Rows) -> str:
        """Count the empty cells."""
        count = sum(cell is None for row in response for cell in row)
        return f"{counted(count, 'cell')} {'is' if count == 1 else 'are'} empty" if count else ""

    def first_wrong(self, response: Rows) -> str:
        """Name the first cell that is wrong."""
        wrong = self.check(response).marks["wrong"]
        if not wrong:
            return ""
        row, column = wrong[0]
        return f"The first wrong cell: {self.columns[column].name}, {self.labels[row]}."

    def random(self, draws: Draws) -> Rows:
        """Guess every cell."""
        of_column = list(zip(*self.reference, strict=True))
        return tuple(
            tuple(column.random(draws, like) for column, like in zip(self.columns, of_column, strict=True))
            for _ in self.labels
        )

    def extremes(self) -> list[Rows]:
        """Leave every cell empty."""
        return [tuple((None,) * len(self.columns) for _ in self.labels)]


def number_rows(values: Sequence[Sequence[int | Fraction]]) -> Rows:
    """Return rows of numbers as cells."""
    return tuple(tuple(("", Fraction(value)) for value in row) for row in values)
