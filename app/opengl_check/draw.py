"""Drawing cases with the OpenGL of this machine, off screen, through moderngl.

The picture goes to float32 colour, float32 depth and 32-bit primitive numbers: no blending, no dithering,
one sample a pixel. moderngl makes 24-bit depth textures; their storage is given anew as float32, with
OpenGL's own call.
"""

import ctypes
import sys
from contextlib import ExitStack
from dataclasses import dataclass
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.opengl_check.case import Case
from core.records.arrays import Singles

SHADER_VERSION = 330
TEXTURE_2D, DEPTH_COMPONENT, DEPTH_COMPONENT_32F, FLOAT = 0x0DE1, 0x1902, 0x8CAC, 0x1406
QUALIFIERS = {"perspective": "smooth", "affine": "noperspective", "flat": "flat"}

VERTEX = np.dtype([("position", np.float32, 4), ("value", np.float32, 4), ("number", np.int32)])

VERTEX_SHADER = """#version 330
in vec4 position;
in vec4 value;
in int number;
{qualifier} out vec4 interpolated;
flat out int owner;
void main() {{ gl_Position = position; interpolated = value; owner = number; }}
"""
FRAGMENT_SHADER = """#version 330
{qualifier} in vec4 interpolated;
flat in int owner;
uniform sampler2D image;
layout(location = 0) out vec4 color;
layout(location = 1) out int primitive;
void main() {{ color = {color}; primitive = owner; }}
"""


class OpenGLMissingError(RuntimeError):
    """moderngl is not installed, or this machine gives no OpenGL 3.3; the message is one sentence."""


@dataclass(frozen=True, eq=False)
class Picture:
    """What was drawn; row 0 is the bottom row."""

    color: Singles
    """(H, W, 4) float32; 0 where nothing was drawn."""
    depth: Singles
    """(H, W) float32; 1 where nothing was drawn."""
    primitive: NDArray[np.int32]
    """(H, W) int32 triangle or segment seen, -1 for none."""


class OpenGLRenderer:
    """An OpenGL context without a window; use it in a ``with`` statement, which releases everything.

    Raises OpenGLMissingError on entering, if there is no moderngl or no OpenGL.
    """

    def __init__(self) -> None:
        self.name = ""
        """What OpenGL calls itself, once the context is open."""
        self._stack = ExitStack()
        self._programs: dict[tuple[str, bool], Any] = {}

    def __enter__(self) -> "OpenGLRenderer":
        try:
            import glcontext
            import moderngl
        except ImportError as error:
            raise OpenGLMissingError(
                f"the comparison with OpenGL needs moderngl (pip install moderngl): {error}"
            ) from error
        try:
            make = (
                glcontext.get_backend_by_name("egl")
                if sys.platform.startswith("linux")
                else glcontext.default_backend()
            )
            self._loader = make(mode="standalone", glversion=SHADER_VERSION)
            self.context = moderngl.create_context(context=self._loader, standalone=True)
        except Exception as error:  # glcontext raises plain Exception
            sentence = str(error).strip().splitlines()
            raise OpenGLMissingError(
                f"OpenGL 3.3 could not be started: {sentence[0] if sentence else type(error).__name__}"
            ) from error
        self._stack.callback(self.context.release)
        self._resting = owned(self._stack, self.context.simple_framebuffer((1, 1)))
        self.name = f"{self.context.info['GL_RENDERER']}, OpenGL {self.context.info['GL_VERSION']}"
        convention = getattr(ctypes, "WINFUNCTYPE", ctypes.CFUNCTYPE)
        integers = [ctypes.c_int] * 5
        self._bind_texture = convention(None, ctypes.c_uint, ctypes.c_uint)(
            self._loader.load("glBindTexture")
        )
        self._define_texture = convention(
            None, ctypes.c_uint, *integers, ctypes.c_uint, ctypes.c_uint, ctypes.c_void_p
        )(self._loader.load("glTexImage2D"))
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._stack.close()
        self._programs.clear()

    def rest(self) -> None:
        """Go back to a framebuffer that stays: moderngl returns to the one in use when it makes another."""
        self._resting.use()

    def draw(self, case: Case) -> Picture:
        """Draw the triangles or lines of ``case``."""
        context = self.context
        width, height = case.size
        with context, ExitStack() as stack:
            # Buffers, cleared.
            color = owned(stack, context.texture(case.size, 4, dtype="f4"))
            primitive = owned(stack, context.texture(case.size, 1, dtype="i4"))
            depth = owned(stack, self._depth_texture(case.size))
            frame = owned(stack, context.framebuffer([color, primitive], depth))
            stack.callback(self.rest)
            frame.use()
            frame.clear(0, 0, 0, 0, depth=1)
            primitive.write(np.full((height, width), -1, np.int32))

            # State. The planes of x and y move out with the viewport; the picture stays where it is.
            guard = case.guard
            frame.viewport = (
                -(guard - 1) * width // 2,
                -(guard - 1) * height // 2,
                guard * width,
                guard * height,
            )
            context.enable_only(context.DEPTH_TEST | (context.CULL_FACE if case.cull != "none" else 0))
            context.depth_func = "<" if case.depth_test else "1"
            context.cull_face = case.cull if case.cull != "none" else "back"
            context.front_face = "ccw"
            context.provoking_vertex = (
                context.FIRST_VERTEX_CONVENTION
                if case.provoking == "first"
                else context.LAST_VERTEX_CONVENTION
            )
            if case.texture is not None:
                self._use_image(stack, case)

            # Vertices: position, value (missing components of a colour are 0, 0, 0, 1), whose corner it is
            # (instead of gl_PrimitiveID, which softpipe for one does not have in fragment shaders).
            vertices = np.zeros(case.clip.shape[:2], VERTEX)
            vertices["position"] = case.clip
            vertices["position"][..., :2] /= np.float32(guard)
            vertices["value"][..., 3] = 1
            vertices["value"][..., : case.attributes.shape[2]] = case.attributes
            vertices["number"] = np.arange(len(case.clip))[:, None]
            program = self._program(case.interpolation, case.texture is not None)
            buffer = owned(stack, context.buffer(vertices.tobytes()))
            layout = (buffer, "4f 4f 1i", "position", "value", "number")
            array = owned(stack, context.vertex_array(program, [layout]))
            array.render(context.LINES if case.is_lines else context.TRIANGLES)

            problem = context.error
            if problem != "GL_NO_ERROR":
                raise RuntimeError(f"OpenGL reports {problem} for a case of the family {case.family}")
            return Picture(
                np.frombuffer(color.read(), np.float32).reshape(height, width, 4),
                np.frombuffer(depth.read(), np.float32).reshape(height, width),
                np.frombuffer(primitive.read(), np.int32).reshape(height, width),
            )

    def _depth_texture(self, size: tuple[int, int]) -> Any:
        texture = self.context.depth_texture(size)
        self._bind_texture(TEXTURE_2D, texture.glo)
        self._define_texture(TEXTURE_2D, 0, DEPTH_COMPONENT_32F, *size, 0, DEPTH_COMPONENT, FLOAT, None)
        return texture

    def _use_image(self, stack: ExitStack, case: Case) -> None:
        assert case.texture is not None
        texels = case.texture.pixels
        rows, columns, channels = texels.shape
        image = np.ones((rows, columns, 4), np.float32)
        image[..., :3] = texels[..., :3]
        if channels == 4:
            image[..., 3] = texels[..., 3]
        texture = owned(stack, self.context.texture((columns, rows), 4, image.tobytes(), dtype="f4"))
        gl_filter = {"nearest": self.context.NEAREST, "bilinear": self.context.LINEAR}[case.texture_filter]
        texture.filter = (gl_filter, gl_filter)
        texture.repeat_x = texture.repeat_y = {"repeat": True, "clamp": False}[case.wrap]
        texture.use(0)

    def _program(self, interpolation: str, is_textured: bool) -> Any:
        key = (interpolation, is_textured)
        if key not in self._programs:
            texts = {
                "qualifier": QUALIFIERS[interpolation],
                "color": "texture(image, interpolated.xy)" if is_textured else "interpolated",
            }
            self._programs[key] = self.context.program(
                VERTEX_SHADER.format(**texts), FRAGMENT_SHADER.format(**texts)
            )
            self._stack.callback(self._programs[key].release)
        return self._programs[key]


def owned(stack: ExitStack, thing: Any) -> Any:
    """Release ``thing`` when the stack is left."""
    stack.callback(thing.release)
    return thing
