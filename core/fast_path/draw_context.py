"""One picture to be drawn: what it shows, where to, with what memory, and what drawing it returns."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.coverage.pixel_runs import Raster
from core.depth.depth import DepthFormat
from core.framebuffer.display import encode_linear, write_pixels
from core.numeric.large_arrays import ScratchBuffers
from core.records.arrays import Flags, Floats, Integers, Singles, cached_property
from core.records.frame import StageCount
from core.resolved import resolve
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.spans.bands import TriangleRows, rows_of_triangles
from core.spans.lanes import TieOwners, TriangleSetup, set_up_lanes, tie_owners
from core.stages.geometry import Geometry

# What drawing a picture returns.


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


# One picture to be drawn: what it shows, where to, and with what memory; the steps of drawing hand it on.


Words = NDArray[np.uint32]
"""Pixels of four bytes, red lowest."""

BLOCK = 1 << 15
"""Pixels that are worked on together: their numbers stay in the processor's cache."""
TOGETHER = 1 << 14
"""Triangles that walk together: their rows stay in the processor's cache."""
MOST_ROWS = 1 << 18
"""Rows of them: each takes some hundred bytes, and tall triangles have many."""
ROWS = 1 << 15
"""Rows of large triangles that are found together: each takes some hundred bytes."""


def blocks(count: int) -> Iterator[slice]:
    """Yield the parts of ``count`` pixels that are worked on together."""
    for first in range(0, count, BLOCK):
        yield slice(first, first + BLOCK)


@dataclass(frozen=True, eq=False)
class DrawContext:
    """A picture to be drawn."""

    scene: AnyScene
    settings: Settings
    geometry: Geometry
    raster: Raster
    """The pixels that are drawn."""
    encoding: str
    """``srgb`` or ``linear``."""
    pixels: Words
    """(H*W,) uint32, the picture."""
    counts: dict[str, StageCount]
    scratch: ScratchBuffers
    mesh_number: int | None = None
    """Of a scene of several meshes, the one whose primitives these are; ``None``: they may be of all."""

    def part(self, chosen: Integers, mesh_number: int | None = None) -> "DrawContext":
        """Return the same picture of the ``chosen`` (C,) primitives, numbered anew; all of one mesh, if it is given."""
        primitives, area = self.geometry.primitives.take(chosen), self.geometry.doubled_area.take(chosen)
        geometry = replace(self.geometry, primitives=primitives, doubled_area=area)
        return replace(self, geometry=geometry, mesh_number=mesh_number)

    @property
    def only_mesh(self) -> int | None:
        """The number of the mesh that all primitives are of; ``None``: there are several, or they are of none."""
        is_alone = not isinstance(self.scene, ClipScene) and len(self.scene.meshes) == 1
        return 0 if is_alone else self.mesh_number

    @cached_property
    def owners(self) -> TieOwners:
        """Who owns a pixel centre on an edge."""
        return tie_owners(self.settings.fill_rule)

    @cached_property
    def depth_format(self) -> DepthFormat:
        """How depth is kept."""
        return resolve(self.settings).depth_format

    @property
    def has_texture(self) -> bool:
        """Whether anything in the scene has a texture."""
        if isinstance(self.scene, ClipScene):
            return self.scene.texture is not None
        return any(mesh.texture is not None for mesh in self.scene.meshes)

    @cached_property
    def background(self) -> np.uint32:
        """The pixel that nothing is seen at."""
        return _word_of(self.scene.background.tobytes(), self.encoding)

    def timed(self, stage: str) -> StageCount:
        """Add the time of the block to a stage."""
        return self.counts[stage]

    def encode(self, color: Floats | Singles) -> Words:
        """Return the bytes of linear colours (F, 4), a word each."""
        return encode(color, self.encoding)

    def walks(self, chosen: Flags | None = None) -> Iterator[tuple[int, int, TriangleSetup]]:
        """Yield first and end of primitives that walk together, and the ``chosen`` (P,) ones, or all, side by side."""
        count = len(self.geometry.primitives)
        for first in range(0, count, TOGETHER):
            yield from self._walks(first, min(first + TOGETHER, count), chosen)

    def _walks(self, first: int, end: int, chosen: Flags | None) -> Iterator[tuple[int, int, TriangleSetup]]:
        """Yield primitives ``first`` to ``end`` in as many parts as they have too many rows for one."""
        with self.timed("bin"):
            lanes = self._lanes(first, end, chosen)
        row_count = sum(lanes.taller)
        if row_count <= MOST_ROWS or end - first == 1:
            yield first, end, lanes
            return
        part = max((end - first) * MOST_ROWS // row_count, 1)
        for start in range(first, end, part):
            yield from self._walks(start, min(start + part, end), chosen)

    def _lanes(self, first: int, end: int, chosen: Flags | None) -> TriangleSetup:
        at = slice(first, end)
        area = self.geometry.doubled_area[at]
        if chosen is not None:
            area = np.multiply(area, chosen[at], out=self.scratch("chosen_area", end - first))
        x, y = self.geometry.window_x[:, at], self.geometry.window_y[:, at]
        return set_up_lanes(x, y, area, self.raster, self.owners, self.scratch)

    def rows_of_each(self, chosen: Integers) -> Iterator[tuple[int, TriangleRows]]:
        """Yield every ``chosen`` (C,) primitive, a large one, with its rows: found for many at once, not for all."""
        at_once = max(ROWS // max(self.raster.shape[0], 1), 1)
        for first in range(0, len(chosen), at_once):
            part = chosen[first : first + at_once]
            with self.timed("bin"):
                x, y, area = (
                    of.take(part, axis=-1)
                    for of in (self.geometry.window_x, self.geometry.window_y, self.geometry.doubled_area)
                )
                rows = rows_of_triangles(x, y, area, self.raster, self.owners, self.scratch)
            yield from zip(part.tolist(), rows, strict=True)


@lru_cache(maxsize=4)
def _word_of(color: bytes, encoding: str) -> np.uint32:
    """Return the bytes of one linear colour, four float64 numbers: most pictures have the background of the last."""
    word: np.uint32 = encode(np.frombuffer(color)[None], encoding)[0]
    return word


def encode(color: Floats | Singles, encoding: str) -> Words:
    """Return the bytes of linear colours (F, 4), a word each: ``srgb`` or ``linear``."""
    with np.errstate(over="ignore"):
        single = np.ascontiguousarray(color, np.float32)
    if encoding == "linear":
        encoded = encode_linear(single)
    else:
        encoded = np.empty(single.shape, np.uint8)
        write_pixels(single, encoded)
    return encoded.view(np.uint32).reshape(-1)
