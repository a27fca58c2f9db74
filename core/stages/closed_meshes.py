"""Closed meshes and solids: of a solid no back face is seen from outside, so half of its triangles need not be drawn.

A closed mesh winds around every point of space a whole number of times (its winding number). A ray that comes from
outside begins at 0, a face seen from its front adds 1, one seen from its back takes 1 off. Where no number is negative,
the first face on every ray is a front: whatever lies outside sees no back. Faces that are wound the other way round,
a mesh turned inside out, or one that passes through itself and turns over, give a negative number somewhere.

References
----------
A. Jacobson, L. Kavan, O. Sorkine-Hornung, *Robust inside-outside segmentation using generalized winding numbers*, 2013.
"""

from dataclasses import replace

import numpy as np

from core.coverage.pixel_runs import Raster, make_raster
from core.interpolation.interpolation import plane_value
from core.numeric.large_arrays import ScratchBuffers
from core.records.arrays import Flags, Floats, Integers
from core.records.frame import StageCount
from core.scene import Camera, Scene
from core.settings import Settings
from core.spans.fill import pixels_of_rows, rows_in_order
from core.spans.lanes import set_up_lanes, tie_owners
from core.stages.declared import STAGES
from core.stages.geometry import Geometry
from core.stages.vertices import process_geometry
from core.transform.vertex_stage import transform_vertices

ASIDE = np.array([0.48, 0.36, 0.8])
"""Direction from which rays are cast: along no face or edge that models often have."""
RAYS = 128
"""Rays across the scene, in both directions."""
SNAPPING = 2.0**-8
"""Pixels that snapping moves a corner along an axis, at most, with room to spare: so far beside a face a ray may meet
it."""
ROUNDING = 1e-9
"""Of depths from 0 to 1."""


def welded(positions: Floats, triangles: Integers) -> Integers:
    """Return the triangles (T, 3) with vertices at one place taken for one: seams of texture coordinates double them.

    Parameters
    ----------
    positions : (N, 3) float64
    triangles : (T, 3) int64
    """
    return np.asarray(np.unique(positions + 0.0, axis=0, return_inverse=True)[1].reshape(-1)[triangles])


def is_closed(positions: Floats, triangles: Integers) -> bool:
    """Return whether every edge of a mesh is gone along as often one way as the other.

    Parameters
    ----------
    positions : (N, 3) float64
    triangles : (T, 3) int64
    """
    return _goes_both_ways(triangles) or _goes_both_ways(welded(positions, triangles))


def _goes_both_ways(triangles: Integers) -> bool:
    """Return whether the edges of triangles (T, 3) are the same edges when all of them are turned round."""
    start, end = triangles.reshape(-1), np.roll(triangles, -1, axis=1).reshape(-1)
    count = int(triangles.max(initial=0)) + 1
    return np.array_equal(np.sort(start * count + end), np.sort(end * count + start))


def is_solid(scene: Scene) -> bool:
    """Return whether the meshes of a scene are closed and wind around no point a negative number of times.

    Notes
    -----
    That they are closed is certain; the numbers are found along `RAYS` times `RAYS` parallel rays, so a part of the
    surface thinner than a ray's distance from the next may be missed.
    """
    if not all(is_closed(mesh.positions, mesh.triangles) for mesh in scene.meshes):
        return False
    raster = make_raster((RAYS, RAYS), "half", (0, 0, RAYS, RAYS))
    aside = replace(scene, camera=_camera_aside(scene), size=(RAYS, RAYS))
    geometry = process_geometry(aside, Settings(), {stage: StageCount() for stage in STAGES}, raster=raster)
    ray, depth, doubt, facing = _faces_on_rays(geometry, raster)
    order = np.lexsort((depth, ray))
    return len(ray) > 0 and bool(
        is_never_negative(ray[order], depth[order], doubt[order], facing[order]).all()
    )


def is_never_negative(ray: Integers, depth: Floats, doubt: Floats, facing: Integers) -> Flags:
    """Return behind which faces (F,) on rays the winding number is 0 or more; behind the last one it has to be 0.

    Parameters
    ----------
    ray : (F,) int64
        The ray of every face, not decreasing.
    depth : (F,) float64
        Where on its ray a face is, from 0 to 1, not decreasing along a ray.
    doubt : (F,) float64
        By how much the depth may be off: two faces that meet at an edge may so stand in the wrong order.
    facing : (F,) int64
        1: seen from the front; -1: from the back.
    """
    is_last = np.append(ray[1:] != ray[:-1], True)
    number = np.cumsum(facing)
    before = np.append(0, number[is_last][:-1])
    number -= np.repeat(before, np.diff(np.append(-1, np.flatnonzero(is_last))))
    is_in_doubt: Flags = np.append(depth[1:] - depth[:-1] <= doubt[1:] + doubt[:-1], False)
    return np.where(is_last, number == 0, (number >= 0) | is_in_doubt)


def _camera_aside(scene: Scene) -> Camera:
    """Return a camera that sees all meshes along parallel rays from `ASIDE`, at depths from 0 to 1."""
    world = transform_vertices(scene).world
    assert world is not None
    position = world[:, :3]
    center = (position.min(axis=0) + position.max(axis=0)) / 2
    radius = float(np.sqrt(((position - center) ** 2).sum(axis=1).max())) or 1.0
    return Camera(
        center + 2 * radius * ASIDE,
        center,
        projection="orthographic",
        view_height=2.1 * radius,
        near=0.9 * radius,
        far=3.1 * radius,
    )


def _faces_on_rays(geometry: Geometry, raster: Raster) -> tuple[Integers, Floats, Floats, Integers]:
    """Return ray, depth, doubt and facing (F,) of faces on rays through pixel centres, see `is_never_negative`."""
    scratch, owners = ScratchBuffers(), tie_owners(geometry.settings.fill_rule)
    lanes = set_up_lanes(geometry.window_x, geometry.window_y, geometry.doubled_area, raster, owners, scratch)
    rows = rows_in_order(lanes, len(geometry.primitives), raster, owners, scratch)
    ray, primitive = pixels_of_rows(rows, raster)
    corners = geometry.depth.take(primitive, axis=1)
    on_plane = plane_value(geometry.depth_plane, primitive, *raster.centers(*raster.position(ray)))
    depth = np.clip(on_plane, corners.min(axis=0), corners.max(axis=0))
    across, up, _ = geometry.depth_plane
    doubt = (np.abs(across) + np.abs(up)) * SNAPPING + ROUNDING
    facing = np.sign(geometry.doubled_area).astype(np.int64)
    return ray, depth, doubt.take(primitive), facing.take(primitive)
