"""Fragments of a wireframe: how fast values change along its lines, and the alpha of lines with intensities.

The intensity scales the fragment's alpha, as OpenGL does with the coverage of smooth lines, and the fragment is blended
over what is there (`core.resolved`). Its depth is tested like any other, but stored only where the
intensity is at
least 1/2: a paler pixel shows mostly what is behind it, so it must not hide what is drawn there later. With the depth
stored of every pixel, lines that pass behind others would end in front of them, at a gap as wide as the pale pixels;
with none stored, lines behind would be drawn over those in front.

References
----------
OpenGL 4.6 (compatibility profile), "Line Antialiasing" and "Antialiasing Application".
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from core.coverage.fills import Fragments
from core.lines.wireframe import LineFragments, Outlines, inverse_w_parts, values_at_ends
from core.records.arrays import Flags, Floats
from core.records.primitives import interpolation_form

# How fast a value changes from pixel to pixel along the lines of a wireframe.


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def line_slopes(
    outlines: Outlines, varyings: Floats, fragments: LineFragments, center: float, interpolation: str
) -> Floats:
    """Return the changes of varyings (P, 3, K) of fragments (F,) with a pixel to the right and with one up.

    Parameters are those of ``core.lines.wireframe.interpolate_outlines``.

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


# Fragments of lines with intensities: their alpha, which of them the depth buffer keeps, and how their
# segments run.


WRITTEN_INTENSITY = 0.5
"""Least intensity with which a fragment is stored in the depth buffer: that of the pixel nearest to the line in its
column, where the line spans the whole column. A paler one shows mostly what is behind, so it hides nothing."""


def run_rightwards(outlines: Outlines) -> Outlines:
    """Return segments (L,) that all run from left to right, upright ones upwards.

    Notes
    -----
    So both triangles at an edge draw the same pixels, intensities and depths: what the first one stored, the
    second one does not pass, and no pixel of the edge is blended twice by rounding.
    """
    first, second = outlines.window[:, 0], outlines.window[:, 1]
    is_leftwards = (first[:, 0] > second[:, 0]) | (
        (first[:, 0] == second[:, 0]) & (first[:, 1] > second[:, 1])
    )

    def of_ends(values: Floats) -> Floats:
        swaps = is_leftwards.reshape(-1, *[1] * (values.ndim - 1))
        return np.where(swaps, values[:, ::-1], values)

    return replace(
        outlines,
        window=of_ends(outlines.window),
        drawn=of_ends(outlines.drawn),
        w=of_ends(outlines.w),
        depth=of_ends(outlines.depth),
        shares=of_ends(outlines.shares),
        window_shares=of_ends(outlines.window_shares),
    )


def intensities_of(fragments: Fragments) -> Floats | None:
    """Return the intensities (F,) of fragments, or ``None`` where they have none."""
    return fragments.intensity if isinstance(fragments, LineFragments) else None


def writes_depth(fragments: Fragments) -> Flags | None:
    """Return which fragments are stored if they pass the depth test, (F,) bool; ``None``: all."""
    intensity = intensities_of(fragments)
    return None if intensity is None else intensity >= WRITTEN_INTENSITY


def weigh_alpha(color: Floats, fragments: Fragments) -> Floats:
    """Return the colours (F, 4) float64 that are blended: alpha scaled by the intensities, if fragments have any."""
    intensity = intensities_of(fragments)
    if intensity is None:
        return color
    weighed = color.copy()
    weighed[:, 3] *= intensity
    return weighed


def weighed_color(color: Sequence[float], intensity: float) -> list[float]:
    """Listing of `weigh_alpha`: the colour that a line's fragment brings to blending."""
    red, green, blue, alpha = color
    alpha *= intensity  #: weigh
    return [red, green, blue, alpha]
