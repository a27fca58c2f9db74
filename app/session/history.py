"""Undo: a history of frozen values, not of commands, and how much memory they hold."""

from collections.abc import Callable, Mapping
from typing import Any, Generic, TypeVar

import numpy as np

# How much memory values hold: the arrays that can be reached from them, each counted once.


def held_arrays(value: Any) -> Mapping[int, int]:
    """Return the bytes of all arrays that a record holds, by the identity of their memory.

    What it has computed and kept counts too. Views of one array count as that array.
    """
    found: dict[int, int] = {}
    seen: set[int] = set()
    waiting = [value]
    while waiting:
        each = waiting.pop()
        if isinstance(each, np.ndarray):
            while isinstance(each.base, np.ndarray):
                each = each.base
            found[id(each)] = each.nbytes
        elif id(each) not in seen:
            seen.add(id(each))
            if isinstance(each, tuple | list):
                waiting.extend(each)
            elif isinstance(each, dict):
                waiting.extend(each.values())
            elif hasattr(each, "__dataclass_fields__"):
                waiting.extend(getattr(each, "__dict__", {}).values())
    return found


# Undo: a history of frozen values, not of commands.


State = TypeVar("State")
LIMIT = 500
"""Values that are kept."""
BYTES_LIMIT = 64 << 20
"""Bytes of arrays that are kept only to be gone back to; the last value before the present one stays all the same."""


def _holds_nothing(state: object) -> Mapping[int, int]:
    return {}


class History(Generic[State]):
    """Values in the order they were made, and which one is present.

    Values that belong to one gesture (a drag) are put in with one ``merge`` key and undone together. Values share the
    arrays in which they are the same, so what is kept is bounded by the bytes that all of them hold together.
    """

    def __init__(self, state: State, held: Callable[[State], Mapping[int, int]] = _holds_nothing) -> None:
        """Begin with one value; ``held`` returns the bytes that a value holds by the identity of what holds them."""
        self._held = held
        self._states = [state]
        self._keys: list[str] = [""]
        self._bytes: list[Mapping[int, int]] = []
        self._owners: dict[int, list[int]] = {}
        """By identity of what is held: how many of the values hold it, and its bytes."""
        self._total = 0
        """Bytes that all values hold together."""
        self._count(held(state))
        self._at = 0

    @property
    def present(self) -> State:
        """The value that holds now."""
        return self._states[self._at]

    @property
    def can_undo(self) -> bool:
        """Whether there is an earlier value."""
        return self._at > 0

    @property
    def can_redo(self) -> bool:
        """Whether there is a later value."""
        return self._at + 1 < len(self._states)

    def neighbour(self, direction: int) -> State | None:
        """Return the value that undo (-1) or redo (1) would lead to; ``None``: there is none."""
        at = self._at + direction
        return self._states[at] if 0 <= at < len(self._states) else None

    def put(self, state: State, merge: str = "") -> None:
        """Make ``state`` the present value and forget what was undone; one of the same gesture replaces the last."""
        self._drop(slice(self._at + 1, None))
        if merge and self._keys[-1] == merge:
            self._drop(slice(self._at, None))
        else:
            # What is shown computes more than a new value holds.
            self._discount(self._bytes.pop())
            self._count(self._held(self._states[-1]))
        self._states.append(state)
        self._keys.append(merge)
        self._count(self._held(state))
        while self._has_too_many():
            self._drop(slice(1))
        self._at = len(self._states) - 1

    def _has_too_many(self) -> bool:
        """Return whether the oldest value is one too many."""
        earlier = self._total - sum(self._owners[identity][1] for identity in self._bytes[-1])
        return len(self._states) > LIMIT or (len(self._states) > 2 and earlier > BYTES_LIMIT)

    def _count(self, held: Mapping[int, int]) -> None:
        """Keep what the newest value holds."""
        self._bytes.append(held)
        for identity, size in held.items():
            owned = self._owners.setdefault(identity, [0, size])
            self._total += 0 if owned[0] else owned[1]
            owned[0] += 1

    def _discount(self, held: Mapping[int, int]) -> None:
        for identity in held:
            owned = self._owners[identity]
            owned[0] -= 1
            if not owned[0]:
                self._total -= owned[1]
                del self._owners[identity]

    def _drop(self, which: slice) -> None:
        for held in self._bytes[which]:
            self._discount(held)
        del self._states[which], self._keys[which], self._bytes[which]

    @property
    def gesture(self) -> str:
        """The gesture that put the present value in; empty: none."""
        return self._keys[self._at]

    def is_within(self, gesture: str) -> bool:
        """Return whether the present value was put in by this gesture."""
        return self.gesture == gesture

    def undo(self) -> State:
        """Return to the value before."""
        self._at = max(self._at - 1, 0)
        return self.present

    def redo(self) -> State:
        """Return to the value that was undone last."""
        self._at = min(self._at + 1, len(self._states) - 1)
        return self.present
