"""From the polygons of a file to triangles that share vertices."""

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.files.mesh_formats.reading import MeshFileError
from core.records.arrays import Floats, Integers


def check_polygons(path: Path, sizes: Integers, indices: NDArray[Any], count: int) -> None:
    """Raise MeshFileError for a polygon of fewer than 3 corners or one that names a vertex that is not there.

    Parameters
    ----------
    path : Path
        The file, for the message.
    sizes : (P,) int64
    indices : (sum of sizes,) of any numbers
        Vertices of all corners, from 0.
    count : int
        Vertices that there are.
    """
    if sizes.min() < 3:
        face = int(np.argmax(sizes < 3))
        raise MeshFileError(f"{path.name}: face {face} needs at least 3 corners, it has {sizes[face]}")
    wrong = ~((indices >= 0) & (indices < count) & (indices == np.floor(indices)))
    if wrong.any():
        corner = int(np.argmax(wrong))
        face = int(np.searchsorted(np.cumsum(sizes), corner, side="right"))
        raise MeshFileError(
            f"{path.name}: face {face} names vertex {indices[corner]:g}, the file has {count}, counted from 0"
        )


def fan(sizes: Integers) -> tuple[Integers, Integers]:
    """Split polygons into triangles around their first corner.

    Parameters
    ----------
    sizes : (P,) int64
        Corners of each polygon, at least 3; the corners of all polygons stand in one row.

    Returns
    -------
    corners : (T, 3) int64
        Places in the row of corners; triangles of a polygon stand together, in the order of the polygons.
    faces : (T,) int64
        The polygon of each triangle.
    """
    first = np.cumsum(sizes) - sizes
    counts = sizes - 2
    faces = np.repeat(np.arange(len(sizes)), counts)
    turn = np.arange(len(faces)) - np.repeat(np.cumsum(counts) - counts, counts)
    start = first[faces]
    return np.stack([start, start + turn + 1, start + turn + 2], axis=1), faces


def triangulate_polygons(vertices: Floats, indices: Integers, sizes: Integers) -> tuple[Integers, Integers]:
    """Split polygons into triangles: by a fan, or by cutting ears where a polygon is not convex.

    Parameters
    ----------
    vertices : (N, 3) float64
        Positions.
    indices : (C,) int64
        Vertices of the corners of all polygons, one polygon after the other.
    sizes : (P,) int64

    Returns
    -------
    corners : (T, 3) int64
    faces : (T,) int64
        As ``fan``.
    """
    if (sizes == 3).all():
        return np.arange(len(indices)).reshape(-1, 3), np.arange(len(sizes))
    corners, faces = fan(sizes)
    positions = vertices[indices]
    a, b, c = (positions[corners[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    count = len(sizes)
    polygon_normals = np.stack([np.bincount(faces, normals[:, k], count) for k in range(3)], axis=1)

    # A triangle of the fan that faces against its polygon shows a polygon that the fan leaves.
    against = (normals * polygon_normals[faces]).sum(axis=1) < 0
    for face in np.unique(faces[against]):
        first = int(sizes[:face].sum())
        inside = positions[first : first + sizes[face]]
        corners[faces == face] = first + cut_ears(inside, polygon_normals[face])
    return corners, faces


def cut_ears(positions: Floats, normal: Floats) -> Integers:
    """Triangulate one simple polygon by cutting off its ears.

    Parameters
    ----------
    positions : (n, 3) float64
    normal : (3,) float64
        Its normal, of any length.

    Returns
    -------
    (n - 2, 3) int64
        Corners of the triangles. A polygon that crosses itself runs out of ears at some point: what is
        left then is split as a fan.

    References
    ----------
    G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82, 1975.
    """
    # Drop the axis that the polygon faces most, keeping the sense of rotation.
    axis = int(np.argmax(np.abs(normal)))
    flat = positions[:, [(axis + 1) % 3, (axis + 2) % 3]] * np.array([np.sign(normal[axis]) or 1.0, 1.0])

    def turn(p: int, q: int, r: int) -> float:
        (px, py), (qx, qy), (rx, ry) = flat[p], flat[q], flat[r]
        return float((qx - px) * (ry - py) - (qy - py) * (rx - px))

    left = list(range(len(positions)))
    triangles = []
    while len(left) > 3:
        for place in range(len(left)):
            before, tip, after = left[place - 1], left[place], left[(place + 1) % len(left)]
            others = [k for k in left if k not in (before, tip, after)]
            if turn(before, tip, after) > 0 and not any(
                turn(before, tip, k) >= 0 and turn(tip, after, k) >= 0 and turn(after, before, k) >= 0
                for k in others
            ):
                triangles.append((before, tip, after))
                del left[place]
                break
        else:
            break
    triangles += [(left[0], q, r) for q, r in pairwise(left[1:])]
    return np.array(triangles, np.int64)


def share_vertices(*indices: Integers) -> tuple[Integers, tuple[Integers, ...]]:
    """Make one vertex of all corners that agree in every index.

    Parameters
    ----------
    *indices : (T, 3) int64
        Numbers of position, texture coordinate, ...; -1 where a corner has none.

    Returns
    -------
    triangles : (T, 3) int64
        The vertices, which are in the order of the first index.
    sources : tuple of (N,) int64
        For each of ``indices``, the number that each vertex came with.
    """
    code = indices[0].ravel()
    for more in indices[1:]:
        width = int(more.max()) + 2
        code = np.unique(code * width + more.ravel() + 1, return_inverse=True)[1]
    if np.ptp(code) > 8 * len(code):
        code = np.unique(code, return_inverse=True)[1]
    code = code - code.min()
    corner_of = np.full(int(code.max()) + 1, -1)
    corner_of[code] = np.arange(len(code))
    is_used = corner_of >= 0
    triangles = (np.cumsum(is_used) - 1)[code].reshape(-1, 3)
    return triangles, tuple(more.ravel()[corner_of[is_used]] for more in indices)
