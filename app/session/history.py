"""Undo: a history of frozen values, not of commands."""

from typing import Generic, TypeVar

State = TypeVar("State")
LIMIT = 500
"""Values that are kept."""


class History(Generic[State]):
    """Values in the order they were made, and which one is present.

    Values that belong to one gesture (a drag) are put in with one ``merge`` key and undone together.
    """

    def __init__(self, state: State) -> None:
        self._states = [state]
        self._keys: list[str] = [""]
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
        del self._states[self._at + 1 :], self._keys[self._at + 1 :]
        if merge and self._keys[-1] == merge:
            self._states[-1] = state
            return
        self._states.append(state)
        self._keys.append(merge)
        excess = max(len(self._states) - LIMIT, 0)
        del self._states[:excess], self._keys[:excess]
        self._at = len(self._states) - 1

    def is_within(self, gesture: str) -> bool:
        """Return whether the present value was put in by this gesture."""
        return self._keys[self._at] == gesture

    def undo(self) -> State:
        """Return to the value before."""
        self._at = max(self._at - 1, 0)
        return self.present

    def redo(self) -> State:
        """Return to the value that was undone last."""
        self._at = min(self._at + 1, len(self._states) - 1)
        return self.present
