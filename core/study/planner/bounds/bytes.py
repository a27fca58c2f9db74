"""From errors of linear light to errors of the bytes on the screen.

The sRGB curve s rises and its slope falls: an error e on top of a light c is worst where c is darkest, s(c + e) - s(c).
A pixel that mixes several triangles is never worse than the worst of them: the lights c and errors e with
s(c + e) - s(c) <= t are those below e = s^-1(s(c) + t) - c, and for a power below 1 that is a concave function of c.
A byte is rounded, so bytes differ by less than the rounded-up difference of their values.
"""

import numpy as np

from core.framebuffer.display import srgb
from core.records.arrays import Floats


def byte_error(dark: Floats, error: Floats) -> Floats:
    """Return the largest change, in 1/255 of sRGB, when light of at least ``dark`` changes by ``error``.

    Parameters
    ----------
    dark, error : float64 arrays of one shape
        Linear light from 0; NaN and infinity count as no knowledge at all.

    Returns
    -------
    float64 array of that shape, 0 to 255
    """
    low = np.clip(np.nan_to_num(dark, nan=0.0), 0.0, 1.0)
    high = np.clip(low + np.nan_to_num(error, nan=np.inf, posinf=np.inf), 0.0, 1.0)
    return np.asarray(255 * (srgb(high) - srgb(low)))


def byte_width(low: Floats, high: Floats) -> Floats:
    """Return how far two lights between ``low`` and ``high`` can be apart, in 1/255 of sRGB; any shape, 0 to 255."""
    low = np.clip(np.nan_to_num(low, nan=0.0), 0.0, 1.0)
    high = np.clip(np.nan_to_num(high, nan=np.inf, posinf=np.inf), 0.0, 1.0)
    return np.asarray(255 * (srgb(high) - srgb(low)))


def times(first: Floats, second: Floats) -> Floats:
    """Return the product of bounds, arrays of any shape; nothing times the unknown is nothing."""
    with np.errstate(invalid="ignore"):
        return np.asarray(np.where((first == 0) | (second == 0), 0.0, first * second))
