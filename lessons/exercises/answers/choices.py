"""Order, one of several, several of them; and what is wrong with a picture: a pixel, and the name of the mistake."""

import re
from dataclasses import dataclass
from itertools import combinations, pairwise, permutations
from typing import ClassVar

from core.records.cells import Form, Marks
from core.records.frame import Frame
from core.records.words import counted
from lessons.exercises.answers.answer import Answer, NotCheckedError, Verdict, read_names
from lessons.exercises.answers.marked import Pixel, PixelAnswer, Pixels, all_pixels, marked_score
from lessons.exercises.numbers import Draws

# Order, one of several, and several of them.


Order = tuple[int, ...]
ORDER_LIMIT = 8
"""Most things to put in order: the score of chance is found over all orders."""
CHOICE_LIMIT = 10
"""Most options to choose from."""


def longest_run(order: Order) -> list[int]:
    """Return the places of the longest run of neighbours that follow each other, of one place where none do."""
    best = run = [0]
    for place, (one, other) in enumerate(pairwise(order), 1):
        run = [*run, place] if other == one + 1 else [place]
        best = max(best, run, key=len)
    return best


@dataclass(frozen=True, eq=False)
class OrderAnswer(Answer):
    """Things in order: scored by the longest run of right neighbours, compared with that of a random order."""

    options: tuple[str, ...]
    """In the right order."""
    shown: tuple[str, ...]
    """In the order in which the question lists them."""

    kind: ClassVar[str] = "order"
    slip: ClassVar[str] = "A slip: two neighbours are exchanged."

    def __post_init__(self) -> None:
        if not 3 <= len(self.options) <= ORDER_LIMIT or len(set(self.options)) != len(self.options):
            raise ValueError(
                f"expected 3 to {ORDER_LIMIT} different things to put in order, got {self.options}"
            )
        runs = [len(longest_run(order)) for order in permutations(range(len(self.options)))]
        object.__setattr__(self, "_by_chance", sum(runs) / len(runs))
        object.__setattr__(self, "_chance", sum(map(self._score, runs)) / len(runs))

    @property
    def reference(self) -> Order:
        """The right order."""
        return tuple(range(len(self.options)))

    @property
    def offered(self) -> str:
        """The things as the question lists them."""
        return "\n".join(f"- {one}" for one in self.shown)

    @property
    def credit(self) -> str:
        """How points are given."""
        return (
            "The longest run of neighbours in the right order earns points. "
            "A run no longer than that of a random order earns nothing."
        )

    @property
    def chance(self) -> float:
        """Mean score of all orders."""
        chance: float = self.__dict__["_chance"]
        return chance

    def _score(self, run: int) -> float:
        by_chance: float = self.__dict__["_by_chance"]
        return max(0.0, (run - by_chance) / (len(self.options) - by_chance))

    @property
    def is_many(self) -> bool:
        """Whether there are more than a thousand orders."""
        return len(self.options) > 6

    @property
    def form(self) -> Form:
        """The things as the question lists them."""
        return Form(self.kind, items=self.shown)

    def given(self, response: Order) -> list[str]:
        """Return the things in order."""
        return [self.options[place] for place in response]

    def read(self, given: object) -> Order:
        """Read the names in order."""
        order = read_names(given, self.options)
        if len(order) != len(self.options):
            raise NotCheckedError(f"expected all {len(self.options)} in order, got {len(order)}")
        return order

    def check(self, response: Order) -> Verdict:
        """Score an order."""
        run = longest_run(response)
        marks = {"right": run if len(run) > 1 else []}
        return Verdict(self._score(len(run)), f"{len(run)} of {len(response)} in a row right", marks)

    def is_slip(self, response: Order) -> bool:
        """Two neighbours are exchanged."""
        off = [k for k, place in enumerate(response) if k != place]
        return len(off) == 2 and off[1] == off[0] + 1

    def text(self, response: Order) -> str:
        """Return the names in order."""
        return " > ".join(self.options[k] for k in response)

    def said(self, text: str) -> list[str]:
        """Return the names of a text."""
        return text.split(" > ")

    def first_wrong(self, response: Order) -> str:
        """Name the first two neighbours that do not belong together."""
        for one, other in pairwise(response):
            if other != one + 1:
                return f"{self.options[other]} does not come right after {self.options[one]}."
        return ""

    def random(self, draws: Draws) -> Order:
        """Guess an order."""
        return draws.shuffled(self.reference)

    def extremes(self) -> list[Order]:
        """Turn the order round."""
        return [self.reference[::-1]]


@dataclass(frozen=True, eq=False)
class ChoiceAnswer(Answer):
    """One of several options, or several of them."""

    options: tuple[str, ...]
    reference: frozenset[int]
    is_several: bool = False
    notes: tuple[str, ...] = ()
    """What is true of each option, a sentence that tells why it is right or wrong; empty: none is known."""

    kind: ClassVar[str] = "choice"
    is_many: ClassVar[bool] = False

    def __post_init__(self) -> None:
        count = len(self.options)
        if not 2 <= count <= CHOICE_LIMIT or len(set(self.options)) != count:
            raise ValueError(f"expected 2 to {CHOICE_LIMIT} different options, got {self.options}")
        if not 0 < len(self.reference) < count or not (self.is_several or len(self.reference) == 1):
            wanted = "some but not all options" if self.is_several else "one option"
            raise ValueError(f"expected {wanted} to be right, got {len(self.reference)} of {count}")

    @property
    def offered(self) -> str:
        """The options."""
        return "\n".join(f"- {option}" for option in self.options)

    @property
    def credit(self) -> str:
        """How points are given."""
        if not self.is_several:
            return "The right option earns all points."
        return "Right options earn their share; each wrong one costs as much as a right one earns, or more."

    @property
    def chance(self) -> float:
        """Mean score of all choices that can be made."""
        if not self.is_several:
            return 1 / len(self.options)
        indices = range(len(self.options))
        choices = [frozenset(chosen) for k in indices for chosen in combinations(indices, k + 1)]
        return sum(self.check(chosen).score for chosen in choices) / len(choices)

    @property
    def form(self) -> Form:
        """The options."""
        return Form(self.kind, items=self.options, is_several=self.is_several)

    def given(self, response: frozenset[int]) -> list[str]:
        """Return the names of the options."""
        return [self.options[place] for place in sorted(response)]

    def read(self, given: object) -> frozenset[int]:
        """Read one name, or a list of them."""
        chosen = frozenset(read_names(given, self.options))
        if not self.is_several and len(chosen) != 1:
            raise NotCheckedError(f"expected one option, got {len(chosen)}")
        return chosen

    def check(self, response: frozenset[int]) -> Verdict:
        """Score a choice."""
        hits, wrong = response & self.reference, response - self.reference
        # A single right option stays unmarked: hints still lead to it.
        missing = self.reference - response if self.is_several else frozenset()
        marks = {"right": hits, "missing": missing, "wrong": wrong}
        if not self.is_several:
            is_right = response == self.reference
            return Verdict(float(is_right), "right" if is_right else "wrong", marks)
        count = len(self.reference)
        score = marked_score(len(hits), count, len(wrong), len(self.options) - count)
        counts = f"{len(hits)} right, {len(missing)} missing, {len(wrong)} wrong"
        return Verdict(score, counts, marks)

    def reason(self, response: frozenset[int]) -> str:
        """Return the note of the first option that is chosen wrongly."""
        wrong = sorted(response - self.reference)
        return self.notes[wrong[0]] if wrong and self.notes else ""

    def text(self, response: frozenset[int]) -> str:
        """Return the options chosen."""
        return ", ".join(self.options[k] for k in sorted(response))

    def said(self, text: str) -> list[str]:
        """Take the options of a text in their order; they may hold commas themselves."""
        chosen, rest = [], f"{text}, "
        for option in self.options:
            if rest.startswith(f"{option}, "):
                chosen.append(option)
                rest = rest.removeprefix(f"{option}, ")
        return chosen

    def first_wrong(self, response: frozenset[int]) -> str:
        """Name the first option that is chosen and wrong, or right and not chosen; of one choice nothing."""
        wrong = sorted(response ^ self.reference)
        return (
            f"The first option to think over: {self.options[wrong[0]]}." if wrong and self.is_several else ""
        )

    def random(self, draws: Draws) -> frozenset[int]:
        """Guess among all choices that can be made."""
        count = len(self.options)
        if not self.is_several:
            return frozenset({draws.whole(0, count - 1)})
        bits = draws.whole(1, 2**count - 1)
        return frozenset(k for k in range(count) if bits >> k & 1)

    def extremes(self) -> list[frozenset[int]]:
        """Choose all, none."""
        return [frozenset(range(len(self.options))), frozenset()]


# What is wrong with a picture: a pixel that a mistake changed, and the name of the mistake.


@dataclass(frozen=True)
class Spot:
    """Pixels that are pointed at, and the mistake that is said to have changed them; either may be missing."""

    pixels: Pixels
    option: int | None


@dataclass(frozen=True, eq=False)
class SpotAnswer(Answer):
    """The picture of a run with a mistake: where it shows, and which it is."""

    size: tuple[int, int]
    """Columns and rows."""
    picture: Frame
    """What is shown: the run with the mistake."""
    wrong: Pixels
    """Pixels that differ from the right picture."""
    options: tuple[str, ...] = ()
    """Mistakes to choose from; none: only the place is asked."""
    right: int = 0
    """The option that made the picture."""

    kind: ClassVar[str] = "spot"
    is_many: ClassVar[bool] = False
    slip: ClassVar[str] = "A slip: all but one of the pixels differ from the right picture."

    def __post_init__(self) -> None:
        PixelAnswer(self.size, self.wrong)
        count = len(self.options)
        if self.options and not (2 <= count <= CHOICE_LIMIT and 0 <= self.right < count):
            raise ValueError(f"expected 2 to {CHOICE_LIMIT} mistakes to choose from, got {count}")

    @property
    def reference(self) -> Spot:
        """All pixels that differ, and the mistake."""
        return Spot(self.wrong, self.right if self.options else None)

    @property
    def _share(self) -> float:
        """Share of the points that the place earns."""
        return 0.5 if self.options else 1.0

    @property
    def offered(self) -> str:
        """The mistakes to choose from."""
        return "\n".join(f"- {option}" for option in self.options)

    @property
    def credit(self) -> str:
        """How points are given."""
        place = "one or more pixels that differ from the right picture, and no other,"
        if not self.options:
            return f"To click {place} earns all points."
        return f"To click {place} earns half of the points, the mistake the other half."

    @property
    def chance(self) -> float:
        """Mean score of one pixel and one mistake."""
        columns, rows = self.size
        place = self._share * len(self.wrong) / (columns * rows)
        return place + (0.5 / len(self.options) if self.options else 0.0)

    @property
    def form(self) -> Form:
        """The raster and the options."""
        return Form(self.kind, items=self.options, size=self.size)

    def given(self, response: Spot) -> dict[str, object]:
        """Return the pixels and the option."""
        option = "" if response.option is None else self.options[response.option]
        return {"pixels": sorted(map(list, response.pixels)), "option": option}

    def read(self, given: object) -> Spot:
        """Read a table of pixels (as text art, or a list) and an option, or one of the two alone."""
        parts = given if isinstance(given, dict) else {"option" if given in self.options else "pixels": given}
        unknown = [str(key) for key in parts if key not in ("pixels", "option")]
        if unknown:
            raise NotCheckedError(f"expected pixels and option, got {unknown[0]!a:.40}")
        pixels, option = parts.get("pixels", []), parts.get("option", "")
        if pixels in ("", []) and option in ("", []):
            raise NotCheckedError("the answer is empty")
        marked = frozenset() if pixels in ("", []) else PixelAnswer(self.size, self.wrong).read(pixels)
        if option in ("", []):
            return Spot(marked, None)
        if not self.options:
            raise NotCheckedError("expected pixels alone: this question names no mistakes")
        chosen = read_names(option, self.options)
        if len(chosen) != 1:
            raise NotCheckedError(f"expected one mistake, got {len(chosen)}")
        return Spot(marked, chosen[0])

    def check(self, response: Spot) -> Verdict:
        """Score the place and the mistake."""
        right, extra = response.pixels & self.wrong, response.pixels - self.wrong
        is_named = bool(self.options) and response.option == self.right
        score = self._share * self._has_place(response) + (1 - self._share) * is_named
        words = [f"{counted(len(right), 'pixel')} of the mistake, {len(extra)} other"]
        if self.options:
            words.append(
                "no mistake named"
                if response.option is None
                else f"mistake {'right' if is_named else 'wrong'}"
            )
        options = [] if response.option is None else [response.option]
        named: Marks = {"right": [*right, *options]} if is_named else {"right": right, "wrong": options}
        marks = {**named, "extra": extra}
        return Verdict(score, "; ".join(words), marks)

    def is_same(self, one: Spot, other: Spot) -> bool:
        """Compare the mistakes, and whether the places are right."""
        return one.option == other.option and self._has_place(one) == self._has_place(other)

    def _has_place(self, spot: Spot) -> bool:
        return bool(spot.pixels) and spot.pixels <= self.wrong

    def is_slip(self, response: Spot) -> bool:
        """The mistake is right, and all but one of three or more pixels."""
        extra = response.pixels - self.wrong
        return len(extra) == 1 and len(response.pixels) >= 3 and response.option == self.reference.option

    def text(self, response: Spot) -> str:
        """Return the pixels as (column, row), and the mistake."""
        pixels = ", ".join(map(str, sorted(response.pixels))) or "no pixel"
        named = [] if response.option is None else [self.options[response.option]]
        return "; ".join([pixels, *named])

    def said(self, text: str) -> dict[str, object]:
        """Return the pixels and the option of a text."""
        pixels, _, option = text.partition("; ")
        found = re.findall(r"\((\d+), (\d+)\)", pixels)
        return {"pixels": [[int(i), int(j)] for i, j in found], "option": option}

    def left_out(self, response: Spot) -> str:
        """Say which half is missing."""
        if not response.pixels:
            return "No pixel is marked"
        return "No mistake is named" if self.options and response.option is None else ""

    def first_wrong(self, response: Spot) -> str:
        """Name the first pixel that does not differ."""
        extra: list[Pixel] = sorted(response.pixels - self.wrong)
        return f"Pixel {extra[0]} is the same in the right picture." if extra else ""

    def random(self, draws: Draws) -> Spot:
        """Guess a pixel and a mistake."""
        columns, rows = self.size
        pixel = draws.whole(0, columns - 1), draws.whole(0, rows - 1)
        return Spot(frozenset({pixel}), draws.whole(0, len(self.options) - 1) if self.options else None)

    def extremes(self) -> list[Spot]:
        """Click all pixels, none."""
        return [Spot(all_pixels(self.size), None), Spot(frozenset(), None)]
