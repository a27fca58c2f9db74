"""Colours as bytes, linear over the window: three channels in one 64-bit word, and how far they may be off.

What the pipeline does and interpolated bytes do not: interpolate linear light (`chord_error`), divide by w
(`perspective_error`), multiply interpolated albedo with interpolated light (`product_error`), cut off light that is too
bright only at the end (`cut_off_error`). Corners lie where they are snapped to (`snapping_error`), and steps over the
window are rounded (`drift_error`).

Corner colours are lit and encoded once a vertex, and the *bytes* are interpolated, linearly in the window. That is not
what the pipeline says: it interpolates linear light and divides by w. How far the two are apart is bounded per
triangle (the functions named ``error``), and only for triangles whose bound stays below one byte is this used: then no
byte is off by more than one. What the bounds leave out are triangles hardly wider than snapping moves their corners:
exact colours are those of the unsnapped triangle and may leave the range of its corners there, these do not.
"""

from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from core.coverage.snapping import SUBPIXELS
from core.fast_path.depth_free import THIN
from core.fast_path.draw_context import DrawContext, Words
from core.framebuffer.display import SRGB_EXPONENT, SRGB_OFFSET, SRGB_SCALE, SRGB_SLOPE, srgb
from core.numeric.planes import (
    DRIFT,
    FIELDS,
    FieldPlane,
    IntegerPlanes,
    integer_planes,
    unpack,
    window_slopes,
)
from core.records.arrays import Flags, Floats, Integers, cached_property
from core.spans.bands import Strip
from core.stages.fragment_color import shade_fragments
from core.stages.geometry import Geometry

# How far colours interpolated as bytes can be from those of the pipeline: bounds, triangle by triangle.


ALIKE = 12.0
"""Bytes that colours differ by, seen side by side, and look much the same."""


@dataclass(frozen=True, eq=False)
class VertexBytes:
    """Lit colours of M vertices as bytes, and what bounds the error of interpolating them."""

    encoded: Floats
    """(3, M) float64, 0 to 255, a row for each channel."""
    products: list[tuple[int, Floats, Floats]]
    """Channel, albedo (M,) and light (M,): where both vary, their product is not linear."""
    is_opaque: Flags | None
    """(M,) bool; ``None``: all are."""
    cut_off: Floats | None
    """(M,) float64, what was cut off from linear colours brighter than 1 or darker than 0; ``None``: nothing was."""
    most_product: float = np.inf
    """`product_error` of any triangle of the scene at most, as far as it is known."""


def chord_error(low: Floats, spread: Floats) -> Floats:
    """Return how far (P,) interpolated sRGB bytes are from the sRGB bytes of interpolated light.

    Parameters
    ----------
    low, spread : (3, P) float64
        Least byte of a triangle's corners and greatest minus least, per channel.

    Notes
    -----
    sRGB is concave; its chord over bytes s to s + d lies at most d^2 / (5 (s + d / 2) + 40) below it (tested).
    """
    gap: Floats = (spread * spread / (5 * low + 2.5 * spread + 40)).max(axis=0)
    return gap


def perspective_error(geometry: Geometry, spread: Floats) -> Floats:
    """Return how far (P,) bytes that differ by ``spread`` (P,) are from those divided by w.

    Notes
    -----
    For a ratio r of the greatest to the least w it is (sqrt r - 1) / (sqrt r + 1) of the spread, up to all of it
    where the ratio is infinite; not a number where a corner is behind the eye.
    """
    w0, w1, w2 = (geometry.primitives.vertex_clip[3].take(index) for index in geometry.primitives.corner)
    ratio = np.maximum(np.maximum(w0, w1), w2)
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        ratio /= np.minimum(np.minimum(w0, w1), w2)
        root = np.sqrt(ratio, out=ratio)
    return np.asarray(spread * (1 - 2 / (root + 1)))


def drift_error(geometry: Geometry) -> Floats:
    """Return how far (P,) rounded steps may lead away from the plane, in bytes, in going from corner 0 to a pixel.

    Notes
    -----
    While it is less than half a byte, a value from 0 to 255 never runs over into the next channel.
    """
    x, y = geometry.window_x, geometry.window_y
    steps = np.maximum(np.abs(x[1] - x[0]), np.abs(x[2] - x[0]))
    steps += np.maximum(np.abs(y[1] - y[0]), np.abs(y[2] - y[0]))
    return np.asarray((steps + 2) * DRIFT)


def snapping_error(across: Floats, up: Floats, spread: Floats) -> Floats:
    """Return how far (P,) bytes that change by ``across`` and ``up`` (3, P) a pixel are off since corners are snapped.

    Notes
    -----
    Of a triangle with corners that are `ALIKE`, differing by ``spread`` (P,), no more is counted than one has that is
    as narrow as `THIN`: in a narrower one bytes stay between those of the corners.
    """
    with np.errstate(invalid="ignore"):
        slope = np.abs(across)
        slope += np.abs(up)
    error: Floats = slope.max(axis=0) * (0.5 / SUBPIXELS)
    return np.minimum(error, np.where(spread <= ALIKE, ALIKE * sqrt(2) / THIN * (0.5 / SUBPIXELS), np.inf))


def cut_off_error(cut_off: Floats, index: Integers, low: Floats, spread: Floats, encoding: str) -> Floats:
    """Return how far (P,) bytes cut off at the corners are from light that is interpolated and then cut off.

    Parameters
    ----------
    cut_off : (M,) float64
        What the vertices lost, in linear light.
    index : (3, P) int64
        The vertices of the corners.
    low, spread : (3, P) float64
        Least byte of the corners and greatest minus least, per channel.

    Notes
    -----
    From a corner that lost e to one that is d below the limit, both are farthest apart where the limit is reached: by
    e d / (e + d).
    """
    lost = np.maximum.reduce([cut_off.take(corner) for corner in index])
    lost *= 255 if encoding == "linear" else _steepest_slope(low.min(axis=0))
    below = spread.max(axis=0)
    total = lost + below
    total[total == 0] = 1
    return np.asarray(lost * below / total)


def product_error(vertices: VertexBytes, index: Integers, low: Floats, encoding: str) -> Floats:
    """Return how far (P,) bytes are from the product of interpolated albedo and interpolated light.

    Parameters
    ----------
    index : (3, P) int64
        The vertices of the corners.
    low : (3, P) float64
        Least byte of the corners, per channel.

    Notes
    -----
    The product of two linear functions that vary by p and q is at most p q / 4 from linear; in bytes this is at most
    255 times as much, times the slope of the encoding.
    """
    error = np.zeros(index.shape[1])
    light_spread, known_light = error, None
    for channel, albedo, light in vertices.products:
        if known_light is None or not np.array_equal(light, known_light):
            light_spread, known_light = _spread(light, index), light
        product = _spread(albedo, index)
        product *= light_spread
        product *= 0.25 * 255 if encoding == "linear" else 0.25 * _steepest_slope(low[channel])
        np.maximum(error, product, out=error)
    return error


def _spread(values: Floats, index: Integers) -> Floats:
    """Return greatest minus least of the values (M,) at the corners (3, P): (P,)."""
    first, second, third = (values.take(of) for of in index)
    spread: Floats = np.maximum(np.maximum(first, second), third)
    spread -= np.minimum(np.minimum(first, second), third)
    return spread


def _steepest_slope(byte: Floats) -> Floats:
    """Return the bytes (P,) that sRGB rises by per unit of linear light above ``byte`` (P,), at most."""
    root = (byte / 255 + SRGB_OFFSET) / SRGB_SCALE
    power = 255 * SRGB_SCALE / SRGB_EXPONENT * np.float_power(root, 1 - SRGB_EXPONENT)
    slope: Floats = np.minimum(power, 255 * SRGB_SLOPE)
    return slope


# Colours as bytes, linear over the window: three channels in one 64-bit word, moved by one addition.


TOLERANCE = 0.95
"""Bytes that the interpolated colour may be away from the exact one before both are rounded: numbers less than 1 apart
are rounded to the same byte or to neighbours."""
LARGEST_DRIFT = 0.45
"""Bytes; half a byte would let a channel run over into the next one."""

NEARLY_LINEAR = ("perspective", "affine", "affine-n")
"""Methods of interpolation between whose values and linear ones the bounds of the errors lie."""


@dataclass(frozen=True, eq=False)
class ByteColors:
    """Corner colours of P triangles in bytes, 0 to 255, and their planes over the window."""

    corner: Floats
    """(3 channels, P) float64, at corner 0."""
    across: Floats
    """(3, P) float64, change per column of the three channels."""
    up: Floats
    """(3, P) float64, change per row."""
    x: Floats
    """(P,) float64, snapped place of corner 0."""
    y: Floats
    """(P,) float64."""
    center: float
    """Offset of a pixel's centre."""
    is_near: Flags
    """(P,) bool, the triangles that may have these colours; those of the others are 0."""

    def packed(self) -> IntegerPlanes:
        """Return the words of all triangles."""
        return self._planes

    @cached_property
    def _planes(self) -> IntegerPlanes:
        fields = [
            FieldPlane((value + 0.5) * 2.0**bits, across * 2.0**bits, up * 2.0**bits, shift)
            for value, across, up, (shift, bits) in zip(
                self.corner, self.across, self.up, FIELDS, strict=True
            )
        ]
        return integer_planes(self.x, self.y, self.center, fields)

    def block(self, context: DrawContext, triangle: int, strip: Strip) -> Words:
        """Return the pixels (R, C) uint32 of one triangle at all pixels of a strip: the very bytes of `look_up`."""
        rows, steps, planes = strip.inside, strip.steps, self._planes
        across = planes.across[triangle]
        of_row = planes.origin[triangle] + (rows.origin * across + rows.row * planes.up[triangle])
        shape = (len(rows), steps.width)
        word = np.add(
            steps.spread(steps.number * across),
            of_row[:, None],
            out=context.scratch("color_block", *shape, dtype=np.int64),
        )
        return unpack(word.reshape(-1), context.scratch).reshape(word.shape)

    def write(self, context: DrawContext, place: Integers, primitive: Integers) -> None:
        """Write the pixels at places (F,) of primitives (F,)."""
        word = self._planes.at(primitive, *context.raster.position(place))
        context.pixels[place] = unpack(word, context.scratch)


_last: list[tuple[Floats, str, VertexBytes]] = []
"""Values of vertices (the very array), encoding and bytes of the last picture: light that does not depend on the
camera gives the same array again."""


def vertex_bytes(context: DrawContext) -> VertexBytes:
    """Return the lit colours of the vertices."""
    values, encoding = context.geometry.primitives.values, context.encoding
    for rows, of_encoding, known in _last:
        if rows is values.rows and of_encoding == encoding:
            if known.products and known.most_product == np.inf and _are_of_vertices(context):
                known = replace(known, most_product=_most_product(context, known))
                _last[:] = [(rows, encoding, known)]
            return known
    mesh = np.zeros(len(values.rows), np.int64)
    surface = shade_fragments(context.scene, context.settings, values.layout, mesh, values.rows)
    unbounded = surface.color[:, :3].T
    linear = np.clip(unbounded, 0, 1)
    encoded = np.ascontiguousarray(255 * (srgb(linear) if encoding == "srgb" else linear))
    products = []
    if surface.diffuse_light is not None:
        for channel in range(3):
            albedo, light = (
                np.ascontiguousarray(of[:, channel]) for of in (surface.albedo, surface.diffuse_light)
            )
            if np.ptp(albedo) and np.ptp(light):
                products.append((channel, albedo, light))
    cut_off = np.abs(unbounded - linear).max(axis=0) if (unbounded != linear).any() else None
    is_opaque: Flags = surface.color[:, 3] == 1
    made = VertexBytes(encoded, products, None if is_opaque.all() else is_opaque, cut_off)
    _last[:] = [(values.rows, encoding, made)]
    return made


def _are_of_vertices(context: DrawContext) -> bool:
    """Return whether the values belong to the sides of the scene's vertices, all fronts first, then all backs."""
    geometry = context.geometry
    values, corner = geometry.primitives.values, geometry.vertices.corner_rows
    if geometry.has_pieces or len(values.rows) % len(geometry.vertices.clip):
        return False
    vertex = values.index % len(geometry.vertices.clip)
    return np.array_equal(vertex, corner.take(geometry.primitives.triangle, axis=1))


def _most_product(context: DrawContext, vertices: VertexBytes) -> float:
    """Return the largest product error of all sides of all triangles of the scene, drawn or not."""
    corner, count = context.geometry.vertices.corner_rows, len(context.geometry.vertices.clip)
    most = 0.0
    for first in range(0, vertices.encoded.shape[1], count):
        index = corner + first
        low = np.minimum.reduce([vertices.encoded.take(of, axis=1) for of in index])
        most = max(most, float(product_error(vertices, index, low, context.encoding).max(initial=0)))
    return most


def byte_colors(context: DrawContext) -> ByteColors | None:
    """Return the colours of all primitives as bytes; ``None`` where they are not those of corners."""
    geometry, encoding = context.geometry, context.encoding
    values, interpolation = geometry.primitives.values, context.settings.interpolation
    is_lit_at_corners = {"color"} <= set(values.layout) <= {"color", "diffuse_light", "specular_light"}
    if not is_lit_at_corners or context.has_texture:
        return None
    if interpolation not in NEARLY_LINEAR:
        return None
    vertices = vertex_bytes(context)
    count = values.index.shape[1]
    first, second, third = (np.empty((3, count)) for _ in range(3))
    for corner, index in zip((first, second, third), values.index, strict=True):
        for of_vertices, at_corner in zip(vertices.encoded, corner, strict=True):
            of_vertices.take(index, out=at_corner, mode="clip")
    low = np.minimum(np.minimum(first, second), third)
    spread = np.maximum(np.maximum(first, second), third)
    spread -= low
    widest: Floats = spread.max(axis=0)
    error = drift_error(geometry)
    is_near: Flags = np.asarray(geometry.is_projected & (error <= LARGEST_DRIFT))
    if vertices.is_opaque is not None:
        is_near &= vertices.is_opaque.take(values.index).all(axis=0)
    if vertices.cut_off is not None:
        error += cut_off_error(vertices.cut_off, values.index, low, spread, encoding)
    if encoding == "srgb":
        error += chord_error(low, spread)
    if interpolation != "affine":
        error += perspective_error(geometry, widest)
    if not float(error.max(initial=0)) + vertices.most_product <= TOLERANCE:
        error += product_error(vertices, values.index, low, encoding)
    x, y = geometry.window_x, geometry.window_y
    across, up = window_slopes(x, y, geometry.doubled_area, first, second, third)
    error += snapping_error(across, up, widest)
    is_near &= error <= TOLERANCE
    return _level_where(~is_near, ByteColors(first, across, up, x[0], y[0], context.raster.center, is_near))


def _level_where(others: Flags, colors: ByteColors) -> ByteColors:
    """Return colours that are 0 for the ``others`` (P,), whose numbers may not be finite."""
    chosen = np.flatnonzero(others)
    if not len(chosen):
        return colors
    x, y = colors.x.copy(), colors.y.copy()
    for values in (colors.corner, colors.across, colors.up, x, y):
        values[..., chosen] = 0
    return replace(colors, x=x, y=y)
