"""Fragments wherever they come from: who owns them, their attributes, and their depth.

It joins geometry, outlines and the formats of the depth buffer; picture, trace and history of a pixel ask it alike.

Pixels of areas take their values from planes over the window, pixels of outlines from the ends of their segments.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from core.coverage.fills import Fragments
from core.coverage.pixel_runs import Raster
from core.coverage.snapping import SUBPIXELS
from core.depth.depth import DepthFormat, DepthQuantity, Stored, clamp_depth
from core.depth.formats import FARTHEST_W, NEAREST_W
from core.interpolation.interpolation import Interpolator, ValueRule, plane_value
from core.lines.drawing import interpolate_line
from core.lines.wireframe import (
    LineFragments,
    Outlines,
    interpolate_outlines,
    inverse_w_parts,
    line_depth,
    line_parameter,
)
from core.lines.wireframe_fragments import line_slopes
from core.methods import table
from core.records.arrays import Flags, Floats, Integers
from core.records.frame import StageCount
from core.records.primitives import interpolation_form
from core.resolved import resolve
from core.scene import AnyScene
from core.stages.fragment_color import Surface, shade_fragments
from core.stages.geometry import Geometry
from core.textures.footprints import uv_slopes
from core.textures.look_up import uses_mipmaps
from core.transform.matrices import reversed_clip_depth

if TYPE_CHECKING:
    from core.textures.footprints import EditedSlopes

ROUNDING = 2.0**-44
"""Bound of the rounding in the depth of a fragment, as a share of its terms: 256 roundings."""


# The depth of fragments: window depth, whether it is in range, and what a depth method stores in its place.


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
    quantity = depth_format.quantity
    plane, at_corners = _plane_and_corners(geometry, quantity)
    beyond = (np.abs(plane[0]) + np.abs(plane[1])) / SUBPIXELS
    if quantity.plane == "z":
        farthest = np.minimum(at_corners.max(axis=1) + beyond, 1.0)
    else:
        farthest = np.maximum(at_corners.min(axis=1) - beyond, 0.0)
    stored = _stored(geometry, farthest, depth_format)
    # On an integer plane every step along a row or a column is rounded.
    return np.add(stored, (1 + sum(geometry.vertices.size)) / 2) if depth_format.is_planar else stored


def nearest_stored(geometry: Geometry, depth_format: DepthFormat, reach: float) -> Stored:
    """Return a bound of what is stored of each primitive (P,) before the eye: none of its fragments is nearer.

    Parameters
    ----------
    reach : float
        How many pixels beyond the unsnapped triangle, whose plane has their depth, fragments lie at most.
    """
    quantity = depth_format.quantity
    (a, b, c), at_corners = _plane_and_corners(geometry, quantity)
    width, height = geometry.vertices.size
    x, y, w = geometry.corners.homogeneous.transpose(2, 0, 1)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        of_plane = a[:, None] * (x / w) + b[:, None] * (y / w) + c[:, None]
        ends = np.concatenate([at_corners, of_plane], axis=1)
        beyond = (np.abs(a) + np.abs(b)) * reach
        beyond += ROUNDING * (np.abs(a) * width + np.abs(b) * height + np.abs(c))
        if quantity.plane == "z":
            nearest = np.clip(np.nan_to_num(ends.min(axis=1) - beyond, nan=-np.inf), 0.0, 1.0)
        else:
            nearest = np.maximum(np.nan_to_num(ends.max(axis=1) + beyond, nan=np.inf), 0.0)
    stored = _stored(geometry, nearest, depth_format)
    return np.subtract(stored, (1 + width + height) / 2) if depth_format.is_planar else stored


def stored_at(geometry: Geometry, clip: Floats, depth_format: DepthFormat) -> Stored:
    """Return what would be stored (N,) at points before the eye, clip positions (N, 4)."""
    plane = depth_format.quantity.plane
    if plane == "z":
        value = np.clip((clip[:, 2] / clip[:, 3] + 1) / 2, 0.0, 1.0)
    else:
        value = _homogeneous(geometry, clip, plane) / clip[:, 3]
    return _stored(geometry, value, depth_format)


def _plane_and_corners(
    geometry: Geometry, quantity: DepthQuantity
) -> tuple[tuple[Floats, Floats, Floats], Floats]:
    """Return the plane of a quantity over the window, (P,) each, and its values at the corners (P, 3)."""
    if quantity.plane == "z":
        return geometry.depth_plane, geometry.depth.T
    clip, is_reversed = geometry.primitives.clip, quantity.plane == "reversed-z"
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        at_corners = _homogeneous(geometry, clip, quantity.plane) / clip[..., 3]
    return geometry.reversed_plane if is_reversed else geometry.inverse_w_plane, at_corners


def _homogeneous(geometry: Geometry, clip: Floats, plane: str) -> Floats:
    """Return what is linear over the window times w, (...), of clip positions (..., 4): ``inverse-w`` or reversed z."""
    if plane == "inverse-w":
        return np.ones(clip.shape[:-1])
    return np.asarray(reversed_clip_depth(clip[..., 2], clip[..., 3], geometry.vertices.view_range))


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


# What is known of fragments wherever they come from: who owns them, their attributes, how their texture
# changes.


def owner_of(fragments: Fragments) -> Integers:
    """Return what each fragment belongs to, (F,) int64: its segment or its primitive."""
    return fragments.segment if isinstance(fragments, LineFragments) else fragments.primitive


def fragments_at(geometry: Geometry, owner: Integers, column: Integers, row: Integers) -> Fragments:
    """Return the fragments of owners (F,), see ``owner_of``, at pixels."""
    if geometry.outlines is None:
        return Fragments(owner, column, row)
    return LineFragments(geometry.outlines.primitive.take(owner), column, row, owner)


def fragment_values(geometry: Geometry, fragments: Fragments, raster: Raster) -> tuple[Floats, Floats]:
    """Return weights of the corners (F, C) and interpolated values (F, K) of fragments.

    C is 3, of segments 2 and of points 1: these are drawn as triangles that repeat their last corner.
    """
    mode, varyings = geometry.settings.interpolation, geometry.primitives.varyings
    if isinstance(fragments, LineFragments) and interpolation_form(mode) != "flat":
        assert geometry.outlines is not None
        weights, values = interpolate_outlines(geometry.outlines, varyings, fragments, raster.center, mode)
    else:
        interpolator = Interpolator(geometry.planes, varyings, *resolve(geometry.settings).interpolation)
        centers = raster.centers(fragments.column, fragments.row)
        weights, values = interpolator.weighted(fragments.primitive, *centers)
    last = geometry.vertices.corner_count - 1
    if last < 2:
        weights = np.column_stack([weights[:, :last], weights[:, last:].sum(axis=1)])
    return weights, values


def interpolate(geometry: Geometry, raster: Raster, fragments: Fragments, count: StageCount) -> Floats:
    """Return the interpolated values (F, K) float64 of fragments."""
    with count:
        count.incoming = count.outgoing = len(fragments)
        if isinstance(fragments, LineFragments):
            return fragment_values(geometry, fragments, raster)[1]
        how = resolve(geometry.settings).interpolation
        interpolator = Interpolator(geometry.planes, geometry.primitives.values, *how)
        return interpolator.values(fragments.primitive, *raster.centers(fragments.column, fragments.row))


def shade(
    scene: AnyScene,
    geometry: Geometry,
    raster: Raster,
    fragments: Fragments,
    values: Floats,
    count: StageCount,
) -> Floats:
    """Return the colours (F, 4) float64 of fragments with interpolated ``values`` (F, K)."""
    with count:
        count.incoming = count.outgoing = len(fragments)
        return surface_of(scene, geometry, raster, fragments, values).color


def not_discarded(scene: AnyScene, geometry: Geometry, raster: Raster, fragments: Fragments) -> Flags:
    """Return (F,) bool, which fragments go on to the depth test: all but those that a fragment shader discards."""
    if scene.program is None:
        return np.ones(len(fragments), bool)
    from core.shaders.stages import discarded_fragments

    discarded = discarded_fragments(scene, geometry, raster, fragments)
    return np.ones(len(fragments), bool) if discarded is None else ~discarded


def surface_of(
    scene: AnyScene,
    geometry: Geometry,
    raster: Raster,
    fragments: Fragments,
    values: Floats,
    slopes: Floats | None = None,
) -> Surface:
    """Return the shaded fragments (F) with interpolated ``values`` (F, K): by the scene's shader, where it has one.

    ``slopes`` of the texture's coordinates, where they are those of other places than the fragments' own.
    """
    if scene.program is not None:
        from core.shaders.stages import run_fragments

        color = run_fragments(scene, geometry, raster, fragments, values).color.astype(np.float64)
        return Surface(color, None, None, color)
    mesh = geometry.primitives.mesh[fragments.primitive]
    slopes = texture_slopes(geometry, raster, fragments, values) if slopes is None else slopes
    return shade_fragments(scene, geometry.settings, geometry.primitives.layout, mesh, values, slopes)


def shade_once(
    scene: AnyScene,
    geometry: Geometry,
    raster: Raster,
    samples: Sequence[Fragments],
    counts: dict[str, StageCount],
) -> tuple[Floats, list[Integers]]:
    """Shade once for every triangle in a pixel: colours (U, 4) at pixels' centres, and which (F,) each sample's has."""
    pixel_count = raster.shape[0] * raster.shape[1]
    keys = [owner_of(of) * pixel_count + raster.index(of.column, of.row) for of in samples]
    every, number = np.unique(np.concatenate(keys), return_inverse=True)
    owner, pixel = np.divmod(every, pixel_count)
    once = fragments_at(geometry, owner, *raster.position(pixel))
    values = interpolate(geometry, raster, once, counts["interpolate"])
    colors = shade(scene, geometry, raster, once, values, counts["shade"])
    return colors, np.split(number.reshape(-1), np.cumsum([len(key) for key in keys])[:-1])


def texture_slopes(geometry: Geometry, raster: Raster, fragments: Fragments, values: Floats) -> Floats | None:
    """Return du/dx, dv/dx, du/dy, dv/dy (4, F) of fragments with interpolated ``values`` (F, K).

    ``None`` where no texture is looked up, or the texture filter does not ask for them.
    """
    if not _asks_for_slopes(geometry):
        return None
    interpolation = geometry.settings.interpolation
    if isinstance(fragments, LineFragments) and interpolation_form(interpolation) != "flat":
        assert geometry.outlines is not None
        varyings = geometry.primitives.varyings[..., geometry.primitives.layout["uv"]]
        slopes = line_slopes(geometry.outlines, varyings, fragments, raster.center, interpolation)
        return slopes.reshape(4, len(fragments))
    x, y = raster.centers(fragments.column, fragments.row)
    return slopes_at(geometry, fragments.primitive, x, y, values)


def slopes_at(geometry: Geometry, primitive: Integers, x: Floats, y: Floats, values: Floats) -> Floats | None:
    """Return the same (4, F), or ``None``, for primitives at window positions (F,)."""
    if not _asks_for_slopes(geometry):
        return None
    rule, *_ = resolve(geometry.settings).interpolation
    if isinstance(rule, ValueRule):
        return edited_slopes_at(geometry, primitive, x, y).slopes
    uv = values[:, geometry.primitives.layout["uv"]]
    name = geometry.settings.interpolation
    return uv_slopes(geometry.planes, geometry.primitives.values, primitive, x, y, uv, name)


def edited_slopes_at(geometry: Geometry, primitive: Integers, x: Floats, y: Floats) -> "EditedSlopes":
    """Return the slopes for primitives at window positions (F,) where an edited listing interpolates."""
    from core.textures.footprints import edited_slopes

    rule, provoking, interval = resolve(geometry.settings).interpolation
    assert isinstance(rule, ValueRule)
    name = table.get("interpolation", geometry.settings.interpolation).name
    values = geometry.primitives.values
    return edited_slopes(rule, geometry.planes, values, primitive, x, y, name, provoking, interval)


def _asks_for_slopes(geometry: Geometry) -> bool:
    return "uv" in geometry.primitives.layout and uses_mipmaps(geometry.settings.texture_filter)
