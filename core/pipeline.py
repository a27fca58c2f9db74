"""The pipeline: a scene becomes a picture, stage by stage.

The same functions serve the picture (in batches, nothing kept) and the trace (a few triangles, everything kept).
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from core.fragments.interpolation import Interpolator, interpolate
from core.methods import table
from core.raster.binning import bound
from core.raster.coverage import Fragments, cover
from core.raster.edges.edge_functions import EdgeFunctions
from core.raster.fills.tested import effective_fill
from core.raster.fills.traits import fill_traits
from core.raster.lines.wireframe import (
    LineFragments,
    draw_outlines,
    interpolate_outlines,
)
from core.raster.pixel_runs import Boxes, Raster, Runs, make_raster, rows_of
from core.records.arrays import Floats, Integers
from core.records.frame import Frame, StageCount
from core.scene import AnyScene, ClipScene, Texture
from core.settings import Settings, import_methods
from core.stages.fragment_color import shade_fragments
from core.stages.fragment_depth import fragment_depth, fragment_inverse_w, outlines_of
from core.stages.texture_slopes import texture_slopes
from core.stages.vertices import Geometry, process_geometry, timed

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
    fill = table.get("fill", effective_fill(settings.fill, settings.coverage)).function
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
    import_methods(settings)
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
    counts["raster"].note = (
        "" if effective_fill(settings.fill, settings.coverage) == settings.fill else settings.fill
    )
    with timed(count):
        edges = geometry.edges if chosen is None else geometry.edges.take(chosen)
        number = np.arange(len(edges)) if chosen is None else chosen
        count.incoming += len(edges)
        first_column, first_row, end_column, end_row = raster.bounds
        boxes = bound(edges, raster)
        area = (boxes.row_end - boxes.row) * (boxes.column_end - boxes.column)
        if fill_traits(settings.fill).looks_everywhere:
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
        how = settings.interpolation, settings.provoking, settings.correction_interval
        interpolator = Interpolator(geometry.planes, geometry.primitives.values, *how)
        return interpolator.values(fragments.primitive, *raster.centers(fragments.column, fragments.row))


def shade_values(
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


CHUNK = 1 << 22
"""Pixels of bounding boxes that are scheduled in one go."""
