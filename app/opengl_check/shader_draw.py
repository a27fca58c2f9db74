"""A fragment shader on every pixel of a square, by OpenGL and by the core."""

import re
from contextlib import ExitStack
from functools import partial
from typing import Any

import numpy as np

from app.opengl_check.draw import OpenGLRenderer, owned
from app.opengl_check.shader_cases import TEXTURE, ShaderCase
from core.records.arrays import Singles
from core.scene import Scene
from core.settings import Settings
from core.shaders.declared import UNIFORMS
from core.shaders.fragment_stage import texture_colors_of
from core.shaders.glsl_types import GlslValue, from_rows
from core.shaders.samplers import Sampler
from core.shaders.shader import Shader
from core.shaders.vertex_stage import uniform_values

T = 0.37
"""The uniform ``t`` of all cases."""
DISCARDED = -9.0
"""What a discarded pixel holds: the cleared colour."""
OVER_ALL = """#version 300 es
void main() { gl_Position = vec4(float(gl_VertexID == 1) * 4.0 - 1.0, float(gl_VertexID == 2) * 4.0 - 1.0, 0.0, 1.0); }
"""


def draw_with_opengl(renderer: OpenGLRenderer, case: ShaderCase, a: Singles, b: Singles) -> Singles:
    """Return what OpenGL computes, (side, side, 4); ``a`` and ``b`` are read as float textures, not interpolated."""
    context, side = renderer.context, len(a)
    source = case.source
    for name in ("a", "b"):
        source = source.replace(f"in vec4 {name};", f"uniform highp sampler2D in_{name};\nvec4 {name};", 1)
    read = "".join(f" {name} = texelFetch(in_{name}, ivec2(gl_FragCoord.xy), 0);" for name in ("a", "b"))
    source = source.replace("void main() {", "void main() {" + read, 1)
    with context, ExitStack() as stack:
        program = owned(stack, context.program(vertex_shader=OVER_ALL, fragment_shader=source))
        for unit, (name, values) in enumerate((("in_a", a), ("in_b", b))):
            texture = owned(stack, context.texture((side, side), 4, values.tobytes(), dtype="f4"))
            texture.filter = (context.NEAREST, context.NEAREST)
            texture.use(unit)
            if name in program:
                program[name].value = unit
        if "map" in program:
            _use_texture(context, stack, case)
            program["map"].value = 2
        if "t" in program:
            program["t"].value = T
        color = owned(stack, context.texture((side, side), 4, dtype="f4"))
        frame = owned(stack, context.framebuffer([color]))
        stack.callback(renderer.rest)
        frame.use()
        frame.clear(DISCARDED, DISCARDED, DISCARDED, DISCARDED)
        context.enable_only(0)
        owned(stack, context.vertex_array(program, [])).render(context.TRIANGLES, 3)
        return np.frombuffer(color.read(), np.float32).reshape(side, side, 4)


def _use_texture(context: Any, stack: ExitStack, case: ShaderCase) -> None:
    rows, columns, _ = TEXTURE.pixels.shape
    texture = owned(stack, context.texture((columns, rows), 4, TEXTURE.pixels.tobytes(), dtype="f4"))
    magnified = context.NEAREST if case.texture_filter == "nearest" else context.LINEAR
    shrunk = magnified
    if case.texture_filter == "trilinear":
        texture.build_mipmaps()
        shrunk = context.LINEAR_MIPMAP_LINEAR
    texture.filter = (shrunk, magnified)
    texture.repeat_x = texture.repeat_y = case.wrap == "repeat"
    texture.use(2)


def run_with_core(case: ShaderCase, a: Singles, b: Singles) -> Singles:
    """Return what the core computes of the same, (side, side, 4)."""
    side = len(a)
    shader = Shader(case.source, "fragment", "raw-shader-material")
    colors_of = partial(texture_colors_of, Settings(texture_filter=case.texture_filter, wrap=case.wrap))
    row, column = np.divmod(np.arange(side * side), side)
    order = np.lexsort((column & 1, row & 1, column // 2, row // 2))
    places = np.stack([column + 0.5, row + 0.5, np.full(side * side, 0.5), np.ones(side * side)], axis=1)
    given = {
        "a": from_rows("vec4", a.reshape(-1, 4)[order]),
        "b": from_rows("vec4", b.reshape(-1, 4)[order]),
        "t": from_rows("float", T),
        "map": GlslValue("sampler2D", (Sampler((TEXTURE,), colors_of),)),
        "gl_FragCoord": from_rows("vec4", places[order]),
        "gl_FrontFacing": from_rows("bool", True),
    }
    outcome = shader.run(given, side * side)
    found = np.empty((side * side, 4), np.float32)
    for k, part in enumerate(outcome.values["c"].parts):
        found[order, k] = part
    found[order[outcome.discarded]] = DISCARDED
    return found.reshape(side, side, 4)


def draw_scene_with_opengl(renderer: OpenGLRenderer, scene: Scene) -> Singles:
    """Return the picture (H, W, 4) of a scene of one mesh with shaders, its back faces culled; 0 where nothing is."""
    context, program_of, mesh = renderer.context, scene.program, scene.meshes[0]
    assert program_of is not None
    vertex, fragment = program_of.vertex, program_of.fragment
    if program_of.dialect == "shader-material":
        vertex = with_material(vertex)
    with context, ExitStack() as stack:
        program = owned(stack, context.program(vertex_shader=vertex, fragment_shader=fragment))
        for name, value in uniform_values(scene, 0).items():
            if name in program and name in UNIFORMS:
                parts = np.array(value.parts, np.float32)
                program[name].write(np.ascontiguousarray(parts).tobytes())
        names = [name for name in ("position", "color") if name in program]
        assert mesh.colors is not None
        values = {"position": mesh.positions, "color": mesh.colors[:, :3]}
        corners = np.hstack([values[name] for name in names])[mesh.triangles.ravel()]
        buffer = owned(stack, context.buffer(corners.astype(np.float32).tobytes()))
        color = owned(stack, context.texture(scene.size, 4, dtype="f4"))
        frame = owned(stack, context.framebuffer([color]))
        stack.callback(renderer.rest)
        frame.use()
        frame.clear(0, 0, 0, 0)
        context.enable_only(context.CULL_FACE)
        context.cull_face, context.front_face = "back", "ccw"
        layout = (buffer, " ".join(["3f"] * len(names)), *names)
        owned(stack, context.vertex_array(program, [layout])).render(context.TRIANGLES)
        width, height = scene.size
        return np.frombuffer(color.read(), np.float32).reshape(height, width, 4)


def with_material(vertex: str) -> str:
    """Return a vertex shader with the declarations that three.js's ShaderMaterial puts before it."""
    declared = (
        "in vec3 position;\nin vec3 color;\nuniform mat4 modelViewMatrix;\nuniform mat4 projectionMatrix;\n"
    )
    return re.sub(r"(precision highp float;\n)", rf"\1{declared}", vertex, count=1)
