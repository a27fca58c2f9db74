"""Colours as bytes, linear over the window: three channels in one 64-bit word, moved by one addition.

Corner colours are lit and encoded once a vertex, and the *bytes* are interpolated, linearly in the window. That is not
what the pipeline says: it interpolates linear light and divides by w. How far the two are apart is bounded per
triangle (the functions named ``error``), and only for triangles whose bound stays below one byte is this used: then no
byte is off by more than one. What the bounds leave out are triangles hardly wider than snapping moves their corners:
exact colours are those of the unsnapped triangle and may leave the range of its corners there, these do not.
"""

from dataclasses import dataclass, replace

import numpy as np

from core.fast_path.byte_errors import (
    VertexBytes,
    chord_error,
    cut_off_error,
    drift_error,
    perspective_error,
    product_error,
    snapping_error,
)
from core.fast_path.draw_context import DrawContext, Words
from core.framebuffer.display import srgb
from core.numeric.byte_words import FIELDS, unpack
from core.numeric.integer_planes import FieldPlane, IntegerPlanes, integer_planes, window_slopes
from core.raster.spans.bands import Strip
from core.records.arrays import Flags, Floats, Integers
from core.records.cached import cached_property
from core.stages.fragment_color import shade_fragments

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
    if geometry.primitives is not geometry.kept or len(values.rows) % len(geometry.vertices.clip):
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
