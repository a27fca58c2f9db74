"""Small shaders for the comparison with OpenGL, drawn by both on every pixel of a square, lane by lane.

Each gets ``a`` in (-4, 4) and ``b`` in (0.1, 4) at every pixel and gives ``c``. What OpenGL computes by another
approximation has a bound; everything else must have the same bits.
"""

import re
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from app.opengl_check.cases import OpenGLRenderer, owned
from core.records.arrays import Singles
from core.scene import Scene, Texture
from core.settings import Settings
from core.shaders.glsl_types import GlslValue, from_rows
from core.shaders.rules import Sampler
from core.shaders.shader import UNIFORMS, Shader
from core.shaders.stages import texture_colors_of, uniform_values

# Small shaders for the comparison with OpenGL: every operator, type and function, control flow, quads and
# textures.


PRELUDE = """#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
"""
"""Without highp, int is mediump in a fragment shader and sampler2D lowp; Mesa computes with as few bits then."""
TEXTURE = Texture(
    (np.random.default_rng(46).integers(0, 257, (4, 8, 4)) / np.float32(256)).astype(np.float32), "texels"
)


@dataclass(frozen=True)
class ShaderCase:
    """One fragment shader, and how far it may be off."""

    name: str
    body: str
    """Statements of main."""
    functions: str = ""
    """What stands before main."""
    absolute: float = 0.0
    relative: float = 0.0
    texture_filter: str = "nearest"
    wrap: str = "repeat"

    @property
    def source(self) -> str:
        """The shader as the core runs it."""
        declared = "in vec4 a;\nin vec4 b;\nuniform float t;\nuniform sampler2D map;\nout vec4 c;\n"
        return f"{PRELUDE}{declared}{self.functions}\nvoid main() {{\n{self.body}\n}}\n"


EXACT = """
a + b | a - b | a * b | a / b | a * b + a | -a | +a | a + 1.5 | 2.0 * a | a / 2.0 | 1.0 / b
vec4(a.x + b.y) | sqrt(b) | inversesqrt(b) | abs(a) | sign(a) | floor(a) | ceil(a) | fract(a) | trunc(a)
round(a * 3.0) | mod(a, b) | mod(a, 1.5) | min(a, b) | max(a, b) | min(a, 0.5) | max(a, 0.5)
clamp(a, -1.0, 1.0) | clamp(a, -b, b) | mix(a, b, 0.3) | step(a, b) | step(0.5, a) | radians(a)
degrees(a) | vec4(dot(a, b)) | vec4(dot(a.xyz, b.xyz)) | vec4(dot(a.xy, b.xy)) | vec4(length(a))
vec4(length(a.xyz)) | vec4(length(a.xy)) | vec4(distance(a, b)) | normalize(a)
vec4(normalize(a.xyz), 1.0) | vec4(cross(a.xyz, b.xyz), 0.0) | reflect(a, normalize(b))
faceforward(a, b, a) | a.wzyx | a.rrgg | a.stpq.abgr | vec4(a.xy, b.zw) | vec4(a.x, b.yzw)
vec4(vec3(a), 1.0) | vec4(a[1], b[2], a[0], b[3]) | vec4(mat2(a) * b.xy, 0.0, 1.0)
vec4(b.xy * mat2(a), 0.0, 1.0) | mat4(a, b, sqrt(b), fract(a)) * floor(b)
floor(b) * mat4(a, b, sqrt(b), fract(a)) | vec4(mat3(mat4(a, b, sqrt(b), fract(a))) * floor(b.xyz), 1.0)
mat4(2.0) * a | vec4(mat2(a) * mat2(b))
(mat4(a, b, sqrt(b), fract(a)) * mat4(floor(b), ceil(a), inversesqrt(b), round(b * 9.0)))[2]
(mat4(a, b, b, a) + mat4(1.0))[3] | vec4(mat2(a) * 2.0) | transpose(mat4(a, b, a * b, a + b))[1]
matrixCompMult(mat4(a, b, a, b), mat4(b, b, a, a))[2] | vec4(determinant(mat2(a)))
vec4(determinant(mat3(a.xyz, b.xyz, a.yzw)))
vec4(inverse(mat3(a.xyz, b.xyz, a.yzw) + mat3(9.0))[1], 1.0) | a.x > 0.0 ? a : b
vec4(a.x > b.x ? 1.0 : 0.0, a.y < b.y ? 1.0 : 0.0, a.z >= 0.0 ? 1.0 : 0.0, a.w <= 0.0 ? 1.0 : 0.0)
vec4(a == b ? 1.0 : 0.0, a != b ? 1.0 : 0.0, a.x == a.x ? 1.0 : 0.0, 0.0)
vec4(a.x > 0.0 && a.y > 0.0, a.x > 0.0 || a.y > 0.0, a.x > 0.0 ^^ a.y > 0.0, !(a.x > 0.0))
vec4(lessThan(a, b)) | vec4(lessThanEqual(a, b)) | vec4(greaterThan(a, b)) | vec4(greaterThanEqual(a, b))
vec4(equal(floor(a), floor(b))) | vec4(notEqual(floor(a), floor(b))) | vec4(not(lessThan(a, b)))
vec4(any(lessThan(a, b)) ? 1.0 : 0.0, all(lessThan(a, b)) ? 1.0 : 0.0, 0.0, 1.0) | vec4(int(a.x))
vec4(ivec4(a * 10.0)) | vec4(ivec4(a * 10.0) + ivec4(b * 5.0)) | vec4(ivec4(a * 10.0) * 3)
vec4(-ivec4(a * 9.0)) | vec4(ivec4(b * 90.0) / 7) | vec4(ivec4(b * 90.0) % 7)
vec4(ivec4(b * 90.0) / ivec4(b * 5.0 + 1.0)) | vec4(abs(ivec4(a * 9.0))) | vec4(ivec4(a * 90.0) / 7)
vec4(min(ivec4(a * 9.0), ivec4(b * 9.0))) | vec4(clamp(ivec4(a * 9.0), -8, 8)) | vec4(sign(ivec4(a)))
vec4(bvec4(ivec4(a))) | vec4(bvec4(a)) | vec4(float(true), float(3), float(a.x > 0.0), 1.0)
vec4(int(a.x > 0.0), 1, 2, 3) | vec4(gl_FragCoord.xy, 0.0, 1.0) | vec4(gl_FrontFacing ? 1.0 : 0.0)
vec4(t) | a * t | vec4(1e3, .5, 2., 1.25e-2) | vec4(0.1 + 0.2)
"""
"""Expressions that have the same bits in OpenGL."""
BOUNDED = {
    "sin(a)": (1.5e-07, 0),
    "cos(a)": (1.5e-07, 0),
    "tan(b * 0.3)": (0, 1e-06),
    "asin(a * 0.25)": (0.0006, 0),
    "acos(a * 0.25)": (0.0006, 0),
    "atan(a)": (5e-06, 0),
    "atan(a, b)": (5e-06, 0),
    "atan(b, a)": (5e-06, 0),
    "exp(a)": (0, 6e-07),
    "exp2(a)": (0, 5e-07),
    "log(b)": (4e-07, 8e-06),
    "log2(b)": (4e-07, 8e-06),
    "pow(b, a)": (0, 2e-06),
    "pow(b, vec4(32.0))": (0, 1e-05),
    "smoothstep(0.0, 2.0, a)": (2.4e-07, 0),
    "smoothstep(vec4(-1.0), b, a)": (2.4e-07, 1e-05),
    "mix(a, b, b * 0.25)": (1e-06, 0),
    "refract(a * 0.2, normalize(b), 0.7)": (1e-06, 1e-06),
    "inverse(mat4(a, b, sqrt(b), fract(a)) + mat4(9.0))[1]": (1e-06, 1e-05),
    "vec4(inverse(mat2(a) + mat2(9.0)))": (1e-06, 1e-06),
    "vec4(determinant(mat4(a, b, sqrt(b), fract(a)) + mat4(9.0)))": (0.001, 1e-06),
}
"""Expressions that OpenGL computes by approximations of its own: bounds, absolute and relative."""
STATEMENTS = {
    "if": "c = b; if (a.x > 0.0) c = a;",
    "if-else": "if (a.x > a.y) { c = a; } else { c = b; }",
    "else-if": (
        "if (a.x > 2.0) c = a; else if (a.x > 0.0) c = b; else if (a.x > -2.0) c = a + b; else c = vec4(1.0);"
    ),
    "nested-if": ("c = a; if (a.x > 0.0) { if (a.y > 0.0) { c = b; } else { c.x = 7.0; } c.w = 2.0; }"),
    "for": "c = a; for (int i = 0; i < 5; i++) c = max(c * 0.5, b - float(i));",
    "for-float": "c = vec4(0.0); for (float x = 0.0; x < b.x; x += 0.5) c += a * x;",
    "for-down": "c = vec4(0.0); for (int i = 4; i > 0; i--) { c = c * 0.5 + b; }",
    "nested-for": (
        "c = a; for (int i = 0; i < 3; i++) for (int j = 0; j < i; j++) c += b * float(i * 10 + j);"
    ),
    "while": "c = b; while (c.x < 9.0) c *= 2.0;",
    "break": (
        "float s = 0.0; for (int i = 0; i < 8; i++) { if (float(i) >= b.x) break; "
        "s += 1.0 / (float(i) + 1.0); } c = vec4(s);"
    ),
    "continue": (
        "c = vec4(0.0); for (int i = 0; i < 8; i++) { if (a.x * float(i - 4) > 0.0) continue; c += b; }"
    ),
    "break-continue": (
        "c = a; for (int i = 0; i < 9; i++) { c.x += b.x; if (c.x < 0.0) continue; "
        "c.y += 1.0; if (c.y > b.y) break; c.z -= 1.0; }"
    ),
    "discard": "c = a; if (a.x > 0.0) discard; c = b;",
    "discard-in-loop": "c = a; for (int i = 0; i < 6; i++) { c += b; if (c.x > 9.0) discard; }",
    "scopes": (
        "float x = a.x; { float x = b.x; c = vec4(x); } c.y = x; for (float x = 0.0; "
        "x < 2.0; x += 1.0) c.z = x;"
    ),
    "swizzle-left": "c = vec4(0.0); c.zx = a.xy; c.w = b.x; c.rg *= 2.0;",
    "index-left": "c = a; c[2] = b.x; c[0] += 1.0;",
    "matrix-left": ("mat4 m = mat4(1.0); m[1] = a; m[2][3] = b.x; m[0].y = sqrt(b.y); c = m * floor(b);"),
    "increments": "int i = int(b.x); i++; i++; i--; float x = a.x; x++; c = vec4(i, x, x, 1.0);",
    "compound": (
        "c = a; c += b; c -= 0.5; c *= b; c /= b.wzyx; int k = 17; k %= 5; k *= 3; k /= 2; c.x += float(k);"
    ),
    "logic-order": (
        "bool p = a.x > 0.0 && 1.0 / a.x > 0.5; bool q = a.y > 0.0 || a.y < -2.0; c = vec4(p, q, p ^^ q, !p);"
    ),
    "logic-levels": "bool p = a.x > 0.0 || a.y > 0.0 && a.z > 0.0 ^^ a.w > 0.0; c = vec4(p);",
    "operator-order": "c = a + b * a - b / a * 2.0 - -a; c.x = a.x - b.x - a.y; c.y = a.x / b.x / b.y;",
    "globals": "total += 1.0; add(a.x); add(b.x); c = vec4(total);",
    "function": "c = vec4(twice(a.x), twice(b.x) + twice(twice(a.y)), 0.0, 1.0);",
    "returns": "c = vec4(rounds(b.x), rounds(b.y), rounds(a.x), pick(a));",
    "const": ("const float half_ = 0.5; const vec2 p = vec2(1.0, 2.0) * half_; c = vec4(p, PI, half_);"),
    "int-overflow": "int k = 2147483647; k = k + int(b.x); c = vec4(k);",
    "mandelbrot": "float k = escape(a.xy * 0.6); if (k > 39.5) discard; c = vec4(k / 40.0);",
    "dFdx": "c = dFdx(a);",
    "dFdy": "c = dFdy(a);",
    "fwidth": "c = fwidth(a * b);",
    "dFdx-of-sum": "vec2 p = gl_FragCoord.xy * gl_FragCoord.yx; c = vec4(dFdx(p), dFdy(p));",
    "dFdx-after-discard": "if (a.x > 2.0) discard; c = dFdx(b);",
    "checker": "vec2 k = floor(gl_FragCoord.xy / 3.0); c = mod(k.x + k.y, 2.0) < 0.5 ? a : b;",
    "fetch": "c = texelFetch(map, ivec2(b.xy), 0);",
    "size": "c = vec4(textureSize(map, 0), 0, 1);",
}
"""Statements that have the same bits, but for those in `REORDERED`."""
REORDERED = {"matrix-left": 4e-6, "compound": 2e-5}
"""Sums and products that OpenGL may reorder: bounds."""
FUNCTIONS = {
    "globals": "float total = 0.5; void add(float x) { if (x < 0.0) return; total += x; }",
    "function": "float twice(float x) { return x + x; }",
    "returns": (
        "float rounds(float x) { for (int i = 0; i < 9; i++) { x = x * b.w + 1.0; "
        "if (x > 9.0) return x; } return -x; }\nfloat pick(vec4 v) { if (v.x > 0.0) { "
        "if (v.y > 0.0) return 1.0; return 2.0; } return v.z; }"
    ),
    "const": "const float PI = 3.14159265;",
    "mandelbrot": (
        "float escape(vec2 p) { vec2 z = vec2(0.0); for (int i = 0; i < 40; i++) { "
        "z = vec2(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + p; "
        "if (dot(z, z) > 4.0) return float(i); } return 40.0; }"
    ),
}
PHONG = """vec3 N = normalize(a.xyz); vec3 L = normalize(b.xyz); vec3 V = vec3(0.0, 0.0, 1.0);
float cosine = dot(N, L); vec3 color = b.xyz * 0.12;
if (cosine > 0.0) {
   vec3 H = normalize(L + V);
   color += b.xyz * 0.88 * cosine; color += 0.25 * pow(max(dot(N, H), 0.0), 32.0);
}
c = vec4(color, 1.0);"""


def _textures() -> list[ShaderCase]:
    found = []
    for wrap in ("repeat", "clamp"):
        # A texel's border may lie on either side: the places keep clear of it.
        inside = "(floor(a.xy * 7.0) + 0.5 + 0.8 * (fract(b.xy) - 0.5)) / vec2(8.0, 4.0)"
        found.append(ShaderCase(f"nearest-{wrap}", f"c = texture(map, {inside});", wrap=wrap))
        body = "c = texture(map, a.xy * 0.7);"
        # OpenGL weighs texels with 8 bits at least.
        found.append(
            ShaderCase(f"bilinear-{wrap}", body, absolute=4e-3, texture_filter="bilinear", wrap=wrap)
        )
    smooth = "c = texture(map, gl_FragCoord.xy * {});"
    for name, step in (("near", "0.05"), ("far", "0.3")):
        body = smooth.format(step)
        found.append(ShaderCase(f"trilinear-{name}", body, absolute=1.6e-2, texture_filter="trilinear"))
    body = "c = vec4(0.0); if (a.x > 0.0) c = texelFetch(map, ivec2(1, 2), 0) * b;"
    return [*found, ShaderCase("fetch-in-branch", body)]


def _expressions(text: str) -> list[str]:
    return [part.strip() for line in text.strip().splitlines() for part in line.split(" | ")]


CASES = (
    *(ShaderCase(text, f"c = {text};") for text in _expressions(EXACT)),
    *(
        ShaderCase(text, f"c = {text};", absolute=absolute, relative=relative)
        for text, (absolute, relative) in BOUNDED.items()
    ),
    *(
        ShaderCase(name, body, FUNCTIONS.get(name, ""), REORDERED.get(name, 0.0))
        for name, body in STATEMENTS.items()
    ),
    ShaderCase("phong", PHONG, absolute=2e-6),
    *_textures(),
)
"""All of them, by names of their own."""


def shader_inputs(side: int, seed: int) -> tuple[Singles, Singles]:
    """Return ``a`` and ``b``, (side, side, 4) each, row 0 at the bottom."""
    rng = np.random.default_rng(seed)
    return (
        rng.uniform(-4, 4, (side, side, 4)).astype(np.float32),
        rng.uniform(0.1, 4, (side, side, 4)).astype(np.float32),
    )


# A fragment shader on every pixel of a square, by OpenGL and by the core.


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


# The family ``shaders`` of the comparison with OpenGL: small shaders, lane by lane.


SHADERS = "shaders"
"""Name of the family."""
SIDE = 32
"""Pixels each way of a case: the lanes of a shader."""


@dataclass(frozen=True, eq=False)
class ShaderResult:
    """How a shader's numbers compare."""

    equal: int
    """Numbers with the same bits."""
    count: int
    error: float
    """The largest difference."""
    excess: int
    """Numbers that differ by more than the case allows."""

    @property
    def agrees(self) -> bool:
        """Whether nothing differs by more."""
        return self.excess == 0


def compare_shader(case: ShaderCase, ours: Singles, theirs: Singles) -> ShaderResult:
    """Compare two results (side, side, 4) of a case; NaN equals NaN."""
    with np.errstate(invalid="ignore", over="ignore"):
        difference = np.abs(ours.astype(float) - theirs)
    same = (ours == theirs) | (np.isnan(ours) & np.isnan(theirs))
    difference[same] = 0
    allowed = case.absolute + case.relative * np.abs(theirs.astype(float))
    return ShaderResult(
        int(same.sum()),
        same.size,
        float(np.max(np.nan_to_num(difference, nan=np.inf))),
        int(np.count_nonzero(~(difference <= allowed))),
    )


def check_shaders(renderer: OpenGLRenderer, seed: int, write: Callable[[str], object]) -> bool:
    """Run all cases with OpenGL and with the core, write what differs, and return whether all agree."""
    a, b = shader_inputs(SIDE, seed)
    results = {
        case.name: compare_shader(case, run_with_core(case, a, b), draw_with_opengl(renderer, case, a, b))
        for case in CASES
    }
    equal, count = (sum(getattr(result, name) for result in results.values()) for name in ("equal", "count"))
    differing = [name for name, result in results.items() if not result.agrees]
    verdict = f"{len(differing)} shaders differ" if differing else "agrees"
    write(
        f"{'shaders':<14}{len(CASES):>6}{count:>12,} numbers, {equal / count:.2%} of them with the same bits  {verdict}"
    )
    for name in differing:
        result = results[name]
        write(f"    {name}: {result.excess} of {result.count} numbers differ, by up to {result.error:.1e}")
    return not differing
