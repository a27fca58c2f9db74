"""What is seen at every pixel: depth and triangle number, for all triangles at once.

Triangles go to the drawing that suits them: those whose depth is linear in packed words, or rounded on a plane, walk
along spans, the large ones in bands; the others (corners that cannot be projected, triangles that the near or the far
plane cuts, 1/w and its logarithm, no depth test) are looked at fragment by fragment, as every other fill does. All of
them keep the least word, so the order does not matter and every fill sees the same triangle at the same pixel.
"""

import numpy as np

from core.fast_path.draw_context import DrawContext
from core.fast_path.record import Split
from core.framebuffer.fixed_depth import SLACK
from core.framebuffer.nearest import NearestFragments
from core.numeric.integer_planes import IntegerPlanes
from core.raster.spans.bands import BIG_AREA, bands, draw_band_words
from core.raster.spans.packed import draw_words, word_block, word_spans
from core.raster.spans.plane_words import DepthPlanes, draw_plane_words, plane_spans
from core.records.arrays import Flags, Integers

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
            geometry.uses_depth_test,
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
    if not geometry.uses_depth_test or quantity.plane == "inverse-w" or quantity.convert is not None:
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
    from core.stages.fragment_depth import fragment_depth

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
