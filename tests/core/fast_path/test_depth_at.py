"""Depth at some pixels only is that of the whole depth buffer, whatever way the picture is drawn."""

import numpy as np
import pytest

from core import Settings, draw_picture, render
from lessons.scenes import make_scene

SETTINGS = {
    "packed words": Settings(fill="spans", depth="fixed-38"),
    "rounded on a plane": Settings(fill="spans", depth="z-float32"),
    "1/w": Settings(fill="spans", depth="inverse-w"),
    "no depth test": Settings(fill="spans", visibility="painters"),
    "all buffers": Settings(fill="bounding-box"),
    "blended": Settings(fill="spans", blend="over"),
    "samples": Settings(fill="spans", antialiasing="msaa-4"),
}


@pytest.mark.parametrize("region", [None, (11, 7, 40, 30)], ids=["whole", "region"])
@pytest.mark.parametrize("name", list(SETTINGS))
def test_depth_at_pixels_is_that_of_the_buffer(name, region):
    scene, settings = make_scene("intersecting"), SETTINGS[name]
    whole = draw_picture(scene, settings, with_depth=True, region=region)
    places = np.random.default_rng(5).integers(0, whole.depth.size, 300)
    picture = draw_picture(scene, settings, depth_at=places, region=region)
    assert np.array_equal(picture.depth, whole.depth.reshape(-1)[places])
    assert picture.depth.dtype == whole.depth.dtype
    assert not picture.depth.flags.writeable
    assert np.array_equal(picture.pixels, whole.pixels)
    if region is None:
        assert np.array_equal(whole.depth, render(scene, settings).depth)


def test_places_outside_of_what_is_drawn_are_refused():
    scene = make_scene("intersecting")
    with pytest.raises(ValueError, match="depth_at must be places of pixels, 0 to 1199, got 0 to 1200"):
        draw_picture(scene, depth_at=np.array([0, 1200]), region=(0, 0, 40, 30))
    with pytest.raises(ValueError, match="got -1 to 5"):
        draw_picture(scene, depth_at=np.array([5, -1]))
    assert draw_picture(scene, depth_at=np.zeros(0, np.int64)).depth.shape == (0,)
