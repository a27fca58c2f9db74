"""Answers that are judged by running: break a weak method, and no more than needed."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from itertools import product
from typing import Any, ClassVar

from core import Settings
from core.coverage.snapping import window_position
from core.methods import table
from core.records.cells import Corner, Form
from core.scene import ClipScene
from core.settings import FAMILIES, with_method
from lessons.exercises.answers.answer import (
    CANDIDATES,
    Answer,
    Dial,
    Entry,
    NotCheckedError,
    Verdict,
    behind,
    exact,
    is_blank,
    spread,
    with_heads,
)
from lessons.exercises.numbers import Draws, number_text

Values = tuple[Fraction, ...]
"""Of the dials, in their order."""
Choices = tuple[int, ...]
"""Of every family, the number of its method."""

COMBINATION_LIMIT = 256
"""Most combinations of methods: all of them are drawn to find the cheapest."""


def _entries_of(given: object, names: list[str], what: str) -> list[Any]:
    """Return the entry of every name: from a list in their order, or a table of them."""
    if is_blank([*given.values()] if isinstance(given, dict) else given):
        raise NotCheckedError("the answer is empty")
    if isinstance(given, dict):
        if set(given) != set(names):
            raise NotCheckedError(f"expected {', '.join(names)}, got {', '.join(map(str, given))!a:.60}")
        given = [given[name] for name in names]
    entries = given if isinstance(given, list) else [given]
    if len(entries) != len(names):
        raise NotCheckedError(f"expected {what} for each of {', '.join(names)}, got {len(entries)}")
    return entries


@dataclass(frozen=True, eq=False)
class BreakAnswer(Answer):
    """Numbers with which a weak method fails and a robust one does not; any that do so are right."""

    dials: tuple[Dial, ...]
    start: Values
    """What the dials begin with."""
    reference: Values
    scene_of: Callable[[Values], ClipScene]
    """The scene of some values."""
    weak: Settings
    robust: Settings
    fails: Callable[[ClipScene, Settings], bool]
    """Runs a scene and says whether the picture is wrong."""
    rule: str
    """When a method fails, as the question states it: ``a pixel is drawn twice``."""

    kind: ClassVar[str] = "break"
    is_many: ClassVar[bool] = False

    def __post_init__(self) -> None:
        if self.check(self.reference).score != 1:
            raise ValueError("expected numbers with which the weak method alone fails")

    @property
    def offered(self) -> str:
        """The dials, and what they begin with."""
        heads = [f"{dial.label}: {dial.values}, at first " for dial in self.dials]
        return with_heads(heads, map(number_text, self.start))

    @property
    def credit(self) -> str:
        """How points are given."""
        return (
            f"All points where the weak method fails and the other does not; a method fails where {self.rule}. "
            "Any such answer counts."
        )

    @cached_property
    def chance(self) -> float:
        """Mean score of answers spread evenly over all."""
        counts = [dial.count for dial in self.dials]
        total = 1
        for count in counts:
            total *= count
        scores = []
        for index in spread(total, CANDIDATES):
            values, rest = [], index
            for dial, count in zip(self.dials, counts, strict=True):
                values.append(dial.value(rest % count))
                rest //= count
            scores.append(self.check(tuple(values)).score)
        return sum(scores) / len(scores)

    @property
    def form(self) -> Form:
        """The dials, and the corners that they move."""
        moved: dict[tuple[int, int], list[int | None]] = {}
        for number, dial in enumerate(self.dials):
            if dial.corner is not None:
                moved.setdefault(dial.corner[:2], [None, None])[dial.corner[2]] = number
        corners = tuple(
            Corner(f"{'ABCDEFGH'[at[0] % 8]}{at[1]}", x, y, partial(self._place, at))
            for at, (x, y) in moved.items()
        )
        start = tuple(dial.snapped(float(value)) for dial, value in zip(self.dials, self.start, strict=True))
        cells = tuple((dial,) for dial in self.dials)
        return Form(self.kind, cells, start=start, corners=corners)

    def _place(self, at: tuple[int, int], given: list[str]) -> tuple[float, float]:
        """Return where a corner is in the window."""
        scene = self.scene_of(self.read(given))
        x, y = window_position(scene.clip, scene.size)[at].tolist()
        return x, y

    def given(self, response: Values) -> list[str]:
        """Return the numbers as texts."""
        return [dial.typed(value) for dial, value in zip(self.dials, response, strict=True)]

    def read(self, given: object) -> Values:
        """Read a list of numbers, or a table of them by the names of the dials."""
        entries = _entries_of(given, [dial.label for dial in self.dials], "a number")
        return tuple(dial.read(entry) for dial, entry in zip(self.dials, entries, strict=True))

    def check(self, response: Values) -> Verdict:
        """Run both methods."""
        weak, robust = self._failing(response)
        first, second = self._titles
        counts = f"“{first}” {_failed(weak)}, “{second}” {_failed(robust)}"
        return Verdict(float(weak and not robust), counts)

    @property
    def _titles(self) -> tuple[str, str]:
        """The names of the weak and the robust method, in the family in which they differ."""
        weak, robust = self.weak, self.robust
        family = next(name for name in FAMILIES if getattr(weak, name) != getattr(robust, name))
        first, second = (table.get(family, getattr(each, family)).title for each in (weak, robust))
        return first, second

    def reason(self, response: Values) -> str:
        """Say when a method fails."""
        return f"A method fails where {self.rule}."

    def _failing(self, response: Values) -> tuple[bool, bool]:
        if response not in self._found:
            scene = self.scene_of(response)
            self._found[response] = self.fails(scene, self.weak), self.fails(scene, self.robust)
        return self._found[response]

    @cached_property
    def _found(self) -> dict[Values, tuple[bool, bool]]:
        """Whether the weak and the robust method fail, by the values that were run."""
        return {}

    def is_same(self, one: Values, other: Values) -> bool:
        """Compare which methods fail."""
        return one == other or self._failing(one) == self._failing(other)

    def text(self, response: Values) -> str:
        """Return the numbers by name."""
        return with_heads(self._heads, map(number_text, response))

    @property
    def _heads(self) -> list[str]:
        return [f"{dial.label} = " for dial in self.dials]

    def said(self, text: str) -> list[str]:
        """Return the numbers of a text."""
        return list(map(exact, behind(text, self._heads)))

    def random(self, draws: Draws) -> Values:
        """Guess every number."""
        return tuple(draws.step(dial.low, dial.high, dial.step) for dial in self.dials)

    def extremes(self) -> list[Values]:
        """Change nothing."""
        return [self.start]


def _failed(fails: bool) -> str:
    return "fails" if fails else "does not fail"


@dataclass(frozen=True)
class Family:
    """Methods to choose from, and what each costs."""

    name: str
    """Of a setting, as ``interpolation``."""
    methods: tuple[str, ...]
    costs: tuple[Fraction, ...]

    @property
    def text(self) -> str:
        """The methods with their costs."""
        priced = zip(self.methods, self.costs, strict=True)
        return ", ".join(f"{method} {number_text(cost)}" for method, cost in priced)

    @property
    def cell(self) -> Entry:
        """The choice among the methods."""
        titles = (
            f"{table.get(self.name, method).title}, cost {number_text(cost)}"
            for method, cost in zip(self.methods, self.costs, strict=True)
        )
        return Entry(FAMILIES[self.name].title, "choice", options=tuple(titles))


@dataclass(frozen=True, eq=False)
class CheapestAnswer(Answer):
    """The cheapest methods whose picture stays within a tolerance; all that cost as little are right."""

    families: tuple[Family, ...]
    limit: Fraction
    """Largest error."""
    error_of: Callable[[Settings], Fraction]
    """Draws with some settings and returns the error against the reference picture."""
    base: Settings
    """The methods of all other families."""
    unit: str = "of 255"
    """Of the error and its limit, for sentences."""

    kind: ClassVar[str] = "cheapest"
    is_many: ClassVar[bool] = False

    def __post_init__(self) -> None:
        count = 1
        for family in self.families:
            count *= len(family.methods)
            if not 2 <= len(family.methods) == len(family.costs):
                raise ValueError(f"expected two or more methods of {family.name}, each with its cost")
        if not 2 <= count <= COMBINATION_LIMIT:
            raise ValueError(f"expected 2 to {COMBINATION_LIMIT} combinations of methods, got {count}")
        within = [choices for choices in self.combinations if self.error(choices) <= self.limit]
        if not within:
            raise ValueError(f"no methods stay within an error of {number_text(self.limit)}")
        least = min(map(self.cost, within))
        if least == self.cost(self.dearest) or least == min(map(self.cost, self.combinations)):
            raise ValueError("expected the cheapest methods within the tolerance to be neither of the ends")

    @cached_property
    def _errors(self) -> dict[Choices, Fraction]:
        return {}

    def settings(self, choices: Choices) -> Settings:
        """Return the settings of some choices."""
        settings = self.base
        for family, k in zip(self.families, choices, strict=True):
            settings = with_method(settings, family.name, family.methods[k])
        return settings

    def error(self, choices: Choices) -> Fraction:
        """Return the error of some choices, by running."""
        if choices not in self._errors:
            self._errors[choices] = self.error_of(self.settings(choices))
        return self._errors[choices]

    def cost(self, choices: Choices) -> Fraction:
        """Return what some choices cost together."""
        return sum((family.costs[k] for family, k in zip(self.families, choices, strict=True)), Fraction(0))

    @property
    def combinations(self) -> list[Choices]:
        """All choices that can be made."""
        return list(product(*(range(len(family.methods)) for family in self.families)))

    @property
    def dearest(self) -> Choices:
        """The choices that cost most."""
        return max(self.combinations, key=self.cost)

    @property
    def reference(self) -> Choices:
        """The first of the cheapest choices within the tolerance."""
        within = [choices for choices in self.combinations if self.error(choices) <= self.limit]
        return min(within, key=self.cost)

    @property
    def offered(self) -> str:
        """The methods with their costs."""
        return with_heads(self._heads, (family.text for family in self.families))

    @property
    def credit(self) -> str:
        """How points are given."""
        return (
            f"The cheapest methods whose error is at most {number_text(self.limit)} {self.unit} earn all points; "
            "dearer ones within it earn what they save of the dearest, in proportion."
        )

    @property
    def chance(self) -> float:
        """Mean score of all choices that can be made."""
        scores = [self.check(choices).score for choices in self.combinations]
        return sum(scores) / len(scores)

    @property
    def form(self) -> Form:
        """The families with the costs of their methods."""
        return Form(
            self.kind,
            tuple((family.cell,) for family in self.families),
            labels=tuple(family.name for family in self.families),
            names=tuple(family.methods for family in self.families),
            told=lambda given: f"Cost together: {number_text(self.cost(self.read(given)))}",
        )

    def given(self, response: Choices) -> dict[str, str]:
        """Return the methods by family."""
        return {family.name: family.methods[k] for family, k in zip(self.families, response, strict=True)}

    def read(self, given: object) -> Choices:
        """Read a table of methods by family, or a list of them."""
        entries = _entries_of(given, [family.name for family in self.families], "a method")
        chosen = []
        for family, entry in zip(self.families, entries, strict=True):
            if entry not in family.methods:
                raise NotCheckedError(f"expected one of {', '.join(family.methods)}, got {entry!r:.60}")
            chosen.append(family.methods.index(entry))
        return tuple(chosen)

    def check(self, response: Choices) -> Verdict:
        """Draw with the methods, and compare error and cost."""
        error, cost = self.error(response), self.cost(response)
        most, least = self.cost(self.dearest), self.cost(self.reference)
        is_within = error <= self.limit
        score = float((most - cost) / (most - least)) if is_within else 0.0
        within = "within" if is_within else "beyond"
        counts = f"error {number_text(error)} {self.unit}, {within} the tolerance; cost {number_text(cost)}"
        return Verdict(score, counts)

    def is_same(self, one: Choices, other: Choices) -> bool:
        """Compare the choices; all that earn everything are the same."""
        return one == other or self.check(one).score == self.check(other).score == 1

    def text(self, response: Choices) -> str:
        """Return the methods by family."""
        return with_heads(self._heads, self.given(response).values())

    @property
    def _heads(self) -> list[str]:
        return [f"{family.name}: " for family in self.families]

    def said(self, text: str) -> list[str]:
        """Return the methods of a text."""
        return behind(text, self._heads)

    def random(self, draws: Draws) -> Choices:
        """Guess every method."""
        return tuple(draws.whole(0, len(family.methods) - 1) for family in self.families)

    def extremes(self) -> list[Choices]:
        """Take the dearest of all, or the cheapest."""
        return [self.dearest, min(self.combinations, key=self.cost)]
