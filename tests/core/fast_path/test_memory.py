"""The memory that a picture takes is what the package says."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from core import Camera, ClipScene, DirectionalLight, Mesh, Scene, Settings, draw_picture
from core.numeric.buffers import ScratchBuffers
from core.scene import AnyScene
from lessons.shapes import sphere
from tests.core.fast_path.references import exact_bytes
from tests.covering import every_pair

PER_PIXEL, PER_TRIANGLE, FIXED = {"none": 24, "msaa-4": 40}, 900, 24_000_000


@every_pair(extent=[(64, 1024), (512, 512)], shading=["phong", "gouraud"], antialiasing=list(PER_PIXEL))
def test_memory_of_a_picture(extent: tuple[int, int], shading: str, antialiasing: str) -> None:
    columns, side = extent
    mesh = sphere(columns=columns, rows=columns // 2)
    scene = Scene(
        (mesh,),
        Camera(np.array([1.0, 0.8, 2.8]), np.zeros(3)),
        (DirectionalLight(np.array([0.4, -0.8, -0.7])),),
        (side, side),
    )
    settings = Settings(depth="fixed-38", shading=shading, antialiasing=antialiasing)
    turned = replace(scene, camera=Camera(np.array([1.1, 0.8, 2.8]), np.zeros(3)))
    limit = PER_PIXEL[antialiasing] * side * side + PER_TRIANGLE * len(mesh.triangles) + FIXED
    assert held(scene, turned, settings) <= limit


def held(first: AnyScene, second: AnyScene, settings: Settings) -> int:
    """Return the most bytes that are held while the second scene is drawn after the first."""
    scratch = ScratchBuffers()
    draw_picture(first, settings, scratch=scratch)
    tracemalloc.start()
    try:
        draw_picture(second, settings, scratch=scratch)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    return peak + scratch.byte_count


def test_memory_of_triangles_with_unlike_colours() -> None:
    mesh = sphere(columns=400, rows=200)
    colors = np.ones((len(mesh.positions), 4))
    colors[:, :3] = np.random.default_rng(1).uniform(0.1, 1, (len(colors), 3))
    meshes = (replace(mesh, colors=colors),)
    first, second = (
        Scene(meshes, Camera(np.array([x, 0.8, 2.8]), np.zeros(3)), (), (512, 512)) for x in (1.0, 1.1)
    )
    chosen = Settings(depth="fixed-38", shading="unlit")
    limit = PER_PIXEL["none"] * 512 * 512 + PER_TRIANGLE * len(mesh.triangles) + FIXED
    assert held(first, second, chosen) <= limit


def test_memory_of_several_meshes() -> None:
    mesh, aside = sphere(columns=64, rows=32), np.eye(4)
    aside[0, 3] = 0.6
    meshes, lights = (mesh, replace(mesh, transform=aside)), (DirectionalLight(np.array([0.4, -0.8, -0.7])),)
    first, second = (
        Scene(meshes, Camera(np.array([x, 0.8, 2.8]), np.zeros(3)), lights, (1024, 1024)) for x in (1.0, 1.1)
    )
    assert draw_picture(first, Settings(depth="fixed-38")).route.color == "lit"
    limit = PER_PIXEL["none"] * 1024 * 1024 + PER_TRIANGLE * 2 * len(mesh.triangles) + FIXED
    assert held(first, second, Settings(depth="fixed-38")) <= limit


def test_memory_of_large_triangles() -> None:
    """Their rows are found for many of them at once, but not for all."""
    count, side = 4000, 256
    clip = np.tile([[-1.0, -1.0, 0.0, 1.0], [3.0, -1.0, 0.0, 1.0], [-1.0, 3.0, 0.0, 1.0]], (count, 1, 1))
    scenes = [ClipScene(clip, size=(side, side)) for _ in range(2)]
    drawn = draw_picture(scenes[0], Settings(depth="fixed-38"))
    assert drawn.route.split is not None
    assert drawn.route.split.big == count
    limit = PER_PIXEL["none"] * side * side + PER_TRIANGLE * count + FIXED
    assert held(*scenes, Settings(depth="fixed-38")) <= limit


def test_memory_of_tall_triangles() -> None:
    """They walk together as many as have not too many rows."""
    count, side, generator = 3000, 640, np.random.default_rng(1)
    clip = np.ones((count, 3, 4))
    clip[:, :, 0] = generator.uniform(-1, 1, (count, 1)) + generator.uniform(-0.02, 0.02, (count, 3))
    clip[:, :, 1] = [-1, 1, 0]
    clip[:, :, 2] = generator.uniform(-0.9, 0.9, (count, 3))
    colors = np.concatenate([generator.random((count, 3)), np.ones((count, 1))], axis=1)
    scenes = [ClipScene(clip, np.repeat(colors[:, None], 3, axis=1), (side, side)) for _ in range(2)]
    chosen = Settings(depth="fixed-38")
    assert np.array_equal(draw_picture(scenes[0], chosen).pixels, exact_bytes(scenes[0], chosen, "srgb"))
    limit = PER_PIXEL["none"] * side * side + PER_TRIANGLE * count + FIXED
    assert held(*scenes, chosen) <= limit


def test_memory_of_a_floor_that_reaches_behind_the_eye() -> None:
    """It is coloured by the plain rules, some pixels at a time."""
    mesh, corners = sphere(columns=64, rows=32), [(-9, -9), (-9, 9), (9, 9), (9, -9)]
    floor = Mesh(np.array([[x, -0.8, z] for x, z in corners]), np.array([[0, 1, 2], [0, 2, 3]]))
    lights = (DirectionalLight(np.array([0.4, -0.8, -0.7])),)
    first, second = (
        Scene((mesh, floor), Camera(np.array([x, 0.8, 2.8]), np.zeros(3)), lights, (1600, 1200))
        for x in (1.0, 1.1)
    )
    drawn = draw_picture(first, Settings(depth="fixed-38"))
    assert drawn.route.color == "lit"
    assert drawn.route.visible > 1_000_000
    limit = PER_PIXEL["none"] * 1600 * 1200 + PER_TRIANGLE * len(mesh.triangles) + FIXED
    assert held(first, second, Settings(depth="fixed-38")) <= limit


@pytest.mark.parametrize("columns", [16, 64])
def test_memory_of_triangles_that_do_not_allow_bytes(columns: int) -> None:
    """Their pixels are coloured by the plain rules, some at a time."""
    mesh = sphere(columns=columns, rows=columns // 2)
    lights = (DirectionalLight(np.array([0.4, -0.8, -0.7])),)
    first, second = (
        Scene((mesh,), Camera(np.array([x, 0.6, 1.8]), np.zeros(3)), lights, (1600, 1200)) for x in (0.8, 0.9)
    )
    chosen = Settings(depth="fixed-38", shading="gouraud")
    drawn = draw_picture(first, chosen)
    assert drawn.route.color == "corners"
    assert drawn.route.visible > 800_000
    limit = PER_PIXEL["none"] * 1600 * 1200 + PER_TRIANGLE * len(mesh.triangles) + FIXED
    assert held(first, second, chosen) <= limit
