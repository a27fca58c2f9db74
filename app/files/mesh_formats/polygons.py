"""From the polygons of a file to triangles that share vertices."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.files.mesh_formats.reading import MeshFileError, Report
from core.records.arrays import Floats, Integers

REPORT_POLYGONS = 5000
"""Polygons between two reports."""


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
        raise MeshFileError(f"{path.name}: face {face} needs at least 3 corners, got {sizes[face]}")
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


def triangulate_polygons(
    vertices: Floats, indices: Integers, sizes: Integers, report: Report
) -> tuple[Integers, Integers]:
    """Split polygons into triangles: by a fan, or by cutting ears where a polygon is not convex.

    Parameters
    ----------
    vertices : (N, 3) float64
        Positions.
    indices : (C,) int64
        Vertices of the corners of all polygons, one polygon after the other.
    sizes : (P,) int64
    report : callable
        Told that there is something to do, many times where there is much.

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
    against = np.unique(faces[(normals * polygon_normals[faces]).sum(axis=1) < 0])
    first_corner, first_triangle = np.cumsum(sizes) - sizes, np.cumsum(sizes - 2) - (sizes - 2)
    # The fan of a quad leaves it where its other diagonal does not.
    quads = against[sizes[against] == 4]
    for row, turned in enumerate(((3, 0, 1), (1, 2, 3))):
        corners[first_triangle[quads] + row] = first_corner[quads, None] + turned
    is_kept = np.ones(len(corners), np.bool_)
    for done, face in enumerate(against[sizes[against] > 4].tolist()):
        if done % REPORT_POLYGONS == 0:
            report(None, "splitting polygons")
        start, row = first_corner[face], first_triangle[face]
        found = cut_ears(positions[start : start + sizes[face]], polygon_normals[face])
        if not len(found):
            continue  # All its corners lie on one line: the fan is as good as anything.
        corners[row : row + len(found)] = start + found
        is_kept[row + len(found) : row + sizes[face] - 2] = False
    return corners[is_kept], faces[is_kept]


def cut_ears(positions: Floats, normal: Floats) -> Integers:
    """Triangulate one simple polygon by cutting off its ears.

    Parameters
    ----------
    positions : (n, 3) float64
    normal : (3,) float64
        Its normal, of any length.

    Returns
    -------
    (m, 3) int64
        Corners of the triangles, which turn as the polygon does: n - 2, or fewer where corners lie on one line or on
        each other, or where the polygon crosses itself.

    References
    ----------
    G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82, 1975. The library, Mapbox' earcut, finds the
    corners near an ear along a curve through the plane instead of looking at all of them.
    """
    from mapbox_earcut import triangulate_float64  # Not before there is a polygon that needs it.

    # Drop the axis that the polygon faces most, keeping the sense of rotation.
    axis = int(np.argmax(np.abs(normal)))
    flat = positions[:, [(axis + 1) % 3, (axis + 2) % 3]] * np.array([np.sign(normal[axis]) or 1.0, 1.0])
    ends = np.array([len(flat)], np.uint32)
    triangles = triangulate_float64(np.ascontiguousarray(flat), ends).reshape(-1, 3).astype(np.int64)
    (ax, ay), (bx, by), (cx, cy) = (flat[triangles[:, k]].T for k in range(3))
    is_turned = (bx - ax) * (cy - ay) < (by - ay) * (cx - ax)
    triangles[is_turned] = triangles[is_turned, ::-1]
    return triangles


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
