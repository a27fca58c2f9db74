"""Incremental edge functions: a value is the one of the pixel before, plus a to the right or b upwards.

The box of a triangle is walked row by row. Its first value is evaluated, the first of every other row is that of the
row below plus b, and along a row a is added. One addition a pixel and edge instead of two products and two sums:
exact where sums are (``int64``, ``exact``, and ``snapped`` where an end of every edge is before the eye); where each
sum is rounded, the errors add up along the way, and the edge drifts.

The walk starts at the corner of the box in the *image*, whatever region of it is drawn, so that every region shows its
part of the picture.

References
----------
J. Pineda, *A parallel algorithm for polygon rasterization*, 1988.
"""

from dataclasses import replace

import numpy as np

from core.raster.binning import bound
from core.raster.edges.edge_functions import EdgeFunctions, edge_value
from core.raster.number_formats.number_format import FormatValue, NumberFormat
from core.raster.pixel_runs import ADDED_A, ADDED_B, EVALUATED, Raster, Runs, Stepping
from core.records.arrays import Flags, Integers


def step_to(edges: EdgeFunctions, runs: Runs, raster: Raster) -> Stepping:
    """Add up from the first pixel of every box of the image to the first pixels of runs."""
    whole = bound(edges, replace(raster, region=None))
    triangle, numbers = runs.triangle, edges.numbers
    x, y = (
        numbers.of_pixels(place[:, None])
        for place in raster.centers(whole.column[triangle], whole.row[triangle])
    )
    a, b, c = edges.a[triangle], edges.b[triangle], edges.c[triangle]
    with np.errstate(over="ignore", invalid="ignore"):
        first = edge_value(a, b, c, x, y)
    climbs, strides = runs.row - whole.row[triangle], runs.start - whole.column[triangle]
    at_row, below = add_up(first, increments(numbers, b), climbs)
    value, left = add_up(at_row, increments(numbers, a), strides)
    added = np.where(strides > 0, ADDED_A, np.where(climbs > 0, ADDED_B, EVALUATED))
    return Stepping(value, np.where((strides > 0)[:, None], left, below), added)


def increments(numbers: NumberFormat, slope: FormatValue) -> FormatValue:
    """Return what a value grows by from pixel to pixel, where a or b is ``slope``, any shape."""
    increment: FormatValue = slope * numbers.of_pixels(np.ones(1))
    return increment


def add_up(value: FormatValue, step: FormatValue, count: Integers) -> tuple[FormatValue, FormatValue]:
    """Add steps (N, 3) to values (N, 3), one after the other, ``count`` (N,) times each.

    Returns
    -------
    value : (N, 3)
    before : (N, 3)
        What the last addition started from; where there was none, the value itself.
    """
    order = np.argsort(-count, kind="stable")
    now, step = value[order], step[order]
    before = now.copy()
    with np.errstate(over="ignore", invalid="ignore"):
        for active in _active_counts(count):
            before[:active] = now[:active]
            now[:active] += step[:active]
    found, earlier = np.empty_like(now), np.empty_like(before)
    found[order], earlier[order] = now, before
    return found, earlier


def stepped_values(edges: EdgeFunctions, runs: Runs) -> FormatValue:
    """Return the values (Q, 3) at all pixels of runs, run by run, added up along them from where they start."""
    assert runs.stepping is not None
    length = runs.lengths
    order = np.argsort(-length, kind="stable")
    now, step = runs.stepping.value[order], increments(edges.numbers, edges.a)[runs.triangle[order]]
    place = (np.cumsum(length) - length)[order]
    values = np.empty((int(length.sum()), 3), now.dtype)
    with np.errstate(over="ignore", invalid="ignore"):
        for active in _active_counts(length):
            values[place[:active]] = now[:active]
            now[:active] += step[:active]
            place[:active] += 1
    return values


def _active_counts(count: Integers) -> list[int]:
    """Return for k = 0, 1, ... how many of ``count`` (N,) are greater than k, while there are any."""
    longest = int(count.max(initial=0))
    histogram = np.bincount(np.maximum(count, 0), minlength=longest + 1)
    at_most = np.cumsum(histogram)
    counts: list[int] = (len(count) - at_most[:longest]).tolist()
    return counts


def step_covers(
    before: list[float], increments: list[float], owns_tie: Flags | list[bool]
) -> tuple[list[float], bool]:
    """Listing of one pixel: values (3,) of the pixel it is reached from, and what is added to each of them."""
    values = []
    inside = []
    for k in range(3):
        value = before[k] + increments[k]  #: add
        values.append(value)
        inside.append(bool(value > 0 or (value == 0 and owns_tie[k])))
    return values, all(inside)  #: covered
