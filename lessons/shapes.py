"""Meshes by formula: cube, sphere, torus, knot, floor, Utah teapot; counter-clockwise outside, with normals, UVs.

Body, lid and bottom are curves that turn about the z axis; handle and spout are given for one side and mirrored.
"""

from math import pi

import numpy as np

from core.framebuffer.display import linear_light
from core.records.arrays import Floats, Integers
from core.scene import Mesh, Texture
from core.tessellation.patches import mesh_of_patches

# Meshes by formula: cube, sphere, torus, knot, floor; counter-clockwise outside, with normals and UVs.


FACE_COLORS = ("#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#F0E442")
"""sRGB colours that colour-blind people tell apart (M. Okabe, K. Ito, 2008)."""

MARK = ("######", "#.....", "#####.", "#.....", "#.....", "#.....")
"""The letter F, rows from the top: it looks different however a texture is turned or mirrored."""


RED_GREEN_BLUE = np.array([[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]])


def linear_color(srgb: str) -> Floats:
    """Return ``#rrggbb`` as (4,) float64 linear colour with alpha 1."""
    return np.append(linear_light(np.array([int(srgb[k : k + 2], 16) for k in (1, 3, 5)]) / 255), 1.0)


def grid_triangles(columns: int, rows: int) -> tuple[Integers, Integers]:
    """Split a grid of ``columns`` x ``rows`` cells into triangles.

    Vertex (i, j) has the number ``j (columns + 1) + i``; seen with i to the right and j up, all turn
    counter-clockwise.

    Returns
    -------
    triangles : (2 columns rows, 3) int64
    faces : (2 columns rows,) int64
        The cell of each triangle.
    """
    i, j = np.meshgrid(np.arange(columns), np.arange(rows))
    first = (j * (columns + 1) + i).ravel()
    second, third, fourth = first + 1, first + columns + 2, first + columns + 1
    triangles = np.stack([first, second, third, first, third, fourth], axis=1).reshape(-1, 3)
    return triangles, np.repeat(np.arange(columns * rows), 2)


def grid_angles(columns: int, rows: int) -> tuple[Floats, Floats, Floats]:
    """Return angle around, fraction along and UVs of the vertices of a grid whose columns close to a ring.

    Returns
    -------
    around : ((columns + 1) (rows + 1),) float64
        Radians; the last column has the very angle of the first, so that the seam has no gap.
    along : same shape, float64
        0 to 1.
    uvs : ((columns + 1) (rows + 1), 2) float64
    """
    i, j = np.meshgrid(np.arange(columns + 1), np.arange(rows + 1))
    around = np.asarray(2 * pi * (i.ravel() % columns) / columns, np.float64)
    uvs: Floats = np.stack([i.ravel() / columns, j.ravel() / rows], axis=1)
    return around, uvs[:, 1], uvs


def cube(side: float = 2.0) -> Mesh:
    """Return a cube around the origin: six faces of one colour each, which share no vertices."""
    triangles: list[tuple[int, int, int]] = []
    positions: list[Floats] = []
    normals: list[Floats] = []
    for axis in range(3):
        for sign in (1.0, -1.0):
            normal, across, up = np.roll(np.eye(3), axis, axis=1)
            normal, across = normal * sign, across * sign
            square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
            first = len(positions)
            positions += [(normal + a * across + b * up) * (side / 2) for a, b in square]
            normals += [normal] * 4
            triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return Mesh(
        positions=np.array(positions),
        triangles=np.array(triangles),
        normals=np.array(normals),
        uvs=np.tile([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], (6, 1)),
        colors=np.repeat([linear_color(color) for color in FACE_COLORS], 4, axis=0),
        faces=np.repeat(np.arange(6), 2),
        name="cube",
    )


def sphere(radius: float = 1.0, columns: int = 48, rows: int = 24) -> Mesh:
    """Return a sphere around the origin: a grid of longitude and latitude whose poles are fans."""
    around, along, uvs = grid_angles(columns, rows)
    height = -np.cos(pi * along)
    ring = np.where((along == 0) | (along == 1), 0.0, np.sin(pi * along))
    normals = np.stack([ring * np.sin(around), height, ring * np.cos(around)], axis=1)
    triangles, faces = grid_triangles(columns, rows)
    is_flat = (triangles // (columns + 1) == 0).sum(axis=1) == 2
    is_flat |= (triangles // (columns + 1) == rows).sum(axis=1) == 2
    return Mesh(
        positions=radius * normals,
        triangles=triangles[~is_flat],
        normals=normals,
        uvs=uvs,
        faces=faces[~is_flat],
        name="sphere",
    )


def torus(ring: float = 0.8, tube: float = 0.35, columns: int = 64, rows: int = 32) -> Mesh:
    """Return a torus around the y axis: its tube of radius ``tube`` is ``ring`` from the origin."""
    around, _, uvs = grid_angles(columns, rows)
    section = np.repeat((2 * pi / rows) * (np.arange(rows + 1) % rows), columns + 1)
    outward = np.stack([np.sin(around), np.zeros_like(around), np.cos(around)], axis=1)
    normals = np.cos(section)[:, None] * outward + np.sin(section)[:, None] * np.array([0.0, 1.0, 0.0])
    triangles, faces = grid_triangles(columns, rows)
    return Mesh(ring * outward + tube * normals, triangles, normals, uvs, faces=faces, name="torus")


def knot(tube: float = 0.28, columns: int = 500, rows: int = 20) -> Mesh:
    """Return a tube around the trefoil, the torus knot (2, 3): ``2 columns rows`` triangles.

    The tube's circles lie in the plane of the curve's normal and binormal (the Frenet frame). The curve
    bends everywhere, so the frame turns smoothly and comes back to where it began.
    """
    t, _, uvs = grid_angles(columns, rows)
    section = np.repeat((2 * pi / rows) * (np.arange(rows + 1) % rows), columns + 1)

    def derivative(order: int) -> Floats:
        # The curve is a sum of sines, whose derivatives are sines a quarter turn on.
        def sine(frequency: int, phase: float) -> Floats:
            return float(frequency) ** order * np.sin(frequency * t + phase + order * pi / 2)

        x, y, z = sine(1, 0) + 2 * sine(2, 0), sine(1, pi / 2) - 2 * sine(2, pi / 2), -sine(3, 0)
        return np.stack([x, y, z], axis=1) / 2

    tangent, bend = derivative(1), derivative(2)
    binormal = np.cross(tangent, bend)
    binormal /= np.linalg.norm(binormal, axis=1, keepdims=True)
    inward = np.cross(binormal, tangent)
    inward /= np.linalg.norm(inward, axis=1, keepdims=True)
    normals = np.cos(section)[:, None] * inward - np.sin(section)[:, None] * binormal
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    triangles, faces = grid_triangles(columns, rows)
    return Mesh(derivative(0) + tube * normals, triangles, normals, uvs, faces=faces, name="knot")


def floor(half: float = 20.0, tiles: float = 20.0) -> Mesh:
    """Return a square of two triangles in the plane y = 0 with a texture that repeats ``tiles`` times."""
    corners = np.array([[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]])
    return Mesh(
        positions=half * corners,
        triangles=np.array([[0, 1, 2], [0, 2, 3]]),
        normals=np.tile([0.0, 1.0, 0.0], (4, 1)),
        uvs=tiles * np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
        texture=checkerboard(),
        faces=np.array([0, 0]),
        name="floor",
    )


def plates(half: float = 1.1, gap: float = 0.0016) -> tuple[Mesh, Mesh]:
    """Return two squares that lean back, a blue one and then an orange one ``gap`` in front of it and to its left.

    The plate behind comes first: where both get the same stored depth, the first one stays.
    """
    corners = np.array([[-1.0, -1.0, 0.5], [1.0, -1.0, 0.5], [1.0, 1.0, -0.5], [-1.0, 1.0, -0.5]]) * half
    normal = np.array([0.0, 1.0, 2.0]) / 5**0.5

    def plate(name: str, color: str, place: Floats) -> Mesh:
        return Mesh(
            positions=corners + place,
            triangles=np.array([[0, 1, 2], [0, 2, 3]]),
            normals=np.tile(normal, (4, 1)),
            colors=np.tile(linear_color(color), (4, 1)),
            faces=np.array([0, 0]),
            name=name,
        )

    aside = np.array([0.35, 0.0, 0.0])
    return (
        plate("plate behind", FACE_COLORS[0], aside),
        plate("plate in front", FACE_COLORS[1], gap * normal - aside),
    )


def checkerboard(square: int = 16) -> Texture:
    """Return a texture of 2 x 2 squares of ``square`` texels, with the letter F in the one at (0, 0)."""
    light, dark, ink = (linear_color(color)[:3] for color in ("#E8E8E8", "#404850", "#D55E00"))
    row, column = np.divmod(np.arange((2 * square) ** 2), 2 * square)
    is_light = (row // square + column // square) % 2 == 0
    pixels = np.where(is_light[:, None], light, dark).reshape(2 * square, 2 * square, 3)

    # The letter, each of its cells two by two texels, in the middle of the square; row 0 is its foot.
    letter = (
        np.array([[cell == "#" for cell in line] for line in MARK[::-1]]).repeat(2, axis=0).repeat(2, axis=1)
    )
    start = (square - len(letter)) // 2
    pixels[start : start + len(letter), start : start + len(letter)][letter] = ink
    return Texture(pixels.astype(np.float32), name="checkerboard with an F")


# The Utah teapot: the Bezier patches of M. Newell, tessellated.


QUARTER = 0.56
"""How far the inner control points of a quarter turn stand off, for radius 1: Newell's round number for 0.5523."""

CURVES = (
    ((1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)),
    ((1.5, 2.4), (1.75, 1.875), (2.0, 1.35), (2.0, 0.9)),
    ((2.0, 0.9), (2.0, 0.45), (1.5, 0.225), (1.5, 0.15)),
    ((0.0, 3.15), (0.8, 3.15), (0.0, 2.85), (0.2, 2.7)),
    ((0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4)),
    ((1.5, 0.15), (1.5, 0.075), (1.425, 0.0), (0.0, 0.0)),
)
"""Rim, body, foot, knob, lid and bottom: radius and height of four control points each."""

HANDLE = (
    ((-1.6, 2.025), (-1.5, 2.25), 0.3),
    ((-2.3, 2.025), (-2.5, 2.25), 0.3),
    ((-2.7, 2.025), (-3.0, 2.25), 0.3),
    ((-2.7, 1.8), (-3.0, 1.8), 0.3),
    ((-2.7, 1.575), (-3.0, 1.35), 0.3),
    ((-2.5, 1.125), (-2.65, 0.9375), 0.3),
    ((-2.0, 0.9), (-1.9, 0.6), 0.3),
)
SPOUT = (
    ((1.7, 1.425), (1.7, 0.6), 0.66),
    ((2.6, 1.425), (3.1, 0.825), 0.66),
    ((2.3, 2.1), (2.4, 2.025), 0.25),
    ((2.7, 2.4), (3.3, 2.4), 0.25),
    ((2.8, 2.475), (3.525, 2.49375), 0.25),
    ((2.9, 2.475), (3.45, 2.5125), 0.15),
    ((2.8, 2.4), (3.2, 2.4), 0.15),
)
"""Rows of control points of two patches that share the fourth row: both ends (x, z) at y = 0, and the half width."""


def patches() -> Floats:
    """Return the control points as (32, 4, 4, 3) float64, z up; seen from outside, the second index turns left.

    References
    ----------
    M. Newell, The utilization of procedure models in digital image synthesis, 1975; F. C. Crow, The origins of the
    teapot, 1987.
    """
    found = [_turned(np.array(curve), quarter) for curve in CURVES for quarter in range(4)]
    for rows in (HANDLE, SPOUT):
        tube = np.array([[(a, 0, b), (a, half, b), (c, half, d), (c, 0, d)] for (a, b), (c, d), half in rows])
        for half_tube in (tube[:4], tube[3:]):
            # One mirror turns the patch over, so the other side runs along its rows backwards.
            found += [half_tube, (half_tube * (1, -1, 1))[:, ::-1]]
    return np.array(found)


def _turned(curve: Floats, quarter: int) -> Floats:
    """Return the patch (4, 4, 3) of a curve (4, 2) of radius and height, turned through one quarter."""
    arc = np.array([(1, 0), (1, QUARTER), (QUARTER, 1), (0, 1)])
    for _ in range(quarter):
        arc = np.stack([-arc[:, 1], arc[:, 0]], axis=1)
    radius, height = curve[:, 0, None, None], np.broadcast_to(curve[:, 1, None, None], (4, 4, 1))
    return np.concatenate([radius * arc, height], axis=2)


def teapot(segments: int = 6, height: float = 1.3) -> Mesh:
    """Return the teapot around the origin, y up: 32 patches, each cut into ``segments`` x ``segments`` cells at first.

    The first row of the knob and the last one of the bottom are single points: their cells keep one triangle, and
    their normals point along the axis. Patches do not share vertices, but those on a common border are equal.
    """
    control = patches()
    top = control[..., 2].max()
    control = (height / top) * (control - (0, 0, top / 2))[..., [0, 2, 1]] * (1, 1, -1)
    return mesh_of_patches(control, segments, name="teapot")
