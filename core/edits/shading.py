"""Edited lighting: the light of a fragment comes from the text."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.edits.typed import Typed
from core.fragments.light_rule import LightRule
from core.fragments.lighting import Reflectance, Surface, plain_lights, plain_material
from core.methods import Method
from core.records.arrays import Floats
from core.scene import Light, Material
from core.settings import Settings

SHAPE = (("number",) * 3, ("number",) * 3)
WORDS = "diffuse and specular light, three numbers each"


@dataclass(frozen=True)
class TypedShading(LightRule):
    """A method of shading whose lighting rule is a typed text."""

    typed: Typed
    right: Callable[..., dict[str, Floats]]

    def __call__(self, *values: Any) -> dict[str, Floats]:
        """Return what the method interpolates."""
        return self.right(*values)

    def light(
        self, position: Floats, normal: Floats, eye: Floats, lights: Sequence[Light], material: Surface
    ) -> tuple[Floats, Floats]:
        """Return diffuse and specular light (F, 3) of points."""
        eyes = np.broadcast_to(eye, position.shape)
        shared = plain_lights(lights)

        def of_block(part: slice) -> list[Any]:
            here = material.take(part) if isinstance(material, Reflectance) else material
            places = [_components(vectors[part]) for vectors in (position, normal, eyes)]
            return [*places, shared, list(plain_material(here)), False]

        diffuse, specular = self.typed.run_blocks(of_block, len(position), SHAPE, WORDS)
        return diffuse.T, specular.T


def _components(vectors: Floats) -> list[Floats]:
    return [np.ascontiguousarray(vectors[:, axis]) for axis in range(3)]


def shading_is_passed_over(settings: Settings, scene: Any) -> str:
    """Return why an edited light would not run."""
    if scene is not None and scene.program is not None:
        return "The shaders of the scene light it."
    return ""


def check_shading(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    lights = [[[0.0, 0.0, 1.0], is_point, [1.0, 1.0, 1.0]] for is_point in (True, False)]
    none = [np.zeros(0)] * 3
    typed.checked([none, none, none, lights, list(plain_material(Material())), False], SHAPE, WORDS)


def edited_shading(method: Method, typed: Typed) -> Method:
    """Return a method of shading that lights by a text."""
    return replace(method, function=TypedShading(typed, method.function), listing=typed)
