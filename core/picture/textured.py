"""Large triangles with nothing but a texture: coordinates band by band, texels packed, bytes at once.

For a picture whose bytes are linear, of triangles so few and large that a band of each is worth its calls; see
``packed_texture`` for how close the bytes are.
"""

import numpy as np
from numpy.typing import NDArray

from core.fragments.interpolation import value_plane
from core.fragments.packed_texture import PackedSampler, is_packable, linear_levels
from core.framebuffer.display import encode_linear
from core.framebuffer.nearest import NearestFragments
from core.geometry_stages import Geometry
from core.picture.visible import lanes_of
from core.raster.schedule import Raster
from core.raster.spans.arena import Arena
from core.raster.spans.bands import Band, bands
from core.raster.spans.lanes import tie_owners
from core.scene import AnyScene, ClipScene, Texture
from core.settings import Settings

Words = NDArray[np.uint32]

MOST = 64
"""Triangles: of more, bands are not worth their calls."""


class TextureColors:
    """Colours of textured triangles, block by block.

    Parameters
    ----------
    geometry : Geometry
    texture : Texture
        Packable.
    settings : Settings
    """

    name = "texture"
    stage = "shade"
    fits_layer = True

    def __init__(self, geometry: Geometry, texture: Texture, settings: Settings) -> None:
        self._geometry = geometry
        self._owners = tie_owners(settings.fill_rule)
        values = geometry.primitives.values
        uv = values.rows[:, values.layout["uv"]]
        corner_values = (uv[:, axis].take(values.index).T for axis in range(2))
        self._planes = [geometry.inverse_w_plane, *(value_plane(geometry.planes, of) for of in corner_values)]
        levels = encode_linear(linear_levels())
        self._sampler = PackedSampler(texture, settings.texture_filter, settings.wrap, levels)

    def block(self, triangle: int, band: Band, raster: Raster, arena: Arena) -> Words:
        """Return the pixels (R, C) uint32 of one triangle at all pixels of a band's block."""
        x, y = raster.along(band.column), raster.along(band.row)
        shape = (len(y), len(x))
        inverse_w, u, v = (arena(f"texture_{name}", *shape, dtype=np.float32) for name in ("w", "u", "v"))
        for values, (a, b, c) in zip((inverse_w, u, v), self._planes, strict=True):
            ramp, of_row = a[triangle] * x, b[triangle] * y + c[triangle]
            np.add(ramp.astype(np.float32), of_row.astype(np.float32)[:, None], out=values)
        with np.errstate(divide="ignore", invalid="ignore"):
            np.divide(np.float32(1), inverse_w, out=inverse_w)
            u *= inverse_w
            v *= inverse_w
        pixels = arena("texture_pixels", *shape, dtype=np.uint32)
        self._sampler.write_words(u.reshape(-1), v.reshape(-1), pixels.reshape(-1))
        return pixels

    def look_up(self, nearest: NearestFragments, raster: Raster, pixels: Words, arena: Arena) -> int:
        """Write the colour of what is seen at every pixel (H*W,) uint32; return how many there are.

        The others keep what they have: the background.
        """
        number = nearest.number_in(slice(None), np.empty(len(pixels), np.int64)).reshape(raster.shape)
        image = pixels.reshape(raster.shape)
        for triangle in range(len(self._geometry.primitives)):
            lanes = lanes_of(self._geometry, triangle, triangle + 1, None, raster, self._owners, arena)
            for band in bands(lanes, raster, self._owners, arena):
                is_seen = number[band.rows, band.columns] == triangle + 1
                if is_seen.any():
                    block = self.block(triangle, band, raster, arena)
                    np.copyto(image[band.rows, band.columns], block, where=is_seen)
        return int(np.count_nonzero(number))


def texture_colors(
    scene: AnyScene, geometry: Geometry, settings: Settings, encoding: str
) -> TextureColors | None:
    """Return the colours of all primitives, or ``None`` where they are more than one texture, or too many."""
    if encoding != "linear" or len(geometry.primitives) > MOST or settings.interpolation != "perspective":
        return None
    if settings.texture_filter not in ("bilinear", "nearest"):
        return None
    texture = _only_texture(scene)
    if texture is None or not is_packable(texture):
        return None
    values = geometry.primitives.values
    if not set(values.layout) <= {"uv", "color"} or not geometry.is_projected.all():
        return None
    if not isinstance(scene, ClipScene) and (values.rows[:, values.layout["color"]] != 1).any():
        return None
    return TextureColors(geometry, texture, settings)


def _only_texture(scene: AnyScene) -> Texture | None:
    """Return the texture that everything in the scene has."""
    if isinstance(scene, ClipScene):
        return scene.texture
    return scene.meshes[0].texture if len(scene.meshes) == 1 else None
