"""Fragment shaders and functions of them, on hidden scenes: light, texture, and what is discarded."""

from dataclasses import replace
from functools import lru_cache, partial

import numpy as np

from core import Settings
from core.scene import Material, Scene, Texture
from core.shaders.presets import VERTEX
from core.shaders.record import ShaderProgram
from lessons.exercises.coding.shader_task import HEAD, Beside, ShaderTask, cases_of
from lessons.exercises.coding.task import Fault
from lessons.scenes import make_scene
from lessons.shapes import FACE_COLORS, linear_color, sphere

# Scenes that a shader of an exercise draws beside built-in shading.


SIZE = (48, 48)


def matte(vertex: str, fragment: str) -> Beside:
    """Return a sphere of large triangles in one light, without a highlight.

    Raises ValueError for shaders that do not fit together.
    """
    scene = _sphere()
    return Beside(Settings(), scene, replace(scene, program=ShaderProgram(vertex, fragment)))


def textured(fragment: str) -> Beside:
    """Return a floor with a texture, without light."""
    scene = _floor()
    settings = Settings(shading="unlit", texture_filter="nearest")
    return Beside(settings, scene, replace(scene, program=ShaderProgram(VERTEX, fragment)))


@lru_cache
def _sphere() -> Scene:
    scene, mesh = make_scene("sphere"), sphere(columns=8, rows=4)
    assert isinstance(scene, Scene)
    colors = np.tile(linear_color(FACE_COLORS[0]), (len(mesh.positions), 1))
    mesh = replace(mesh, colors=colors, material=Material(specular=0.0))
    return replace(scene, meshes=(mesh,), lights=scene.lights[:1], size=SIZE)


@lru_cache
def _floor() -> Scene:
    scene = make_scene("textured-floor")
    assert isinstance(scene, Scene)
    return replace(scene, size=SIZE)


# Fragment shaders and functions of them: light, texture, and what is discarded, on hidden inputs of every
# class.


STRAIGHT = tuple(map(float, np.eye(4).ravel()))
"""Of a camera that looks along -z, column by column."""
TURNED = (0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
"""Of one that looks along x."""
UP, SIDE, SLANTED = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 0.6, 0.8)
_LIGHT = (
    ("vec3", "vNormal"),
    ("vec3", "vColor"),
    ("vec3", "lightDirection"),
    ("float", "ambient"),
    ("float", "diffuse"),
    ("mat4", "viewMatrix"),
)
_RED, _GREY = (1.0, 0.5, 0.25), (0.5, 0.5, 0.5)
_COSINE = "float cosine = max(dot(N, L), 0.0);"
_SURFACE = "outColor = vec4(vColor * (ambient + diffuse * cosine), 1.0);"
_UNIT, _TO_LIGHT = "vec3 N = normalize(vNormal);", "vec3 L = normalize(mat3(viewMatrix) * -lightDirection);"
DIFFUSE = ShaderTask(
    "diffuse-shader",
    "shade",
    "the diffuse light",
    """This fragment shader lights a surface. vNormal is interpolated, so it may be shorter than 1.
    lightDirection is the way the light travels in the world, of any length; mat3(viewMatrix) turns it to what
    the eye sees, as vNormal is. The colour is vColor times the light: ambient, and diffuse times the cosine
    between the normal and the way to the light. What is turned away from the light has ambient light alone.
    Alpha is 1.
    Hint: Take a surface that faces the light, one that is turned away, and one whose normal is shorter than
    1.
    Hint: dot(N, L) is the cosine only where both have length 1; below 0 it says that the surface is turned
    away.
    Hint: With N = (0, 0, 1) and light that travels along (0, 0, -1), the cosine is 1: follow each line.""",
    f"""{HEAD}in vec3 vNormal;
in vec3 vColor;
uniform vec3 lightDirection;
uniform float ambient;
uniform float diffuse;
out vec4 outColor;
void main() {{
   {_UNIT}
   {_TO_LIGHT}
   {_COSINE}
   {_SURFACE}
}}""",
    cases_of(
        _LIGHT,
        {
            "light from the front": [
                (UP, _RED, (0.0, 0.0, -1.0), 0.25, 0.75, STRAIGHT),
                (SIDE, _GREY, (-1.0, 0.0, 0.0), 0.0, 1.0, STRAIGHT),
            ],
            "light at an angle": [
                (SLANTED, _RED, (0.0, 0.0, -1.0), 0.25, 0.5, STRAIGHT),
                (UP, _GREY, (0.0, -0.6, -0.8), 0.5, 0.5, STRAIGHT),
            ],
            "a short normal": [
                ((0.0, 0.0, 0.5), _RED, (0.0, 0.0, -1.0), 0.25, 0.75, STRAIGHT),
                ((0.0, 0.3, 0.4), _GREY, (0.0, 0.0, -1.0), 0.5, 0.5, STRAIGHT),
            ],
            "a long light direction": [
                (UP, _RED, (0.0, 0.0, -2.0), 0.25, 0.75, STRAIGHT),
                (SLANTED, _GREY, (0.0, 0.0, -4.0), 0.5, 0.5, STRAIGHT),
            ],
            "turned away from the light": [
                (UP, _RED, (0.0, 0.0, 1.0), 0.25, 0.75, STRAIGHT),
                (SLANTED, _GREY, (0.0, 0.6, 0.8), 0.5, 0.25, STRAIGHT),
            ],
            "light along the surface": [
                (UP, _RED, SIDE, 0.25, 0.75, STRAIGHT),
                (SIDE, _GREY, (0.0, 0.0, -1.0), 0.5, 0.5, STRAIGHT),
            ],
            "a turned camera": [
                (UP, _RED, SIDE, 0.25, 0.75, TURNED),
                (SLANTED, _GREY, SIDE, 0.5, 0.5, TURNED),
            ],
        },
    ),
    (
        Fault(_UNIT, "vec3 N = vNormal;", "normal-not-unit"),
        Fault(_TO_LIGHT, "vec3 L = normalize(mat3(viewMatrix) * lightDirection);", "light-turned-round"),
        Fault(_TO_LIGHT, "vec3 L = normalize(-lightDirection);"),
        Fault(_TO_LIGHT, "vec3 L = mat3(viewMatrix) * -lightDirection;"),
        Fault(_COSINE, "float cosine = dot(N, L);", "cosine-below-zero"),
        Fault(_COSINE, "float cosine = abs(dot(N, L));"),
        Fault(_SURFACE, "outColor = vec4(vColor * diffuse * cosine, 1.0);", "ambient-missing"),
        Fault(_SURFACE, "outColor = vec4(vColor * (ambient + diffuse * cosine), 0.0);", "alpha-zero"),
        Fault(_SURFACE, "outColor = vec4(vColor * ambient + diffuse * cosine, 1.0);"),
    ),
    ("outColor = vec4(vColor, 1.0);", "outColor = vec4(0.0);", "outColor = vec4(vColor * ambient, 1.0);"),
    given=_LIGHT,
    outputs=("outColor",),
    beside=partial(matte, VERTEX),
)
_RAY = (("vec3", "normal"), ("vec3", "direction"))
LAMBERT = ShaderTask(
    "lambert",
    "shade",
    "the cosine of the light",
    """lambert is given a normal and the direction in which the light travels, both of any length. It returns
    the cosine of the angle between the normal and the way to the light, and 0 where that is below 0.
    Hint: What must come out where the light falls straight on the surface, and what where it comes from
    behind?
    Hint: dot of two vectors of length 1 is the cosine between them.
    Hint: For the normal (0, 0, 1) and light along (0, 0, -1), it is 1; for light along (0, 0, 1), it is
    0.""",
    """float lambert(vec3 normal, vec3 direction) {
   vec3 N = normalize(normal);
   vec3 L = normalize(-direction);
   return max(dot(N, L), 0.0);
}""",
    cases_of(
        _RAY,
        {
            "light from the front": [(UP, (0.0, 0.0, -1.0)), (SIDE, (-1.0, 0.0, 0.0))],
            "light at an angle": [(SLANTED, (0.0, 0.0, -1.0)), (UP, (0.0, -0.6, -0.8))],
            "a normal of another length": [
                ((0.0, 0.0, 0.5), (0.0, 0.0, -1.0)),
                ((0.0, 3.0, 4.0), (0.0, 0.0, -1.0)),
            ],
            "a direction of another length": [(UP, (0.0, 0.0, -2.0)), (SLANTED, (0.0, 0.0, -0.25))],
            "turned away from the light": [(UP, (0.0, 0.0, 1.0)), (SLANTED, (0.0, 0.6, 0.8))],
        },
    ),
    (
        Fault("vec3 N = normalize(normal);", "vec3 N = normal;", "normal-not-unit"),
        Fault("vec3 L = normalize(-direction);", "vec3 L = normalize(direction);", "light-turned-round"),
        Fault("vec3 L = normalize(-direction);", "vec3 L = -direction;"),
        Fault("return max(dot(N, L), 0.0);", "return dot(N, L);", "cosine-below-zero"),
    ),
    ("return 1.0;", "return 0.0;", "return dot(normal, direction);"),
    given=_RAY,
    returns="float",
)
_MIRROR = (("vec3", "N"), ("vec3", "L"), ("vec3", "V"), ("float", "shininess"))
HIGHLIGHT = ShaderTask(
    "highlight",
    "shade",
    "the highlight",
    """highlight is given three vectors of length 1: the normal N, L towards the light and V towards the eye.
    H, of length 1, lies half-way between L and V. It returns the cosine between N and H, 0 where that is
    below 0, to the power of shininess.
    Hint: Where N lies exactly between L and V, the result is 1, whatever the shininess.
    Hint: L + V points half-way between L and V, but it is longer than 1.
    Hint: With N = L = V = (0, 0, 1), H is (0, 0, 1), the cosine is 1, and 1 to any power is 1.""",
    """float highlight(vec3 N, vec3 L, vec3 V, float shininess) {
   vec3 H = normalize(L + V);
   float cosine = max(dot(N, H), 0.0);
   return pow(cosine, shininess);
}""",
    cases_of(
        _MIRROR,
        {
            "the light is mirrored": [(UP, UP, UP, 8.0), (UP, SLANTED, (0.0, -0.6, 0.8), 4.0)],
            "beside the highlight": [(UP, SLANTED, UP, 2.0), (SLANTED, UP, UP, 4.0)],
            "shininess 1": [(UP, SLANTED, UP, 1.0), (UP, SIDE, UP, 1.0)],
            "light and eye far apart": [(UP, SIDE, UP, 4.0), (SLANTED, SIDE, UP, 2.0)],
            "turned away from both": [((0.0, 0.0, -1.0), SLANTED, UP, 3.0), ((0.0, -0.6, -0.8), UP, UP, 2.0)],
        },
    ),
    (
        Fault("vec3 H = normalize(L + V);", "vec3 H = L + V;"),
        Fault("vec3 H = normalize(L + V);", "vec3 H = normalize(V - L);"),
        Fault("vec3 H = normalize(L + V);", "vec3 H = L;"),
        Fault("float cosine = max(dot(N, H), 0.0);", "float cosine = abs(dot(N, H));"),
        Fault("float cosine = max(dot(N, H), 0.0);", "float cosine = max(dot(L, H), 0.0);"),
        Fault("return pow(cosine, shininess);", "return cosine * shininess;"),
    ),
    ("return 1.0;", "return 0.0;", "return shininess;"),
    given=_MIRROR,
    returns="float",
)


_TEXELS = Texture(np.array([[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0.0, 0.0, 1.0], [1.0, 1.0, 0.0]]]))
"""Red and green in the first row, blue and yellow in the second."""
_UV = (("vec2", "vUv"),)
_TEXEL, _OPAQUE = "vec4 texel = texture(map, vUv);", "outColor = vec4(texel.rgb, 1.0);"
TEXTURE = ShaderTask(
    "texture-shader",
    "shade",
    "the textured surface",
    """This fragment shader colours a surface with the texture map. vUv is the place in the texture: (0, 0) is
    its lower left corner, (1, 1) the upper right one. Alpha is 1.
    Hint: Which quarter of the texture has the wrong colour: is it turned over, exchanged, or only another
    colour?
    Hint: u goes to the right and v upwards, in the texture as in vUv.
    Hint: 1.0 - v turns the picture over. Here (0, 0) must read the lower left texel and (1, 1) the upper
    right one.""",
    f"""{HEAD}in vec2 vUv;
uniform sampler2D map;
out vec4 outColor;
void main() {{
   {_TEXEL}
   {_OPAQUE}
}}""",
    cases_of(
        _UV,
        {
            "the lower left quarter": [((0.25, 0.25),), ((0.1, 0.4),)],
            "the lower right quarter": [((0.75, 0.25),), ((0.9, 0.1),)],
            "the upper left quarter": [((0.25, 0.75),), ((0.4, 0.9),)],
            "the upper right quarter": [((0.75, 0.75),), ((0.6, 0.9),)],
        },
    ),
    (
        Fault(_TEXEL, "vec4 texel = texture(map, vec2(vUv.x, 1.0 - vUv.y));"),
        Fault(_TEXEL, "vec4 texel = texture(map, vec2(1.0 - vUv.x, vUv.y));"),
        Fault(_TEXEL, "vec4 texel = texture(map, vUv.yx);"),
        Fault(_TEXEL, "vec4 texel = texture(map, vUv * 0.5);"),
        Fault(_OPAQUE, "outColor = vec4(texel.bgr, 1.0);"),
        Fault(_OPAQUE, "outColor = vec4(texel.rgb, 0.0);", "alpha-zero"),
    ),
    ("outColor = vec4(0.0, 0.0, 0.0, 1.0);", "outColor = vec4(vUv, 0.0, 1.0);"),
    given=_UV,
    outputs=("outColor",),
    textures={"map": _TEXELS},
    beside=textured,
)
_LEAF = (("vec4", "vColor"), ("float", "threshold"))
_TEST = "if (vColor.a < threshold) discard;"
ALPHA_TEST = ShaderTask(
    "alpha-test-shader",
    "shade",
    "the alpha test",
    """This fragment shader discards each fragment whose alpha lies below threshold. All others are written
    with their colour and an alpha of 1, also those that lie exactly at the threshold.
    Hint: Take a fragment above the threshold, one below and one exactly at it: which of them is wrong?
    Hint: discard ends the fragment. What is left must be opaque.
    Hint: With a threshold of 0.0 nothing is below it; with alpha 1.0 nothing may be discarded.""",
    f"""{HEAD}in vec4 vColor;
uniform float threshold;
out vec4 outColor;
void main() {{
   {_TEST}
   outColor = vec4(vColor.rgb, 1.0);
}}""",
    cases_of(
        _LEAF,
        {
            "alpha above the threshold": [((1.0, 0.5, 0.25, 0.75), 0.5), ((0.0, 1.0, 0.5, 1.0), 0.25)],
            "alpha below the threshold": [((1.0, 0.5, 0.25, 0.25), 0.5), ((0.0, 1.0, 0.5, 0.0), 0.25)],
            "alpha at the threshold": [((1.0, 0.5, 0.25, 0.5), 0.5), ((0.0, 1.0, 0.5, 1.0), 1.0)],
            "a threshold of 0": [((1.0, 0.5, 0.25, 0.0), 0.0), ((0.0, 1.0, 0.5, 0.5), 0.0)],
        },
    ),
    (
        Fault(_TEST, "if (vColor.a > threshold) discard;", "threshold-reversed"),
        Fault(_TEST, "if (vColor.a <= threshold) discard;"),
        Fault(_TEST, "if (vColor.r < threshold) discard;"),
        Fault(_TEST, "if (threshold < 0.0) discard;"),
        Fault("outColor = vec4(vColor.rgb, 1.0);", "outColor = vec4(vColor.rgb, 0.0);", "alpha-zero"),
        Fault("outColor = vec4(vColor.rgb, 1.0);", "outColor = vColor;"),
    ),
    ("outColor = vColor;", "discard;", "outColor = vec4(0.0);"),
    given=_LEAF,
    outputs=("outColor",),
)
_BOARD = (("vec2", "uv"), ("float", "squares"))
CHECKER = ShaderTask(
    "checker",
    "shade",
    "a checkerboard",
    """checker is given a place uv and the number of squares on a length of 1. It returns 0 on the square that
    begins at (0, 0), 1 on its four neighbours, and so on in turn, also where u or v is below 0.
    Hint: Number the squares: which column and which row does a place lie in?
    Hint: Columns and rows are whole numbers. Their sum is even on the first square and odd on its neighbours.
    Hint: mod(x, 2.0) is 0 for even and 1 for odd numbers, also below 0.""",
    """float checker(vec2 uv, float squares) {
   vec2 square = floor(uv * squares);
   return mod(square.x + square.y, 2.0);
}""",
    cases_of(
        _BOARD,
        {
            "the first square": [((0.1, 0.1), 4.0), ((0.2, 0.05), 2.0)],
            "a neighbour": [((0.3, 0.1), 4.0), ((0.1, 0.6), 2.0)],
            "on the diagonal": [((0.3, 0.3), 4.0), ((0.9, 0.9), 4.0)],
            "below 0": [((-0.1, 0.1), 4.0), ((-0.1, -0.1), 4.0), ((-0.3, 0.1), 4.0)],
            "beyond 1": [((1.1, 0.1), 4.0), ((1.3, 0.1), 4.0)],
        },
    ),
    (
        Fault("vec2 square = floor(uv * squares);", "vec2 square = uv * squares;"),
        Fault("vec2 square = floor(uv * squares);", "vec2 square = floor(uv);"),
        Fault("vec2 square = floor(uv * squares);", "vec2 square = trunc(uv * squares);"),
        Fault("return mod(square.x + square.y, 2.0);", "return mod(square.x, 2.0);"),
        Fault("return mod(square.x + square.y, 2.0);", "return mod(square.x * square.y, 2.0);"),
    ),
    ("return 0.0;", "return 1.0;", "return uv.x;"),
    given=_BOARD,
    returns="float",
)
TASKS = (DIFFUSE, LAMBERT, HIGHLIGHT, TEXTURE, ALPHA_TEST, CHECKER)
