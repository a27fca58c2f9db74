"""What a scene shows first: the whole of a small one, a triangle with pixels of a large one."""

from dataclasses import replace

import numpy as np
import pytest

from app.session.document import LEAST_AREA, open_document, window_corners_of
from core import Camera, DirectionalLight, Scene
from lessons.shapes import torus

RING = torus(1.0, 0.4, 200, 100)


def seen_from(*eye: float) -> Scene:
    light = DirectionalLight(np.array([0.0, -1.0, -1.0]))
    return Scene((RING,), Camera(np.array(eye), np.zeros(3)), (light,), (512, 512))


# From above the middle is a hole, around which all triangles are seen edge-on.
@pytest.mark.parametrize("eye", [(0.0, 3.0, 1.0), (0.0, 2.0, 2.5), (1.5, 1.0, 2.0)])
def test_the_first_triangle_has_pixels(eye: tuple[float, float, float]) -> None:
    document = open_document(seen_from(*eye), "a ring")
    assert document.triangle is not None
    assert np.count_nonzero(document.make_trace().stage("raster").marks["covered"]) >= LEAST_AREA / 2


def test_it_is_near_the_middle() -> None:
    document = open_document(seen_from(1.5, 1.0, 2.0), "a ring")
    assert document.triangle is not None
    assert np.abs(window_corners_of(document, document.triangle) - 256).max() < 64


def test_a_scene_behind_the_camera_opens() -> None:
    turned_away = Camera(np.array([0.0, 0.0, 9.0]), np.array([0.0, 0.0, 20.0]))
    scene = replace(seen_from(0.0, 3.0, 1.0), camera=turned_away)
    assert open_document(scene, "nothing").triangle == 0
