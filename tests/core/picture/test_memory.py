"""The memory that a picture takes is what the package says."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from core import Camera, DirectionalLight, Scene, Settings, draw_picture
from core.raster.spans.arena import Arena
from lessons.shapes import sphere

PER_PIXEL, PER_TRIANGLE, FIXED = {"none": 24, "msaa-4": 40}, 900, 24_000_000


@pytest.mark.parametrize(("columns", "side"), [(64, 1024), (512, 512)])
@pytest.mark.parametrize("shading", ["phong", "gouraud"])
@pytest.mark.parametrize("antialiasing", list(PER_PIXEL))
def test_memory_of_a_picture(columns: int, side: int, shading: str, antialiasing: str) -> None:
    mesh, arena = sphere(columns=columns, rows=columns // 2), Arena()
    scene = Scene(
        (mesh,),
        Camera(np.array([1.0, 0.8, 2.8]), np.zeros(3)),
        (DirectionalLight(np.array([0.4, -0.8, -0.7])),),
        (side, side),
    )
    settings = Settings(depth="fixed-38", shading=shading, antialiasing=antialiasing)
    draw_picture(scene, settings, arena=arena)
    turned = replace(scene, camera=Camera(np.array([1.1, 0.8, 2.8]), np.zeros(3)))
    tracemalloc.start()
    try:
        draw_picture(turned, settings, arena=arena)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    held = peak + arena.byte_count
    assert held <= PER_PIXEL[antialiasing] * side * side + PER_TRIANGLE * len(mesh.triangles) + FIXED
