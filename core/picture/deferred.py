"""Deferred colour: attributes and light once for every visible pixel, by the rules of every other picture."""

import numpy as np
from numpy.typing import NDArray

from core.arrays import Integers
from core.fragments.interpolation import Interpolator
from core.frame import StageCount
from core.framebuffer.display import encode_linear, write_pixels
from core.framebuffer.nearest import NearestFragments
from core.geometry_stages import Geometry, timed
from core.raster.schedule import Raster
from core.raster.spans.arena import Arena
from core.scene import AnyScene
from core.settings import Settings
from core.surface import shade_fragments

BLOCK = 1 << 15
"""Pixels that are shaded together: their numbers stay in the processor's cache."""

Words = NDArray[np.uint32]


def shade_visible(
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    nearest: NearestFragments,
    encoding: str,
    pixels: Words,
    counts: dict[str, StageCount],
    arena: Arena,
) -> int:
    """Write the bytes of all pixels that something is seen at, (H*W,) uint32; return how many there are.

    The others keep what they have: the background.
    """
    with timed(counts["interpolate"]):
        values = geometry.primitives.values
        interpolator = Interpolator(geometry.planes, values, settings.interpolation, settings.provoking)
    seen_count = 0
    for first in range(0, len(pixels), BLOCK):
        part = slice(first, first + BLOCK)
        with timed(counts["depth"]):
            place, primitive = nearest.seen_in(part)
        if not len(place):
            continue
        seen_count += len(place)
        with timed(counts["interpolate"]):
            column, row = raster.position(np.add(place, first))
            x, y = raster.centers(column, row)
            rows = arena("values", interpolator.value_count, len(place))
            interpolated = interpolator.values(primitive, x, y, rows)
        with timed(counts["shade"]):
            mesh = _mesh_of(geometry, primitive)
            color = shade_fragments(scene, settings, values.layout, mesh, interpolated).color
        with timed(counts["resolve"]):
            pixels[part][place] = encode(color, encoding)
    return seen_count


def _mesh_of(geometry: Geometry, primitive: Integers) -> Integers:
    return geometry.primitives.mesh.take(primitive)


def encode(color: np.ndarray, encoding: str) -> Words:
    """Return the bytes of linear colours (F, 4), a word each, red lowest: ``srgb`` or ``linear``."""
    with np.errstate(over="ignore"):
        single = np.ascontiguousarray(color, np.float32)
    if encoding == "linear":
        encoded = encode_linear(single)
    else:
        encoded = np.empty(single.shape, np.uint8)
        write_pixels(single, encoded)
    return encoded.view(np.uint32).reshape(-1)
