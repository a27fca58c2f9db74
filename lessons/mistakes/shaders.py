"""The shelf of shader mistakes: what students type wrong, each as one edit of a preset, and how it is recognised.

A mistake is recognised by its picture: shaders written in another way that go wrong alike are named, too.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from core import Settings, render
from core.records.arrays import Singles
from core.scene import Scene
from core.shaders.presets import PRESETS, preset_program
from core.shaders.record import ShaderProgram

CLOSE = 4e-6
"""Colours that differ by no more are the same: float32 rounds sums in their order."""


@dataclass(frozen=True)
class ShaderMistake:
    """One wrong edit of a preset."""

    name: str
    preset: str
    stage: str
    right: str
    wrong: str
    says: str
    """What went wrong, and what to write."""

    @property
    def sentence(self) -> str:
        """The same, as all mistakes have it."""
        return self.says


SHELF = (
    ShaderMistake(
        "normal-not-unit",
        "phong",
        "fragment",
        "normalize(vNormal)",
        "vNormal",
        "The normal is not a unit vector: interpolation shortens it between the vertices. Write normalize(vNormal).",
    ),
    ShaderMistake(
        "light-turned-round",
        "phong",
        "fragment",
        "* -direction",
        "* direction",
        "The light comes from the wrong side: its direction is the way it travels. The vector to it is the negative.",
    ),
    ShaderMistake(
        "alpha-zero",
        "phong",
        "fragment",
        "vec4(light, 1.0)",
        "vec4(light, 0.0)",
        "Alpha is 0, so the surface counts as transparent. Write 1.0 as the fourth component.",
    ),
    ShaderMistake(
        "normal-in-object-space",
        "phong",
        "vertex",
        "normalMatrix * normal",
        "normal",
        "The normal is still in object space, but the light is seen from the eye. Write normalMatrix * normal.",
    ),
    ShaderMistake(
        "ambient-missing",
        "phong",
        "fragment",
        "vColor * ambient",
        "vec3(0.0)",
        "Ambient light is missing: what no light reaches is black. Begin with vColor * ambient.",
    ),
    ShaderMistake(
        "matrix-on-the-right",
        "phong",
        "vertex",
        "projectionMatrix * seen",
        "seen * projectionMatrix",
        "A vector on the left of a matrix multiplies by its transpose. Write projectionMatrix * seen.",
    ),
    ShaderMistake(
        "position-as-direction",
        "phong",
        "vertex",
        "vec4(position, 1.0)",
        "vec4(position, 0.0)",
        "With w = 0 the position is a direction: the matrices do not move it. Write vec4(position, 1.0).",
    ),
    ShaderMistake(
        "position-as-colour",
        "task",
        "vertex",
        "vColor = color;",
        "vColor = position;",
        "vColor has the vertex's position instead of its colour: numbers below 0 are black. Hand on color.",
    ),
    ShaderMistake(
        "color-not-handed-on",
        "task",
        "vertex",
        "vColor = color;",
        "vColor = vec3(0.0);",
        "vColor never gets the vertex's colour. Hand on color in the vertex shader.",
    ),
    ShaderMistake(
        "one-scale-for-all",
        "task",
        "vertex",
        "position.y*0.5",
        "position.y*1.5",
        "All axes have the scale of x. The task has a factor of its own for each: 1.5, 0.5 and 2.0.",
    ),
    ShaderMistake(
        "cosine-below-zero",
        "phong",
        "fragment",
        "   if (cosine <= 0.0) return vec3(0.0);\n",
        "",
        "The cosine is below 0 where the surface is turned away, and takes light away there. Write max(..., 0.0).",
    ),
    ShaderMistake(
        "threshold-reversed",
        "alpha-test",
        "fragment",
        "alpha < threshold",
        "alpha > threshold",
        "The wrong fragments are discarded: those above the threshold. Discard where alpha < threshold.",
    ),
)
"""All of them."""


def wrong_program(mistake: ShaderMistake, scene: Scene) -> ShaderProgram:
    """Return the preset with the mistake."""
    program = preset_program(mistake.preset, scene)
    source = getattr(program, mistake.stage)
    return replace(program, **{mistake.stage: source.replace(mistake.right, mistake.wrong)})


def recognised(program: ShaderProgram, scene: Scene, settings: Settings) -> ShaderMistake | None:
    """Return the mistake that makes the picture of shaders that began with a preset; ``None``: none, or they are right.

    Parameters
    ----------
    scene : Scene
        Small: each mistake is drawn.
    """
    plain = replace(scene, program=None)
    presets = [name for name, preset in PRESETS.items() if preset.title == program.name]
    candidates = [mistake for mistake in SHELF if mistake.preset in presets]
    if not candidates:
        return None
    drawn = render(replace(plain, program=program), settings).color
    right = replace(preset_program(presets[0], plain), uniforms=program.uniforms)
    if _alike(drawn, _picture(plain, right, settings)):
        return None
    for mistake in candidates:
        wrong = replace(wrong_program(mistake, plain), uniforms=program.uniforms)
        if _alike(drawn, _picture(plain, wrong, settings)):
            return mistake
    return None


@lru_cache(maxsize=32)
def _picture(scene: Scene, program: ShaderProgram, settings: Settings) -> Singles:
    return render(replace(scene, program=program), settings).color


def _alike(first: Singles, second: Singles) -> bool:
    return bool(np.allclose(first, second, rtol=0, atol=CLOSE, equal_nan=True))
