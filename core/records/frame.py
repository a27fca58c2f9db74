"""What drawing a scene returns, and what each stage counts."""

from dataclasses import dataclass, field
from threading import local
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Floats, Singles


class _OpenBlocks(local):
    """The timed blocks that a thread is in: when each began, and the seconds of blocks inside it."""

    def __init__(self) -> None:
        self.blocks: list[list[float]] = []


_open = _OpenBlocks()


@dataclass
class StageCount:
    """What one stage took in, gave out, and how long it took: ``with count:`` times a block.

    Blocks may be nested, each is counted without those inside it.
    """

    incoming: int = 0
    outgoing: int = 0
    seconds: float = 0.0
    note: str = ""
    """Key of why the stage was inserted or skipped, else empty."""

    def __enter__(self) -> "StageCount":
        _open.blocks.append([perf_counter(), 0.0])
        return self

    def __exit__(self, *raised: object) -> None:
        start, inside = _open.blocks.pop()
        elapsed = perf_counter() - start
        self.seconds += elapsed - inside
        if _open.blocks:
            _open.blocks[-1][1] += elapsed


@dataclass(frozen=True, eq=False)
class Samples:
    """The buffers of a picture with S samples in every pixel."""

    position: Floats
    """(S, 2) float64, x and y in the pixel from its lower left corner, 0 to 1."""
    color: Singles
    """(S, H, W, 4) float32, linear, before they are resolved."""
    depth: NDArray[Any]
    """(S, H, W), as the depth method stores it."""
    primitive: NDArray[np.int32]
    """(S, H, W) int32, number of the triangle seen, -1 for none."""
    cover_count: NDArray[np.int32]
    """(S, H, W) int32, covered fragments at every sample, whether seen or not."""


@dataclass(frozen=True, eq=False)
class Frame:
    """All buffers of a picture; row 0 is the bottom row."""

    color: Singles
    """(H, W, 4) float32, linear, straight alpha; of several samples, what resolving leaves."""
    depth: Singles
    """(H, W) float32, as the depth method stores it; of several samples that of sample 0."""
    primitive: NDArray[np.int32]
    """(H, W) int32, number of the triangle seen, -1 for none; of several samples at sample 0."""
    attributes: Singles
    """(H, W, K) float32, interpolated values of the triangle ``primitive``, 0 where there is none."""
    cover_count: NDArray[np.int32]
    """(H, W) int32, covered fragments at every pixel, whether seen or not; of several samples the sum."""
    statistics: dict[str, StageCount] = field(default_factory=dict)
    """Counts per stage: triangles up to ``edges``, pixels (or samples) from ``bin`` on."""
    samples: Samples | None = None
    """The buffers of every sample, where a pixel has several."""

    def __post_init__(self) -> None:
        for buffer in (self.color, self.depth, self.primitive, self.attributes, self.cover_count):
            buffer.flags.writeable = False
