"""The command line: render, trace and the lists, with real files in processes of their own."""

import csv
import json
import os
import signal
import subprocess
import sys
from functools import partial
from io import StringIO

import numpy as np
import pytest
from PIL import Image

from app import __version__
from app.__main__ import main
from app.cli.commands import COMMANDS, run_command_line
from app.files.open_any import open_any
from app.files.state_files import State, save_state
from app.session.document import STEPPED
from core import STAGES, Settings, render, trace
from core.framebuffer.display import picture_bytes, to_display
from core.methods import table
from core.scene import ClipScene
from core.trace.conditions import symbols_of
from lessons.lectures.catalogue import LECTURES
from lessons.lectures.scenes import ALL_SCENES
from lessons.scenes import make_scene, scene_names
from tests.app.cli.cli_runs import ROOT, run_program, start_program
from tests.app.files.mesh_writing import SQUARE, write
from tests.covering import in_turn

HALF_COVERED = ClipScene(
    [[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]], [[-1, -1, 0.5, 1], [1, -1, 0.5, 1], [1, 1, 0.5, 1]]],
    np.tile([1.0, 0.5, 0.25, 0.5], (2, 3, 1)),
    (6, 5),
)


def succeeded(*arguments, **how):
    run = run_program(*arguments, **how)
    assert run.returncode == 0, run.stderr
    assert run.stderr == ""
    return run.stdout


def test_render_writes_the_buffers_of_the_core_bit_for_bit(tmp_path):
    succeeded(
        *("render", "cube", "-o", "out.png", "--size", "40x30"),
        *("--set", "shading=flat", "cull=back", "--set", "block_size=4", "--buffers", "out.npz"),
        cwd=tmp_path,
    )
    scene = make_scene("cube")
    scene = type(scene)(scene.meshes, scene.camera, scene.lights, (40, 30), scene.background)
    frame = render(scene, Settings(shading="flat", cull="back", block_size=4))
    with np.load(tmp_path / "out.npz") as buffers:
        assert set(buffers) == {"color", "depth", "primitive"}
        for name in buffers:
            expected = getattr(frame, name)
            assert buffers[name].dtype == expected.dtype
            assert buffers[name].tobytes() == expected.tobytes()
    with Image.open(tmp_path / "out.png") as image:
        assert (image.mode, image.size) == ("RGBA", (40, 30))
        assert np.array_equal(np.asarray(image), to_display(frame.color).pixels[::-1])
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.npz", "out.png"]


@pytest.mark.parametrize("name", scene_names())
def test_every_built_in_scene_renders(tmp_path, name):
    assert main(["render", name, "--size", "24x16", "-o", str(tmp_path / "out.png")]) == 0
    with Image.open(tmp_path / "out.png") as image:
        assert image.size == (24, 16)


def test_a_picture_that_was_blended_gets_straight_alpha():
    frame = render(HALF_COVERED, Settings(blend="over", visibility="last-drawn"))
    pixels = picture_bytes(frame.color, "over")
    # One layer and two layers of the same half-transparent colour: the colour stays, alpha does not.
    alphas = {(1.0, 0.5, 0.25, 0.5): 128, (1.0, 0.5, 0.25, 0.75): 191}
    for color, alpha in alphas.items():
        expected = [*to_display(np.array([[color]], np.float32)).pixels[0, 0, :3], alpha]
        assert (pixels == expected).all(axis=2).any()
    assert set(map(tuple, pixels.reshape(-1, 4).tolist())) <= {
        (255, 188, 137, 128),
        (255, 188, 137, 191),
        (0, 0, 0, 0),
    }


def test_a_mesh_file_and_the_state_of_it_render_the_same(tmp_path):
    write(tmp_path / "square.obj", SQUARE + "f 1 2 3 4\n")
    opened = open_any(str(tmp_path / "square.obj"))
    save_state(tmp_path / "square.rasterscope", State(opened.document))
    for name in ("square.obj", "square.rasterscope"):
        succeeded("render", name, "--size", "32x32", "--buffers", name + ".npz", cwd=tmp_path)
    first, second = (np.load(tmp_path / f"square.{kind}.npz") for kind in ("obj", "rasterscope"))
    with first, second:
        assert (first["primitive"] >= 0).any()
        for name in first:
            assert np.array_equal(first[name], second[name])


def test_a_missing_texture_is_a_warning(tmp_path):
    write(tmp_path / "a.mtl", "newmtl a\nmap_Kd gone.png\n")
    write(tmp_path / "a.obj", "mtllib a.mtl\n" + SQUARE + "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\n")
    run = run_program("render", "a.obj", "-o", "a.png", "--size", "8x8", cwd=tmp_path)
    assert run.returncode == 0
    (line,) = run.stderr.splitlines()
    assert line.startswith("rasterscope: warning: ")
    assert "gone.png" in line
    assert (tmp_path / "a.png").exists()


@pytest.mark.parametrize("stage", STAGES)
def test_the_json_of_a_stage_has_every_number_and_a_sentence_for_every_operation(stage, capsys):
    assert main(["trace", "textured-floor", "--triangle", "1", "--stage", stage, "--size", "12x8"]) == 0
    found = json.loads(capsys.readouterr().out)
    scene = make_scene("textured-floor")
    expected = trace(
        type(scene)(scene.meshes, scene.camera, scene.lights, (12, 8)), STEPPED, triangle=1
    ).stage(stage)
    symbols = symbols_of(expected)
    assert (found["stage"], found["method"], found["triangle"]) == (stage, expected.method, 1)
    assert found["size"] == [12, 8]
    assert len(found["rows"]) == found["row_count"] == expected.steps.row_count > 0
    for number, row in enumerate(found["rows"]):
        assert (row["row"], row["kind"]) == (number, expected.kind_of(number))
        assert set(row["columns"]) == {symbols.get(name, name) for name in expected.columns}
        for name, of_rows in expected.columns.items():
            column, value = of_rows[number], row["columns"][symbols.get(name, name)]
            numbers = np.array(value, column.dtype if column.dtype.kind in "Ub" else float)
            assert np.array_equal(numbers, np.asarray(column), equal_nan=column.dtype.kind == "f")
        for operation in row["operations"]:
            assert operation["key"].startswith(f"{stage}.{row['kind']}.")
            assert operation["sentence"].endswith(".")
            lines = (operation["formula"] or {"symbolic": ""}).values()
            assert not any("\\vertex" in line for line in lines)
            assert (operation["line"] is None) == (operation["code"] is None)
    positions = [operation["position"] for row in found["rows"] for operation in row["operations"]]
    assert positions == list(range(1, found["operation_count"] + 1))


def test_the_text_has_the_sentence_and_the_formula_of_every_operation():
    text = succeeded(
        "trace", "shared-edge", "--triangle", "1", "--stage", "depth", "--format", "text", "--size", "8x6"
    )
    assert text.splitlines()[:6] == [
        "Two triangles sharing an edge, stage depth, depth=z-float32",
        "",
        "Row 0, test, triangle 1, pixel (6, 1)",
        "     1  Pixel (6, 1): its depth z = 0.5 is stored as 0.5.",
        "          z_new = float32(z)",
        "          0.5 = float32(0.5)",
    ]


def test_infinities_and_missing_numbers_are_json(capsys):
    assert main(["trace", "near-plane", "--stage", "raster", "--size", "6x4", "--set", "fill=scanline"]) == 0
    found = json.loads(capsys.readouterr().out, parse_constant=lambda text: pytest.fail(text))
    assert any(None in row["columns"]["values"] for row in found["rows"])


def test_the_csv_has_a_line_for_every_row():
    text = succeeded("trace", "shared-edge", "--triangle", "1", "--stage", "raster", "--format", "csv")
    rows = list(csv.DictReader(StringIO(text)))
    expected = trace(make_scene("shared-edge"), STEPPED, triangle=1).stage("raster")
    assert len(rows) == expected.steps.row_count
    for k, name in enumerate(("values[0]", "values[1]", "values[2]")):
        assert [float(row[name]) for row in rows] == expected.columns["values"][:, k].tolist()
    assert [int(row["is_covered"]) for row in rows] == expected.marks["covered"].astype(int).tolist()
    assert {row["row_triangle"] for row in rows} == {"1"}
    assert all(len(row) == len(rows[0]) and None not in row for row in rows)


def test_the_npz_has_the_columns_bit_for_bit(tmp_path):
    succeeded(
        *("trace", "single-triangle", "--stage", "depth", "--format", "npz", "-o", "depth.npz"),
        *("--region", "10,8,20,12", "--before", "cleared"),
        cwd=tmp_path,
    )
    expected = trace(make_scene("single-triangle"), STEPPED, region=(10, 8, 20, 12), before="cleared").stage(
        "depth"
    )
    with np.load(tmp_path / "depth.npz") as found:
        assert symbols_of(expected)["depth"] == "z"
        for name, column in expected.columns.items():
            written = found[symbols_of(expected).get(name, name)]
            assert written.dtype == column.dtype
            assert written.tobytes() == column.tobytes()
        assert found["row_pixel"].tolist() == expected.pixel.tolist()
        assert found["row_kind"].tolist() == [expected.kind_of(k) for k in range(expected.steps.row_count)]
        assert np.array_equal(found["mark_covered"], expected.marks["covered"])
        after = expected.state(expected.steps.count)
        assert np.array_equal(found["buffer_depth"], after["depth"])
        assert found["buffer_depth"].shape == (12, 20)


@pytest.mark.parametrize(("fill", "stage"), in_turn(["hierarchy", "scanline", "scanline-lecture"], STAGES))
def test_csv_and_npz_of_every_stage(tmp_path, capsys, stage, fill):
    path = tmp_path / "a.npz"
    common = ["trace", "near-plane", "--stage", stage, "--size", "12x8", "--set", f"fill={fill}"]
    assert main([*common, "--format", "npz", "-o", str(path)]) == 0
    assert main([*common, "--format", "csv"]) == 0
    names, *rows = csv.reader(StringIO(capsys.readouterr().out))
    assert len(set(names)) == len(names)
    with np.load(path) as found:
        assert len(rows) == len(found["row_kind"])


def test_a_large_scene_is_traced_where_the_window_shows_it(capsys):
    document = open_any("knot").document
    assert main(["trace", "knot", "--triangle", str(document.triangle), "--stage", "depth"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert tuple(found["region"]) == document.region
    assert found["size"] == [512, 512]


def test_a_state_is_traced_as_it_was_left(tmp_path, capsys):
    document = open_any("intersecting").document
    document = type(document)(
        document.scene,
        type(document.raster)(20, 10, (30, 20)),
        Settings(depth="inverse-w", fill="blocks"),
        triangle=1,
        before="cleared",
        title="A",
    )
    path = tmp_path / "a.rasterscope"
    save_state(path, State(document))
    assert main(["trace", str(path), "--stage", "depth"]) == 0
    found = json.loads(capsys.readouterr().out)
    expected = document.make_trace().stage("depth")
    assert (found["region"], found["triangle"], found["before"]) == ([30, 20, 20, 10], 1, "cleared")
    assert (found["settings"]["fill"], found["method"]) == ("blocks", "depth=inverse-w")
    stored = [row["columns"]["stored"] for row in found["rows"]]
    assert stored == expected.columns["stored"].tolist()


def test_methods_lists_the_whole_table():
    text = succeeded("methods")
    for method in table:
        assert f"{method.family}={method.name} " in text
    found = json.loads(succeeded("methods", "--json"))
    assert [(row["family"], row["name"]) for row in found].sort() == [
        (m.family, m.name) for m in table
    ].sort()
    defaults = {row["family"]: row["name"] for row in found if row["is_default"]}
    assert all(getattr(Settings(), family) == name for family, name in defaults.items())
    assert {row["family"] for row in json.loads(succeeded("methods", "fill", "--json"))} == {"fill"}


def test_scenes_lists_the_catalogue():
    lines = succeeded("scenes").splitlines()
    rows = json.loads(succeeded("scenes", "--json"))
    assert [line.split()[0] for line in lines if line not in LECTURES.values()] == list(ALL_SCENES)
    assert [row["name"] for row in rows] == list(ALL_SCENES)
    assert list(dict.fromkeys(row["lecture"] for row in rows)) == ["", *LECTURES]
    assert [row["name"] for row in rows if not row["lecture"]] == list(scene_names())


def test_version_and_help():
    version = start_program("--version")
    assert (version.returncode, version.stdout, version.stderr) == (0, f"rasterscope {__version__}\n", "")
    text = succeeded("--help")
    assert all(word in text for word in (*(command.name for command in COMMANDS), "examples", "FILE"))


@pytest.mark.parametrize("command", [command.name for command in COMMANDS])
def test_the_help_of_a_command_has_examples(capsys, command):
    assert main([command, "--help"]) == 0
    assert "examples:" in capsys.readouterr().out


HEADLESS = [
    ["render", "shared-edge", "-o", "out.png", "--buffers", "out.npz"],
    ["trace", "cube", "--triangle", "1", "--stage", "cull", "--format", "csv"],
    ["trace", "cube", "--triangle", "1", "--stage", "cull", "--format", "npz", "-o", "a.npz"],
    ["trace", "cube", "--triangle", "1", "--stage", "cull", "--format", "json"],
    ["methods"],
    ["scenes"],
    ["--help"],
]


def test_commands_without_a_window_do_not_import_qt(tmp_path):
    code = (
        "import json, sys; from app.__main__ import main; "
        "codes = [main(arguments) for arguments in json.loads(sys.argv[1])]; "
        "qt = [m for m in sys.modules if m.partition('.')[0] in ('PySide6', 'shiboken6')]; "
        "print(codes, qt, file=sys.stderr)"
    )
    run = subprocess.run(
        [sys.executable, "-c", code, json.dumps(HEADLESS)],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        cwd=tmp_path,
    )
    assert (run.returncode, run.stderr) == (0, f"{[0] * len(HEADLESS)} []\n")


def test_a_reader_that_leaves_is_no_error():
    command = [sys.executable, "-P", "-m", "app", "trace", "cube", "--stage", "raster", "--size", "60x60"]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(ROOT)}
    ) as process:
        assert process.stdout.readline() == b"{\n"
        process.stdout.close()
        assert process.stderr.read() == b""
        assert process.wait(60) == 1


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGINT for one process")
def test_an_interrupt_ends_with_130_and_without_a_word():
    command = [sys.executable, "-P", "-m", "app", "trace", "cube", "--stage", "raster", "--size", "60x60"]
    # A shell lets what it starts in the background ignore this signal, the tests too.
    heed = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        preexec_fn=heed,
    ) as process:
        assert process.stdout.readline() == b"{\n"
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
        # Interrupted while it runs a text, as dataclasses do, Python ends by the signal: a shell says 130 of either.
        assert process.returncode in (130, -signal.SIGINT)
        assert errors == b""


def test_a_program_without_a_console_ends_well(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    for name in ("stdout", "stderr"):
        monkeypatch.setattr(f"sys.{name}", None)
    assert run_command_line(["render", "cube", "-o", "cube.png", "--size", "8x8"]) == 0
    assert run_command_line(["render", "cube", "-o", "cube.jpg"]) == 2
