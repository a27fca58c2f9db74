"""What is seen at every pixel: depth and triangle number, for all triangles at once.

Triangles go to the drawing that suits them: those whose depth is linear in packed words, or float32 on a plane, walk
along spans, the large ones in bands; the others (corners that cannot be projected, triangles that the near or the far
plane cuts, 1/w, no depth test) are looked at fragment by fragment, as every other fill does. All of them keep the
least word, so the order does not matter and every fill sees the same triangle at the same pixel.
"""

from collections.abc import Iterator

import numpy as np

from core.arrays import Flags, Integers
from core.frame import StageCount
from core.framebuffer.depth import DepthFormat
from core.framebuffer.fixed_depth import SLACK
from core.framebuffer.nearest import NearestFragments
from core.geometry_stages import Geometry, timed
from core.methods import table
from core.picture.record import Split
from core.pipeline import covered, fragment_depth
from core.raster.schedule import Raster
from core.raster.spans.arena import Arena
from core.raster.spans.bands import BIG_AREA, bands, draw_band_words
from core.raster.spans.lanes import Lanes, TieOwners, set_up_lanes, tie_owners
from core.raster.spans.packed import PackedPlanes, draw_words, word_spans
from core.raster.spans.plane_words import DepthPlanes, draw_plane_words, plane_spans
from core.settings import Settings

CHUNK = 1 << 14
"""Triangles that walk together: their rows stay in the processor's cache."""


Planes = PackedPlanes | DepthPlanes


def find_visible(
    geometry: Geometry, settings: Settings, raster: Raster, counts: dict[str, StageCount], arena: Arena
) -> tuple[NearestFragments, Split]:
    """Return the nearest fragment of every pixel of the raster."""
    depth_format: DepthFormat = table.get("depth", settings.depth).function()
    pixel_count = raster.shape[0] * raster.shape[1]
    with timed(counts["depth"]):
        nearest = NearestFragments(
            pixel_count,
            len(geometry.primitives),
            depth_format,
            geometry.uses_depth_test,
            arena("words", pixel_count, dtype=np.int64),
        )
    with timed(counts["edges"]):
        planes, is_walked = _word_planes(geometry, depth_format, raster, nearest)
    is_big = is_walked & (np.abs(geometry.doubled_area) > 2 * BIG_AREA)
    fragments = 0
    if planes is not None:
        in_lanes = is_walked & ~is_big
        fragments += _walk(nearest.keys, planes, geometry, in_lanes, raster, settings, counts, arena)
        for triangle in np.flatnonzero(is_big).tolist():
            fragments += _draw_big(nearest.keys, planes, geometry, triangle, raster, settings, counts, arena)
    rest = np.flatnonzero(~is_walked)
    if len(rest):
        fragments += _one_by_one(geometry, rest, settings, raster, depth_format, nearest, counts)
    big = int(is_big.sum())
    return nearest, Split(int(is_walked.sum()) - big, big, len(rest), fragments)


def _word_planes(
    geometry: Geometry, depth_format: DepthFormat, raster: Raster, nearest: NearestFragments
) -> tuple[Planes | None, Flags]:
    """Return the words of all primitives as planes, and for which (P,) they hold: these walk along spans."""
    count = len(geometry.primitives)
    if not geometry.uses_depth_test or depth_format.quantity != "z":
        return None, np.zeros(count, bool)
    payload = np.arange(1, count + 1)
    if depth_format.is_planar:
        fixed = geometry.fixed_planes
        bits = nearest.primitive_bits
        origin = ((fixed.origin + SLACK) << bits) + payload
        return PackedPlanes(origin, fixed.across << bits, fixed.up << bits), fixed.is_linear
    planes = DepthPlanes(*geometry.depth_plane, payload)
    return planes, geometry.is_projected & geometry.is_in_range & planes.is_finite


def chunks(count: int) -> Iterator[tuple[int, int]]:
    """Yield first and end of parts of ``count`` triangles that walk together."""
    for first in range(0, count, CHUNK):
        yield first, min(first + CHUNK, count)


def lanes_of(
    geometry: Geometry,
    first: int,
    end: int,
    chosen: Flags | None,
    raster: Raster,
    owners: TieOwners,
    arena: Arena,
) -> Lanes:
    """Put the ``chosen`` (P,) ones, or all, of primitives ``first`` to ``end`` side by side."""
    at = slice(first, end)
    area = geometry.doubled_area[at]
    if chosen is not None:
        area = np.multiply(area, chosen[at], out=arena("chosen_area", end - first))
    return set_up_lanes(geometry.window_x[:, at], geometry.window_y[:, at], area, raster, owners, arena)


def _walk(
    words: Integers,
    planes: Planes,
    geometry: Geometry,
    chosen: Flags,
    raster: Raster,
    settings: Settings,
    counts: dict[str, StageCount],
    arena: Arena,
) -> int:
    """Draw the ``chosen`` (P,) triangles along their spans; return how many fragments there were."""
    owners = tie_owners(settings.fill_rule)
    fragments = 0
    for first, end in chunks(len(geometry.primitives)):
        with timed(counts["bin"]):
            lanes = lanes_of(geometry, first, end, chosen, raster, owners, arena)
        part = planes.part(first, end)
        if isinstance(part, PackedPlanes):
            with timed(counts["raster"]):
                word_rows = word_spans(part, lanes, raster, owners, arena)
            with timed(counts["depth"]):
                fragments += word_rows.pixel_count
                draw_words(words, word_rows)
        else:
            with timed(counts["raster"]):
                rows = plane_spans(lanes, raster, owners, arena)
            with timed(counts["depth"]):
                fragments += rows.pixel_count
                draw_plane_words(words, part, rows, lanes.triangle, raster, arena)
    return fragments


def _draw_big(
    words: Integers,
    planes: Planes,
    geometry: Geometry,
    triangle: int,
    raster: Raster,
    settings: Settings,
    counts: dict[str, StageCount],
    arena: Arena,
) -> int:
    """Draw one triangle in bands; return how many fragments it had."""
    owners = tie_owners(settings.fill_rule)
    lanes = lanes_of(geometry, triangle, triangle + 1, None, raster, owners, arena)
    image = words.reshape(raster.shape)
    fragments = 0
    with timed(counts["raster"]):
        for band in bands(lanes, raster, owners, arena):
            if isinstance(planes, PackedPlanes):
                block = planes.block(triangle, band, arena)
            else:
                block = planes.block(triangle, band, raster, arena)
            fragments += draw_band_words(image, band, block)
    return fragments


def _one_by_one(
    geometry: Geometry,
    chosen: Integers,
    settings: Settings,
    raster: Raster,
    depth_format: DepthFormat,
    nearest: NearestFragments,
    counts: dict[str, StageCount],
) -> int:
    """Look at the fragments of the ``chosen`` (C,) triangles; return how many there were."""
    total = 0
    for fragments in covered(geometry, settings, raster, counts, chosen):
        with timed(counts["depth"]):
            _, keeps, stored = fragment_depth(geometry, fragments, raster, depth_format)
            total += len(fragments)
            if not keeps.all():
                fragments, stored = fragments.select(keeps), stored[keeps]
            nearest.add(raster.index(fragments.column, fragments.row), fragments.primitive, stored)
    return total
