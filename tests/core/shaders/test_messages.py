"""What a beginner's mistake is answered with: the right line, and a sentence that says what to write."""

import pytest

from core.lanes.problem import Problem
from core.shaders.record import ShaderProblem, ShaderProgram
from core.shaders.shader import Shader
from tests.core.shaders.broken import BROKEN


@pytest.mark.parametrize(("line", "said", "source"), BROKEN, ids=[said[:40] for _, said, _ in BROKEN])
def test_a_mistake_is_named_at_its_line(line, said, source):
    with pytest.raises(Problem) as caught:
        Shader(source, "fragment", "raw-shader-material")
    assert said in caught.value.sentence
    assert caught.value.line == line
    assert caught.value.column >= 1


def test_only_a_fragment_can_be_discarded():
    source = "#version 300 es\nvoid main() {\n   discard;\n}\n"
    with pytest.raises(Problem, match=r"line 3, column 4: only a fragment can be discarded"):
        Shader(source, "vertex", "shader-material")


def test_names_of_three_js_are_declared_by_a_switch():
    source = "#version 300 es\nvoid main() { gl_Position = projectionMatrix * vec4(position, 1.0); }\n"
    assert Shader(source, "vertex", "shader-material").notes == ()
    with pytest.raises(
        Problem, match=r"only ShaderMaterial declares it. Switch to it, or write uniform mat4"
    ):
        Shader(source, "vertex", "raw-shader-material")
    again = source.replace("void", "in vec3 position;\nvoid")
    with pytest.raises(Problem, match="line 2, column 9: ShaderMaterial declares position already"):
        Shader(again, "vertex", "shader-material")


def test_a_vertex_shader_that_places_nothing_is_noted():
    shader = Shader(
        "#version 300 es\nout vec3 v;\nvoid main() { v = position; }\n", "vertex", "shader-material"
    )
    assert "gl_Position is never written" in " ".join(shader.notes)


VERTEX = (
    "#version 300 es\nout vec3 vColor;\nvoid main() { gl_Position = vec4(position, 1.0); vColor = color; }\n"
)
FRAGMENT = "#version 300 es\nin vec3 vColor;\nout vec4 c;\nvoid main() { c = vec4(vColor, 1.0); }\n"


@pytest.mark.parametrize(
    ("fragment", "said"),
    [
        (FRAGMENT.replace("vColor", "vColour"), "vColour has no source: .* did you mean vColor?"),
        (
            FRAGMENT.replace("in vec3", "in vec4").replace("vec4(vColor, 1.0)", "vColor"),
            "vColor is vec4 here and vec3 in the vertex shader",
        ),
        (FRAGMENT.replace("in vec3", "flat in vec3"), "vColor is flat vec3 here and vec3"),
    ],
)
def test_shaders_that_do_not_fit_are_refused(fragment, said):
    with pytest.raises(ShaderProblem, match=rf"^fragment shader, line 2, column \d+: {said}"):
        ShaderProgram(VERTEX, fragment)


def test_attributes_and_uniforms_must_be_there():
    with pytest.raises(
        ShaderProblem, match=r"vertex shader, line 2, .* a mesh has no attribute colour.*mean color?"
    ):
        ShaderProgram(VERTEX.replace("out vec3", "in vec3 colour;out vec3"), FRAGMENT)
    with_t = FRAGMENT.replace("in vec3", "uniform vec2 t; in vec3")
    with pytest.raises(ValueError, match=r"uniform t is vec2: 2 numbers, got 1"):
        ShaderProgram(VERTEX, with_t, (("t", (1.0,)),))
    with pytest.raises(ValueError, match="uniform t must be finite"):
        ShaderProgram(VERTEX, with_t, (("t", (1.0, float("nan"))),))
