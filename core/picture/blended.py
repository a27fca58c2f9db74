"""Transparent triangles: every fragment in its turn, pixel by pixel.

The spans give the fragments in any order; sorted by pixel and number of the triangle they stand in drawing order.
Depth test and blending then go layer by layer (``stacks``), by the rules of every other picture.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from core.arrays import Flags, Floats, Integers, Singles
from core.framebuffer.blending import blend_stacks
from core.framebuffer.depth import run_depth_tests
from core.framebuffer.stacks import stacks_of
from core.integer_planes import IntegerPlanes
from core.methods import table
from core.picture.fragment_colors import FragmentColors
from core.picture.job import Job, blocks
from core.picture.record import Split
from core.picture.visible import chunks
from core.pipeline import covered, fragment_depth
from core.raster.coverage import Fragments
from core.raster.spans.packed import list_words, word_spans
from core.sorting import radix_order

STRIP_FRAGMENTS = 1 << 17
"""Fragments of a strip of rows, about: sorting them stays in the processor's cache."""


class Blended(NamedTuple):
    """What was drawn."""

    split: Split
    passed: int
    """Fragments that passed the depth test and were blended."""
    visible: int
    """Pixels that have any of them."""


def draw_blended(job: Job, palette: Floats | None) -> Blended:
    """Draw every fragment in its turn, one strip of rows after another.

    ``palette`` (P, 4) has the colours of triangles of one colour each.
    """
    geometry, raster = job.geometry, job.raster
    first_column, first_row, end_column, end_row = raster.bounds
    columns = end_column - first_column
    expected = float(np.abs(geometry.doubled_area[geometry.is_projected]).sum()) / 2
    rows = max(int((end_row - first_row) * STRIP_FRAGMENTS / max(expected, 1)), 1)
    fragments = passed = visible = 0
    for row in range(first_row, end_row, rows):
        region = (first_column, row, columns, min(rows, end_row - row))
        at = slice((row - first_row) * columns, (row - first_row + region[3]) * columns)
        strip = replace(job, raster=replace(raster, region=region), pixels=job.pixels[at])
        color, found = _draw_strip(strip, palette)
        with job.timed("resolve"):
            strip.pixels[:] = job.encode(color)
        fragments, passed, visible = fragments + found[0], passed + found[1], visible + found[2]
    walked = int(np.count_nonzero(geometry.is_projected))
    return Blended(Split(walked, 0, len(geometry.primitives) - walked, fragments), passed, visible)


def _draw_strip(job: Job, palette: Floats | None) -> tuple[Singles, tuple[int, int, int]]:
    """Return the blended colours of a strip, (h*W, 4) float32, its fragments, those blended, and their pixels."""
    geometry, raster = job.geometry, job.raster
    pixel, primitive = _fragments(job)
    with job.timed("depth"):
        # Both in one number, as short as can be: pixel first, then drawing order.
        bits = max(len(geometry.primitives) - 1, 0).bit_length()
        order = radix_order((pixel << bits) | primitive)
        pixel, primitive = pixel.take(order), primitive.take(order)
        fragments = Fragments(primitive, *raster.position(pixel))
        passes = None
        is_tested = geometry.uses_depth_test or job.depth_format.quantity != "z"
        if is_tested or not geometry.is_in_range.all():
            fragments, pixel, passes = _test_depth(job, fragments, pixel)
        stacks = stacks_of(pixel, np.arange(len(pixel)))
    if palette is not None:
        source, number = np.ascontiguousarray(palette.T).T, fragments.primitive
    elif passes is None:
        source, number = _colors(job, fragments), np.arange(len(pixel))
    else:
        source, number = _colors(job, fragments.select(passes)), np.cumsum(passes) - 1
    with job.timed("blend"):
        color = np.empty((len(job.pixels), 4), np.float32)
        color[:] = job.scene.background
        rule = table.get("blend", job.settings.blend).function
        blend_stacks(color, source, number, stacks, passes, rule)
    blended = pixel if passes is None else pixel[passes]
    visible = int(np.count_nonzero(blended[1:] != blended[:-1])) + min(len(blended), 1)
    return color, (len(order), len(blended), visible)


def _test_depth(job: Job, fragments: Fragments, pixel: Integers) -> tuple[Fragments, Integers, Flags]:
    """Return the fragments in depth range, their pixels, and which of them pass the depth test."""
    depth_format = job.depth_format
    _, keeps, stored = fragment_depth(job.geometry, fragments, job.raster, depth_format)
    if not keeps.all():
        fragments, stored, pixel = fragments.select(keeps), stored[keeps], pixel[keeps]
    stacks = stacks_of(pixel, np.arange(len(pixel)))
    cleared = np.full(len(job.pixels), depth_format.cleared, depth_format.stored_type)
    tests = run_depth_tests(stored, stacks, cleared, depth_format, job.geometry.uses_depth_test)
    return fragments, pixel, tests.passes


def _fragments(job: Job) -> tuple[Integers, Integers]:
    """Return pixel and primitive (F,) int64 of all fragments, in any order."""
    geometry, raster = job.geometry, job.raster
    count = len(geometry.primitives)
    # A word that is the number of the triangle at every pixel.
    level = np.zeros(count, np.int64)
    numbers = IntegerPlanes(np.arange(count), level, level)
    none = np.empty(0, np.int64)
    pixels, primitives = [none], [none]
    for first, end in chunks(count):
        with job.timed("bin"):
            lanes = job.lanes(first, end, geometry.is_projected)
        with job.timed("raster"):
            spans = word_spans(numbers.part(first, end), lanes, raster, job.owners, job.arena)
            pixel, primitive = list_words(spans)
            pixels.append(pixel)
            primitives.append(primitive)
    rest = np.flatnonzero(~geometry.is_projected)
    if len(rest):
        for fragments in covered(geometry, job.settings, raster, job.counts, rest):
            pixels.append(raster.index(fragments.column, fragments.row))
            primitives.append(fragments.primitive)
    return np.concatenate(pixels), np.concatenate(primitives)


def _colors(job: Job, fragments: Fragments) -> Floats:
    """Return the colours (F, 4) float64 of fragments."""
    colors, source = FragmentColors(job), np.empty((4, len(fragments))).T
    for part in blocks(len(fragments)):
        at = (fragments.primitive[part], fragments.column[part], fragments.row[part])
        source[part] = colors.at(*at)
    return source
