"""What the history of a pixel is made of: keys and numbers, no sentences."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from core.records.arrays import Singles


@dataclass(frozen=True, eq=False)
class Link:
    """One fact of a chain from the vertices to the blended colour, or a verdict."""

    stage: str
    """A stage of ``core.STAGES``, or ``verdict``."""
    key: str
    """What became of it there: names the sentence."""
    values: Mapping[str, Any]
    """The numbers of the sentence, those of the rules themselves."""


@dataclass(frozen=True, eq=False)
class PixelState:
    """What the buffers hold at the pixel, or what a fragment offers to them."""

    color: Singles
    """(4,) float32, linear."""
    depth: float
    """As the depth method stores it; exactly a float32."""
    triangle: int
    """Number of the triangle in the scene, -1: none."""


@dataclass(frozen=True, eq=False)
class PixelEvent:
    """The buffers before anything, the clear, or one triangle at this pixel."""

    kind: str
    """``initial``, ``clear``, ``fragment`` (covered), ``missed`` (not covered), ``culled`` or ``clipped``."""
    chain: tuple[Link, ...]
    """What the stages did with it, up to the one where it ended."""
    triangle: int = -1
    primitive: int = -1
    """Index of the piece among the drawn primitives of the whole scene; -1: none was drawn."""
    before: PixelState | None = None
    """What was there; ``None``: undefined, or no fragment."""
    out: PixelState | None = None
    """What the fragment offers."""
    after: PixelState | None = None
    is_rejected: bool = False

    @property
    def reason(self) -> Link:
        """The last link: where and why it ended."""
        return self.chain[-1]

    def link(self, stage: str) -> Link | None:
        """Return the link of a stage, ``None`` where it was not reached."""
        return next((link for link in self.chain if link.stage == stage), None)


@dataclass(frozen=True, eq=False)
class PixelHistory:
    """Everything that happened to one pixel of the picture of the whole scene."""

    column: int
    row: int
    triangle: int | None
    """The triangle that was asked about, ``None``: the pixel itself."""
    verdict: Link
    """The first line: what became of the pixel, or of the triangle at this pixel."""
    events: tuple[PixelEvent, ...]
    """Initial value, clear, then triangles in drawing order."""
    counts: Mapping[str, int]
    """Triangles that are not listed one by one: how many, by the key of their reason."""
    cover_count: int
    """Fragments here that are in depth range."""
    sample: int | None = None
    """Which of several samples it is the history of; ``None``: the pixel's centre."""

    @property
    def final(self) -> PixelState:
        """What the picture shows."""
        return next(event.after for event in reversed(self.events) if event.after is not None)

    @property
    def fragments(self) -> tuple[PixelEvent, ...]:
        """The events of covered fragments, in drawing order."""
        return tuple(event for event in self.events if event.kind == "fragment")
