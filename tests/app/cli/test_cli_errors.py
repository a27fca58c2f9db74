"""Bad input on the command line: one line on stderr, the right exit code, and no half-written file."""

import json
import os
import struct
import subprocess
import sys

import numpy as np
import pytest

from app.files.open_any import open_any
from app.files.state_files import State, save_state
from core import Settings
from tests.app.cli.cli_runs import ROOT, refused, run_program
from tests.app.files.mesh_writing import SQUARE, stl_binary, write

SOLID = "rasterscope render: "


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        (["render"], "the following arguments are required: FILE"),
        (["render", "cube"], "give -o out.png, --buffers out.npz or both"),
        (["render", "cube", "-o", "out.jpg"], "must end with .png, got out.jpg"),
        (["render", "cube", "-o", "out.png", "--buffers", "out.zip"], "must end with .npz, got out.zip"),
        (["render", "cube", "-o", "out.png", "--size", "0x0"], "1 to 16384 pixels each way, got 0x0"),
        (["render", "cube", "-o", "out.png", "--size", "8"], "WIDTHxHEIGHT such as 640x480, got 8"),
        (["render", "cube", "-o", "out.png", "--size", "-8x8"], "--size"),
        (["render", "cube", "-o", "out.png", "--size", "99999x1"], "1 to 16384 pixels each way, got 99999x1"),
        (["render", "cube", "-o", "out.png", "--set", "fill"], "family=method such as fill=blocks, got fill"),
        (["render", "cube", "-o", "out.png", "--set", "fill=magic"], "fill must be one of"),
        (["render", "cube", "-o", "out.png", "--set", "colour=red"], "setting must be one of"),
        (["render", "cube", "-o", "out.png", "--set", "block_size=0"], "whole number from 1 to 256, got 0"),
        (["render", "cube", "-o", "out.png", "--set", "block_size=x"], "block_size must be a whole number"),
        (["render", "cube", "-o", "out.png", "--verbose"], "unrecognized arguments: --verbose"),
        (["trace", "cube"], "the following arguments are required: --stage"),
        (["trace", "cube", "--stage", "magic"], "invalid choice"),
        (["trace", "cube", "--stage", "raster", "--triangle", "-1"], "--triangle"),
        (["trace", "cube", "--stage", "raster", "--triangle", "one"], "a whole number from 0, got one"),
        (["trace", "cube", "--stage", "raster", "--format", "xml"], "invalid choice"),
        (["trace", "cube", "--stage", "raster", "--format", "npz"], "npz needs a file"),
        (["trace", "cube", "--stage", "raster", "--region", "1,2"], "COLUMN,ROW,COLUMNS,ROWS"),
        (["methods", "colours"], "family must be one of"),
        (["screenshot", "cube"], "the following arguments are required: -o/--output"),
        (["screenshot", "cube", "-o", "a.txt"], "must end with .png, .svg, .pdf, got a.txt"),
        (["screenshot", "cube", "-o", "a.png", "--theme", "pink"], "invalid choice"),
        (["screenshot", "cube", "-o", "a.png", "--step", "-3"], "--step"),
        (["rendr", "cube", "-o", "a.png"], "one FILE or a command"),
        (["--magic"], "unrecognized arguments: --magic"),
        (["--", "cube", "sphere"], "expected one FILE or a command"),
        (["screenshot", "cube", "-o", "a.png", "--view", "magic"], "view must be one of"),
        (
            ["screenshot", "cube", "-o", "a.png", "--page", "compare", "--show", "magic"],
            "family must be one of",
        ),
        (
            ["screenshot", "cube", "-o", "a.png", "--page", "compare", "--show", "line", "--work", "magic"],
            "work of line must be one of",
        ),
        (
            ["screenshot", "cube", "-o", "a.png", "--page", "stability", "--show", "magic"],
            "experiment must be one of",
        ),
    ],
)
def test_wrong_usage(tmp_path, arguments, wanted):
    assert wanted in refused(2, *arguments, cwd=tmp_path)
    assert list(tmp_path.iterdir()) == []


NAN = "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"
MESHES = [
    ("a.obj", "", "a.obj is empty"),
    ("a.obj", SQUARE + "f 1 2 9\n", "9"),
    ("a.obj", NAN, "a.obj"),
    ("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "only degenerate faces"),
    ("a.obj", "Dear reader,\nthis is a letter.\n", "no vertices"),
    ("a.txt", "a letter", "extension .txt"),
    ("a.glb", struct.pack("<4sII", b"glTF", 2, 500) + b"\0" * 20, "a.glb"),
    ("a.ply", "ply\nformat ascii 1.0\n", "a.ply"),
    ("a.stl", stl_binary(np.zeros((4, 3, 3)))[:150], "a.stl"),
]


@pytest.mark.parametrize(("name", "content", "wanted"), MESHES)
def test_a_bad_mesh(tmp_path, name, content, wanted):
    write(tmp_path / name, content)
    line = refused(1, "render", name, "-o", "out.png", cwd=tmp_path)
    assert line.startswith(SOLID)
    assert wanted in line
    assert [path.name for path in tmp_path.iterdir()] == [name]


def test_what_is_not_there_or_cannot_be_read(tmp_path):
    line = refused(1, "render", "gone.obj", "-o", "out.png", cwd=tmp_path)
    assert line == f"{SOLID}there is no file gone.obj"
    assert (
        "there is no file and no built-in scene named 'cubes'; the built-in scenes are single-triangle"
        in refused(1, "trace", "cubes", "--stage", "raster", cwd=tmp_path)
    )
    assert "no built-in scene named ''" in refused(1, "render", "", "-o", "out.png", cwd=tmp_path)
    (tmp_path / "folder.obj").mkdir()
    assert "is a folder" in refused(1, "render", "folder.obj", "-o", "out.png", cwd=tmp_path)
    assert "gone.rasterscope" in refused(1, "render", "gone.rasterscope", "-o", "out.png", cwd=tmp_path)


@pytest.mark.parametrize(
    "command", [("render",), ("trace", "--stage", "raster"), ("screenshot",)], ids=lambda command: command[0]
)
def test_where_nothing_can_be_written_nothing_is_opened(tmp_path, command):
    name, *more = command
    line = refused(1, name, "gone.obj", *more, "-o", "nowhere/out.png", cwd=tmp_path)
    assert "nowhere/out.png cannot be written: there is no folder" in line


def test_a_triangle_that_is_not_there():
    line = refused(2, "trace", "cube", "--stage", "raster", "--triangle", "12")
    assert line == "rasterscope trace: argument --triangle: must be 0 to 11 in cube, got 12"
    assert "must contain pixels" in refused(2, "trace", "cube", "--stage", "raster", "--region", "600,0,4,4")


def test_a_method_that_the_scene_cannot_serve(tmp_path):
    write(tmp_path / "a.obj", SQUARE + "f 1 2 3 4\n")
    document = open_any(str(tmp_path / "a.obj")).document
    scene = document.scene
    camera = type(scene.camera)(scene.camera.eye, scene.camera.target, projection="orthographic")
    scene = type(scene)(scene.meshes, camera, scene.lights, (8, 8))
    document = type(document)(scene, type(document.raster)(8, 8))
    save_state(tmp_path / "a.rasterscope", State(document))
    line = refused(1, "render", "a.rasterscope", "-o", "out.png", "--set", "depth=inverse-w", cwd=tmp_path)
    assert "depth inverse-w needs a perspective camera" in line


def test_a_picture_larger_than_the_memory_is_refused(monkeypatch):
    import app.cli.render as memory

    monkeypatch.setattr(memory, "BYTES_PER_BLENDED_PIXEL", 1 << 50)
    memory.check_memory((64, 48), Settings())
    with pytest.raises(ValueError, match=r"a picture of 64x48 pixels may take .* GiB of memory"):
        memory.check_memory((64, 48), Settings(blend="over"))


def test_samples_count_as_memory(monkeypatch):
    import app.cli.render as memory

    monkeypatch.setattr("app.session.memory.free_memory", lambda: 2.0**30)
    cases = {
        Settings(): 380,
        Settings(antialiasing="area"): 380,
        Settings(antialiasing="msaa-4"): 650,
        Settings(antialiasing="ssaa-n", samples_across=1): 380,
        Settings(antialiasing="ssaa-16"): 16 * 130,
        Settings(antialiasing="ssaa-n", samples_across=8, blend="over"): 64 * 150,
    }
    for settings, bytes_of_pixel in cases.items():
        side = int((2**30 / bytes_of_pixel) ** 0.5)
        memory.check_memory((side, side), settings)
        with pytest.raises(ValueError, match=r"may take 1\.1 GiB of memory, 1\.0 GiB are free"):
            memory.check_memory((side + 1, side + 1), settings)


def test_too_many_samples_are_refused_before_drawing(tmp_path):
    line = refused(
        1, "render", "cube", "-o", "out.png", "--size", "16000x16000", "--set", "antialiasing=ssaa-n",
        "samples_across=8", cwd=tmp_path,
    )  # fmt: skip
    assert "a picture of 16000x16000 pixels with 64 samples each may take 1983.7 GiB of memory, " in line


@pytest.mark.skipif(sys.platform == "win32", reason="no such permissions and devices")
class TestWriting:
    def test_no_such_folder(self, tmp_path):
        line = refused(1, "render", "cube", "-o", "gone/out.png", "--size", "8x8", cwd=tmp_path)
        assert "gone/out.png cannot be written: there is no folder" in line

    def test_a_folder_in_the_way(self, tmp_path):
        (tmp_path / "out.png").mkdir()
        line = refused(1, "render", "cube", "-o", "out.png", "--size", "8x8", cwd=tmp_path)
        assert line == f"{SOLID}out.png cannot be written: it is a folder"

    def test_a_full_disk_leaves_the_old_file_whole(self, tmp_path):
        runs = [
            ["render", "cube", "-o", "out.png"],
            ["render", "cube", "--buffers", "buffers.npz"],
            ["trace", "cube", "--stage", "raster", "--size", "64x64", "-o", "out.json"],
            ["trace", "cube", "--stage", "raster", "--size", "64x64", "--format", "npz", "-o", "trace.npz"],
        ]
        names = [arguments[-1] for arguments in runs]
        for name in names:
            (tmp_path / name).write_bytes(b"the old content")
        # A limit on the size of files stands in for a full disk: writing fails in the middle.
        code = (
            "import json, resource, signal, sys; from app.cli.commands import run_command_line; "
            "signal.signal(signal.SIGXFSZ, signal.SIG_IGN); "
            "resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000)); "
            "sys.exit(sum(run_command_line(arguments) for arguments in json.loads(sys.argv[1])))"
        )
        run = subprocess.run(
            [sys.executable, "-c", code, json.dumps(runs)],
            capture_output=True,
            text=True,
            cwd=tmp_path,
            # Bytecode cut off at the limit would be taken for whole by every later start.
            env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"},
        )
        assert run.returncode == len(runs), "each has failed with 1"
        for name, line in zip(names, run.stderr.splitlines(), strict=True):
            assert f"{name} cannot be written: " in line
            assert (tmp_path / name).read_bytes() == b"the old content"
        assert {path.name for path in tmp_path.iterdir()} == set(names)

    @pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no device that is full")
    def test_a_full_standard_output(self):
        with open("/dev/full", "wb") as full:
            run = subprocess.run(
                [sys.executable, "-P", "-m", "app", "methods"],
                stdout=full,
                stderr=subprocess.PIPE,
                env={**os.environ, "PYTHONPATH": str(ROOT)},
                text=True,
            )
        assert run.returncode == 1
        assert run.stderr == "rasterscope methods: the output cannot be written: no space left on device\n"

    @pytest.mark.slow
    def test_an_unbuffered_standard_output_that_is_cut_off(self, tmp_path):
        # A limit on the size of files: one write is done in part, as on a disk that fills up.
        code = (
            "import resource, sys; from app.__main__ import main; "
            "resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000)); "
            "sys.exit(main())"
        )
        command = ["trace", "shared-edge", "--stage", "raster", "--format", "csv"]
        with open(tmp_path / "out.csv", "wb") as output:
            run = subprocess.run(
                [sys.executable, "-u", "-c", code, *command],
                stdout=output,
                stderr=subprocess.PIPE,
                env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"},
                text=True,
            )
        assert run.returncode == 1
        assert "the output cannot be written: " in run.stderr.splitlines()[-1]

    @pytest.mark.skipif(
        os.geteuid() == 0 if hasattr(os, "geteuid") else True, reason="root may write anywhere"
    )
    def test_a_folder_that_may_not_be_written(self, tmp_path):
        tmp_path.chmod(0o500)
        line = refused(1, "render", "cube", "-o", tmp_path / "out.png", "--size", "8x8")
        tmp_path.chmod(0o700)
        assert "permission is denied" in line


def test_what_goes_to_a_device_goes_there():
    run = run_program("trace", "cube", "--stage", "cull", "--format", "csv", "-o", os.devnull)
    assert (run.returncode, run.stderr) == (0, "")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="elsewhere there is always a display")
def test_a_window_without_a_display_says_so(monkeypatch):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    line = refused(1, "cube", QT_QPA_PLATFORM="")
    assert line.startswith("rasterscope: there is no display to open a window on")
    assert "rasterscope render FILE -o out.png" in line


@pytest.mark.parametrize(
    ("field", "value", "wanted"),
    [
        ("version", 4, "it is of version 4, and this Rasterscope opens versions 1 to 3"),
        ("position", "ten", "position must be a valid integer, got 'ten'"),
        ("scene.camera.near", 90.0, "scene.camera: near must be less than far, got near 90"),
        ("scene.camera.far", float("nan"), "scene.camera.far must be a finite number, got nan"),
        ("scene.camera.field_of_view", 0.0, "field of view must be between 0 and 180 degrees, got 0"),
        ("scene.camera.field_of_view", np.pi, "field of view must be between 0 and 180 degrees, got 180"),
        ("scene.size", [0, 8], "scene.size.0 must be greater than or equal to 1, got 0"),
        ("settings.fill", "magic", "settings: fill must be one of"),
        ("scene.source.built_in", "moon", "scene.source.built_in: scene must be one of"),
    ],
)
def test_a_bad_state(tmp_path, field, value, wanted):
    path = tmp_path / "a.rasterscope"
    save_state(path, State(open_any("cube").document))
    record = place = json.loads(path.read_text())
    *parents, name = field.split(".")
    for parent in parents:
        place = place[parent]
    place[name] = value
    path.write_text(json.dumps(record))
    for command in (["render", "-o", "out.png"], ["trace", "--stage", "raster"]):
        line = refused(1, command[0], "a.rasterscope", *command[1:], cwd=tmp_path)
        assert line.startswith(f"rasterscope {command[0]}: a.rasterscope cannot be opened: ")
        assert wanted in line
    assert [found.name for found in tmp_path.iterdir()] == ["a.rasterscope"]


def test_numbers_that_overflow_are_one_warning(tmp_path):
    path = tmp_path / "a.rasterscope"
    save_state(path, State(open_any("cube").document))
    record = json.loads(path.read_text())
    record["scene"]["lights"][0]["color"] = [1e300, 1e300, 1e300]
    path.write_text(json.dumps(record))
    run = run_program("render", "a.rasterscope", "-o", "a.png", "--size", "8x8", cwd=tmp_path)
    assert run.returncode in (0, 1)
    (line,) = run.stderr.splitlines()
    assert line.startswith("rasterscope")


@pytest.mark.parametrize(
    "arguments", [["knot", "--size", "512x512", "--set", "fill=brute-force"], ["cube", "--size", "9999x9999"]]
)
def test_a_trace_that_cannot_be_kept(tmp_path, arguments):
    line = refused(1, "trace", *arguments, "--stage", "depth", "-o", "out.json", cwd=tmp_path)
    assert "pixel tests, and at most 5,000,000 fit: choose one --triangle" in line
    assert line.endswith("fill than brute-force" if "knot" in arguments else "or a --region")
    assert list(tmp_path.iterdir()) == []
