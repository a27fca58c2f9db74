"""Binning: the part of the raster that a triangle may touch, as a box and as blocks of n x n pixels.

References
----------
M. Zwicker, *Computergrafik*, lecture "Binning", Bern 2016: three cases, conservative block test, two levels.
N. Greene, *Hierarchical polygon tiling with coverage masks*, 1996.
"""

import numpy as np

from core.coverage.edges import EdgeFunctions, edge_value, is_inside
from core.coverage.pixel_runs import (
    BEHIND,
    INSIDE,
    LEAF,
    MIXED,
    OUTSIDE,
    PROJECTED,
    SPLIT,
    Blocks,
    Boxes,
    Raster,
    Runs,
    expand,
)
from core.records.arrays import Flags, Floats, Integers


def bound(edges: EdgeFunctions, raster: Raster) -> Boxes:
    """Return the pixels whose centres lie in the bounding box of each triangle, by the lecture's three cases.

    Notes
    -----
    1. Every corner can be projected: its bounding box, limited to the raster. 2. No corner in front of the eye
    (all w <= 0): nothing. 3. Otherwise: the whole raster. A corner too far away to be snapped counts as
    not projected, so that case 1 stays exact. Formats that round, which do not snap, have a box as well: that of the
    corners as they are, outward to whole pixels; where they err by more, the box decides.
    """
    corners = edges.corners
    positions, projected = corners.decided, np.all(corners.is_projected, axis=1)
    if edges.numbers.bounds_outward:
        positions, projected = corners.window, has_outer_box(corners.window)
    case = np.where(projected, PROJECTED, MIXED)
    case[np.all(corners.homogeneous[..., 2] <= 0, axis=1)] = BEHIND

    # Columns and rows whose centres lie between the least and the greatest corner, ends included.
    bounds = raster.bounds
    box = np.empty((4, len(edges)), np.int64)
    for axis in range(2):
        first, second, third = positions[..., axis].T
        least, greatest = np.fmin(np.fmin(first, second), third), np.fmax(np.fmax(first, second), third)
        if edges.numbers.bounds_outward:
            least, greatest = np.floor(least), np.ceil(greatest)
        low = np.ceil(least - raster.center)
        high = np.floor(greatest - raster.center) + 1
        box[axis] = np.maximum(np.where(projected, low, bounds[axis]), bounds[axis])
        box[axis + 2] = np.minimum(np.where(projected, high, bounds[axis + 2]), bounds[axis + 2])

    # Nothing to look at: behind the eye, no area, or between the pixel centres.
    empty = (case == BEHIND) | (edges.doubled_area == 0) | (box[2] <= box[0]) | (box[3] <= box[1])
    box[2:, empty] = box[:2, empty]
    return Boxes(case, *box)


OUTER_LIMIT = 2.0**30
"""Pixels: corners beyond are not known well enough for an outer box."""


def has_outer_box(window: Floats) -> Flags:
    """Return (P,) bool: all corners (P, 3, 2) are in front of the eye and near enough to be bounded by whole pixels."""
    return np.asarray((np.abs(window) <= OUTER_LIMIT).all(axis=(1, 2)))


def classify(
    edges: EdgeFunctions, raster: Raster, triangle: Integers, column: Integers, row: Integers, size: int
) -> tuple[np.ndarray, np.ndarray, Integers, Integers]:
    """Test blocks of ``size`` x ``size`` pixels against the edges of their triangles, conservatively.

    Returns
    -------
    low, high : (N, 3) float64
        Least and greatest value of each edge function at the block's pixel centres. Both stand at corner pixels.
    verdict : (N,) int64
        ``OUTSIDE`` if one edge has all pixels outside, ``INSIDE`` if all edges have all pixels inside, else ``SPLIT``.
    rejected_by : (N,) int64
    """
    left, bottom = raster.centers(column, row)
    span = float(size - 1)
    numbers = edges.numbers
    low, high = np.empty((len(triangle), 3)), np.empty((len(triangle), 3))
    is_outside, is_within = np.zeros(len(triangle), bool), np.ones(len(triangle), bool)
    rejected_by = np.full(len(triangle), -1)
    for k in range(3):
        a, b, c = (coefficient[:, k].take(triangle) for coefficient in (edges.a, edges.b, edges.c))
        owns_tie = edges.owns_tie[:, k].take(triangle)
        right, top = a > 0, b > 0
        with np.errstate(over="ignore", invalid="ignore"):
            least, greatest = (
                edge_value(
                    a,
                    b,
                    c,
                    numbers.of_pixels(left + span * at_right),
                    numbers.of_pixels(bottom + span * at_top),
                )
                for at_right, at_top in ((~right, ~top), (right, top))
            )
        low[:, k], high[:, k] = numbers.shown_values(least), numbers.shown_values(greatest)
        rejects = ~is_inside(greatest, owns_tie)
        rejected_by[rejects & ~is_outside] = k
        is_outside |= rejects
        is_within &= is_inside(least, owns_tie)
    verdict = np.where(is_outside, OUTSIDE, np.where(is_within, INSIDE, SPLIT))
    return low, high, verdict, rejected_by


def grid_blocks(boxes: Boxes, size: int) -> tuple[Integers, Integers, Integers]:
    """Return triangle, column and row of every block of the ``size`` grid that a box touches, row by row."""
    first_column, first_row = boxes.column // size, boxes.row // size
    columns = np.where(boxes.column_end > boxes.column, -(-boxes.column_end // size) - first_column, 0)
    rows = np.where(boxes.row_end > boxes.row, -(-boxes.row_end // size) - first_row, 0)
    triangle, place = expand(columns * rows)
    row, column = np.divmod(place, columns[triangle])
    return triangle, (first_column[triangle] + column) * size, (first_row[triangle] + row) * size


def one_level(edges: EdgeFunctions, boxes: Boxes, raster: Raster, size: int) -> Blocks:
    """Return the blocks of one grid."""
    triangle, column, row = grid_blocks(boxes, size)
    low, high, verdict, rejected_by = classify(edges, raster, triangle, column, row, size)
    count = len(triangle)
    return Blocks(
        triangle,
        column,
        row,
        np.full(count, size),
        np.full(count, -1),
        np.arange(1, count + 1),
        low,
        high,
        np.where(verdict == SPLIT, LEAF, verdict),
        rejected_by,
    )


def two_levels(edges: EdgeFunctions, boxes: Boxes, raster: Raster, size: int, factor: int) -> Blocks:
    """Return blocks of ``factor * size`` pixels, those that are neither in nor out followed by their own blocks."""
    coarse = one_level(edges, boxes, raster, size * factor)
    verdict = np.where(coarse.verdict == LEAF, SPLIT, coarse.verdict)

    # Blocks of a split node that the triangle's box touches.
    split = np.flatnonzero(verdict == SPLIT)
    column, row, parent = children(coarse, split, boxes, size, factor)
    triangle = coarse.triangle[parent]
    low, high, fine_verdict, fine_rejected = classify(edges, raster, triangle, column, row, size)
    fine_verdict = np.where(fine_verdict == SPLIT, LEAF, fine_verdict)

    # Pre-order: a node stands before its blocks, so it moves on by the blocks of the nodes before it.
    child_count = np.bincount(parent, minlength=len(verdict))
    own_place = np.arange(len(verdict)) + np.cumsum(child_count) - child_count
    child_place = np.arange(len(parent)) + parent + 1

    def merge(of_coarse: np.ndarray, of_fine: np.ndarray) -> np.ndarray:
        merged = np.empty((len(of_coarse) + len(of_fine), *of_coarse.shape[1:]), of_coarse.dtype)
        merged[own_place], merged[child_place] = of_coarse, of_fine
        return merged

    return Blocks(
        merge(coarse.triangle, triangle),
        merge(coarse.column, column),
        merge(coarse.row, row),
        merge(coarse.size, np.full(len(parent), size)),
        merge(coarse.parent, own_place[parent]),
        merge(own_place + 1 + child_count, child_place + 1),
        merge(coarse.low, low),
        merge(coarse.high, high),
        merge(verdict, fine_verdict),
        merge(coarse.rejected_by, fine_rejected),
    )


def children(
    coarse: Blocks, split: Integers, boxes: Boxes, size: int, factor: int
) -> tuple[Integers, Integers, Integers]:
    """Return column, row and parent of the small blocks in the ``split`` (S,) nodes that the triangle's box touches."""
    triangle = coarse.triangle[split]
    left, bottom = coarse.column[split], coarse.row[split]
    first_column = np.maximum((boxes.column[triangle] - left) // size, 0)
    first_row = np.maximum((boxes.row[triangle] - bottom) // size, 0)
    columns = np.minimum(-((left - boxes.column_end[triangle]) // size), factor) - first_column
    rows = np.minimum(-((bottom - boxes.row_end[triangle]) // size), factor) - first_row
    which, place = expand(columns * rows)
    row, column = np.divmod(place, columns[which])
    return (
        left[which] + (first_column[which] + column) * size,
        bottom[which] + (first_row[which] + row) * size,
        split[which],
    )


def runs_of_blocks(blocks: Blocks, boxes: Boxes) -> Runs:
    """Return the rows of the blocks that are inside (accepted) or have to be tested, limited to the boxes."""
    chosen = np.flatnonzero((blocks.verdict == INSIDE) | (blocks.verdict == LEAF))
    triangle = blocks.triangle[chosen]
    first = np.maximum(blocks.row[chosen], boxes.row[triangle])
    end = np.minimum(blocks.row[chosen] + blocks.size[chosen], boxes.row_end[triangle])
    start = np.maximum(blocks.column[chosen], boxes.column[triangle])
    stop = np.minimum(blocks.column[chosen] + blocks.size[chosen], boxes.column_end[triangle])
    which, place = expand(np.where(stop > start, np.maximum(end - first, 0), 0))
    return Runs(
        triangle=triangle[which],
        row=first[which] + place,
        start=start[which],
        stop=stop[which],
        accepted=blocks.verdict[chosen[which]] == INSIDE,
        group=chosen[which],
        blocks=blocks,
    )


def block_verdict(
    edges: list[tuple[float, float, float, bool]], left: float, bottom: float, right: float, top: float
) -> str:
    """Listing of the block test: (a, b, c, owns tie) of the three edges, centres of the corner pixels."""
    all_inside = True
    for a, b, c, owns_tie in edges:
        x = right if a > 0 else left
        y = top if b > 0 else bottom
        high = a * x + (b * y + c)  #: high
        x = left if a > 0 else right
        y = bottom if b > 0 else top
        low = a * x + (b * y + c)  #: low
        if not (high > 0 or (high == 0 and owns_tie)):
            return "outside"  #: outside
        if not (low > 0 or (low == 0 and owns_tie)):
            all_inside = False
    return "inside" if all_inside else "split"  #: verdict


def pixels_of_block(columns: range, rows: range) -> list[tuple[int, int]]:
    """Listing of a block inside all edges: its pixels, none of which is tested."""
    pixels = []
    for row in rows:
        for column in columns:
            pixels.append((column, row))  #: draw
    return pixels
