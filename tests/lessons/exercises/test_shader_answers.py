"""Shaders that are repaired or written: what is right, what is wrong and where, what cannot run; and their files."""

from pathlib import Path

import numpy as np
import pytest

from lessons.exercises.answers.listings import CannotRunError, CodeAnswer, head_alone
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.coding import fragment_shaders, vertex_shaders
from lessons.exercises.coding.fragment_shaders import (
    ALPHA_TEST,
    CHECKER,
    DIFFUSE,
    HIGHLIGHT,
    LAMBERT,
    TEXTURE,
)
from lessons.exercises.coding.tasks import TASKS
from lessons.exercises.coding.vertex_shaders import VERTEX
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import ask, judge
from lessons.mistakes.shelf import SHADERS


def unit(vector):
    return np.array(vector) / np.linalg.norm(vector)


def test_the_right_texts_give_what_numpy_computes() -> None:
    def lambert(normal, direction):
        return max(float(unit(normal) @ -unit(direction)), 0.0)

    def highlight(n, to_light, to_eye, shininess):
        return max(float(np.array(n) @ unit(np.add(to_light, to_eye))), 0.0) ** shininess

    def checker(uv, squares):
        return (np.floor(uv[0] * squares) + np.floor(uv[1] * squares)) % 2

    for task, rule in ((LAMBERT, lambert), (HIGHLIGHT, highlight), (CHECKER, checker)):
        found = [row for (row,) in task.results(task.text)]
        np.testing.assert_allclose(found, [rule(*case.values) for _, case in task.all_cases], atol=1e-6)
    for (_, case), found in zip(VERTEX.all_cases, VERTEX.results(VERTEX.text), strict=True):
        position, normal, color, *matrices = case.values
        view, projection = (np.reshape(one, (4, 4)).T for one in matrices[:2])
        clip = projection @ view @ [*position, 1]
        seen = np.linalg.inv(view[:3, :3]).T @ normal
        np.testing.assert_allclose(found, [*clip, *seen, *color], atol=1e-5)


def test_each_wrong_line_is_wrong_somewhere_and_right_somewhere_else() -> None:
    for task in (*vertex_shaders.TASKS, *fragment_shaders.TASKS):
        assert len(task.cases) >= 4
        wrong = [{one.name for one in task.wrong_cases(task.with_fault(fault))} for fault in task.faults]
        assert all(wrong), task.name
        assert len(set(map(frozenset, wrong))) > 1, task.name
        assert {fault.mistake for fault in task.faults} - {""} <= set(SHADERS)


def test_a_right_shader_draws_what_built_in_shading_draws() -> None:
    for task in (DIFFUSE, TEXTURE, VERTEX):
        right = task.beside(task.text)
        assert not right.differs, task.name
    answer = CodeAnswer(DIFFUSE, head_alone(DIFFUSE))
    assert answer.opened(DIFFUSE.text.replace("* -light", "* light")) is not None
    assert (
        CodeAnswer(LAMBERT, head_alone(LAMBERT)).opened(LAMBERT.text.replace("-direction", "direction"))
        is None
    )


OTHERS = {
    DIFFUSE: DIFFUSE.text.replace("vec3 N = normalize(vNormal);", "vec3 N = vNormal / length(vNormal);"),
    LAMBERT: "float lambert(vec3 n, vec3 d) {\n"
    "   float cosine = -dot(n, d) / (length(n) * length(d));\n"
    "   if (cosine < 0.0) return 0.0;\n"
    "   return cosine;\n}",
    ALPHA_TEST: ALPHA_TEST.text.replace(
        "if (vColor.a < threshold) discard;", "if (!(vColor.a >= threshold)) { discard; }"
    ),
    TEXTURE: TEXTURE.text.replace(
        "texture(map, vUv)", "texelFetch(map, ivec2(vUv * vec2(textureSize(map, 0))), 0)"
    ),
    VERTEX: VERTEX.text.replace(
        "projectionMatrix * seen", "projectionMatrix * (modelViewMatrix * vec4(position, 1.0))"
    ),
}


def test_another_way_to_write_the_same_is_right() -> None:
    for task, text in OTHERS.items():
        assert text != task.text
        answer = CodeAnswer(task, head_alone(task))
        assert answer.check(answer.read(text)).score == 1, task.name


def test_the_input_that_shows_it_and_the_mistake_are_told() -> None:
    question = ask(TEMPLATES["repair-alpha-test-shader"], 0)
    answer = question.draft.answer
    reversed_text = ALPHA_TEST.text.replace("a < threshold", "a > threshold")
    judged = judge(question, answer.read(reversed_text))
    assert judged.mistakes == ("threshold-reversed",)
    assert judged.sentences == [
        SHADERS["threshold-reversed"].sentence,
        "For vColor = (1, 0.5, 0.25, 0.75), threshold = 0.5: yours discarded; right (1, 0.5, 0.25, 1).",
    ]
    short = DIFFUSE.text.replace("normalize(vNormal)", "vNormal")
    assert CodeAnswer(DIFFUSE, head_alone(DIFFUSE)).check(short).counts == "right in 6 of 7 classes of inputs"


HEAD = LAMBERT.head
CANNOT = {
    f"{HEAD}\n   return 1;\n}}": (2, "lambert gives float, int is returned"),
    f"{HEAD}\n   return 1.0;": (1, "is never closed"),
    f"{HEAD}\n   while (true) {{}}\n   return 1.0;\n}}": (2, "the loop goes on"),
    f"{HEAD}\n   return sqrt(x);\n}}": (2, "x is not declared"),
    "float lambert(vec3 normal) {\n   return 1.0;\n}": (1, "the head of lambert must stay"),
    "vec3 other(vec3 a, vec3 b) {\n   return a;\n}": (1, "the head of lambert must stay"),
    "__import__('os').system('x')": (1, "GLSL has no character"),
}


@pytest.mark.parametrize("text", CANNOT)
def test_what_cannot_run_is_no_wrong_answer(text: str) -> None:
    answer = CodeAnswer(LAMBERT, head_alone(LAMBERT))
    line, said = CANNOT[text]
    with pytest.raises(CannotRunError, match=said) as caught:
        answer.check(answer.read(text))
    assert caught.value.place.line == line


def test_a_shader_that_writes_something_else_is_told() -> None:
    answer = CodeAnswer(DIFFUSE, head_alone(DIFFUSE))
    with pytest.raises(CannotRunError, match="outColor must be written"):
        answer.check(answer.read(DIFFUSE.text.replace("outColor", "color")))


def test_a_file_asks_for_a_shader(tmp_path: Path) -> None:
    path = tmp_path / "shader.toml"
    number = DIFFUSE.text.split("\n").index("   vec3 N = normalize(vNormal);") + 1
    path.write_text(
        'version = 1\ntitle = "A shader"\nstage = "shade"\nquestion = "Repair it."\n[answer]\ntype = "code"\n'
        f'task = "diffuse-shader"\nline = {number}\n',
        encoding="utf-8",
    )
    answer = ask(read_exercise(path), 0).draft.answer
    assert "   // this line is missing" in answer.start.split("\n")
    assert answer.check(TASKS["diffuse-shader"].text).score == 1
    with pytest.raises(CannotRunError, match="N is not declared"):
        answer.check(answer.read(answer.start))
