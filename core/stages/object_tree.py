"""The tree of boxes over a scene's triangles: what it is built over, where, and for whom."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from core.culling.object_culling import ObjectCulling, cull_objects, view_planes
from core.methods import table
from core.records.arrays import Floats, Integers
from core.records.box_tree import BoxTree, Objects, checked_objects
from core.resolved import resolve
from core.scene import AnyScene, Scene
from core.settings import Settings, no_effect
from core.transform.vertex_stage import VertexStage, World, place_meshes
from core.visibility.ray_casting import RayPlanes
from core.visibility.rays_in_tree import TreeRays, set_up_tree_rays


@dataclass(frozen=True, eq=False)
class ObjectTree:
    """A tree of boxes over the T triangles of a scene, or a list of its meshes."""

    objects: Objects
    tree: BoxTree
    is_world: bool
    """Whether boxes lie in world space; else x, y and w of clip space are their axes, with the eye at 0."""


def object_tree(scene: AnyScene, vertices: VertexStage, settings: Settings) -> ObjectTree | None:
    """Return the tree of a scene; ``None``: no method asks for one.

    Raises
    ------
    ValueError
        Where an octree would get too large, or a corner is not finite.
    """
    if no_effect(settings, "hierarchy", scene):
        return None
    rule = settings.hierarchy, settings.leaf_size, settings.octree_depth
    if isinstance(scene, Scene) and scene.program is None and all(mesh.is_affine for mesh in scene.meshes):
        return _tree_of_world(place_meshes(scene.meshes), *rule)
    corners = vertices.clip[vertices.all_corners][..., [0, 1, 3]]
    return _grown(corners, vertices.mesh, rule, is_world=False)


@lru_cache(maxsize=2)
def _tree_of_world(world: World, hierarchy: str, leaf_size: int, octree_depth: int) -> ObjectTree:
    """Return the tree of meshes; only the camera moves more often than they do."""
    return _grown(
        world.world[world.corners, :3], world.mesh, (hierarchy, leaf_size, octree_depth), is_world=True
    )


def _grown(corners: Floats, mesh: Integers, rule: tuple[str, int, int], is_world: bool) -> ObjectTree:
    """Return the tree over primitives of corners (T, C, 3)."""
    hierarchy, leaf_size, octree_depth = rule
    objects = checked_objects(corners.min(axis=1), corners.max(axis=1), mesh)
    build = table.get("hierarchy", hierarchy).function
    return ObjectTree(objects, build(objects, leaf_size, octree_depth), is_world)


def culled_objects(
    scene: AnyScene, vertices: VertexStage, settings: Settings, grown: ObjectTree | None, plane_count: int
) -> ObjectCulling | None:
    """Return what culling of objects drops; ``None``: it asks no object of this scene."""
    if grown is None or settings.object_culling == "none" or no_effect(settings, "object_culling", scene):
        return None
    assert vertices.projection is not None
    assert vertices.view is not None
    planes = view_planes(vertices.projection, vertices.view)
    rule = resolve(settings).method("object_culling").function
    return cull_objects(grown.tree, rule, planes, len(grown.objects), plane_count)


BEYOND = 1 / 128
"""Pixels that coverage may reach beyond snapped corners: where a snapped triangle turns over, sqrt(2)/256."""


def rays_in_tree(grown: ObjectTree, vertices: VertexStage, planes: RayPlanes, reach: float) -> TreeRays:
    """Return the rays of a picture among the boxes of a tree.

    Parameters
    ----------
    reach : float
        How many pixels snapping moves a corner at most.
    """
    if grown.is_world:
        assert vertices.projection is not None
        assert vertices.view is not None
        to_clip = vertices.projection @ vertices.view
        sizes = np.abs(vertices.projection) @ np.abs(vertices.view)
    else:
        to_clip = np.zeros((4, 4))
        to_clip[[0, 1, 3], [0, 1, 2]] = 1.0
        sizes = to_clip
    is_parallel = bool(grown.is_world and not to_clip[3, :3].any())
    return set_up_tree_rays(
        grown.tree, to_clip, planes, float(to_clip[3, 3]) if is_parallel else 0.0, reach + BEYOND, sizes
    )
