"""What a pixel should show of a texture: the mean over its footprint, exactly. Texture filters are judged by it.

The footprint is a quadrilateral in the texture, and the texture is even over each texel. By Green's theorem the
integral of the colour over the quadrilateral is the integral of F dy around it, where F(x, y) is the integral of the
colour from 0 to x in the row of y: a sum over whole texels, known beforehand, and a part of one. Between two crossings
of texel borders F is linear along an edge, so its value in the middle of the piece times the piece's height is exact.
The cost grows with the length around the footprint, not with its area.

Error
-----
Only rounding: 2^-52 times the number of pieces and the columns that F sums over, below 1e-9 of the colour's range for
footprints of a texel's area and more. The mean is taken evenly over the footprint, as if the pixel were mapped there
by an affine map. Under perspective equal parts of the pixel do not cover equal parts of the footprint: the pixel's own
mean differs by at most (sqrt R - 1)/(sqrt R + 1) of the colour's range, where R is the cube of the ratio of the
greatest to the least 1/w in the pixel (the map's determinant goes with 1/w to the third).

References
----------
F. Crow, *Summed-area tables for texture mapping*, SIGGRAPH 1984.
P. Heckbert, *Fundamentals of texture mapping and image warping*, 1989, section 3.
"""

import numpy as np

from core.fragments.textures import wrap_period
from core.methods import table
from core.records.arrays import Floats, Integers, checked
from core.scene import Texture

PIECE_LIMIT = 1 << 16
"""Texel borders that the outline of one footprint may cross: beyond, it has no mean."""
_BATCH = 1 << 18
"""Pieces that are integrated in one go, about."""


def footprint_means(texture: Texture, corners: Floats, wrap: str = "repeat") -> Floats:
    """Return the mean colours of a texture over quadrilaterals.

    Parameters
    ----------
    corners : (F, 4, 2) float64 array
        x and y in texels, (0, 0) the lower left corner of the texture; in turn, either way round, not crossing.
    wrap : str
        What lies outside: a method of this family.

    Returns
    -------
    (F, C) float64
        In the channels of the texture. NaN where a corner is not finite, the area is 0, or the outline crosses more
        than ``PIECE_LIMIT`` borders of texels.

    Raises
    ------
    ValueError
        If ``corners`` is not (F, 4, 2), or the wrap is not in the table.
    """
    quads = checked("corners", corners, ("F", 4, 2), finite=False)
    plane = _Plane(texture, wrap)
    means = np.full((len(quads), texture.pixels.shape[2]), np.nan)
    finite = np.isfinite(quads).all(axis=(1, 2))
    with np.errstate(over="ignore", invalid="ignore"):
        crossings = np.abs(np.roll(quads, -1, axis=1) - quads).sum(axis=(1, 2)) + 12
    wanted = np.flatnonzero(finite & (crossings <= PIECE_LIMIT))
    batch = np.cumsum(crossings[wanted]) // _BATCH
    for part in np.split(wanted, np.flatnonzero(np.diff(batch)) + 1):
        means[part] = _means(plane, quads[part])
    return means


class _Plane:
    """A texture over the whole plane, and its integral along rows."""

    def __init__(self, texture: Texture, wrap: str) -> None:
        pixels = texture.pixels.astype(np.float64)
        period, wrapped = wrap_period(wrap), table.get("wrap", wrap).function
        if period > 1:
            rows, columns = (wrapped(np.arange(period * size), size) for size in pixels.shape[:2])
            pixels = pixels[rows][:, columns]
        self.pixels = pixels
        self.is_clamped = not period
        self.height, self.width = pixels.shape[:2]
        before = np.zeros((self.height, 1, pixels.shape[2]))
        self._sums = np.concatenate([before, np.cumsum(pixels, axis=1)], axis=1)

    def integral(self, x: Floats, row: Integers) -> Floats:
        """Return the integral of the colour from 0 to x (N,) along rows (N,): (N, C)."""
        if self.is_clamped:
            row = np.clip(row, 0, self.height - 1)
            inside = np.clip(x, 0, self.width)
            column = np.minimum(inside.astype(np.int64), self.width - 1)
            border = self.pixels[row, np.where(x < 0, 0, self.width - 1)]
            beyond = (x - inside)[:, None] * border
        else:
            row = row % self.height
            periods = np.floor(x / self.width)
            inside = x - periods * self.width
            column = np.clip(inside.astype(np.int64), 0, self.width - 1)
            beyond = periods[:, None] * self._sums[row, -1]
        part = (inside - column)[:, None] * self.pixels[row, column]
        return np.asarray(self._sums[row, column] + part + beyond)


def _means(plane: _Plane, quads: Floats) -> Floats:
    """Return the means (F, C) over quadrilaterals (F, 4, 2)."""
    if not plane.is_clamped:
        # Whole periods nearer, where sums are small.
        size = np.array([plane.width, plane.height])
        quads = quads - np.floor(quads[:, :1] / size) * size
    start, end = quads.reshape(-1, 2), np.roll(quads, -1, axis=1).reshape(-1, 2)
    edge, first, last = _pieces(start, end)
    way = (end - start)[edge]
    middle = start[edge] + (0.5 * (first + last))[:, None] * way
    height = (last - first) * way[:, 1]
    along = plane.integral(middle[:, 0], np.floor(middle[:, 1]).astype(np.int64)) * height[:, None]
    owner = edge // 4
    total = np.stack([np.bincount(owner, values, len(quads)) for values in along.T], axis=1)
    area = np.bincount(owner, middle[:, 0] * height, len(quads))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(area[:, None] == 0, np.nan, total / area[:, None]))


def _pieces(start: Floats, end: Floats) -> tuple[Integers, Floats, Floats]:
    """Cut edges from ``start`` to ``end`` (E, 2) at the borders of texels: edge and both parameters of each piece."""
    edges, parameters = (
        [np.arange(len(start)), np.arange(len(start))],
        [np.zeros(len(start)), np.ones(len(start))],
    )
    for axis in range(2):
        low, high = np.minimum(start[:, axis], end[:, axis]), np.maximum(start[:, axis], end[:, axis])
        border = np.floor(low) + 1
        count = np.maximum(np.ceil(high) - border, 0).astype(np.int64)
        edge = np.repeat(np.arange(len(start)), count)
        number = np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count)
        way = end[edge, axis] - start[edge, axis]
        edges.append(edge)
        parameters.append((border[edge] + number - start[edge, axis]) / way)
    edge, parameter = np.concatenate(edges), np.clip(np.concatenate(parameters), 0.0, 1.0)
    order = np.lexsort((parameter, edge))
    edge, parameter = edge[order], parameter[order]
    is_piece = edge[1:] == edge[:-1]
    return edge[1:][is_piece], parameter[:-1][is_piece], parameter[1:][is_piece]
