"""Resolving: the colour of a pixel from those of the samples in and around it.

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
"""

from collections.abc import Callable, Sequence

import numpy as np

from core.methods import method, table
from core.records.arrays import Floats, Singles

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
