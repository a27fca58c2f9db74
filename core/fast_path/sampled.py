"""Pictures of several samples a pixel the fast way: four by spans, or any number as a larger picture, band by band.

The samples of one place in all pixels are a picture of the moved scene (`core.antialiasing.resolve`), and the
spans find what is seen in it. Where the four samples of a pixel show one triangle, its colour at the centre is that of
the pixel: the mean of four equal numbers is that number, bit for bit. Only where samples differ is anything averaged.

The filter ``tent`` mixes the samples of neighbours, so all of them are coloured and resolved, a few rows at a time.

Bytes end at 1, and light does not: where a pixel has samples as bright as a byte can be beside darker ones, what was
cut off might have made it brighter. Such pixels are drawn by all buffers instead; and where alpha may be above 1, or
light below 0, all pixels whose samples reach either end.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from core.antialiasing.resolve import (
    at_sample,
    bands_of,
    filter_weights,
    finer_raster,
    finer_scene,
    finer_settings,
    grown,
    inner_of,
    reach_of,
    resolve_samples,
    samples_by_place,
)
from core.antialiasing.sampling import ROTATED_GRID
from core.coverage.pixel_runs import Raster
from core.fast_path.draw_context import (
    DepthStatistics,
    DrawContext,
    Picture,
    Route,
    Split,
    Words,
    blocks,
    encode,
)
from core.fast_path.fragment_colors import FragmentColors
from core.fast_path.opaque import find_visible
from core.fast_path.unlit import palette
from core.framebuffer.blending import blend_traits
from core.framebuffer.display import Bytes, from_display
from core.numeric.large_arrays import ScratchBuffers
from core.pipeline import draw
from core.records.arrays import Flags, Floats, Integers, Singles, read_only
from core.records.frame import StageCount
from core.resolved import resolve
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.stages.declared import STAGES
from core.stages.vertices import process_geometry

# A multisampled picture the fast way: what each of the four samples shows by spans, then colours once a
# triangle.


Numbers = NDArray[np.int32]
"""(4, N) what every sample of N pixels shows: a primitive plus one, 0 for none."""
PIXELS_OF_BAND = 1 << 16
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
    for band in bands_of(raster, 1, PIXELS_OF_BAND):
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


# A supersampled picture the fast way: the bytes of its samples, drawn as any picture, resolved in linear
# light.


SAMPLES_OF_BAND = 1 << 19
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
    yield from bands_of(raster, 1, SAMPLES_OF_BAND // (side * side))


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
