"""Random corners, meshes, matrices and values that the cases of `app.opengl_check.families` are made of."""

import numpy as np

from core.raster.edges.snapping import SUBPIXELS
from core.records.arrays import Floats, Integers, Singles


def grid_corners(rng: np.random.Generator, size: tuple[int, int], count: int) -> Floats:
    """Return random window positions (count, 2) in pixels, put on one of the grids of `put_on_grid`."""
    points = rng.uniform(0, 1, (count, 2)) * size
    return put_on_grid(rng, points)


def put_on_grid(rng: np.random.Generator, points: Floats) -> Floats:
    """Move window positions (N, 2) to pixel centres, corners, half pixels, 1/256 pixel, or 0.3/256 beside."""
    kind = rng.integers(5)
    if kind == 0:
        return np.floor(points) + 0.5
    if kind == 1:
        return np.rint(points)
    if kind == 2:
        return np.rint(points * 2) / 2
    snapped = np.rint(points * SUBPIXELS)
    return (snapped if kind == 3 else snapped + rng.uniform(-0.3, 0.3, points.shape)) / SUBPIXELS


def gradual_values(rng: np.random.Generator, shape: tuple[int, ...]) -> Singles:
    """Return values from 0 to 1 in steps of 1/256 (float32): short numbers, which keep files small."""
    return (rng.integers(0, 257, shape) / 256).astype(np.float32)


def fan(rng: np.random.Generator, size: tuple[int, int]) -> tuple[Floats, Integers]:
    """Return a fan around a hub: window positions (N, 2) and triangles (N - 1, 3)."""
    count = int(rng.integers(5, 13))
    angles = (np.arange(count) + rng.uniform(0.1, 0.9, count)) * 2 * np.pi / count
    radius = rng.uniform(0.5, 0.95, count) * min(size) / 2
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1) * radius[:, None]
    points = put_on_grid(rng, np.concatenate([np.zeros((1, 2)), ring]) + np.array(size) / 2)
    rim = np.arange(count)
    return points, np.stack([np.zeros(count, int), rim + 1, (rim + 1) % count + 1], axis=1)


def grid_mesh(rng: np.random.Generator, size: tuple[int, int]) -> tuple[Floats, Integers]:
    """Return a grid, jittered or not, each cell cut along a diagonal: positions (N, 2), triangles (T, 3)."""
    columns, rows = (int(n) for n in rng.integers(2, 7, 2))
    x, y = np.meshgrid(np.linspace(0.06, 0.94, columns + 1), np.linspace(0.06, 0.94, rows + 1))
    points = np.stack([x.ravel(), y.ravel()], axis=1) * size
    if rng.random() < 0.7:
        points += rng.uniform(-0.25, 0.25, points.shape) * np.array(size) / (columns, rows)
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    a, b, c, d = corner, corner + 1, corner + columns + 2, corner + columns + 1
    falls = (rng.random(len(corner)) < 0.5)[:, None]
    first = np.where(falls, np.stack([a, b, c], 1), np.stack([a, b, d], 1))
    second = np.where(falls, np.stack([a, c, d], 1), np.stack([b, c, d], 1))
    return put_on_grid(rng, points), np.concatenate([first, second])


def turned(rng: np.random.Generator, triangles: Integers) -> Integers:
    """Return triangles (T, 3) in another order, with other first corners and windings."""
    triangles = triangles[rng.permutation(len(triangles))]
    first = rng.integers(0, 3, (len(triangles), 1))
    step = np.where(rng.random((len(triangles), 1)) < 0.5, 1, -1)
    corner = (first + step * np.arange(3)) % 3
    return np.take_along_axis(triangles, corner.astype(np.int64), axis=1)


def perspective_matrix(field_of_view: float, aspect: float, near: float, far: float) -> Floats:
    """Return the (4, 4) matrix from camera space, looking along -z, to clip space; the angle in radians."""
    scale = 1 / np.tan(field_of_view / 2)
    depth, offset = (far + near) / (near - far), 2 * far * near / (near - far)
    return np.array([[scale / aspect, 0, 0, 0], [0, scale, 0, 0], [0, 0, depth, offset], [0, 0, -1, 0]])


def random_rotation(rng: np.random.Generator) -> Floats:
    """Return a (4, 4) rotation about a random axis."""
    a, b, c, d = rng.normal(size=4)
    x, y, z, s = np.array([a, b, c, d]) / np.sqrt(a * a + b * b + c * c + d * d)
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - s * z), 2 * (x * z + s * y)],
        [2 * (x * y + s * z), 1 - 2 * (x * x + z * z), 2 * (y * z - s * x)],
        [2 * (x * z - s * y), 2 * (y * z + s * x), 1 - 2 * (x * x + y * y)],
    ]
    return matrix


def icosphere(subdivisions: int) -> tuple[Floats, Floats, Integers]:
    """Return a sphere of radius 1: points (N, 3), normals (N, 3), triangles (20 * 4 ** subdivisions, 3)."""
    golden = (1 + np.sqrt(5)) / 2
    points = [(x, y, 0.0) for x in (-1.0, 1.0) for y in (-golden, golden)]
    points = [tuple(np.roll(point, turn)) for turn in range(3) for point in points]
    vertices = np.array(points) / np.sqrt(1 + golden * golden)
    distance = np.sqrt(((vertices[:, None] - vertices[None]) ** 2).sum(axis=2))
    is_near = (distance > 0) & (distance < 1.1)
    triangles = np.array(
        [
            (i, j, k)
            for i in range(12)
            for j in range(i + 1, 12)
            for k in range(j + 1, 12)
            if is_near[i, j] and is_near[j, k] and is_near[i, k]
        ]
    )
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    is_inward = (np.cross(b - a, c - a) * (a + b + c)).sum(axis=1) < 0
    triangles[is_inward] = triangles[is_inward][:, ::-1]
    for _ in range(subdivisions):
        corners = vertices[triangles]
        middle = corners + corners[:, [1, 2, 0]]
        middle /= np.sqrt((middle**2).sum(axis=2, keepdims=True))
        a, b, c = (corners[:, k] for k in range(3))
        ab, bc, ca = (middle[:, k] for k in range(3))
        pieces = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        flat = np.concatenate([np.stack(piece, axis=1) for piece in pieces]).reshape(-1, 3)
        _, first, index = np.unique(np.round(flat, 9), axis=0, return_index=True, return_inverse=True)
        vertices, triangles = flat[first], index.reshape(-1, 3)
    return vertices, vertices, triangles


def torus(around: int, across: int) -> tuple[Floats, Floats, Integers]:
    """Return a torus of radii 0.8 and 0.35: points, normals (N, 3), 2 * around * across triangles (T, 3)."""
    i, j = (index.ravel() for index in np.meshgrid(np.arange(around), np.arange(across), indexing="ij"))
    u, v = i * 2 * np.pi / around, j * 2 * np.pi / across
    normals = np.stack([np.cos(u) * np.cos(v), np.sin(u) * np.cos(v), np.sin(v)], axis=1)
    points = 0.8 * np.stack([np.cos(u), np.sin(u), np.zeros_like(u)], axis=1) + 0.35 * normals
    ni, nj = (i + 1) % around, (j + 1) % across
    a, b, c, d = i * across + j, ni * across + j, ni * across + nj, i * across + nj
    return points, normals, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
