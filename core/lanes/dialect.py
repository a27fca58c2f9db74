"""What a language gives the evaluator: its values, and what is done with them."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Protocol

from core.lanes.masks import Mask, Some
from core.lanes.problem import Place
from core.lanes.run import Run

Value = Any
"""What a variable holds: what only the dialect knows."""
Rule = Callable[[Value, Value, Some, Run], Value]
"""Of an operator with two operands."""
Turn = Callable[[Some, int], tuple[Mask, Mask, Value]]
"""Of the lanes in a loop, and the number of the round: who goes on, who has ended, and the thing of this round."""


class Dialect(Protocol):
    """One language's values. ``mask`` is that of the lanes that are at ``place``; `Problem` says what does not go."""

    nothing: Value
    """What a return without a value gives."""
    is_typed: bool
    """Whether a variable keeps its type, which ``check_kept`` watches."""

    def names(self) -> Mapping[str, Value]:
        """Return the variables that every call begins with."""

    def constant(self, value: Any, place: Place) -> Value:
        """Return the value of what was typed."""

    def unknown(self, name: str, known: Iterable[str]) -> str:
        """Return what is said of a name without a value, where there are others."""

    def truth(self, value: Value, place: Place) -> Any:
        """Return a condition as one bool, where all lanes agree, or as flags (L,)."""

    def flag(self, truth: Any) -> Value:
        """Return the value of such a condition."""

    def uniform(self, value: Value, place: Place) -> bool:
        """Return a condition that must be the same in all lanes."""

    def rule(self, operator: str, place: Place) -> Rule:
        """Return what an operator does with two operands."""

    def prefix(self, operator: str, place: Place) -> Callable[[Value], Value]:
        """Return what an operator does with one operand."""

    def check_stored(self, value: Value, mask: Some, place: Place, run: Run) -> None:
        """Say what may not be stored in a variable; the mask is (L,)."""

    def check_kept(self, name: str, old: Value, new: Value, place: Place) -> None:
        """Say where a variable would change its type."""

    def size(self, value: Value) -> int:
        """Return how many numbers a variable takes up."""

    def merged(self, flags: Any, new: Value, old: Value, place: Place, run: Run, returned: int = 0) -> Value:
        """Return ``new`` where ``flags`` (L,) hold, else ``old``; 1: it is returned, 2: it is a part of that."""

    def zero(self, of: Any) -> Value:
        """Return what a variable of a type begins with that is declared without a value."""

    def typed(self, of: Any, value: Value, place: Place, name: str) -> Value:
        """Return the value that a variable of a type is declared with."""

    def many(
        self, parts: Sequence[Value], starred: Sequence[bool], mask: Some, place: Place, run: Run
    ) -> Value:
        """Return a list; of a starred part its elements; the mask is (L,)."""

    def elements(self, value: Value, mask: Some, place: Place, run: Run) -> list[Value]:
        """Return the elements of a value that has as many in every lane; the mask is (L,)."""

    def unpacked(
        self, value: Value, starred: Sequence[bool], mask: Some, place: Place, run: Run
    ) -> list[Value]:
        """Return a value for each of several names; one of them may be starred."""

    def turns(self, value: Value, mask: Some, place: Place, run: Run) -> Turn:
        """Return the rounds of a loop over a value; the mask is (L,)."""

    def put(self, whole: Value, value: Value, mask: Some, place: Place, run: Run) -> None:
        """Put a value at the end of a list; the mask is (L,)."""

    def part(self, whole: Value, index: Value, mask: Some, place: Place, run: Run) -> Value:
        """Return an element; the mask is (L,)."""

    def with_part(self, whole: Value, index: Value, new: Value, mask: Some, place: Place, run: Run) -> Value:
        """Return a value with another element; the mask is (L,)."""

    def field(self, whole: Value, name: str, place: Place) -> Value:
        """Return a part that has a name."""

    def call(self, name: str, values: Sequence[Value], mask: Some, place: Place, run: Run) -> Value:
        """Return what a function of the language makes of values; the mask is (L,)."""

    def arguments(
        self, name: str, parameters: Sequence[str], values: Sequence[Value], place: Place
    ) -> Sequence[Value]:
        """Return the values that a function of the program is called with."""
