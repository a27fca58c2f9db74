"""Laws of the meshes by formula: closed, outward, of unit normals, with a texture that shows every turn."""

import numpy as np
import pytest

from lessons.shapes import checkerboard, cube, floor, grid_triangles, knot, sphere, torus

CLOSED = [
    (cube, 2, 8.0),
    (sphere, 2, 4 / 3 * np.pi),
    (torus, 0, 2 * np.pi**2 * 0.8 * 0.35**2),
    (knot, 0, None),
]


def merged(mesh):
    """Vertices of one position made one: seams of UVs and normals are no holes."""
    positions, inverse = np.unique(mesh.positions, axis=0, return_inverse=True)
    return positions, inverse.reshape(-1)[mesh.triangles]


@pytest.mark.parametrize(("shape", "characteristic", "volume"), CLOSED)
def test_a_closed_shape_has_two_opposite_triangles_at_every_edge(shape, characteristic, volume):
    positions, triangles = merged(shape())
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    assert (edges[:, 0] != edges[:, 1]).all()
    forward = {tuple(edge) for edge in edges.tolist()}
    assert len(forward) == len(edges)
    assert all((b, a) in forward for a, b in forward)
    assert len(positions) - len(edges) // 2 + len(triangles) == characteristic


@pytest.mark.parametrize(("shape", "characteristic", "volume"), CLOSED)
def test_a_closed_shape_faces_outward(shape, characteristic, volume):
    mesh = shape()
    a, b, c = (mesh.positions[mesh.triangles[:, k]] for k in range(3))
    enclosed = (a * np.cross(b, c)).sum() / 6
    assert enclosed > 0
    if volume is not None:
        assert enclosed == pytest.approx(volume, rel=0.02)


@pytest.mark.parametrize("shape", [cube, sphere, torus, knot, floor])
def test_normals_are_unit_and_agree_with_the_faces(shape):
    mesh = shape()
    assert np.linalg.norm(mesh.normals, axis=1) == pytest.approx(1)
    a, b, c = (mesh.positions[mesh.triangles[:, k]] for k in range(3))
    face = np.cross(b - a, c - a)
    face /= np.linalg.norm(face, axis=1, keepdims=True)
    assert ((mesh.normals[mesh.triangles] * face[:, None]).sum(axis=2) > 0.9).all()


@pytest.mark.parametrize("shape", [cube, sphere, torus, knot])
def test_uvs_run_from_0_to_1_and_do_not_mirror_the_texture(shape):
    mesh = shape()
    assert mesh.uvs.min() == 0
    assert mesh.uvs.max() == 1
    a, b, c = (mesh.uvs[mesh.triangles[:, k]] for k in range(3))
    first, second = b - a, c - a
    assert (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0] > 0).all()


def test_counts():
    assert len(cube().triangles) == 12
    assert cube().faces.tolist() == [face for face in range(6) for _ in range(2)]
    assert len(knot().triangles) == 20000
    assert len(sphere().triangles) == 2 * 48 * 24 - 2 * 48


def test_a_face_of_the_cube_has_one_colour_and_six_differ():
    mesh = cube()
    colors = mesh.colors[mesh.triangles].reshape(6, 6, 4)
    assert (colors == colors[:, :1]).all()
    assert len(np.unique(colors[:, 0], axis=0)) == 6


def test_a_grid_keeps_its_cells_together():
    triangles, faces = grid_triangles(2, 1)
    assert triangles.tolist() == [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]]
    assert faces.tolist() == [0, 0, 1, 1]


def test_the_checkerboard_is_its_own_mirror_image_under_no_turn():
    pixels = checkerboard().pixels
    turns = [np.rot90(image, k) for image in (pixels, pixels[:, ::-1]) for k in range(4)]
    assert not any(np.array_equal(pixels, turned) for turned in turns[1:])
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) == 3
    # The bar of the F that is longest is its top one: the highest row with ink.
    ink = (pixels[..., 0] > 2 * pixels[..., 1]) & (pixels[..., 0] > 0.3)
    rows = ink.sum(axis=1).nonzero()[0]
    assert ink[rows[-1]].sum() == 12
    assert ink[rows[0]].sum() == 2


def test_the_floor_faces_up_and_repeats_its_texture():
    mesh = floor()
    assert (mesh.positions[:, 1] == 0).all()
    assert mesh.uvs.max() > 1
    assert mesh.texture is not None
