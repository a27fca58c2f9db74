"""State files of meshes: the mesh is taken from its own file, as long as that is the same."""

import json
import os
import shutil
from dataclasses import replace

import numpy as np
import pytest

from app.files.open_any import open_any
from app.files.state_files import EXTENSION, State, load_state, save_state
from app.files.state_models import Bookmark
from app.files.state_scenes import StateFileError
from core.scene import Material, PointLight
from tests.app.files.mesh_writing import SQUARE, write, write_image
from tests.app.files.states import EVERYTHING, again, assert_same


@pytest.fixture
def mesh(tmp_path):
    folder = tmp_path / "meshes"
    folder.mkdir()
    write_image(folder / "square.png", [[(255, 0, 0), (0, 0, 255)]])
    text = SQUARE + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"
    return write(folder / "square.obj", text)


def save(mesh, folder, **changes):
    opened = open_any(str(mesh))
    assert opened.warnings == ()
    document = replace(opened.document, **changes)
    state = State(document, "depth", 3, 2, (5, 6), [Bookmark(stage="raster", position=1)], look=EVERYTHING)
    path = folder / f"a{EXTENSION}"
    save_state(path, state)
    return state, path


def test_the_mesh_is_taken_from_its_file(mesh, tmp_path):
    state, path = save(mesh, tmp_path)
    loaded, _ = load_state(path)
    assert_same(state, loaded)
    assert loaded.document.path == str(mesh)
    record = json.loads(path.read_text())
    assert record["scene"]["source"] == {"file": "meshes/square.obj"}
    assert "arrays" not in record["scene"]["meshes"][0]
    assert set(record["scene"]["meshes"][0]["from_source"]) >= {"positions", "uvs", "texture", "faces"}


def test_both_files_may_move_together(mesh, tmp_path):
    state, path = save(mesh, tmp_path)
    shutil.move(tmp_path / "meshes", tmp_path / "there" / "meshes")
    shutil.move(path, tmp_path / "there" / path.name)
    loaded, _ = load_state(tmp_path / "there" / path.name)
    assert_same(state, loaded)


def test_an_edited_scene_opens_edited(mesh, tmp_path):
    scene = open_any(str(mesh)).document.scene
    moved = scene.meshes[0].positions.copy()
    moved[2, 0] = 0.1
    camera = replace(scene.camera, eye=scene.camera.eye + 0.5, field_of_view=1.25)
    lights = (PointLight(np.array([1.0, 2.0, 3.0]), np.array([0.5, 0.25, 1.0])),)
    scene = replace(
        scene,
        meshes=(replace(scene.meshes[0], positions=moved, material=Material(0.5, 0.5, 0.0, 1.0)),),
        camera=camera,
        lights=lights,
        size=(320, 200),
    )
    state, path = save(mesh, tmp_path, scene=scene)
    assert_same(state, load_state(path)[0])


def test_a_state_that_was_opened_saves_again(mesh, tmp_path):
    state, path = save(mesh, tmp_path)
    loaded, _ = load_state(path)
    other = tmp_path / "deep" / "er"
    other.mkdir(parents=True)
    save_state(other / path.name, loaded)
    source = json.loads((other / path.name).read_text())["scene"]["source"]
    assert source["file"] == "../../meshes/square.obj"
    assert_same(state, load_state(other / path.name)[0])


def test_a_mesh_file_that_is_gone(mesh, tmp_path):
    _, path = save(mesh, tmp_path)
    mesh.unlink()
    with pytest.raises(StateFileError, match=r"a\.rasterscope .* mesh file is missing .*square\.obj"):
        load_state(path)


def test_a_mesh_file_that_has_changed(mesh, tmp_path):
    _, path = save(mesh, tmp_path)
    mesh.write_text(mesh.read_text().replace("v 1 1 0", "v 1 2 0"))
    with pytest.raises(StateFileError, match=r"square\.obj has changed .* positions of mesh 0"):
        load_state(path)


def test_a_texture_that_has_changed(mesh, tmp_path):
    _, path = save(mesh, tmp_path)
    write_image(mesh.parent / "square.png", [[(0, 255, 0), (0, 0, 255)]])
    with pytest.raises(StateFileError, match="the texture of mesh 0"):
        load_state(path)


@pytest.mark.parametrize("how", ["changed", "gone"])
def test_a_mesh_file_that_is_not_the_same_any_more_is_not_needed(mesh, tmp_path, how):
    opened = open_any(str(mesh))
    if how == "gone":
        mesh.unlink()
    else:
        mesh.write_text(SQUARE + "f 1 2 3\n")
        os.utime(mesh, ns=(1, 1))
    state = State(opened.document)
    assert_same(state, again(tmp_path, state))
