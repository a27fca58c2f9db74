"""Order, one of several, and several of them."""

from dataclasses import dataclass
from itertools import combinations, pairwise, permutations
from typing import ClassVar

from core.records.cells import Form
from lessons.exercises.answers.answer import Answer, NotCheckedError, Verdict, read_names
from lessons.exercises.answers.marked import marked_score
from lessons.exercises.numbers import Draws

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
        counts = f"{len(run)} of {len(response)} in a row right" if len(run) > 1 else "no two in a row right"
        return Verdict(self._score(len(run)), counts, marks)

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
