"""A single layer: where no pixel belongs to two triangles there is nothing to hide, and no depth is needed.

Colours go straight to the pixels. Whether the assumption held is counted afterwards: if as many pixels were written
as the triangles have, no pixel was written twice, and the picture is that of every depth test; if not, it is drawn
again with depth. The surface of a convex solid without its back faces is a single layer, and so is one triangle.
"""

from typing import TYPE_CHECKING

import numpy as np

from core.fast_path.draw_context import DrawContext, Words
from core.fast_path.palette import PaletteColors
from core.fast_path.record import Split
from core.fast_path.textured import TextureColors
from core.numeric.byte_words import unpack
from core.raster.pixel_runs import Raster
from core.raster.spans.bands import BIG_AREA, TriangleRows, strips
from core.raster.spans.packed import each_pass, word_spans
from core.records.arrays import Flags, Integers

if TYPE_CHECKING:  # the first picture of one colour a triangle does not wait for these
    from core.fast_path.byte_colors import ByteColors
    from core.fast_path.corner_colors import CornerColors

    LayerColors = PaletteColors | CornerColors | TextureColors


def draw_layer(context: DrawContext, colors: "LayerColors") -> Split | None:
    """Draw all primitives over the background; return which way they went, ``None`` if they overlap.

    All corners are projected, and every fragment would pass the depth test; no pixel that ``colors`` give is 0.
    """
    geometry, pixels = context.geometry, context.pixels
    is_checked = len(geometry.primitives) > 1
    with context.timed("resolve"):
        pixels.fill(0 if is_checked else context.background)
    chosen = np.ones(len(geometry.primitives), bool)
    is_big: Flags = np.abs(geometry.doubled_area) > 2 * BIG_AREA
    fragments = 0
    if isinstance(colors, TextureColors):
        is_big = chosen
    elif isinstance(colors, PaletteColors):
        fragments = _write_small(context, colors, ~is_big)
    else:
        chosen = ~colors.is_light
        fragments = colors.write_light() + _write_small(context, colors.bytes, chosen & ~is_big)
    big = np.flatnonzero(chosen & is_big)
    fragments += _write_big(
        context, colors if isinstance(colors, PaletteColors | TextureColors) else colors.bytes, big
    )
    if is_checked:
        with context.timed("resolve"):
            if int(np.count_nonzero(pixels)) != fragments:
                return None
            np.copyto(pixels, context.background, where=pixels == 0)
    if not isinstance(colors, PaletteColors | TextureColors):
        colors.write_plain(context)
    return Split(len(is_big) - len(big), len(big), 0, fragments)


def _write_small(context: DrawContext, colors: "PaletteColors | ByteColors", chosen: Flags) -> int:
    """Write the ``chosen`` (P,) triangles along their spans; return how many pixels they have."""
    if not chosen.any():
        return 0
    fragments = 0
    with context.timed("interpolate"):
        planes = colors.packed()
    for first, end, lanes in context.walks(chosen):
        with context.timed("raster"):
            spans = word_spans(
                planes.part(first, end), lanes, context.raster, context.owners, context.scratch
            )
            fragments += spans.pixel_count
        with context.timed("shade"):
            for k, pixel, word in each_pass(spans):
                context.pixels[k:][pixel] = unpack(word, context.scratch)
    return fragments


def _write_big(
    context: DrawContext, colors: "PaletteColors | ByteColors | TextureColors", chosen: Integers
) -> int:
    """Write the pixels of the ``chosen`` (C,) triangles; return how many they have."""
    image = context.pixels.reshape(context.raster.shape)
    fragments = 0
    for triangle, rows in context.rows_of_each(chosen):
        fragments += rows.pixel_count
        with context.timed("shade"):
            if isinstance(colors, PaletteColors):
                fill_rows(image, rows, colors.words[triangle], context.raster)
            else:
                for strip in strips(rows):
                    copy_rows(image, colors.block(context, triangle, strip), strip.inside, context.raster)
    return fragments


def fill_rows(image: Words, rows: TriangleRows, color: np.uint32, raster: Raster) -> None:
    """Fill the rows of a triangle with one colour."""
    source = np.full(image.shape[1], color, np.uint32).data.cast("B")
    target = image.reshape(-1).data.cast("B")
    begins, ends, lengths = _bytes_of_rows(image, rows, raster)
    for begin, end, length in zip(begins, ends, lengths, strict=True):
        target[begin:end] = source[:length]


def copy_rows(image: Words, block: Words, rows: TriangleRows, raster: Raster) -> None:
    """Copy the rows of a block (R, C) to those of a triangle, from its start on."""
    source, target = block.reshape(-1).data.cast("B"), image.reshape(-1).data.cast("B")
    begins, ends, lengths = _bytes_of_rows(image, rows, raster)
    starts = range(0, source.nbytes, block.strides[0])
    for begin, end, start, length in zip(begins, ends, starts, lengths, strict=True):
        target[begin:end] = source[start : start + length]


def _bytes_of_rows(
    image: Words, rows: TriangleRows, raster: Raster
) -> tuple[list[int], list[int], list[int]]:
    """Return at which bytes of the image rows begin and end, and how many these are.

    Notes
    -----
    A slice of a memoryview is the quickest way that Python has to copy a row: 0.25 us, a NumPy slice takes twice that.
    """
    first_column, bottom, _, _ = raster.bounds
    begin = (rows.row - bottom) * image.strides[0] + (rows.start - first_column) * 4
    length = (rows.stop - rows.start) * 4
    return begin.tolist(), (begin + length).tolist(), length.tolist()
