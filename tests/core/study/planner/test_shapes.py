"""Convex meshes, and triangles that cover every sample once at most: both are proofs, so nothing else may pass."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from core.pipeline import render
from core.records.arrays import Floats, Integers
from core.scene import Camera, Mesh, Scene
from core.stages.closed_meshes import is_closed
from core.study import everything_on, look_at, plan
from core.study.accuracy.workloads import sphere_mesh, sphere_scene
from core.study.planner.choices.costs import LectureOrder
from core.study.planner.corpus import corpus_scene
from core.study.planner.scene_analysis.conservative_coverage import touch
from core.study.planner.scene_analysis.convexity import is_convex
from core.study.planner.scene_analysis.covered_once import is_covered_once, outline

GOLDEN = (1 + 5**0.5) / 2


def icosahedron(edge: float) -> tuple[Floats, Integers]:
    """Return 12 vertices, and the 20 triangles between those that are an ``edge`` apart, looking outwards."""
    signs = (1.0, -1.0)
    corners = np.array([(0.0, a, b * GOLDEN) for a in signs for b in signs])
    vertices = np.concatenate([np.roll(corners, turn, axis=1) for turn in range(3)])
    triangles = []
    for one, two, three in combinations(range(12), 3):
        corner = vertices[[one, two, three]]
        if np.allclose(np.linalg.norm(corner - np.roll(corner, 1, axis=0), axis=1), edge):
            outwards = np.linalg.det(corner) > 0
            triangles.append((one, two, three) if outwards else (one, three, two))
    return vertices, np.array(triangles)


@pytest.mark.parametrize("rings", [3, 8, 20])
def test_spheres_are_convex(rings: int) -> None:
    mesh = sphere_mesh(rings)
    assert is_convex(mesh.positions, mesh.triangles)
    assert is_convex(mesh.positions * (1, 3, 0.2) + 5, mesh.triangles)
    assert not is_convex(mesh.positions, mesh.triangles[:, ::-1])
    assert not is_convex(mesh.positions, mesh.triangles[1:])


def test_a_dent_is_not_convex() -> None:
    mesh = sphere_mesh(8)
    positions = mesh.positions.copy()
    positions[len(positions) // 2] *= 0.9
    assert not is_convex(positions, mesh.triangles)


def test_inward_edges_and_eulers_formula_are_not_enough() -> None:
    vertices, triangles = icosahedron(2.0)
    assert len(triangles) == 20
    assert is_convex(vertices, triangles)
    vertices, great = icosahedron(2 * GOLDEN)
    assert len(great) == 20
    assert is_closed(vertices, great)
    assert not is_convex(vertices, great)


def test_two_solids_are_not_one() -> None:
    mesh = sphere_mesh(5)
    both = np.concatenate([mesh.positions, 0.5 * mesh.positions])
    assert not is_convex(both, np.concatenate([mesh.triangles, mesh.triangles + len(mesh.positions)]))


def test_an_outline_is_what_shared_edges_leave() -> None:
    start, end = outline(np.array([[0, 1, 2], [0, 2, 3]]))
    assert sorted(zip(start.tolist(), end.tolist(), strict=True)) == [(0, 1), (1, 2), (2, 3), (3, 0)]
    assert len(outline(np.array([[0, 1, 2], [0, 2, 1]]))[0]) == 0


@pytest.mark.parametrize("scale", [1, 2, 4])
def test_what_is_covered_once_is_covered_no_more_than_once(scale: int) -> None:
    proven = 0
    for seed in range(105):
        scene = corpus_scene(seed)[1]
        everything = everything_on(scene)
        touched = touch(scene, everything)
        for cull in ("back", "none"):
            finer = replace(scene, size=(scale * scene.size[0], scale * scene.size[1]))
            settings = replace(everything, cull=cull, antialiasing="none", clipping="homogeneous")
            if is_covered_once(touched, cull == "back", scale):
                proven += 1
                assert render(finer, settings).cover_count.max() <= 1, (seed, cull)
    assert proven > 30


def test_a_convex_mesh_with_culling_needs_no_depth_buffer() -> None:
    scene = sphere_scene(8, 48)
    assert next(fact.text for fact in look_at(scene).facts if fact.name == "convex") == "1 of 1"
    chosen = plan(scene, base=replace(everything_on(scene)), costs=LectureOrder())
    assert chosen.settings.visibility == "last-drawn"
    reason = next(each.reason for each in chosen.decisions if each.setting == "visibility")
    assert "covered by one triangle at most" in reason
    assert "convex" in reason


def test_fronts_that_hide_each_other_are_not_covered_once() -> None:
    whole = sphere_mesh(6)
    transform = np.eye(4)
    transform[2, 3] = -3.0
    near = Mesh(whole.positions, whole.triangles, whole.normals)
    camera = Camera(np.array([0.0, 0, 4]), np.zeros(3))
    scene = Scene((near, replace(near, transform=transform)), camera, (), (40, 40))
    touched = touch(scene, everything_on(scene))
    assert not is_covered_once(touched, True, 1)
    assert not is_covered_once(touched, False, 1)
