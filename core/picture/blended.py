"""Transparent triangles: every fragment in its turn, pixel by pixel.

The spans give the fragments in any order; sorted by pixel and number of the triangle they stand in drawing order.
Depth test and blending then go layer by layer (``stacks``), by the rules of every other picture.
"""

from dataclasses import replace

import numpy as np

from core.arrays import Flags, Floats, Integers, Singles
from core.fragments.interpolation import Interpolator
from core.frame import StageCount
from core.framebuffer.blending import blend_stacks
from core.framebuffer.depth import DepthFormat, run_depth_tests
from core.framebuffer.stacks import radix_order, stacks_of
from core.geometry_stages import Geometry, timed
from core.methods import table
from core.picture.deferred import BLOCK
from core.picture.record import Split
from core.picture.visible import chunks, lanes_of
from core.pipeline import covered, fragment_depth
from core.raster.coverage import Fragments
from core.raster.schedule import Raster
from core.raster.spans.arena import Arena
from core.raster.spans.lanes import tie_owners
from core.raster.spans.packed import PackedPlanes, list_words, word_spans
from core.scene import AnyScene
from core.settings import Settings
from core.surface import shade_fragments

STRIP_FRAGMENTS = 1 << 17
"""Fragments of a strip of rows, about: sorting them stays in the processor's cache."""


def draw_blended(
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    palette: Floats | None,
    counts: dict[str, StageCount],
    arena: Arena,
) -> tuple[Singles, Split]:
    """Return the blended colours (H*W, 4) float32; ``palette`` (P, 4) has those of triangles of one colour each.

    The picture is drawn in strips of rows, one after another.
    """
    first_column, first_row, end_column, end_row = raster.bounds
    expected = float(np.abs(geometry.doubled_area[geometry.is_projected]).sum()) / 2
    rows = max(int((end_row - first_row) * STRIP_FRAGMENTS / max(expected, 1)), 1)
    colors, fragments = [np.empty((0, 4), np.float32)], 0
    for row in range(first_row, end_row, rows):
        region = (first_column, row, end_column - first_column, min(rows, end_row - row))
        color, count = _draw_strip(
            scene, geometry, settings, replace(raster, region=region), palette, counts, arena
        )
        colors.append(color)
        fragments += count
    walked = int(np.count_nonzero(geometry.is_projected))
    return np.concatenate(colors), Split(walked, 0, len(geometry.primitives) - walked, fragments)


def _draw_strip(
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    palette: Floats | None,
    counts: dict[str, StageCount],
    arena: Arena,
) -> tuple[Singles, int]:
    """Return the blended colours of a strip, (h*W, 4) float32, and how many fragments it had."""
    pixel, primitive = _fragments(geometry, settings, raster, counts, arena)
    with timed(counts["depth"]):
        # Both in one number, as short as can be: pixel first, then drawing order.
        bits = max(len(geometry.primitives) - 1, 0).bit_length()
        order = radix_order((pixel << bits) | primitive)
        pixel, primitive = pixel.take(order), primitive.take(order)
        fragments = Fragments(primitive, *raster.position(pixel))
        passes = None
        depth_format: DepthFormat = table.get("depth", settings.depth).function()
        is_tested = geometry.uses_depth_test or depth_format.quantity != "z" or not geometry.is_in_range.all()
        if is_tested:
            fragments, pixel, passes = _test_depth(geometry, raster, depth_format, fragments, pixel)
        stacks = stacks_of(pixel, np.arange(len(pixel)))
    if palette is not None:
        source, number = np.ascontiguousarray(palette.T).T, fragments.primitive
    elif passes is None:
        source, number = _colors(scene, geometry, settings, raster, fragments, counts), np.arange(len(pixel))
    else:
        source = _colors(scene, geometry, settings, raster, fragments.select(passes), counts)
        number = np.cumsum(passes) - 1
    with timed(counts["blend"]):
        color = np.empty((raster.shape[0] * raster.shape[1], 4), np.float32)
        color[:] = scene.background
        rule = table.get("blend", settings.blend).function
        blend_stacks(color, source, number, stacks, passes, rule)
    return color, len(order)


def _test_depth(
    geometry: Geometry, raster: Raster, depth_format: DepthFormat, fragments: Fragments, pixel: Integers
) -> tuple[Fragments, Integers, Flags]:
    """Return the fragments in depth range, their pixels, and which of them pass the depth test."""
    _, keeps, stored = fragment_depth(geometry, fragments, raster, depth_format)
    if not keeps.all():
        fragments, stored, pixel = fragments.select(keeps), stored[keeps], pixel[keeps]
    stacks = stacks_of(pixel, np.arange(len(pixel)))
    cleared = np.full(raster.shape[0] * raster.shape[1], depth_format.cleared, depth_format.stored_type)
    tests = run_depth_tests(stored, stacks, cleared, depth_format, geometry.uses_depth_test)
    return fragments, pixel, tests.passes


def _fragments(
    geometry: Geometry, settings: Settings, raster: Raster, counts: dict[str, StageCount], arena: Arena
) -> tuple[Integers, Integers]:
    """Return pixel and primitive (F,) int64 of all fragments, in any order."""
    owners = tie_owners(settings.fill_rule)
    count = len(geometry.primitives)
    # A word that is the number of the triangle at every pixel.
    number, level = np.arange(count), np.zeros(count, np.int64)
    numbers = PackedPlanes(number, level, level)
    none = np.empty(0, np.int64)
    pixels, primitives = [none], [none]
    for first, end in chunks(count):
        with timed(counts["bin"]):
            lanes = lanes_of(geometry, first, end, geometry.is_projected, raster, owners, arena)
        with timed(counts["raster"]):
            pixel, primitive = list_words(word_spans(numbers.part(first, end), lanes, raster, owners, arena))
            pixels.append(pixel)
            primitives.append(primitive)
    rest = np.flatnonzero(~geometry.is_projected)
    if len(rest):
        for fragments in covered(geometry, settings, raster, counts, rest):
            pixels.append(raster.index(fragments.column, fragments.row))
            primitives.append(fragments.primitive)
    return np.concatenate(pixels), np.concatenate(primitives)


def _colors(
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    fragments: Fragments,
    counts: dict[str, StageCount],
) -> Floats:
    """Return the colours (F, 4) float64 of fragments."""
    layout = geometry.primitives.layout
    source = np.empty((4, len(fragments))).T
    interpolator = Interpolator(
        geometry.planes, geometry.primitives.values, settings.interpolation, settings.provoking
    )
    for first in range(0, len(fragments), BLOCK):
        part = slice(first, first + BLOCK)
        primitive = fragments.primitive[part]
        with timed(counts["interpolate"]):
            x, y = raster.centers(fragments.column[part], fragments.row[part])
            values = interpolator.values(primitive, x, y)
        with timed(counts["shade"]):
            mesh = geometry.primitives.mesh.take(primitive)
            source[part] = shade_fragments(scene, settings, layout, mesh, values).color
    return source
