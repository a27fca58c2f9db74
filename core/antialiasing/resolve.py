"""Resolving: samples drawn as the pixels of another picture, and filtered to one colour.

Every sample is weighed by its distance from the pixel's centre, x and y apart, and the sum is divided by that of the
weights. The weights are dyadic fractions where the samples' places are; the tent's for 3 x 3 samples are rounded.
Colours are linear: a mean of sRGB bytes would be too dark.

At the image's border the samples beyond it do not exist: the weights of those within are all that is summed, so a
picture of one colour keeps it.

References
----------
LMU, *Computer Graphics 1*, tutorial 5, "Super Sampling Antialiasing (SSAA)", 2020.
M. I. Jubair, *Computer Graphics*, "Anti-aliasing": box filtering by supersampling.
A. Glassner, *Principles of digital image synthesis*, 1995, 10.6 (box and tent, there "triangle").

A supersampled picture is drawn by the same methods on its own raster: its corners are snapped to 1/256 of a sample's
square, its textures are looked up and its light is evaluated at every sample, and its lines are one sample wide.

The four samples of multisampling are pictures of the moved scene, one for each place in the pixel
(`core.antialiasing.sampling`). A wireframe is not moved: its lines have no area, and cover all samples of their
pixels, as OpenGL's lines without multisampling do.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from core.antialiasing.sampling import ROTATED_GRID, grid_positions
from core.coverage.pixel_runs import Raster
from core.methods import method, table
from core.records.arrays import Floats, Singles, read_only
from core.records.frame import Frame, Samples, StageCount
from core.resolved import resolve
from core.scene import SIZE_LIMIT, AnyScene
from core.settings import Settings
from core.stages.declared import STAGES
from core.stages.geometry import Geometry

# Resolving: the colour of a pixel from those of the samples in and around it.


Weigh = Callable[[Floats], Floats]
AROUND = (-1, 0, 1)
"""Pixels looked at each way: no filter reaches farther than one pixel from the centre."""


@method(
    "resolve_filter",
    "box",
    "Box (mean of the pixel's samples)",
    source="Jubair, Anti-aliasing: box filtering; OpenGL 4.6, 18.3.1 (resolving by BlitFramebuffer)",
    exact_for="the mean over the pixel's square, as the number of samples grows",
    breaks_where="fine regular patterns: moiré stays visible",
)
def box(distance: Floats) -> Floats:
    """Return the weights (S,) of samples at distances along one axis from the pixel's centre, in pixels."""
    return np.where(np.abs(distance) <= 0.5, 1.0, 0.0)


@method(
    "resolve_filter",
    "tent",
    "Tent (samples of the neighbours too)",
    source="Glassner 1995, 10.6",
    exact_for="linear gradients, and a constant colour at the border",
    breaks_where="sharp details: one pixel spreads over three",
)
def tent(distance: Floats) -> Floats:
    """Return 1 at the centre, falling to 0 one pixel away. Arguments as in `box`."""
    return np.maximum(0.0, 1.0 - np.abs(distance))


def filter_weights(position: Floats, name: str) -> Floats:
    """Return what samples of the 3 x 3 pixels around a centre weigh.

    Parameters
    ----------
    position : (S, 2) float64
        Samples in a pixel, 0 to 1.
    name : str
        A method of the family ``resolve_filter``.

    Returns
    -------
    (3, 3, S) float64
        By row and column of the neighbour, from the lower left.
    """
    weigh: Weigh = table.get("resolve_filter", name).function
    x, y = position.T - 0.5
    rows = np.stack([weigh(y + row) for row in AROUND])
    columns = np.stack([weigh(x + column) for column in AROUND])
    return rows[:, None] * columns[None]


def reach_of(weights: Floats) -> int:
    """Return how many pixels away weights (3, 3, S) look: 0 or 1."""
    around = weights.copy()
    around[1, 1] = 0
    return int(around.any())


def resolve_samples(color: Singles, weights: Floats) -> Singles:
    """Return the picture of samples.

    Parameters
    ----------
    color : (S, H, W, 4) float32
        Linear.
    weights : (3, 3, S) float64

    Returns
    -------
    (H, W, 4) float32
        The weighted mean in float64, summed neighbour by neighbour and sample by sample, rounded once.
    """
    _, height, width, _ = color.shape
    total, sums = np.zeros((height, width, 1)), np.zeros((height, width, 4))
    for row, below in enumerate(AROUND):
        for column, left in enumerate(AROUND):
            to = _shifted(height, -below), _shifted(width, -left)
            source = _shifted(height, below), _shifted(width, left)
            for sample in np.flatnonzero(weights[row, column]):
                weight = weights[row, column, sample]
                with np.errstate(invalid="ignore", over="ignore"):
                    sums[to] += weight * color[sample][source].astype(np.float64)
                total[to] += weight
    with np.errstate(invalid="ignore", over="ignore"):
        return np.asarray((sums / total).astype(np.float32))


def _shifted(length: int, by: int) -> slice:
    """Return the part of an axis that has a neighbour ``by`` away, seen from the neighbour."""
    return slice(max(by, 0), length + min(by, 0))


def weighted_mean(samples: Sequence[float], weights: Sequence[float]) -> float:
    """Return one channel of a pixel (listing of `resolve_samples`); samples beyond the border are left out."""
    total = 0.0
    result = 0.0
    for value, weight in zip(samples, weights, strict=True):  #: samples
        result += weight * value
        total += weight
    return float(np.float32(result / total))  #: divide


# Samples as the pixels of another picture: of the scene at n times its size, or moved by the way to a
# sample.


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
    return replace(resolve(settings).of_one_sample, pixel_center="half")


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
