"""A multisampled picture the fast way: what each of the four samples shows by spans, then colours once a triangle.

The samples of one place in all pixels are a picture of the moved scene (`core.antialiasing.sample_rasters`), and the
spans find what is seen in it. Where the four samples of a pixel show one triangle, its colour at the centre is that of
the pixel: the mean of four equal numbers is that number, bit for bit. Only where samples differ is anything averaged.

The filter ``tent`` mixes the samples of neighbours, so all of them are coloured and resolved, a few rows at a time.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from core.antialiasing.sample_rasters import at_sample, bands_of, grown, inner_of
from core.antialiasing.sampling import ROTATED_GRID
from core.fast_path.draw_context import DrawContext, Words, blocks
from core.fast_path.fragment_colors import FragmentColors
from core.fast_path.palette import palette
from core.fast_path.record import DepthStatistics, Route, Split
from core.fast_path.visible import find_visible
from core.framebuffer.resolve import filter_weights, reach_of, resolve_samples
from core.numeric.buffers import ScratchBuffers
from core.raster.pixel_runs import Raster
from core.records.arrays import Floats, Integers, Singles
from core.records.frame import StageCount
from core.scene import AnyScene
from core.settings import Settings
from core.stages.vertices import process_geometry

Numbers = NDArray[np.int32]
"""(4, N) what every sample of N pixels shows: a primitive plus one, 0 for none."""
BAND = 1 << 16
"""Pixels whose samples are coloured and resolved together."""


def draw_multisampled(
    scene: AnyScene,
    settings: Settings,
    raster: Raster,
    encoding: str,
    pixels: Words,
    counts: dict[str, StageCount],
    scratch: ScratchBuffers,
) -> tuple[Route, DepthStatistics]:
    """Draw opaque filled triangles with four samples a pixel into ``pixels`` (H*W,): the bytes of `render`."""
    weights = filter_weights(ROTATED_GRID, settings.resolve_filter)
    wide = grown(raster, reach_of(weights))
    room = pixels
    if len(pixels) != wide.shape[0] * wide.shape[1]:
        room = scratch("wide_pixels", wide.shape[0] * wide.shape[1], dtype=np.uint32)
    geometry = process_geometry(scene, settings, counts)
    context = DrawContext(scene, settings, geometry, wide, encoding, room, counts, scratch)
    numbers, split = _find_samples(context)
    route = Route("multisampled", "deferred", split, int(np.count_nonzero(numbers.any(axis=0))))
    sample_count = int(np.count_nonzero(numbers))
    if reach_of(weights):
        return route, DepthStatistics(sample_count, _resolve_all(context, numbers, weights, raster, pixels))
    with context.timed("shade"):
        of_triangles = palette(context)
    words = None if of_triangles is None else context.encode(of_triangles)
    colors, looked_up = FragmentColors(context), 0
    for part in blocks(len(pixels)):
        number = numbers[:, part]
        is_mixed = (number[1:] != number[0]).any(axis=0)
        pixels[part] = context.background
        looked_up += _color_alike(context, colors, words, np.where(is_mixed, 0, number[0]), part)
        mixed = np.flatnonzero(is_mixed)
        color = sample_colors(context, colors, number[:, mixed], mixed + part.start)
        with context.timed("resolve"):
            pixels[part][mixed] = context.encode(resolve_samples(color[:, None], weights)[0])
    passing = DepthStatistics(sample_count, colors.count + looked_up)
    return route if words is None else replace(route, color="palette"), passing


def _find_samples(context: DrawContext) -> tuple[Numbers, Split]:
    """Return what every sample shows, and how the last one was drawn, with the fragments of all."""
    numbers: Numbers = context.scratch(
        "sample_numbers", len(ROTATED_GRID), len(context.pixels), dtype=np.int32
    )
    fragments = 0
    for sample, number in enumerate(numbers):
        nearest, split = find_visible(replace(context, geometry=at_sample(context.geometry, sample)))
        fragments += split.fragments
        with context.timed("depth"):
            for part in blocks(len(number)):
                of_block = context.scratch("numbers_of_block", len(number[part]), dtype=np.int64)
                number[part] = nearest.number_in(part, of_block)
    return numbers, replace(split, fragments=fragments)


def _color_alike(
    context: DrawContext, colors: FragmentColors, words: Words | None, number: Numbers, part: slice
) -> int:
    """Write the pixels of a part of the picture that one triangle has all samples of.

    ``number`` (N,) is its primitive plus one, 0: leave the pixel; ``words`` (P,) the colours of triangles of one each,
    and what is returned how many of them were looked up.
    """
    place = np.flatnonzero(number)
    primitive = number.take(place).astype(np.int64) - 1
    if words is None:
        color = colors.at(primitive, *context.raster.position(place + part.start))
    with context.timed("resolve"):
        context.pixels[part][place] = context.encode(color) if words is None else words.take(primitive)
    return 0 if words is None else len(place)


def sample_colors(context: DrawContext, colors: FragmentColors, number: Numbers, place: Integers) -> Singles:
    """Return the linear colours (4, N, 4) float32 of the samples of pixels, one shade for a triangle in a pixel.

    Parameters
    ----------
    number : (4, N) int32
        What every sample shows, plus one; 0 for none.
    place : (N,) int64
        The pixels, in the flattened raster of the context.
    """
    with context.timed("blend"):
        # The first sample of the pixel that shows the same is shaded for all of them.
        first = (number[:, None] == number[None]).argmax(axis=1)
        is_first = (first == np.arange(len(number))[:, None]) & (number > 0)
        _, of_pixel = np.nonzero(is_first)
        row_of_color = np.zeros(number.shape, np.int64)
        row_of_color[is_first] = np.arange(1, len(of_pixel) + 1)
        row_of_color = np.take_along_axis(row_of_color, first, axis=0)
    shaded = np.empty((len(of_pixel) + 1, 4), np.float32)
    shaded[0] = context.scene.background
    pixel, primitive = place.take(of_pixel), number[is_first].astype(np.int64) - 1
    for part in blocks(len(pixel)):
        with np.errstate(over="ignore"):
            shaded[1:][part] = colors.at(primitive[part], *context.raster.position(pixel[part]))
    with context.timed("blend"):
        return shaded.take(row_of_color, axis=0)


def _resolve_all(
    context: DrawContext, numbers: Numbers, weights: Floats, raster: Raster, pixels: Words
) -> int:
    """Colour all samples of a context's raster, and resolve those of ``raster`` into ``pixels`` (H*W,).

    Returns how many fragments were coloured.
    """
    colors = FragmentColors(context)
    for band in bands_of(raster, 1, BAND):
        around = grown(band, reach_of(weights))
        rows, _ = inner_of(context.raster, around)
        place = np.arange(rows.start * context.raster.shape[1], rows.stop * context.raster.shape[1])
        color = sample_colors(context, colors, numbers[:, place], place)
        with context.timed("resolve"):
            resolved = resolve_samples(color.reshape(len(color), *around.shape, 4), weights)
            at = (band.bounds[1] - raster.bounds[1]) * raster.shape[1]
            inner = resolved[inner_of(around, band)].reshape(-1, 4)
            pixels[at : at + len(inner)] = context.encode(inner)
    return colors.count
