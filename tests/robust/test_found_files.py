"""Files that once ended in a traceback, or took far more memory or time than they hold, each as small as it can be."""

import json
import struct

import numpy as np
import pytest

from app.files.mesh_files import load_meshes
from app.files.mesh_formats.reading import MeshFileError
from app.pages.compare.study_files import StudyFileError, load_study
from tests.app.files.mesh_writing import SQUARE, GltfWriter, ply_text, stl_text, write
from tests.app.files.test_earlier_files import EARLIER

LINES = ["0 0 0", "1 0 0", "0 1 0"]

REFUSED = {
    "rows without properties": (
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 1000000000000\nelement face 1000000000\nend_header\n",
        "has no vertices",
    ),
    "a list that is 2.5 long": ("a.ply", ply_text(LINES, ["2.5 0 1 2"]), "a list of face has length -1"),
    "a list that is not a number long": ("a.ply", ply_text(LINES, ["nan 0 1 2"]), "has length -1"),
    "a word among numbers": ("a.ply", ply_text([*LINES[:2], "0 x 0"], ["3 0 1 2"]), "a.ply, line 12"),
    "a texture coordinate without numbers": ("a.obj", SQUARE + "vt\nf 1 2 3\n", "line 5"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_file_that_was_found_is_refused_with_one_sentence(tmp_path, name):
    file, content, wanted = REFUSED[name]
    with pytest.raises(MeshFileError) as problem:
        load_meshes(write(tmp_path / file, content))
    assert wanted in str(problem.value)
    assert file in str(problem.value)


@pytest.mark.parametrize(
    ("names", "wanted"),
    [
        ("x y z s", "vertices have s without t; s is left out"),
        ("x y z nx nz", "vertices have nx, nz without ny; nx, nz is left out"),
    ],
)
def test_a_ply_with_half_of_its_columns_opens_without_them(tmp_path, names, wanted):
    lines = [f"{line}{' 0' * (len(names.split()) - 3)}" for line in LINES]
    loaded = load_meshes(write(tmp_path / "a.ply", ply_text(lines, ["3 0 1 2"], names)))
    assert loaded.warnings == (wanted,)
    assert (loaded.meshes[0].uvs, loaded.meshes[0].normals) == (None, None)


def repeat_a_method(record):
    record["points"] *= 2


def repeat_a_measure(record):
    record["measures"] *= 2


def name_an_error_that_nothing_measures(record):
    record["points"][0]["errors"]["x"] = 1.0


@pytest.mark.parametrize(
    ("change", "wanted"),
    [
        (lambda record: record["dials"].clear(), "dials must be those of its work"),
        (repeat_a_method, "every method must be there once"),
        (repeat_a_measure, "every measure must be there once"),
        (name_an_error_that_nothing_measures, "errors must be those of the measures, .* has x"),
    ],
)
def test_a_study_that_does_not_fit_together_is_refused(tmp_path, change, wanted):
    record = json.loads((EARLIER / "study-cull-closed.json").read_text())
    change(record)
    with pytest.raises(StudyFileError, match=wanted):
        load_study(write(tmp_path / "a.json", json.dumps(record)))


def test_a_binary_stl_that_counts_more_than_it_has_is_refused(tmp_path):
    content = b" " * 80 + struct.pack("<I", 2**32 - 1) + bytes(50)
    with pytest.raises(MeshFileError, match=r"a\.stl"):
        load_meshes(write(tmp_path / "a.stl", content))


def test_infinite_corners_of_a_text_stl_are_refused_without_a_warning(tmp_path):
    text = stl_text(np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]])).replace("vertex 1 0 0", "vertex 1e999 0 0")
    with pytest.raises(MeshFileError, match=r"a\.stl"):
        load_meshes(write(tmp_path / "a.stl", text))


def test_a_signalling_nan_in_a_gltf_is_refused_without_a_warning(tmp_path):
    writer = GltfWriter()
    corners = np.frombuffer(b"\x01\x00\xa0\x7f" * 9, np.float32).reshape(3, 3)
    writer.primitive([[0, 1, 2]], POSITION=corners)
    with pytest.raises(MeshFileError, match=r"a\.glb"):
        load_meshes(write(tmp_path / "a.glb", writer.glb()))
