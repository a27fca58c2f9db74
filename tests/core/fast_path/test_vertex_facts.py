"""What is kept of a mesh from picture to picture holds for each of them."""

from dataclasses import replace

import numpy as np
import pytest

from core import Camera, DirectionalLight, Scene, Settings, draw_picture
from lessons.shapes import sphere
from tests.core.fast_path.references import exact_bytes

CAMERA = Camera(np.array([0.0, 0.0, 4.0]), np.zeros(3))
CLIPPED = Settings(depth="fixed-38", clipping="sutherland-hodgman", cull="back")


def white_below_and_red_above() -> Scene:
    mesh = sphere()
    colors = np.ones((len(mesh.positions), 4))
    colors[mesh.positions[:, 1] > 0, 1:3] = 0
    lights = (DirectionalLight(np.array([0.4, -0.8, -0.7])),)
    return Scene((replace(mesh, colors=colors),), CAMERA, lights, (60, 50))


@pytest.mark.parametrize("after", [CLIPPED, replace(CLIPPED, clipping="homogeneous")], ids=["clipped", "not"])
def test_a_part_of_one_colour_says_nothing_of_the_whole(after):
    """Of a scene that is clipped only what is drawn is looked at; nothing is cut, so the vertices are the same."""
    scene = white_below_and_red_above()
    part = draw_picture(scene, CLIPPED, region=(0, 0, 60, 15))
    assert part.route.color == "lit"
    whole = draw_picture(scene, after)
    assert whole.route.color == ("deferred" if after is CLIPPED else "lit")
    assert np.abs(whole.pixels.astype(int) - exact_bytes(scene, after, "srgb")).max() <= 1
