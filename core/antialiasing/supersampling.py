"""Supersampling: the picture at n times the size, every sample drawn and shaded by itself, and then resolved.

The finer picture is drawn by the same methods on its own raster: its corners are snapped to 1/256 of a sample's
square, its textures are looked up and its light is evaluated at every sample, and its lines are one sample wide.

Memory: 28 bytes a sample for the buffers (450 a pixel of 4 x 4), beside what `BAND` samples take while they are drawn.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from core.antialiasing.sample_counts import SampleTraits, side_of
from core.antialiasing.sampled import SampledPicture, resolve_region
from core.antialiasing.single_sample import draw_geometry
from core.framebuffer.sample_positions import grid_positions
from core.methods import method, table
from core.raster.pixel_runs import Raster
from core.records.arrays import Integers
from core.records.frame import STAGES, Frame, Samples, StageCount
from core.scene import SIZE_LIMIT, AnyScene
from core.settings import Settings
from core.stages.vertices import Geometry, process_geometry

BAND = 1 << 21
"""Samples that are drawn in one go: the numbers of more would take too much memory."""
GEOMETRY = STAGES[: STAGES.index("bin") + 1]
"""Stages that every band counts anew."""


@method(
    "antialiasing",
    "ssaa-4",
    "Supersampling, 2 x 2 samples",
    source="LMU 2020, Supersampling (SSAA); Jubair, Antialiasing, supersampling",
    exact_for="areas in quarters of a pixel, shading included",
    breaks_where="edges that are nearly level or upright: two steps a pixel; four times the work",
    takes=("resolve_filter",),
    traits=SampleTraits(lambda _: 2),
)
def supersample_by_2(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | None = None
) -> Frame:
    """Draw with 2 x 2 samples a pixel; ``chosen`` (T,) triangles, or all."""
    return supersample(scene, settings, raster, chosen, side_of(settings))


@method(
    "antialiasing",
    "ssaa-16",
    "Supersampling, 4 x 4 samples",
    source="LMU 2020, Supersampling (SSAA); Jubair, Antialiasing, supersampling",
    exact_for="areas in sixteenths of a pixel, shading included",
    breaks_where="edges that are nearly level or upright: four steps a pixel; sixteen times the work",
    takes=("resolve_filter",),
    traits=SampleTraits(lambda _: 4),
)
def supersample_by_4(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | None = None
) -> Frame:
    """Draw with 4 x 4 samples a pixel; ``chosen`` (T,) triangles, or all."""
    return supersample(scene, settings, raster, chosen, side_of(settings))


@method(
    "antialiasing",
    "ssaa-n",
    "Supersampling, n x n samples",
    source="LMU 2020, Supersampling (SSAA); Jubair, Antialiasing, supersampling",
    exact_for="areas in n * n parts of a pixel, shading included; n is samples_across",
    breaks_where="edges that are nearly level or upright: n steps a pixel; n * n times the work",
    takes=(
        "resolve_filter",
        "samples_across",
    ),
    traits=SampleTraits(lambda settings: settings.samples_across),
)
def supersample_by_n(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | None = None
) -> Frame:
    """Draw with ``samples_across`` x ``samples_across`` samples a pixel; ``chosen`` (T,) triangles, or all."""
    return supersample(scene, settings, raster, chosen, side_of(settings))


def supersample(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | None, side: int
) -> Frame:
    """Draw with ``side`` x ``side`` samples a pixel; ``chosen`` (T,) triangles, or all."""
    finer, plain = finer_scene(scene, side), finer_settings(settings)

    def draw_samples(wide: Raster) -> SampledPicture:
        bands = []
        for band in bands_of(finer_raster(wide, side), side, BAND):
            counts = {stage: StageCount() for stage in STAGES}
            geometry = in_squares(process_geometry(finer, plain, counts, chosen), settings, side)
            bands.append(draw_geometry(finer, geometry, plain, band, counts))
        return _join_bands(bands, side)

    return resolve_region(draw_samples, grid_positions(side), settings, raster)


def finer_settings(settings: Settings) -> Settings:
    """Return the settings that samples are drawn with: each is in the middle of its square."""
    return replace(settings, antialiasing="none", pixel_center="half")


def in_squares(geometry: Geometry, settings: Settings, side: int) -> Geometry:
    """Return the geometry of the finer scene, moved so that the squares of pixels begin at whole samples.

    The square of pixel i reaches from i - 1/2 to i + 1/2 where centres are whole numbers.
    """
    border = 0.5 - table.get("pixel_center", settings.pixel_center).function()
    return geometry.moved(border * side, border * side) if border else geometry


def finer_scene(scene: AnyScene, side: int) -> AnyScene:
    """Return the scene at ``side`` times its size.

    Raises
    ------
    ValueError
        If that is larger than a raster may be.
    """
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


def _join_bands(bands: list[Frame], side: int) -> SampledPicture:
    """Return all samples of bands, in rows by their place in the pixel."""
    counts = {stage: StageCount() for stage in STAGES}
    for number, band in enumerate(bands):
        for stage, count in band.statistics.items():
            counts[stage].seconds += count.seconds
            counts[stage].note = count.note
            if stage not in GEOMETRY or number == 0:
                counts[stage].incoming += count.incoming
                counts[stage].outgoing += count.outgoing
            elif stage == "bin":
                counts[stage].outgoing += count.outgoing

    by_place = partial(samples_by_place, side=side)
    color, depth, primitive, cover_count = (
        by_place(np.concatenate([getattr(band, name) for band in bands]))
        for name in ("color", "depth", "primitive", "cover_count")
    )
    attributes = np.concatenate([band.attributes[::side, ::side] for band in bands])
    return SampledPicture(
        Samples(grid_positions(side), color, depth, primitive, cover_count), attributes, counts
    )


def samples_by_place(finer: np.ndarray, side: int) -> np.ndarray:
    """Return a finer buffer (nH, nW, C) or (nH, nW) as (S, H, W, C) or (S, H, W): of all pixels, place by place."""
    height, width = (length // side for length in finer.shape[:2])
    squares = finer.reshape(height, side, width, side, *finer.shape[2:])
    by_place = np.moveaxis(squares, (1, 3), (0, 1))
    return np.ascontiguousarray(by_place.reshape(side * side, height, width, *finer.shape[2:]))
