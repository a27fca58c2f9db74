"""Trees of boxes on the same rays: nodes, references and bytes, and the boxes and triangles that the rays ask."""

from dataclasses import replace

import numpy as np

from core.fast_path.draw_context import Picture
from core.records.box_tree import BoxTree
from core.scene import AnyScene
from core.settings import Settings
from core.stages.object_tree import object_tree
from core.study.family import Assignment, StudyFamily
from core.study.record import Axis, WorkKind
from core.study.whole_picture import MEASURES, ChoiceTask
from core.study.workloads import sphere_scene
from core.trace.source import TraceSource
from core.transform.vertex_stage import transform_vertices
from core.visibility.rays_in_tree import TreeWalk
from core.visibility.tree_walk import walk_rays

LEAF_SIZES = (1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0)


def tree_of(scene: AnyScene, settings: Settings) -> BoxTree:
    """Return the tree that rays walk with these settings."""
    grown = object_tree(scene, transform_vertices(scene), replace(settings, visibility="ray-casting-tree"))
    assert grown is not None
    return grown.tree


def walk_of_all_rays(scene: AnyScene, settings: Settings) -> TreeWalk:
    """Return the walk of one ray for each pixel of a scene of filled triangles, those that hit nothing among them."""
    source = TraceSource(scene, replace(settings, visibility="ray-casting-tree"))
    geometry, raster = source.geometry, source.raster
    assert geometry.tree_rays is not None
    pixels = np.arange(raster.shape[0] * raster.shape[1])
    row, column = np.divmod(pixels, raster.shape[1])
    m, n = geometry.ray_planes.rays(column, row, raster.center)
    _, keeps, _ = source.depths
    hits = source.place[keeps], source.triangle_of_fragment[keeps]
    none = np.full(len(pixels), -1)
    _, walk = walk_rays(
        geometry.tree_rays, geometry.ray_planes, *hits, (pixels, m, n), none, keeps_visits=False
    )
    return walk


class TreeTask(ChoiceTask):
    """A sphere, drawn by rays that walk a tree; the first method is a list of meshes."""

    def __init__(self, scene: AnyScene, base: Settings, leaf_size: int) -> None:
        super().__init__(scene, "hierarchy", base)
        self.turned = {"leaf_size": leaf_size}

    def counts(self, settings: Settings, made: Picture) -> dict[str, int]:
        """Return the size of the tree, and what all rays of the picture ask."""
        settings = self.with_dials(settings)
        tree, walk = tree_of(self.scene, settings), walk_of_all_rays(self.scene, settings)
        return {
            "nodes": len(tree),
            "references": len(tree.items),
            "bytes of the tree": tree.byte_count,
            "boxes asked": int(walk.box_count.sum()),
            "triangles asked": int(walk.asked_count.sum()),
            **super().counts(settings, made),
        }


def make_trees(assignment: Assignment) -> TreeTask:
    """Make the picture of a sphere of so many rings."""
    scene = sphere_scene(int(assignment.dials["rings"]), 48)
    return TreeTask(scene, assignment.settings, int(assignment.dials["leaf"]))


HIERARCHY = StudyFamily(
    "hierarchy",
    "Trees of boxes",
    ("hierarchy",),
    (
        WorkKind(
            "rays",
            "Rays to a sphere",
            "frame",
            (
                Axis(
                    "leaf", "Leaf size", "triangles", LEAF_SIZES, default=8, is_cost=True, setting="leaf_size"
                ),
                Axis("rings", "Rings of the sphere", "", (6.0, 12.0, 24.0), default=12),
            ),
        ),
    ),
    MEASURES,
    make_trees,
    Settings(visibility="ray-casting-tree"),
)
