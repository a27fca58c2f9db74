"""What a drawing in space consists of: lines, faces, points and words, as frozen records.

The space is right-handed with y up; the viewer at rest looks along -z. An ``ink`` is a name of
:mod:`widgets.basics.theme`. Coordinates may be anything: what is not finite is left out, what is far away is cut.
"""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Dash = Literal["solid", "dash", "dot"]
SpotShape = Literal["disc", "ring", "square", "cross"]


CUBE = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
"""(8, 3) corners of the cube around the origin that is two units wide."""


@dataclass(frozen=True, eq=False)
class Stroke:
    """A line through points."""

    points: NDArray[np.float64] = field(repr=False)
    """(N, 3) float64."""
    ink: str = "text"
    width: float = 1.5
    """Logical pixels."""
    dash: Dash = "solid"
    is_closed: bool = False
    opacity: float = 1.0

    def __post_init__(self) -> None:
        _check_points("points of a stroke", self.points)


@dataclass(frozen=True, eq=False)
class Patch:
    """A flat, convex, translucent face."""

    points: NDArray[np.float64] = field(repr=False)
    """(N, 3) float64, its corners in turn."""
    ink: str = "muted_text"
    opacity: float = 0.15

    def __post_init__(self) -> None:
        _check_points("points of a patch", self.points)


@dataclass(frozen=True, eq=False)
class Spot:
    """A point with a mark and a name."""

    point: NDArray[np.float64] = field(repr=False)
    """(3,) float64."""
    ink: str = "text"
    shape: SpotShape = "disc"
    radius: float = 4.0
    label: str = ""

    def __post_init__(self) -> None:
        if self.point.shape != (3,):
            raise ValueError(f"point must be (3,), got {self.point.shape}")


@dataclass(frozen=True, eq=False)
class Word:
    """Text at a point of the space."""

    point: NDArray[np.float64] = field(repr=False)
    """(3,) float64."""
    text: str
    ink: str = "muted_text"

    def __post_init__(self) -> None:
        if self.point.shape != (3,):
            raise ValueError(f"point must be (3,), got {self.point.shape}")


@dataclass(frozen=True, eq=False)
class Diagram:
    """A drawing in space."""

    patches: tuple[Patch, ...] = ()
    strokes: tuple[Stroke, ...] = ()
    spots: tuple[Spot, ...] = ()
    words: tuple[Word, ...] = ()
    frame: NDArray[np.float64] = field(default_factory=lambda: CUBE, repr=False)
    """(N, 3) float64, points that the whole view shows; from step to step they should change little."""
    azimuth: float = 0.6
    elevation: float = 0.35
    """Radians, the direction from which it is first seen; see :class:`~widgets.space.orbit.Orbit`."""
    caption: str = ""
    """What the drawing shows, in one to three sentences."""


def _check_points(name: str, points: NDArray[np.float64]) -> None:
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"{name} must be (N, 3), got {points.shape}")
