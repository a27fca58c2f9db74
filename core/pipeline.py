"""The pipeline: a scene becomes a picture, stage by stage.

The same functions serve the picture (in batches, nothing kept) and the trace (a few triangles, everything kept).
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from core.arrays import Floats, Integers, Singles, read_only
from core.blend_choice import blend_choice
from core.fragment_depth import fragment_depth, fragment_inverse_w, outlines_of
from core.fragments.interpolation import Interpolator, interpolate
from core.frame import STAGES, Frame, StageCount
from core.framebuffer.blending import blend_stacks
from core.framebuffer.depth import DepthFormat, Stored
from core.framebuffer.nearest import NearestFragments
from core.geometry_stages import Geometry, process_geometry, timed
from core.hidden_surfaces import DecidedFragments, decide_fragments
from core.methods import table
from core.raster.binning import bound
from core.raster.coverage import Fragments, cover, join_fragments
from core.raster.edge_functions import EdgeFunctions
from core.raster.fills import suited_fill
from core.raster.line_intensities import weigh_alpha, writes_depth
from core.raster.schedule import Boxes, Raster, Runs, make_raster, rows_of
from core.raster.wireframe import (
    LineFragments,
    draw_outlines,
    interpolate_outlines,
)
from core.scene import AnyScene, ClipScene, Texture
from core.settings import Settings
from core.surface import shade_fragments
from core.texture_slopes import texture_slopes

Batch = TypeVar("Batch")

__all__ = [
    "Geometry",
    "draw",
    "draw_triangles",
    "fragment_depth",
    "fragment_inverse_w",
    "fragment_values",
    "process_geometry",
    "render",
    "schedule",
]


def render(scene: AnyScene, settings: Settings | None = None) -> Frame:
    """Draw a scene.

    Parameters
    ----------
    scene : Scene or ClipScene
    settings : Settings, optional

    Returns
    -------
    Frame

    Raises
    ------
    ValueError
        If a method needs what the scene does not have (``inverse-w`` with an orthographic camera).

    Examples
    --------
    >>> clip = [[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]]]
    >>> print(render(ClipScene(clip, size=(4, 3))).primitive[::-1])
    [[-1 -1 -1 -1]
     [ 0  0 -1 -1]
     [ 0  0  0 -1]]
    """
    settings = settings or Settings()
    return draw(scene, settings, make_raster(scene.size, settings.pixel_center))


def draw_triangles(
    clip: ArrayLike,
    width: int,
    height: int,
    attributes: ArrayLike | None = None,
    texture: Texture | ArrayLike | None = None,
    settings: Settings | None = None,
) -> Frame:
    """Draw triangles given in clip space.

    Parameters
    ----------
    clip : (T, 3, 4) array_like
        x, y, z, w of every corner, any signs of w.
    width, height : int
        Size of the raster in pixels.
    attributes : (T, 3, K) array_like, optional
        Values to interpolate; the first four are the colour (missing ones are 0, 0, 0, 1), or the first two the
        texture coordinates where a texture is given.
    texture : Texture or (h, w, C) array_like, optional
        Linear texels, row 0 at v = 0; see `core.scene.Texture`.
    settings : Settings, optional
    """
    if texture is not None and not isinstance(texture, Texture):
        texture = Texture(np.asarray(texture))
    values = None if attributes is None else np.asarray(attributes)
    return render(ClipScene(np.asarray(clip), values, (width, height), texture), settings)


def schedule(edges: EdgeFunctions, settings: Settings, raster: Raster) -> tuple[Boxes, Runs]:
    """Bin triangles and list the runs of pixels that the fill looks at: none where only outlines are drawn."""
    boxes = bound(edges, raster)
    if table.get("polygon_mode", settings.polygon_mode).function():
        return boxes, rows_of(boxes, np.empty(0, np.int64))
    fill = table.get("fill", suited_fill(settings.fill, settings.coverage)).function
    return boxes, fill(edges, boxes, raster, settings.block_size)


def fragment_values(
    geometry: Geometry, settings: Settings, fragments: Fragments, raster: Raster
) -> tuple[Floats, Floats]:
    """Return weights of the corners (F, 3) and interpolated values (F, K) of fragments."""
    mode, varyings = settings.interpolation, geometry.primitives.varyings
    if isinstance(fragments, LineFragments) and mode != "flat":
        return interpolate_outlines(outlines_of(geometry), varyings, fragments, raster.center, mode)
    x, y = raster.centers(fragments.column, fragments.row)
    how = mode, settings.provoking, settings.correction_interval
    return interpolate(geometry.planes, varyings, fragments.primitive, x, y, *how)


def owner_of(fragments: Fragments) -> Integers:
    """Return what each fragment belongs to, (F,) int64: its segment or its primitive."""
    return fragments.segment if isinstance(fragments, LineFragments) else fragments.primitive


def fragments_of(geometry: Geometry, owner: Integers, column: Integers, row: Integers) -> Fragments:
    """Return the fragments of owners (F,), see ``owner_of``, at pixels."""
    if geometry.outlines is None:
        return Fragments(owner, column, row)
    return LineFragments(geometry.outlines.primitive.take(owner), column, row, owner)


def draw(scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | None = None) -> Frame:
    """Draw the ``chosen`` (T,) triangles, or all; the buffers are those of the raster's region."""
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(scene, settings, counts, chosen)
    depth_format: DepthFormat = table.get("depth", settings.depth).function()
    pixel_count = raster.shape[0] * raster.shape[1]
    cover_count = np.zeros(pixel_count, np.int32)
    owner_count = len(geometry.primitives if geometry.outlines is None else geometry.outlines)
    nearest = NearestFragments(pixel_count, owner_count, depth_format, geometry.uses_depth_test)
    kept: list[tuple[Fragments, Stored]] = []
    blend, counts["blend"].note = blend_choice(settings)
    keeps_all = geometry.casts_rays or blend != "opaque"

    # Coverage and depth of every fragment, in batches.
    cover_primitives = covered if geometry.outlines is None else _outlined
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

    # What is seen; attributes and colour once per visible pixel.
    with timed(counts["depth"]):
        decided = _decide(kept, geometry, raster, depth_format) if keeps_all else None
        pixel, owner, depth = nearest.resolve()
        if geometry.casts_rays and decided is not None:
            pixel, last = decided.last_passing(raster)
            owner, depth[pixel] = owner_of(decided.fragments)[last], decided.stored[last]
        counts["depth"].outgoing = len(pixel)
    seen = fragments_of(geometry, owner, *raster.position(pixel))
    values = _interpolate(geometry, settings, raster, seen, counts["interpolate"])
    color = np.empty((len(depth), 4), np.float32)
    color[:] = scene.background
    if decided is None or blend == "opaque":
        color[pixel] = _shade(scene, geometry, settings, raster, seen, values, counts["shade"])
        counts["blend"].incoming = counts["blend"].outgoing = len(pixel)
    else:
        _blend(color, scene, geometry, settings, raster, decided, counts)

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
        cover_count=read_only(cover_count.reshape(raster.shape)),
        statistics=counts,
    )


def covered(
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    counts: dict[str, StageCount],
    chosen: Integers | None = None,
) -> Iterator[Fragments]:
    """Yield the covered pixels of the ``chosen`` (C,) primitives, or all, a few million looked-at pixels at a time."""
    count = counts["bin"]
    counts["raster"].note = (
        "" if suited_fill(settings.fill, settings.coverage) == settings.fill else settings.fill
    )
    with timed(count):
        edges = geometry.edges if chosen is None else geometry.edges.take(chosen)
        number = np.arange(len(edges)) if chosen is None else chosen
        count.incoming += len(edges)
        first_column, first_row, end_column, end_row = raster.bounds
        boxes = bound(edges, raster)
        area = (boxes.row_end - boxes.row) * (boxes.column_end - boxes.column)
        if settings.fill == "brute-force":
            area[:] = (end_row - first_row) * (end_column - first_column)
        ends = np.flatnonzero(np.diff(np.cumsum(area) // CHUNK, append=-1)) + 1
    for first, end in zip([0, *ends][:-1], ends, strict=True):
        with timed(count):
            part = edges.part(int(first), int(end))
            _, runs = schedule(part, settings, raster)
            count.outgoing += int(runs.lengths.sum())
        for fragments, tested in _timed_batches(cover(part, runs, raster), counts["raster"]):
            counts["raster"].incoming += tested
            counts["raster"].outgoing += len(fragments)
            yield replace(fragments, primitive=number.take(fragments.primitive + int(first)))


def _timed_batches(batches: Iterator[Batch], count: StageCount) -> Iterator[Batch]:
    """Yield what ``batches`` yields, and add the time that it takes to make them."""
    while True:
        with timed(count):
            batch = next(batches, None)
        if batch is None:
            return
        yield batch


def _outlined(
    geometry: Geometry, settings: Settings, raster: Raster, counts: dict[str, StageCount]
) -> Iterator[Fragments]:
    """Yield the pixels of the outlines of all primitives."""
    counts["bin"].incoming = len(geometry.edges)
    batches = draw_outlines(outlines_of(geometry), raster, settings.line)
    for fragments, _ in _timed_batches(batches, counts["raster"]):
        counts["bin"].outgoing += len(fragments)
        counts["raster"].incoming += len(fragments)
        counts["raster"].outgoing += len(fragments)
        yield fragments


def _interpolate(
    geometry: Geometry, settings: Settings, raster: Raster, fragments: Fragments, count: StageCount
) -> Floats:
    """Return the interpolated values (F, K) float64 of fragments."""
    with timed(count):
        count.incoming = count.outgoing = len(fragments)
        if isinstance(fragments, LineFragments):
            return fragment_values(geometry, settings, fragments, raster)[1]
        how = settings.interpolation, settings.provoking, settings.correction_interval
        interpolator = Interpolator(geometry.planes, geometry.primitives.values, *how)
        return interpolator.values(fragments.primitive, *raster.centers(fragments.column, fragments.row))


def _shade(
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    fragments: Fragments,
    values: Floats,
    count: StageCount,
) -> Floats:
    """Return the colours (F, 4) float64 of fragments."""
    with timed(count):
        count.incoming = count.outgoing = len(fragments)
        mesh = geometry.primitives.mesh[fragments.primitive]
        slopes = texture_slopes(geometry, settings, raster, fragments, values)
        return shade_fragments(scene, settings, geometry.primitives.layout, mesh, values, slopes).color


def _decide(
    kept: list[tuple[Fragments, Stored]], geometry: Geometry, raster: Raster, depth_format: DepthFormat
) -> DecidedFragments:
    """Put the fragments of all batches in drawing order, and find out which of them pass."""
    if not kept:
        none = np.empty(0, np.int64)
        empty = np.empty(0, depth_format.stored_type)
        return decide_fragments(
            geometry, fragments_of(geometry, none, none, none), empty, raster, depth_format
        )
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
    values = _interpolate(geometry, settings, raster, fragments, counts["interpolate"])
    source = _shade(scene, geometry, settings, raster, fragments, values, counts["shade"])
    with timed(counts["blend"]):
        source = weigh_alpha(source, fragments)
        rule = table.get("blend", blend_choice(settings)[0]).function
        blend_stacks(color, source, np.cumsum(passes) - 1, decided.stacks, passes, rule)
        counts["blend"].incoming = counts["blend"].outgoing = len(fragments)


CHUNK = 1 << 22
"""Pixels of bounding boxes that are scheduled in one go."""
