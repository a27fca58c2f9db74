"""Binning: the part of the raster that a triangle may touch, as a box and as blocks of n x n pixels.

References
----------
M. Zwicker, *Computergrafik*, lecture "Binning", Bern 2016: three cases, conservative block test, two levels.
N. Greene, *Hierarchical polygon tiling with coverage masks*, 1996.
"""

import numpy as np

from core.arrays import Integers
from core.raster.edge_functions import EdgeFunctions, edge_value
from core.raster.schedule import (
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


def bound(edges: EdgeFunctions, raster: Raster) -> Boxes:
    """Return the pixels whose centres lie in the bounding box of each triangle, by the lecture's three cases.

    Notes
    -----
    1. Every corner can be projected: its bounding box, limited to the raster. 2. No corner in front of the eye
    (all w <= 0): nothing. 3. Otherwise: the whole raster. A corner too far away to be snapped counts as
    not projected, so that case 1 stays exact.
    """
    corners = edges.corners
    first_column, first_row, end_column, end_row = raster.bounds
    case = np.where(corners.is_projected.all(axis=1), PROJECTED, MIXED)
    case[(corners.homogeneous[..., 2] <= 0).all(axis=1)] = BEHIND
    box = np.empty((4, len(edges)), np.int64)
    box[:] = np.array([first_column, first_row, end_column, end_row])[:, None]

    # Columns and rows whose centres lie between the least and the greatest corner, ends included.
    projected = case == PROJECTED
    positions = corners.decided[projected] - raster.center
    low, high = np.ceil(positions.min(axis=1)), np.floor(positions.max(axis=1)) + 1
    box[0, projected] = np.maximum(low[:, 0], first_column)
    box[1, projected] = np.maximum(low[:, 1], first_row)
    box[2, projected] = np.minimum(high[:, 0], end_column)
    box[3, projected] = np.minimum(high[:, 1], end_row)

    # Nothing to look at: behind the eye, no area, or between the pixel centres.
    empty = (case == BEHIND) | (edges.doubled_area == 0) | (box[2] <= box[0]) | (box[3] <= box[1])
    box[2:, empty] = box[:2, empty]
    return Boxes(case, *box)


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
    a, b, c = edges.a[triangle], edges.b[triangle], edges.c[triangle]
    left = (column + raster.center)[:, None]
    bottom = (row + raster.center)[:, None]
    right, top = left + (size - 1), bottom + (size - 1)
    low = edge_value(a, b, c, np.where(a > 0, left, right), np.where(b > 0, bottom, top))
    high = edge_value(a, b, c, np.where(a > 0, right, left), np.where(b > 0, top, bottom))
    owns_tie = edges.owns_tie[triangle]
    outside = (high < 0) | ((high == 0) & ~owns_tie)
    inside = (low > 0) | ((low == 0) & owns_tie)
    verdict = np.where(outside.any(axis=1), OUTSIDE, np.where(inside.all(axis=1), INSIDE, SPLIT))
    rejected_by = np.where(verdict == OUTSIDE, outside.argmax(axis=1), -1)
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

    # Blocks of a split node that lie in the raster.
    split = np.flatnonzero(verdict == SPLIT)
    first_column, first_row, end_column, end_row = raster.bounds
    place = np.arange(factor * factor)
    column = (coarse.column[split, None] + place % factor * size).ravel()
    row = (coarse.row[split, None] + place // factor * size).ravel()
    parent = np.repeat(split, factor * factor)
    exists = (
        (column < end_column) & (row < end_row) & (column + size > first_column) & (row + size > first_row)
    )
    column, row, parent = column[exists], row[exists], parent[exists]
    triangle = coarse.triangle[parent]
    low, high, fine_verdict, fine_rejected = classify(edges, raster, triangle, column, row, size)
    fine_verdict = np.where(fine_verdict == SPLIT, LEAF, fine_verdict)

    # Pre-order: a node stands before its blocks, so it moves on by the blocks of the nodes before it.
    children = np.bincount(parent, minlength=len(verdict))
    own_place = np.arange(len(verdict)) + np.cumsum(children) - children
    child_place = np.arange(len(parent)) + parent + 1
    order = np.argsort(np.concatenate([own_place, child_place]), kind="stable")

    def merge(of_coarse: np.ndarray, of_fine: np.ndarray) -> np.ndarray:
        return np.concatenate([of_coarse, of_fine])[order]

    return Blocks(
        merge(coarse.triangle, triangle),
        merge(coarse.column, column),
        merge(coarse.row, row),
        merge(coarse.size, np.full(len(parent), size)),
        merge(coarse.parent, own_place[parent]),
        merge(own_place + 1 + children, child_place + 1),
        merge(coarse.low, low),
        merge(coarse.high, high),
        merge(verdict, fine_verdict),
        merge(coarse.rejected_by, fine_rejected),
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
    coefficients: list[tuple[float, float, float, bool]], left: float, bottom: float, right: float, top: float
) -> str:
    """Listing of the block test: (a, b, c, owns tie) of the three edges, centres of the corner pixels."""
    all_inside = True
    for a, b, c, owns_tie in coefficients:
        high = a * (right if a > 0 else left) + (b * (top if b > 0 else bottom) + c)  #: high
        if high < 0 or (high == 0 and not owns_tie):  #: reject
            return "outside"  #: outside
        low = a * (left if a > 0 else right) + (b * (bottom if b > 0 else top) + c)  #: low
        if low < 0 or (low == 0 and not owns_tie):  #: accept
            all_inside = False
    return "inside" if all_inside else "split"  #: verdict
