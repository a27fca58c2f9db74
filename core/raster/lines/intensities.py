"""Fragments of lines with intensities: their alpha, which of them the depth buffer keeps, and how their segments run.

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

from core.raster.coverage import Fragments
from core.raster.lines.wireframe import LineFragments, Outlines
from core.records.arrays import Flags, Floats

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
