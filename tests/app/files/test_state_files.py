"""State files: what is saved opens as it was, and what does not fit is told in one sentence."""

import json
import math
import os
import shutil
from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from app.files.file_writing import FileWriteError
from app.files.open_any import open_any
from app.files.state_files import EXTENSION, State, StateFileError, load_state, readable_json, save_state
from app.files.state_models import Bookmark, Breakpoints, GridLook, Look, OrbitRecord
from app.session.document import VIEWS, Document, TeachingRaster, open_document
from core import STAGES, Settings, render
from core.methods import table
from core.scene import Camera, ClipScene, DirectionalLight, Material, Mesh, PointLight, Scene, Texture
from core.settings import families
from lessons.scenes import make_scene, scene_names
from tests.app.files.mesh_writing import SQUARE, write, write_image

EVERYTHING = Look(
    view="scene",
    views={"raster": "clip"},
    grid=GridLook(
        buffers={"raster": "E0"},
        overlays={"raster": ["tie"]},
        ranges={"E0": (-1.5, 1.5)},
        fits_ranges=True,
        hidden_buffers=["w"],
        middle=(0.25, 0.75),
        zoom=3.0,
    ),
    orbits={"scene": OrbitRecord(azimuth=1.0, elevation=0.5, target=(0.0, 1.0, 0.0), extent=2.0)},
    other={"fill": "hierarchy", "block_size": 4},
    other_buffer="depth",
    panes=["overlays"],
    text_size=125,
    event="tie",
)
FRAME_BUFFERS = ("color", "depth", "primitive", "attributes", "cover_count")


def again(folder, state):
    """Save and load."""
    path = folder / f"state{EXTENSION}"
    save_state(path, state)
    loaded, warnings = load_state(path)
    assert warnings == ()
    return loaded


def assert_same(first, second):
    """Compare two states: every number of the documents, the pictures and the step."""
    for name in ("stage", "position", "level", "pin", "breakpoints", "look"):
        assert getattr(first, name) == getattr(second, name)
    assert tuple(first.bookmarks) == tuple(second.bookmarks)
    one, two = first.document, second.document
    for name in ("raster", "settings", "triangle", "before", "title"):
        assert getattr(one, name) == getattr(two, name)
    assert_same_value(one.scene, two.scene)
    pictures = [render(d.traced_scene, d.settings) for d in (one, two)]
    for name in FRAME_BUFFERS:
        assert getattr(pictures[0], name).tobytes() == getattr(pictures[1], name).tobytes()
    traces = [s.document.make_trace().stage(s.stage) for s in (first, second)]
    explained = [t.explain(min(first.position, t.steps.count)) for t in traces]
    assert (explained[0] is None) == (explained[1] is None)
    if explained[0] is not None:
        assert explained[0].key == explained[1].key
        for name, value in explained[0].values.items():
            assert np.asarray(value).tobytes() == np.asarray(explained[1].values[name]).tobytes()


def assert_same_value(first, second):
    """Compare records field by field, arrays bit for bit."""
    assert type(first) is type(second)
    if isinstance(first, np.ndarray):
        assert (first.dtype, first.shape) == (second.dtype, second.shape)
        assert first.tobytes() == second.tobytes()
        assert not second.flags.writeable
    elif isinstance(first, tuple):
        assert len(first) == len(second)
        for one, two in zip(first, second, strict=True):
            assert_same_value(one, two)
    elif hasattr(first, "__dataclass_fields__"):
        for field in fields(first):
            assert_same_value(getattr(first, field.name), getattr(second, field.name))
    else:
        assert first == second


stages = st.sampled_from(STAGES)
# Named by what they are not: Hypothesis takes a second to find out what UTF-8 can write.
characters = st.characters(exclude_categories=["Cs"])
notes = st.text(characters, max_size=9)
numbers = st.floats(-50, 50, allow_subnormal=False)


def numbers_of(*shape):
    return arrays.arrays(np.float64, shape, elements=numbers)


@st.composite
def settings_values(draw):
    chosen = {family: draw(st.sampled_from(table.names(family))) for family in families()}
    return Settings(**chosen, block_size=draw(st.integers(1, 64)))


@st.composite
def clip_scenes(draw):
    count = draw(st.integers(1, 3))
    texture = None
    if draw(st.booleans()):
        texture = Texture(draw(arrays.arrays(np.float32, (2, 3, 3), elements=st.floats(0, 1, width=32))), "t")
    shared = draw(st.none() | arrays.arrays(np.int64, (count, 3), elements=st.integers(0, 5)))
    return ClipScene(
        draw(numbers_of(count, 3, 4)),
        draw(arrays.arrays(np.float64, (count, 3, draw(st.integers(2, 5))), elements=st.floats(0, 1))),
        (draw(st.integers(1, 20)), draw(st.integers(1, 20))),
        texture,
        draw(arrays.arrays(np.float64, 4, elements=st.floats(0, 1))),
        shared,
    )


@st.composite
def mesh_scenes(draw):
    count = draw(st.integers(3, 6))
    triangles = draw(arrays.arrays(np.int64, (2, 3), elements=st.integers(0, count - 1)))
    mesh = Mesh(
        draw(numbers_of(count, 3)),
        triangles,
        draw(st.none() | numbers_of(count, 3)),
        draw(st.none() | numbers_of(count, 2)),
        draw(st.none() | arrays.arrays(np.float64, (count, 4), elements=st.floats(0, 1))),
        faces=draw(st.none() | st.just(np.array([4, 4]))),
        transform=draw(numbers_of(4, 4)),
        material=Material(0.25, draw(st.floats(0, 1)), 0.5, draw(st.floats(1, 100))),
        name=draw(st.text(characters, max_size=5)),
    )
    projection = draw(st.sampled_from(["perspective", "orthographic"]))
    target = draw(numbers_of(3))
    camera = Camera(
        target + np.array([0.5, 1.0, 4.0]),
        target,
        projection=projection,
        field_of_view=draw(st.floats(0.2, 2.5)),
        near=draw(st.floats(0.1, 1)),
        far=draw(st.floats(2, 100)),
    )
    lights = (DirectionalLight(np.array([0.0, -1.0, draw(numbers)])), PointLight(draw(numbers_of(3))))
    return Scene((mesh,), camera, lights, (12, 9))


@st.composite
def states(draw):
    scene = draw(st.one_of(clip_scenes(), mesh_scenes()))
    settings = draw(settings_values())
    is_orthographic = isinstance(scene, Scene) and scene.camera.projection == "orthographic"
    if is_orthographic and "perspective" in table.get("depth", settings.depth).needs:
        settings = replace(settings, depth="z-float32")
    raster = TeachingRaster(draw(st.integers(1, 16)), draw(st.integers(1, 12)))
    document = Document(
        scene,
        raster,
        settings,
        triangle=draw(st.none() | st.just(0)),
        before=draw(st.sampled_from(["earlier", "cleared"])),
        title=draw(st.text(characters, max_size=8)),
    )
    stage = draw(st.sampled_from(STAGES))
    with np.errstate(all="ignore"):
        count = document.make_trace().stage(stage).steps.count
    return State(
        document,
        stage,
        draw(st.integers(0, count)),
        draw(st.integers(0, 4)),
        draw(st.none() | st.tuples(st.integers(0, raster.columns - 1), st.integers(0, raster.rows - 1))),
        draw(
            st.lists(st.builds(Bookmark, stage=stages, position=st.integers(0, 99), note=notes), max_size=3)
        ),
        draw(
            st.builds(
                Breakpoints,
                pixels=st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), max_size=2),
                condition=st.sampled_from(["", "E0 < 0.5 and covered"]),
            )
        ),
        draw(st.builds(Look, views=st.dictionaries(stages, st.sampled_from(VIEWS), max_size=2))),
    )


@given(states())
def test_loading_gives_the_same_picture_and_the_same_step(tmp_path_factory, state):
    with np.errstate(all="ignore"):
        assert_same(state, again(tmp_path_factory.mktemp("state"), state))


@pytest.mark.parametrize("name", scene_names())
def test_a_built_in_scene_is_named_not_copied(tmp_path, name):
    document = open_any(name).document
    assert_same(State(document), again(tmp_path, State(document)))
    assert (tmp_path / f"state{EXTENSION}").stat().st_size < 8000


def test_a_built_in_scene_with_a_moved_vertex_keeps_the_rest_by_name(tmp_path):
    document = open_any("torus").document
    mesh = document.scene.meshes[0]
    positions = mesh.positions.copy()
    positions[7] += 0.125
    scene = replace(document.scene, meshes=(replace(mesh, positions=positions),))
    state = State(replace(document, scene=scene))
    assert_same(state, again(tmp_path, state))
    record = json.loads((tmp_path / f"state{EXTENSION}").read_text())
    (saved,) = record["scene"]["meshes"]
    assert record["scene"]["source"] == {"built_in": "torus"}
    assert set(saved["arrays"]) == {"positions"}
    assert "triangles" in saved["from_source"]


@pytest.mark.parametrize("name", ["line-strip", "points"])
def test_the_kind_of_primitives_is_kept_and_checked(tmp_path, name):
    path = tmp_path / f"state{EXTENSION}"
    document = open_any(name).document
    assert_same(State(document), again(tmp_path, State(document)))
    record = json.loads(path.read_text())
    assert record["scene"]["primitives"] == document.scene.kind
    for kind, message in (("lines", "scene.primitives must be"), ("triangles", r"clip must be \(T, 3, 4\)")):
        record["scene"]["primitives"] = kind
        path.write_text(json.dumps(record))
        with pytest.raises(StateFileError, match=message):
            load_state(path)


@pytest.mark.parametrize("region", [(-1.0, -1.0, 0.0, 0.0), ((-1.0, -1.0), (1.0, -1.0), (0.0, 1.0))])
def test_the_clip_window_of_lines_is_kept(tmp_path, region):
    document = open_any("segment").document
    scene = replace(document.scene, clip_region=region)
    state = State(replace(document, scene=scene))
    assert_same(state, again(tmp_path, state))


class TestMeshFiles:
    @pytest.fixture
    def mesh(self, tmp_path):
        folder = tmp_path / "meshes"
        folder.mkdir()
        write_image(folder / "square.png", [[(255, 0, 0), (0, 0, 255)]])
        text = SQUARE + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"
        return write(folder / "square.obj", text)

    def save(self, mesh, folder, **changes):
        opened = open_any(str(mesh))
        assert opened.warnings == ()
        document = replace(opened.document, **changes)
        state = State(
            document, "depth", 3, 2, (5, 6), [Bookmark(stage="raster", position=1)], look=EVERYTHING
        )
        path = folder / f"a{EXTENSION}"
        save_state(path, state)
        return state, path

    def test_the_mesh_is_taken_from_its_file(self, mesh, tmp_path):
        state, path = self.save(mesh, tmp_path)
        loaded, _ = load_state(path)
        assert_same(state, loaded)
        assert loaded.document.path == str(mesh)
        record = json.loads(path.read_text())
        assert record["scene"]["source"] == {"file": "meshes/square.obj"}
        assert "arrays" not in record["scene"]["meshes"][0]
        assert set(record["scene"]["meshes"][0]["from_source"]) >= {"positions", "uvs", "texture", "faces"}

    def test_both_files_may_move_together(self, mesh, tmp_path):
        state, path = self.save(mesh, tmp_path)
        shutil.move(tmp_path / "meshes", tmp_path / "there" / "meshes")
        shutil.move(path, tmp_path / "there" / path.name)
        loaded, _ = load_state(tmp_path / "there" / path.name)
        assert_same(state, loaded)

    def test_an_edited_scene_opens_edited(self, mesh, tmp_path):
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
        state, path = self.save(mesh, tmp_path, scene=scene)
        assert_same(state, load_state(path)[0])

    def test_a_state_that_was_opened_saves_again(self, mesh, tmp_path):
        state, path = self.save(mesh, tmp_path)
        loaded, _ = load_state(path)
        other = tmp_path / "deep" / "er"
        other.mkdir(parents=True)
        save_state(other / path.name, loaded)
        source = json.loads((other / path.name).read_text())["scene"]["source"]
        assert source["file"] == "../../meshes/square.obj"
        assert_same(state, load_state(other / path.name)[0])

    def test_a_mesh_file_that_is_gone(self, mesh, tmp_path):
        _, path = self.save(mesh, tmp_path)
        mesh.unlink()
        with pytest.raises(StateFileError, match=r"a\.rasterscope .* mesh file is missing .*square\.obj"):
            load_state(path)

    def test_a_mesh_file_that_has_changed(self, mesh, tmp_path):
        _, path = self.save(mesh, tmp_path)
        mesh.write_text(mesh.read_text().replace("v 1 1 0", "v 1 2 0"))
        with pytest.raises(StateFileError, match=r"square\.obj has changed .* positions of mesh 0"):
            load_state(path)

    def test_a_texture_that_has_changed(self, mesh, tmp_path):
        _, path = self.save(mesh, tmp_path)
        write_image(mesh.parent / "square.png", [[(0, 255, 0), (0, 0, 255)]])
        with pytest.raises(StateFileError, match="the texture of mesh 0"):
            load_state(path)

    @pytest.mark.parametrize("how", ["changed", "gone"])
    def test_a_mesh_file_that_is_not_the_same_any_more_is_not_needed(self, mesh, tmp_path, how):
        opened = open_any(str(mesh))
        if how == "gone":
            mesh.unlink()
        else:
            mesh.write_text(SQUARE + "f 1 2 3\n")
            os.utime(mesh, ns=(1, 1))
        state = State(opened.document)
        assert_same(state, again(tmp_path, state))


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
        (put(3, "version"), "it is of version 3, and this Rasterscope opens versions 1 to 2"),
        (put("1", "version"), "it is of version 1, and this Rasterscope opens versions 1 to 2"),
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
        ({"rows": None, "zlib": "eJwDAAAAAAE=", "shape": [2**40, 3, 4]}, "must not be larger than 4 GiB"),
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


def test_saving_where_it_is_not_possible_leaves_the_old_file(tmp_path):
    state = State(open_any("cube").document)
    with pytest.raises(FileWriteError, match="there is no folder"):
        save_state(tmp_path / "gone" / "a.rasterscope", state)
    path = tmp_path / "a.rasterscope"
    save_state(path, state)
    before = path.read_bytes()
    with pytest.raises(ValueError, match="position"):
        save_state(path, replace(state, position=-1))
    assert path.read_bytes() == before
    assert [found.name for found in tmp_path.iterdir()] == ["a.rasterscope"]


def test_the_file_can_be_read_by_people(tmp_path):
    again(tmp_path, State(open_any("single-triangle").document))
    lines = (tmp_path / f"state{EXTENSION}").read_text().splitlines()
    assert ' "version": 2,' in lines
    assert '  "fill_rule": "shared-edge",' in lines
    assert max(map(len, lines)) < 200
    assert len(lines) < 80


@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.text(characters),
        lambda v: st.lists(v) | st.dictionaries(st.text(characters), v),
    )
)
def test_readable_json_is_json(value):
    assert json.loads(readable_json(value)) == value


def test_a_pin_beside_the_raster_is_taken_away_with_a_warning(tmp_path):
    path = tmp_path / "state.rasterscope"
    document = open_document(make_scene("single-triangle"), "Single triangle")
    save_state(path, State(document, pin=(9999, 3)))
    state, warnings = load_state(path)
    assert state.pin is None
    assert warnings == ("The pinned pixel (9999, 3) is not in the raster: nothing is pinned.",)
