"""Shaders as beginners write them: each with the line that is wrong, and the sentence that must be said."""

from tests.texts import cases_of

HEAD = """#version 300 es
precision highp float;
in vec3 n;
uniform float t;
uniform mat4 m;
uniform sampler2D map;
out vec4 c;
"""
MAIN = HEAD + "void main() {\n   {}\n}\n"
"""The body begins in line 9."""

BASES = {"main": MAIN, "head": HEAD + "{}", "all": "{}"}
BROKEN = [
    (int(line), said, BASES[base].replace("{}", text, 1))
    for base, line, said, text in cases_of(__file__, "broken.txt")
]
"""Line, part of the sentence, and the shader: a body of main, or more of it."""
