"""One sample a pixel, its centre: coverage, depth, attributes, colour and blending of a whole picture.

Pictures with several samples a pixel are made from the same steps.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.framebuffer.blending import blend_stacks
from core.framebuffer.depth import DepthFormat, Stored
from core.framebuffer.nearest import NearestFragments
from core.methods import method, table
from core.pipeline import covered, fragments_of, interpolate_fragments, outlined, owner_of, shade_values
from core.raster.coverage import Fragments, join_fragments
from core.raster.lines.intensities import weigh_alpha, writes_depth
from core.raster.pixel_runs import Raster
from core.records.arrays import Integers, Singles, read_only
from core.records.frame import STAGES, Frame, StageCount
from core.scene import AnyScene
from core.settings import Settings
from core.stages.blend_choice import blend_choice, is_mixed
from core.stages.fragment_depth import fragment_depth
from core.stages.hidden_surfaces import DecidedFragments, decide_fragments
from core.stages.vertices import Geometry, process_geometry, timed


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
    pixel, owner, depth = found.seen
    counts["depth"].outgoing = len(pixel)
    seen = fragments_of(geometry, owner, *raster.position(pixel))
    values = interpolate_fragments(geometry, settings, raster, seen, counts["interpolate"])
    color = np.empty((len(depth), 4), np.float32)
    color[:] = scene.background
    if found.decided is None or not is_mixed(settings):
        color[pixel] = shade_values(scene, geometry, settings, raster, seen, values, counts["shade"])
        counts["blend"].incoming = counts["blend"].outgoing = len(pixel)
    else:
        _blend(color, scene, geometry, settings, raster, found.decided, counts)

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

    seen: tuple[Integers, Integers, Stored]
    """The pixels that something is seen at (V,), the owner of the fragment there (V,), and the depth buffer (H*W,)."""
    cover_count: NDArray[np.int32]
    """(H*W,) int32."""
    decided: DecidedFragments | None
    """All fragments in depth range, where they are blended or rays are cast."""


def find_fragments(
    geometry: Geometry, settings: Settings, raster: Raster, counts: dict[str, StageCount]
) -> FoundFragments:
    """Find coverage and depth of every fragment, in batches, and which of them are seen."""
    depth_format: DepthFormat = table.get("depth", settings.depth).function()
    pixel_count = raster.shape[0] * raster.shape[1]
    cover_count = np.zeros(pixel_count, np.int32)
    owner_count = len(geometry.primitives if geometry.outlines is None else geometry.outlines)
    nearest = NearestFragments(pixel_count, owner_count, depth_format, geometry.uses_depth_test)
    _, counts["blend"].note = blend_choice(settings)
    keeps_all = geometry.casts_rays or is_mixed(settings)
    kept: list[tuple[Fragments, Stored]] = []
    cover_primitives = covered if geometry.outlines is None else outlined
    for fragments in cover_primitives(geometry, settings, raster, counts):
        with timed(counts["depth"]):
            _, keeps, stored = fragment_depth(geometry, fragments, raster, depth_format)
            if not keeps.all():
                fragments, stored = fragments.select(keeps), stored[keeps]
            pixel = raster.index(fragments.column, fragments.row)
            np.add.at(cover_count, pixel, np.int32(1))
            counts["depth"].incoming += len(pixel)
            if keeps_all:
                kept.append((fragments, stored))
            if not geometry.casts_rays:
                writes = writes_depth(fragments)
                if writes is not None:
                    pixel, fragments, stored = pixel[writes], fragments.select(writes), stored[writes]
                nearest.add(pixel, owner_of(fragments), stored)
    with timed(counts["depth"]):
        decided = _decide(kept, geometry, raster, depth_format) if keeps_all else None
        pixel, owner, depth = nearest.resolve()
        if geometry.casts_rays and decided is not None:
            pixel, last = decided.last_passing(raster)
            owner, depth[pixel] = owner_of(decided.fragments)[last], decided.stored[last]
    return FoundFragments((pixel, owner, depth), cover_count, decided)


def _decide(
    kept: list[tuple[Fragments, Stored]], geometry: Geometry, raster: Raster, depth_format: DepthFormat
) -> DecidedFragments:
    """Put the fragments of all batches in drawing order, and find out which of them pass."""
    if not kept:
        none = np.empty(0, np.int64)
        kept = [(fragments_of(geometry, none, none, none), np.empty(0, depth_format.stored_type))]
    fragments = join_fragments([f for f, _ in kept])
    stored = np.concatenate([s for _, s in kept])
    owner = owner_of(fragments)
    if (owner[1:] < owner[:-1]).any():
        order = np.argsort(owner, kind="stable")
        fragments, stored = fragments.take(order), stored[order]
    return decide_fragments(geometry, fragments, stored, raster, depth_format)


def _blend(
    color: Singles,
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    decided: DecidedFragments,
    counts: dict[str, StageCount],
) -> None:
    """Blend all fragments that pass the depth test into ``color`` (H*W, 4), in drawing order."""
    passes = decided.passes
    fragments = decided.fragments.select(passes)
    values = interpolate_fragments(geometry, settings, raster, fragments, counts["interpolate"])
    source = shade_values(scene, geometry, settings, raster, fragments, values, counts["shade"])
    with timed(counts["blend"]):
        source = weigh_alpha(source, fragments)
        rule = table.get("blend", blend_choice(settings)[0]).function
        blend_stacks(color, source, np.cumsum(passes) - 1, decided.stacks, passes, rule)
        counts["depth"].outgoing = counts["blend"].incoming = counts["blend"].outgoing = len(fragments)
