"""Triangles made at random, and the two large ones: the workloads that are given in the window."""

import numpy as np

from app.bench.records import SUBPIXELS, Bytes, Floats, WindowTriangles

LARGE_CORNERS = ((3.3, 5.2), (1019.7, 12.6), (8.1, 1021.9))
SLENDEREST = 0.12
"""Least area of a random triangle as a fraction of the square of its longest side: no slivers."""
DARKEST = 16
"""Least value of a colour channel: what is drawn can be told from the black background."""


def snapped(points: Floats) -> Floats:
    """Round window positions (..., 2) to 1/256 pixel."""
    return np.rint(points * SUBPIXELS) / SUBPIXELS


def large_triangle(colors: tuple[tuple[int, int, int], ...]) -> WindowTriangles:
    """Return a triangle that covers half of 1024 x 1024 pixels, with these colours at its corners."""
    opaque = np.array([[(*color, 255) for color in colors]], np.uint8)
    return WindowTriangles(
        snapped(np.array([LARGE_CORNERS])), np.array([[0.2, 0.5, 0.8]]), opaque, (1024, 1024)
    )


def random_triangles(
    seed: int, count: int, size: tuple[int, int], area: float, is_blended: bool = False
) -> WindowTriangles:
    """Return ``count`` triangles of about ``area`` pixels each, spread evenly over the raster."""
    rng = np.random.default_rng(seed)
    middle = rng.uniform(0, 1, (count, 1, 2)) * size
    shape = _shapes(rng, count)
    shape *= np.sqrt(area / (doubled_areas(shape) / 2))[:, None, None]
    shape -= shape.mean(axis=1, keepdims=True)
    corners = snapped(np.clip(middle + shape, 0, size))
    depth = rng.uniform(0.05, 0.95, (count, 1)) + rng.uniform(-0.02, 0.02, (count, 3))
    colors = _flat_colors(rng, count, is_blended)
    has_area = doubled_areas(corners) > 0
    return WindowTriangles(corners[has_area], depth[has_area], colors[has_area], size, is_blended)


def doubled_areas(corners: Floats) -> Floats:
    """Return twice the signed area (T,) of triangles (T, 3, 2)."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return np.asarray(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])


def _shapes(rng: np.random.Generator, count: int) -> Floats:
    """Return counter-clockwise triangles (count, 3, 2) of no particular size that are not too slender."""
    shape = rng.normal(size=(count, 3, 2))
    poor = np.arange(count)
    while len(poor):
        shape[poor] = rng.normal(size=(len(poor), 3, 2))
        sides = shape[poor] - np.roll(shape[poor], 1, axis=1)
        longest = (sides**2).sum(axis=2).max(axis=1)
        poor = poor[np.abs(doubled_areas(shape[poor])) / 2 < SLENDEREST * longest]
    turned = doubled_areas(shape) < 0
    shape[turned] = shape[turned][:, [0, 2, 1]]
    return shape


def _flat_colors(rng: np.random.Generator, count: int, is_blended: bool) -> Bytes:
    """Return one random colour for each triangle, at all its corners: (count, 3, 4)."""
    color = np.full((count, 4), 255, np.uint8)
    color[:, :3] = rng.integers(DARKEST, 256, (count, 3))
    if is_blended:
        color[:, 3] = rng.integers(64, 192, count)
    return np.repeat(color[:, None], 3, axis=1)
