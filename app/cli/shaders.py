"""Shaders on the command line: ``--vertex FILE --fragment FILE``, a preset, and values of uniforms."""

import argparse
from dataclasses import replace
from math import isfinite

from app.files.input_files import read_input
from app.usage import UsageError
from core.lanes.limits import SHADER
from core.scene import AnyScene, Scene
from core.shaders.linking import own_uniforms
from core.shaders.presets import PRESETS, VERTEX, preset_program
from core.shaders.record import DIALECTS, ShaderProgram

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
