"""The binary logarithm from a few sums and products: the same bits in arrays of any length, and in the listing.

A library's ``log2`` may round an element in the vector part of an array otherwise than one in its rest.
"""

from math import frexp, ldexp

import numpy as np

from core.records.arrays import Floats

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
