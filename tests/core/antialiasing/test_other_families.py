"""Antialiasing with the methods of other families: number formats of coverage, and ways to find what is visible."""

from dataclasses import replace

import numpy as np
import pytest

from core import ClipScene, Settings, render
from core.methods import table
from lessons.scenes import make_scene

SAMPLED = ["ssaa-4", "ssaa-16", "msaa-4"]


@pytest.fixture(scope="module")
def cube():
    return replace(make_scene("cube"), size=(40, 30))


@pytest.mark.parametrize("coverage", table.names("coverage"))
def test_areas_are_alike_in_every_number_format(cube, coverage):
    found = render(cube, Settings(antialiasing="area", coverage=coverage)).color
    expected = render(cube, Settings(antialiasing="area")).color
    assert np.abs(found - expected).max() < (0.05 if coverage == "float16" else 0.005)


@pytest.mark.parametrize("antialiasing", SAMPLED)
def test_rays_through_the_samples_meet_what_the_depth_buffer_keeps(cube, antialiasing):
    by_depth = render(cube, Settings(antialiasing=antialiasing, depth="reversed-z"))
    by_rays = render(cube, Settings(antialiasing=antialiasing, visibility="ray-casting"))
    np.testing.assert_array_equal(by_rays.samples.primitive, by_depth.samples.primitive)
    assert len(np.unique(by_rays.samples.primitive)) > 3


def test_rays_order_pieces_as_depths_do(cube):
    by_rays = render(cube, Settings(antialiasing="area", visibility="ray-casting")).color
    by_depth = render(cube, Settings(antialiasing="area", depth="reversed-z")).color
    np.testing.assert_allclose(by_rays, by_depth, atol=1e-6)


def test_rays_between_two_planes_are_compared_exactly_at_samples():
    """Two planes that cross in x = 0: the samples left of it show one, those right of it the other."""
    left_near = [[-1, -1, -0.5, 1], [1, -1, 0.5, 1], [0, 1, 0, 1]]
    right_near = [[-1, -1, 0.5, 1], [1, -1, -0.5, 1], [0, 1, 0, 1]]
    scene = ClipScene([left_near, right_near], size=(5, 4))
    samples = render(scene, Settings(antialiasing="msaa-4", visibility="ray-casting")).samples
    at = samples.position[:, 0][:, None, None] + np.arange(5)
    seen = samples.primitive >= 0
    assert (samples.primitive[seen] == (at > 2.5).repeat(4, axis=1).astype(int)[seen]).all()
    assert seen.any()
