"""Opening a mesh file: which files open, what the others say, framing, progress, cancelling, size."""

import json
import os
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

from app.files import file_access, mesh_files
from app.files.mesh_files import OpeningCancelledError, frame_meshes, load_meshes, open_mesh
from app.files.mesh_formats import EXTENSIONS, obj, reading
from app.files.mesh_formats.reading import MeshFileError
from core.scene import Mesh
from core.transform.vertex_stage import transform_vertices
from lessons.shapes import cube, knot, torus
from tests.app.files.mesh_writing import SQUARE, GltfWriter, stl_binary, write, write_image
from tests.covering import is_everything


def never():
    return False


def grid_stl(path, columns):
    mesh = torus(columns=columns, rows=columns)
    return write(path, stl_binary(mesh.positions[mesh.triangles])), len(mesh.triangles)


def test_the_files_that_open():
    assert EXTENSIONS == (".obj", ".ply", ".stl", ".off", ".glb", ".gltf", ".xyz", ".dxf")


@pytest.mark.parametrize("how", ["here", "process"])
def test_both_ways_of_reading_give_the_same(tmp_path, how):
    write_image(tmp_path / "a.png", [[(255, 0, 0), (0, 0, 255)]])
    text = SQUARE + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl gold\nf 1/1 2/2 3/3 4/4\n"
    path = write(tmp_path / "a.obj", text)
    reports = []
    opened = open_mesh(
        path, lambda *report: reports.append(report), never if how == "process" else None, size=(40, 30)
    )
    (mesh,) = opened.scene.meshes
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh.texture.pixels.tolist() == [[[1, 0, 0], [0, 0, 1]]]
    assert not mesh.positions.flags.writeable
    assert not mesh.texture.pixels.flags.writeable
    assert opened.warnings == ("the file names material gold but no material file; it is left out",)
    assert opened.scene.size == (40, 30)
    assert reports[0] == (0.0, "")
    assert reports[-1] == (1.0, "")


def test_materials_that_share_a_texture_share_it_after_the_process(tmp_path):
    write_image(tmp_path / "a.png", [[(255, 0, 0)]])
    text = SQUARE + "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 2/1 3/1 4/1\n"
    first, second = load_meshes(write(tmp_path / "a.obj", text), None, never).meshes
    assert first.texture is second.texture


@pytest.mark.parametrize(
    ("name", "content", "wanted"),
    [
        (
            "a.txt",
            "v 0 0 0\n",
            "a.txt has the extension .txt; files that open are .obj, .ply, .stl, .off, .glb",
        ),
        ("model", "v 0 0 0\n", "the file model has no extension; files that open are .obj"),
        ("a.obj", "", "a.obj is empty"),
        ("a.obj", "Dear reader,\nthis is a letter.\n", "a.obj has no vertices: it is empty or no OBJ file"),
        ("a.obj", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "a.obj is not an OBJ file: it is not text"),
    ],
)
def test_what_is_no_mesh_is_refused(tmp_path, name, content, wanted):
    ways = (None, never) if wanted.startswith("a.obj has no") or is_everything() else (None,)
    for is_cancelled in ways:  # here, and in a process
        with pytest.raises(MeshFileError) as problem:
            open_mesh(write(tmp_path / name, content), None, is_cancelled)
        assert wanted in str(problem.value)


def test_an_extension_in_capitals_opens(tmp_path):
    assert load_meshes(write(tmp_path / "A.OBJ", SQUARE + "f 1 2 3\n")).meshes[0].name == "A"


def test_a_path_that_cannot_be_read_is_refused(tmp_path):
    with pytest.raises(MeshFileError, match="there is no file"):
        open_mesh(tmp_path / "gone.obj")
    for name in ("folder.obj", "folder"):
        (tmp_path / name).mkdir()
        with pytest.raises(MeshFileError, match=f"{name} is a folder, not a mesh file"):
            open_mesh(tmp_path / name)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_is_refused_without_waiting_for_it(tmp_path):
    os.mkfifo(tmp_path / "pipe.obj")
    with pytest.raises(MeshFileError, match=r"pipe\.obj is not a file"):
        open_mesh(tmp_path / "pipe.obj")


def test_a_file_without_permission_is_refused(tmp_path, monkeypatch):
    path = write(tmp_path / "a.obj", SQUARE + "f 1 2 3\n")
    path.chmod(0)
    if os.access(path, os.R_OK):
        # The administrator may read everything: let the system say what it says to others.
        def refuse(*arguments):
            raise PermissionError(13, "Permission denied")

        monkeypatch.setattr(file_access, "_open_at_once", refuse)
    with pytest.raises(MeshFileError, match=r"a\.obj may not be read: permission is denied"):
        open_mesh(path)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.obj", SQUARE + "f 1 2 3\n"),
        ("a.ply", "ply\nformat ascii 1.0\nend_header\n"),
        ("a.off", "OFF\n0 0 0\n"),
        ("a.stl", stl_binary(np.zeros((9, 3, 3)))),
        ("b.stl", "solid\nendsolid\n"),
        ("a.xyz", "0 0 0\n"),
        ("a.dxf", "0\nEOF\n"),
    ],
)
def test_a_file_above_the_limit_of_memory_is_refused_before_it_is_read(tmp_path, monkeypatch, name, content):
    monkeypatch.setattr(reading, "MEMORY_LIMIT", 100)
    with pytest.raises(MeshFileError, match=r"is too large: opening it would take about .* MiB of memory"):
        open_mesh(write(tmp_path / name, content))


def test_a_file_of_too_many_meshes_is_refused_before_they_are_made(tmp_path, monkeypatch):
    monkeypatch.setattr(reading, "MOST_MESHES", 5)
    monkeypatch.setattr(reading, "share_vertices", lambda *parts: pytest.fail("a mesh is made"))
    path = write(tmp_path / "a.obj", SQUARE + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n" * 3)
    with pytest.raises(MeshFileError, match=r"a\.obj has 6 runs of faces with one material, and at most 5"):
        load_meshes(path)
    writer = GltfWriter()
    for _ in range(6):
        writer.primitive([[0, 1, 2]], POSITION=np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]))
    with pytest.raises(MeshFileError, match=r"b\.glb has 6 parts in its nodes, and at most 5 are opened"):
        load_meshes(write(tmp_path / "b.glb", writer.glb()))


def test_materials_that_no_face_names_are_passed_over(tmp_path):
    write(tmp_path / "a.mtl", "newmtl a\nKd 1 0 0\n" + "newmtl b\nKd red\n" * 1000)
    path = write(tmp_path / "a.obj", "mtllib a.mtl\n" + SQUARE + "usemtl a\nf 1 2 3\n")
    assert load_meshes(path).warnings == ()


def test_the_limit_lets_two_million_triangles_in():
    from app.files.mesh_formats import off, ply, stl

    # Bytes of a triangle and half a vertex, as exporters write them at this size.
    assert 2e6 * 120 * obj.MEMORY_PER_BYTE < reading.MEMORY_LIMIT
    assert 2e6 * 40 * max(off.MEMORY_PER_BYTE, ply.MEMORY_PER_BYTE) < reading.MEMORY_LIMIT
    assert 2e6 * stl.MEMORY_PER_TRIANGLE < reading.MEMORY_LIMIT


def test_a_large_file_reports_progress_from_its_process(tmp_path):
    lines = "".join(f"v {k} 0 0\nv {k} 1 0\nv {k} 0 1\nf -1 -2 -3\n" for k in range(20000))
    reports = []
    loaded = load_meshes(write(tmp_path / "a.obj", lines), lambda *report: reports.append(report), never)
    assert len(loaded.meshes[0].triangles) == 20000
    fractions = [fraction for fraction, doing in reports if doing == "reading lines"]
    assert len(fractions) >= 3
    assert fractions == sorted(fractions)
    assert 0 < fractions[0] < fractions[-1] <= 1


@pytest.mark.parametrize("kind", ["stl", "obj"])
def test_cancelling_takes_effect_soon_and_leaves_nothing(tmp_path, kind, monkeypatch):
    if kind == "stl":
        path, _ = grid_stl(tmp_path / "a.stl", 400)
    else:
        path = write(tmp_path / "a.obj", SQUARE * 100000 + "f 1 2 3\n")
    processes = []
    start = subprocess.Popen

    def started(*arguments, **options):
        processes.append(start(*arguments, **options))
        return processes[-1]

    monkeypatch.setattr(mesh_files.subprocess, "Popen", started)
    seen, asked = [], []

    def is_cancelled():
        # In the middle: the process has begun to read.
        asked.append(time.perf_counter())
        return "reading" in " ".join(seen)

    threads = threading.active_count()
    with pytest.raises(OpeningCancelledError, match="was cancelled"):
        open_mesh(path, lambda fraction, doing: seen.append(doing), is_cancelled)
    assert time.perf_counter() - asked[-1] < 10
    assert np.diff(asked).max() < 10
    (process,) = processes
    assert process.returncode is not None
    assert threading.active_count() <= threads


def test_a_reader_that_dies_is_an_error(tmp_path, monkeypatch):
    monkeypatch.setattr(mesh_files, "START", "import os; os._exit(3)")
    with pytest.raises(MeshFileError, match=r"a\.obj cannot be read: its reader ended"):
        open_mesh(write(tmp_path / "a.obj", SQUARE), None, never)


def test_what_a_reader_prints_does_not_disturb_the_result(tmp_path, monkeypatch):
    noisy = "import app.files.mesh_files as m; r = m.read_file\n" + (
        "def noisy(*given):\n    print('noise', flush=True)\n    return r(*given)\nm.read_file = noisy\n"
    )
    before, serve = mesh_files.START.rsplit("; ", 1)
    monkeypatch.setattr(mesh_files, "START", f"{before}\n{noisy}{serve}")
    loaded = load_meshes(write(tmp_path / "a.obj", SQUARE + "f 1 2 3\n"), None, never)
    assert len(loaded.meshes) == 1


def test_a_program_without_a_console_reads_too(tmp_path, monkeypatch):
    """Such as ``pythonw``: it has no standard error."""
    before, serve = mesh_files.START.rsplit("; ", 1)
    monkeypatch.setattr(mesh_files, "START", f"{before}; sys.stderr = None; {serve}")
    loaded = load_meshes(write(tmp_path / "a.obj", SQUARE + "f 1 2 3\n"), None, never)
    assert len(loaded.meshes) == 1


def test_a_reader_that_nobody_listens_to_any_more_is_quiet(tmp_path):
    path = write(tmp_path / "a.obj", SQUARE + "f 1 2 3\n")
    order = [json.dumps([str(mesh_files.PROJECT), *filter(None, sys.path)]), str(path), ""]
    with subprocess.Popen(
        [sys.executable, "-P", "-c", mesh_files.START, *order], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        process.stdout.close()
        assert process.stderr.read() == b""


SHAPES = [cube(), knot(), torus()]


@pytest.mark.parametrize("size", [(512, 512), (640, 200), (200, 640)])
@pytest.mark.parametrize("shape", SHAPES, ids=["cube", "knot", "torus"])
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_a_framed_model_fills_the_picture_and_stays_inside_the_view_volume(shape, size, scale):
    mesh = Mesh(shape.positions * scale + 3 * scale, shape.triangles)
    stage = transform_vertices(frame_meshes((mesh,), size))
    assert (stage.clip[:, 3] > 0).all()
    ndc = stage.ndc
    assert np.abs(ndc).max() <= 1
    assert np.abs(ndc[:, :2]).max() > 0.85
    # The far half of the view volume does not squeeze the model's depths into nothing.
    depth = stage.window[:, 2]
    assert depth.max() - depth.min() > 0.3


def test_framing_counts_transforms_and_skips_vertices_that_no_triangle_uses():
    mesh = Mesh(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1e6, 0, 0.0]]), np.array([[0, 1, 2]]))
    moved = Mesh(
        mesh.positions,
        mesh.triangles,
        transform=np.array([[1, 0, 0, 9], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]]),
    )
    assert frame_meshes((mesh,)).camera.target.tolist() == [0.5, 0.5, 0]
    assert frame_meshes((mesh, moved)).camera.target.tolist() == [5, 0.5, 0]


def test_the_camera_stands_in_front_above_and_far_enough_to_orbit():
    scene = frame_meshes((cube(),))
    assert scene.camera.eye[2] > scene.camera.eye[1] > 0
    distance = np.linalg.norm(scene.camera.eye)
    radius = np.sqrt(3)
    assert scene.camera.near <= distance - radius
    assert scene.camera.far >= distance + radius
    strong, weak = (light.color.sum() for light in scene.lights)
    assert weak < strong / 2
