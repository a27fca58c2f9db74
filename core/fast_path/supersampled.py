"""A supersampled picture the fast way: the bytes of its samples, drawn as any picture, resolved in linear light.

Bytes end at 1, and light does not: where a pixel has samples as bright as a byte can be beside darker ones, what was
cut off might have made it brighter. Such pixels are drawn by all buffers instead; and where alpha may be above 1, or
light below 0, all pixels whose samples reach either end.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from core.antialiasing.sample_rasters import (
    bands_of,
    finer_raster,
    finer_scene,
    finer_settings,
    grown,
    inner_of,
    samples_by_place,
)
from core.fast_path.draw_context import Words, encode
from core.fast_path.record import Picture, Route
from core.framebuffer.blending import blend_traits
from core.framebuffer.display import Bytes, from_display
from core.framebuffer.resolve import filter_weights, reach_of, resolve_samples
from core.numeric.buffers import ScratchBuffers
from core.pipeline import draw
from core.raster.pixel_runs import Raster
from core.records.arrays import Flags, Singles, read_only
from core.records.frame import StageCount
from core.resolved import resolve
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.stages.declared import STAGES

BAND = 1 << 19
"""Samples that are drawn and resolved in one go."""
BRIGHTEST = 255


def draw_supersampled(
    draw_picture: Callable[..., Picture],
    scene: AnyScene,
    settings: Settings,
    raster: Raster,
    encoding: str,
    pixels: Words,
    scratch: ScratchBuffers,
) -> Picture:
    """Draw a picture with n x n samples a pixel into ``pixels`` (H*W,).

    Parameters
    ----------
    draw_picture : callable
        Draws the samples, as a picture of n times the size.
    """
    sampling = resolve(settings).sampling
    side = sampling.side
    finer, plain = finer_scene(scene, side), finer_settings(settings)
    weights = filter_weights(sampling.position, settings.resolve_filter)
    is_unusual = _has_unusual_light(scene, settings)
    counts = {stage: StageCount() for stage in STAGES}
    route = Route("supersampled", "corners")
    for band in _pixel_bands(raster, side):
        wide_pixels = grown(band, reach_of(weights))
        drawn = draw_picture(finer, plain, region=_region(finer_raster(wide_pixels, side)), scratch=scratch)
        _add(counts, drawn.statistics)
        route = replace(route, color=drawn.route.color, visible=route.visible + drawn.route.visible)
        with counts["resolve"]:
            samples = samples_by_place(drawn.pixels, side)
            inner = inner_of(wide_pixels, band)
            light = from_display(samples.reshape(-1, *samples.shape[2:])).reshape(samples.shape)
            color = resolve_samples(light, weights)[inner]
            cut_off = is_cut_off(samples, reach_of(weights), is_unusual)[inner]
        if cut_off.any():
            _draw_exactly(color, cut_off, scene, settings, band, counts)
        with counts["resolve"]:
            at = (band.bounds[1] - raster.bounds[1]) * raster.shape[1]
            pixels[at : at + cut_off.size] = encode(color.reshape(-1, 4), encoding)
    counts["resolve"].incoming, counts["resolve"].outgoing = side * side * len(pixels), len(pixels)
    return Picture(read_only(pixels.view("u1").reshape(*raster.shape, 4)), None, counts, route)


def _has_unusual_light(scene: AnyScene, settings: Settings) -> bool:
    """Return whether light may be below 0, or alpha above 1: given so, or added by fragments that hide nothing."""
    if not blend_traits(settings.blend).hides(np.ones(1)).all():
        return True
    if isinstance(scene, ClipScene):
        assert scene.attributes is not None
        textures = [scene.texture]
        colors = [scene.background, scene.attributes[..., : 4 if scene.texture is None else 0]]
    else:
        textures = [mesh.texture for mesh in scene.meshes]
        colors = [scene.background, *(mesh.colors for mesh in scene.meshes if mesh.colors is not None)]
        if any(light.color.min() < 0 for light in scene.lights):
            return True
    if any(texture is not None and texture.has_negative_light for texture in textures):
        return True
    return any(of.min(initial=0.0) < 0 or of[..., 3:].max(initial=0.0) > 1 for of in colors)


def is_cut_off(samples: Bytes, reach: int, is_unusual: bool) -> Flags:
    """Tell of which pixels light may have been cut off before it was averaged with other samples.

    Parameters
    ----------
    samples : (S, H, W, 4) uint8
    reach : int
        How many pixels away the filter looks: 0 or 1.
    is_unusual : bool
        Whether not only red, green and blue may be above 1, but alpha too, and any of them below 0.

    Returns
    -------
    (H, W) bool
    """
    shown = samples if is_unusual else samples[..., :3]
    greatest, least = shown.max(axis=0), shown.min(axis=0)
    if reach:
        greatest, least = _over_neighbours(greatest, np.maximum), _over_neighbours(least, np.minimum)
    found: Flags = (greatest == BRIGHTEST) & (least < BRIGHTEST)
    if is_unusual:
        found |= (least == 0) & (greatest > 0)
    return np.asarray(found.any(axis=2))


def _over_neighbours(values: Bytes, choose: Callable[..., Bytes]) -> Bytes:
    """Return the greatest or least of values (H, W, C) over 3 x 3 pixels."""
    result = values.copy()
    result[1:] = choose(result[1:], values[:-1])
    result[:-1] = choose(result[:-1], values[1:])
    across = result.copy()
    result[:, 1:] = choose(result[:, 1:], across[:, :-1])
    result[:, :-1] = choose(result[:, :-1], across[:, 1:])
    return result


def _draw_exactly(
    color: Singles,
    chosen: Flags,
    scene: AnyScene,
    settings: Settings,
    raster: Raster,
    counts: dict[str, StageCount],
) -> None:
    """Draw the ``chosen`` (H, W) pixels of a raster by all buffers, into ``color`` (H, W, 4)."""
    rows, columns = np.flatnonzero(chosen.any(axis=1)), np.flatnonzero(chosen.any(axis=0))
    first_column, first_row, _, _ = raster.bounds
    at = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
    size = int(columns[-1] - columns[0]) + 1, int(rows[-1] - rows[0]) + 1
    region = (first_column + int(columns[0]), first_row + int(rows[0]), *size)
    frame = draw(scene, settings, replace(raster, region=region))
    _add(counts, frame.statistics)
    color[at][chosen[at]] = frame.color[chosen[at]]


def _pixel_bands(raster: Raster, side: int) -> Iterator[Raster]:
    """Yield parts of a raster of pixels whose samples are drawn in one go."""
    yield from bands_of(raster, 1, BAND // (side * side))


def _region(raster: Raster) -> tuple[int, int, int, int]:
    first_column, first_row, end_column, end_row = raster.bounds
    return first_column, first_row, end_column - first_column, end_row - first_row


def _add(counts: dict[str, StageCount], of_band: dict[str, StageCount]) -> None:
    """Add the counts of a band: each of them has all triangles, and pixels of its own."""
    for stage, count in of_band.items():
        place = STAGES.index(stage)
        is_of_triangles, gives_pixels = place <= STAGES.index("bin"), place >= STAGES.index("bin")
        counts[stage].incoming = count.incoming + (0 if is_of_triangles else counts[stage].incoming)
        counts[stage].outgoing = count.outgoing + (counts[stage].outgoing if gives_pixels else 0)
        counts[stage].seconds += count.seconds
        counts[stage].note = count.note
