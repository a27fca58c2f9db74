"""Scenes that a shader of an exercise draws beside built-in shading."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from core import Settings
from core.scene import Material, Scene
from core.shaders.presets import VERTEX
from core.shaders.record import ShaderProgram
from lessons.exercises.coding.shader_task import Beside
from lessons.scenes import make_scene
from lessons.shapes import FACE_COLORS, linear_color, sphere

SIZE = (48, 48)


def matte(vertex: str, fragment: str) -> Beside:
    """Return a sphere of large triangles in one light, without a highlight.

    Raises ValueError for shaders that do not fit together.
    """
    scene = _sphere()
    return Beside(Settings(), scene, replace(scene, program=ShaderProgram(vertex, fragment)))


def textured(fragment: str) -> Beside:
    """Return a floor with a texture, without light."""
    scene = _floor()
    settings = Settings(shading="unlit", texture_filter="nearest")
    return Beside(settings, scene, replace(scene, program=ShaderProgram(VERTEX, fragment)))


@lru_cache
def _sphere() -> Scene:
    scene, mesh = make_scene("sphere"), sphere(columns=8, rows=4)
    assert isinstance(scene, Scene)
    colors = np.tile(linear_color(FACE_COLORS[0]), (len(mesh.positions), 1))
    mesh = replace(mesh, colors=colors, material=Material(specular=0.0))
    return replace(scene, meshes=(mesh,), lights=scene.lights[:1], size=SIZE)


@lru_cache
def _floor() -> Scene:
    scene = make_scene("textured-floor")
    assert isinstance(scene, Scene)
    return replace(scene, size=SIZE)
