"""Does every fragment pass the depth test over a cleared buffer? Then a single layer needs no depth at all.

A fragment as far as the far plane does not: it is not nearer than what the buffer was cleared to. Neither does one
whose depth, extrapolated from the unsnapped plane to a pixel that only the snapped triangle has, gets there.
"""

import numpy as np

from core.coverage.snapping import SUBPIXELS, place_corners
from core.depth.depth import DepthFormat
from core.depth.fixed_depth import SLOPE_LIMIT
from core.interpolation.interpolation import set_up_planes, value_plane
from core.records.arrays import Flags, Floats, Integers
from core.stages.geometry import Geometry

FARTHEST = 1 - 2.0**-20
"""Window depth that float32 and fixed point still tell from the far plane, rounding of their planes included."""
THIN = 2.0**-4
"""Pixels. A wider triangle is many times wider than the 2^-9 that a corner is moved by."""
SNAPPING = 1 / SUBPIXELS
"""Pixels that snapping moves a point along an axis, at most, with room to spare."""
ROUNDING = 2.0**-48
"""Rounding of a plane through corners at x and y, as a part of x y over twice the area, with room to spare."""


def all_pass_depth_test(geometry: Geometry, depth_format: DepthFormat) -> bool:
    """Return whether nothing fails the test against the cleared buffer; ``False`` may also mean that it is not known.

    Parameters
    ----------
    geometry : Geometry
        All corners projected, all triangles between the near and the far plane.
    """
    if not geometry.drawing.uses_depth_test:
        return True
    if not depth_format.quantity.is_window_depth:
        return False
    # Whole numbers tell the last half of a step from the far plane no more: keep a whole one away.
    limit = FARTHEST if depth_format.scale == 1 else min(FARTHEST, 1 - 1 / depth_format.scale)
    farthest = geometry.depth.max(axis=0)
    if farthest.max(initial=0.0) >= limit:
        return False
    difference = farthest - geometry.depth.min(axis=0)
    if depth_format.is_planar and _all_linear(geometry, difference):
        return True  # planes through the snapped corners do not leave the corners' depths
    # In a triangle that is not thin, snapping moves the depth by less than it differs between the corners.
    doubtful = np.flatnonzero(is_thin(geometry) | (farthest + difference >= limit))
    return bool((farthest.take(doubtful) + _extrapolated(geometry, doubtful) < limit).all())


def _all_linear(geometry: Geometry, difference: Floats) -> bool:
    """Return whether every triangle certainly has an integer plane; corners differ in depth by ``difference`` (P,)."""
    reach = max(
        float(np.abs(window[1:] - window[0]).max(initial=0))
        for window in (geometry.window_x, geometry.window_y)
    )
    steepest = 2 * reach * float(difference.max(initial=0))
    return steepest <= SLOPE_LIMIT * float(np.abs(geometry.doubled_area).min(initial=np.inf))


def is_thin(geometry: Geometry) -> Flags:
    """Return (P,) bool."""
    x, y = geometry.window_x, geometry.window_y
    length = np.maximum(x.max(axis=0) - x.min(axis=0), y.max(axis=0) - y.min(axis=0))
    return np.asarray(np.abs(geometry.doubled_area) <= THIN * length)


def _extrapolated(geometry: Geometry, chosen: Integers) -> Floats:
    """Return how far (C,) snapping and rounding may take the depth of ``chosen`` triangles from that of the corners."""
    clip = geometry.primitives.clip_of(chosen)
    corners = place_corners(clip, geometry.vertices.size, geometry.settings.coverage)
    planes = set_up_planes(corners.homogeneous)
    across, up, _ = value_plane(planes, (clip[..., 2] + clip[..., 3]) / 2)
    reach = np.abs(corners.decided).max(axis=1, initial=0.0).prod(axis=1)
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        unsnapped_area = np.abs(planes.determinant) / planes.w.prod(axis=1)
        return np.asarray((np.abs(across) + np.abs(up)) * SNAPPING + ROUNDING * reach / unsnapped_area)
