"""How much memory something takes is asked before it is allocated, and what is free is what the system grants."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from app.cli import trace
from app.cli.render import check_memory
from app.files import state_scenes
from app.files.mesh_files import load_meshes
from app.files.mesh_formats import gltf
from app.files.mesh_formats.reading import MeshFileError
from app.files.open_any import open_any
from app.files.state_arrays import array_from, array_record
from app.files.state_files import State, save_state
from app.files.state_scenes import StateFileError
from app.session import document, memory
from app.session.document import open_document
from app.session.memory import GIBI, MEBI, MemoryBoundError, Need, amounts, check_free, free_memory
from app.session.tracing import trace_now
from core import ClipScene, Settings
from tests.app.cli.cli_runs import refused, run_program
from tests.app.files.mesh_writing import GltfWriter, write


def system(folder: Path, groups: str, **files: str) -> Path:
    """Write the files of a system with 8 GiB free; ``cgroup__memory.max`` becomes ``sys/fs/cgroup/...``."""
    files = {
        "proc/meminfo": f"MemTotal: 99 kB\nMemAvailable: {8 * 2**20} kB\n",
        "proc/self/cgroup": groups,
    } | {"sys/fs/cgroup" + name: text for name, text in files.items()}
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


def test_free_is_what_the_machine_has_where_no_group_limits_it(tmp_path):
    root = system(tmp_path, "0::/a\n", **{"/a/memory.max": "max\n", "/a/memory.current": "5\n"})
    assert free_memory(root) == 8 * GIBI


def test_every_control_group_around_the_process_limits_it(tmp_path):
    unused = "anon 3\ninactive_file 1048576\n"
    files = {
        "/a/b/memory.max": f"{3 * GIBI}\n",
        "/a/b/memory.current": "0\n",
        "/a/memory.max": f"{2 * GIBI}\n",
        "/a/memory.current": f"{GIBI}\n",
        "/a/memory.stat": unused,
    }
    assert free_memory(system(tmp_path, "0::/a/b\n", **files)) == GIBI + MEBI


def test_a_control_group_of_the_first_kind_limits_too(tmp_path):
    files = {"/memory/c/memory.limit_in_bytes": f"{GIBI}\n", "/memory/c/memory.usage_in_bytes": f"{MEBI}\n"}
    root = system(tmp_path, "8:pids:/\n4:cpu,memory:/c\n0::/\n", **files)
    assert free_memory(root) == GIBI - MEBI


def test_a_container_that_sees_its_group_as_the_root_is_limited(tmp_path):
    files = {"/memory.max": f"{GIBI}\n", "/memory.current": "0\n"}
    assert free_memory(system(tmp_path, "0::/somewhere/else\n", **files)) == GIBI


@given(st.integers(0, 2**44), st.integers(1, 2**44))
def test_two_amounts_of_memory_never_read_the_same(bound, more):
    texts = amounts(bound + more, bound)
    larger, smaller = (float(text.split()[0]) for text in texts)
    assert larger > smaller


def test_a_picture_that_does_not_fit_is_refused_with_numbers_that_differ(monkeypatch):
    monkeypatch.setattr(memory, "free_memory", lambda: 2e9)
    with pytest.raises(
        ValueError, match=r"a picture of 4096x4096 pixels may take 6\.0 GiB of memory, 1\.8 GiB are"
    ):
        check_memory((4096, 4096), Settings())


def test_parts_of_one_file_share_one_bound():
    need = Need(1000)
    need.ask(1500, 60, "the first")
    need.ask(100, 0, "the second")
    with pytest.raises(MemoryBoundError, match="the third would take"):
        need.ask(1, 0, "the third")
    with pytest.raises(MemoryBoundError, match="are free"):
        check_free(2**70, "all")


def test_an_image_with_few_bits_a_pixel_is_no_large_texture(tmp_path):
    Image.new("1", (8192, 8192)).save(tmp_path / "a.png")
    write(tmp_path / "a.mtl", "newmtl a\nmap_Kd a.png\n")
    text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n"
    (warning,) = load_meshes(write(tmp_path / "a.obj", text)).warnings
    assert "has 8192 x 8192 pixels, which would take 1.2 GiB of memory, and the limit" in warning


def test_many_places_of_one_mesh_in_a_glb_are_counted(tmp_path):
    writer = GltfWriter()
    positions = np.random.default_rng(1).random((3000, 3)).astype(np.float32)
    writer.primitive(np.arange(3000).reshape(-1, 3).tolist(), POSITION=positions)
    for places, fits in ((10, True), (400, False)):
        writer.header["nodes"] = [{"mesh": 0, "translation": [k, 0, 0]} for k in range(places)]
        writer.header["scenes"][0]["nodes"] = list(range(places))
        path = write(tmp_path / "a.glb", writer.glb())
        if fits:
            meshes = load_meshes(path).meshes
            assert len(meshes) == places
            assert all(a.positions is b.positions and a.triangles is b.triangles for a, b in pairwise(meshes))
        else:
            with pytest.raises(MeshFileError, match="drawing the meshes of its 400 nodes would take"):
                load_meshes(path)


def test_a_large_mesh_in_one_place_takes_what_is_free(tmp_path, monkeypatch):
    writer = GltfWriter()
    writer.primitive([[0, 1, 2]], POSITION=np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]))
    monkeypatch.setattr(gltf, "DRAWING", 10**8)
    path = write(tmp_path / "a.glb", writer.glb())
    assert len(load_meshes(path).meshes) == 1
    monkeypatch.setattr(memory, "free_memory", lambda: 1e8)
    with pytest.raises(MeshFileError, match="drawing the meshes of its 1 nodes may take"):
        load_meshes(path)


def test_compressed_bytes_that_cannot_hold_an_array_are_not_unpacked():
    record = array_record(np.zeros(5000))
    larger = record.model_copy(update={"shape": [2**28]})
    with pytest.raises(ValueError, match="more than 61 compressed ones hold"):
        array_from(larger)


def test_a_state_that_unfolds_to_more_than_it_may_is_refused_before(tmp_path, monkeypatch):
    path = tmp_path / "a.rasterscope"
    save_state(path, State(open_document(ClipScene(np.zeros((2000, 3, 4))), "zeros")))
    path.write_text(path.read_text().replace('"shape": [2000, 3, 4]', f'"shape": [{2**22}, 3, 4]'))
    monkeypatch.setattr(state_scenes, "array_from", lambda record: pytest.fail("it is unfolded"))
    with pytest.raises(
        StateFileError, match=r"scene: its arrays would take 768\.0 MiB of memory, and the limit"
    ):
        open_any(str(path))


def test_an_array_that_does_not_fit_into_what_is_free_is_refused(monkeypatch):
    record = array_record(np.zeros(5000))
    monkeypatch.setattr(memory, "free_memory", lambda: 1000.0)
    with pytest.raises(ValueError, match="an array of shape"):
        array_from(record)


def test_a_trace_of_very_many_triangles_is_refused(monkeypatch):
    monkeypatch.setattr(trace, "MOST_TRIANGLES", 11)
    line = refused(1, "trace", "cube", "--stage", "transform")
    assert line.endswith("24 triangles or vertices, and at most 11 fit: choose one --triangle")
    assert run_program("trace", "cube", "--stage", "transform", "--triangle", "0").returncode == 0


def grid_file(path: Path, side: int) -> Path:
    """Write a mesh of 2 side^2 triangles."""
    places = [f"v {x} {y} 0" for y in range(side + 1) for x in range(side + 1)]
    corners = [(y * (side + 1) + x + 1, side + 1) for y in range(side) for x in range(side)]
    return write(path, "\n".join([*places, *(f"f {a} {a + 1} {a + w + 1} {a + w}" for a, w in corners), ""]))


@pytest.fixture
def tight(monkeypatch):
    """Let nearly nothing be free, and ask for what is drawn and stepped however little it is."""
    monkeypatch.setattr(document, "UNASKED", 0)
    monkeypatch.setattr(memory, "free_memory", lambda: 4e6)


def test_a_mesh_whose_picture_does_not_fit_is_refused_before_it_is_drawn(tmp_path, tight):
    assert open_any(str(grid_file(tmp_path / "a.obj", 5))).document.triangle_count == 50
    with pytest.raises(
        MeshFileError, match=r"^b\.obj is too large: drawing its 3,200 triangles may take 5\.\d MiB"
    ):
        open_any(str(grid_file(tmp_path / "b.obj", 40)))


def test_all_triangles_of_a_large_mesh_are_not_stepped_together(tmp_path, monkeypatch):
    opened = open_any(str(grid_file(tmp_path / "a.obj", 15))).document
    assert opened.triangle is not None
    everything = replace(opened, triangle=None)
    assert trace_now(everything, "cull").source.triangle is None
    monkeypatch.setattr(document, "MOST_TRIANGLES", 449)
    with pytest.raises(
        ValueError, match="All 450 triangles are too many to be stepped together, at most 449 are"
    ):
        trace_now(everything, "cull")
    assert trace_now(opened, "cull").source.triangle == opened.triangle


def test_a_trace_that_does_not_fit_is_refused_before_it_is_made(tmp_path, tight):
    mesh = open_any(str(grid_file(tmp_path / "a.obj", 15))).document
    mesh.check_length()
    with pytest.raises(
        ValueError, match=r"stepping 450 triangles together may take .* MiB of memory, 3\.8 MiB are"
    ):
        trace_now(replace(mesh, triangle=None), "cull")


def test_a_state_that_steps_more_than_fits_opens_at_one_triangle(tmp_path, monkeypatch):
    mesh = open_any(str(grid_file(tmp_path / "a.obj", 15))).document
    save_state(tmp_path / "a.rasterscope", State(replace(mesh, triangle=None)))
    assert open_any(str(tmp_path / "a.rasterscope")).document.triangle is None
    monkeypatch.setattr(document, "MOST_TRIANGLES", 449)
    opened = open_any(str(tmp_path / "a.rasterscope"))
    assert opened.document.triangle is not None
    assert opened.state.document is opened.document
    assert opened.warnings[-1].startswith("All 450 triangles are too many")
