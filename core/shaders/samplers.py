"""Textures in a shader: look-ups by the program's own filters."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from core.lanes.problem import Place, Problem
from core.lanes.run import Run
from core.records.arrays import Floats, Integers
from core.scene import Texture
from core.shaders.glsl_types import GlslValue
from core.shaders.quads import across, up

Colors = Callable[[Texture, Floats, Floats | None], Floats]
"""Of a texture, texture coordinates (L, 2) and their slopes (4, L), if known: colours (L, 4)."""


@dataclass(frozen=True, eq=False)
class Sampler:
    """What a sampler2D reads from: the texture of each lane's mesh."""

    textures: tuple[Texture | None, ...]
    colors_of: Colors
    """The filter and wrap of the settings."""
    mesh: Integers | None = None
    """(L,) int64, which texture each lane reads; ``None``: all the first."""

    def at(self, lanes: slice) -> "Sampler":
        """Return the sampler of some lanes."""
        mesh = None if self.mesh is None else self.mesh[lanes]
        return Sampler(self.textures, self.colors_of, mesh)

    def only(self, place: Place) -> Texture:
        """Return the texture where all lanes read the same."""
        number = 0 if self.mesh is None or not len(self.mesh) else int(self.mesh[0])
        texture = self.textures[number]
        if texture is None or (self.mesh is not None and (self.mesh != number).any()):
            raise Problem(place, "texelFetch and textureSize need one mesh with a texture")
        return texture


def look_up(values: Sequence[GlslValue], place: Place, run: Run) -> GlslValue:
    """Return texture(sampler, uv)."""
    sampler: Sampler | None = values[0].parts[0]
    u, v = (np.broadcast_to(part, (run.lanes,)) for part in values[1].parts)
    if sampler is None or run.lanes == 0:
        return _colors(np.zeros((run.lanes, 4)))
    uv = np.stack([u, v], axis=1).astype(np.float64)
    slopes = None
    if run.lanes % 4 == 0:
        slopes = np.stack([across(u), across(v), up(u), up(v)]).astype(np.float64)
    color = np.ones((run.lanes, 4))
    for number, texture in enumerate(sampler.textures):
        if texture is None:
            continue
        chosen: Any = slice(None) if sampler.mesh is None else np.flatnonzero(sampler.mesh == number)
        of_mesh = None if slopes is None else slopes[:, chosen]
        color[chosen] = sampler.colors_of(texture, uv[chosen], of_mesh)
    return _colors(color)


def texel_at(values: Sequence[GlslValue], place: Place, run: Run) -> GlslValue:
    """Return texelFetch(sampler, texel, 0); outside of the texture it gives 0."""
    sampler: Sampler | None = values[0].parts[0]
    column, row = (np.broadcast_to(part, (run.lanes,)) for part in values[1].parts)
    if np.any(np.asarray(values[2].parts[0]) != 0):
        raise Problem(place, "texelFetch reads level 0 only here")
    if sampler is None or run.lanes == 0:
        return _colors(np.zeros((run.lanes, 4)))
    pixels = sampler.only(place).pixels
    height, width, channels = pixels.shape
    is_inside = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    found = pixels[np.where(is_inside, row, 0), np.where(is_inside, column, 0)]
    color = np.zeros((run.lanes, 4), np.float32)
    color[:, 3] = 1
    color[:, :channels] = found if channels > 1 else found[:, :1]
    if channels == 1:
        color[:, 1:3] = found
    return _colors(np.where(is_inside[:, None], color, 0))


def texture_size(values: Sequence[GlslValue], place: Place, run: Run) -> GlslValue:
    """Return textureSize(sampler, 0)."""
    sampler: Sampler | None = values[0].parts[0]
    if sampler is None:
        return GlslValue("ivec2", (np.int32(1), np.int32(1)))
    height, width, _ = sampler.only(place).pixels.shape
    return GlslValue("ivec2", (np.int32(width), np.int32(height)))


def _colors(color: Any) -> GlslValue:
    return GlslValue("vec4", tuple(np.ascontiguousarray(color.T.astype(np.float32))))
