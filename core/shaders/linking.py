"""Whether two shaders fit each other, and the scene's uniforms fit both."""

from itertools import zip_longest
from typing import TYPE_CHECKING

from core.lanes.problem import Problem
from core.records.arrays import Floats
from core.scene import DirectionalLight, Light, PointLight, Scene
from core.shaders.glsl_types import component_count, proposal
from core.shaders.record import DIALECTS, ShaderProblem
from core.shaders.shader import ATTRIBUTES, UNIFORMS, Shader, compile_shader

if TYPE_CHECKING:
    from core.shaders.record import ShaderProgram


# Light and material of a scene as uniforms: a shader that declares one of their names gets the scene's
# numbers.


LIGHTS = ("light", "fill")
"""What the names of a scene's first and second light begin with."""
MATERIAL = ("ambient", "diffuse", "specular", "shininess")
AHEAD = (0.0, 0.0, -1.0)
"""The way light travels where a scene has none."""


def scene_uniforms(scene: Scene, mesh: int = 0) -> dict[str, tuple[float, ...]]:
    """Return the numbers that a scene gives the shaders of one of its meshes, by the names of the uniforms.

    Of each light ``lightSource`` has four: the way that it travels and 0, or the place of a point light and 1;
    ``lightDirection`` has the first three of them. A scene without lights has one that travels along -z.
    """
    material = scene.meshes[mesh].material
    found: dict[str, tuple[float, ...]] = {name: (float(getattr(material, name)),) for name in MATERIAL}
    for name, light in zip_longest(LIGHTS, scene.lights[: len(LIGHTS)]):
        is_shining = light is not None or (not scene.lights and name == LIGHTS[0])
        vector = AHEAD if light is None else _numbers(_vector_of(light))
        found[f"{name}Source"] = (*vector, float(isinstance(light, PointLight)))
        found[f"{name}Direction"] = vector
        found[f"{name}Color"] = (float(is_shining),) * 3 if light is None else _numbers(light.color)
    return found


def _vector_of(light: Light) -> Floats:
    return light.direction if isinstance(light, DirectionalLight) else light.position


def _numbers(values: Floats) -> tuple[float, ...]:
    return tuple(float(value) for value in values)


def read_shader(source: str, stage: str, dialect: str) -> Shader:
    """Read a shader as `compile_shader`; the problem says which shader it is about."""
    if dialect not in DIALECTS:
        raise ValueError(f"dialect must be one of {', '.join(DIALECTS)}, got {dialect}")
    try:
        return compile_shader(source, stage, dialect)
    except Problem as problem:
        raise ShaderProblem(stage, problem.place, problem.sentence) from None


def check_program(program: "ShaderProgram") -> None:
    """Raise ShaderProblem or ValueError where a program does not fit together."""
    vertex, fragment = program.shaders
    _check_attributes(vertex)
    outs = {variable.name: variable for variable in vertex.outputs}
    for variable in fragment.inputs:
        if variable.qualifier != "in" or variable.name.startswith("gl_"):
            continue
        out = outs.get(variable.name)
        if out is None:
            hint = proposal(variable.name, list(outs))
            raise ShaderProblem(
                "fragment",
                variable.place,
                f"{variable.name} has no source: the vertex shader has no out {variable.of} {variable.name}{hint}",
            )
        if out.of != variable.of or out.is_flat != variable.is_flat:
            ours, theirs = (f"{'flat ' * v.is_flat}{v.of}" for v in (variable, out))
            raise ShaderProblem(
                "fragment",
                variable.place,
                f"{variable.name} is {ours} here and {theirs} in the vertex shader: write the same in both",
            )
    _check_uniforms(program, vertex, fragment)


def _check_attributes(vertex: Shader) -> None:
    for variable in vertex.inputs:
        if variable.name.startswith("gl_"):
            continue
        if variable.qualifier == "in":
            wanted = (
                ("vec3", "vec4")
                if variable.name in ("color", "position")
                else (ATTRIBUTES.get(variable.name),)
            )
            if variable.name not in ATTRIBUTES:
                hint = proposal(variable.name, list(ATTRIBUTES))
                names = "position, normal, uv and color"
                raise ShaderProblem(
                    "vertex", variable.place, f"a mesh has no attribute {variable.name}, only {names}{hint}"
                )
            if variable.of not in wanted:
                raise ShaderProblem(
                    "vertex",
                    variable.place,
                    f"the attribute {variable.name} is {wanted[0]}, here it is declared {variable.of}",
                )


def _check_uniforms(program: "ShaderProgram", vertex: Shader, fragment: Shader) -> None:
    declared: dict[str, str] = {}
    for shader in (vertex, fragment):
        for variable in shader.inputs:
            if variable.qualifier != "uniform":
                continue
            of = UNIFORMS.get(variable.name, variable.of)
            if of != variable.of:
                raise ShaderProblem(
                    shader.stage,
                    variable.place,
                    f"the scene gives {variable.name} as {of}, here it is declared {variable.of}",
                )
            if declared.setdefault(variable.name, variable.of) != variable.of:
                raise ShaderProblem(
                    shader.stage,
                    variable.place,
                    f"{variable.name} is {variable.of} here and {declared[variable.name]} in the vertex shader",
                )
    for name, values in program.uniforms:
        if name in declared and name not in UNIFORMS and declared[name] != "sampler2D":
            count = component_count(declared[name])
            if len(values) != count:
                raise ValueError(
                    f"uniform {name} is {declared[name]}: {count} number{'s' * (count > 1)}, got {len(values)}"
                )


def own_uniforms(program: "ShaderProgram") -> dict[str, str]:
    """Return the uniforms that the scene does not give, with their types: what the user sets."""
    found: dict[str, str] = {}
    for shader in program.shaders:
        for variable in shader.inputs:
            if (
                variable.qualifier == "uniform"
                and variable.name not in UNIFORMS
                and variable.of != "sampler2D"
            ):
                found[variable.name] = variable.of
    return found
