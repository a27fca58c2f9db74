"""Affine interpolation that is corrected every n pixels along a row: one division for n pixels instead of one for each.

The weights are perspective-correct at two anchors of a row and linear between them. Anchors stand at columns whose
number is a multiple of n, so a pixel's anchors depend on nothing but the triangle and the pixel, whatever is drawn
first and in however many batches. Where a row of the triangle begins or ends between two of these columns, the anchor
moves to that end: beyond it 1/w need not be positive. A centre that lies outside its row, as snapping may have it
by a hair, is its own anchor, and gets what perspective gives it.

References
----------
M. Abrash, *Graphics Programming Black Book*, 1997, chapter 68 (Quake: every 16 pixels, to hide the division).
C. Hecker, *Perspective Texture Mapping, part 4: Approximations*, Game Developer, 1995.
"""

from dataclasses import dataclass
from math import floor, inf

import numpy as np

from core.interpolation.interpolation import Planes, perspective, weights_at
from core.methods import method
from core.records.arrays import Floats, Integers
from core.records.listing import Operation


@dataclass(frozen=True, eq=False)
class Anchors:
    """Where F fragments are interpolated perspective-correctly, and how far between."""

    row_left: Floats
    """(F,) float64 pixels, x where the triangle's row begins; -inf where no left edge bounds it."""
    row_right: Floats
    """(F,) float64 pixels, x where it ends."""
    grid: Floats
    """(F,) float64 pixels, x of the column before the pixel, or its own, whose number is a multiple of n."""
    left: Floats
    """(F,) float64 pixels, x of the anchor to the left of the pixel, or at it."""
    right: Floats
    """(F,) float64 pixels, x of the anchor to the right."""
    fraction: Floats
    """(F,) float64, 0 at the left anchor, 1 at the right one; 0 where both are one."""


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def place_anchors(planes: Planes, primitive: Integers, x: Floats, y: Floats, interval: int) -> Anchors:
    """Return the anchors of fragments (F,) with centres x, y (F,), ``interval`` columns apart at most.

    Notes
    -----
    The row of a triangle reaches from the largest crossing of its left edges to the least of its right edges, by the
    corners before snapping.
    """
    row_left, row_right = np.full(len(x), -np.inf), np.full(len(x), np.inf)
    sign = np.sign(planes.determinant).take(primitive)
    for corner in range(3):
        a = planes.a[:, corner].take(primitive)
        rest = planes.b[:, corner].take(primitive) * y + planes.c[:, corner].take(primitive)
        crossing = -rest / a
        is_left, is_right = a * sign > 0, a * sign < 0
        row_left = np.where(is_left & (crossing > row_left), crossing, row_left)
        row_right = np.where(is_right & (crossing < row_right), crossing, row_right)
    column = np.floor(x)
    grid = np.floor(column / interval) * interval + (x - column)
    is_inside = (row_left <= x) & (x <= row_right)
    left = np.where(is_inside, np.where(row_left > grid, row_left, grid), x)
    right = np.where(is_inside, np.where(row_right < grid + interval, row_right, grid + interval), x)
    fraction = np.where(right > left, (x - left) / (right - left), 0.0)
    return Anchors(row_left, row_right, grid, left, right, fraction)


def interpolate_corrected_at(
    a: Floats, b: Floats, c: Floats, determinant: float, x: float, y: float, interval: int, values: Floats
) -> tuple[list[float], float]:
    """Listing of affine interpolation corrected every ``interval`` pixels: adjugate (3,) each, corner values (3,)."""
    ends = [-inf, inf]
    for k in range(3):
        rest = b[k] * y + c[k]
        if a[k] * determinant > 0:
            ends[0] = max(ends[0], -rest / a[k])  #: row
        if a[k] * determinant < 0:
            ends[1] = min(ends[1], -rest / a[k])
    column = floor(x)
    grid = floor(column / interval) * interval + (x - column)  #: grid
    left, right = max(grid, ends[0]), min(grid + interval, ends[1])  #: anchors
    if not ends[0] <= x <= ends[1]:
        left = right = x
    t = (x - left) / (right - left) if right > left else 0.0  #: fraction
    first, second = weights_at(a, b, c, left, y), weights_at(a, b, c, right, y)  #: corrected
    weights = []
    for k in range(3):
        weights.append(first[k] * (1 - t) + second[k] * t)  #: weights
    value = weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]  #: value
    return weights, value


@method(
    "interpolation",
    "affine-n",
    "Affine, corrected every n pixels",
    source="Abrash 1997, Graphics Programming Black Book, chapter 68; Hecker 1995, Perspective Texture Mapping",
    exact_for="triangles with the same w at all corners; all triangles with a correction interval of 1",
    breaks_where="w that changes much within n pixels of a row: the error is that of affine over one interval",
    needs=("positive-w",),
    takes=("correction_interval",),
    listing=interpolate_corrected_at,
    operations={
        "affine-n": (
            Operation("row", "row", {"row_ends": "ends"}),
            Operation("grid", "grid", ("grid",)),
            Operation("anchors", "anchors", {"anchor_x": "left right"}),
            Operation("fraction", "fraction", {"fraction": "t"}),
            Operation("corrected", "corrected", {"anchor_weights": "first second"}),
            Operation("weights", "weights", ("weights",), ("inverse_w",)),
        )
    },
    traits="perspective",
)
@np.errstate(invalid="ignore", over="ignore")
def corrected_affine(
    planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int, interval: int
) -> Floats:
    """Return weights (F, 3) that are perspective-correct at two anchors of a row and linear between them.

    Notes
    -----
    Pixels of a wireframe lie along no row: they are interpolated perspective-correctly.
    """
    anchors = place_anchors(planes, primitive, x, y, interval)
    left = perspective(planes, primitive, anchors.left, y, provoking, interval)
    right = perspective(planes, primitive, anchors.right, y, provoking, interval)
    fraction = anchors.fraction[:, None]
    mixed: Floats = left * (1 - fraction) + right * fraction
    return mixed


def largest_affine_error(w_ratio: Floats) -> Floats:
    """Return how far affine interpolation strays along an edge, as a part of the edge.

    Parameters
    ----------
    w_ratio : (N,) float64 array
        w of one end over w of the other, above 0; r and 1/r give the same.

    Returns
    -------
    (N,) float64
        The largest difference between the affine and the perspective-correct parameter: (sqrt r - 1)/(sqrt r + 1).

    Notes
    -----
    With w = 1 and r at the ends, the point at t of the edge on screen is at s = t / (r - (r - 1) t) of it in space.
    t - s is largest where ds/dt = 1, that is r - (r - 1) t = sqrt r: at t = sqrt r / (sqrt r + 1), where
    s = 1 / (sqrt r + 1). With correction it holds for every interval, r being the ratio of w at its two anchors.
    """
    root = np.sqrt(w_ratio)
    error: Floats = np.abs(root - 1) / (root + 1)
    return error
