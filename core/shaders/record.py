"""The shaders of a scene: a vertex and a fragment shader with the values of their uniforms."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite
from typing import TYPE_CHECKING

from core.lanes.problem import Place, Problem
from core.records.arrays import cached_property

if TYPE_CHECKING:
    from core.shaders.shader import Shader


DIALECTS = {"shader-material": "ShaderMaterial", "raw-shader-material": "RawShaderMaterial"}
"""three.js declares its attributes and matrices for a ShaderMaterial; for a RawShaderMaterial the shader does."""


class ShaderProblem(Problem):
    """A shader that cannot be read or run, or two that do not fit; ``stage`` says which it is about."""

    def __init__(self, stage: str, place: Place, sentence: str) -> None:
        super().__init__(place, sentence)
        self.args = (stage, place, sentence)
        self.stage = stage

    def __str__(self) -> str:
        return f"{self.stage} shader, {super().__str__()}"


@dataclass(frozen=True)
class ShaderProgram:
    """Two shaders that fit each other.

    Raises
    ------
    ShaderProblem
        With the shader, its line and column, and one sentence.
    ValueError
        A uniform's value that does not fit its declaration, or an unknown dialect.
    """

    vertex: str
    """Source of the vertex shader, GLSL ES 3.00."""
    fragment: str
    """Source of the fragment shader."""
    uniforms: tuple[tuple[str, tuple[float, ...]], ...] = ()
    """Name of a uniform and its numbers, of a matrix column by column.

    Those that are missing are the scene's light and material, see `core.shaders.linking`; others are 0.
    """
    dialect: str = "shader-material"
    """Who declares three.js's names, a key of `DIALECTS`."""
    name: str = field(default="", compare=False)
    """Title of the preset that it began with."""

    def __post_init__(self) -> None:
        given = self.uniforms.items() if isinstance(self.uniforms, Mapping) else self.uniforms
        object.__setattr__(
            self, "uniforms", tuple(sorted((name, tuple(map(float, values))) for name, values in given))
        )
        for name, values in self.uniforms:
            if not all(map(isfinite, values)):
                raise ValueError(f"uniform {name} must be finite, got {list(values)}")
        from core.shaders.linking import check_program

        check_program(self)

    @cached_property
    def shaders(self) -> "tuple[Shader, Shader]":
        """The vertex and the fragment shader, read and checked."""
        from core.shaders.linking import read_shader

        return (
            read_shader(self.vertex, "vertex", self.dialect),
            read_shader(self.fragment, "fragment", self.dialect),
        )

    def __reduce__(self) -> tuple[type["ShaderProgram"], tuple[object, ...]]:
        """Send the texts to another process, which reads them itself."""
        return type(self), (self.vertex, self.fragment, self.uniforms, self.dialect, self.name)

    @property
    def values(self) -> dict[str, tuple[float, ...]]:
        """The uniforms' numbers by name."""
        return dict(self.uniforms)
