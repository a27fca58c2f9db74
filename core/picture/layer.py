"""A single layer: where no pixel belongs to two triangles there is nothing to hide, and no depth is needed.

Colours go straight to the pixels. Whether the assumption held is counted afterwards: if as many pixels were written
as the triangles have, no pixel was written twice, and the picture is that of every depth test; if not, it is drawn
again with depth. The surface of a convex solid without its back faces is a single layer, and so is one triangle.
"""

import numpy as np
from numpy.typing import NDArray

from core.arrays import Flags, Integers
from core.frame import StageCount
from core.geometry_stages import Geometry, timed
from core.picture.byte_colors import ByteColors
from core.picture.byte_words import unpack
from core.picture.palette import PaletteColors
from core.picture.textured import TextureColors
from core.picture.visible import chunks, lanes_of
from core.raster.schedule import Raster
from core.raster.spans.arena import Arena
from core.raster.spans.bands import BIG_AREA, bands, spans_by_row
from core.raster.spans.lanes import tie_owners
from core.raster.spans.packed import FEW, WordSpans, word_spans, write_out
from core.settings import Settings

Words = NDArray[np.uint32]
LayerColors = PaletteColors | ByteColors | TextureColors


def draw_layer(
    geometry: Geometry,
    colors: LayerColors,
    settings: Settings,
    raster: Raster,
    background: np.uint32,
    pixels: Words,
    counts: dict[str, StageCount],
    arena: Arena,
) -> int | None:
    """Draw all primitives over the background; return how many fragments there are, ``None`` if they overlap.

    Parameters
    ----------
    geometry : Geometry
        All corners projected, all triangles between the near and the far plane.
    colors : PaletteColors, ByteColors or TextureColors
        No pixel that they give is 0.
    pixels : (H*W,) uint32
        Is written.
    """
    is_checked = len(geometry.primitives) > 1
    with timed(counts["resolve"]):
        pixels.fill(0 if is_checked else background)
    is_big: Flags = np.abs(geometry.doubled_area) > 2 * BIG_AREA
    if isinstance(colors, TextureColors):
        is_big[:] = True
        fragments = 0
    else:
        fragments = _write_small(geometry, colors, ~is_big, settings, raster, pixels, counts, arena)
    image = pixels.reshape(raster.shape)
    for triangle in np.flatnonzero(is_big).tolist():
        fragments += draw_bands(geometry, colors, triangle, settings, raster, image, counts, arena)
    if is_checked:
        with timed(counts["resolve"]):
            if int(np.count_nonzero(pixels)) != fragments:
                return None
            np.copyto(pixels, background, where=pixels == 0)
    return fragments


def _write_small(
    geometry: Geometry,
    colors: PaletteColors | ByteColors,
    chosen: Flags,
    settings: Settings,
    raster: Raster,
    pixels: Words,
    counts: dict[str, StageCount],
    arena: Arena,
) -> int:
    """Write the ``chosen`` (P,) triangles along their spans; return how many pixels they have."""
    if not chosen.any():
        return 0
    owners, fragments = tie_owners(settings.fill_rule), 0
    with timed(counts["interpolate"]):
        planes = colors.packed()
    for first, end in chunks(len(geometry.primitives)):
        with timed(counts["bin"]):
            lanes = lanes_of(geometry, first, end, chosen, raster, owners, arena)
        with timed(counts["raster"]):
            spans = word_spans(planes.part(first, end), lanes, raster, owners, arena)
            fragments += spans.pixel_count
        with timed(counts["shade"]):
            write_words(pixels, spans, arena)
    return fragments


def draw_bands(
    geometry: Geometry,
    colors: LayerColors,
    triangle: int,
    settings: Settings,
    raster: Raster,
    image: Words,
    counts: dict[str, StageCount],
    arena: Arena,
) -> int:
    """Write the pixels of one triangle to ``image`` (H, W) uint32; return how many it has."""
    owners = tie_owners(settings.fill_rule)
    with timed(counts["bin"]):
        lanes = lanes_of(geometry, triangle, triangle + 1, None, raster, owners, arena)
    if isinstance(colors, PaletteColors):
        with timed(counts["shade"]):
            return fill_rows(
                image, *spans_by_row(lanes, raster, owners, arena), colors.words[triangle], raster
            )
    fragments = 0
    with timed(counts["shade"]):
        for band in bands(lanes, raster, owners, arena):
            block = colors.block(triangle, band, raster, arena)
            there = image[band.rows, band.columns]
            first, end = 0, block.shape[1]
            for columns, outside in band.outside():
                np.copyto(there[:, columns], block[:, columns], where=~outside)
                if columns.start == 0:
                    first = columns.stop
                else:
                    end = columns.start
            there[:, first:end] = block[:, first:end]
            fragments += int((band.stop - band.start).sum())
    return fragments


def fill_rows(
    image: Words, first_row: int, start: Integers, stop: Integers, color: np.uint32, raster: Raster
) -> int:
    """Fill rows from ``first_row`` on with one colour, from start to stop (R,); return how many pixels they have.

    Notes
    -----
    A slice of a memoryview is the quickest way that Python has to copy a row: 0.25 us, a NumPy slice takes twice that.
    """
    first_column, bottom, _, _ = raster.bounds
    row_bytes = image.strides[0]
    row = np.full(image.shape[1], color, np.uint32).data.cast("B")
    target = image.reshape(-1).data.cast("B")
    begin = (np.arange(len(start)) + (first_row - bottom)) * row_bytes
    begins = (begin + (start - first_column) * 4).tolist()
    ends = (begin + (stop - first_column) * 4).tolist()
    for at, end in zip(begins, ends, strict=True):
        target[at:end] = row[: end - at]
    return int((stop - start).sum())


def write_words(pixels: Words, spans: WordSpans, arena: Arena) -> None:
    """Write the colours of spans (used up) to pixels (H*W,): pass k writes the k-th pixel of every long enough span."""
    pixel, word, step = spans.pixel, spans.word, spans.step
    for passes, count in enumerate(spans.longer):
        if count < FEW:
            span, place = write_out(spans.longer[passes:])
            pixels[pixel[span] + place] = unpack(word[span] + place * step[span], arena)
            return
        pixels[pixel[:count]] = unpack(word[:count], arena)
        pixel[:count] += 1
        word[:count] += step[:count]
