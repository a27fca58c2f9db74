"""Shaders as beginners write them: each with the line that is wrong, and the sentence that must be said."""

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

BODIES: list[tuple[int, str, str]] = [
    (9, "c is vec4, the value is vec3 (write vec4(v, 1.0))", "c = n;"),
    (
        9,
        "there is no vec4 * int (GLSL converts nothing by itself: write 1.0 for 1",
        "c = vec4(1, 1.0, 0.0, 1.0) * 2;",
    ),
    (9, ".xyzq mixes letters: use xyzw, rgba or stpq", "c = vec4(1.0).xyzq;"),
    (9, ".xk is no component: a vector has x, y, z, w", "c = vec4(n.xk, 1.0, 1.0);"),
    (9, ".w: vec3 has no component w, only xyz", "c = vec4(n.w);"),
    (9, "there is no sin(int), only sin(float or vector) (GLSL converts nothing", "c = vec4(sin(1));"),
    (9, "expected a value, got ;", "c = vec4(1.0) +;"),
    (9, "nn is not declared", "c = vec4(nn, 1.0);"),
    (9, "step is a function: write step(...), or did you mean steps?", "float steps = t; c = vec4(step);"),
    (9, "N is not declared: did you mean n?", "c = vec4(N, 1.0);"),
    (9, "there is no function normalise: did you mean normalize?", "c = vec4(normalise(n), 1.0);"),
    (9, "a ; is missing at the end of this statement", "c = vec4(1.0)\n   c.x = 2.0;"),
    (9, "a ; is missing at the end of this statement", "c = vec4(1.0)"),
    (9, "a condition must be bool and not float: compare it, as x > 0.0", "if (t) c = vec4(1.0);"),
    (9, "a condition must be bool and not int: compare it, as x != 0", "int i = 3; while (i) i--;"),
    (9, "= stores a value: to compare write ==", "if (t = 1.0) c = vec4(1.0);"),
    (9, "== compares: to store a value write =", "c == vec4(1.0);"),
    (9, "n is an in variable: it can only be read", "n = vec3(1.0);"),
    (9, "t is a uniform: a shader can only read it", "t += 1.0;"),
    (9, "a is const: it keeps its value", "const float a = 1.0; a = 2.0;"),
    (9, ".xx names a component twice", "c.xx = vec2(1.0);"),
    (9, "brackets may be nested 64 deep", "c = vec4(" + "(" * 80 + "1.0" + ")" * 80 + ");"),
    (9, "break stands outside of a loop", "break;"),
    (9, "L is vec3, the value is float (write vec3(x))", "vec3 L = normalize(1.0);"),
    (9, "an int reaches to 2147483647, 3000000000 is larger", "int k = 3000000000;"),
    (9, "x is float, the value is int (GLSL converts nothing by itself: write 1.0 for 1", "float x = 1;"),
    (9, "k is int, the value is float (GLSL converts nothing by itself: write int(...))", "int k = 1.0;"),
    (9, "vec4 needs 4 numbers, these are 3", "c = vec4(n);"),
    (9, "vec3 needs 3 numbers, these are 4", "c = vec4(vec3(n.x, n.y, n.z, 1.0), 1.0);"),
    (9, "there is no vec3 * mat4 (the sizes differ", "c = vec4(n * m, 1.0);"),
    (9, "there is no mat4 * vec3 (the sizes differ: write vec4(v, 1.0))", "c = m * n;"),
    (
        9,
        "< compares single numbers: for vectors write any(lessThan(a, b))",
        "if (n < vec3(1.0)) c = vec4(1.0);",
    ),
    (9, "! needs bool and not float", "if (!t) c = vec4(1.0);"),
    (9, "GLSL ES 3.00 has no texture2D: write texture", "c = texture2D(map, n.xy);"),
    (9, "there is no texture(sampler2D, vec3), only texture(sampler2D, vec2)", "c = texture(map, n);"),
    (9, "GLSL ES 3.00 has no gl_FragColor: declare out vec4 outColor;", "gl_FragColor = vec4(1.0);"),
    (9, "GLSL has no saturate: write clamp(x, 0.0, 1.0)", "c = vec4(saturate(t));"),
    (9, "GLSL calls it mix", "c = vec4(lerp(t, 1.0, 0.5));"),
    (9, "for floats write mod(a, b)", "c = vec4(t % 2.0);"),
    (9, "|: operations on bits are not supported here", "int k = 1 | 2;"),
    (9, "arrays are not supported here", "float a[3];"),
    (9, "switch is not supported here: write if and else", "switch (1) { }"),
    (9, "do is not supported here: write for or while", "do { } while (true);"),
    (9, "a vector of GLSL is vec2", "float2 a = n.xy;"),
    (9, "index 3 of vec3 is outside of 0 to 2", "c = vec4(n[3]);"),
    (9, "an index must be int and not float", "c = vec4(n[1.0]);"),
    (9, "x is declared twice", "float x = 1.0; float x = 2.0;"),
    (9, "nothing can be stored here: the left side of = must be a variable", "n.x + 1.0 = t;"),
    (
        9,
        "both values of ? : must have one type, these are vec3 and float",
        "c = vec4(t > 0.0 ? n : 1.0, 1.0);",
    ),
    (9, "clamp takes 3 values, here it gets 2", "c = vec4(clamp(t, 0.0));"),
    (9, "there is no dot(vec3, vec4)", "c = vec4(dot(n, c));"),
    (9, "main is void: it returns nothing", "return 1.0;"),
    (9, "expected ; between the parts of a loop's head", "for (int i = 0) c = vec4(1.0);"),
    (9, "this else has no if before it", "else c = vec4(1.0);"),
    (9, "GLSL has no character '$'", "c = vec4($t);"),
    (9, "this comment never ends", "c = vec4(1.0); /* why"),
    (9, "write it behind the name: i++", "int i = 0; ++i;"),
    (9, "a bool is not a number: write c ? 1.0 : 0.0", "c = vec4(1.0) * (t > 0.0);"),
    (9, "write 1.0 instead of 1f", "c = vec4(1f);"),
    (9, "n is a variable and cannot be called: is a * missing before the bracket?", "c = vec4(n(t), 1.0);"),
    (9, "normal is not declared", "c = vec4(normal, 1.0);"),
    (10, "y is not declared", "if (t > 0.0) { float y = 1.0; }\n   c = vec4(y);"),
]
"""Line, part of the sentence, body of main."""

WHOLE: list[tuple[int, str, str]] = [
    (5, "there is no function main", "#version 300 es\nprecision highp float;\nout vec4 c;\n\n"),
    (1, "this is GLSL ES 3.00: write #version 300 es", "#version 100\nvoid main() { }\n"),
    (2, "#define is not supported here: write const", "#version 300 es\n#define PI 3.14\nvoid main() { }\n"),
    (2, "GLSL ES 3.00 has no varying: write out in the vertex shader", "#version 300 es\nvarying vec3 v;\n"),
    (2, "no colour leaves this shader: declare out vec4 outColor;", "#version 300 es\nvoid main() { }\n"),
    (
        2,
        "the colour is red, green, blue and alpha: write out vec4 c, not vec3",
        "#version 300 es\nout vec3 c;\nvoid main() { c = vec3(1.0); }\n",
    ),
    (8, "this { is never closed: } is missing", HEAD + "void main() {\n   c = vec4(1.0);\n"),
    (10, "this } closes nothing", HEAD + "void main() {\n   c = vec4(1.0);\n}}\n"),
    (
        8,
        "mix is a function of GLSL: choose another name",
        HEAD + "float mix(float a) { return a; }\nvoid main() { c = vec4(1.0); }\n",
    ),
    (
        8,
        "f gives float, vec3 is returned",
        HEAD + "float f() { return n; }\nvoid main() { c = vec4(f()); }\n",
    ),
    (
        9,
        "f takes (float), here it gets (int)",
        HEAD + "float f(float x) { return x; }\nvoid main() { c = vec4(f(1)); }\n",
    ),
    (
        8,
        "f calls itself in the end: GLSL has no recursion",
        HEAD + "float f(float x) { return f(x); }\nvoid main() { c = vec4(f(1.0)); }\n",
    ),
    (
        8,
        "there is no function g: write a function before the functions that call it",
        HEAD + "void main() { c = vec4(g()); }\nfloat g() { return 1.0; }\n",
    ),
    (8, "f ends without return", HEAD + "float f() { float x = 1.0; }\nvoid main() { c = vec4(f()); }\n"),
    (
        8,
        "inout parameters are not supported here: return the value instead",
        HEAD + "void f(inout float x) { }\nvoid main() { c = vec4(1.0); }\n",
    ),
    (
        8,
        "x is vec2, the value is vec3 (write v.xy)",
        HEAD + "void f() { vec2 x = n; }\nvoid main() { c = vec4(1.0); }\n",
    ),
    (
        3,
        "whole numbers are not interpolated: write flat in int",
        "#version 300 es\nout vec4 c;\nin int k;\nvoid main() { c = vec4(1.0); }\n",
    ),
    (2, "a const needs its value", "#version 300 es\nconst float a;\nvoid main() { }\n"),
    (2, "struct is not supported here", "#version 300 es\nstruct A { float x; };\nvoid main() { }\n"),
]
"""Line, part of the sentence, whole shader."""
