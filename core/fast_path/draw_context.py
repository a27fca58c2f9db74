"""One picture to be drawn: what it shows, where to, and with what memory; the steps of drawing hand it on."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from core.framebuffer.depth import DepthFormat
from core.framebuffer.display import encode_linear, write_pixels
from core.numeric.buffers import ScratchBuffers
from core.raster.pixel_runs import Raster
from core.raster.spans.bands import TriangleRows, rows_of_triangles
from core.raster.spans.lanes import TieOwners, TriangleSetup, set_up_lanes, tie_owners
from core.records.arrays import Flags, Floats, Integers, Singles
from core.records.cached import cached_property
from core.records.frame import StageCount
from core.resolved import resolve
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.stages.geometry import Geometry

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
