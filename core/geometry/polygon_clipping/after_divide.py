"""Clipping after the division by w, as a naive program does: the sign of w is lost before anything is cut.

A corner with w < 0 is divided like any other: x/w and y/w have the wrong sign, so it comes out mirrored through the
eye, and the edge to it runs the other way around. With w = 0 there is no quotient: the triangle is left out. All
numbers are linear in NDC once they are divided by w, so 1/|w| and the values over |w| go along and are divided again
afterwards: while all w > 0 the result is right.

References
----------
J. Blinn, M. Newell, *Clipping using homogeneous coordinates*, 1978.
"""

from dataclasses import replace

import numpy as np

from core.geometry.polygon_clipping.sutherland_hodgman import Clipped, clip_chosen
from core.records.arrays import Flags, Floats
from core.records.primitives import Primitives


def clip_divided(primitives: Primitives, distances: Floats, planes: tuple[int, ...]) -> Clipped:
    """Divide what reaches through a plane or behind the eye by w, and clip it there.

    Parameters
    ----------
    distances : (P, 3, 6) float64, see ``core.geometry.culling.plane_distances``
    planes : indices of ``core.geometry.culling.PLANES``; none: only divide
    """
    is_crossing = (distances[:, :, list(planes)] < 0).any(axis=(1, 2))
    chosen = np.flatnonzero(is_crossing | (primitives.clip[..., 3] <= 0).any(axis=1))
    polygon, is_defined = divide_corners(primitives.clip[chosen], primitives.varyings[chosen])
    count = np.where(is_defined, 3, 0)
    clipped = clip_chosen(primitives, chosen, polygon, count, planes, True, multiply_back)
    return replace(clipped, is_divided=True)


def divide_corners(clip: Floats, varyings: Floats) -> tuple[Floats, Flags]:
    """Divide corners by w.

    Parameters
    ----------
    clip : (Q, 3, 4) float64
    varyings : (Q, 3, K) float64

    Returns
    -------
    polygon : (Q, 3, 5 + K) float64
        x/w, y/w, z/w, 1, then 1/|w| and the values over |w|; 0 where not defined.
    is_defined : (Q,) bool
        Everything is finite; not so where a w is 0, or too small to divide by.
    """
    w = clip[..., 3:]
    with np.errstate(all="ignore"):
        inverse = 1 / np.abs(w)
        polygon = np.concatenate([clip[..., :3] / w, np.ones_like(w), inverse, varyings * inverse], axis=2)
    is_defined = np.isfinite(polygon).all(axis=(1, 2)) & (inverse[..., 0] > 0).all(axis=1)
    polygon[~is_defined] = 0
    return polygon, is_defined


def multiply_back(corners: Floats) -> tuple[Floats, Floats]:
    """Return the clip positions (C, 3, 4), all with w > 0, and values of divided corners (C, 3, 5 + K)."""
    w = 1 / corners[..., 4:5]
    return corners[..., :4] * w, corners[..., 5:] * w


def divide_corner(x: float, y: float, z: float, w: float) -> tuple[float, float, float] | None:
    """Listing of the division of one corner: its place in NDC, or nothing."""
    if w == 0:
        return None  #: undefined
    ndc = x / w, y / w, z / w  #: divide
    return ndc  #: keep
