"""The memory that a picture takes is what the package says."""

import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core import Camera, ClipScene, DirectionalLight, Mesh, Scene, Settings, draw_picture
from core.numeric.large_arrays import ScratchBuffers
from core.scene import AnyScene
from lessons.shapes import sphere
from tests.core.fast_path.references import exact_bytes

PER_PIXEL, PER_TRIANGLE, FIXED = {"none": 24, "msaa-4": 40}, 900, 24_000_000
LIGHTS = (DirectionalLight(np.array([0.4, -0.8, -0.7])),)
Drawn = tuple[list[AnyScene], int, dict[str, Any]]
"""A scene and the one that is drawn after it, its triangles, and the settings."""


def seen(
    meshes: tuple[Mesh, ...], size: tuple[int, int], eyes: tuple[float, float] = (1.0, 1.1), **choice: Any
) -> Drawn:
    """Return meshes seen from two places."""
    scenes: list[AnyScene] = [
        Scene(meshes, Camera(np.array([x, 0.8, 2.8]), np.zeros(3)), LIGHTS, size) for x in eyes
    ]
    return scenes, sum(len(mesh.triangles) for mesh in meshes), choice


def ball(columns: int) -> Mesh:
    return sphere(columns=columns, rows=columns // 2)


def of_unlike_colours() -> Drawn:
    mesh = ball(400)
    colors = np.ones((len(mesh.positions), 4))
    colors[:, :3] = np.random.default_rng(1).uniform(0.1, 1, (len(colors), 3))
    return seen((replace(mesh, colors=colors),), (512, 512), shading="unlit")


def of_two_meshes() -> Drawn:
    mesh, aside = ball(64), np.eye(4)
    aside[0, 3] = 0.6
    return seen((mesh, replace(mesh, transform=aside)), (1024, 1024))


def of_a_floor_behind_the_eye() -> Drawn:
    """It is coloured by the plain rules, some pixels at a time."""
    corners = [(-9, -9), (-9, 9), (9, 9), (9, -9)]
    floor = Mesh(np.array([[x, -0.8, z] for x, z in corners]), np.array([[0, 1, 2], [0, 2, 3]]))
    return seen((ball(64), floor), (1600, 1200))


def of_large_triangles() -> Drawn:
    """Their rows are found for many of them at once, but not for all."""
    clip = np.tile([[-1.0, -1.0, 0.0, 1.0], [3.0, -1.0, 0.0, 1.0], [-1.0, 3.0, 0.0, 1.0]], (4000, 1, 1))
    return [ClipScene(clip, size=(256, 256)) for _ in range(2)], len(clip), {}


def of_tall_triangles() -> Drawn:
    """They walk together as many as have not too many rows."""
    count, generator = 3000, np.random.default_rng(1)
    clip = np.ones((count, 3, 4))
    clip[:, :, 0] = generator.uniform(-1, 1, (count, 1)) + generator.uniform(-0.02, 0.02, (count, 3))
    clip[:, :, 1] = [-1, 1, 0]
    clip[:, :, 2] = generator.uniform(-0.9, 0.9, (count, 3))
    colors = np.concatenate([generator.random((count, 3)), np.ones((count, 1))], axis=1)
    return [ClipScene(clip, np.repeat(colors[:, None], 3, axis=1), (640, 640)) for _ in range(2)], count, {}


CASES: dict[str, Callable[[], Drawn]] = {
    "many triangles": lambda: seen((ball(1024),), (64, 64), shading="gouraud"),
    "several samples": lambda: seen((ball(512),), (512, 512), antialiasing="msaa-4"),
    "unlike colours": of_unlike_colours,
    "two meshes": of_two_meshes,
    "large triangles": of_large_triangles,
    "tall triangles": of_tall_triangles,
    "a floor behind the eye": of_a_floor_behind_the_eye,
    "no bytes": lambda: seen((ball(16),), (1600, 1200), (0.3, 0.4), shading="gouraud"),
}
ROUTES = {"two meshes": "lit", "a floor behind the eye": "lit", "no bytes": "corners"}
EVERY_DAY = ("unlike colours", "no bytes")


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[] if name in EVERY_DAY else pytest.mark.slow) for name in CASES]
)
def test_memory_of_a_picture(name: str) -> None:
    (first, second), triangle_count, choice = CASES[name]()
    settings, scratch = Settings(depth="fixed-38", **choice), ScratchBuffers()
    drawn = draw_picture(first, settings, scratch=scratch)
    assert drawn.route.color == ROUTES.get(name, drawn.route.color)
    if name == "large triangles":
        assert drawn.route.split.big == triangle_count
    if name == "tall triangles":
        assert np.array_equal(drawn.pixels, exact_bytes(first, settings, "srgb"))
    tracemalloc.start()
    try:
        draw_picture(second, settings, scratch=scratch)
        held = tracemalloc.get_traced_memory()[1] + scratch.byte_count
    finally:
        tracemalloc.stop()
    pixels = np.prod(first.size) * PER_PIXEL[settings.antialiasing]
    assert held <= pixels + PER_TRIANGLE * triangle_count + FIXED
