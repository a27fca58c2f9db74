"""Files without faces: lines of OBJ, PLY and DXF open as segments, vertices of OBJ, PLY and XYZ as points."""

from pathlib import Path

import numpy as np
import pytest

from app.files.mesh_files import load_meshes, open_mesh
from app.files.mesh_formats.reading import MeshFileError
from app.files.open_any import open_any
from core import render
from tests.app.files.mesh_writing import CIRCLE, INSERT, POLYLINE, SEGMENT, dxf_text, write

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
        ("a.xyz", "5 5 5\n", "points", [[0]], "1 point is drawn"),
        ("a.xyz", "# x y z\n0 0 0\n\n1,2,3\n", "points", [[0], [1]], "2 points are drawn"),
        (
            "a.dxf",
            dxf_text(SEGMENT, POLYLINE),
            "segments",
            [[0, 1], [2, 3], [3, 4], [4, 5]],
            "4 segments are drawn",
        ),
    ],
)
def test_they_open_as_a_scene_and_it_says_so(
    tmp_path: Path, name: str, content: str, kind: str, index: list[list[int]], said: str
) -> None:
    opened = open_any(str(write(tmp_path / name, content)))
    scene = opened.document.scene
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


def test_a_circle_of_a_drawing_is_round_and_a_block_stands_where_it_is_inserted(tmp_path: Path) -> None:
    wires = load_meshes(write(tmp_path / "a.dxf", dxf_text(CIRCLE, INSERT))).wires
    assert wires.positions[-2:].tolist() == [[5, 5, 0], [9, 8, 0]]
    assert np.allclose(np.hypot(*(wires.positions[:-2, :2] - 1).T), 2)
    assert len(wires.positions) > 40


def test_colours_of_points_are_bytes_and_other_columns_are_left_out(tmp_path: Path) -> None:
    wires = load_meshes(write(tmp_path / "a.xyz", "0 0 0 255 0 0\n1 0 0 0 0 255\n")).wires
    assert wires.colors.tolist() == [[1, 0, 0, 1], [0, 0, 1, 1]]
    normals = load_meshes(write(tmp_path / "b.xyz", "0 0 0 0.6 0 0.8\n1 0 0 0 0 1\n"))
    assert normals.wires.colors is None
    assert "columns 4 to 6" in normals.warnings[1]


@pytest.mark.parametrize(
    ("entity", "wanted"),
    [
        ("0\nELLIPSE\n10\n0\n20\n0\n", "1 ELLIPSE"),
        (SEGMENT + "31\n1.5\n", "heights"),
        (CIRCLE + "230\n-1.0\n", "plane"),
        (INSERT + "70\n3\n", "block"),
    ],
)
def test_a_drawing_says_what_of_it_is_not_drawn(tmp_path: Path, entity: str, wanted: str) -> None:
    assert load_meshes(write(tmp_path / "a.dxf", dxf_text(SEGMENT))).warnings[1:] == ()
    (said,) = load_meshes(write(tmp_path / "a.dxf", dxf_text(SEGMENT, entity))).warnings[1:]
    assert wanted in said


@pytest.mark.parametrize(
    ("name", "content", "wanted"),
    [
        ("a.xyz", "0 0 0\n\n1 x 0\n2 2 2\n", "line 3"),
        ("a.xyz", "0 0 0\n1 0\n2 2 2 2\n", "line 2"),
        ("a.xyz", "3\nwater\nO 0 0 0\n", "line 1"),
        ("a.xyz", "# nothing\n", "no points"),
        ("a.xyz", "0 0 nan\n", "vertex 0"),
        ("a.xyz", b"\0\1\2", "not text"),
        ("a.dxf", "Dear reader,\nthis is a letter.\n", "not a DXF file"),
        ("a.dxf", dxf_text(SEGMENT)[:-30], "cut short"),
        ("a.dxf", dxf_text(SEGMENT).replace("4.0", "four"), "cannot be read as DXF"),
        ("a.dxf", dxf_text(SEGMENT.replace("4.0", "nan")), "vertex 1"),
        ("a.dxf", dxf_text(), "no lines"),
        ("a.dxf", dxf_text(*[INSERT] * 90_000), "too large"),
        ("a.dxf", dxf_text(SEGMENT, f"0\nTEXT\n1\n{'x' * 2**20}\n", *[SEGMENT] * 40), "too large"),
    ],
)
def test_what_cannot_be_read_is_refused_with_one_sentence(
    tmp_path: Path, name: str, content: str | bytes, wanted: str
) -> None:
    with pytest.raises(MeshFileError) as problem:
        load_meshes(write(tmp_path / name, content))
    assert wanted in str(problem.value)
    assert name in str(problem.value)
    assert "\n" not in str(problem.value)
