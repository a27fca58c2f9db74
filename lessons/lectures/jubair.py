"""Numbers of Jubair's lecture: barycentric coordinates, Cyrus-Beck with its table, z-buffer, box filter, culling."""

from functools import partial

import numpy as np

from core import Camera, Mesh, Scene, Settings, clip_lines, render, trace
from core.antialiasing.resolve import weighted_mean
from core.coverage.edge_formats import inverse_coefficients
from core.depth.depth import depth_test
from core.lines.line_clipping import ParameterRows, rectangle_window
from core.lines.parametric_clipping import cyrus_beck_listing
from core.methods import table
from lessons.lectures.clipping_and_projection import WINDOW
from lessons.lectures.printed import slide_number
from lessons.small_scenes import cells_unlike, rounded, triangles
from lessons.window_scenes import two_triangles, two_triangles_turned

SEGMENT = (-2.0, -1.0, 10.0, 8.0)
"""Crosses the lines of all four edges of the window 8 x 6."""
A, B, C = (0.0, 0.0), (8.0, 0.0), (0.0, 4.0)
"""A triangle of area 16."""
KNOWN_CASES = "Known Cases (1/1)"


def weights_of(x: float, y: float) -> tuple[float, ...]:
    """Return alpha, beta and gamma by the inverse, as the edge functions have them."""
    inverse, _ = inverse_coefficients([[*corner, 1.0] for corner in (A, B, C)])
    return rounded(np.array([a * x + b * y + c for a, b, c in zip(*inverse, strict=True)]))


def weights_by(way: str, x: float, y: float) -> tuple[float, ...]:
    """Return the same by the listing of a method of interpolation."""
    listing = table.get("interpolation", way).listing
    assert listing is not None
    return tuple(listing((A, B, C), x, y, (0.0, 0.0, 0.0))[0])


def drawn_color(column: int, row: int) -> tuple[float, ...]:
    """Return the colour of a pixel of the triangle with red, green and blue corners, 8 x 6."""
    colors = np.array([[[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]]], float)
    scene = triangles((A, B, C), colors=colors)
    return rounded(np.round(render(scene, Settings()).color[row, column, :3].astype(float), 6))


def border_pixels(fill_rule: str) -> int:
    """Return how many pixels are drawn of a triangle with centres on all three edges."""
    scene = triangles(((0.5, 0.5), (4.5, 0.5), (0.5, 4.5)))
    return int(np.count_nonzero(render(scene, Settings(fill_rule=fill_rule)).cover_count))


def side_of_left_edge(x: float) -> float:
    """Return N . (p - p_E) of the left edge x = 0."""
    window = rectangle_window(*WINDOW)
    return float(window.normals[0] @ (np.array([x, 3.0]) - window.points[0])) + 0.0


def edge_parameter(edge: int) -> float:
    """Return t of one edge by the method ``cyrus-beck``: left, right, bottom, top."""
    rows = clip_lines(np.reshape(SEGMENT, (1, 2, 2)), WINDOW, "cyrus-beck").rows
    assert isinstance(rows, ParameterRows)
    return float(rows.t[rows.edge == edge][0])


def normal_of(edge: int) -> tuple[int, ...]:
    """Return the outward normal of an edge of a rectangle."""
    return tuple(rectangle_window(*WINDOW).normals[edge].astype(int).tolist())


def entry_and_exit(x0: float, y0: float, x1: float, y1: float) -> tuple[float, float, bool]:
    """Return t_E, t_L and whether something is kept, by the listing of ``cyrus-beck``."""
    window = rectangle_window(*WINDOW)
    ends, seen = cyrus_beck_listing([x0, y0], [x1, y1], window.normals, window.points, ignores_parallel=False)
    return float(seen[-1][3]), float(seen[-1][4]), bool(ends)


def point_is_kept(x: float, y: float) -> bool:
    """Return whether a segment of no length is kept, by the listing as printed."""
    return bool(clip_lines([[[x, y], [x, y]]], WINDOW, "cyrus-beck-lecture").is_kept[0])


def infinite_cells() -> int:
    """Return how many cells of the slide's 8 x 8 a first fragment of any depth passes."""
    return int(np.count_nonzero(np.isposinf(trace(two_triangles()).stage("depth").state(0)["depth"])))


def culled(turned: bool) -> tuple[bool, bool]:
    """Return whether N . V > 0 for a triangle before the eye, or the same turned over, and whether it is culled."""
    positions = np.array([[-1.0, -1.0, -3.0], [1.0, -1.0, -3.0], [0.0, 1.0, -3.0]])
    face = (0, 2, 1) if turned else (0, 1, 2)
    a, b, c = positions[list(face)]
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]))
    frame = render(
        Scene((Mesh(positions, np.array([face])),), camera, (), (8, 6)), Settings(cull="back-normal")
    )
    return bool(np.cross(b - a, c - a) @ a > 0), not frame.cover_count.any()


X0, Y0, X1, Y1 = SEGMENT
_number = partial(slide_number, "Jubair")
NUMBERS = (
    _number(
        "Barycentric Interpolation (1/4)",
        "alpha + beta + gamma at (2, 1)",
        1.0,
        lambda: sum(weights_by("affine-equations", 2.0, 1.0)),
    ),
    _number(
        "Barycentric Interpolation (2/4)",
        "beta at (2, 1) = f_ac(2, 1) / f_ac(8, 0)",
        2.0 / 8.0,
        lambda: weights_by("affine-distances", 2.0, 1.0)[1],
    ),
    _number(
        "Barycentric Interpolation (4/4)",
        "A_a/A, A_b/A, A_c/A at (2, 1)",
        (0.5, 0.25, 0.25),
        weights_by,
        "affine-areas",
        2.0,
        1.0,
    ),
    _number(
        "Barycentric Interpolation (4/4)", "the same by the inverse", (0.5, 0.25, 0.25), weights_of, 2.0, 1.0
    ),
    _number(
        "Practice Problem",
        "P = (2, 1) inside: smallest weight above 0",
        True,
        lambda: min(weights_of(2.0, 1.0)) > 0,
    ),
    _number(
        "Practice Problem",
        "Q = (6, 3) outside: smallest weight above 0",
        False,
        lambda: min(weights_of(6.0, 3.0)) > 0,
    ),
    _number(
        "Triangle Rasterization (2/7)",
        "colour of pixel (1, 0): its weights at (1.5, 0.5)",
        (0.6875, 0.1875, 0.125),
        drawn_color,
        1,
        0,
    ),
    _number(
        "Triangle Rasterization (3/7)",
        "weights in [0, 1]: pixels of a triangle with 15",
        15,
        border_pixels,
        "inclusive",
    ),
    _number(
        "Triangle Rasterization (4/7)",
        "weights > 0: pixels of the same triangle",
        3,
        border_pixels,
        "exclusive",
    ),
    _number(
        "Edge-line Intersection (3/7)", "N . (p - p_E) outside the left edge", 2.0, side_of_left_edge, -2.0
    ),
    _number("Edge-line Intersection (4/7)", "N . (p - p_E) inside", -3.0, side_of_left_edge, 3.0),
    _number("Edge-line Intersection (5/7)", "N . (p - p_E) on the edge", 0.0, side_of_left_edge, 0.0),
    _number(KNOWN_CASES, "normal of the left edge", (-1, 0), normal_of, 0),
    _number(KNOWN_CASES, "normal of the right edge", (1, 0), normal_of, 1),
    _number(KNOWN_CASES, "normal of the bottom edge", (0, -1), normal_of, 2),
    _number(KNOWN_CASES, "normal of the top edge", (0, 1), normal_of, 3),
    _number(
        KNOWN_CASES,
        "t of the left edge, (-2, -1)-(10, 8) in 8 x 6",
        -(X0 - 0.0) / (X1 - X0),
        edge_parameter,
        0,
    ),
    _number(KNOWN_CASES, "t of the right edge", (X0 - 8.0) / -(X1 - X0), edge_parameter, 1),
    _number(KNOWN_CASES, "t of the bottom edge", -(Y0 - 0.0) / (Y1 - Y0), edge_parameter, 2),
    _number(KNOWN_CASES, "t of the top edge", (Y0 - 6.0) / -(Y1 - Y0), edge_parameter, 3),
    _number(
        "True Clipping Intersection (7/12)",
        "max of PE, min of PL, kept, of that segment",
        (1 / 6, 7 / 9, True),
        entry_and_exit,
        *SEGMENT,
    ),
    _number(
        "True Clipping Intersection (12/12)",
        "t_E > t_L, (-2, 5)-(2, 9): rejected",
        (0.5, 0.25, False),
        entry_and_exit,
        *(-2.0, 5.0, 2.0, 9.0),
    ),
    _number("Cyrus-Beck Algorithm (1/1)", "a point inside is kept", True, point_is_kept, 3.0, 2.0),
    _number("Cyrus-Beck Algorithm (1/1)", "a point outside is kept", False, point_is_kept, 9.0, 2.0),
    _number(
        "A Minimal 3D Pipeline (11/16)", "cells at infinity, which any fragment passes", 64, infinite_cells
    ),
    _number(
        "A Minimal 3D Pipeline (7/16)",
        "cells that do not hold the distance of the closest triangle, in either order",
        (0, 0),
        lambda: tuple(cells_unlike(make(), np.fmin) for make in (two_triangles, two_triangles_turned)),
    ),
    _number(
        "A Minimal 3D Pipeline (7/16)",
        "z = 5 over a stored 3: stored then, updated",
        (3.0, False),
        depth_test,
        5.0,
        3.0,
        False,
    ),
    _number(
        "Anti-aliasing (4/6)", "box filter of 0, 0, 1, 1", 0.5, weighted_mean, (0, 0, 1, 1), (1, 1, 1, 1)
    ),
    _number("Backface Culling (2/3)", "N away from the eye: N . V > 0, culled", (True, True), culled, True),
    _number("Backface Culling (2/3)", "N towards the eye: N . V > 0, culled", (False, False), culled, False),
)
