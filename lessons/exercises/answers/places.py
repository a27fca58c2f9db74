"""Points that are placed in the window: vertices, or corners that clipping makes."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import ClassVar

from core.records.cells import Form
from core.scene import ClipScene
from lessons.exercises.answers.answer import CANDIDATES, Answer, NotCheckedError, Verdict, spread
from lessons.exercises.answers.cells import Dial, Entry, behind, exact_pair, is_blank, read_entry, with_heads
from lessons.exercises.draws import Draws
from lessons.exercises.numbers import Number, are_close, number_text, plain_number

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
