"""moderngl: the OpenGL of this machine, drawing off screen, its pixels read back."""

import sys
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.bench import records

Singles = NDArray[np.float32]

LIBRARY = "OpenGL"
DISTRIBUTION = "moderngl"

FLAT_VERTEX = """#version 330
in vec4 position;
in vec4 color;
{qualifier} out vec4 interpolated;
void main() {{ gl_Position = position; interpolated = color; }}
"""
FLAT_FRAGMENT = """#version 330
{qualifier} in vec4 interpolated;
out vec4 color;
void main() {{ color = interpolated; }}
"""
GOURAUD_VERTEX = """#version 330
uniform mat4 matrix;
uniform vec3 to_light;
uniform vec2 reflectance;  // ambient, diffuse
in vec3 position;
in vec3 normal;
in vec3 albedo;
smooth out vec4 interpolated;
void main() {
    gl_Position = matrix * vec4(position, 1);
    interpolated = vec4(albedo * (reflectance.x + reflectance.y * max(dot(normal, to_light), 0)), 1);
}
"""
TEXTURED_VERTEX = """#version 330
uniform mat4 matrix;
in vec3 position;
in vec3 normal;
in vec2 uv;
out vec3 place, facing;
out vec2 at;
void main() { gl_Position = matrix * vec4(position, 1); place = position; facing = normal; at = uv; }
"""
UNLIT_FRAGMENT = """#version 330
uniform sampler2D image;
in vec3 place, facing;
in vec2 at;
out vec4 color;
void main() { color = vec4(texture(image, at).rgb, 1); }
"""
PHONG_FRAGMENT = """#version 330
uniform sampler2D image;
uniform vec3 to_light, eye;
uniform vec4 reflectance;  // ambient, diffuse, specular, shininess
in vec3 place, facing;
in vec2 at;
out vec4 color;
void main() {
    vec3 normal = normalize(facing);
    float cosine = dot(normal, to_light);
    float light = reflectance.x + reflectance.y * max(cosine, 0);
    float highlight = max(dot(normal, normalize(to_light + normalize(eye - place))), 0);
    float mirrored = cosine > 0 ? reflectance.z * pow(highlight, reflectance.w) : 0;
    color = vec4(texture(image, at).rgb * light + mirrored, 1);
}
"""


def contender(work: records.Work) -> records.Contender | None:
    """Return OpenGL drawing ``work``, or ``None`` where it has no way to."""
    if isinstance(work, records.WindowTriangles):
        return records.Contender(LIBRARY, "graphics", lambda stack: prepare_triangles(work, stack))
    if isinstance(work, records.Lines):
        return records.Contender(
            LIBRARY, "graphics", lambda stack: prepare_lines(work, stack), "its own rule for lines"
        )
    if isinstance(work, records.ViewedMesh):
        return records.Contender(LIBRARY, "graphics", lambda stack: prepare_mesh(work, stack))
    return None


def open_context(stack: ExitStack) -> Any:
    """Return a context of its own without a window, or raise UnavailableError."""
    import glcontext
    import moderngl

    try:
        is_linux = sys.platform.startswith("linux")
        make = glcontext.get_backend_by_name("egl") if is_linux else glcontext.default_backend()
        loader = make(mode="standalone", glversion=330)
        context = moderngl.create_context(context=loader, standalone=True)
    except Exception as error:  # glcontext raises plain Exception
        raise records.UnavailableError(f"OpenGL 3.3 could not be started: {error}") from error
    stack.callback(context.release)
    return context


class Canvas:
    """A context and its framebuffer: RGBA bytes and a depth buffer of 24 bits."""

    def __init__(self, size: tuple[int, int], stack: ExitStack) -> None:
        self.context = open_context(stack)
        self.size = size
        with self.context:
            self.renderer: str = self.context.info["GL_RENDERER"]
            color, depth = self.context.renderbuffer(size, 4), self.context.depth_renderbuffer(size)
            self.frame = self.context.framebuffer([color], depth)
            self.context.enable_only(self.context.DEPTH_TEST | self.context.CULL_FACE)

    def prepared(self, array: Any, mode: int, set_uniforms: Callable[[], None]) -> records.Prepared:
        """Draw a vertex array into the cleared framebuffer and read the colours back."""
        pixels = np.empty((self.size[1], self.size[0], 4), np.uint8)

        def run() -> records.Bytes:
            with self.context:
                self.frame.use()
                self.frame.clear(0, 0, 0, 0, depth=1)
                set_uniforms()
                array.render(mode)
                self.frame.read_into(pixels, components=4)
            return pixels

        return records.Prepared(run, lambda: self.renderer)


def prepare_flat(
    canvas: Canvas, position: Singles, colors: records.Bytes, is_flat: bool, mode: int, enabled: int
) -> records.Prepared:
    """Hold vertices (V, 4) in clip space with their colours (V, 4)."""
    context = canvas.context
    qualifier = {"qualifier": "flat" if is_flat else "smooth"}
    vertices = np.zeros(len(position), [("position", np.float32, 4), ("color", np.uint8, 4)])
    vertices["position"], vertices["color"] = position, colors
    with context:
        context.enable_only(enabled)
        program = context.program(FLAT_VERTEX.format(**qualifier), FLAT_FRAGMENT.format(**qualifier))
        buffer = context.buffer(vertices.tobytes())
        array = context.vertex_array(program, [(buffer, "4f 4f1", "position", "color")])
    return canvas.prepared(array, mode, lambda: None)


def prepare_triangles(work: records.WindowTriangles, stack: ExitStack) -> records.Prepared:
    """Hold window triangles in a vertex buffer."""
    canvas = Canvas(work.size, stack)
    context = canvas.context
    position = np.ones((*work.depth.shape, 4), np.float32)
    position[..., :2] = work.corners / np.array(work.size) * 2 - 1
    position[..., 2] = 2 * work.depth - 1
    enabled = context.BLEND if work.is_blended else context.DEPTH_TEST | context.CULL_FACE
    colors = work.colors.reshape(-1, 4)
    return prepare_flat(canvas, position.reshape(-1, 4), colors, work.is_flat, context.TRIANGLES, enabled)


def prepare_lines(work: records.Lines, stack: ExitStack) -> records.Prepared:
    """Hold lines from pixel centre to pixel centre in a vertex buffer; OpenGL leaves the last pixel out."""
    canvas = Canvas(work.size, stack)
    position = np.zeros((2 * len(work.ends), 4), np.float32)
    position[:, :2] = (work.ends.reshape(-1, 2) + 0.5) / np.array(work.size) * 2 - 1
    position[:, 3] = 1
    colors = np.full((len(position), 4), 255, np.uint8)
    colors[:, :3] = np.repeat(work.colors, 2, axis=0)
    return prepare_flat(canvas, position, colors, True, canvas.context.LINES, 0)


def prepare_mesh(work: records.ViewedMesh, stack: ExitStack) -> records.Prepared:
    """Hold the mesh in buffers on the OpenGL side; matrices and light are set anew for every picture."""
    canvas = Canvas(work.size, stack)
    context = canvas.context
    attributes = {"position": work.positions, "normal": work.normals}
    if work.texture is None:
        attributes["albedo"] = np.ones_like(work.positions) if work.colors is None else work.colors
        shaders = GOURAUD_VERTEX, FLAT_FRAGMENT.format(qualifier="smooth")
    else:
        assert work.uvs is not None
        attributes["uv"] = work.uvs
        shaders = TEXTURED_VERTEX, UNLIT_FRAGMENT if work.lighting is None else PHONG_FRAGMENT
    with context:
        program = context.program(*shaders)
        used = {name: values for name, values in attributes.items() if name in program}
        vertices = np.concatenate(list(used.values()), axis=1).astype(np.float32)
        layout = " ".join(f"{values.shape[1]}f" for values in used.values())
        array = context.vertex_array(
            program,
            [(context.buffer(vertices.tobytes()), layout, *used)],
            context.buffer(work.triangles.astype(np.int32).tobytes()),
        )
        if work.texture is not None:
            rows, columns = work.texture.shape[:2]
            texture = context.texture((columns, rows), 3, work.texture.tobytes())
            texture.filter = (context.LINEAR, context.LINEAR)
            texture.use(0)
    return canvas.prepared(array, context.TRIANGLES, lambda: set_view(program, work))


def set_view(program: Any, work: records.ViewedMesh) -> None:
    """Set the uniforms that the program has."""
    program["matrix"].write((work.projection @ work.view).T.astype(np.float32).tobytes())
    light = work.lighting
    if light is None:
        return
    program["to_light"].value = tuple(-light.direction)
    if "eye" in program:
        program["eye"].value = tuple(work.eye)
        program["reflectance"].value = (light.ambient, light.diffuse, light.specular, light.shininess)
    else:
        program["reflectance"].value = (light.ambient, light.diffuse)
