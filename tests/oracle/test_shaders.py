"""Small shaders against a real OpenGL: its recorded answers, and where there is one, the OpenGL of this machine."""

from dataclasses import replace

import numpy as np
import pytest

from app.cli.opengl_check import run_opengl_check
from app.opengl_check.cases import OpenGLMissingError, OpenGLRenderer
from app.opengl_check.shaders import (
    CASES,
    compare_shader,
    draw_scene_with_opengl,
    draw_with_opengl,
    run_with_core,
    shader_inputs,
)
from core import Settings, render
from core.shaders.glsl_types import TYPES
from core.shaders.words import FUNCTIONS
from tests.oracle.record_shaders import FILE, SEED, SIDE, tutorial_scenes

RECORDED = np.load(FILE)
ANSWERS = dict(zip(RECORDED["names"].tolist(), RECORDED["answers"], strict=True))
INPUTS = shader_inputs(SIDE, SEED)


def test_every_operator_type_and_function_is_among_the_cases():
    assert len(CASES) >= 150
    assert {case.name for case in CASES} == set(ANSWERS)
    text = " ".join(case.source for case in CASES)
    assert [name for name in FUNCTIONS if f"{name}(" not in text] == []
    assert [name for name in TYPES if name not in text and name not in ("ivec3", "bvec2", "bvec3")] == []
    words = (
        *("&&", "||", "^^", "!", "?", "%", "++", "--", "%=", "/=", "discard", "break", "continue"),
        *("while", "for"),
    )
    assert [word for word in words if word not in text] == []
    assert FILE.stat().st_size < 300_000


@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_a_shader_gives_what_opengl_gave(case):
    ours = run_with_core(case, *INPUTS)
    result = compare_shader(case, ours, ANSWERS[case.name])
    assert result.agrees, f"{result.excess} numbers differ, by up to {result.error:.1e}"


def test_most_cases_have_the_same_bits():
    exact = [case for case in CASES if case.absolute == case.relative == 0]
    assert len(exact) > 0.75 * len(CASES)


def test_a_change_is_noticed():
    case = next(case for case in CASES if case.name == "a * b + a")
    wrong = replace(case, body=case.body.replace("+ a", "+ b"))
    assert compare_shader(case, run_with_core(wrong, *INPUTS), ANSWERS[case.name]).excess > 200


@pytest.mark.parametrize("name", tutorial_scenes())
def test_the_tutorials_shaders_draw_what_opengl_drew(name):
    _assert_same_picture(tutorial_scenes()[name], RECORDED[name])


def _assert_same_picture(scene, theirs):
    frame = render(scene, Settings(cull="back"))
    np.testing.assert_array_equal(frame.primitive >= 0, theirs[..., 3] > 0)
    np.testing.assert_allclose(frame.color, theirs, atol=5e-7)


@pytest.fixture(scope="module")
def renderer():
    try:
        with OpenGLRenderer() as opened:
            yield opened
    except OpenGLMissingError as error:
        pytest.skip(str(error))


def test_the_opengl_of_this_machine_gives_the_same(renderer):
    for _name, scene in tutorial_scenes().items():
        _assert_same_picture(scene, draw_scene_with_opengl(renderer, scene))
    for case in CASES[::12]:
        result = compare_shader(case, run_with_core(case, *INPUTS), draw_with_opengl(renderer, case, *INPUTS))
        assert result.agrees, case.name


def test_the_command_has_the_family(renderer):
    lines = []
    assert run_opengl_check(["shaders"], write=lines.append) == 0
    assert any(line.startswith("shaders") and "agrees" in line for line in lines)
