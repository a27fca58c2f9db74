"""Transparent triangles: every fragment in its turn, pixel by pixel.

Spans taken triangle by triangle give the fragments in drawing order; a stable sort puts those of a pixel on top of
each other.
Depth test and blending then go layer by layer (``stacks``), by the rules of every other picture.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from core.coverage.fills import Fragments
from core.depth.depth import run_depth_tests, stacks_of
from core.fast_path.draw_context import DrawContext, Split, blocks
from core.fast_path.fragment_colors import FragmentColors
from core.framebuffer.blending import blend_stacks
from core.numeric.large_arrays import radix_order
from core.records.arrays import Flags, Floats, Integers, Singles
from core.resolved import resolve
from core.spans.fill import pixels_of_rows, rows_in_order
from core.stages.bin_and_raster import covered
from core.stages.fragments import fragment_depth

STRIP_FRAGMENTS = 1 << 17
"""Fragments of a strip of rows, about: sorting them stays in the processor's cache."""


class Blended(NamedTuple):
    """What was drawn."""

    split: Split
    passed: int
    """Fragments that passed the depth test and were blended."""
    visible: int
    """Pixels that have any of them."""


def draw_blended(context: DrawContext, palette: Floats | None) -> Blended:
    """Draw every fragment in its turn, one strip of rows after another.

    ``palette`` (P, 4) has the colours of triangles of one colour each.
    """
    geometry, raster = context.geometry, context.raster
    first_column, first_row, end_column, end_row = raster.bounds
    columns = end_column - first_column
    rows = strip_height(np.abs(geometry.doubled_area[geometry.is_projected]) / 2, raster.shape)
    fragments = passed = visible = 0
    for row in range(first_row, end_row, rows):
        region = (first_column, row, columns, min(rows, end_row - row))
        at = slice((row - first_row) * columns, (row - first_row + region[3]) * columns)
        strip = replace(context, raster=replace(raster, region=region), pixels=context.pixels[at])
        color, found = _draw_strip(strip, palette)
        with context.timed("resolve"):
            strip.pixels[:] = context.encode(color)
        fragments, passed, visible = fragments + found[0], passed + found[1], visible + found[2]
    walked = int(np.count_nonzero(geometry.is_projected))
    return Blended(Split(walked, 0, len(geometry.primitives) - walked, fragments), passed, visible)


def strip_height(areas: Floats, shape: tuple[int, int]) -> int:
    """Return how many rows of a picture of ``shape`` (rows, columns) are a strip, for triangles of areas (P,) pixels.

    However far a triangle reaches beyond the picture, it has no more fragments than that has pixels.
    """
    rows, columns = shape
    expected = float(np.minimum(areas, rows * columns).sum())
    return max(int(rows * STRIP_FRAGMENTS / max(expected, 1)), 1)


def _draw_strip(context: DrawContext, palette: Floats | None) -> tuple[Singles, tuple[int, int, int]]:
    """Return the blended colours of a strip, (h*W, 4) float32, its fragments, those blended, and their pixels."""
    geometry = context.geometry
    pixel, primitive = _fragments(context)
    count, passes = len(pixel), None
    with context.timed("depth"):
        is_tested = geometry.drawing.uses_depth_test or not context.depth_format.quantity.is_window_depth
        if is_tested or not geometry.is_in_range.all():
            pixel, primitive, passes = _test_depth(context, pixel, primitive)
        stacks = stacks_of(pixel, np.arange(len(pixel)))
    if palette is not None:
        source, number = np.ascontiguousarray(palette.T).T, primitive
    elif passes is None:
        source, number = _colors(context, pixel, primitive), np.arange(len(pixel))
    else:
        source, number = _colors(context, pixel[passes], primitive[passes]), np.cumsum(passes) - 1
    with context.timed("blend"):
        color = np.empty((len(context.pixels), 4), np.float32)
        color[:] = context.scene.background
        rule = resolve(context.settings).blend_method.function
        blend_stacks(color, source, number, stacks, passes, rule)
    if passes is None:
        return color, (count, len(pixel), len(stacks.pixel))
    blended = pixel[passes]
    visible = int(np.count_nonzero(blended[1:] != blended[:-1])) + min(len(blended), 1)
    return color, (count, len(blended), visible)


def _test_depth(
    context: DrawContext, pixel: Integers, primitive: Integers
) -> tuple[Integers, Integers, Flags]:
    """Return pixel and primitive (F,) of the fragments in depth range, and which of them pass the depth test."""
    depth_format = context.depth_format
    fragments = Fragments(primitive, *context.raster.position(pixel))
    _, keeps, stored = fragment_depth(context.geometry, fragments, context.raster, depth_format)
    if not keeps.all():
        pixel, primitive, stored = pixel[keeps], primitive[keeps], stored[keeps]
    stacks = stacks_of(pixel, np.arange(len(pixel)))
    cleared = np.full(len(context.pixels), depth_format.cleared, depth_format.stored_type)
    tests = run_depth_tests(stored, stacks, cleared, depth_format, context.geometry.drawing.uses_depth_test)
    return pixel, primitive, tests.passes


def _fragments(context: DrawContext) -> tuple[Integers, Integers]:
    """Return pixel and primitive (F,) int64 of all fragments, sorted by pixel, then by drawing order."""
    geometry, raster = context.geometry, context.raster
    count = len(geometry.primitives)
    none = np.empty(0, np.int64)
    pixels, primitives = [none], [none]
    for first, end, lanes in context.walks(geometry.is_projected):
        with context.timed("raster"):
            rows = rows_in_order(lanes, end - first, raster, context.owners, context.scratch)
            pixel, primitive = pixels_of_rows(rows, raster)
            primitive += first
            pixels.append(pixel)
            primitives.append(primitive)
    rest = np.flatnonzero(~geometry.is_projected)
    if len(rest):
        for fragments in covered(geometry, raster, context.counts, rest):
            pixels.append(raster.index(fragments.column, fragments.row))
            primitives.append(fragments.primitive)
    with context.timed("depth"):
        pixel, primitive = np.concatenate(pixels), np.concatenate(primitives)
        # Spans come in drawing order; what does not is sorted by both, in one number as short as can be.
        bits = max(count - 1, 0).bit_length()
        order = radix_order((pixel << bits) | primitive if len(rest) else pixel)
        return pixel.take(order), primitive.take(order)


def _colors(context: DrawContext, pixel: Integers, primitive: Integers) -> Floats:
    """Return the colours (F, 4) float64 of fragments of primitives (F,) at pixels (F,)."""
    colors, source = FragmentColors(context), np.empty((4, len(pixel))).T
    for part in blocks(len(pixel)):
        source[part] = colors.at(primitive[part], *context.raster.position(pixel[part]))
    return source
