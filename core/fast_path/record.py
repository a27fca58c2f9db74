"""What drawing a picture returns."""

from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.records.frame import StageCount

Visibility = Literal["layer", "packed-depth", "stacks", "frame", "supersampled", "multisampled"]
Coloring = Literal["palette", "corners", "lit", "texture", "deferred"]


@dataclass(frozen=True)
class Split:
    """How many triangles went which way, and how many pixels they have."""

    lanes: int
    """Triangles that walked along spans."""
    big: int
    """Triangles drawn in bands."""
    one_by_one: int
    """Triangles looked at fragment by fragment."""
    fragments: int
    """Covered pixels of all triangles."""


@dataclass(frozen=True)
class Route:
    """How a picture was drawn, and the counts that decided it."""

    visibility: Visibility
    """``layer``: no pixel belongs to two triangles, so none is hidden; ``words``: nearest of all fragments;
    ``stacks``: every fragment in its turn, blended; ``frame``: by all buffers of ``render``; ``supersampled``: a
    picture of all samples, drawn by any of these, and resolved; ``multisampled``: ``words`` of each of four samples,
    and what they show averaged where they differ."""
    color: Coloring
    """``palette``: one colour a triangle; ``corners``: corner colours interpolated, as bytes where that is near enough,
    else as linear light, else like ``deferred``; ``lit``: normals, and a texture or colours of vertices, lit once per
    visible pixel in single precision; ``texture``: packed texels in bands; ``deferred``: attributes and light once per
    visible pixel, as ``render`` has them."""
    split: Split | None = None
    visible: int = 0
    """Pixels that something is seen at."""
    allowed: str = ""
    """The colours that all triangles of this picture, or of this part of one, allow; others than ``color`` where plain
    colours were asked for. Empty: it was not looked at."""

    @property
    def depth_complexity(self) -> float:
        """Fragments for each pixel that something is seen at."""
        return self.split.fragments / max(self.visible, 1) if self.split else 0.0


class DepthStatistics(NamedTuple):
    """How much of a picture passed the depth test."""

    passed: int
    """Fragments, or where a pixel has several samples, those of them that show a triangle."""
    shaded: int
    """Fragments that were given a colour: fewer where several samples of a pixel show one triangle."""


@dataclass(frozen=True, eq=False)
class Picture:
    """A scene as a screen shows it."""

    pixels: NDArray[np.uint8]
    """(H, W, 4) uint8: red, green, blue, alpha; row 0 is the bottom row."""
    depth: NDArray[Any] | None
    """(H, W) as the depth method stores it, or (N,) at the pixels it was asked for at; ``None``: it was not."""
    statistics: dict[str, StageCount]
    """Counts and seconds per stage."""
    route: Route
