"""How far a picture of fewer samples is from that of everything on, in the pixels whose candidates differ.

There it is looked, sample by sample, which triangle covers it and is nearest: that is exact, as coverage is decided on
the snapped corners. So the weights with which the triangles' colours are mixed are known for both pictures, and with
the range of each colour the two mixtures have ranges too; no more than these can they be apart. Where a sample is in
doubt (its centre on an edge, depths too close) the whole width of the candidates counts, see ``surfaces``.

The widest pixels come first, and where too many are beyond the tolerance the others need not be looked at.
"""

from dataclasses import dataclass

import numpy as np

from core.records.arrays import Flags, Floats, Integers
from core.study.planner.bounds.bytes import byte_width
from core.study.planner.bounds.color_ranges import ColorRanges
from core.study.planner.bounds.translucency import Range, blended_mixture
from core.study.planner.scene_analysis.conservative_coverage import Touched
from core.study.planner.scene_analysis.per_sample_check import pairs_of, sample_pairs
from core.study.planner.scene_analysis.sample_patterns import EVERYTHING, Pattern
from core.study.planner.scene_analysis.surfaces import Surfaces

BATCH = 512
"""Pixels that are looked at first; each further batch is twice as large."""


@dataclass(frozen=True)
class SampleError:
    """How far pictures of some samples are from everything on."""

    error: float
    """Bound in 1/255, of all pixels but those ``beyond``."""
    beyond: int
    """Pixels that may be farther off than the tolerance; where there are too many, those that were found."""


def sample_error(
    touched: Touched,
    colors: tuple[ColorRanges, ColorRanges],
    found: Surfaces,
    background: Floats,
    pattern: Pattern,
    margin: float,
    most: tuple[int, int],
    alpha: Range | None = None,
) -> SampleError:
    """Bound the error of a picture with other samples.

    Parameters
    ----------
    touched : Touched
    colors : (ColorRanges, ColorRanges)
        At the samples of everything on, and where this method takes colours.
    found : Surfaces
        The candidates, with the width of both.
    background : (4,) float64 linear
    pattern : Pattern
    margin : float
        Window depths closer than this leave a doubt.
    most : (int, int)
        The tolerance: bytes, and pixels that may differ by more.
    alpha : ((P,) float64, (P,) float64), optional
        The least and the largest of each primitive, where surfaces let others shine through.
    """
    most_bytes, most_pixels = most
    wide = np.flatnonzero(found.width > most_bytes)
    wide = wide[np.argsort(-found.width[wide], kind="stable")]
    narrow = found.width[found.width <= most_bytes]
    error, beyond, first, count = float(narrow.max(initial=0.0)), 0, 0, BATCH
    while first < len(wide) and beyond <= most_pixels:
        pixels = np.sort(wide[first : first + count])
        bounds = _bounds(touched, colors, found, background, pattern, margin, pixels, alpha)
        within = bounds <= most_bytes
        error = max(error, float(bounds[within].max(initial=0.0)))
        beyond += int(np.count_nonzero(~within))
        first, count = first + count, 2 * count
    return SampleError(error, beyond)


def _bounds(
    touched: Touched,
    colors: tuple[ColorRanges, ColorRanges],
    found: Surfaces,
    background: Floats,
    pattern: Pattern,
    margin: float,
    pixels: Integers,
    alpha: Range | None,
) -> Floats:
    """Return the bounds (N,) of some pixels in rising order, in 1/255."""
    pairs, starts = pairs_of(touched, pixels, found.is_candidate)
    width = found.width[pixels]
    place = np.searchsorted(pixels, touched.pixel[pairs[starts]])
    mixtures = []
    for of_pattern, samples in zip(colors, (EVERYTHING, pattern), strict=True):
        where = background, samples, margin, pairs, starts
        mixtures.append(
            _mixture(touched, of_pattern, *where)
            if alpha is None
            else blended_mixture(touched, of_pattern, alpha, *where)
        )
    (full, is_sure), (fewer, is_sure_too) = mixtures
    apart = np.maximum(byte_width(full[0], fewer[1]), byte_width(fewer[0], full[1])).max(axis=1)
    bounds = width.copy()
    bounds[place] = np.where(is_sure & is_sure_too, np.minimum(apart, width[place]), width[place])
    return bounds


def _mixture(
    touched: Touched,
    colors: ColorRanges,
    background: Floats,
    pattern: Pattern,
    margin: float,
    pairs: Integers,
    starts: Integers,
) -> tuple[tuple[Floats, Floats], Flags]:
    """Return the least and the largest mean light (N, 3) of the samples of N pixels, and where it is sure (N,)."""
    counts = np.diff(np.append(starts, len(pairs)))
    weight, nothing = np.zeros(len(pairs)), np.zeros(len(starts))
    is_sure = np.ones(len(starts), bool)
    for covers, may_cover, depth in sample_pairs(touched, pairs, pattern):
        nearest = np.minimum.reduceat(np.where(covers, depth, np.inf), starts)
        within = may_cover & (depth <= np.repeat(nearest, counts) + margin)
        several = np.add.reduceat(within.astype(np.int64), starts)
        is_sure &= (several == 0) | ((several == 1) & (nearest < np.inf))
        weight += within
        nothing += several == 0
    share, left = weight / len(pattern.positions), nothing / len(pattern.positions)
    least, most = (
        np.add.reduceat(share[:, None] * np.where(share[:, None] > 0, part[pairs], 0.0), starts, axis=0)
        + left[:, None] * background[:3]
        for part in (colors.low, colors.high)
    )
    return (least, most), is_sure
