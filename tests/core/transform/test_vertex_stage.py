"""Every vertex through every space, normals as covectors, triangles of several meshes in one list."""

import numpy as np
import pytest

from core import Camera, ClipScene, Mesh, Scene
from core.transform.matrices import rotation, scaling, translation
from core.transform.vertex_stage import transform_vertices, unit, vertex_normals, world_normals

POSITIONS = np.array([[0.0, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, -4]])
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])
M = translation(1, 2, 3) @ rotation(np.array([1.0, 2.0, 3.0]), 0.7) @ scaling(1, 2, 0.5)


def scene(*meshes: Mesh, size=(8, 6)) -> Scene:
    return Scene(meshes, Camera([3.0, 4.0, 12.0], [0.0, 1.0, 0.0], near=1, far=50), size=size)


def test_all_spaces_are_kept_and_follow_from_each_other() -> None:
    stage = transform_vertices(scene(Mesh(POSITIONS, TRIANGLES, transform=M)))
    column = np.concatenate([POSITIONS, np.ones((4, 1))], axis=1)
    assert np.array_equal(stage.object, column)
    assert np.allclose(stage.world, column @ M.T)
    assert np.allclose(stage.camera, stage.world @ stage.view.T)
    assert np.allclose(stage.clip, stage.camera @ stage.projection.T)
    assert np.allclose(stage.clip, column @ (stage.projection @ stage.view @ stage.model[0]).T)
    assert np.allclose(stage.ndc, stage.clip[:, :3] / stage.clip[:, 3:])
    window = np.concatenate([stage.ndc, np.ones((4, 1))], axis=1) @ stage.viewport.T
    assert np.allclose(stage.window, window[:, :3])


def test_vertices_of_several_meshes_are_numbered_on() -> None:
    first = Mesh(POSITIONS, TRIANGLES)
    second = Mesh(POSITIONS[:3], [[2, 1, 0]], transform=translation(0, 0, 5))
    stage = transform_vertices(scene(first, second))
    assert stage.corners.tolist() == [[0, 1, 2], [0, 2, 3], [6, 5, 4]]
    assert stage.mesh.tolist() == [0, 0, 1]
    assert stage.world[4].tolist() == [0, 0, 5, 1]
    assert len(stage.model) == 2


def test_a_clip_scene_starts_in_clip_space() -> None:
    clip = np.arange(24.0).reshape(2, 3, 4)
    stage = transform_vertices(ClipScene(clip, size=(4, 4)))
    assert np.array_equal(stage.clip[stage.corners], clip)
    assert stage.world is stage.camera is stage.object is stage.normals is None


def test_the_eye_plane_has_no_place_in_the_window() -> None:
    clip = np.array([[[1.0, 0, 0, 0], [0, 0, 0, 0], [1, 1, 1, -1]]])
    stage = transform_vertices(ClipScene(clip, size=(4, 4)))
    assert np.isinf(stage.ndc[0, 0])
    assert np.isnan(stage.window[1]).all()
    assert stage.ndc[2].tolist() == [-1, -1, -1]


def test_normals_stand_upright_on_a_mesh_that_is_stretched() -> None:
    slope = Mesh([[0.0, 0, 0], [1, 0, 0], [0, 1, -1]], [[0, 1, 2]], transform=M)
    corners = (M @ np.concatenate([slope.positions.T, np.ones((1, 3))]))[:3].T
    normals = world_normals(slope)
    expected = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    assert np.allclose(normals, expected / np.linalg.norm(expected))


def test_normals_of_a_mirrored_mesh_point_along_its_own_faces() -> None:
    # A mirror turns the winding over, and the facing with it: the normal goes with the winding.
    mirrored = Mesh([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], transform=scaling(-1, 1, 1))
    corners = mirrored.positions * [-1, 1, 1]
    winding = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    assert np.allclose(world_normals(mirrored), unit(winding))


def test_missing_normals_are_averages_of_the_faces_weighted_by_area() -> None:
    # A large face in the xy plane and a small one in the xz plane meet along x.
    positions = [[0.0, 0, 0], [1, 0, 0], [0, 4, 0], [0, 0, -1]]
    normals = vertex_normals(np.array(positions), np.array([[0, 1, 2], [0, 3, 1]]))
    assert normals.tolist() == [[0.0, -1.0, 4.0], [0.0, -1.0, 4.0], [0.0, 0.0, 4.0], [0.0, -1.0, 0.0]]
    assert np.allclose(np.linalg.norm(world_normals(Mesh(positions, [[0, 1, 2], [0, 3, 1]])), axis=1), 1)


def test_given_normals_are_used_at_unit_length() -> None:
    mesh = Mesh(POSITIONS, TRIANGLES, normals=np.array([[0, 0, 5.0], [3, 0, 4], [0, 0, 0], [1, 0, 0]]))
    assert np.allclose(world_normals(mesh), [[0, 0, 1], [0.6, 0, 0.8], [0, 0, 0], [1, 0, 0]])


@pytest.mark.parametrize("shape", [(3,), (0, 3), (2, 5, 3)])
def test_unit_leaves_zero_vectors_alone(shape: tuple[int, ...]) -> None:
    assert not unit(np.zeros(shape)).any()
    assert np.allclose(np.linalg.norm(unit(np.full(shape, 2.0)), axis=-1), 1)
