"""Numbers of Zwicker's lecture: viewport, edge functions, inside tests, pixel centres, textures, z-buffer on 1/w."""

from functools import partial

import numpy as np

from core import ClipScene, Settings, render, trace
from core.coverage.edge_formats import inverse_coefficients
from core.coverage.edges import covers
from core.depth.depth import depth_test
from core.interpolation.interpolation import interpolate_at
from core.textures.look_up import bilinear_color, nearest_color
from core.transform.matrices import transform, viewport
from lessons.lectures.printed import slide_number
from lessons.small_scenes import SPLIT_SQUARE, cells_unlike, pixel_count, rounded, triangles
from lessons.window_scenes import larger_is_nearer

CORNERS = ((1.0, 0.0, 1.0), (6.0, 2.0, 2.0), (6.0, 15.0, 3.0))
"""x, y, w of a triangle, not divided."""
INVERSE, DETERMINANT = inverse_coefficients([list(corner) for corner in CORNERS])
"""A column of coefficients a, b, c for each of alpha, beta, gamma, and the determinant."""
TURNED = (CORNERS[0], CORNERS[2], CORNERS[1])
TEXTURE = [[[0.0], [1.0]], [[2.0], [4.0]]]
"""2 x 2 texels, the bottom row first."""


def edge_functions_at(x: float, y: float, w: float) -> tuple[float, ...]:
    """Return alpha, beta and gamma at a point."""
    return rounded(np.array([a * x + b * y + c * w for a, b, c in zip(*INVERSE, strict=True)]))


def in_viewport(x: float, y: float) -> tuple[float, ...]:
    """Return where the lecture's viewport of 4 x 3 pixels puts an NDC position."""
    return rounded(transform(viewport(4, 3), np.array([[x, y, 0.0, 1.0]]))[0, :2])


def lit_center(column: int, row: int) -> tuple[float, ...]:
    """Return the place at which a pixel of the 4 x 3 raster is decided, from the trace of the tests."""
    scene = triangles(((-9.0, -9.0), (30.0, -9.0), (-9.0, 30.0)), size=(4, 3))
    rows = trace(scene, Settings(fill="brute-force")).stage("raster")
    at = int(rows.rows_at_pixel(column, row)[0])
    return tuple((rows.pixel[at] + rows.constants["center"]).tolist())


def signs_at(w_sign: float) -> tuple[int, ...]:
    """Return the signs of alpha/w, beta/w, gamma/w in the middle of the triangle, or of its mirror image behind."""
    middle = np.array(CORNERS).mean(axis=0) * w_sign
    at_pixel = np.array(edge_functions_at(*middle.tolist())) / middle[2]
    return tuple(np.sign(at_pixel * np.sign(w_sign)).astype(int).tolist())


def drawn_pixels(clip: list[tuple[float, float, float, float]]) -> int:
    """Return how many pixels of 8 x 6 a triangle covers."""
    return pixel_count(ClipScene(np.array([clip]), size=(8, 6)))


def tested_pixels(*w: float) -> int:
    """Return how many of 8 x 6 pixels a triangle with these w may have to be tested at, by its bounding box."""
    places = ((0.5, 0.0), (0.75, 0.25), (0.5, 0.5))
    clip = [(x * k, y * k, 0.0, k) for (x, y), k in zip(places, w, strict=True)]
    frame = render(ClipScene(np.array([clip]), size=(8, 6)), Settings(fill="bounding-box"))
    return frame.statistics["bin"].outgoing


def unlike_brute_force() -> int:
    """Return at how many pixels 4 x 4 blocks cover otherwise than all pixels tested."""
    scene = triangles(((1.3, 0.2), (15.1, 4.7), (5.2, 11.9)), size=(16, 12))
    fills = (Settings(fill="blocks", block_size=4), Settings(fill="brute-force"))
    first, second = (render(scene, settings).cover_count for settings in fills)
    return int(np.count_nonzero(first != second))


def cover_counts(fill_rule: str) -> tuple[int, int]:
    """Return how many pixels of two triangles with a common edge are drawn, and how many of them twice."""
    count = render(triangles(*SPLIT_SQUARE), Settings(fill_rule=fill_rule)).cover_count
    return int(np.count_nonzero(count)), int(np.count_nonzero(count > 1))


def on_upright_edge(extends_right: bool) -> bool:
    """Return whether a pixel centre on an upright edge belongs to the triangle on its right, or on its left."""
    other = (6.5, 3.0) if extends_right else (0.5, 3.0)
    corners = ((3.5, 0.0), other, (3.5, 6.0)) if extends_right else ((3.5, 0.0), (3.5, 6.0), other)
    return bool(render(triangles(corners), Settings()).cover_count[2, 3])


def interpolated(weight_of: str) -> float:
    """Return u in the middle of the window between w = 1 with u = 0 and w = 3 with u = 1; or 1/w, or affine u."""
    size = (8, 8)
    corners = [(-1.0, -1.0, 0.0, 1.0), (3.0, -3.0, 0.0, 3.0), (-1.0, 1.0, 0.0, 1.0)]
    scene = ClipScene(np.array([corners]), np.array([[[0.0], [1.0], [0.0]]]), size)
    homogeneous = np.array([[(x + w) * 4, (y + w) * 4, w] for x, y, _, w in scene.clip[0].tolist()])
    inverse, _ = inverse_coefficients(homogeneous.tolist())
    a, b, c = (np.array(row) for row in inverse)
    _, inverse_w, u = interpolate_at(a, b, c, 4.0, 0.0, np.array([0.0, 1.0, 0.0]))
    return {"u": u, "1/w": inverse_w}[weight_of]


def is_inside(x: float, y: float) -> bool:
    """Return whether alpha/w, beta/w and gamma/w are all above 0 at a pixel."""
    a, b, c = (np.array(row) for row in INVERSE)
    return covers(a, b, c, np.zeros(3, bool), x, y)[1]


def determinant(corners: tuple[tuple[float, float, float], ...]) -> float:
    """Return the determinant of the corners (x, y, w)."""
    return round(inverse_coefficients([list(corner) for corner in corners])[1], 12)


def constant_function() -> tuple[float, ...]:
    """Return a x + b y + c w of the constant function at the three corners."""
    coefficients = np.array(INVERSE) @ np.ones(3)
    return rounded(np.array(CORNERS) @ coefficients)


EDGES, INSIDE, CENTER = "Finding coefficients", "Pixel inside/outside test", "Where is the center of a pixel?"
_number = partial(slide_number, "Zwicker")
NUMBERS = (
    _number(CENTER, "viewport of 4 x 3 pixels: lower left", (0.0, 0.0), in_viewport, -1.0, -1.0),
    _number(CENTER, "viewport of 4 x 3 pixels: upper right", (4.0, 3.0), in_viewport, 1.0, 1.0),
    _number(CENTER, "centre of the lower left pixel", (0.5, 0.5), lit_center, 0, 0),
    _number(CENTER, "centre of the upper right pixel", (3.5, 2.5), lit_center, 3, 2),
    _number(EDGES, "alpha, beta, gamma at vertex 0", (1.0, 0.0, 0.0), edge_functions_at, *CORNERS[0]),
    _number(EDGES, "alpha, beta, gamma at vertex 1", (0.0, 1.0, 0.0), edge_functions_at, *CORNERS[1]),
    _number(EDGES, "alpha, beta, gamma at vertex 2", (0.0, 0.0, 1.0), edge_functions_at, *CORNERS[2]),
    _number(
        "Edge functions",
        "alpha + beta + gamma on the triangle's plane",
        1.0,
        lambda: round(sum(edge_functions_at(*np.dot((2.0, -1.5, 0.5), CORNERS).tolist())), 12),
    ),
    _number(INSIDE, "signs of alpha/w, beta/w, gamma/w inside", (1, 1, 1), signs_at, 1.0),
    _number(INSIDE, "the same behind the eye", (-1, -1, -1), signs_at, -1.0),
    _number(INSIDE, "the pixel (2.5, 2) is inside", True, is_inside, 2.5, 2.0),
    _number(INSIDE, "the pixel (2.5, 5) is inside", False, is_inside, 2.5, 5.0),
    _number(
        "Open issues",
        "triangle of no area before projection: pixels",
        0,
        drawn_pixels,
        [(-1, -1, 0, 1), (0, 0, 0, 1), (1, 1, 0, 1)],
    ),
    _number(
        "Open issues",
        "triangle whose projection has no area: pixels",
        0,
        drawn_pixels,
        [(-1, -1, 0, 1), (0, 0, 0, 2), (2, 2, 0, 2)],
    ),
    _number("Open issues", "determinant of a front face", 54.0, determinant, CORNERS),
    _number("Open issues", "determinant of the same face turned over", -54.0, determinant, TURNED),
    _number("Binning", "case 2, all w < 0: pixels to test of 48", 0, tested_pixels, -1.0, -1.0, -1.0),
    _number("Binning", "case 3, w of both signs: pixels to test of 48", 48, tested_pixels, 1.0, -1.0, 1.0),
    _number("Binning", "case 1, all w > 0: pixels to test of 48", 2, tested_pixels, 1.0, 2.0, 3.0),
    _number("Improvement", "4 x 4 blocks: pixels unlike all pixels tested", 0, unlike_brute_force),
    _number(
        "Shared edges",
        "4 x 3 pixels of a split square: drawn, drawn twice",
        (12, 0),
        cover_counts,
        "shared-edge",
    ),
    _number("Shared edges", "centre on the left edge of a triangle: filled", True, on_upright_edge, True),
    _number("Shared edges", "centre on the right edge of a triangle: filled", False, on_upright_edge, False),
    _number("Texture mapping", "texel at (u, v) = (0, 0)", (0.0,), nearest_color, TEXTURE, 0.0, 0.0, "clamp"),
    _number("Texture mapping", "texel at (u, v) = (1, 1)", (4.0,), nearest_color, TEXTURE, 1.0, 1.0, "clamp"),
    _number(
        "Bilinear interpolation",
        "w_u = w_v = 1/2 between 0, 1, 2 and 4",
        (1.75,),
        bilinear_color,
        TEXTURE,
        0.5,
        0.5,
        "clamp",
    ),
    _number(
        "Step 2: projection to pixel coord.",
        "the constant function at the vertices",
        (1.0, 1.0, 1.0),
        constant_function,
    ),
    _number(
        "Step 2: projection to pixel coord.", "1/w midway between w = 1 and w = 3", 2 / 3, interpolated, "1/w"
    ),
    _number(
        "Step 2: projection to pixel coord.", "u = (u/w)/(1/w) there, from 0 to 1", 0.25, interpolated, "u"
    ),
    _number(
        "Z-buffering",
        "1/w = 1/2 over a stored 1/3: stored then, updated",
        (0.5, True),
        depth_test,
        1 / 2,
        1 / 3,
        True,
    ),
    _number(
        "Z-buffering",
        "1/w = 1/4 over a stored 1/3: stored then, updated",
        (1 / 3, False),
        depth_test,
        1 / 4,
        1 / 3,
        True,
    ),
    _number(
        "Z-buffering",
        "cells that do not hold the largest 1/w of three patches",
        0,
        lambda: cells_unlike(larger_is_nearer(), np.fmax),
    ),
)
