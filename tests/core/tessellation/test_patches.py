"""Patches: borders without a gap, normals against differences, poles, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from core import Settings, render
from core.records.curves import checked_patches
from core.stages.before_matrices import before_matrices, tessellated
from core.tessellation.bezier import levels, shares
from core.tessellation.patches import mesh_of_patches
from lessons.curve_scenes import cracked, hill
from lessons.scenes import make_scene
from lessons.shapes import patches, teapot


def by_columns_first(control, u: float, v: float) -> np.ndarray:
    """Evaluate in the other order: both give the same surface."""
    of_u, of_v = (shares(np.array(each), np.array(1.0)) for each in (u, v))
    columns = levels(of_u[0][None], of_u[1][None], np.swapaxes(control, 0, 1))[-1][:, 0]
    return levels(*of_v, columns)[-1][0]


def test_points_are_those_of_the_other_order_and_normals_those_of_differences():
    mesh = hill().meshes[0]
    for place, normal, (v, u) in zip(mesh.positions, mesh.normals, mesh.uvs, strict=True):
        assert np.allclose(place, by_columns_first(mesh.patches[0], u, v), atol=1e-12)
        du, dv = (
            (
                by_columns_first(mesh.patches[0], u + a, v + b)
                - by_columns_first(mesh.patches[0], u - a, v - b)
            )
            / 2e-6
            for a, b in ((1e-6, 0), (0, 1e-6))
        )
        assert np.allclose(normal, np.cross(du, dv), atol=1e-6)


@pytest.mark.parametrize("segments", [1, 3, 6, 7])
def test_common_borders_of_the_teapot_are_the_same_to_the_last_bit(segments):
    """Every point on a border of two patches is the same point, whichever way each of them runs along it."""
    mesh = teapot(segments)
    used = np.unique(mesh.triangles)
    edge = used[((mesh.uvs[used] == 0) | (mesh.uvs[used] == 1)).any(axis=1)]
    exact, rounded = (
        len(np.unique(p, axis=0)) for p in (mesh.positions[edge], mesh.positions[edge].round(9))
    )
    poles = 2 * (4 * segments + 1)
    assert exact - rounded <= poles, "points of a border differ in their last bits"


def test_the_poles_of_the_teapot_have_normals_along_the_axis():
    mesh = teapot()
    at_axis = np.hypot(mesh.positions[:, 0], mesh.positions[:, 2]) < 1e-9
    normals = mesh.normals[at_axis] / np.linalg.norm(mesh.normals[at_axis], axis=1, keepdims=True)
    assert np.allclose(np.abs(normals[:, 1]), 1)
    assert (np.sign(normals[:, 1]) == np.sign(mesh.positions[at_axis][:, 1])).all()


def test_the_setting_cuts_the_teapot_anew_and_the_same_meshes_serve_another_camera():
    scene = make_scene("teapot")
    for segments, triangles in ((6, 2256), (3, 552), (12, 9120)):
        made = before_matrices(scene, Settings(segments=segments))
        assert len(made.meshes[0].triangles) == triangles
    moved = replace(scene, camera=replace(scene.camera, eye=scene.camera.eye + 0.5))
    settings = Settings(segments=12)
    assert before_matrices(moved, settings).meshes is before_matrices(scene, settings).meshes


def test_two_levels_along_one_edge_leave_a_crack():
    scene = cracked()
    found = tessellated(scene, Settings(tessellation="bound", curve_tolerance=160))
    assert [len(cut.step) - 1 for cut in found.cuts] == [2, 1, 3, 1]
    ends = [
        mesh.positions[mesh.uvs[:, 0] == side] for mesh, side in zip(found.scene.meshes, (1, 0), strict=True)
    ]
    x = np.linspace(2, 60, 2001)
    heights = [np.interp(x, each[:, 0], each[:, 1]) for each in ends]
    assert round(float(np.abs(heights[0] - heights[1]).max()), 2) == 8.45
    # Holes and double hits with two levels; with one, every pixel once.
    unlit = {"shading": "unlit"}
    one = render(scene, Settings(**unlit, segments=3)).cover_count
    two = render(scene, Settings(**unlit, tessellation="bound", curve_tolerance=160)).cover_count
    assert one.max() == 1
    assert ((one == 1) & (two == 0)).sum() > 100


def test_a_patch_without_area_is_refused():
    line = np.zeros((1, 4, 4, 3))
    line[..., 0] = np.arange(16).reshape(4, 4)
    for bad in (line, np.ones((1, 4, 4, 3))):
        with pytest.raises(
            ValueError, match="patch 0 of mesh has no area: its control points lie on one line"
        ):
            mesh_of_patches(bad)
    with pytest.raises(ValueError, match=r"patches of lid must be \(P, 4, 4, 3\)"):
        checked_patches("lid", np.ones((3, 3, 3)), 1e9)


def test_too_many_cells_are_refused_before_any_is_made():
    with pytest.raises(ValueError, match="1,000 segments would make 64,000,000 triangles"):
        render(make_scene("teapot"), Settings(segments=1000))


def test_the_teapots_patches_close_around_the_axis():
    control = patches()
    assert control.shape == (32, 4, 4, 3)
    assert (control[0][:, 3] == control[1][:, 0]).all()
