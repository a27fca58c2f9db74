"""Edited interpolation, texture filters and lighting: values and colours of fragments come from the text."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from core.edits.typed import Typed, parameters_of
from core.interpolation.interpolation import (
    Planes,
    ValuePlaces,
    ValueRule,
    interpolate_affine_at,
    interpolate_at,
)
from core.lanes.python_values import LEVEL, Table, table_of
from core.methods import Method
from core.records.arrays import Floats, Integers
from core.resolved import resolve
from core.scene import Light, Material, Texture
from core.settings import Settings
from core.shading.lighting import Reflectance, Surface, plain_lights, plain_material
from core.shading.shading import LightRule
from core.textures.look_up import ColorRule, fill_missing_channels
from core.textures.mipmaps import mipmap_levels

# Edited interpolation: weights and values both come from the text.


WEIGHTS = "the weights of the three corners"
GIVEN: dict[str, Callable[[ValuePlaces, slice], Any]] = {
    "a": lambda at, part: _rows(at.planes.a, at.primitive[part]),
    "b": lambda at, part: _rows(at.planes.b, at.primitive[part]),
    "c": lambda at, part: _rows(at.planes.c, at.primitive[part]),
    "w": lambda at, part: _rows(at.planes.w, at.primitive[part]),
    "determinant": lambda at, part: at.planes.determinant.take(at.primitive[part]),
    "corners": lambda at, part: [list(xy) for xy in at.planes.window.take(at.primitive[part], axis=2)],
    "x": lambda at, part: at.x[part],
    "y": lambda at, part: at.y[part],
    "provoking": lambda at, _part: at.provoking,
    "interval": lambda at, _part: at.interval,
}
"""What listings of the family are given, by the names of their parameters; ``values`` come beside."""
WITH_SUM = (interpolate_at, interpolate_affine_at)
"""Listings that return the sum of what they divide by it, too."""
THREE = ("number",) * 3


def _rows(values: Floats, primitive: Integers) -> list[Floats]:
    return [values[:, k].take(primitive) for k in range(3)]


@dataclass(frozen=True)
class TypedInterpolation(ValueRule):
    """A rule of the family ``interpolation`` that runs a typed text."""

    typed: Typed

    @property
    def _parameters(self) -> tuple[str, ...]:
        return parameters_of(self.typed.of)

    @property
    def _shape(self) -> tuple[Any, ...]:
        return (THREE, "number", "number") if self.typed.of in WITH_SUM else (THREE, "number")

    @property
    def _words(self) -> str:
        return f"{WEIGHTS}, {'their sum, ' if len(self._shape) == 3 else ''}and the value"

    def __call__(
        self, planes: Planes, primitive: Integers, x: Floats, y: Floats, provoking: int, interval: int
    ) -> Floats:
        """Return weights (F, 3)."""
        at = ValuePlaces(planes, primitive, x, y, provoking, interval)
        return self.weights_and_values(at, np.zeros((3, len(primitive))))[0].T

    def weights_and_values(self, at: ValuePlaces, corners: Floats) -> tuple[Floats, Floats]:
        """Return weights (3, F) and values (F,) between those of the corners (3, F)."""

        def of_block(part: slice) -> list[Any]:
            at_corners = list(corners[:, part])
            return [at_corners if name == "values" else GIVEN[name](at, part) for name in self._parameters]

        weights, *_, values = self.typed.run_blocks(of_block, len(at.primitive), self._shape, self._words)
        return weights, values

    def check(self) -> None:
        """Raise `Problem` for a text that cannot run."""
        none = np.zeros((0, 3))
        planes = Planes(none, none, none, np.zeros(0), none, np.zeros((0, 3, 3)))
        at = ValuePlaces(planes, np.zeros(0, np.int64), np.zeros(0), np.zeros(0), 2, 16)
        values = [
            [np.zeros(0)] * 3 if name == "values" else GIVEN[name](at, slice(0)) for name in self._parameters
        ]
        self.typed.checked(values, self._shape, self._words)


def check_interpolation(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    TypedInterpolation(typed).check()


def edited_interpolation(method: Method, typed: Typed) -> Method:
    """Return an interpolation that runs a text."""
    return replace(method, function=TypedInterpolation(typed), listing=typed)


def interpolation_is_passed_over(settings: Settings, scene: Any) -> str:
    """Return why an edited interpolation would not run."""
    if (scene is not None and scene.corner_count < 3) or resolve(settings).is_outlined:
        return "Lines and points are interpolated along themselves, by listings of their own."
    return ""


# Edited texture filters: the colour comes from the text.


COLOR = "the colour: as many numbers as a texel has"


@lru_cache(4)
def texels_of(levels: tuple[Texture, ...], is_stack: bool) -> Table:
    """Return what a listing knows as ``pixels`` (``is_stack``: as ``levels``)."""
    found = table_of([level.pixels for level in levels])
    return found if is_stack else replace(found, chosen=(0,) * (LEVEL + 1))


def filter_inputs(typed: Typed, texture: Texture, u: Any, v: Any, lod: Any, wrap: str) -> list[Any]:
    """Return what the listing of a filter is given: ``lod`` is left out where it takes none."""
    takes_levels = "levels" in parameters_of(typed.of)
    levels = mipmap_levels(texture) if takes_levels else (texture,)
    return [texels_of(levels, takes_levels), u, v, *([lod] if takes_levels else []), str(wrap)]


@dataclass(frozen=True)
class TypedFilter(ColorRule):
    """A texture filter that runs a typed text."""

    typed: Typed
    right: Callable[..., Any]
    """The rule of the method: which texels the trace shows as read."""

    def __call__(self, *values: Any) -> Any:
        """Return what the method reads."""
        return self.right(*values)

    def colors(self, texture: Texture, uv: Floats, lod: Floats | None, wrap: str) -> Floats:
        """Return colours (4, F) of finite coordinates ``uv`` (2, F)."""
        channels = texture.pixels.shape[2]
        color = np.empty((4, uv.shape[1]))

        def of_block(part: slice) -> list[Any]:
            (u, v), levels = uv[:, part], None if lod is None else lod[part]
            return filter_inputs(self.typed, texture, u, v, levels, wrap)

        color[:channels] = self.typed.run_blocks(of_block, uv.shape[1], ("number",) * channels, COLOR)
        fill_missing_channels(color.T, channels)
        return color


def check_filter(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    white = Texture(np.ones((1, 1, 4), np.float32))
    none = np.zeros(0)
    typed.checked(filter_inputs(typed, white, none, none, none, "repeat"), ("number",) * 4, COLOR)


def edited_filter(method: Method, typed: Typed) -> Method:
    """Return a texture filter that runs a text."""
    return replace(method, function=TypedFilter(typed, method.function), listing=typed)


def filter_is_passed_over(settings: Settings, scene: Any) -> str:
    """Return why an edited texture filter would not run."""
    if "wrap" in settings.replacements:
        return "It knows the three wraps by their names: choose one of them."
    return ""


# Edited lighting: the light of a fragment comes from the text.


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
    if settings.shadow != "none":
        return "Shadows change what arrives of a light at each fragment: choose shadow none."
    if settings.environment != "none":
        return "Reflections are added to what the text computes: choose environment none."
    return ""


def check_shading(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    lights = [[[0.0, 0.0, 1.0], is_point, [1.0, 1.0, 1.0]] for is_point in (True, False)]
    none = [np.zeros(0)] * 3
    typed.checked([none, none, none, lights, list(plain_material(Material())), False], SHAPE, WORDS)


def edited_shading(method: Method, typed: Typed) -> Method:
    """Return a method of shading that lights by a text."""
    return replace(method, function=TypedShading(typed, method.function), listing=typed)
