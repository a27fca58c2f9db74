"""Depth as games and graphics cards keep it: whole numbers of 24 and 16 bits, reversed, logarithmic.

A library's ``log2`` may round an element in the vector part of an array otherwise than one in its rest.

All of them are pure functions of triangle and pixel, and none moves the near or the far plane: what lies between these
is decided on the window depth z, whatever is stored.

References
----------
OpenGL 4.6, 2.3.5 (fixed-point data) and 8.5.3 (DEPTH_COMPONENT24, DEPTH_COMPONENT16).
E. Lapidous, G. Jiao, *Optimal depth buffer for low-cost graphics hardware*, 1999 (reversed z in floating point).
N. Reed, *Depth precision visualized*, 2015.
B. Kemen (Outerra), *Logarithmic depth buffer*, 2009, and *Maximizing depth buffer range and precision*, 2012.
"""

from functools import partial
from math import frexp, ldexp

import numpy as np

from core.depth.depth import WINDOW_DEPTH, DepthFormat, DepthQuantity, as_float32
from core.methods import method
from core.records.arrays import Flags, Floats, Singles

# The binary logarithm from a few sums and products: the same bits in arrays of any length, and in the
# listing.


SQUARE_ROOT = 0.7071067811865476
"""Mantissas are taken from here to the square root of 2, where the series is shortest."""
SERIES = tuple(2 / (2 * k + 1) for k in range(12))
"""Coefficients of ln m = s (2 + 2/3 s^2 + 2/5 s^4 + ...) with s = (m - 1)/(m + 1), at most 0.172 in size."""
PER_OCTAVE = 1.4426950408889634
"""1 / ln 2."""


def log2(value: Floats) -> Floats:
    """Return the binary logarithms of positive numbers (F,) float64, to a few units of the last place.

    References
    ----------
    M. Abramowitz, I. Stegun, *Handbook of mathematical functions*, 4.1.27, 1964.
    """
    mantissa, exponent = np.frexp(value)
    is_small = mantissa < SQUARE_ROOT
    mantissa = np.where(is_small, 2 * mantissa, mantissa)
    s = (mantissa - 1) / (mantissa + 1)
    square = s * s
    total = np.zeros_like(s)
    for coefficient in reversed(SERIES):
        total = total * square + coefficient
    return np.asarray((exponent - is_small) + PER_OCTAVE * (s * total))


def log2_of(value: float) -> float:
    """Listing of `log2` for one positive number."""
    mantissa, exponent = frexp(value)
    if mantissa < SQUARE_ROOT:
        mantissa, exponent = ldexp(mantissa, 1), exponent - 1
    s = (mantissa - 1) / (mantissa + 1)
    total = 0.0
    for coefficient in reversed(SERIES):
        total = total * (s * s) + coefficient
    return exponent + PER_OCTAVE * (s * total)


# Depth as games and graphics cards keep it: whole numbers of 24 and 16 bits, reversed, and logarithmic.


NEAREST_W, FARTHEST_W = 2.0**-16, 2.0**16
"""What the logarithm counts from and to where there is no camera: triangles given in clip space."""


def as_unsigned(depth: Floats, steps: float) -> Singles:
    """Round depths (F,) from 0 to 1 to whole numbers from 0 to ``steps``, half to even; float32 holds them exactly."""
    return as_float32(np.rint(depth * steps))


def as_share(value: Floats) -> Singles:
    """Limit values (F,) to 0 to 1, and round them to float32."""
    return as_float32(np.minimum(np.maximum(value, 0.0), 1.0))


def unsigned_depth(z: float, steps: float) -> float:
    """Listing of a depth kept in whole numbers."""
    return float(round(z * steps))  #: round


def share_of_depth(value: float) -> np.float32:
    """Listing of a depth from 0 to 1 kept as a float32."""
    limited = min(max(value, 0.0), 1.0)
    return np.float32(limited)  #: round


def unsigned_format(bits: int) -> DepthFormat:
    """Return the format that keeps z as an unsigned normalized integer."""
    steps = 2.0**bits - 1
    return DepthFormat(
        WINDOW_DEPTH,
        f"Window depth z in steps of 1/{int(steps):,}, all of them where cleared: smaller is nearer.",
        steps,
        False,
        partial(as_unsigned, steps=steps),
        scale=steps,
        unit="steps",
    )


@method(
    "depth",
    "z-24",
    "z in 24 bits",
    source="OpenGL 4.6, DEPTH_COMPONENT24: round(z (2^24 - 1)), half to even",
    exact_for="depth order, to 2^-24 of z, the same at every z",
    breaks_where="surfaces far from the eye: z crowds towards 1, and most of the steps lie near the near plane",
    listing=unsigned_depth,
)
def z_24() -> DepthFormat:
    """Store the window depth as a whole number from 0 to 2^24 - 1."""
    return unsigned_format(24)


@method(
    "depth",
    "z-16",
    "z in 16 bits",
    source="OpenGL 4.6, DEPTH_COMPONENT16: round(z (2^16 - 1)), half to even",
    exact_for="depth order, to 2^-16 of z, the same at every z",
    breaks_where="surfaces close to each other, already at a few hundred times the near distance",
    listing=unsigned_depth,
)
def z_16() -> DepthFormat:
    """Store the window depth as a whole number from 0 to 2^16 - 1."""
    return unsigned_format(16)


def reversed_depth(a: float, b: float, c: float, x: float, y: float) -> float:
    """Listing of the reversed depth at a pixel: a plane over the window through the corners' own, 1 near and 0 far."""
    return a * x + (b * y + c)  #: value


def reversed_depth_along(t: float, start: float, end: float) -> float:
    """Listing of the reversed depth along an outline."""
    return (1 - t) * start + t * end  #: value


@method(
    "depth",
    "reversed-z",
    "Reversed z, float32",
    source="Lapidous and Jiao 1999; Reed, Depth precision visualized, 2015",
    exact_for="depth order, to 2^-24 of the distance, the same at every distance",
    breaks_where="cameras without perspective, and clip positions with rounded z: no better than z-float32",
    listing=share_of_depth,
)
def reversed_z() -> DepthFormat:
    """Store a depth that is 1 at the near plane and 0 at the far plane; larger is nearer.

    Notes
    -----
    The small numbers of far surfaces are where float32 is finest. That is worth something only if they come from a
    projection of their own: 1 - z has lost them already (``core.transform.matrices``).
    """
    quantity = DepthQuantity(
        "reversed-z", "reversed-z", listing=reversed_depth, line_listing=reversed_depth_along
    )
    description = "Reversed z as float32, from 1 (near) to 0 (far and cleared): larger is nearer."
    return DepthFormat(quantity, description, 0.0, True, as_share)


def logarithmic_depth(inverse_w: Floats, near: float, far: float) -> Floats:
    """Return log2(w/near) / log2(far/near) of 1/w (F,) float64; 1 where 1/w is not positive."""
    is_in_front: Flags = inverse_w > 0
    with np.errstate(over="ignore"):
        ratio = 1 / (np.where(is_in_front, inverse_w, 1.0) * near)
    # So near to the eye that it overflows is before every near plane, so far that it is infinite behind every far one.
    octaves = log2(np.minimum(np.maximum(ratio, np.finfo(float).tiny), np.finfo(float).max))
    return np.where(is_in_front, octaves / log2_of(far / near), 1.0)


def logarithm_of_w(inverse_w: float, near: float, far: float) -> float:
    """Listing of the logarithmic depth at a pixel."""
    if not inverse_w > 0:
        return 1.0  #: behind
    ratio = 1 / (inverse_w * near)
    return log2_of(ratio) / log2_of(far / near)  #: value


@method(
    "depth",
    "logarithmic",
    "Logarithm of w, float32",
    source="Kemen (Outerra), Logarithmic depth buffer, 2009: log2(w/near) / log2(far/near), here at every pixel",
    exact_for="depth order, to 2^-24 log2(far/near) octaves of the distance, the same at every distance",
    breaks_where="orthographic cameras: w is constant. Clip positions with w below 2^-16 or above 2^16",
    needs=("perspective",),
    listing=share_of_depth,
)
def logarithmic() -> DepthFormat:
    """Store the logarithm of the distance: 0 at the near plane, 1 at the far plane; smaller is nearer.

    Notes
    -----
    Where 1/w is not positive (a pixel that only the snapped corners cover) nothing is seen, as with 1/w.
    """
    quantity = DepthQuantity("logarithm", "inverse-w", logarithmic_depth, logarithm_of_w)
    description = "log2(w / near) / log2(far / near), float32; 1 where cleared: smaller is nearer."
    return DepthFormat(quantity, description, 1.0, False, as_share)
