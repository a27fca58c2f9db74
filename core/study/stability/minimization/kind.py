"""A kind of case: something with parts and numbers that can be left out or made simpler."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Generic, TypeVar

from core.scene import AnyScene

Parts = TypeVar("Parts")
"""A case, taken apart."""


@dataclass(frozen=True)
class Kind(Generic[Parts]):
    """How cases of one kind are taken apart, made smaller and put together."""

    take_apart: Callable[[AnyScene], Parts]
    """From a scene; a ``ValueError`` where it is of another kind."""
    put_together: Callable[[Parts], AnyScene]
    """To the scene that is run, opens in the stepper and is saved; a ``ValueError`` where the parts make none."""
    ways: tuple[Callable[[Parts], Iterator[Parts]], ...]
    """Each gives what is a little smaller than the parts, the most promising first; taken in turns."""
    words: Callable[[Parts], str]
    """How much it is: ``2 triangles in 1x1 pixels``."""

    def as_case(self, scene: AnyScene) -> AnyScene:
        """Return what of a scene is made smaller."""
        return self.put_together(self.take_apart(scene))


def counted_triangles(count: int, size: tuple[int, int]) -> str:
    """Return in words how many triangles there are in how large a picture."""
    return f"{count} triangle{'s' if count > 1 else ''} in {size[0]}x{size[1]} pixels"
