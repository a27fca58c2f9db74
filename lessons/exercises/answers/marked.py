"""What is marked on a picture: pixels or blocks, and points that are placed."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import ClassVar

from core.records.cells import Form
from core.scene import ClipScene
from lessons.exercises.answers.answer import (
    CANDIDATES,
    Answer,
    Dial,
    Entry,
    NotCheckedError,
    Verdict,
    behind,
    exact_pair,
    is_blank,
    read_entry,
    spread,
    with_heads,
)
from lessons.exercises.numbers import Draws, NoQuestionError, Number, are_close, number_text, plain_number

# Marked pixels or blocks.


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


# Points that are placed in the window: vertices, or corners that clipping makes.


Place = tuple[Number, Number]
"""x and y in pixels, y up."""
Places = tuple[Place, ...]


@dataclass(frozen=True, eq=False)
class PlaceAnswer(Answer):
    """Named points; each is right near its place, or all together where a run says so."""

    size: tuple[int, int]
    """Columns and rows of the window in which the points lie."""
    names: tuple[str, ...]
    reference: Places
    also: tuple[Places, ...] = ()
    """Other right answers."""
    step: Fraction = Fraction(1, 2)
    """The points move by so many pixels."""
    tolerance: float = 0.0
    """Farthest from the right place, in pixels."""
    is_right: Callable[[Places], bool] | None = None
    """Runs the pipeline with the points; ``None``: the places themselves decide."""
    rule: str = ""
    """What ``is_right`` asks for, as the question states it."""
    scene_of: Callable[[Places], ClipScene] | None = None
    """What is drawn with the points, to be shown while they move; ``None``: the points alone."""

    kind: ClassVar[str] = "places"
    slip: ClassVar[str] = "A slip: one point is off by one step."

    def __post_init__(self) -> None:
        if not self.names or any(len(places) != len(self.names) for places in (self.reference, *self.also)):
            raise ValueError(f"expected a place for each of {self.names}, got {len(self.reference)}")
        if self.check(self.reference).score != 1:
            raise ValueError(f"the places {self.text(self.reference)} are not right")

    @property
    def offered(self) -> str:
        """The names of the points."""
        return f"Points: {', '.join(self.names)}"

    @property
    def credit(self) -> str:
        """How points are given."""
        if self.is_right is not None:
            return f"All points where {self.rule}; any such place counts."
        within = f" within {self.tolerance:g} pixel of it" if self.tolerance else ""
        if len(self.names) == 1:
            return f"The right place earns all points{within}."
        return f"Each of the {len(self.names)} points earns its share at its place{within}."

    @property
    def chance(self) -> float:
        """Mean score of places spread evenly over the window."""
        columns, rows = (int(side / self.step) + 1 for side in self.size)
        places = [
            (Fraction(k % columns) * self.step, Fraction(k // columns) * self.step)
            for k in spread(columns * rows, CANDIDATES)
        ]
        return sum(self.check((place,) * len(self.names)).score for place in places) / len(places)

    @property
    def form(self) -> Form:
        """X and y of each point."""
        cells = tuple((Entry(name, stands_alone=False),) * 2 for name in self.names)
        dial = Dial("", high=Fraction(max(self.size)), step=self.step)
        return Form(self.kind, cells, ("x", "y"), self.names, size=self.size, snapped=dial.snapped)

    def given(self, response: Places) -> list[list[str]]:
        """Return x and y as texts."""
        return [[plain_number(x), plain_number(y)] for x, y in response]

    def read(self, given: object) -> Places:
        """Read a list of [x, y]; of one point, also x and y alone, as a list or a text."""
        if is_blank(given):
            raise NotCheckedError("the answer is empty")
        points = given
        if len(self.names) == 1:
            pair = given.split(",") if isinstance(given, str) else given
            is_pair = isinstance(pair, list) and not any(isinstance(part, list) for part in pair)
            points = [pair] if is_pair else given
        if not isinstance(points, list) or len(points) != len(self.names):
            got = f"{len(points)}" if isinstance(points, list) else type(points).__name__
            raise NotCheckedError(f"expected [x, y] of {len(self.names)} points, got {got}")
        return tuple(map(self._read_place, points))

    def _read_place(self, given: object) -> Place:
        pair = given.split(",") if isinstance(given, str) else given
        if not isinstance(pair, list) or len(pair) != 2:
            raise NotCheckedError(f"expected x and y, got {given!r:.60}")
        x, y = map(read_entry, pair)
        columns, rows = self.size
        if not (0 <= x <= columns and 0 <= y <= rows):
            raise NotCheckedError(
                f"expected a place in the window from (0, 0) to ({columns}, {rows}), got {given!r:.60}"
            )
        return x, y

    def check(self, response: Places) -> Verdict:
        """Score the points against the nearest of all right answers, or by running."""
        if self.is_right is not None:
            if response not in self._found:
                self._found[response] = self.is_right(response)
            right = list(range(len(self.names))) if self._found[response] else []
        else:
            right = max((self._near(response, places) for places in (self.reference, *self.also)), key=len)
        wrong = [k for k in range(len(self.names)) if k not in right]
        counts = f"{len(right)} of {len(self.names)} points right"
        return Verdict(len(right) / len(self.names), counts, {"right": right, "wrong": wrong})

    @cached_property
    def _found(self) -> dict[Places, bool]:
        """Whether places are right, by those that were run."""
        return {}

    def _near(self, response: Places, places: Places) -> list[int]:
        return [
            k for k, (mine, its) in enumerate(zip(response, places, strict=True)) if self._is_near(mine, its)
        ]

    def _is_near(self, one: Place, other: Place) -> bool:
        x, y = one[0] - other[0], one[1] - other[1]
        return x * x + y * y <= Fraction(self.tolerance) ** 2 or (
            are_close(one[0], other[0], 0) and are_close(one[1], other[1], 0)
        )

    def is_same(self, one: Places, other: Places) -> bool:
        """Compare point by point, within the tolerance; all that is right is the same."""
        if len(self._near(one, other)) == len(self.names):
            return True
        return self.check(one).score == self.check(other).score == 1

    def is_slip(self, response: Places) -> bool:
        """One point alone is off, by one step along one axis."""
        off = [
            {abs(mine[0] - its[0]), abs(mine[1] - its[1])}
            for mine, its in zip(response, self.reference, strict=True)
            if not self._is_near(mine, its)
        ]
        return self.is_right is None and len(off) == 1 and off[0] == {0, self.step}

    def text(self, response: Places) -> str:
        """Return the points by name."""
        return with_heads(self._heads, (f"({number_text(x)}, {number_text(y)})" for x, y in response))

    @property
    def _heads(self) -> list[str]:
        return [f"{name}: " for name in self.names]

    def said(self, text: str) -> list[list[str]]:
        """Return x and y of the points of a text."""
        return list(map(exact_pair, behind(text, self._heads)))

    def first_wrong(self, response: Places) -> str:
        """Name the first point that is wrong."""
        wrong = next(iter(self.check(response).marks["wrong"]), None)
        return "" if wrong is None else f"The first point that is wrong: {self.names[wrong]}."

    def random(self, draws: Draws) -> Places:
        """Guess places of the window's grid."""
        columns, rows = self.size
        return tuple(
            (
                draws.step(Fraction(0), Fraction(columns), self.step),
                draws.step(Fraction(0), Fraction(rows), self.step),
            )
            for _ in self.names
        )

    def extremes(self) -> list[Places]:
        """Leave all points in one corner of the window, or put all in the middle."""
        columns, rows = self.size
        middle = (Fraction(columns, 2), Fraction(rows, 2))
        ends = [((Fraction(0), Fraction(0)),) * len(self.names), (middle,) * len(self.names)]
        return [places for places in ends if self.is_right is None and not self._near(places, self.reference)]
