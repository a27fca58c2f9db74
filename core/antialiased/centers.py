"""One sample a pixel, its centre: coverage, depth, attributes, colour and blending of a whole picture.

Pictures with several samples a pixel are made from the same steps.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.arrays import Flags, Integers, Singles, read_only
from core.frame import STAGES, Frame, StageCount
from core.framebuffer.blending import blend_stacks
from core.framebuffer.depth import DepthFormat, Stored, run_depth_tests
from core.framebuffer.nearest import NearestFragments
from core.framebuffer.stacks import PixelStacks, stack_fragments
from core.geometry_stages import Geometry, process_geometry, timed
from core.methods import method, table
from core.pipeline import (
    covered,
    fragment_depth,
    fragments_of,
    interpolate_fragments,
    outlined,
    owner_of,
    shade_values,
)
from core.raster.coverage import Fragments
from core.raster.schedule import Raster
from core.scene import AnyScene
from core.settings import Settings


@method(
    "antialiasing",
    "none",
    "None (one sample a pixel)",
    source="Zwicker 2016, Pixel inside/outside test; LMU 2020, Aliasing",
    exact_for="edges along pixel borders",
    breaks_where="every other edge: stairs, and details between the pixel centres are lost",
)
def draw_at_centers(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | None = None
) -> Frame:
    """Draw with one sample, the pixel's centre; arguments (T,) and result as of `draw`."""
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(scene, settings, counts, chosen)
    return draw_geometry(scene, geometry, settings, raster, counts)


def draw_geometry(
    scene: AnyScene, geometry: Geometry, settings: Settings, raster: Raster, counts: dict[str, StageCount]
) -> Frame:
    """Draw what is known of the triangles already; the work is added to ``counts``."""
    found = find_fragments(geometry, settings, raster, counts)

    # What is seen; attributes and colour once per visible pixel.
    with timed(counts["depth"]):
        pixel, owner, depth = found.nearest.resolve()
        counts["depth"].outgoing = len(pixel)
    seen = fragments_of(geometry, owner, *raster.position(pixel))
    values = interpolate_fragments(geometry, settings, raster, seen, counts["interpolate"])
    color = np.empty((len(depth), 4), np.float32)
    color[:] = scene.background
    if settings.blend == "opaque":
        color[pixel] = shade_values(scene, geometry, settings, seen, values, counts["shade"])
        counts["blend"].incoming = counts["blend"].outgoing = len(pixel)
    else:
        _blend(color, scene, geometry, settings, raster, found.kept, counts)

    # Buffers of the frame.
    with timed(counts["resolve"]):
        identity = np.full(len(depth), -1, np.int32)
        identity[pixel] = geometry.primitives.triangle[seen.primitive]
        attributes = np.zeros((len(depth), values.shape[1]), np.float32)
        attributes[pixel] = values
        counts["resolve"].incoming = counts["resolve"].outgoing = len(depth)
    return Frame(
        color=read_only(color.reshape(*raster.shape, 4)),
        depth=read_only(depth.reshape(raster.shape)),
        primitive=read_only(identity.reshape(raster.shape)),
        attributes=read_only(attributes.reshape(*raster.shape, values.shape[1])),
        cover_count=read_only(found.cover_count.reshape(raster.shape)),
        statistics=counts,
    )


class FoundFragments(NamedTuple):
    """Coverage and depth of all fragments of a picture."""

    nearest: NearestFragments
    cover_count: NDArray[np.int32]
    """(H*W,) int32."""
    kept: list[tuple[Fragments, Stored]]
    """Where fragments are blended: all that are in depth range, with their stored depths, in batches."""


def find_fragments(
    geometry: Geometry, settings: Settings, raster: Raster, counts: dict[str, StageCount]
) -> FoundFragments:
    """Find coverage and depth of every fragment, in batches."""
    depth_format: DepthFormat = table.get("depth", settings.depth).function()
    pixel_count = raster.shape[0] * raster.shape[1]
    cover_count = np.zeros(pixel_count, np.int32)
    owner_count = len(geometry.primitives if geometry.outlines is None else geometry.outlines)
    nearest = NearestFragments(pixel_count, owner_count, depth_format, geometry.uses_depth_test)
    kept: list[tuple[Fragments, Stored]] = []
    cover_primitives = covered if geometry.outlines is None else outlined
    for fragments in cover_primitives(geometry, settings, raster, counts):
        with timed(counts["depth"]):
            _, keeps, stored = fragment_depth(geometry, fragments, raster, depth_format)
            if not keeps.all():
                fragments, stored = fragments.select(keeps), stored[keeps]
            pixel = raster.index(fragments.column, fragments.row)
            np.add.at(cover_count, pixel, np.int32(1))
            nearest.add(pixel, owner_of(fragments), stored)
            counts["depth"].incoming += len(pixel)
            if settings.blend != "opaque":
                kept.append((fragments, stored))
    return FoundFragments(nearest, cover_count, kept)


def _blend(
    color: Singles,
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    kept: list[tuple[Fragments, Stored]],
    counts: dict[str, StageCount],
) -> None:
    """Blend all fragments that pass the depth test into ``color`` (H*W, 4), in drawing order."""
    with timed(counts["depth"]):
        fragments, stacks, passes = stack_and_compare(geometry, settings, raster, kept)
        fragments = fragments.select(passes)
    values = interpolate_fragments(geometry, settings, raster, fragments, counts["interpolate"])
    source = shade_values(scene, geometry, settings, fragments, values, counts["shade"])
    with timed(counts["blend"]):
        rule = table.get("blend", settings.blend).function
        blend_stacks(color, source, np.cumsum(passes) - 1, stacks, passes, rule)
        counts["blend"].incoming = counts["blend"].outgoing = len(fragments)


def stack_and_compare(
    geometry: Geometry, settings: Settings, raster: Raster, kept: list[tuple[Fragments, Stored]]
) -> tuple[Fragments, PixelStacks, Flags]:
    """Put fragments into drawing order, stack them on their pixels, and test their depths from a cleared buffer.

    Returns
    -------
    fragments : Fragments
        All F of them.
    stacks : PixelStacks
    passes : (F,) bool
    """
    depth_format: DepthFormat = table.get("depth", settings.depth).function()
    owner, column, row = (
        _join([owner_of(f) for f, _ in kept]),
        _join([f.column for f, _ in kept]),
        _join([f.row for f, _ in kept]),
    )
    stored = np.concatenate([s for _, s in kept]) if kept else np.empty(0, depth_format.stored_type)
    if (owner[1:] < owner[:-1]).any():
        order = np.argsort(owner, kind="stable")
        owner, column, row, stored = owner[order], column[order], row[order], stored[order]
    fragments = fragments_of(geometry, owner, column, row)
    stacks = stack_fragments(raster.index(column, row))
    cleared = np.full(raster.shape[0] * raster.shape[1], depth_format.cleared, depth_format.stored_type)
    passes = run_depth_tests(stored, stacks, cleared, depth_format, geometry.uses_depth_test).passes
    return fragments, stacks, passes


def _join(parts: list[Integers]) -> Integers:
    return np.concatenate(parts) if parts else np.empty(0, np.int64)
