"""How fast a value changes from pixel to pixel along the lines of a wireframe."""

import numpy as np

from core.raster.lines.wireframe import LineFragments, Outlines, inverse_w_parts, values_at_ends
from core.records.arrays import Floats
from core.records.primitives import interpolation_form


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def line_slopes(
    outlines: Outlines, varyings: Floats, fragments: LineFragments, center: float, interpolation: str
) -> Floats:
    """Return the changes of varyings (P, 3, K) of fragments (F,) with a pixel to the right and with one up.

    Parameters are those of ``core.raster.lines.wireframe.interpolate_outlines``.

    Returns
    -------
    (2, K, F) float64
        0 across the major axis: a line is as wide as its pixel. Beyond the ends, and of a segment that is a point,
        as at the end.

    Notes
    -----
    With t from 0 to 1 along the segment in the window and w at the ends, the share of the second end is
    s = (t / w1) / (1/w), and ds/dt = 1 / (w0 w1 (1/w)^2); affine interpolation has s = t.
    """
    segment = fragments.segment
    length = outlines.window[:, 1] - outlines.window[:, 0]
    is_steep = np.abs(length[:, 1]) > np.abs(length[:, 0])
    whole = np.where(is_steep, length[:, 1], length[:, 0])
    per_pixel = np.where(whole == 0, 0.0, 1 / whole).take(segment)
    if interpolation_form(interpolation) != "affine":
        start, end = inverse_w_parts(outlines, fragments, center)
        total = start + end
        w0, w1 = outlines.w.T
        per_pixel = per_pixel / (w0.take(segment) * w1.take(segment) * (total * total))
    at_ends = values_at_ends(outlines, varyings, interpolation)
    change = (at_ends[:, 1] - at_ends[:, 0]).take(segment, axis=0).T * per_pixel
    steep = is_steep.take(segment)
    return np.stack([np.where(steep, 0.0, change), np.where(steep, change, 0.0)])


def line_slopes_at(
    t: float, w0: float, w1: float, length: float, first: Floats, second: Floats
) -> tuple[float, Floats]:
    """Listing of the slope along a segment of ``length`` pixels between two ends with their values (K,)."""
    total = (1 - t) / w0 + t / w1
    per_pixel = 1 / length / (w0 * w1 * (total * total))
    slopes = (second - first) * per_pixel  #: slopes
    return total, slopes


def affine_line_slopes_at(length: float, first: Floats, second: Floats) -> Floats:
    """Listing of the slope along a segment without perspective: (K,) per pixel."""
    slopes = (second - first) * (1 / length)  #: slopes
    return slopes
