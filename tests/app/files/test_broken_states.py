"""State files that are damaged, or do not fit: one sentence names the field."""

import json
import math
from dataclasses import replace

import pytest

from app.files.open_any import open_any
from app.files.state_files import EXTENSION, State, load_state, save_state
from app.files.state_scenes import StateFileError
from app.session.document import Document, TeachingRaster
from core import Settings
from lessons.scenes import make_scene
from tests.app.files.states import EVERYTHING


def edited(change):
    """Return the text of a state file that ``change`` has been applied to."""

    def make(folder):
        path = folder / f"state{EXTENSION}"
        scene = replace(make_scene("cube"), size=(32, 32))
        document = Document(scene, TeachingRaster(32, 32), title="Cube")
        save_state(path, State(document, pin=(1, 2), look=EVERYTHING))
        record = json.loads(path.read_text())
        change(record)
        path.write_text(json.dumps(record))
        return path

    return make


def put(value, *where):
    def change(record):
        for name in where[:-1]:
            record = record[name]
        record[where[-1]] = value

    return change


def drop(*where):
    def change(record):
        for name in where[:-1]:
            record = record[name]
        del record[where[-1]]

    return change


@pytest.mark.parametrize(
    ("change", "wanted"),
    [
        (put(4, "version"), "it is of version 4, and this Rasterscope opens versions 1 to 3"),
        (put("1", "version"), "it is of version 1, and this Rasterscope opens versions 1 to 3"),
        (put(0, "version"), "it is of version 0"),
        (put(True, "version"), "it is of version True"),
        (drop("version"), "it is of version None"),
        (put("paint", "program"), "it is not a state file of Rasterscope"),
        (put(1, "title"), "title must be a valid string, got 1"),
        (put("raster", "raster"), "raster must be"),
        (put("eight", "raster", "columns"), "raster.columns must be a valid integer, got 'eight'"),
        (put(8.5, "raster", "columns"), "raster.columns must be a valid integer, got 8.5"),
        (put(True, "raster", "columns"), "raster.columns must be a valid integer, got True"),
        (put(0, "raster", "columns"), "raster: teaching raster must be 1x1 to 96x72 pixels, got 0x32"),
        (put(4000, "raster", "rows"), "teaching raster must be 1x1 to 96x72 pixels"),
        (put([40, 40], "raster", "origin"), "region must contain pixels of the 32x32 image"),
        (put([-1, 0], "raster", "origin"), "raster.origin.0 must be greater than or equal to 0, got -1"),
        (drop("raster", "rows"), "raster.rows is missing"),
        (put(3, "colour"), "colour is not a known field"),
        (put(math.nan, "scene", "camera", "near"), "scene.camera.near must be a finite number"),
        (put(math.inf, "scene", "background", 0), "scene.background.0 must be a finite number"),
        (put("near", "scene", "camera", "near"), "camera.near must be a valid number, got 'near'"),
        (put(50.0, "scene", "camera", "near"), "near must be less than far, got near 50"),
        (put(-1.0, "scene", "camera", "near"), "near must be positive for a perspective camera"),
        (put(0.0, "scene", "camera", "field_of_view"), "field of view must be between 0 and 180 degrees"),
        (put(math.pi, "scene", "camera", "field_of_view"), "field of view must be between 0 and 180 degrees"),
        (put("fisheye", "scene", "camera", "projection"), "camera.projection must be 'perspective'"),
        (put([0.0, 0.0], "scene", "camera", "eye"), "scene.camera.eye"),
        (put([0.0, 0.0, 0.0], "scene", "lights", 0, "vector"), "scene.lights.0: light direction"),
        (put("lamp", "scene", "lights", 0, "kind"), "lights.0.kind must be 'directional' or 'point'"),
        (put([0, 5], "scene", "size"), "scene.size.0 must be greater than or equal to 1, got 0"),
        (put([5], "scene", "size"), "scene.size.1 is missing"),
        (put([99999, 5], "scene", "size"), "scene: size must be 1 to 16384 pixels each way"),
        (put("sphere of doom", "scene", "source", "built_in"), "scene must be one of single-triangle"),
        (put("shared-edge", "scene", "source", "built_in"), "shared-edge has no meshes"),
        (put("sphere", "scene", "source", "built_in"), "sphere has changed since the state was saved"),
        (put("x.obj", "scene", "source", "file"), "a source is either built_in or file"),
        (put([], "scene", "meshes"), "scene.meshes must have"),
        (put("blob", "scene", "kind"), "scene"),
        (put(4, "scene", "meshes", 0, "source_mesh"), "cube has changed"),
        (drop("scene", "meshes", 0, "from_source", "positions"), "meshes.0.arrays.positions is missing"),
        (
            put("0", "scene", "meshes", 0, "from_source", "weights"),
            "has an array weights; those of a mesh are",
        ),
        (
            put(2.0, "scene", "meshes", 0, "material", "ambient"),
            "material ambient must be from 0 to 1, got 2",
        ),
        (put("magic", "settings", "fill"), "settings: fill must be one of"),
        (put("red", "settings", "colour"), "settings: setting must be one of"),
        (
            put(0, "settings", "block_size"),
            "settings: block_size must be a whole number from 1 to 256, got 0",
        ),
        (put([], "settings", "fill"), "settings.fill"),
        (put(12, "triangle"), "triangle must be 0 to 11, got 12"),
        (put(-1, "triangle"), "triangle must be greater than or equal to 0, got -1"),
        (put("later", "before"), "before must be earlier or cleared, got later"),
        (put("paint", "stage"), "stage: must be one of transform, cull"),
        (put(-5, "position"), "position must be greater than or equal to 0, got -5"),
        (put(9, "level"), "level must be less than or equal to 4, got 9"),
        (put([1], "pin"), "pin.1 is missing"),
        (put([{"stage": "x", "position": 0}], "bookmarks"), "bookmarks.0.stage: must be one of transform"),
        (put([["raster", 0]], "bookmarks"), "bookmarks.0"),
        (put("zz", "look", "view"), "look.view: must be one of pixels, scene, "),
        (put({"x": "pixels"}, "look", "views"), "look.views.x.[key]: must be one of transform"),
        (put({"zoom": 0.0}, "look", "grid"), "look.grid.zoom must be greater than or equal to 0.01, got 0"),
        (put({"ranges": {"z": [1.0, 0.0]}}, "look", "grid"), "the first end must not be above the second"),
        (put({"middle": [0.5, 2.0]}, "look", "grid"), "look.grid.middle.1 must be less than or equal to 1"),
        (put({"fill": "magic"}, "look", "other"), "look.other: fill must be one of"),
        (put({"condition": "import os"}, "breakpoints"), "breakpoints.condition: a condition compares"),
        (put({"lines": [["cover", 0]]}, "breakpoints"), "breakpoints.lines.0.1 must be greater than"),
    ],
)
def test_a_field_that_does_not_fit_is_named(tmp_path, change, wanted):
    path = edited(change)(tmp_path)
    with pytest.raises(StateFileError) as problem:
        load_state(path)
    text = str(problem.value)
    assert text.startswith("state.rasterscope cannot be opened: ")
    assert wanted in text
    assert "\n" not in text


ARRAY = {"dtype": "float64", "shape": [1, 3, 4], "rows": [[0, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 1.5]]}


@pytest.mark.parametrize(
    ("change", "wanted"),
    [
        ({"rows": None}, "an array must have either rows, zlib or file"),
        ({"zlib": "AAAA"}, "an array must have either rows, zlib or file"),
        ({"rows": [[0, 0, 0, 1]]}, "scene.clip: shape [1, 3, 4] wants 12 numbers, got 4"),
        ({"shape": [2, 3, 4]}, "wants 24 numbers, got 12"),
        ({"shape": [3, 4]}, "clip must be (T, 3, 4), got (3, 4)"),
        ({"shape": [-1, 3, 4]}, "shape.0 must be greater than or equal to 0"),
        ({"dtype": "object"}, "dtype must be 'float64', 'float32' or 'int64'"),
        ({"dtype": "int64"}, "scene.clip: numbers of int64 must be whole"),
        ({"rows": [["one"] * 4] * 3}, "scene.clip.rows.0.0"),
        ({"rows": [[10**400] * 4] * 3}, "scene"),
        ({"rows": None, "zlib": "§§"}, "the compressed bytes are damaged"),
        ({"rows": None, "zlib": "AAAA"}, "the compressed bytes are damaged"),
        ({"rows": None, "zlib": "eJwDAAAAAAE="}, "wants 96 bytes, got 0"),
        (
            {"rows": None, "zlib": "eJwDAAAAAAE=", "shape": [2**40, 3, 4]},
            "its arrays would take 98304.0 GiB of",
        ),
    ],
)
def test_an_array_that_is_damaged_is_told(tmp_path, change, wanted):
    path = tmp_path / f"state{EXTENSION}"
    save_state(path, State(open_any("single-triangle").document))
    record = json.loads(path.read_text())
    record["scene"]["clip"] = {k: v for k, v in {**ARRAY, **change}.items() if v is not None}
    path.write_text(json.dumps(record))
    with pytest.raises(StateFileError) as problem:
        load_state(path)
    assert wanted in str(problem.value)
    assert "\n" not in str(problem.value)


def test_the_array_that_was_damaged_opens_whole(tmp_path):
    path = tmp_path / f"state{EXTENSION}"
    save_state(path, State(open_any("single-triangle").document))
    record = json.loads(path.read_text())
    record["scene"]["clip"] = ARRAY
    path.write_text(json.dumps(record))
    assert load_state(path)[0].document.scene.clip[0, 2].tolist() == [0, 1, 0, 1.5]


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\x89PNG\r\n\x1a\n",
        b"hello",
        b"[]",
        b"null",
        b"[" * 100_000,
        b'{"version": ' + b"9" * 5000 + b"}",
    ],
    ids=["empty", "picture", "text", "list", "null", "deep", "long"],
)
def test_what_is_no_state_is_refused(tmp_path, content):
    path = tmp_path / f"a{EXTENSION}"
    path.write_bytes(content)
    with pytest.raises(StateFileError, match="it is not a state file"):
        load_state(path)


def test_a_part_of_a_state_is_refused(tmp_path):
    path = tmp_path / f"a{EXTENSION}"
    save_state(path, State(open_any("cube").document))
    content = path.read_bytes()
    for length in range(1, len(content) - 2, 97):
        path.write_bytes(content[:length])
        with pytest.raises(StateFileError, match="it is incomplete"):
            load_state(path)


def test_a_path_that_cannot_be_read(tmp_path):
    with pytest.raises(StateFileError, match="there is no file"):
        load_state(tmp_path / f"gone{EXTENSION}")
    folder = tmp_path / f"folder{EXTENSION}"
    folder.mkdir()
    with pytest.raises(StateFileError, match=r"folder\.rasterscope cannot be opened: "):
        load_state(folder)
    with pytest.raises(StateFileError):
        open_any(str(tmp_path / f"gone{EXTENSION.upper()}"))


def test_a_method_that_the_scene_cannot_serve_is_told(tmp_path):
    def change(record):
        record["scene"]["camera"]["projection"] = "orthographic"
        record["settings"]["depth"] = "inverse-w"

    with pytest.raises(StateFileError, match="settings: depth inverse-w needs a perspective camera"):
        load_state(edited(change)(tmp_path))


def test_a_family_that_is_left_out_has_its_default(tmp_path):
    path = edited(drop("settings", "fill"))(tmp_path)
    assert load_state(path)[0].document.settings == Settings()
