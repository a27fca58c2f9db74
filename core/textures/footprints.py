"""How much of a texture a pixel sees: the slopes of u and v, and the exact mean over a footprint.

The slopes du/dx, dv/dx, du/dy and dv/dy are those of the interpolated functions at the pixel's centre, computed
from the triangle's planes: a function of the triangle and the pixel and nothing else. Graphics processors take
differences between the pixels of a 2 x 2 quad instead, which cost next to nothing there, are the same for all four
pixels, and differ from the slopes at a centre by the curvature over half a pixel.

References
----------
J. P. Ewins et al., *MIP-map level selection for texture mapping*, IEEE TVCG 4 (4), 1998.

Nothing is known of it but its values. So its slopes are those of the method that it stands for, plus what its values
differ from the method's half a pixel to each side. One that gives the method's values has its slopes, bit for bit.

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

from dataclasses import dataclass

import numpy as np

from core.interpolation.interpolation import Interpolator, Planes, ValueRule, numerators
from core.methods import table
from core.records.arrays import Floats, Integers, checked
from core.records.primitives import CornerValues, interpolation_form
from core.scene import Texture
from core.textures.look_up import wrap_period

# How texture coordinates change from pixel to pixel: the slopes that say how much of a texture a pixel
# sees.


BLOCK = 8192
"""Fragments that are looked at once, so that their numbers stay in the processor's cache."""


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def uv_slopes(
    planes: Planes,
    values: CornerValues,
    primitive: Integers,
    x: Floats,
    y: Floats,
    uv: Floats,
    interpolation: str,
) -> Floats:
    """Return how u and v change from pixel to pixel.

    Parameters
    ----------
    planes : Planes
        Of P primitives.
    values : CornerValues
        At their corners, ``uv`` among them.
    primitive : (F,) int64 array
    x, y : (F,) float64 arrays
        Pixel centres in the window.
    uv : (F, 2) float64 array
        Texture coordinates there.
    interpolation : str
        Name of a method of the family.

    Returns
    -------
    (4, F) float64
        du/dx, dv/dx, du/dy, dv/dy; not finite where 1/w is 0.

    Notes
    -----
    With weights n_k / n, du/dx is the sum of a_k (u_k - u) over n: each corner draws u towards its own. Affine
    weights are n_k w_k over their sum. ``flat`` changes nowhere. ``affine-n`` takes the slopes of the
    perspective-correct function that it stands for.
    """
    slopes = np.zeros((4, len(primitive)))
    if interpolation_form(interpolation) == "flat":
        return slopes
    columns = values.rows[:, values.layout["uv"]].T.copy()
    for start in range(0, len(primitive), BLOCK):
        part = slice(start, start + BLOCK)
        of = primitive[part]
        across, up, n = slope_numerators(planes, of, x[part], y[part], interpolation)
        total = n[0] + n[1] + n[2]
        corner = [values.index[k].take(of) for k in range(3)]
        for axis in range(2):
            draw = [columns[axis].take(corner[k]) - uv[part, axis] for k in range(3)]
            for first, rise in ((0, across), (2, up)):
                slopes[first + axis, part] = (
                    rise[0] * draw[0] + rise[1] * draw[1] + rise[2] * draw[2]
                ) / total
    return slopes


def slope_numerators(
    planes: Planes, primitive: Integers, x: Floats, y: Floats, interpolation: str
) -> tuple[list[Floats], list[Floats], list[Floats]]:
    """Return the changes to the right and up, and the values, of the three numerators of the weights, (F,) each."""
    n = list(numerators(planes, primitive, x, y))
    across, up = ([rise[:, k].take(primitive) for k in range(3)] for rise in (planes.a, planes.b))
    if interpolation_form(interpolation) == "affine":
        w = [planes.w[:, k].take(primitive) for k in range(3)]
        n, across, up = ([values[k] * w[k] for k in range(3)] for values in (n, across, up))
    return across, up, n


def slopes_at(a: Floats, b: Floats, n: Floats, u: float, v: float, us: Floats, vs: Floats) -> list[float]:
    """Listing of the slopes: changes and values of the three numerators (3,) each, and u, v at the corners (3,)."""
    total = n[0] + n[1] + n[2]
    du = [us[k] - u for k in range(3)]
    dv = [vs[k] - v for k in range(3)]
    slopes = []
    for rise, draw in ((a, du), (a, dv), (b, du), (b, dv)):
        slopes.append((rise[0] * draw[0] + rise[1] * draw[1] + rise[2] * draw[2]) / total)  #: slopes
    return slopes


def slopes_of_one_value() -> list[float]:
    """Listing of the slopes where a triangle has the value of one corner."""
    slopes = [0.0, 0.0, 0.0, 0.0]  #: slopes
    return slopes


# How texture coordinates change from pixel to pixel where an edited listing interpolates.


SIDES = ((0.5, 0.0), (-0.5, 0.0), (0.0, 0.5), (0.0, -0.5))
"""Half a pixel to the right, left, up and down."""


@dataclass(frozen=True, eq=False)
class EditedSlopes:
    """Slopes of u and v of F fragments, and what they are made from."""

    of_method: Floats
    """(4, F) float64, du/dx, dv/dx, du/dy and dv/dy of the method's own u and v."""
    apart: Floats
    """(4, 2, F) float64, u and v of the rule less those of the method, half a pixel to the right, left, up and down."""

    @property
    def slopes(self) -> Floats:
        """(4, F) float64, du/dx, dv/dx, du/dy, dv/dy."""
        right, left, up, down = self.apart
        with np.errstate(invalid="ignore"):
            found: Floats = self.of_method + np.concatenate([right - left, up - down])
        return found


def edited_slopes(
    rule: ValueRule,
    planes: Planes,
    values: CornerValues,
    primitive: Integers,
    x: Floats,
    y: Floats,
    interpolation: str,
    provoking: int,
    interval: int,
) -> EditedSlopes:
    """Return the slopes of fragments (F,) at window positions; see `core.textures.footprints.uv_slopes`.

    ``interpolation`` is the method that the rule stands for; the last two are those of an `Interpolator`.
    """
    uv = CornerValues(values.rows[:, values.layout["uv"]], {"uv": slice(0, 2)}, values.index)
    method = table.get("interpolation", interpolation).function
    ours, right = (Interpolator(planes, uv, of, provoking, interval) for of in (rule, method))
    with np.errstate(invalid="ignore"):
        apart = [
            (ours.values(primitive, x + dx, y + dy) - right.values(primitive, x + dx, y + dy)).T
            for dx, dy in SIDES
        ]
    own = right.values(primitive, x, y)
    return EditedSlopes(uv_slopes(planes, uv, primitive, x, y, own, interpolation), np.stack(apart))


def slopes_of_edit(of_method: Floats, right: Floats, left: Floats, up: Floats, down: Floats) -> list[float]:
    """Listing of the slopes of an edited listing: those of the method (4,), and how far u and v are apart (2,) each."""
    apart = [right[0] - left[0], right[1] - left[1], up[0] - down[0], up[1] - down[1]]
    slopes = [of_method[k] + apart[k] for k in range(4)]  #: slopes
    return slopes


# What a pixel should show of a texture: the mean over its footprint, exactly. Texture filters are judged by
# it.


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
    edges = [np.arange(len(start)), np.arange(len(start))]
    parameters = [np.zeros(len(start)), np.ones(len(start))]
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
