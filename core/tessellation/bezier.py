"""De Casteljau's scheme: points of Bezier curves and patches by mixing neighbours, level by level.

References
----------
P. de Casteljau, *Outillages méthodes calcul*, Citroën, 1959. G. Farin, *Curves and Surfaces for CAGD*, 1988.
"""

import numpy as np

from core.records.arrays import Floats, Integers


def de_casteljau(points: list[float], step: int, steps: int) -> float:
    """Listing of one coordinate of a curve's point at t = step / steps, from that of its control points."""
    s, t = (steps - step) / steps, step / steps  #: parameter
    while len(points) > 1:
        mixtures = []
        for k in range(len(points) - 1):
            mixtures.append(s * points[k] + t * points[k + 1])  #: mix
        points = mixtures
    return points[0]  #: emit


def normal_of(u: Floats, v: Floats) -> tuple[float, float, float]:
    """Listing of the normal of a surface, from its derivatives in both directions."""
    x = u[1] * v[2] - u[2] * v[1]  #: normal_x
    y = u[2] * v[0] - u[0] * v[2]  #: normal_y
    z = u[0] * v[1] - u[1] * v[0]  #: normal_z
    return x, y, z


Shares = tuple[Floats, Floats]
"""1 - t and t of points (...,)."""


def shares(step: Integers, steps: Integers) -> Shares:
    """Return 1 - t and t (...,) of t = step / steps: each by one division.

    So a curve that is run backwards has the same points.
    """
    return (steps - step) / steps, step / steps


def of_each(of: Shares) -> Shares:
    """Return the same shares (..., 1) for several curves of each point."""
    return of[0][..., None], of[1][..., None]


def mix(s: Floats, t: Floats, points: Floats) -> Floats:
    """Return the next level (..., n - 1, D): the mixture of each two neighbours of points (..., n, D)."""
    return np.asarray(s[..., None, None] * points[..., :-1, :] + t[..., None, None] * points[..., 1:, :])


def levels(s: Floats, t: Floats, points: Floats) -> list[Floats]:
    """Return all levels of the scheme: the control points (..., n, D), n - 1 mixtures, and so on to one point.

    Notes
    -----
    At t = 0 and t = 1 the mixtures are an end itself, not one that was rounded.
    """
    found = [points]
    while found[-1].shape[-2] > 1:
        found.append(mix(s, t, found[-1]))
    return found


def halves(control: Floats) -> tuple[Floats, Floats]:
    """Return the control points (..., n, D) of both halves of curves: the two sides of the scheme at t = 1/2."""
    half = np.full(control.shape[:-2], 0.5)
    found = levels(half, half, control)
    first = np.stack([level[..., 0, :] for level in found], axis=-2)
    second = np.stack([level[..., -1, :] for level in found[::-1]], axis=-2)
    return first, second


def patch_nets(control: Floats, down: Shares, across: Shares) -> Floats:
    """Return the last two by two points (..., 2, 2, 3) of the scheme of patches, which give both derivatives.

    Parameters
    ----------
    control : (..., 4, 4, 3) float64
    down, across : pairs of (...,) float64
        Of the first index, and of the second.
    """
    # Every row by itself, then the two columns that are left.
    rows = mix(*of_each(across), mix(*of_each(across), control))
    columns = mix(*of_each(down), mix(*of_each(down), np.swapaxes(rows, -3, -2)))
    return np.swapaxes(columns, -3, -2)


def patch_points(net: Floats, down: Shares, across: Shares) -> Floats:
    """Return points (..., 3) of patches from their last nets (..., 2, 2, 3): the columns first, then the row."""
    ends = mix(*of_each(down), np.swapaxes(net, -3, -2))[..., 0, :]
    found: Floats = mix(*across, ends)[..., 0, :]
    return found


def patch_derivatives(net: Floats, down: Shares, across: Shares) -> tuple[Floats, Floats]:
    """Return the derivatives (..., 3) by the first index and by the second, from last nets (..., 2, 2, 3)."""
    by_first = 3 * mix(*across, net[..., 1, :, :] - net[..., 0, :, :])[..., 0, :]
    by_second = 3 * mix(*down, net[..., :, 1, :] - net[..., :, 0, :])[..., 0, :]
    return by_first, by_second


def cross(one: Floats, other: Floats) -> Floats:
    """Return cross products (..., 3), as `normal_of` has them."""
    (a, b, c), (d, e, f) = (np.moveaxis(each, -1, 0) for each in (one, other))
    return np.stack([b * f - c * e, c * d - a * f, a * e - b * d], axis=-1)
