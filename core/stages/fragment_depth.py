"""The depth of fragments: window depth, whether it is in range, and what a depth method stores in its place.

It joins geometry, outlines and the formats of the depth buffer; picture, trace and history of a pixel ask it alike.
"""

import numpy as np

from core.fragments.interpolation import plane_value
from core.framebuffer.depth import DepthFormat, DepthQuantity, Stored, clamp_depth
from core.framebuffer.depth_formats import FARTHEST_W, NEAREST_W
from core.geometry.reversed_depth import reversed_clip_depth
from core.raster.coverage import Fragments
from core.raster.edges.snapping import SUBPIXELS
from core.raster.lines.drawing import interpolate_line
from core.raster.lines.wireframe import LineFragments, Outlines, inverse_w_parts, line_depth, line_parameter
from core.raster.pixel_runs import Raster
from core.records.arrays import Flags, Floats, Integers
from core.stages.geometry import Geometry


def fragment_depth(
    geometry: Geometry, fragments: Fragments, raster: Raster, depth_format: DepthFormat
) -> tuple[Floats, Flags, Stored]:
    """Return the window depth of fragments, whether it is in range, and what would be stored.

    Returns
    -------
    depth : (F,) float64, clamped where the triangle is in range as a whole
    keeps : (F,) bool, False too where 1/w is interpolated and shows a point behind the eye
    stored : (F,) of the format's ``stored_type``
    """
    if not isinstance(fragments, LineFragments):
        x, y = raster.centers(fragments.column, fragments.row)
        depth, keeps, stored = depth_at(geometry, fragments.primitive, x, y, depth_format)
        if depth_format.is_planar:
            fixed = geometry.fixed_planes
            on_plane = fixed.at(fragments.primitive, fragments.column, fragments.row)
            stored = np.where(fixed.is_linear.take(fragments.primitive), on_plane, stored)
        return depth, keeps, stored
    outlines = outlines_of(geometry)
    depth = line_depth(outlines, fragments, raster.center)
    depth, keeps = clamp_depth(depth, outlines.is_in_range.take(fragments.segment))
    plane = _plane_along(geometry, fragments, raster, depth_format.quantity, depth)
    return depth, _in_front(keeps, plane, depth_format), _stored(geometry, plane, depth_format)


def depth_at(
    geometry: Geometry, primitive: Integers, x: Floats, y: Floats, depth_format: DepthFormat
) -> tuple[Floats, Flags, Stored]:
    """Return depth, whether it is in range, and what would be stored, (F,) each, of primitives at window positions."""
    depth = plane_value(geometry.depth_plane, primitive, x, y)
    depth, keeps = clamp_depth(depth, geometry.is_in_range.take(primitive))
    plane = _plane_at(geometry, primitive, (x, y), depth_format.quantity, depth)
    return depth, _in_front(keeps, plane, depth_format), _stored(geometry, plane, depth_format)


def farthest_stored(geometry: Geometry, depth_format: DepthFormat) -> Stored:
    """Return a bound of what is stored of each primitive (P,) before the eye: none of its fragments is farther.

    Notes
    -----
    Fragments lie up to a step of snapping beyond the edges of the unsnapped triangle, whose plane has their depth. A
    fragment may be lost where this is not nearer than the cleared value.
    """
    quantity, clip = depth_format.quantity, geometry.primitives.clip
    if quantity.plane == "z":
        plane, at_corners = geometry.depth_plane, geometry.depth.T
    else:
        is_reversed, value = quantity.plane == "reversed-z", np.ones(clip.shape[:2])
        plane = geometry.reversed_plane if is_reversed else geometry.inverse_w_plane
        if is_reversed:
            value = reversed_clip_depth(clip[..., 2], clip[..., 3], geometry.vertices.view_range)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            at_corners = value / clip[..., 3]
    beyond = (np.abs(plane[0]) + np.abs(plane[1])) / SUBPIXELS
    if quantity.plane == "z":
        farthest = np.minimum(at_corners.max(axis=1) + beyond, 1.0)
    else:
        farthest = np.maximum(at_corners.min(axis=1) - beyond, 0.0)
    stored = _stored(geometry, farthest, depth_format)
    # On an integer plane every step along a row or a column is rounded.
    return np.add(stored, (1 + sum(geometry.vertices.size)) / 2) if depth_format.is_planar else stored


def fragment_quantity(
    geometry: Geometry, fragments: Fragments, raster: Raster, quantity: DepthQuantity, depth: Floats
) -> Floats:
    """Return what a depth method stores, (F,) float64, before it is limited and rounded; ``depth`` as it is tested."""
    if isinstance(fragments, LineFragments):
        plane = _plane_along(geometry, fragments, raster, quantity, depth)
    else:
        centers = raster.centers(fragments.column, fragments.row)
        plane = _plane_at(geometry, fragments.primitive, centers, quantity, depth)
    return _converted(geometry, plane, quantity)


def _plane_at(
    geometry: Geometry, primitive: Integers, at: tuple[Floats, Floats], quantity: DepthQuantity, depth: Floats
) -> Floats:
    """Return what is interpolated, (F,) float64, of primitives at window positions x and y (F,)."""
    if quantity.plane == "z":
        return depth
    plane = geometry.inverse_w_plane if quantity.plane == "inverse-w" else geometry.reversed_plane
    return plane_value(plane, primitive, *at)


def _plane_along(
    geometry: Geometry, fragments: LineFragments, raster: Raster, quantity: DepthQuantity, depth: Floats
) -> Floats:
    """Return what is interpolated, (F,) float64, of fragments of outlines."""
    if quantity.plane == "z":
        return depth
    along = fragment_inverse_w if quantity.plane == "inverse-w" else _reversed_along
    return along(geometry, fragments, raster)


def _in_front(keeps: Flags, plane: Floats, depth_format: DepthFormat) -> Flags:
    """Drop fragments (F,) whose interpolated 1/w shows a point behind the eye."""
    return keeps & (plane > 0) if depth_format.quantity.plane == "inverse-w" else keeps


def _stored(geometry: Geometry, plane: Floats, depth_format: DepthFormat) -> Stored:
    return depth_format.store(_converted(geometry, plane, depth_format.quantity))


def _converted(geometry: Geometry, plane: Floats, quantity: DepthQuantity) -> Floats:
    return plane if quantity.convert is None else quantity.convert(plane, *logarithm_range(geometry))


def logarithm_range(geometry: Geometry) -> tuple[float, float]:
    """Return near and far of the logarithm of w: the camera's, or those for triangles given in clip space."""
    return geometry.vertices.view_range or (NEAREST_W, FARTHEST_W)


def _reversed_along(geometry: Geometry, fragments: LineFragments, raster: Raster) -> Floats:
    """Return the reversed depth (F,) of fragments of outlines: it goes linearly from end to end."""
    outlines = outlines_of(geometry)
    t = line_parameter(outlines, fragments, raster.center)
    return interpolate_line(fragments.segment, t, reversed_ends(geometry, outlines)[..., None])[:, 0]


def reversed_ends(geometry: Geometry, outlines: Outlines) -> Floats:
    """Return the reversed depth of both ends of outlines, (L, 2)."""
    z = (2 * outlines.depth - 1) * outlines.w
    return reversed_clip_depth(z, outlines.w, geometry.vertices.view_range) / outlines.w


def fragment_inverse_w(geometry: Geometry, fragments: Fragments, raster: Raster) -> Floats:
    """Return 1/w at fragments, (F,) float64."""
    if isinstance(fragments, LineFragments):
        start, end = inverse_w_parts(outlines_of(geometry), fragments, raster.center)
        return start + end
    x, y = raster.centers(fragments.column, fragments.row)
    return plane_value(geometry.inverse_w_plane, fragments.primitive, x, y)


def outlines_of(geometry: Geometry) -> Outlines:
    """Return the outlines of a geometry that is drawn as a wireframe."""
    assert geometry.outlines is not None
    return geometry.outlines
