"""Being told what is done, and being asked whether to go on."""

from collections.abc import Callable

Watch = Callable[[float, str], None]
"""Told the part that is done and what is done next; whatever it raises ends planning or measuring."""
Pause = Callable[[], None]
"""Called between the parts of one step; whatever it raises ends the step."""


def unwatched(done: float, doing: str) -> None:
    """Let everything be done."""


def unpaused() -> None:
    """Go on."""
