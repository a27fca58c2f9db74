"""A contender: one library drawing one workload."""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from typing import Any

from app.bench.records import Bytes

Run = Callable[[], Any]
"""Draws the picture from nothing and returns its pixels, (H, W, 3 or 4) uint8; or reads a file."""


def unchanged(pixels: Bytes) -> Bytes:
    """Return the pixels that a run returned."""
    return pixels


class UnavailableError(RuntimeError):
    """A library is not installed, or cannot draw here; the message is one sentence."""


@dataclass(frozen=True)
class Prepared:
    """What is left to do when everything that is done once has been done: data loaded, programs compiled."""

    run: Run
    tell: Callable[[], str] = str
    """Says how it was drawn: the name of an OpenGL implementation, or a route; asked once all is timed."""
    picture: Callable[[Any], Bytes] = unchanged
    """Makes pixels of what a run returned, to be compared; not timed."""


@dataclass(frozen=True)
class Contender:
    """One library drawing one workload."""

    library: str
    kind: str
    """``ours``, ``graphics`` (an OpenGL implementation), ``painter`` (draws 2D shapes), ``compiled`` (a loop) or
    ``reader`` (of files)."""
    prepare: Callable[[ExitStack], Prepared]
    """Does what is done once, untimed; what must be released at the end is left on the stack."""
    less: str = ""
    """What it does less than ours."""
    is_top_down: bool = False
    """Whether row 0 of its pixels is the top row."""
