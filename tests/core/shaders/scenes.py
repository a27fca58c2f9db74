"""Scenes with shaders that tests draw: the tutorial's triangle, and a square over the whole window."""

import numpy as np

from core import Camera, Mesh, Scene
from core.scene import Texture
from core.shaders.presets import TASK_FRAGMENT, TASK_VERTEX
from core.shaders.record import ShaderProgram

POSITIONS = np.array([[-5, -3, -10], [0, 5, -10], [10, -5, -10]], float)
COLORS = np.array([[0x33, 0x99, 0xFF], [0, 0xFF, 0xFF], [0x55, 0, 0xEE]]) / 255
CAMERA = Camera(np.zeros(3), np.array([0.0, 0, -1]), field_of_view=np.radians(45), near=0.1, far=100)
SQUARE = """#version 300 es
uniform float depth;
out vec2 vUv;
void main() { gl_Position = vec4(position.xy, depth, 1.0); vUv = uv; }
"""
"""A square that fills the window."""

BRANCHES = """
vec2 p = vUv - 0.5;
float r = length(p) * 2.0;
if (r > 0.9) discard;
vec3 k = vec3(0.0);
for (int i = 0; i < 2; i++) {
   if (p.x > 0.2) continue;
   k[i] += p.x > 0.0 ? r : 1.0 - r;
}
c = vec4(k, 1.0);
c.r *= dFdx(r) + 0.5;
"""
"""A body of main with branches, a loop, a discarded fragment and a derivative."""


def tutorial_scene(
    vertex: str = TASK_VERTEX, fragment: str = TASK_FRAGMENT, size: tuple[int, int] = (512, 384)
) -> Scene:
    """Return the tutorial's triangle, drawn by two shaders."""
    mesh = Mesh(POSITIONS, np.array([[0, 2, 1]]), colors=np.column_stack([COLORS, np.ones(3)]))
    dialect = "raw-shader-material" if "in vec3 position" in vertex else "shader-material"
    return Scene((mesh,), CAMERA, size=size, program=ShaderProgram(vertex, fragment, dialect=dialect))


def square_scene(
    fragment: str,
    size: tuple[int, int] = (8, 8),
    uniforms: dict[str, tuple[float, ...]] | None = None,
    texture: Texture | None = None,
    vertex: str = SQUARE,
) -> Scene:
    """Return a square over the whole window, with a body of a fragment shader that reads vUv and writes c."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    mesh = Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), uvs=uvs, texture=texture)
    source = (
        fragment
        if "main" in fragment
        else (
            f"#version 300 es\nprecision highp float;\nin vec2 vUv;\nuniform sampler2D map;\nuniform float t;\n"
            f"out vec4 c;\nvoid main() {{ {fragment} }}\n"
        )
    )
    return Scene(
        (mesh,), CAMERA, size=size, program=ShaderProgram(vertex, source, tuple((uniforms or {}).items()))
    )
