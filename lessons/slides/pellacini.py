"""Numbers of Pellacini's lecture: clipping, viewport depth, pixel centres, d of Bresenham, parameters, z precision."""

from functools import partial

import numpy as np

from core import Settings, draw_lines
from core.geometry.culling import PLANES
from core.geometry.matrices import projection, transform, viewport
from core.methods import table
from core.raster.lines.drawing import interpolate_line
from core.raster.number_formats.inverse import inverse_coefficients
from core.scene import Camera, triangulate
from lessons.printed.records import slide_number
from lessons.slides.small_scenes import clipped_corner_count, distance, is_covered, rounded, triangles

NEAR = PLANES.index("near")
BRESENHAM, WHICH_Z = "bresenham's line rasterization", "which z distance"
A, B, C = (1.0, 1.0), (7.0, 2.0), (3.0, 5.0)


def depth_of_viewport(z: float) -> float:
    """Return the window depth of an NDC z."""
    return float(transform(viewport(8, 6), np.array([[0.0, 0.0, z, 1.0]]))[0, 2])


def decisions() -> tuple[float, ...]:
    """Return d = (x + 1) m + b - y of every step of (0, 0)-(5, 2), by the method ``bresenham-float``."""
    drawn = draw_lines([[[0, 0], [5, 2]]], 8, 8, "bresenham-float", last_pixel=True, pixel_center="integer")
    return rounded(drawn.steps.decision[1:])


def parameters(s: float) -> float:
    """Return q(s) between q0 = 2 and q1 = 10."""
    return float(interpolate_line(np.array([0]), np.array([s]), [[[2.0], [10.0]]])[0, 0])


def weights_of(x: float, y: float) -> tuple[float, ...]:
    """Return alpha, beta and gamma of a point of the plane."""
    inverse, _ = inverse_coefficients([[*corner, 1.0] for corner in (A, B, C)])
    return rounded(np.array([a * x + b * y + c for a, b, c in zip(*inverse, strict=True)]))


def z_of_half_depth() -> float:
    """Return how far from the eye window depth 1/2 lies, near = 1, far = 99."""
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]), near=1.0, far=99.0)
    matrix = projection(camera, 1.0)
    return round(float(matrix[2, 3] / matrix[2, 2]), 12)


def center_of_pixel_0() -> float:
    """Return the coordinate of the centre of pixel 0 with centres on integers."""
    return float(table.get("pixel_center", "integer").function())


def covers_corner(column: int, row: int) -> bool:
    """Return whether a pixel is drawn of a triangle with centres on integers and ends on them."""
    scene = triangles(((1.0, 1.0), (5.0, 1.0), (1.0, 5.0)))
    return is_covered(scene, column, row, Settings(pixel_center="integer"))


_number = partial(slide_number, "Pellacini")
NUMBERS = (
    _number("graphics pipeline", "a quad: triangles", 2, lambda: len(triangulate([[0, 1, 2, 3]])[0])),
    _number("point clipping", "(0, 0, -3, 2) and the near plane: w + z", -1.0, distance, (0, 0, -3, 2), NEAR),
    _number(
        "polygon clipping",
        "a triangle with one corner beyond the near plane: corners left",
        4,
        clipped_corner_count,
        [(0, 0, -2, 1), (1, 0, 0, 1), (0, 1, 0, 1)],
        NEAR,
    ),
    _number(
        "polygon clipping",
        "with two corners beyond it: corners left",
        3,
        clipped_corner_count,
        [(0, 0, -2, 1), (1, 0, -2, 1), (0, 1, 0, 1)],
        NEAR,
    ),
    _number("viewport transformation", "depth of z = -1", 0.0, depth_of_viewport, -1.0),
    _number("viewport transformation", "depth of z = 1", 1.0, depth_of_viewport, 1.0),
    _number("rasterization", "centre of pixel 0", 0.0, center_of_pixel_0),
    _number(
        "rasterization", "centres on integers: pixel (1, 1) at the corner (1, 1)", True, covers_corner, 1, 1
    ),
    _number(BRESENHAM, "d of slope 0.4; NE: d += m - 1, E: d += m", (0.4, 0.8, 0.2, 0.6, 0.0), decisions),
    _number("interpolating parameters along a line", "q from 2 to 10 at s = 0", 2.0, parameters, 0.0),
    _number("interpolating parameters along a line", "q at s = 1/4", 4.0, parameters, 0.25),
    _number("interpolating parameters along a line", "q at s = 1", 10.0, parameters, 1.0),
    _number(
        "triangle barycentric coordinates",
        "weights of a/2 + b/4 + c/4",
        (0.5, 0.25, 0.25),
        weights_of,
        3.0,
        2.25,
    ),
    _number(
        "triangle barycentric coordinates",
        "weights of a point outside",
        (0.5, 0.75, -0.25),
        weights_of,
        5.0,
        0.75,
    ),
    _number(WHICH_Z, "distance of depth 1/2, near 1, far 99: 2nf/(n + f)", 1.98, z_of_half_depth),
)
