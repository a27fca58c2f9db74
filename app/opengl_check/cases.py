"""One case of the comparison with OpenGL: what it is made of, and the OpenGL of this machine drawing it.

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
from numpy.typing import ArrayLike, NDArray

from core.coverage.snapping import SUBPIXELS
from core.records.arrays import Floats, Integers, Singles
from core.scene import Texture
from core.settings import Settings

# Random corners, meshes, matrices and values that the cases of `app.opengl_check.families` are made of.


def grid_corners(rng: np.random.Generator, size: tuple[int, int], count: int) -> Floats:
    """Return random window positions (count, 2) in pixels, put on one of the grids of `put_on_grid`."""
    points = rng.uniform(0, 1, (count, 2)) * size
    return put_on_grid(rng, points)


def put_on_grid(rng: np.random.Generator, points: Floats) -> Floats:
    """Move window positions (N, 2) to pixel centres, corners, half pixels, 1/256 pixel, or 0.3/256 beside."""
    kind = rng.integers(5)
    if kind == 0:
        return np.floor(points) + 0.5
    if kind == 1:
        return np.rint(points)
    if kind == 2:
        return np.rint(points * 2) / 2
    snapped = np.rint(points * SUBPIXELS)
    return (snapped if kind == 3 else snapped + rng.uniform(-0.3, 0.3, points.shape)) / SUBPIXELS


def gradual_values(rng: np.random.Generator, shape: tuple[int, ...]) -> Singles:
    """Return values from 0 to 1 in steps of 1/256 (float32): short numbers, which keep files small."""
    return (rng.integers(0, 257, shape) / 256).astype(np.float32)


def fan(rng: np.random.Generator, size: tuple[int, int]) -> tuple[Floats, Integers]:
    """Return a fan around a hub: window positions (N, 2) and triangles (N - 1, 3)."""
    count = int(rng.integers(5, 13))
    angles = (np.arange(count) + rng.uniform(0.1, 0.9, count)) * 2 * np.pi / count
    radius = rng.uniform(0.5, 0.95, count) * min(size) / 2
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1) * radius[:, None]
    points = put_on_grid(rng, np.concatenate([np.zeros((1, 2)), ring]) + np.array(size) / 2)
    rim = np.arange(count)
    return points, np.stack([np.zeros(count, int), rim + 1, (rim + 1) % count + 1], axis=1)


def grid_mesh(rng: np.random.Generator, size: tuple[int, int]) -> tuple[Floats, Integers]:
    """Return a grid, jittered or not, each cell cut along a diagonal: positions (N, 2), triangles (T, 3)."""
    columns, rows = (int(n) for n in rng.integers(2, 7, 2))
    x, y = np.meshgrid(np.linspace(0.06, 0.94, columns + 1), np.linspace(0.06, 0.94, rows + 1))
    points = np.stack([x.ravel(), y.ravel()], axis=1) * size
    if rng.random() < 0.7:
        points += rng.uniform(-0.25, 0.25, points.shape) * np.array(size) / (columns, rows)
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    a, b, c, d = corner, corner + 1, corner + columns + 2, corner + columns + 1
    falls = (rng.random(len(corner)) < 0.5)[:, None]
    first = np.where(falls, np.stack([a, b, c], 1), np.stack([a, b, d], 1))
    second = np.where(falls, np.stack([a, c, d], 1), np.stack([b, c, d], 1))
    return put_on_grid(rng, points), np.concatenate([first, second])


def turned(rng: np.random.Generator, triangles: Integers) -> Integers:
    """Return triangles (T, 3) in another order, with other first corners and windings."""
    triangles = triangles[rng.permutation(len(triangles))]
    first = rng.integers(0, 3, (len(triangles), 1))
    step = np.where(rng.random((len(triangles), 1)) < 0.5, 1, -1)
    corner = (first + step * np.arange(3)) % 3
    return np.take_along_axis(triangles, corner.astype(np.int64), axis=1)


def perspective_matrix(field_of_view: float, aspect: float, near: float, far: float) -> Floats:
    """Return the (4, 4) matrix from camera space, looking along -z, to clip space; the angle in radians."""
    scale = 1 / np.tan(field_of_view / 2)
    depth, offset = (far + near) / (near - far), 2 * far * near / (near - far)
    return np.array([[scale / aspect, 0, 0, 0], [0, scale, 0, 0], [0, 0, depth, offset], [0, 0, -1, 0]])


def random_rotation(rng: np.random.Generator) -> Floats:
    """Return a (4, 4) rotation about a random axis."""
    a, b, c, d = rng.normal(size=4)
    x, y, z, s = np.array([a, b, c, d]) / np.sqrt(a * a + b * b + c * c + d * d)
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - s * z), 2 * (x * z + s * y)],
        [2 * (x * y + s * z), 1 - 2 * (x * x + z * z), 2 * (y * z - s * x)],
        [2 * (x * z - s * y), 2 * (y * z + s * x), 1 - 2 * (x * x + y * y)],
    ]
    return matrix


def icosphere(subdivisions: int) -> tuple[Floats, Floats, Integers]:
    """Return a sphere of radius 1: points (N, 3), normals (N, 3), triangles (20 * 4 ** subdivisions, 3)."""
    golden = (1 + np.sqrt(5)) / 2
    points = [(x, y, 0.0) for x in (-1.0, 1.0) for y in (-golden, golden)]
    points = [tuple(np.roll(point, turn)) for turn in range(3) for point in points]
    vertices = np.array(points) / np.sqrt(1 + golden * golden)
    distance = np.sqrt(((vertices[:, None] - vertices[None]) ** 2).sum(axis=2))
    is_near = (distance > 0) & (distance < 1.1)
    triangles = np.array(
        [
            (i, j, k)
            for i in range(12)
            for j in range(i + 1, 12)
            for k in range(j + 1, 12)
            if is_near[i, j] and is_near[j, k] and is_near[i, k]
        ]
    )
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    is_inward = (np.cross(b - a, c - a) * (a + b + c)).sum(axis=1) < 0
    triangles[is_inward] = triangles[is_inward][:, ::-1]
    for _ in range(subdivisions):
        corners = vertices[triangles]
        middle = corners + corners[:, [1, 2, 0]]
        middle /= np.sqrt((middle**2).sum(axis=2, keepdims=True))
        a, b, c = (corners[:, k] for k in range(3))
        ab, bc, ca = (middle[:, k] for k in range(3))
        pieces = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        flat = np.concatenate([np.stack(piece, axis=1) for piece in pieces]).reshape(-1, 3)
        _, first, index = np.unique(np.round(flat, 9), axis=0, return_index=True, return_inverse=True)
        vertices, triangles = flat[first], index.reshape(-1, 3)
    return vertices, vertices, triangles


def torus(around: int, across: int) -> tuple[Floats, Floats, Integers]:
    """Return a torus of radii 0.8 and 0.35: points, normals (N, 3), 2 * around * across triangles (T, 3)."""
    i, j = (index.ravel() for index in np.meshgrid(np.arange(around), np.arange(across), indexing="ij"))
    u, v = i * 2 * np.pi / around, j * 2 * np.pi / across
    normals = np.stack([np.cos(u) * np.cos(v), np.sin(u) * np.cos(v), np.sin(v)], axis=1)
    points = 0.8 * np.stack([np.cos(u), np.sin(u), np.zeros_like(u)], axis=1) + 0.35 * normals
    ni, nj = (i + 1) % around, (j + 1) % across
    a, b, c, d = i * across + j, ni * across + j, ni * across + nj, i * across + nj
    return points, normals, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


# One case of the comparison with OpenGL: triangles or lines in clip space, and how to draw them.


STEP = 1 / SUBPIXELS
"""Pixels between two places of the grid that coverage is decided on."""


@dataclass(frozen=True, eq=False)
class Case:
    """Triangles or lines in clip space, and how to draw them; nothing else takes part in the picture."""

    family: str
    clip: Singles
    """(T, 3, 4) or, for lines, (L, 2, 4) float32 clip x, y, z, w."""
    attributes: Singles
    """(T, 3, K) or (L, 2, K) float32; the colour, or the first two texture coordinates."""
    size: tuple[int, int]
    """(width, height) in pixels."""
    texture: Texture | None = None
    cull: str = "none"
    depth_test: bool = False
    """Nearer wins and a tie keeps what is there; else what is drawn last wins, and its depth is stored."""
    interpolation: str = "perspective"
    provoking: str = "last"
    texture_filter: str = "nearest"
    wrap: str = "clamp"
    guard: int = 1
    """How many times farther out the clip planes of x and y are: nothing within is clipped. A power of two;
    if it is above 1, width and height must be even."""

    def __post_init__(self) -> None:
        if self.guard > 1 and (self.size[0] % 2 or self.size[1] % 2):
            raise ValueError(f"size must be even for a guard of {self.guard}, got {self.size}")

    @property
    def is_lines(self) -> bool:
        """Whether the primitives are line segments."""
        return bool(self.clip.shape[1] == 2)

    def settings(self, fill: str = "hierarchy") -> Settings:
        """Return how the core draws the triangles of this case, with one of the fills."""
        return Settings(
            cull=self.cull,
            fill=fill,
            interpolation=self.interpolation,
            provoking=self.provoking,
            texture_filter=self.texture_filter,
            wrap=self.wrap,
            shading="unlit",
            visibility="z-buffer" if self.depth_test else "last-drawn",
        )


def clip_positions(window: Floats, depth: ArrayLike, w: ArrayLike, size: tuple[int, int]) -> Singles:
    """Put corners at places in the window.

    Parameters
    ----------
    window : (..., 2) float64
        Pixels.
    depth, w : (...) array_like
        Window depth from 0 to 1, and clip w.
    size : (width, height)

    Returns
    -------
    (..., 4) float32, clip space
    """
    weight = np.broadcast_to(np.asarray(w, float), window.shape[:-1])[..., None]
    ndc = window * 2 / np.array(size) - 1
    z = np.broadcast_to(np.asarray(depth, float), window.shape[:-1])[..., None] * 2 - 1
    return np.concatenate([ndc * weight, z * weight, weight], axis=-1).astype(np.float32)


def settle(clip: Singles, size: tuple[int, int]) -> Singles:
    """Move clip positions (..., 4) float32, all w > 0, to where float32 rounding cannot turn the snap.

    That is by less than 1/1024 pixel, to at most 0.3 steps from the middle of a step of the grid.
    """
    w = clip[..., 3].astype(float)
    steps = (clip[..., :2] / w[..., None] + 1) * np.array(size) / 2 / STEP
    whole = np.rint(steps)
    window = (whole + np.clip(steps - whole, -0.3, 0.3)) * STEP
    return clip_positions(window, (clip[..., 2] / w + 1) / 2, w, size)


# Drawing cases with the OpenGL of this machine, off screen, through moderngl.


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
