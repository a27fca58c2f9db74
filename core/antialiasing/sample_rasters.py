"""Samples as the pixels of another picture: of the scene at n times its size, or moved by the way to a sample.

A supersampled picture is drawn by the same methods on its own raster: its corners are snapped to 1/256 of a sample's
square, its textures are looked up and its light is evaluated at every sample, and its lines are one sample wide.

The four samples of multisampling are pictures of the moved scene, one for each place in the pixel
(`core.antialiasing.sampling`). A wireframe is not moved: its lines have no area, and cover all samples of their
pixels, as OpenGL's lines without multisampling do.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from core.antialiasing.sampling import ROTATED_GRID, grid_positions
from core.framebuffer.resolve import resolve_samples
from core.raster.pixel_runs import Raster
from core.records.arrays import Floats, Singles, read_only
from core.records.frame import Frame, Samples, StageCount
from core.resolved import resolve
from core.scene import SIZE_LIMIT, AnyScene
from core.settings import Settings
from core.stages.declared import STAGES
from core.stages.geometry import Geometry

GEOMETRY = STAGES[: STAGES.index("bin") + 1]
"""Stages that count triangles."""


def at_sample(geometry: Geometry, sample: int) -> Geometry:
    """Return the geometry that has one of the four samples at the pixels' centres."""
    if geometry.outlines is not None:
        return geometry
    x, y = 0.5 - ROTATED_GRID[sample]
    return geometry.moved(float(x), float(y))


def finer_settings(settings: Settings) -> Settings:
    """Return the settings that samples are drawn with: each is in the middle of its square."""
    return replace(settings, antialiasing="none", pixel_center="half")


def in_squares(geometry: Geometry, settings: Settings, side: int) -> Geometry:
    """Return the geometry of the finer scene, moved so that the squares of pixels begin at whole samples.

    The square of pixel i reaches from i - 1/2 to i + 1/2 where centres are whole numbers.
    """
    border = 0.5 - resolve(settings).center
    return geometry.moved(border * side, border * side) if border else geometry


def finer_scene(scene: AnyScene, side: int) -> AnyScene:
    """Return the scene at ``side`` times its size; ValueError if that is larger than a raster may be."""
    width, height = (side * length for length in scene.size)
    if max(width, height) > SIZE_LIMIT:
        raise ValueError(
            f"{side} x {side} samples a pixel make {width}x{height} samples of {scene.size[0]}x{scene.size[1]} pixels, "
            f"at most {SIZE_LIMIT} each way can be drawn"
        )
    return replace(scene, size=(width, height))


def finer_raster(raster: Raster, side: int) -> Raster:
    """Return the raster whose pixels are the samples of ``raster``: ``side`` x ``side`` in the square of each pixel."""
    first_column, first_row, end_column, end_row = raster.bounds
    region = None
    if raster.region is not None:
        columns, rows = end_column - first_column, end_row - first_row
        region = (side * first_column, side * first_row, side * columns, side * rows)
    return Raster(side * raster.width, side * raster.height, region=region)


def bands_of(raster: Raster, side: int, most: int) -> Iterator[Raster]:
    """Yield parts of a raster of samples, whole rows of pixels of about ``most`` samples, from the bottom up."""
    first_column, first_row, end_column, end_row = raster.bounds
    columns = end_column - first_column
    rows = max(most // (columns * side), 1) * side
    if rows >= end_row - first_row:
        yield raster
        return
    for row in range(first_row, end_row, rows):
        yield replace(raster, region=(first_column, row, columns, min(rows, end_row - row)))


def samples_by_place(finer: np.ndarray, side: int) -> np.ndarray:
    """Return a finer buffer (nH, nW, C) or (nH, nW) as (S, H, W, C) or (S, H, W): of all pixels, place by place."""
    height, width = (length // side for length in finer.shape[:2])
    squares = finer.reshape(height, side, width, side, *finer.shape[2:])
    by_place = np.moveaxis(squares, (1, 3), (0, 1))
    return np.ascontiguousarray(by_place.reshape(side * side, height, width, *finer.shape[2:]))


def join_bands(bands: list[Frame], side: int) -> tuple[Samples, Singles, dict[str, StageCount]]:
    """Return the samples of bands of a finer picture place by place, the attributes of sample 0, and the counts."""
    counts = {stage: StageCount() for stage in STAGES}
    for number, drawn in enumerate(bands):
        for stage, count in drawn.statistics.items():
            # Every band counts all triangles anew, and pixels of its own.
            is_known, has_pixels = number > 0 and stage in GEOMETRY, stage == "bin"
            counts[stage].incoming += 0 if is_known else count.incoming
            counts[stage].outgoing += 0 if is_known and not has_pixels else count.outgoing
            counts[stage].seconds += count.seconds
            counts[stage].note = count.note
    color, depth, primitive, cover_count = (
        samples_by_place(np.concatenate([getattr(drawn, name) for drawn in bands]), side)
        for name in ("color", "depth", "primitive", "cover_count")
    )
    attributes = np.concatenate([drawn.attributes[::side, ::side] for drawn in bands])
    return Samples(grid_positions(side), color, depth, primitive, cover_count), attributes, counts


def grown(raster: Raster, reach: int) -> Raster:
    """Return the raster with ``reach`` more pixels on every side, as far as the image goes."""
    if not reach:
        return raster
    first_column, first_row, end_column, end_row = raster.bounds
    region = (
        first_column - reach,
        first_row - reach,
        end_column - first_column + 2 * reach,
        end_row - first_row + 2 * reach,
    )
    return replace(raster, region=region)


def inner_of(wide: Raster, raster: Raster) -> tuple[slice, slice]:
    """Return where the pixels of ``raster`` stand in the buffers of ``wide``: slices of (H, W, ...)."""
    first_column, first_row, end_column, end_row = raster.bounds
    column, row, _, _ = wide.bounds
    return slice(first_row - row, end_row - row), slice(first_column - column, end_column - column)


def resolve_frame(
    samples: Samples,
    attributes: Singles,
    counts: dict[str, StageCount],
    weights: Floats,
    wide: Raster,
    raster: Raster,
) -> Frame:
    """Resolve the samples of a ``wide`` raster, as far as the filter looks, to the pixels of ``raster``.

    ``attributes`` (H, W, K) are those of sample 0; ``weights`` (3, 3, S) the filter's.
    """
    with counts["resolve"] as count:
        inner = inner_of(wide, raster)
        color = resolve_samples(samples.color, weights)[inner]
        count.incoming, count.outgoing = samples.depth.size, color.shape[0] * color.shape[1]
        buffers = (samples.color, samples.depth, samples.primitive, samples.cover_count)
        cropped = Samples(samples.position, *(read_only(values[:, *inner]) for values in buffers))
    return Frame(
        color=color,
        depth=cropped.depth[0],
        primitive=cropped.primitive[0],
        attributes=attributes[inner],
        cover_count=cropped.cover_count.sum(axis=0, dtype=np.int32),
        statistics=counts,
        samples=cropped,
    )
