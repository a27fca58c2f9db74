"""The tree of boxes over a scene's triangles: what it is built over, where, and for whom."""

from dataclasses import dataclass
from typing import TypeGuard

import numpy as np

from core.culling.object_culling import ObjectCulling, cull_objects, frustum, view_planes
from core.methods import Method
from core.numeric.watched import work
from core.records.arrays import Floats, Integers
from core.records.box_tree import BoxTree, Objects, checked_objects
from core.resolved import resolve
from core.scene import AnyScene, Scene
from core.settings import Settings, no_effect
from core.transform.vertex_stage import VertexStage, World, place_meshes
from core.trees.expected import BuildCost, expected_build
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
    rule = _rule(settings)
    of = place_meshes(scene.meshes) if _is_in_world(scene) else vertices
    if (kept := _kept(of, rule)) is not None:
        return kept
    if isinstance(of, World):
        grown = _grown(of.world[of.corners, :3], of.mesh, rule, is_world=True)
    else:
        grown = _grown(of.clip[of.all_corners][..., [0, 1, 3]], of.mesh, rule, is_world=False)
    _last[:] = [*_last[-KEPT + 1 :], (of, rule, grown)]
    return grown


KEPT = 2
_Rule = tuple[Method, int, int]
_last: list[tuple[World | VertexStage, _Rule, ObjectTree]] = []
"""The last `KEPT` trees: only the camera moves more often than meshes do, and vertices never change."""


def _rule(settings: Settings) -> _Rule:
    return resolve(settings).method("hierarchy"), settings.leaf_size, settings.octree_depth


def _is_in_world(scene: AnyScene) -> TypeGuard[Scene]:
    """Return whether the boxes of a scene lie in world space, where the camera does not move them."""
    return isinstance(scene, Scene) and scene.program is None and all(mesh.is_affine for mesh in scene.meshes)


def _kept(of: World | VertexStage, rule: _Rule) -> ObjectTree | None:
    return next((tree for known, by, tree in _last if known is of and by == rule), None)


def expected_tree(scene: AnyScene, triangle_count: int, settings: Settings) -> BuildCost | None:
    """Return what the tree of a scene will take; ``None``: no method asks for one, or it is built already."""
    if no_effect(settings, "hierarchy", scene):
        return None
    rule = _rule(settings)
    if _is_in_world(scene) and _kept(place_meshes(scene.meshes), rule) is not None:
        return None
    return expected_build(rule[0].name, triangle_count, *rule[1:])


def _grown(corners: Floats, mesh: Integers, rule: _Rule, is_world: bool) -> ObjectTree:
    """Return the tree over primitives of corners (T, C, 3); whoever watches hears before what it takes."""
    objects = checked_objects(corners.min(axis=1), corners.max(axis=1), mesh)
    with work(expected_build(rule[0].name, len(objects), *rule[1:]).text):
        return ObjectTree(objects, rule[0].function(objects, *rule[1:]), is_world)


def culled_objects(
    scene: AnyScene, vertices: VertexStage, settings: Settings, grown: ObjectTree | None, plane_count: int
) -> ObjectCulling | None:
    """Return what culling of objects drops; ``None``: it asks no object of this scene."""
    if grown is None or settings.object_culling == "none" or no_effect(settings, "object_culling", scene):
        return None
    assert vertices.projection is not None
    assert vertices.view is not None
    planes = view_planes(vertices.projection, vertices.view)
    method = resolve(settings).method("object_culling")
    rule = frustum if method.traits == "occlusion" else method.function
    found = cull_objects(grown.tree, rule, planes, len(grown.objects), plane_count)
    if method.traits != "occlusion":
        return found
    from core.stages.occluders import occlusion_of  # It asks for the geometry of all, which asks for trees.

    assert isinstance(scene, Scene)
    return found.hiding(occlusion_of(scene, settings))


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
