"""How far colours interpolated as bytes can be from those of the pipeline: bounds, triangle by triangle.

What the pipeline does and interpolated bytes do not: interpolate linear light (`chord_error`), divide by w
(`perspective_error`), multiply interpolated albedo with interpolated light (`product_error`), cut off light that is too
bright only at the end (`cut_off_error`). Corners lie where they are snapped to (`snapping_error`), and steps over the
window are rounded (`drift_error`).
"""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from core.fast_path.depth_free import THIN
from core.framebuffer.display import SRGB_EXPONENT, SRGB_OFFSET, SRGB_SCALE, SRGB_SLOPE
from core.numeric.byte_words import DRIFT
from core.raster.edges.snapping import SUBPIXELS
from core.records.arrays import Flags, Floats, Integers
from core.stages.geometry import Geometry

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
