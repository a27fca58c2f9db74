"""An opaque picture by spans: what is seen at every pixel, the cheapest colours with the right bytes, one layer.

Triangles go to the drawing that suits them: those whose depth is linear in packed words, or rounded on a plane, walk
along spans, the large ones in bands; the others (corners that cannot be projected, triangles that the near or the far
plane cuts, 1/w and its logarithm, no depth test) are looked at fragment by fragment, as every other fill does. All of
them keep the least word, so the order does not matter and every fill sees the same triangle at the same pixel.

Colours go straight to the pixels. Whether the assumption held is counted afterwards: if as many pixels were written
as the triangles have, no pixel was written twice, and the picture is that of every depth test; if not, it is drawn
again with depth. The surface of a convex solid without its back faces is a single layer, and so is one triangle.

The files of each way are imported when it is first taken, as in `core.fast_path.draw`.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias
from weakref import WeakKeyDictionary

import numpy as np

from core.coverage.pixel_runs import Raster
from core.depth.depth import NearestFragments
from core.depth.fixed_depth import SLACK
from core.fast_path.draw_context import DrawContext, Route, Split, Words
from core.fast_path.unlit import PaletteColors, TextureColors, palette
from core.numeric.planes import IntegerPlanes, unpack
from core.records.arrays import Flags, Integers, Singles, read_only
from core.scene import AnyScene, ClipScene, Mesh
from core.spans.bands import BIG_AREA, TriangleRows, bands, draw_band_words, strips
from core.spans.words import (
    DepthPlanes,
    draw_plane_words,
    draw_words,
    each_pass,
    plane_spans,
    word_block,
    word_spans,
)

if TYPE_CHECKING:
    from core.fast_path.byte_colors import ByteColors
    from core.fast_path.corner_colors import CornerColors, SmoothColors


# What is seen at every pixel: depth and triangle number, for all triangles at once.


Planes = IntegerPlanes | DepthPlanes


def find_visible(context: DrawContext) -> tuple[NearestFragments, Split]:
    """Return the nearest fragment of every pixel."""
    geometry = context.geometry
    with context.timed("depth"):
        memory = context.scratch("words", len(context.pixels), dtype=np.int64)
        nearest = NearestFragments(
            len(context.pixels),
            len(geometry.primitives),
            context.depth_format,
            geometry.drawing.uses_depth_test,
            memory,
        )
    with context.timed("edges"):
        planes, is_walked = _word_planes(context, nearest)
    is_big = is_walked & (np.abs(geometry.doubled_area) > 2 * BIG_AREA)
    fragments = 0
    if planes is not None:
        fragments += _walk(context, nearest.keys, planes, is_walked & ~is_big)
        fragments += _draw_big(context, nearest.keys, planes, np.flatnonzero(is_big))
    rest = np.flatnonzero(~is_walked)
    if len(rest):
        fragments += _one_by_one(context, nearest, rest)
    big = int(np.count_nonzero(is_big))
    return nearest, Split(int(np.count_nonzero(is_walked)) - big, big, len(rest), fragments)


def _word_planes(context: DrawContext, nearest: NearestFragments) -> tuple[Planes | None, Flags]:
    """Return the words of all primitives as planes, and for which (P,) they hold: these walk along spans."""
    geometry, depth_format = context.geometry, context.depth_format
    count = len(geometry.primitives)
    quantity = depth_format.quantity
    if not geometry.drawing.uses_depth_test or quantity.plane == "inverse-w" or quantity.convert is not None:
        return None, np.zeros(count, bool)
    number = np.arange(1, count + 1)
    if depth_format.is_planar:
        fixed, bits = geometry.fixed_planes, nearest.primitive_bits
        depth = fixed.planes
        origin = ((depth.origin + SLACK) << bits) + number
        return IntegerPlanes(origin, depth.across << bits, depth.up << bits), fixed.is_linear
    plane = geometry.depth_plane if quantity.plane == "z" else geometry.reversed_plane
    planes = DepthPlanes(*plane, number, depth_format.scale, depth_format.larger_is_nearer)
    return planes, geometry.is_projected & geometry.is_in_range & planes.is_finite


def _walk(context: DrawContext, words: Integers, planes: Planes, chosen: Flags) -> int:
    """Draw the ``chosen`` (P,) triangles along their spans; return how many fragments there were."""
    raster, scratch = context.raster, context.scratch
    fragments = 0
    for first, end, lanes in context.walks(chosen):
        part = planes.part(first, end)
        if isinstance(part, IntegerPlanes):
            with context.timed("raster"):
                word_rows = word_spans(part, lanes, raster, context.owners, scratch)
            with context.timed("depth"):
                fragments += word_rows.pixel_count
                draw_words(words, word_rows)
        else:
            with context.timed("raster"):
                rows = plane_spans(lanes, raster, context.owners, scratch)
            with context.timed("depth"):
                fragments += rows.pixel_count
                draw_plane_words(words, part, rows, lanes.triangle, raster, scratch)
    return fragments


def _draw_big(context: DrawContext, words: Integers, planes: Planes, chosen: Integers) -> int:
    """Draw the ``chosen`` (C,) triangles in bands; return how many fragments they had."""
    image = words.reshape(context.raster.shape)
    fragments = 0
    with context.timed("raster"):
        for triangle, rows in context.rows_of_each(chosen):
            for band in bands(rows, context.raster):
                if isinstance(planes, IntegerPlanes):
                    block = word_block(planes, triangle, band, context.scratch)
                else:
                    block = planes.block(triangle, band, context.raster, context.scratch)
                fragments += draw_band_words(image, band, block)
    return fragments


def _one_by_one(context: DrawContext, nearest: NearestFragments, chosen: Integers) -> int:
    """Look at the fragments of the ``chosen`` (C,) triangles; return how many there were."""
    # Most pictures have no such triangle and do not wait for it.
    from core.stages.bin_and_raster import covered
    from core.stages.fragments import fragment_depth

    raster = context.raster
    total = 0
    for fragments in covered(context.geometry, raster, context.counts, chosen):
        with context.timed("depth"):
            _, keeps, stored = fragment_depth(context.geometry, fragments, raster, context.depth_format)
            total += len(fragments)
            if not keeps.all():
                fragments, stored = fragments.select(keeps), stored[keeps]
            nearest.add(raster.index(fragments.column, fragments.row), fragments.primitive, stored)
    return total


# A single layer: where no pixel belongs to two triangles there is nothing to hide, and no depth is needed.


if TYPE_CHECKING:  # the first picture of one colour a triangle does not wait for these
    LayerColors: TypeAlias = PaletteColors | CornerColors | TextureColors


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


# An opaque picture by spans: the cheapest colours with the right bytes, and no depth where there is one
# layer.


FEW = 16
"""Triangles: so few are tried without depth, since it costs little."""

_overlaps: WeakKeyDictionary[Mesh | ClipScene, bool] = WeakKeyDictionary()
"""Scenes, by their first mesh, that turned out to have more than one layer: depth is not left out again."""


def draw_opaque(
    context: DrawContext, with_depth: bool, depth_at: Integers | None, plain_colors: bool
) -> tuple[Route, Singles | None]:
    """Draw what is nearest at every pixel.

    Parameters
    ----------
    with_depth, depth_at, plain_colors
        As `draw_picture`.

    Returns
    -------
    route : Route
    depth : (H, W) or (N,) array, or None where none is asked for
    """
    allowed = _choose_colors(context)
    colors = None if plain_colors and not isinstance(allowed, PaletteColors) else allowed
    keeps_depth = with_depth or depth_at is not None
    depth, route = None, None if keeps_depth else _draw_layer(context, colors)
    if route is None:
        nearest, route = _draw_visible(context, colors)
        if depth_at is not None:
            depth = read_only(nearest.depth_at(depth_at))
        elif with_depth:
            depth = read_only(nearest.depth().reshape(context.raster.shape))
    # A part without triangles forbids nothing, as one colour a triangle does not.
    name = allowed.name if allowed else "deferred"
    return replace(route, allowed=name if len(context.geometry.primitives) else PaletteColors.name), depth


def _choose_colors(context: DrawContext) -> "PaletteColors | SmoothColors | None":
    """Return the cheapest colours that give the right bytes; ``None``: only attributes and light per pixel do."""
    with context.timed("shade"):
        of_triangles = palette(context)
        if of_triangles is not None:
            return PaletteColors(context.encode(of_triangles))
    from core.fast_path.corner_colors import smooth_colors

    with context.timed("interpolate"):
        return smooth_colors(context)


def _draw_layer(context: DrawContext, colors: "PaletteColors | SmoothColors | None") -> Route | None:
    """Draw without depth, if that can be right; ``None``: it is not."""
    of_layer = None if colors is None else colors.for_layer
    if of_layer is None or not _may_be_one_layer(context):
        return None

    split = draw_layer(context, of_layer)
    if split is None:
        _overlaps[_key(context.scene)] = True
        return None
    return Route("layer", of_layer.name, split, split.fragments)


def _may_be_one_layer(context: DrawContext) -> bool:
    """Return whether it is worth trying without depth: one triangle, or a mesh of which only one side is drawn."""
    geometry, scene = context.geometry, context.scene
    if not (geometry.is_projected.all() and geometry.is_in_range.all()):
        return False
    count = len(geometry.primitives)
    is_likely = count <= FEW or (context.settings.cull != "none" and not isinstance(scene, ClipScene))
    if count > 1 and (not is_likely or _key(scene) in _overlaps):
        return False
    from core.fast_path.depth_free import all_pass_depth_test

    with context.timed("depth"):
        return all_pass_depth_test(geometry, context.depth_format)


def _key(scene: AnyScene) -> Mesh | ClipScene:
    return scene if isinstance(scene, ClipScene) else scene.meshes[0]


def _draw_visible(
    context: DrawContext, colors: "PaletteColors | SmoothColors | None"
) -> tuple[NearestFragments, Route]:
    """Find what is seen, then colour it."""
    nearest, split = find_visible(context)
    if not isinstance(colors, PaletteColors):  # which writes the background as one of its colours
        with context.timed("resolve"):
            context.pixels.fill(context.background)
    if colors is None:
        from core.fast_path.fragment_colors import shade_visible

        return nearest, Route("packed-depth", "deferred", split, shade_visible(context, nearest))
    with context.timed(colors.stage):
        return nearest, Route("packed-depth", colors.name, split, colors.look_up(context, nearest))
