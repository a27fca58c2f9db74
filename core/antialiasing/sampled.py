"""Several samples a pixel: what supersampling and multisampling have in common."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.framebuffer.resolve import filter_weights, reach_of, resolve_samples
from core.raster.pixel_runs import Raster
from core.records.arrays import Floats, Singles, read_only
from core.records.frame import Frame, Samples, StageCount
from core.records.timing import timed
from core.settings import Settings


class SampledPicture(NamedTuple):
    """All samples of a picture, before they are resolved."""

    samples: Samples
    attributes: Singles
    """(H, W, K) float32, of sample 0."""
    statistics: dict[str, StageCount]


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


def resolve_region(
    draw_samples: Callable[[Raster], SampledPicture], position: Floats, settings: Settings, raster: Raster
) -> Frame:
    """Draw the samples of a region, and those around it that the filter needs, and resolve them.

    Parameters
    ----------
    draw_samples : callable
        Draws all samples of a raster.
    position : (S, 2) float64
        Where they lie in the pixel.
    settings : Settings
    raster : Raster
        The region that is wanted.
    """
    weights = filter_weights(position, settings.resolve_filter)
    wide = grown(raster, reach_of(weights))
    picture = draw_samples(wide)
    count = picture.statistics["resolve"]
    with timed(count):
        inner = inner_of(wide, raster)
        samples = picture.samples
        color = resolve_samples(samples.color, weights)[inner]
        count.incoming, count.outgoing = samples.depth.size, color.shape[0] * color.shape[1]
        cropped = Samples(samples.position, *(read_only(values[:, *inner]) for values in _buffers(samples)))
    return Frame(
        color=read_only(color),
        depth=cropped.depth[0],
        primitive=cropped.primitive[0],
        attributes=read_only(picture.attributes[inner]),
        cover_count=read_only(cropped.cover_count.sum(axis=0, dtype=np.int32)),
        statistics=picture.statistics,
        samples=cropped,
    )


def inner_of(wide: Raster, raster: Raster) -> tuple[slice, slice]:
    """Return where the pixels of ``raster`` stand in the buffers of ``wide``: slices of (H, W, ...)."""
    first_column, first_row, end_column, end_row = raster.bounds
    column, row, _, _ = wide.bounds
    return slice(first_row - row, end_row - row), slice(first_column - column, end_column - column)


def _buffers(samples: Samples) -> tuple[NDArray[Any], ...]:
    return samples.color, samples.depth, samples.primitive, samples.cover_count
