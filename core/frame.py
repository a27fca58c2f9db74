"""The stages by name, and what drawing a scene returns."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from core.arrays import Singles

STAGES = (
    "transform",
    "cull",
    "clip",
    "edges",
    "bin",
    "raster",
    "interpolate",
    "shade",
    "depth",
    "blend",
    "resolve",
)
"""Names of the pipeline's stages in order."""


@dataclass
class StageCount:
    """What one stage took in, gave out, and how long it took."""

    incoming: int = 0
    outgoing: int = 0
    seconds: float = 0.0
    note: str = ""
    """Key of why the stage was inserted or skipped, else empty."""


@dataclass(frozen=True, eq=False)
class Frame:
    """All buffers of a picture; row 0 is the bottom row."""

    color: Singles
    """(H, W, 4) float32, linear, straight alpha."""
    depth: Singles
    """(H, W) float32, as the depth method stores it."""
    primitive: NDArray[np.int32]
    """(H, W) int32, number of the triangle seen, -1 for none."""
    attributes: Singles
    """(H, W, K) float32, interpolated values of the triangle seen, 0 where there is none."""
    cover_count: NDArray[np.int32]
    """(H, W) int32, covered fragments at every pixel, whether seen or not."""
    statistics: dict[str, StageCount] = field(default_factory=dict)
    """Counts per stage: triangles up to ``edges``, pixels from ``bin`` on."""
