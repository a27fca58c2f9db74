"""What a file names is read from its own folder only, unless the user allows more; from a network never."""

import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest

from app.files.file_access import NamedFileError, NamedFiles, OutsideError, OutsideWarning, is_network_path
from app.files.mesh_files import load_meshes
from app.files.mesh_formats.reading import MeshFileError, OutsideMeshError
from app.files.open_any import open_any
from app.files.state_files import load_state, save_state
from app.files.state_scenes import OutsideSourceError
from tests.app.cli.cli_runs import refused, run_program
from tests.app.files.mesh_writing import GltfWriter, ply_text, write, write_image

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
NETWORK = [
    "//server/share/skin.png",
    "\\\\server\\share\\skin.png",
    "http://server/skin.png",
    "//?/C:/skin.png",
]


@pytest.fixture
def folders(tmp_path: Path) -> tuple[Path, Path]:
    """Return the folder of a mesh, and one beside it with a texture, a material file and a mesh."""
    inside, outside = tmp_path / "meshes", tmp_path / "other"
    inside.mkdir()
    outside.mkdir()
    write_image(outside / "skin.png", [[(255, 0, 0)]])
    write(outside / "looks.mtl", "newmtl a\nKd 0 1 0\n")
    write(outside / "square.obj", TRIANGLE + "f 1 2 3\n")
    return inside, outside


def textured_obj(folder: Path, texture: str) -> Path:
    write(folder / "looks.mtl", f"newmtl a\nmap_Kd {texture}\n")
    return write(folder / "a.obj", f"mtllib looks.mtl\n{TRIANGLE}usemtl a\nf 1/1 2/1 3/1\n")


def textured_ply(folder: Path, texture: str) -> Path:
    lines = [f"{line} 0 0" for line in ("0 0 0", "1 0 0", "0 1 0")]
    more = f"comment TextureFile {texture}\n"
    return write(folder / "a.ply", ply_text(lines, ["3 0 1 2"], "x y z s t", more))


def textured_gltf(folder: Path, texture: str) -> Path:
    writer = GltfWriter()
    positions = np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    writer.primitive([[0, 1, 2]], 0, POSITION=positions, TEXCOORD_0=np.zeros((3, 2), np.float32))
    writer.header |= {
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": texture}],
    }
    return write(folder / "a.glb", writer.glb())


WAYS = [textured_obj, textured_ply, textured_gltf]


@pytest.mark.parametrize("make", WAYS)
@pytest.mark.parametrize("way", ["above", "absolute", "link", "through a link"])
def test_a_texture_outside_is_left_out_unless_it_is_allowed(folders, make, way):
    inside, outside = folders
    name = {"above": "../other/skin.png", "absolute": f"{outside}/skin.png", "link": "linked.png"}.get(
        way, ""
    )
    if way == "link":
        (inside / "linked.png").symlink_to(outside / "skin.png")
    elif not name:
        (inside / "folder").symlink_to(outside)
        name = "folder/skin.png"
    path = make(inside, name)
    (warning,) = load_meshes(path).warnings
    assert isinstance(warning, OutsideWarning)
    assert name in warning
    assert f"is outside the folder of {path.name}; it is left out" in warning
    assert load_meshes(path).meshes[0].texture is None
    allowed = load_meshes(path, allows_outside=True)
    assert allowed.warnings == ()
    assert allowed.meshes[0].texture.pixels.tolist() == [[[1, 0, 0]]]


@pytest.mark.parametrize("make", WAYS)
@pytest.mark.parametrize("name", NETWORK)
def test_a_network_is_never_asked(folders, make, name, monkeypatch):
    path = make(folders[0], name)
    asked = []
    for function in ("stat", "lstat", "open"):
        monkeypatch.setattr(os, function, asking(getattr(os, function), asked))
    for allows in (False, True):
        (warning,) = load_meshes(path, allows_outside=allows).warnings
        assert "is on a network, from where no named file is read" in warning
    assert [place for place in asked if "server" in place or place.startswith(("//", "\\\\"))] == []


def asking(function, asked):
    def noted(place, *arguments, **options):
        asked.append(str(place))
        return function(place, *arguments, **options)

    return noted


def test_a_network_path_is_known_by_its_beginning():
    assert all(map(is_network_path, [*NETWORK, "smb://server/x", "file://server/x"]))
    assert not any(
        map(is_network_path, ["skin.png", "a/b.png", "/tmp/skin.png", "C:/skin.png", "../x.png", ""])
    )


def test_a_material_file_outside_is_left_out_unless_it_is_allowed(folders):
    inside, _ = folders
    path = write(inside / "a.obj", f"mtllib ../other/looks.mtl\n{TRIANGLE}usemtl a\nf 1 2 3\n")
    (warning,) = load_meshes(path).warnings
    assert warning == (
        "material file ../other/looks.mtl is outside the folder of a.obj; its materials are left out"
    )
    assert load_meshes(path, allows_outside=True).meshes[0].colors[0].tolist() == [0, 1, 0, 1]


def test_a_material_file_in_a_subfolder_names_textures_of_the_whole_folder(folders):
    inside, outside = folders
    (inside / "materials").mkdir()
    shutil.copy(outside / "skin.png", inside / "skin.png")
    write(inside / "materials" / "looks.mtl", "newmtl a\nmap_Kd ../skin.png\n")
    text = f"mtllib materials/looks.mtl\n{TRIANGLE}usemtl a\nf 1/1 2/1 3/1\n"
    loaded = load_meshes(write(inside / "a.obj", text))
    assert loaded.warnings == ()
    assert loaded.meshes[0].texture is not None


def test_a_buffer_outside_is_refused_unless_it_is_allowed(folders):
    inside, outside = folders
    writer = GltfWriter()
    writer.primitive([[0, 1, 2]], POSITION=np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]))
    text = writer.gltf(outside / "a.bin").replace('"a.bin"', '"../other/a.bin"')
    path = write(inside / "a.gltf", text)
    for is_cancelled in (None, lambda: False):
        with pytest.raises(OutsideMeshError, match=r"its file \.\./other/a\.bin is outside the folder"):
            load_meshes(path, None, is_cancelled)
    assert len(load_meshes(path, None, lambda: False, allows_outside=True).meshes) == 1


def saved_state(folders: tuple[Path, Path]) -> Path:
    """Return a state in the folder of meshes whose mesh is in the other folder, as this program writes it."""
    inside, outside = folders
    opened = open_any(str(outside / "square.obj"))
    save_state(inside / "a.rasterscope", opened_state(opened))
    return inside / "a.rasterscope"


def opened_state(opened):
    from app.files.state_files import State

    return opened.state or State(opened.document)


def change_source(path: Path, **changes: object) -> None:
    """Change the source of a state file, as another program or a text editor would."""
    record = json.loads(path.read_text())
    record["scene"]["source"] |= changes
    path.write_text(json.dumps(record))


def test_a_state_of_this_program_opens_its_mesh_wherever_it_is(folders):
    load_state(saved_state(folders))


@pytest.mark.parametrize("changes", [{"mark": ""}, {"mark": "00" * 32}, {"allows_outside": True}])
def test_a_state_of_another_program_opens_a_mesh_outside_only_if_that_is_allowed(folders, changes):
    path = saved_state(folders)
    change_source(path, **changes)
    with pytest.raises(
        OutsideSourceError, match=r"its mesh file \.\./other/square\.obj is outside the folder"
    ):
        load_state(path)
    state, _ = load_state(path, allows_outside=True)
    assert state.document.title == "square"


def test_a_state_with_the_mark_of_another_machine_is_refused(folders, monkeypatch, tmp_path):
    path = saved_state(folders)
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path / "another user"))
    with pytest.raises(OutsideSourceError):
        load_state(path)


def test_a_state_never_opens_a_mesh_from_a_network(folders):
    path = saved_state(folders)
    change_source(path, file="//server/share/square.obj", mark="")
    with pytest.raises(ValueError, match="is on a network"):
        load_state(path, allows_outside=True)


def test_what_was_open_last_opens_again_also_without_a_mark(folders, monkeypatch):
    path = saved_state(folders)
    change_source(path, mark="")
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(path.parent))
    load_state(path)


def test_a_state_keeps_that_outside_was_allowed(folders):
    inside, _ = folders
    mesh = textured_obj(inside, "../other/skin.png")
    state = inside / "a.rasterscope"
    save_state(state, opened_state(open_any(str(mesh), allows_outside=True)))
    opened = open_any(str(state))
    assert opened.left_outside == ()
    assert opened.document.scene.meshes[0].texture is not None


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_beside_a_mesh_is_not_waited_for(folders):
    inside, _ = folders
    os.mkfifo(inside / "pipe")
    (warning,) = load_meshes(textured_obj(inside, "pipe")).warnings
    assert "pipe of material a is not a file" in warning
    for ending in (".rasterscope", ".obj"):
        os.mkfifo(inside / f"pipe{ending}")
        with pytest.raises(ValueError, match="is not a file"):
            open_any(str(inside / f"pipe{ending}"))


def test_a_device_is_no_texture_even_where_outside_is_allowed(folders):
    (warning,) = load_meshes(textured_obj(folders[0], "/dev/zero"), allows_outside=True).warnings
    assert "/dev/zero of material a is not a file" in warning


def test_an_image_that_another_program_would_decode_is_no_image(folders):
    inside, _ = folders
    write(inside / "a.eps", "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 8 8\nshowpage\n")
    (warning,) = load_meshes(textured_obj(inside, "a.eps")).warnings
    assert "a.eps of material a is not an image" in warning


def test_names_with_a_zero_byte_or_of_great_length_are_not_there(tmp_path):
    files = NamedFiles(tmp_path / "a.obj")
    for name in ("a\0b.png", "x" * 5000, "x/" * 3000, ""):
        with pytest.raises(NamedFileError) as problem:
            files.find(name)
        assert not isinstance(problem.value, OutsideError) or "\0" in name


def test_the_command_line_says_what_allows_it(folders):
    inside, _ = folders
    path = textured_obj(inside, "../other/skin.png")
    done = run_program("render", path, "-o", inside / "a.png", "--size", "8x8")
    assert "is outside the folder of a.obj; it is left out; --allow-outside reads it" in done.stderr
    done = run_program("render", path, "-o", inside / "a.png", "--size", "8x8", "--allow-outside")
    assert (done.returncode, done.stderr) == (0, "")
    state = saved_state(folders)
    change_source(state, mark="")
    for command in (("trace", state, "--stage", "raster"), ("screenshot", state, "-o", inside / "b.png")):
        assert "--allow-outside reads it" in refused(1, *command)


def test_a_broken_mesh_file_is_no_question_of_folders(folders):
    with pytest.raises(MeshFileError) as problem:
        load_meshes(write(folders[0] / "a.gltf", "{}"))
    assert not isinstance(problem.value, OutsideMeshError)
