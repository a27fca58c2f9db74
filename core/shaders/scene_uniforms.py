"""Light and material of a scene as uniforms: a shader that declares one of their names gets the scene's numbers."""

from itertools import zip_longest

from core.records.arrays import Floats
from core.scene import DirectionalLight, Light, PointLight, Scene

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
