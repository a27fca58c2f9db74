"""How far light in float32 may be from that of ``render``, in bytes.

A normal that is off by an angle e moves the cosine by e at most. The highlight cos^n falls fastest where its angle has
the tangent 1 / sqrt(n - 1): by less than sqrt(n) e. In linear bytes that is 255 times as much. sRGB is steep where it
is dark, and a light that is dark changes little: with f the encoding, x f'(x) is at most `SHARE` x^(5/12), so the
diffuse part A D (albedo, light) moves by (A D)^(5/12) `SHARE` e / D, and the highlight S by S^(5/12) `SHARE` n tan e,
whose greatest value is that at cos^(5n/12). The encoding is concave: what the parts are off by in the dark they are
never off by more in a sum.
"""

from math import sqrt

import numpy as np

from core.fast_path.lit.corner_places import CornerPlaces
from core.fast_path.lit.pixel_light import PixelLight
from core.fast_path.lit.planes import rounding
from core.fast_path.lit.vertex_facts import ALIKE
from core.framebuffer.display import SRGB_EXPONENT, SRGB_LIMIT, SRGB_SLOPE

STEEPEST = 255 * SRGB_SLOPE
"""Bytes that sRGB rises by per unit of light, at most."""
POWER = 1 / SRGB_EXPONENT
SHARE = STEEPEST * SRGB_LIMIT ** (1 - POWER)
"""x f'(x) / x^(1/2.4) is at most this: the value where the straight beginning of sRGB ends."""
SINGLE = 2.0**-20
"""Unit vectors in float32, and the products of two, are rounded by less."""
TABLE = 0.25
"""Bytes that the table of levels and the sums in float32 may be off."""


def normal_error(places: CornerPlaces) -> float:
    """Return the greatest angle, in radians, that an interpolated normal may be turned by, of P triangles (P,).

    Notes
    -----
    Doubtful triangles have no such bound. The components at the corners differ by 2 at most, and the shortest
    interpolated normal has length sqrt((1 + 2 ALIKE) / 3) times the least w over the greatest. `SINGLE` is what float32
    adds.
    """
    turn = rounding(places, np.full(len(places.is_doubtful), 4 * sqrt(3)))
    turn *= places.w.max(axis=0) / places.w.min(axis=0)
    # Of one triangle, so that what holds for all bands of a picture holds for the picture.
    return float(turn.max(initial=0)) / sqrt((1 + 2 * ALIKE) / 3) + SINGLE


def light_error(turn: float, light: PixelLight, brightest: float, encoding: str) -> float:
    """Return how many bytes a lit pixel may be off before rounding.

    Parameters
    ----------
    turn : float
        Angle that normals are off, from `normal_error`.
    brightest : float
        Greatest albedo there is.
    """
    material, strengths = light.material, [max(color) for _, color in light.lights]
    diffuse = material.diffuse * turn * sum(strengths)
    error = _diffuse_bytes(diffuse, material.ambient, brightest, encoding)
    for strength in strengths:
        error += _highlight_bytes(turn, material.specular * strength, material.shininess, encoding)
    return error + TABLE


def _diffuse_bytes(change: float, ambient: float, brightest: float, encoding: str) -> float:
    """Return how many bytes a ``change`` of diffuse light makes where it is at least ``ambient``."""
    if encoding == "linear":
        return 255 * brightest * change
    most = STEEPEST * brightest * change
    return min(most, SHARE * brightest**POWER * ambient ** (POWER - 1) * change) if ambient > 0 else most


def _highlight_bytes(turn: float, strength: float, exponent: float, encoding: str) -> float:
    """Return how many bytes a highlight of so much light changes by if its angle changes by ``turn``."""
    if strength == 0:
        return 0.0
    # A root of the cosine is infinitely steep at a right angle.
    fastest = np.sqrt(exponent) if exponent >= 1 else np.inf
    change = turn * fastest + SINGLE * exponent
    if encoding == "linear":
        return float(255 * strength * change)
    most = STEEPEST * strength * change
    damped = POWER * exponent
    if damped >= 1:
        relative = exponent * (turn / np.sqrt(damped) + SINGLE)
        most = min(most, SHARE * strength**POWER * relative)
    return float(most)
