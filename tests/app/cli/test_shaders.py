"""Shaders on the command line, and in state files."""

import json
from dataclasses import replace

import numpy as np
import pytest

from app.files.open_any import open_any
from app.files.state_files import State, load_state
from app.files.state_scenes import StateFileError
from core import render
from core.shaders.presets import PRESETS, TASK_FRAGMENT, TASK_VERTEX, preset_program
from core.shaders.record import ShaderProgram
from lessons.lectures.scenes import scene_named
from tests.app.cli.cli_runs import refused, run_program
from tests.app.files.states import again, assert_same


def _picture(tmp_path, *arguments):
    run = run_program("render", *arguments, "--size", "40x30", "--buffers", tmp_path / "a.npz")
    assert run.returncode == 0, run.stderr
    return np.load(tmp_path / "a.npz")["color"]


def test_shaders_of_files_draw_the_picture(tmp_path):
    vertex, fragment = tmp_path / "a.vert", tmp_path / "a.frag"
    vertex.write_text(TASK_VERTEX)
    fragment.write_text(
        TASK_FRAGMENT.replace("vColor, 1.0", "vColor * t, 1.0").replace("in vec3", "uniform float t; in vec3")
    )
    found = _picture(tmp_path, "cube", "--vertex", vertex, "--fragment", fragment, "--uniform", "t=0.5")
    scene = replace(scene_named("cube").make(), size=(40, 30))
    wanted = render(
        replace(scene, program=ShaderProgram(TASK_VERTEX, fragment.read_text(), (("t", (0.5,)),)))
    )
    np.testing.assert_array_equal(found, wanted.color)
    assert (found[..., 3] > 0).any()


def test_a_preset_has_the_light_of_the_scene(tmp_path):
    scene = replace(scene_named("sphere").make(), size=(40, 30))
    wanted = render(replace(scene, program=preset_program("phong", scene)))
    np.testing.assert_array_equal(_picture(tmp_path, "sphere", "--shaders", "phong"), wanted.color)
    (tmp_path / "p.frag").write_text(PRESETS["phong"].fragment)
    np.testing.assert_array_equal(
        _picture(tmp_path, "sphere", "--fragment", tmp_path / "p.frag"), wanted.color
    )


def test_a_trace_has_the_lines_of_the_shader():
    run = run_program("trace", "lmu-shaders", "--stage", "shade", "--size", "8x6", "--format", "text")
    assert run.returncode == 0, run.stderr
    assert "Line 9: outColor = vec4(vColor, 1) = (" in run.stdout
    run = run_program(
        "trace", "cube", "--triangle", 0, "--stage", "transform", "--shaders", "minimal", "--format", "json"
    )
    assert run.returncode == 0, run.stderr
    assert "statement" in run.stdout


def test_lanes_run_together_in_a_trace_and_in_states(tmp_path):
    asked = ("trace", "lmu-shaders", "--stage", "transform", "--format", "npz", "-o")
    for name, *order in (("one.npz",), ("together.npz", "--lanes", "together")):
        run = run_program(*asked, tmp_path / name, *order)
        assert run.returncode == 0, run.stderr
    one, together = (np.load(tmp_path / name)["corner"] for name in ("one.npz", "together.npz"))
    assert one[:8].tolist() == [0, 0, 0, 0, 1, 1, 1, 1]
    assert together[:8].tolist() == [0, 1, 2, 0, 1, 2, 0, 0]
    document = replace(open_any("lmu-shaders").document, lanes="together")
    assert again(tmp_path, State(document, "shade", 3)).document.lanes == "together"


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["--fragment", "wrong.frag"], 1, "fragment shader, line 4, column 19: c is vec4, the value is vec3"),
        (["--fragment", "none.frag"], 1, "none.frag"),
        (
            ["--shaders", "toon", "--uniform", "step=4"],
            2,
            "these shaders have no uniform step, only lightSource",
        ),
        (["--uniform", "steps"], 2, "must be NAME=N,N"),
        (["--uniform", "steps=4"], 2, "needs shaders: give --vertex, --fragment or --shaders"),
        (["--shaders", "toon", "--vertex", "wrong.frag"], 2, "not together with --vertex and --fragment"),
    ],
)
def test_wrong_shaders_are_one_line(tmp_path, arguments, code, said):
    (tmp_path / "wrong.frag").write_text(
        "#version 300 es\nin vec3 vNormal;\nout vec4 c;\nvoid main() {     c = vNormal; }\n"
    )
    arguments = [str(tmp_path / text) if text.endswith(".frag") else text for text in arguments]
    assert said in refused(code, "render", "cube", "-o", tmp_path / "a.png", *arguments)
    assert "shaders need a scene of meshes" in refused(
        2, "render", "fan", "-o", tmp_path / "a.png", "--shaders", "toon"
    )


def test_a_state_keeps_the_shaders_as_text(tmp_path):
    scene = scene_named("lmu-shaders").make()
    program = replace(scene.program, uniforms=(("unused", (1.0, 2.0)),))
    document = replace(open_any("lmu-shaders").document, scene=replace(scene, program=program))
    state = State(document, "shade", 12)
    read = again(tmp_path, state)
    assert_same(state, read)
    assert read.document.scene.program == program
    path = next(tmp_path.glob("*.rasterscope"))
    record = json.loads(path.read_text())
    assert record["scene"]["program"]["vertex"] == TASK_VERTEX
    record["scene"]["program"]["fragment"] = "#version 300 es\nvoid main() { }\n"
    path.write_text(json.dumps(record))
    with pytest.raises(
        StateFileError, match=r"scene.program: fragment shader, line 2, .*no colour leaves this shader"
    ):
        load_state(path)
