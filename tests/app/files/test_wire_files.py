"""Files without faces: OBJ's lines and points and PLY's edges and vertices open as segments and points."""

from pathlib import Path

import numpy as np
import pytest

from app.files.mesh_files import MeshFileError, load_meshes, open_mesh
from app.files.open_any import open_any
from core import ClipScene, render
from tests.app.files.mesh_writing import write

VERTICES = "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 1\n"
PLY = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n{}end_header\n"
PLACES = "0 0 0\n2 0 0\n1 2 0\n"
EDGES = "element edge 2\nproperty int vertex1\nproperty int vertex2\n"


@pytest.mark.parametrize(
    ("name", "content", "kind", "index", "said"),
    [
        (
            "a.obj",
            VERTICES + "l 1 2 3\nl -1/2 1\n",
            "segments",
            [[0, 1], [1, 2], [3, 0]],
            "3 segments are drawn",
        ),
        ("a.obj", VERTICES + "p 1 3 # two\np 4\n", "points", [[0], [2], [3]], "3 points are drawn"),
        ("a.obj", VERTICES + "p 1\nl 1 2\n", "segments", [[0, 1]], "1 segment is drawn"),
        ("a.obj", VERTICES, "points", [[0], [1], [2], [3]], "4 points are drawn"),
        ("a.ply", PLY.format("") + PLACES, "points", [[0], [1], [2]], "3 points are drawn"),
        (
            "a.ply",
            PLY.format(EDGES) + PLACES + "0 1\n2 0\n",
            "segments",
            [[0, 1], [2, 0]],
            "2 segments are drawn",
        ),
    ],
)
def test_they_open_as_a_scene_and_it_says_so(
    tmp_path: Path, name: str, content: str, kind: str, index: list[list[int]], said: str
) -> None:
    opened = open_any(str(write(tmp_path / name, content)))
    scene = opened.document.scene
    assert isinstance(scene, ClipScene)
    assert (scene.kind, scene.shared.tolist()) == (kind, index)
    assert opened.warnings[0] == f"{name} has no faces: {said}"
    assert (scene.clip[..., 3] > 0).all()
    assert (np.abs(scene.clip[..., :3]) <= scene.clip[..., 3:]).all()
    assert (render(scene).primitive >= 0).any()


def test_points_beside_lines_and_lines_beside_faces_are_left_out_with_a_sentence(tmp_path: Path) -> None:
    both = load_meshes(write(tmp_path / "a.obj", VERTICES + "l 1 2\np 1\np 2\n"), None, lambda: False)
    assert both.warnings == (
        "a.obj has no faces: 1 segment is drawn",
        "2 points beside the segments are left out",
    )
    faces = load_meshes(write(tmp_path / "b.obj", VERTICES + "f 1 2 3\nl 1 2 3\n"))
    assert faces.warnings == ("2 segments and 0 points beside the faces are left out",)
    assert (len(faces.meshes), faces.wires) == (1, None)


def test_colours_go_along(tmp_path: Path) -> None:
    text = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nl 1 3\n"
    scene = open_mesh(write(tmp_path / "a.obj", text)).scene
    assert isinstance(scene, ClipScene)
    assert scene.attributes is not None
    assert scene.attributes[0].tolist() == [[1, 0, 0, 1], [0, 0, 1, 1]]


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.obj", VERTICES + "l 1\n", "a.obj, line 5: a line needs at least 2 vertices, got 1"),
        ("a.obj", VERTICES + "l 1 9\n", "a.obj: a line or point names vertex 9 of 4, counted from 1"),
        ("a.obj", VERTICES + "p x\n", "a.obj, line 5: x is not a corner of a face"),
        ("a.ply", PLY.format(EDGES) + PLACES + "0 7\n0 1\n", "a line or point names vertex 8 of 3"),
        ("a.ply", PLY.format("") + "0 0 nan\n1 0 0\n0 1 0\n", "a.ply"),
    ],
)
def test_what_is_wrong_is_one_sentence(tmp_path: Path, name: str, content: str, message: str) -> None:
    with pytest.raises(MeshFileError) as caught:
        open_mesh(write(tmp_path / name, content))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)
