"""Record what OpenGL draws with four samples a pixel, for the tests that run without OpenGL.

From the top of the project, where the extra ``gpu`` is installed::

    python -m tests.oracle.record_multisampled

makes the files of tests/oracle/multisampled afresh, from fixed seeds: cases as those of `record_cases`, and of every
sample the triangle and the colour (S, H, W); ``position`` (S, 2) is where OpenGL says that its samples lie.
"""

import json
import sys
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np

from app.opengl_check.cases import Case
from app.opengl_check.families import make_case

FOLDER = Path(__file__).parent / "multisampled"
SAMPLES = 4
LARGEST = 24
CHOSEN = {"single": 2, "shared": 2, "sliver": 2, "depth": 2, "noperspective": 1, "mesh": 1}
"""Cases of each family: the first whose samples differ."""
TRIED = 20
LAYOUT = [("position", np.float32, 4), ("value", np.float32, 4), ("number", np.int32)]
VERTEX_SHADER = """#version 330
in vec4 position; in vec4 value; in int number;
{qualifier} out vec4 interpolated; flat out int owner;
void main() {{ gl_Position = position; interpolated = value; owner = number; }}
"""
FRAGMENT_SHADER = """#version 330
{qualifier} in vec4 interpolated; flat in int owner;
layout(location = 0) out vec4 color; layout(location = 1) out vec4 primitive;
void main() {{ color = interpolated; primitive = vec4(owner); }}
"""
WHOLE_WINDOW = """#version 330
void main() { gl_Position = vec4(gl_VertexID % 2 * 4 - 1, gl_VertexID / 2 * 4 - 1, 0, 1); }
"""
FETCH = """#version 330
uniform sampler2DMS image; uniform int number; out vec4 value;
void main() { value = texelFetch(image, ivec2(gl_FragCoord.xy), number); }
"""


def draw_samples(context: Any, case: Case) -> tuple[np.ndarray, np.ndarray]:
    """Return triangle (S, H, W) int16 and colour (S, H, W, 4) float32 of every sample."""
    with ExitStack() as stack:

        def owned(thing: Any) -> Any:
            stack.callback(thing.release)
            return thing

        color, primitive = (
            owned(context.texture(case.size, 4, samples=SAMPLES, dtype="f4")) for _ in range(2)
        )
        depth = owned(context.depth_renderbuffer(case.size, samples=SAMPLES))
        frame = owned(context.framebuffer([color, primitive], depth))
        frame.use()
        frame.clear(0, 0, 0, 0, depth=1)
        cull = context.CULL_FACE if case.cull != "none" else 0
        context.enable_only(context.DEPTH_TEST | cull)
        context.depth_func = "<" if case.depth_test else "1"
        context.cull_face = case.cull if case.cull != "none" else "back"
        vertices = np.zeros(case.clip.shape[:2], LAYOUT)
        vertices["position"], vertices["value"][..., 3] = case.clip, 1
        vertices["value"][..., : case.attributes.shape[2]] = case.attributes
        vertices["number"] = np.arange(1, len(case.clip) + 1)[:, None]
        qualifier = {"perspective": "smooth", "affine": "noperspective", "flat": "flat"}[case.interpolation]
        texts = (VERTEX_SHADER.format(qualifier=qualifier), FRAGMENT_SHADER.format(qualifier=qualifier))
        program = owned(context.program(*texts))
        buffer = owned(context.buffer(vertices.tobytes()))
        corners = (buffer, "4f 4f 1i", "position", "value", "number")
        owned(context.vertex_array(program, [corners])).render(context.TRIANGLES)
        primitives = read_samples(context, primitive, case.size)[..., 0].astype(np.int16) - 1
        return primitives, read_samples(context, color, case.size)


def read_samples(context: Any, texture: Any, size: tuple[int, int]) -> np.ndarray:
    """Return every sample of a texture, (S, H, W, 4) float32."""
    with ExitStack() as stack:
        target = context.texture(size, 4, dtype="f4")
        frame = context.framebuffer([target])
        fetch = context.program(WHOLE_WINDOW, FETCH)
        window = context.vertex_array(fetch, [])
        for thing in (target, frame, fetch, window):
            stack.callback(thing.release)
        frame.use()
        context.enable_only(context.NOTHING)
        texture.use(0)
        found = []
        for sample in range(SAMPLES):
            fetch["number"].value = sample
            window.render(context.TRIANGLES, vertices=3)
            found.append(np.frombuffer(target.read(), np.float32).reshape(size[1], size[0], 4))
        return np.stack(found)


def main() -> int:
    """Write all files."""
    import moderngl

    context = moderngl.create_context(standalone=True, backend="egl")
    renderer = f"{context.info['GL_RENDERER']}, OpenGL {context.info['GL_VERSION']}"
    FOLDER.mkdir(exist_ok=True)
    for family, count in CHOSEN.items():
        cases = [make_case(family, 7, number, LARGEST) for number in range(TRIED)]
        drawn = [(case, *draw_samples(context, case)) for case in cases]
        differing = [each for each in drawn if (each[1] != each[1][0]).any()]
        for number, (case, primitive, color) in enumerate(differing[:count]):
            names = ("family", "cull", "depth_test", "interpolation", "provoking", "size")
            options = {name: getattr(case, name) for name in names} | {"renderer": renderer}
            np.savez_compressed(
                FOLDER / f"{family}_{number}.npz",
                options=np.array(json.dumps(options)),
                clip=case.clip,
                attributes=case.attributes,
                sample_primitive=primitive,
                sample_color=color,
            )
    return 0


if __name__ == "__main__":
    sys.exit(main())
