"""The pipeline: a scene becomes a picture, stage by stage.

The same functions serve the picture (in batches, nothing kept) and the trace (a few triangles, everything kept).
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from core.arrays import Flags, Floats, Integers
from core.fragments.interpolation import Interpolator, interpolate, plane_value
from core.frame import Frame, StageCount
from core.framebuffer.depth import DepthFormat, Stored, clamp_depth
from core.geometry_stages import Geometry, process_geometry, timed
from core.methods import table
from core.raster.binning import bound
from core.raster.coverage import Fragments, cover
from core.raster.edge_functions import EdgeFunctions
from core.raster.schedule import Boxes, Raster, Runs, make_raster, rows_of
from core.raster.wireframe import (
    LineFragments,
    Outlines,
    draw_outlines,
    interpolate_outlines,
    inverse_w_parts,
    line_depth,
)
from core.scene import AnyScene, ClipScene, Texture
from core.settings import Settings
from core.surface import shade_fragments

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
    fill = table.get("fill", settings.fill).function
    return boxes, fill(edges, boxes, raster, settings.block_size)


def fragment_depth(
    geometry: Geometry, fragments: Fragments, raster: Raster, depth_format: DepthFormat
) -> tuple[Floats, Flags, Stored]:
    """Return the window depth of fragments, whether it is in range, and what would be stored.

    Returns
    -------
    depth : (F,) float64, clamped where the triangle is in range as a whole
    keeps : (F,) bool, False too where 1/w is stored and shows a point behind the eye
    stored : (F,) of the format's ``stored_type``
    """
    if not isinstance(fragments, LineFragments):
        x, y = raster.centers(fragments.column, fragments.row)
        depth, keeps, stored = depth_at(geometry, fragments.primitive, x, y, depth_format)
        if depth_format.quantity == "z" and depth_format.is_planar:
            fixed = geometry.fixed_planes
            on_plane = fixed.planes.at(fragments.primitive, fragments.column, fragments.row)
            stored = np.where(fixed.is_linear.take(fragments.primitive), on_plane.astype(np.float64), stored)
        return depth, keeps, stored
    outlines = outlines_of(geometry)
    depth = line_depth(outlines, fragments, raster.center)
    depth, keeps = clamp_depth(depth, outlines.is_in_range.take(fragments.segment))
    if depth_format.quantity == "z":
        return depth, keeps, depth_format.store(depth)
    inverse_w = fragment_inverse_w(geometry, fragments, raster)
    return depth, keeps & (inverse_w > 0), depth_format.store(inverse_w)


def depth_at(
    geometry: Geometry, primitive: Integers, x: Floats, y: Floats, depth_format: DepthFormat
) -> tuple[Floats, Flags, Stored]:
    """Return depth, whether it is in range, and what would be stored, (F,) each, of primitives at window positions."""
    depth = plane_value(geometry.depth_plane, primitive, x, y)
    depth, keeps = clamp_depth(depth, geometry.is_in_range.take(primitive))
    if depth_format.quantity == "z":
        return depth, keeps, depth_format.store(depth)
    inverse_w = plane_value(geometry.inverse_w_plane, primitive, x, y)
    return depth, keeps & (inverse_w > 0), depth_format.store(inverse_w)


def fragment_inverse_w(geometry: Geometry, fragments: Fragments, raster: Raster) -> Floats:
    """Return 1/w at fragments, (F,) float64."""
    if isinstance(fragments, LineFragments):
        start, end = inverse_w_parts(outlines_of(geometry), fragments, raster.center)
        return start + end
    x, y = raster.centers(fragments.column, fragments.row)
    return plane_value(geometry.inverse_w_plane, fragments.primitive, x, y)


def fragment_values(
    geometry: Geometry, settings: Settings, fragments: Fragments, raster: Raster
) -> tuple[Floats, Floats]:
    """Return weights of the corners (F, 3) and interpolated values (F, K) of fragments."""
    mode, varyings = settings.interpolation, geometry.primitives.varyings
    if isinstance(fragments, LineFragments) and mode != "flat":
        return interpolate_outlines(outlines_of(geometry), varyings, fragments, raster.center, mode)
    x, y = raster.centers(fragments.column, fragments.row)
    return interpolate(geometry.planes, varyings, fragments.primitive, x, y, mode, settings.provoking)


def outlines_of(geometry: Geometry) -> Outlines:
    """Return the outlines of a geometry that is drawn as a wireframe."""
    assert geometry.outlines is not None
    return geometry.outlines


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
    antialiased = table.get("antialiasing", settings.antialiasing).function
    frame: Frame = antialiased(scene, settings, raster, chosen)
    return frame


def covered(
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    counts: dict[str, StageCount],
    chosen: Integers | None = None,
) -> Iterator[Fragments]:
    """Yield the covered pixels of the ``chosen`` (C,) primitives, or all, a few million looked-at pixels at a time."""
    count = counts["bin"]
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


def outlined(
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


def interpolate_fragments(
    geometry: Geometry, settings: Settings, raster: Raster, fragments: Fragments, count: StageCount
) -> Floats:
    """Return the interpolated values (F, K) float64 of fragments."""
    with timed(count):
        count.incoming = count.outgoing = len(fragments)
        if isinstance(fragments, LineFragments):
            return fragment_values(geometry, settings, fragments, raster)[1]
        values, mode = geometry.primitives.values, settings.interpolation
        interpolator = Interpolator(geometry.planes, values, mode, settings.provoking)
        return interpolator.values(fragments.primitive, *raster.centers(fragments.column, fragments.row))


def shade_values(
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    fragments: Fragments,
    values: Floats,
    count: StageCount,
) -> Floats:
    """Return the colours (F, 4) float64 of fragments."""
    with timed(count):
        count.incoming = count.outgoing = len(fragments)
        mesh = geometry.primitives.mesh[fragments.primitive]
        return shade_fragments(scene, settings, geometry.primitives.layout, mesh, values).color


CHUNK = 1 << 22
"""Pixels of bounding boxes that are scheduled in one go."""
