"""Colours as bytes, linear over the window: three channels in one 64-bit word, moved by one addition.

Corner colours are lit and encoded once a vertex, and the *bytes* are interpolated, linearly in the window. That is not
what the pipeline says: it interpolates linear light and divides by w. How far the two are apart is bounded per
triangle (the functions named ``error``), and only where the bound stays below one byte is this used: then no byte is
off by more than one. What the bounds leave out are triangles hardly wider than snapping moves their corners: exact
colours are those of the unsnapped triangle and may leave the range of its corners there, these do not.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats, Integers
from core.framebuffer.display import srgb
from core.framebuffer.nearest import NearestFragments
from core.geometry_stages import Geometry
from core.picture.byte_words import DRIFT, FIELDS, unpack
from core.picture.palette import has_texture
from core.primitives import CornerValues
from core.raster.schedule import Raster
from core.raster.spans.arena import Arena
from core.raster.spans.bands import Band
from core.raster.spans.packed import PackedPlanes
from core.scene import AnyScene
from core.settings import Settings
from core.surface import shade_fragments

Words = NDArray[np.uint32]

TOLERANCE = 0.95
"""Bytes that the interpolated colour may be away from the exact one before both are rounded: numbers less than 1 apart
are rounded to the same byte or to neighbours."""
LARGEST_DRIFT = 0.45
"""Bytes; half a byte would let a channel run over into the next one."""
BLOCK = 1 << 15
"""Pixels that are looked up together: their numbers stay in the processor's cache."""
STEEPEST = 2.0**40
"""Bytes a pixel; steeper planes are seen edge-on."""


@dataclass(frozen=True, eq=False)
class ByteColors:
    """Corner colours of P triangles in bytes, 0 to 255, and their planes over the window."""

    corner: Floats
    """(3, P) float64 per channel, at corner 0: (3 channels, P)."""
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
    name = "bytes"
    stage = "interpolate"
    fits_layer = True

    def packed(self) -> PackedPlanes:
        """Return the words of all triangles."""
        count = len(self.x)
        column, row = np.floor(self.x), np.floor(self.y)
        origin, across, up = np.zeros((3, count), np.int64)
        for channel, (shift, bits) in enumerate(FIELDS):
            unit = 2.0**bits
            step, rise = np.rint(self.across[channel] * unit), np.rint(self.up[channel] * unit)
            at_pixel = np.rint(
                (self.corner[channel] + 0.5) * unit
                + (column + self.center - self.x) * step
                + (row + self.center - self.y) * rise
            )
            for word, values in ((origin, at_pixel), (across, step), (up, rise)):
                word += values.astype(np.int64) << shift
        origin -= column.astype(np.int64) * across
        origin -= row.astype(np.int64) * up
        return PackedPlanes(origin, across, up)

    def block(self, triangle: int, band: Band, raster: Raster, arena: Arena) -> Words:
        """Return the pixels (R, C) uint32 of one triangle at all pixels of a band's block.

        Notes
        -----
        The share of the row and that of the column are rounded by themselves, so the error does not grow with the
        distance from the corner.
        """
        x, y = raster.along(band.column) - self.x[triangle], raster.along(band.row) - self.y[triangle]
        ramp, of_row = np.zeros(len(x), np.int64), np.zeros(len(y), np.int64)
        for channel, (shift, bits) in enumerate(FIELDS):
            unit = 2.0**bits
            ramp += np.rint(x * (self.across[channel, triangle] * unit)).astype(np.int64) << shift
            start = (self.corner[channel, triangle] + 0.5) * unit
            of_row += np.rint(y * (self.up[channel, triangle] * unit) + start).astype(np.int64) << shift
        word = np.add(ramp, of_row[:, None], out=arena("color_block", len(y), len(x), dtype=np.int64))
        return unpack(word.reshape(-1), arena).reshape(word.shape)

    def look_up(self, nearest: NearestFragments, raster: Raster, pixels: Words, arena: Arena) -> int:
        """Write the colour of what is seen at every pixel (H*W,) uint32; return how many there are.

        The others keep what they have: the background.
        """
        planes = self.packed()
        seen_count = 0
        for first in range(0, len(pixels), BLOCK):
            part = slice(first, first + BLOCK)
            place, primitive = nearest.seen_in(part)
            seen_count += len(place)
            column, row = raster.position(np.add(place, first))
            word, step = (arena(name, len(place), dtype=np.int64) for name in ("seen_word", "seen_step"))
            planes.origin.take(primitive, out=word, mode="clip")
            for along, change in ((column, planes.across), (row, planes.up)):
                change.take(primitive, out=step, mode="clip")
                step *= along
                word += step
            pixels[part][place] = unpack(word, arena)
        return seen_count


@dataclass(frozen=True, eq=False)
class VertexBytes:
    """Lit colours of M vertices as bytes, and what bounds the error of interpolating them."""

    encoded: Floats
    """(3, M) float64, 0 to 255, a row for each channel."""
    products: list[tuple[int, Floats, Floats]]
    """Channel, albedo (M,) and light (M,): where both vary, their product is not linear."""
    is_opaque: bool
    cut_off: Floats | None
    """(M,) float64, what was cut off from linear colours brighter than 1 or darker than 0; ``None``: nothing was."""


_last: list[tuple[Floats, str, VertexBytes]] = []
"""Values of vertices (the very array), encoding and bytes of the last picture: light that does not depend on the
camera gives the same array again."""


def vertex_bytes(scene: AnyScene, values: CornerValues, settings: Settings, encoding: str) -> VertexBytes:
    """Return the lit colours of the vertices whose ``values`` are given."""
    for rows, of_encoding, known in _last:
        if rows is values.rows and of_encoding == encoding:
            return known
    mesh = np.zeros(len(values.rows), np.int64)
    surface = shade_fragments(scene, settings, values.layout, mesh, values.rows)
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
    made = VertexBytes(encoded, products, bool((surface.color[:, 3] == 1).all()), cut_off)
    _last[:] = [(values.rows, encoding, made)]
    return made


def byte_colors(
    scene: AnyScene, geometry: Geometry, settings: Settings, encoding: str, center: float
) -> ByteColors | None:
    """Return the colours of all primitives as bytes, or ``None`` where some pixel could be off by more than one."""
    values = geometry.primitives.values
    is_lit_at_corners = {"color"} <= set(values.layout) <= {"color", "diffuse_light", "specular_light"}
    if not is_lit_at_corners or has_texture(scene):
        return None
    if settings.interpolation == "flat" or not geometry.is_projected.all():
        return None
    vertices = vertex_bytes(scene, values, settings, encoding)
    if not vertices.is_opaque:
        return None
    count = values.index.shape[1]
    first, second, third = (np.empty((3, count)) for _ in range(3))
    for corner, index in zip((first, second, third), values.index, strict=True):
        for of_vertices, at_corner in zip(vertices.encoded, corner, strict=True):
            of_vertices.take(index, out=at_corner, mode="clip")
    low = np.minimum(np.minimum(first, second), third)
    spread = np.maximum(np.maximum(first, second), third)
    spread -= low
    error = product_error(vertices, values.index, low, encoding)
    if vertices.cut_off is not None:
        error += cut_off_error(vertices.cut_off, values.index, low, spread, encoding)
    if encoding == "srgb":
        error += chord_error(low, spread)
    if settings.interpolation == "perspective":
        error += perspective_error(geometry, spread.max(axis=0))
    drift = drift_error(geometry)
    error += drift
    if float(error.max(initial=0)) > TOLERANCE or float(drift.max(initial=0)) > LARGEST_DRIFT:
        return None

    x, y = geometry.window_x, geometry.window_y
    second -= first
    third -= first
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        share = 1 / geometry.doubled_area
        dx1, dy1, dx2, dy2 = (side * share for side in (x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]))
        across = second * dy2
        across -= third * dy1
        third *= dx1
        second *= dx2
        up = np.subtract(third, second, out=third)
        steepest = max(abs(float(f(of, initial=0))) for f in (np.max, np.min) for of in (across, up))
    if not steepest < STEEPEST:
        return None
    return ByteColors(first, across, up, x[0], y[0], center)


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
    where the ratio is infinite.
    """
    w0, w1, w2 = (geometry.primitives.vertex_clip[3].take(index) for index in geometry.primitives.corner)
    ratio = np.maximum(np.maximum(w0, w1), w2)
    with np.errstate(over="ignore"):
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
    vertices : VertexBytes
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
    power = 255 * 1.055 / 2.4 * np.float_power((byte / 255 + 0.055) / 1.055, -1.4)
    slope: Floats = np.minimum(power, 255 * 12.92)
    return slope
