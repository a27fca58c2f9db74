"""Depth and attributes of triangles at pixel centres, in Python's integers, rounded once at the end.

The three corners of a triangle in the homogeneous window, multiplied to whole numbers, have whole-number cross
products n_k: the shares of the corners in a point of the window are in proportion to them. A value is
sum(n_k v_k) / sum(n_k), the depth z/w is sum(n_k z_k) / det.

References
----------
M. Zwicker, *Computergrafik*, lecture "Perspective correct interpolation", Bern 2016.
"""

from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Floats, Integers
from core.study.exact.coverage import doubled_center, exact_spans, homogeneous_corner

Whole = NDArray[Any]
"""Python integers, as an array of objects."""


@dataclass(frozen=True, eq=False)
class ExactPlanes:
    """Linear functions of one triangle over doubled pixel positions, in whole numbers."""

    coefficients: tuple[tuple[int, int, int], ...]
    """a, b, c of n_k, for doubled x and y."""
    determinant: int
    """Of the (x, y, w) matrix, in the same unit; 0: seen edge-on."""
    depth: tuple[int, int, int, int]
    """a, b, c of the window depth over doubled x and y, and what it is to be divided by (positive)."""


def exact_planes(corners: Floats, size: tuple[int, int]) -> ExactPlanes:
    """Return the planes of a triangle given in clip space, (3, 4) float64, before snapping."""
    placed = [homogeneous_corner(corner, size) for corner in corners]
    scale = lcm(*(value.denominator for corner in placed for value in corner))
    rows = [tuple(int(value * scale) for value in corner) for corner in placed]
    coefficients = []
    for k in range(3):
        (x1, y1, w1), (x2, y2, w2) = rows[k - 2], rows[k - 1]
        a, b, c = y1 * w2 - w1 * y2, w1 * x2 - x1 * w2, x1 * y2 - y1 * x2
        coefficients.append((a, b, 2 * c))
    (x, y, w), (a, b, c) = rows[0], coefficients[0]
    determinant = x * a + y * b + w * c // 2
    return ExactPlanes(
        tuple(coefficients), determinant, _depth_plane(corners, coefficients, determinant, scale)
    )


def _depth_plane(
    corners: Floats, coefficients: list[tuple[int, int, int]], determinant: int, scale: int
) -> tuple[int, int, int, int]:
    """Return (z/w + 1)/2 over doubled positions: sum(n_k z_k) / det, which is measured in ``scale`` units of w."""
    z = [Fraction(float(corner[2])) for corner in corners]
    unit = lcm(*(value.denominator for value in z))
    heights = [int(value * unit) for value in z]
    a, b, c = (
        sum(part[i] * height for part, height in zip(coefficients, heights, strict=True)) for i in range(3)
    )
    # z/w = scale sum(n_k z_k) / (2 det), n_k taken at doubled positions; half of it and a half are the depth.
    divisor = 4 * determinant * unit
    sign = -1 if divisor < 0 else 1
    return sign * scale * a, sign * scale * b, sign * (scale * c + divisor // 2), abs(divisor)


def _at(plane: tuple[int, int, int], doubled_x: Whole, doubled_y: Whole) -> Whole:
    a, b, c = plane
    return np.asarray(a * doubled_x + b * doubled_y + c)


def _doubled(index: Integers, doubled_center: int) -> Whole:
    return np.asarray((2 * index + doubled_center).astype(object))


def exact_values(
    corners: Floats,
    values: Floats,
    size: tuple[int, int],
    column: Integers,
    row: Integers,
    pixel_center: str = "half",
) -> Floats:
    """Return perspective-correct values (F, K) float64, correctly rounded, of values (3, K) at the corners (3, 4).

    Notes
    -----
    NaN for a triangle that is seen edge-on, or where 1/w is 0.
    """
    planes, center = exact_planes(corners, size), doubled_center(pixel_center)
    x, y = _doubled(column, center), _doubled(row, center)
    shares = [_at(plane, x, y) for plane in planes.coefficients]
    total = shares[0] + shares[1] + shares[2]
    result = np.full((len(column), values.shape[1]), np.nan)
    defined = np.flatnonzero(total != 0) if planes.determinant else np.empty(0, np.int64)
    for k, of_corners in enumerate(values.T):
        exact = [Fraction(float(value)) for value in of_corners]
        unit = lcm(*(value.denominator for value in exact))
        first, second, third = (int(value * unit) for value in exact)
        mixed = first * shares[0] + second * shares[1] + third * shares[2]
        result[defined, k] = (mixed[defined] / (unit * total[defined])).astype(np.float64)
    return result


@dataclass(frozen=True, eq=False)
class ExactFragments:
    """F covered pixels whose depth is in range, in drawing order."""

    triangle: Integers
    """(F,) int64."""
    column: Integers
    row: Integers
    depth: Floats
    """(F,) float64, window depth, correctly rounded."""
    planes: dict[int, ExactPlanes]
    """By triangle, to compare depths that round to the same number."""


def exact_fragments(clip: Floats, size: tuple[int, int]) -> ExactFragments:
    """Return the pixels of triangles (T, 3, 4), of corners on the grid, that lie between the near and the far plane.

    Notes
    -----
    Depth comes from the corners before snapping. A triangle that is in range as a whole keeps all its pixels, as its
    depth is clamped where snapping makes it reach a hair farther; only others are decided pixel by pixel.
    """
    triangle, column, row = exact_spans(clip, size).pixels()
    depth, keeps = np.zeros(len(triangle)), np.ones(len(triangle), bool)
    planes: dict[int, ExactPlanes] = {}
    center = doubled_center("half")
    ends = np.flatnonzero(np.diff(triangle, append=-1)) + 1
    for first, end in zip([0, *ends][:-1], ends, strict=True):
        part, number = slice(first, end), int(triangle[first])
        plane = planes[number] = exact_planes(clip[number], size)
        above = _at(plane.depth[:3], _doubled(column[part], center), _doubled(row[part], center))
        below = plane.depth[3]
        if below == 0:
            keeps[part] = False
            continue
        depth[part] = (above / below).astype(np.float64)
        _, _, z, w = clip[number].T
        if ((np.abs(z) > w) | (w <= 0)).any():
            keeps[part] = (above >= 0) & (above <= below)
    depth = np.clip(depth, 0.0, 1.0)
    return ExactFragments(triangle[keeps], column[keeps], row[keeps], depth[keeps], planes)


def exact_visible(fragments: ExactFragments, size: tuple[int, int]) -> Integers:
    """Return the triangle that is nearest at every pixel, (H, W) int64, -1 for none; a tie keeps the first drawn."""
    width, height = size
    pixel = fragments.row * width + fragments.column
    order = np.lexsort((fragments.triangle, fragments.depth, pixel))
    seen = np.full(width * height, -1)
    starts = np.flatnonzero(np.diff(pixel[order], prepend=-1))
    seen[pixel[order[starts]]] = fragments.triangle[order[starts]]

    # Depths that are hardly apart are compared as fractions.
    first, second = order[:-1], order[1:]
    close = (pixel[first] == pixel[second]) & (fragments.depth[second] - fragments.depth[first] <= 2.0**-50)
    for at in np.unique(pixel[first[close]]):
        candidates = np.flatnonzero(pixel == at)
        nearest = min(candidates, key=lambda k: (_exact_depth(fragments, int(k)), fragments.triangle[k]))
        seen[at] = fragments.triangle[nearest]
    return seen.reshape(height, width)


def exact_nearest(clip: Floats, size: tuple[int, int]) -> Integers:
    """Return (H, W) int64, the nearest of triangles (T, 3, 4) in clip space, whichever way it faces; -1: none."""
    return exact_visible(exact_fragments(clip, size), size)


def _exact_depth(fragments: ExactFragments, index: int) -> Fraction:
    a, b, c, below = fragments.planes[int(fragments.triangle[index])].depth
    center = doubled_center("half")
    x, y = 2 * int(fragments.column[index]) + center, 2 * int(fragments.row[index]) + center
    return min(max(Fraction(a * x + b * y + c, below), Fraction(0)), Fraction(1))
