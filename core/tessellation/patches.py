"""Meshes of bicubic Bezier patches: points, normals and triangles of a grid of parameters on each."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from core.records.arrays import Flags, Floats, Integers
from core.records.curves import checked_patches
from core.scene import COORDINATE_LIMIT, Mesh
from core.tessellation.bezier import cross, patch_derivatives, patch_nets, patch_points, shares

NO_AREA = 1e-9
"""Triangles whose doubled area is less than this part of their patch's squared size are left out."""


@dataclass(frozen=True, eq=False)
class PatchGrid:
    """The V vertices of patches that are cut at parameters of their own."""

    patch: Integers
    """(V,) int64."""
    step: Integers
    """(V, 2) int64: t = step / steps along the first index of the patch, and along the second."""
    steps: Integers
    """(V, 2) int64."""
    triangles: Integers
    """(T, 3) int64."""
    of_patch: Integers
    """(T,) int64, the patch of every triangle."""


def patch_grid(cuts: Sequence[tuple[tuple[Integers, int], tuple[Integers, int]]]) -> PatchGrid:
    """Return the grid of patches, each with its steps (M,) int64 and their number, along both indices."""
    step, steps, triangles, first = [], [], [], 0
    for (down, of_down), (across, of_across) in cuts:
        rows, columns = len(down), len(across)
        step.append(np.stack(np.meshgrid(down, across, indexing="ij"), axis=-1).reshape(-1, 2))
        steps.append(np.broadcast_to([of_down, of_across], (rows * columns, 2)))
        corner = first + (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
        # With the first index to the right and the second upwards, both triangles turn counter-clockwise.
        right, up = corner + columns, corner + 1
        pair = [corner, right + 1, up, corner, right, right + 1]
        triangles.append(np.stack(pair, axis=1).reshape(-1, 3))
        first += rows * columns
    number = np.arange(len(cuts))
    return PatchGrid(
        patch=np.repeat(number, [len(each) for each in step]),
        step=np.concatenate(step),
        steps=np.concatenate(steps).astype(np.int64),
        triangles=np.concatenate(triangles),
        of_patch=np.repeat(number, [len(each) for each in triangles]),
    )


def grid_points(control: Floats, grid: PatchGrid) -> tuple[Floats, Floats]:
    """Return positions and normals (V, 3) of a grid on patches (P, 4, 4, 3); normals are not unit.

    Notes
    -----
    Where one derivative is 0, as at a pole, the mixed derivative shows where it goes to: the normal is that of the
    points beside. Only where that is 0, too, the normal is 0.
    """
    down, across = (shares(grid.step[:, k], grid.steps[:, k]) for k in (0, 1))
    of_vertex = control[grid.patch]
    net = patch_nets(of_vertex, down, across)
    by_first, by_second = patch_derivatives(net, down, across)
    normals = cross(by_first, by_second)
    flat = np.flatnonzero(is_lost(normals, of_vertex))
    if len(flat):
        # Both derivatives a little into the patch: to first order, by the mixed derivative.
        mixed = net[flat, 1, 1] - net[flat, 1, 0] - net[flat, 0, 1] + net[flat, 0, 0]
        inward = np.where(2 * grid.step[flat] <= grid.steps[flat], 1.0, -1.0)
        one, other = by_first[flat], by_second[flat]
        is_first = (one * one).sum(axis=1) < (other * other).sum(axis=1)
        beside = np.where(
            is_first[:, None], cross(inward[:, 1:] * mixed, other), cross(one, inward[:, :1] * mixed)
        )
        normals[flat] = beside
    return patch_points(net, down, across), normals


def is_lost(normals: Floats, control: Floats) -> Flags:
    """Return (V,) bool, where normals (V, 3) are 0, up to the rounding of patches (V, 4, 4, 3)."""
    size = np.ptp(control, axis=(1, 2)).max(axis=1)
    return np.asarray(np.abs(normals).max(axis=1) <= NO_AREA * size * size)


def mesh_of_patches(patches: ArrayLike, segments: int = 6, **more: Any) -> Mesh:
    """Return a mesh of patches (P, 4, 4, 3), each cut into ``segments`` equal steps both ways.

    ``more`` are further fields of the mesh.
    """
    control = checked_patches(more.get("name", "mesh"), patches, COORDINATE_LIMIT)
    cut = np.arange(segments + 1), segments
    return Mesh(patches=control, **grid_arrays(control, patch_grid([(cut, cut)] * len(control))), **more)


def cut_mesh(mesh: Mesh, grid: PatchGrid) -> Mesh:
    """Return the mesh with the triangles of a grid on its patches; all of one colour, that of vertex 0."""
    assert mesh.patches is not None
    arrays = grid_arrays(mesh.patches, grid)
    colors = None if mesh.colors is None else np.tile(mesh.colors[:1], (len(arrays["positions"]), 1))
    return replace(mesh, colors=colors, **arrays)


def grid_arrays(control: Floats, grid: PatchGrid) -> dict[str, Any]:
    """Return the arrays of a mesh of patches (P, 4, 4, 3) by their names, without triangles that have no area."""
    positions, normals = grid_points(control, grid)
    corners = positions[grid.triangles]
    doubled = np.abs(cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])).max(axis=1)
    size = np.ptp(control, axis=(1, 2)).max(axis=1)[grid.of_patch]
    has_area = doubled > NO_AREA * size * size
    return {
        "positions": positions,
        "normals": normals,
        "uvs": (grid.step / grid.steps)[:, ::-1],
        "triangles": grid.triangles[has_area],
        "faces": grid.of_patch[has_area],
    }
