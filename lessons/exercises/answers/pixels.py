"""Marked pixels or blocks."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product
from typing import ClassVar

from core.records.cells import Form
from lessons.exercises.answers.answer import Answer, NotCheckedError, Verdict
from lessons.exercises.draws import Draws, NoQuestionError

Pixel = tuple[int, int]
"""Column and row; row 0 is the bottom row."""
Pixels = frozenset[Pixel]

SIDE_LIMIT = 128
"""Most pixels on a side that files may ask for: each can be pointed at."""


def all_pixels(size: tuple[int, int]) -> Pixels:
    """Return all pixels of a raster of ``size`` (columns, rows)."""
    return frozenset(product(range(size[0]), range(size[1])))


class NothingToMarkError(NoQuestionError):
    """All pixels must be marked, or none: there is nothing to ask."""


def marked_score(hits: int, must: int, wrong: int, must_not: int) -> float:
    """Return ``max(0, hits / must - wrong / min(must, must_not))``: all and none earn nothing."""
    return max(0.0, hits / must - wrong / min(must, must_not))


@dataclass(frozen=True, eq=False)
class PixelAnswer(Answer):
    """Pixels of a raster, or blocks of it; ``may`` pixels are left out of the count."""

    size: tuple[int, int]
    """Columns and rows."""
    reference: Pixels
    """Those that must be marked."""
    may: Pixels = frozenset()
    """Those that the question leaves open."""
    noun: str = "pixels"
    direction: tuple[float, float] | None = None
    """From the start to the end of the line that they make, in pixels; ``None``: they make none."""

    kind: ClassVar[str] = "pixels"
    named_limit: ClassVar[float] = 0.5

    def __post_init__(self) -> None:
        if not self.reference or not self._must_not_count:
            missing = "must not (.)" if self.reference else "must (#)"
            raise NothingToMarkError(
                f"expected {self.noun} that must and others that must not, got none that {missing}"
            )

    @property
    def _must_not_count(self) -> int:
        return self.size[0] * self.size[1] - len(self.reference | self.may)

    @property
    def credit(self) -> str:
        """How points are given."""
        return (
            f"Marked {self.noun} earn their share of all that must be marked; each wrong one costs at least as much. "
            "An answer that is exactly what a known mistake gives earns at most half of the points."
        )

    @property
    def form(self) -> Form:
        """The raster."""
        return Form(self.kind, size=self.size, noun=self.noun)

    def given(self, response: Pixels) -> list[list[int]]:
        """Return the marked pixels."""
        return sorted(map(list, response))

    def read(self, given: object) -> Pixels:
        """Read text art, top row first, or a list of columns and rows."""
        if isinstance(given, str):
            art = read_art(given, self.size, NotCheckedError)
            marked = frozenset(pixel for pixel, mark in art.items() if mark == "#")
        else:
            marked = frozenset(self._pixel(pair) for pair in self._pairs(given))
        if not marked:
            raise NotCheckedError(f"no {self.noun} are marked")
        return marked

    def _pairs(self, given: object) -> Iterable[object]:
        limit = self.size[0] * self.size[1]
        if not isinstance(given, list) or len(given) > limit:
            got = f"{len(given)} entries" if isinstance(given, list) else type(given).__name__
            raise NotCheckedError(f"expected text art or a list of up to {limit} [column, row], got {got}")
        return given

    def _pixel(self, pair: object) -> Pixel:
        if isinstance(pair, list) and len(pair) == 2:
            column, row = pair
            columns, rows = self.size
            if type(column) is int and type(row) is int and 0 <= column < columns and 0 <= row < rows:
                return column, row
        raise NotCheckedError(
            f"expected [column, row] from [0, 0] to [{self.size[0] - 1}, {self.size[1] - 1}], got {pair!r:.60}"
        )

    def check(self, response: Pixels) -> Verdict:
        """Score marked pixels."""
        hits = response & self.reference
        missing, extra = self.reference - response, response - self.reference - self.may
        score = marked_score(len(hits), len(self.reference), len(extra), self._must_not_count)
        counts = f"{len(hits)} right, {len(missing)} missing, {len(extra)} extra"
        return Verdict(score, counts, {"right": hits, "missing": missing, "extra": extra})

    def is_same(self, one: Pixels, other: Pixels) -> bool:
        """Compare all but the pixels that may be marked."""
        return one - self.may == other - self.may

    def is_slip(self, response: Pixels) -> bool:
        """One pixel is missing, or one is extra."""
        return len((response ^ self.reference) - self.may) == 1

    def text(self, response: Pixels) -> str:
        """Return text art, top row first."""
        columns, rows = self.size
        lines = ["".join(".#"[(i, j) in response] for i in range(columns)) for j in range(rows)]
        return "\n".join(reversed(lines))

    def first_wrong(self, response: Pixels) -> str:
        """Name the lowest row with a wrong pixel, or the first column or row of a line, in drawing order."""
        wrong = (response ^ self.reference) - self.may
        if not wrong:
            return ""
        if self.direction is None:
            return f"The lowest row with a wrong one: row {min(row for _, row in wrong)}."
        axis = int(abs(self.direction[1]) > abs(self.direction[0]))
        first = max if self.direction[axis] < 0 else min
        place = first(pixel[axis] for pixel in wrong)
        return f"The first wrong one from the start of the line: {('column', 'row')[axis]} {place}."

    def random(self, draws: Draws) -> Pixels:
        """Mark every pixel with one probability, itself drawn."""
        share = draws.fraction()
        columns, rows = self.size
        return frozenset((i, j) for j in range(rows) for i in range(columns) if draws.fraction() < share)

    def extremes(self) -> list[Pixels]:
        """Mark all, none."""
        return [all_pixels(self.size), frozenset()]


def read_art(
    art: str, size: tuple[int, int] | None = None, error: type[ValueError] = ValueError
) -> dict[Pixel, str]:
    """Return the mark of every pixel of text art, top row first: ``#`` must, ``?`` may, ``.`` must not.

    ``size`` (columns, rows) is what it must have; ``None``: any up to ``SIDE_LIMIT`` on a side.
    """
    lines = [line.strip() for line in art.strip("\n").split("\n")] if art.strip() else []
    if not lines:
        raise error("the text art is empty")
    wanted = size or (len(lines[0]), len(lines))
    if max(wanted) > SIDE_LIMIT:
        raise error(f"expected text art of up to {SIDE_LIMIT} pixels each way, got {wanted[0]} x {wanted[1]}")
    if len(lines) != wanted[1]:
        raise error(f"expected {wanted[1]} rows of text art, got {len(lines)}")
    marks = {}
    for number, line in enumerate(lines, 1):
        if len(line) != wanted[0]:
            raise error(
                f"expected {wanted[0]} pixels in every row of text art, got {len(line)} in row {number}"
            )
        for column, mark in enumerate(line):
            if mark not in "#?.":
                raise error(f"expected #, ? or . in text art, got {mark!a} in row {number}")
            marks[column, len(lines) - number] = mark
    return marks
