"""Texts that want to break the lab, and mutations of good ones: a sentence, and no traceback, hang or large memory."""

import random
import re
import time
import tracemalloc
from dataclasses import replace

import pytest

from core.lanes.problem import Problem
from core.shaders.shader import LIMITS, Shader
from tests.core.shaders.broken import MAIN
from tests.core.shaders.samples import SAMPLES, random_lanes, shader_of
from tests.covering import is_everything

CALLERS = "\n".join(
    f"float f{k}(float x) {{ return {' + '.join([f'f{k - 1}(x)'] * 40)}; }}"
    if k
    else "float f0(float x) { return x; }"
    for k in range(8)
)
NESTED = "for (int i = 0; i < 1000; i++) " * 3 + "c.x += 1.0;"
HOSTILE = {
    "long": "//" + "x" * 20_001,
    "deep": MAIN.replace("{}", "c = vec4(" + "(" * 64 + "t" + ")" * 64 + ");"),
    "signs": MAIN.replace("{}", "c = vec4(" + "-" * 3000 + "t);").replace("--", "- -"),
    "chain": MAIN.replace("{}", "c = vec4(" + "t + " * 4000 + "t);"),
    "letters": MAIN.replace("{}", "c = vec4(n" + ".xyz" * 4000 + ", t);"),
    "blocks": MAIN.replace("{}", "{" * 3000 + "}" * 3000),
    "ifs": MAIN.replace("{}", "if (t > 0.0) " * 1000 + "discard;"),
    "elses": MAIN.replace("{}", "if (t > 0.0) discard; " + "else if (t > 1.0) discard; " * 500),
    "choices": MAIN.replace("{}", "c = vec4(" + "t > 0.0 ? t : " * 1000 + "t);"),
    "calls": MAIN.replace("void main", CALLERS + "\nvoid main").replace("{}", "c = vec4(f7(t));"),
    "variables": MAIN.replace("{}", "mat4 " + ", ".join(f"a{k}" for k in range(500)) + ";"),
    "number": MAIN.replace("{}", "c = vec4(1" + "0" * 5000 + ".0);"),
    "exponent": MAIN.replace("{}", "int k = 1e999999999;"),
    "nul": MAIN.replace("{}", "c = vec4(\0);"),
    "surrogate": MAIN.replace("{}", "c = vec4(\ud800);"),
    "letter": MAIN.replace("{}", "float \u00e4 = 1.0;"),
    "python": MAIN.replace("{}", "__import__('os').system('x');"),
    "attribute": MAIN.replace("{}", "c = n.__class__;"),
    "directive": "#include </etc/passwd>\n" + MAIN,
    "empty": "",
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_text_ends_in_a_sentence(name):
    start = time.process_time()
    with pytest.raises(Problem) as caught:
        Shader(HOSTILE[name], "fragment", "raw-shader-material")
    assert len(caught.value.sentence) < 200
    assert time.process_time() - start < 4


def test_brackets_up_to_the_limit_are_read():
    Shader(
        MAIN.replace("{}", "c = vec4(" + "(" * 60 + "t" + ")" * 60 + ");"), "fragment", "raw-shader-material"
    )
    Shader(MAIN.replace("{}", "c = vec4(" + "t + " * 240 + "t);"), "fragment", "raw-shader-material")


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("while (t == t) { c = a; }", r"line 8, column 1: the loop goes on after 1,000 rounds"),
        ("for (float x = a.x; x != 0.5; x += 1.0) { }", r"the loop goes on after 1,000 rounds"),
        (NESTED, "longer than 0.3 seconds|after 1,000 rounds"),
    ],
)
def test_an_endless_loop_stops_with_its_line(body, said):
    shader = shader_of(SAMPLES["phong"].split("void main")[0] + "void main() {\n" + body + "\n}\n")
    with pytest.raises(Problem, match=said):
        shader.run(random_lanes(64), 64, limits=replace(LIMITS, seconds=0.3))


def test_a_run_can_be_ended():
    shader = shader_of(SAMPLES["phong"].split("void main")[0] + "void main() {" + NESTED + "}")
    with pytest.raises(Problem, match="stopped"):
        shader.run(random_lanes(4), 4, stop=lambda: True)


def test_what_the_most_variables_take_stays_small():
    names = ", ".join(f"a{k} = a * {k}.0" for k in range(200))
    shader = shader_of(SAMPLES["phong"].split("void main")[0] + f"void main() {{ vec4 {names}; c = a199; }}")
    given = random_lanes(shader.block)
    tracemalloc.start()
    shader.run(given, shader.block)
    assert tracemalloc.get_traced_memory()[1] < 20e6
    tracemalloc.stop()


SIGNS = [
    *"(){}[];,.+-*/%<>=!?:",
    *("&&", "||", "++", "--", "+=", "==", "#", "//", "/*", "*/", "\n", "\x00", "é"),
]
NAMES_IN_TURN = (
    "1 0 1.0 2 .5 1e9 2147483647 x y a b c t i vec2 vec3 vec4 float int bool mat3 if else for while return break "
    "continue discard in out uniform const flat true sin dot normalize texture dFdx xyz rgba main void gl_FragCoord"
)
NAMES = NAMES_IN_TURN.split()
WORDS = SIGNS + NAMES


TOKEN = re.compile(r"[A-Za-z_]\w*|\d+\.\d*|\d+|[-+*/%<>=!&|]+|[(){};,]")


def _mutated(source, rng):
    """Return a source with another token of the same kind somewhere, or with another piece of text."""
    tokens = list(TOKEN.finditer(source))
    if rng.random() < 0.7:
        old = rng.choice(tokens[12:])
        alike = [other[0] for other in tokens if other[0][0].isalpha() == old[0][0].isalpha()] + NAMES[:20]
        return source[: old.start()] + rng.choice(alike) + source[old.end() :]
    at, way = rng.randrange(len(source)), rng.randrange(3)
    end = min(len(source), at + rng.randint(1, 8))
    if way == 0:
        return source[:at] + source[end:]
    if way == 1:
        return source[:at] + f" {rng.choice(WORDS)} " + source[at:]
    other = rng.randrange(len(source))
    return source[:at] + source[other : other + rng.randint(1, 30)] + source[at:]


def _outcome(source, given):
    """Return ``None`` if a shader ran on 8 lanes, else the problem."""
    try:
        shader = Shader(source, "fragment", "raw-shader-material")
        known = {v.name: given[v.name] for v in shader.inputs if v.name in given and given[v.name].of == v.of}
        shader.run(known, 8, limits=replace(LIMITS, seconds=0.5))
    except Problem as problem:
        return problem
    return None


def test_mutations_end_in_a_picture_or_a_sentence():
    rng, given = random.Random(7), random_lanes(8)
    count, ran = 20_000 if is_everything() else 300, 0
    for _ in range(count):
        source = _mutated(rng.choice(list(SAMPLES.values())), rng)
        problem = _outcome(source, given)
        ran += problem is None
        if problem is not None:
            assert 1 <= problem.line <= source.count("\n") + 1
            assert problem.sentence
            assert "cannot be computed" not in problem.sentence, source
    assert ran > count / 20
