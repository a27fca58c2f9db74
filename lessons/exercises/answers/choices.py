"""Order, one of several, and several of them."""

from dataclasses import dataclass
from itertools import combinations, pairwise, permutations
from typing import ClassVar

from lessons.exercises.answers.answer import Answer, NotCheckedError, Verdict
from lessons.exercises.answers.pixels import marked_score
from lessons.exercises.draws import Draws

Order = tuple[int, ...]
ORDER_LIMIT = 8
"""Most things to put in order: the score of chance is found over all orders."""
CHOICE_LIMIT = 10
"""Most options to choose from."""


def longest_run(order: Order) -> int:
    """Return the length of the longest run of neighbours that follow each other, 1 where none do."""
    longest = length = 1
    for one, other in pairwise(order):
        length = length + 1 if other == one + 1 else 1
        longest = max(longest, length)
    return longest


def read_names(given: object, options: tuple[str, ...]) -> tuple[int, ...]:
    """Return the numbers of named options, each at most once."""
    if given in ("", [], None):
        raise NotCheckedError("the answer is empty")
    names = [given] if isinstance(given, str) else given
    if not isinstance(names, list):
        raise NotCheckedError(f"expected a list of options, got {type(given).__name__}")
    for name in names:
        if name not in options:
            raise NotCheckedError(f"expected one of {', '.join(options)}, got {name!r:.60}")
    if len(set(names)) != len(names):
        raise NotCheckedError("expected each option once, got one twice")
    return tuple(options.index(name) for name in names)


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
        runs = [longest_run(order) for order in permutations(range(len(self.options)))]
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

    def read(self, given: object) -> Order:
        """Read the names in order."""
        order = read_names(given, self.options)
        if len(order) != len(self.options):
            raise NotCheckedError(f"expected all {len(self.options)} in order, got {len(order)}")
        return order

    def check(self, response: Order) -> Verdict:
        """Score an order."""
        run = longest_run(response)
        return Verdict(self._score(run), f"{run} of {len(response)} in a row right", {"order": response})

    def is_same(self, one: Order, other: Order) -> bool:
        """Compare orders."""
        return one == other

    def is_slip(self, response: Order) -> bool:
        """Two neighbours are exchanged."""
        off = [k for k, place in enumerate(response) if k != place]
        return len(off) == 2 and off[1] == off[0] + 1

    def text(self, response: Order) -> str:
        """Return the names in order."""
        return " > ".join(self.options[k] for k in response)

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
    def is_many(self) -> bool:
        """There are few options."""
        return False

    def read(self, given: object) -> frozenset[int]:
        """Read one name, or a list of them."""
        chosen = frozenset(read_names(given, self.options))
        if not self.is_several and len(chosen) != 1:
            raise NotCheckedError(f"expected one option, got {len(chosen)}")
        return chosen

    def check(self, response: frozenset[int]) -> Verdict:
        """Score a choice."""
        hits, extra = response & self.reference, response - self.reference
        if not self.is_several:
            # The right option stays unmarked: hints still lead to it.
            is_right = response == self.reference
            marks = {"right": hits, "missing": frozenset[int](), "extra": extra}
            return Verdict(float(is_right), "right" if is_right else "wrong", marks)
        missing = self.reference - response
        count = len(self.reference)
        score = marked_score(len(hits), count, len(extra), len(self.options) - count)
        counts = f"{len(hits)} right, {len(missing)} missing, {len(extra)} wrong"
        return Verdict(score, counts, {"right": hits, "missing": missing, "extra": extra})

    def is_same(self, one: frozenset[int], other: frozenset[int]) -> bool:
        """Compare choices."""
        return one == other

    def is_slip(self, response: frozenset[int]) -> bool:
        """No choice is a slip: a belief stands behind each."""
        return False

    def reason(self, response: frozenset[int]) -> str:
        """Return the note of the first option that is chosen wrongly."""
        wrong = sorted(response - self.reference)
        return self.notes[wrong[0]] if wrong and self.notes else ""

    def text(self, response: frozenset[int]) -> str:
        """Return the options chosen."""
        return ", ".join(self.options[k] for k in sorted(response))

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
