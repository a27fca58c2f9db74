"""Numbers of LMU's tutorial: Liang-Barsky, z-fighting, the complete Bresenham, the scanline fill, three.js."""

from functools import partial

import numpy as np

from core import Settings, clip_lines, draw_lines, render
from core.coverage.scanline import draw_triangle
from core.framebuffer.display import encode_srgb
from core.lines.line_clipping import ParameterRows
from core.methods import table
from core.scene import Camera
from core.transform.matrices import projection, scaling, transform
from lessons.lectures.clipping_and_projection import WINDOW, printed_depth_of
from lessons.lectures.printed import slide_number
from lessons.lectures.scenes import VERTICES, three_js_triangle
from lessons.shapes import linear_color
from lessons.small_scenes import cells_unlike
from lessons.window_scenes import equal_depths

SEGMENT = (-2.0, 1.0, 6.0, 5.0)
LIANG_BARSKY, THREE_JS = "Liang-Barsky Algorithm", "Task 2 g) three.js construction"
SCANLINE = "Task 1 g) Scan Line Algorithm for Triangles (cont.)"


def p_or_q(name: str) -> tuple[float, ...]:
    """Return p, q or t of left, right, bottom and top by the method ``liang-barsky``."""
    rows = clip_lines(np.reshape(SEGMENT, (1, 2, 2)), WINDOW, "liang-barsky").rows
    assert isinstance(rows, ParameterRows)
    values = {"p": rows.along, "q": rows.room, "t": rows.t}[name]
    return tuple(float(value) for value in values[rows.edge >= 0])


def outcome(x0: float, y0: float, x1: float, y1: float) -> bool:
    """Return whether something of a segment is kept."""
    return bool(clip_lines([[[x0, y0], [x1, y1]]], WINDOW, "liang-barsky").is_kept[0])


def depth_step(z: float) -> float:
    """Return by how much z_perp changes over 0.1 from z on, away from the eye."""
    return abs(printed_depth_of(z - 0.1) - printed_depth_of(z))


def orthographic_steps() -> float:
    """Return the ratio of the steps of depth over 0.1 near and far, of an orthographic camera."""
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]), projection="orthographic", near=1.0, far=10.0)
    points = np.array([[0.0, 0.0, z, 1.0] for z in (-1.0, -1.1, -9.9, -10.0)])
    depths = transform(projection(camera, 1.0), points)[:, 2]
    return round(float((depths[1] - depths[0]) / (depths[3] - depths[2])), 9)


def unlike_complete() -> int:
    """Return how many of 225 lines from (7, 7) to a pixel of 15 x 15 the rule draws otherwise than the listing."""
    listing = table.get("line", "bresenham-lecture").listing
    assert listing is not None
    unlike = 0
    for x in range(15):
        for y in range(15):
            drawn = draw_lines([[[7, 7], [x, y]]], 15, 15, "bresenham-lecture", pixel_center="integer")
            listed = [pixel[:2] for pixel in listing(7, 7, x, y, True)]
            unlike += listed != [tuple(pixel) for pixel in drawn.pixels.tolist()]
    return unlike


def scanlines(*corners: tuple[float, float]) -> int:
    """Return how many lines the fill draws of a triangle."""
    first, second, third = corners
    return len(draw_triangle(first, second, third, 16))


def drawn_pixels(face: tuple[int, int, int]) -> bool:
    """Return whether back-face culling leaves anything of the three.js triangle."""
    return bool(render(three_js_triangle(face), Settings(cull="back")).cover_count.any())


def byte_color(color: str) -> tuple[int, ...]:
    """Return the bytes on the screen of a colour that went through linear light."""
    return tuple(encode_srgb(linear_color(color)[None, :3].astype(np.float32))[0].tolist())


def bresenham_step(ends: tuple[float, float]) -> tuple[int, ...]:
    """Return the pixel after (0, 0) on the line to (dx, dy)."""
    drawn = draw_lines([[(0, 0), ends]], 16, 16, "bresenham-float", last_pixel=True, pixel_center="integer")
    return tuple(drawn.pixels[1].tolist())


_number = partial(slide_number, "LMU")
NUMBERS = (
    _number(LIANG_BARSKY, "p1 to p4 of (-2, 1)-(6, 5) in 8 x 6", (-8.0, 8.0, -4.0, 4.0), p_or_q, "p"),
    _number(LIANG_BARSKY, "q1 to q4", (-2.0, 10.0, 1.0, 5.0), p_or_q, "q"),
    _number(LIANG_BARSKY, "t1 to t4 = q/p", (0.25, 1.25, -0.25, 1.25), p_or_q, "t"),
    _number(LIANG_BARSKY, "p = 0 and q < 0, (2, 8)-(6, 8): kept", False, outcome, 2.0, 8.0, 6.0, 8.0),
    _number(LIANG_BARSKY, "t_max > t_min, (-2, 5)-(2, 9): kept", False, outcome, -2.0, 5.0, 2.0, 9.0),
    _number(
        "Frame and Depth Buffers",
        "cells that do not hold the current minimum z-value, two patches of one depth",
        0,
        lambda: cells_unlike(equal_depths(), np.fmin),
    ),
    _number(
        "Task 1 d) Z-fighting: Case 1 - Depth values are very close",
        "0.1 + 0.2",
        "0.30000000000000004",
        lambda: repr(0.1 + 0.2),
    ),
    _number(
        "Task 1 d) Z-fighting: Case 2 - Close to far plane",
        "step of depth at n = -1 over that at f = -10 is above 50",
        True,
        lambda: depth_step(-1.0) > 50 * depth_step(-9.9),
    ),
    _number(
        "Task 1 d) Z-fighting: Case 2 - Close to far plane",
        "the same ratio of an orthographic camera",
        1.0,
        orthographic_steps,
    ),
    _number("Bresenham Algorithm", "e + m = 0.6 > 0.5: next pixel", (1, 1), bresenham_step, (5, 3)),
    _number("Bresenham Algorithm", "e + m = 0.4 <= 0.5: next pixel", (1, 0), bresenham_step, (5, 2)),
    _number("Bresenham Algorithm", "e + m = 0.5 <= 0.5: next pixel", (1, 0), bresenham_step, (4, 2)),
    _number(
        "Task 1 g) Bresenham (complete version)",
        "rule and listing differ on lines of 225",
        0,
        unlike_complete,
    ),
    _number(SCANLINE, "lines of (2, 12), (9, 7), (4, 1)", 12, scanlines, (2, 12), (9, 7), (4, 1)),
    _number(THREE_JS, "face (0, 2, 1): drawn with back faces culled", True, drawn_pixels, (0, 2, 1)),
    _number(THREE_JS, "face (0, 1, 2): drawn with back faces culled", False, drawn_pixels, (0, 1, 2)),
    _number(THREE_JS, "0x3399ff on the screen", (51, 153, 255), byte_color, "#3399ff"),
    _number(THREE_JS, "0x00ffff on the screen", (0, 255, 255), byte_color, "#00ffff"),
    _number(THREE_JS, "0x5500ee on the screen", (85, 0, 238), byte_color, "#5500ee"),
    _number(
        "Task 2 g) GLSL shaders",
        "first vertex, scaled by 1.5, 0.5 and 2",
        (-7.5, -1.5, -20.0),
        lambda: tuple(transform(scaling(1.5, 0.5, 2.0), np.append(VERTICES[:1], 1.0)[None])[0, :3].tolist()),
    ),
    _number(
        "Minimum Fragment Shader (WebGL 2)",
        "vec4(1, 1, 0, 1) on the screen",
        (255, 255, 0),
        byte_color,
        "#ffff00",
    ),
)
