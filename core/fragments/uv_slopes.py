"""How texture coordinates change from pixel to pixel: the slopes that say how much of a texture a pixel sees.

The slopes du/dx, dv/dx, du/dy and dv/dy are those of the interpolated functions at the pixel's centre, computed
from the triangle's planes: a function of the triangle and the pixel and nothing else. Graphics processors take
differences between the pixels of a 2 x 2 quad instead, which cost next to nothing there, are the same for all four
pixels, and differ from the slopes at a centre by the curvature over half a pixel.

References
----------
J. P. Ewins et al., *MIP-map level selection for texture mapping*, IEEE TVCG 4 (4), 1998.
"""

import numpy as np

from core.fragments.interpolation import Planes, numerators
from core.records.arrays import Floats, Integers
from core.records.primitives import CornerValues, interpolation_form

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
