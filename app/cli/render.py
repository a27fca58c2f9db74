"""``rasterscope render``: a picture and its buffers, without a window; with shaders, which ``trace`` takes too."""

import argparse
import os
from dataclasses import replace
from math import isfinite

import numpy as np

from app.cli import arguments
from app.files.file_access import check_writable, read_input, whole_file
from app.session.memory import check_free
from app.usage import UsageError
from core import Frame, Settings, render
from core.framebuffer.display import picture_bytes
from core.lanes.problem import SHADER
from core.resolved import resolve
from core.scene import AnyScene, Scene
from core.shaders.linking import own_uniforms
from core.shaders.presets import PRESETS, VERTEX, preset_program
from core.shaders.record import DIALECTS, ShaderProgram

# Shaders on the command line: ``--vertex FILE --fragment FILE``, a preset, and values of uniforms.


PLAIN_FRAGMENT = PRESETS["normals"].fragment
"""Draws normals as colours where only a vertex shader is given that hands on what it needs."""


def add_shaders(parser: argparse.ArgumentParser) -> None:
    """Let the command take shaders."""
    group = parser.add_argument_group("shaders", "GLSL ES 3.00, run without a graphics card")
    group.add_argument(
        "--vertex", metavar="FILE", help="the vertex shader; default: one that passes everything on"
    )
    group.add_argument("--fragment", metavar="FILE", help="the fragment shader")
    group.add_argument("--shaders", metavar="PRESET", choices=tuple(PRESETS), help=", ".join(PRESETS))
    group.add_argument(
        "--uniform",
        metavar="NAME=N,N,...",
        type=uniform_from_text,
        nargs="+",
        action="extend",
        default=[],
        help="numbers of a uniform; light and material are those of the scene",
    )
    group.add_argument(
        "--dialect",
        choices=tuple(DIALECTS),
        default="shader-material",
        help="who declares three.js's names: ShaderMaterial, or with RawShaderMaterial the shader",
    )


def uniform_from_text(text: str) -> tuple[str, tuple[float, ...]]:
    """Return name and numbers of a text such as ``lightColor=1,0.5,0``."""
    name, sign, numbers = text.partition("=")
    try:
        values = tuple(float(number) for number in numbers.split(","))
    except ValueError:
        values = ()
    if not (name and sign and values and all(map(isfinite, values))):
        raise argparse.ArgumentTypeError(f"must be NAME=N,N,... such as lightColor=1,0.5,0, got {text}")
    return name, values


def with_shaders(scene: AnyScene, options: argparse.Namespace) -> AnyScene:
    """Return the scene with the shaders that were asked for; raises UsageError, and ValueError for a wrong shader."""
    asked = options.vertex or options.fragment or options.shaders
    if not asked and not options.uniform:
        return scene
    if not isinstance(scene, Scene):
        raise UsageError("shaders need a scene of meshes: this one is given in clip space")
    if (options.vertex or options.fragment) and options.shaders:
        raise UsageError("argument --shaders: not together with --vertex and --fragment")
    if options.shaders:
        program = preset_program(options.shaders, scene)
    elif asked:
        program = _from_files(options)
    elif scene.program is None:
        raise UsageError("argument --uniform: needs shaders: give --vertex, --fragment or --shaders")
    else:
        program = scene.program
    return replace(scene, program=_with_uniforms(program, options.uniform))


def _from_files(options: argparse.Namespace) -> ShaderProgram:
    vertex = _text(options.vertex) if options.vertex else VERTEX
    fragment = _text(options.fragment) if options.fragment else PLAIN_FRAGMENT
    return ShaderProgram(vertex, fragment, (), options.dialect)


def _with_uniforms(program: ShaderProgram, chosen: list[tuple[str, tuple[float, ...]]]) -> ShaderProgram:
    declared = own_uniforms(program)
    for name, _ in chosen:
        if name not in declared:
            names = f", only {', '.join(declared)}" if declared else ""
            raise UsageError(f"argument --uniform: these shaders have no uniform {name}{names}")
    return replace(program, uniforms=tuple({**program.values, **dict(chosen)}.items()))


def _text(path: str) -> str:
    """Return the text of a shader's file."""
    content = read_input(path, 4 * SHADER.characters)
    try:
        return content.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as problem:
        raise ValueError(f"{path}: this is not a text in UTF-8 (byte {problem.start})") from None


# ``rasterscope render``: a picture and its buffers, without a window.


DESCRIPTION = (
    """Draw a scene into a PNG file (sRGB, straight alpha), its buffers into an npz file, or both."""
)
EXAMPLES = """The npz file has three arrays; row 0 is the bottom row.
  color      (H, W, 4) float32, linear, as the blend method leaves it
  depth      (H, W) float32, as the depth method stores it
  primitive  (H, W) int32, number of the visible triangle, -1 for none

examples:
  rasterscope render teapot.obj -o teapot.png
  rasterscope render teapot.obj -o teapot.png --size 640x480 --set shading=flat cull=back
  rasterscope render teapot.obj -o toon.png --fragment toon.glsl --uniform steps=4
  rasterscope render shared-edge -o edge.png --set fill=blocks block_size=4 --buffers edge.npz
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    arguments.add_file(parser)
    parser.add_argument("-o", "--output", metavar="out.png", help="the picture")
    arguments.add_size(parser)
    arguments.add_settings(parser)
    arguments.add_edits(parser)
    add_shaders(parser)
    parser.add_argument("--buffers", metavar="out.npz", help="color, depth and primitive as arrays")


def run(options: argparse.Namespace) -> int:
    """Draw and write."""
    for path, name, ending in ((options.output, "-o", ".png"), (options.buffers, "--buffers", ".npz")):
        if path is not None and not path.lower().endswith(ending) and not is_device(path):
            raise UsageError(f"argument {name}: the name of the file must end with {ending}, got {path}")
    if options.output is None and options.buffers is None:
        raise UsageError("nothing would be written: give -o out.png, --buffers out.npz or both")
    for path in filter(None, (options.output, options.buffers)):
        check_writable(path)

    opened = arguments.open_file(options)
    settings = arguments.chosen_settings(opened.document.settings, options.set, options.edit)
    scene = with_shaders(arguments.sized(opened.document.scene, options), options)
    blend = resolve(settings).blend_name
    check_memory(scene.size, settings)
    with arguments.overflow_reported():
        frame = render(scene, settings)

    if options.output is not None:
        write_picture(options.output, frame, blend)
    if options.buffers is not None:
        with whole_file(options.buffers) as file:
            np.savez(file, color=frame.color, depth=frame.depth, primitive=frame.primitive)
    return 0


def write_picture(path: str, frame: Frame, blend: str) -> None:
    """Write the colours of a frame as a PNG file, top row first."""
    from PIL import Image

    pixels = picture_bytes(frame.color, blend)
    with whole_file(path) as file:
        Image.fromarray(np.ascontiguousarray(pixels[::-1])).save(file, "PNG")


def is_device(path: str) -> bool:
    """Return whether a path names something that is written to directly, as /dev/null."""
    return os.path.exists(path) and not os.path.isfile(path) and not os.path.isdir(path)


BYTES_PER_PIXEL = {"opaque": 380}
BYTES_PER_BLENDED_PIXEL = 530
"""Memory that drawing takes at its peak where every pixel is textured, lit and seen; measured at 4096x4096."""
BYTES_PER_SAMPLE = {"opaque": 130}
BYTES_PER_BLENDED_SAMPLE = 150
"""The same of a sample of supersampling, which is drawn in bands: only its buffers are kept; measured with 2 x 2, 4 x 4
and 8 x 8 samples."""
BYTES_PER_MULTISAMPLED_PIXEL = {"opaque": 650}
BYTES_PER_BLENDED_MULTISAMPLED_PIXEL = 1040
"""The same of a pixel with the four samples of multisampling, which is shaded once; measured at 2048x2048."""


def bytes_per_pixel(settings: Settings) -> int:
    """Return how many bytes a pixel may take at the peak of drawing, beside what does not grow with the picture."""
    resolved = resolve(settings)
    blend, sampling = resolved.blend_name, resolved.sampling
    whole = BYTES_PER_PIXEL.get(blend, BYTES_PER_BLENDED_PIXEL)
    if settings.antialiasing == "msaa-4":
        whole = BYTES_PER_MULTISAMPLED_PIXEL.get(blend, BYTES_PER_BLENDED_MULTISAMPLED_PIXEL)
    elif sampling.side:
        of_sample = BYTES_PER_SAMPLE.get(blend, BYTES_PER_BLENDED_SAMPLE)
        whole = max(whole, of_sample * sampling.count)
    return whole


def check_memory(size: tuple[int, int], settings: Settings) -> None:
    """Raise ValueError for a picture of ``size`` pixels that may not fit into the memory that is free."""
    count = resolve(settings).sampling.count
    samples = f" with {count} samples each" if count > 1 else ""
    needed = size[0] * size[1] * bytes_per_pixel(settings)
    check_free(needed, f"a picture of {size[0]}x{size[1]} pixels{samples}")
