"""A mesh before a camera as triangles in the window: what a library without a vertex stage is given.

NumPy alone, and none of the core's code: the reference that coverage is checked against begins here too.
"""

from dataclasses import dataclass

import numpy as np

from app.bench.random_triangles import doubled_areas
from app.bench.records import SUBPIXELS, Bytes, Floats, Integers, ViewedMesh, WindowTriangles


@dataclass(frozen=True, eq=False)
class Projected:
    """The triangles of a mesh that face the eye; all of it must lie in front of the eye."""

    triangle: Integers
    """(P,) int64 numbers in the mesh."""
    corners: Floats
    """(P, 3, 2) float64 window x, y, snapped to 1/256 pixel."""
    depth: Floats
    """(P, 3) float64 window depth."""


def project(mesh: ViewedMesh) -> Projected:
    """Return where the triangles of ``mesh`` that face the eye are in the window.

    Raises ValueError if a vertex is not before the eye: such triangles have no place in the window.
    """
    points = np.concatenate([mesh.positions, np.ones((len(mesh.positions), 1))], axis=1)
    clip = points @ (mesh.projection @ mesh.view).T
    if (clip[:, 3] <= 0).any():
        raise ValueError("the mesh must lie in front of the eye")
    ndc = clip[:, :3] / clip[:, 3:]
    window = np.rint((ndc[:, :2] + 1) * np.array(mesh.size) / 2 * SUBPIXELS) / SUBPIXELS
    corners = window[mesh.triangles]
    front = np.flatnonzero(doubled_areas(corners) > 0)
    return Projected(front, corners[front], (ndc[:, 2] / 2 + 0.5)[mesh.triangles[front]])


def lit_colors(mesh: ViewedMesh) -> Bytes:
    """Return the colours (N, 4) uint8 of the vertices under a light without highlights."""
    color = np.ones((len(mesh.positions), 3)) if mesh.colors is None else mesh.colors
    light = mesh.lighting
    if light is not None:
        facing = np.maximum(mesh.normals @ -light.direction, 0.0)
        color = color * (light.ambient + light.diffuse * facing)[:, None]
    opaque = np.full((len(color), 4), 255, np.uint8)
    opaque[:, :3] = np.floor(np.clip(color, 0, 1) * 255 + 0.5)
    return opaque


def as_window_triangles(mesh: ViewedMesh) -> WindowTriangles:
    """Return what is left to draw of a mesh once it is transformed, culled and lit at its vertices."""
    projected = project(mesh)
    colors = lit_colors(mesh)[mesh.triangles[projected.triangle]]
    return WindowTriangles(projected.corners, projected.depth, colors, mesh.size)
