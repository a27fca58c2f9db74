"""The sphere's picture against scalar rays and the scalar lighting listing."""

from math import sqrt, tan

import numpy as np
import pytest

from core.shading.lighting import blinn_phong, plain_lights, plain_material
from core.shading.measured import sphere_picture
from core.study.workloads import sphere_scene


def test_pixels_are_lit_points_of_the_sphere() -> None:
    scene = sphere_scene(8, 24)
    meets, color = sphere_picture(scene, 1.0)
    assert 100 < meets.sum() < 24 * 24
    eye = scene.camera.eye.tolist()
    distance = sqrt(sum(value * value for value in eye))
    backward = [value / distance for value in eye]
    right = [backward[2], 0.0, -backward[0]]
    length = sqrt(right[0] ** 2 + right[2] ** 2)
    right = [value / length for value in right]
    up = [
        backward[1] * right[2] - backward[2] * right[1],
        backward[2] * right[0] - backward[0] * right[2],
        backward[0] * right[1] - backward[1] * right[0],
    ]
    reach = tan(scene.camera.field_of_view / 2)
    for row in range(0, 24, 5):
        for column in range(24):
            x, y = ((2 * (n + 0.5) / 24 - 1) * reach for n in (column, row))
            ray = [x * r + y * u - b for r, u, b in zip(right, up, backward, strict=True)]
            size = sqrt(sum(value * value for value in ray))
            ray = [value / size for value in ray]
            # The nearest point of the ray to the centre, and from there back to the surface.
            towards = -sum(e * r for e, r in zip(eye, ray, strict=True))
            gap = distance * distance - towards * towards
            assert meets[row, column] == (gap < 1)
            if gap < 1:
                along = towards - sqrt(1 - gap)
                point = tuple(e + along * r for e, r in zip(eye, ray, strict=True))
                diffuse, specular = blinn_phong(
                    point,
                    point,
                    tuple(eye),
                    plain_lights(scene.lights),
                    plain_material(scene.meshes[0].material),
                    False,
                )
                expected = [d + s for d, s in zip(diffuse, specular, strict=True)]
                assert color[row, column, :3] == pytest.approx(expected, abs=1e-9)
            else:
                assert np.array_equal(color[row, column], scene.background)
