"""Meshes that the watertight law is tested on: closed ones in space, and tilings of the window."""

import numpy as np


def icosphere(subdivisions: int) -> tuple[np.ndarray, np.ndarray]:
    """Return positions (N, 3) on the unit sphere and triangles (T, 3), counter-clockwise from outside."""
    golden = (1 + 5**0.5) / 2
    corners = [(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0)]
    corners += [(0, -1, golden), (0, 1, golden), (0, -1, -golden), (0, 1, -golden)]
    corners += [(golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1)]
    positions = [np.array(corner) / np.linalg.norm(corner) for corner in corners]
    triangles = [
        (0, 11, 5),
        (0, 5, 1),
        (0, 1, 7),
        (0, 7, 10),
        (0, 10, 11),
        (1, 5, 9),
        (5, 11, 4),
        (11, 10, 2),
    ]
    triangles += [(10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5)]
    triangles += [(2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    found, faces = np.array(positions), np.array(triangles)
    for _ in range(subdivisions):
        ends = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
        edges, middle = np.unique(ends, axis=0, return_inverse=True)
        sums = found[edges[:, 0]] + found[edges[:, 1]]
        (i, j, k), (a, b, c) = faces.T, len(found) + middle.reshape(-1, 3).T
        found = np.concatenate([found, sums / np.linalg.norm(sums, axis=1, keepdims=True)])
        faces = np.stack([[i, a, c], [j, b, a], [k, c, b], [a, b, c]]).transpose(2, 0, 1).reshape(-1, 3)
    return found, faces


def torus(around: int, through: int, radius: float = 1.0, tube: float = 0.4) -> tuple[np.ndarray, np.ndarray]:
    """Return positions (N, 3) and 2 * around * through triangles, counter-clockwise from outside."""
    u, v = np.meshgrid(np.arange(around), np.arange(through), indexing="ij")
    long, short = 2 * np.pi * u.ravel() / around, 2 * np.pi * v.ravel() / through
    reach = radius + tube * np.cos(short)
    positions = np.stack([reach * np.cos(long), reach * np.sin(long), tube * np.sin(short)], axis=1)
    here, ahead = u * through + v, (u + 1) % around * through + v
    beside, across = u * through + (v + 1) % through, (u + 1) % around * through + (v + 1) % through
    quads = np.stack([here, ahead, across, here, across, beside], axis=-1)
    return positions, quads.reshape(-1, 3)


def clip_of_view(positions, triangles, eye, rotation, aspect: float = 1.0, near: float = 0.05) -> np.ndarray:
    """Return (T, 3, 4) clip positions seen from ``eye`` with a turned camera and a right angle of view."""
    camera = (np.asarray(positions) - eye) @ rotation.T
    x, y, z = camera.T
    clip = np.stack([x / aspect, y, -z - 2 * near, -z], axis=1)
    return clip[triangles]


def random_rotation(generator: np.random.Generator) -> np.ndarray:
    """Return a (3, 3) rotation, all directions alike."""
    q, r = np.linalg.qr(generator.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


def fan(hub, rim) -> np.ndarray:
    """Return (T, 3, k) triangles of a closed fan: hub (k,), rim (T, k) in counter-clockwise order."""
    rim = np.asarray(rim, float)
    return np.stack(
        [np.broadcast_to(np.asarray(hub, float), rim.shape), rim, np.roll(rim, -1, axis=0)], axis=1
    )


def tiling(generator: np.random.Generator, size: tuple[int, int], steps: int, points: int) -> np.ndarray:
    """Return window triangles (T, 3, 2) on the grid of 1/steps pixel that tile a square around the window.

    Points are put into the triangle they lie in, one after the other, and diagonals are turned at random:
    many slivers, many corners on pixel centres, no T-junction.
    """
    low, high = -2 * steps, (max(size) + 2) * steps
    corners = [(low, low), (high, low), (high, high), (low, high)]
    triangles = [(0, 1, 2), (0, 2, 3)]
    for x, y in generator.integers(low + 1, high, (points, 2)).tolist():
        sides = {t: _areas(corners, t, (x, y)) for t in triangles}
        inside = next((t for t, areas in sides.items() if min(areas) > 0), None)
        if inside is None:
            continue
        corners.append((x, y))
        i, j, k = inside
        new = len(corners) - 1
        triangles.remove(inside)
        triangles += [(i, j, new), (j, k, new), (k, i, new)]
        triangles = _turn_diagonal(generator, corners, triangles)
    return np.array([[corners[c] for c in t] for t in triangles], float) / steps


def _area(a, b, c) -> int:
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])


def _areas(corners, triangle, point) -> list[int]:
    i, j, k = (corners[c] for c in triangle)
    return [_area(i, j, point), _area(j, k, point), _area(k, i, point)]


def _turn_diagonal(generator: np.random.Generator, corners, triangles) -> list[tuple[int, int, int]]:
    """Turn the diagonal of one random pair of neighbours whose four corners are convex."""
    owner = {(t[n], t[(n + 1) % 3]): t for t in triangles for n in range(3)}
    edges = [edge for edge in owner if edge[::-1] in owner]
    i, j = edges[int(generator.integers(len(edges)))]
    first, second = owner[i, j], owner[j, i]
    k = next(c for c in first if c not in (i, j))
    m = next(c for c in second if c not in (i, j))
    turned = [(k, i, m), (k, m, j)]
    if min(_area(*(corners[c] for c in t)) for t in turned) <= 0:
        return triangles
    return [t for t in triangles if t not in (first, second)] + turned
