"""Supersampling: the samples are the picture at n times the size, resolved."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from core import ClipScene, Settings, draw_picture, pipeline, render
from core.antialiasing.resolve import resolve_samples
from core.coverage.pixel_runs import make_raster
from core.framebuffer.display import to_display
from core.pipeline import draw
from tests.core.trace.trace_cases import EACH_METHOD, SCENES, name_of, settings_of
from tests.covering import every_pair, in_turn

SIDES = {"ssaa-4": 2, "ssaa-16": 4, "ssaa-n": 3}


@pytest.mark.parametrize(
    ("name", "choice"),
    in_turn(["clip", "lit", "textured-clip", "orthographic"], EACH_METHOD),
    ids=name_of,
)
def test_samples_are_the_pixels_of_the_larger_picture(name, choice):
    scene = SCENES[name]
    settings = settings_of(choice | {"antialiasing": "ssaa-4", "pixel_center": "half"}, scene)
    frame = render(scene, settings)
    larger = replace(scene, size=(2 * scene.size[0], 2 * scene.size[1]))
    finer = render(larger, replace(settings, antialiasing="none"))
    for sample in range(4):
        at = slice(sample // 2, None, 2), slice(sample % 2, None, 2)
        for buffer in ("color", "depth", "primitive", "cover_count"):
            assert np.array_equal(
                getattr(frame.samples, buffer)[sample],
                getattr(finer, buffer)[at],
                equal_nan=buffer == "color",
            )
    assert np.array_equal(frame.attributes, finer.attributes[::2, ::2])


def test_one_sample_across_is_the_centre_with_nothing_to_average():
    scene = SCENES["clip"]
    for center, rule in product(("half", "integer"), ("box", "tent")):
        plain = Settings(coverage="float16", pixel_center=center, resolve_filter=rule)
        one = replace(plain, antialiasing="ssaa-n", samples_across=1)
        assert render(scene, one).color.tobytes() == render(scene, plain).color.tobytes()


@pytest.mark.parametrize("resolve_filter", ["box", "tent"])
@pytest.mark.parametrize("side", range(2, 9))
def test_any_number_of_samples_across(side, resolve_filter):
    scene = SCENES["lit"]
    settings = Settings(antialiasing="ssaa-n", samples_across=side, resolve_filter=resolve_filter)
    frame = render(scene, settings)
    larger = render(replace(scene, size=(side * scene.size[0], side * scene.size[1])))
    assert np.array_equal(frame.samples.primitive[-1], larger.primitive[side - 1 :: side, side - 1 :: side])
    assert np.array_equal(frame.samples.color[0], larger.color[::side, ::side])
    named = {2: "ssaa-4", 4: "ssaa-16"}.get(side)
    if named is not None and resolve_filter == "box":
        same = render(scene, replace(settings, antialiasing=named))
        assert frame.color.tobytes() == same.color.tobytes()
        pictures = [draw_picture(scene, replace(settings, antialiasing=name)) for name in ("ssaa-n", named)]
        assert np.array_equal(pictures[0].pixels, pictures[1].pixels)
    picture = draw_picture(scene, settings)
    assert picture.route.visibility == "supersampled"
    assert np.abs(picture.pixels.astype(int) - to_display(frame.color).pixels).max() <= 2


@pytest.mark.parametrize("resolve_filter", ["box", "tent"])
@pytest.mark.parametrize("side", range(1, 9))
def test_a_picture_of_one_colour_keeps_it(side, resolve_filter):
    color = np.full((1, 3, 4), [0.1, 0.7, 1 / 3, 1])
    scene = ClipScene([[[-1, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]]], color, (5, 4))
    settings = Settings(antialiasing="ssaa-n", samples_across=side, resolve_filter=resolve_filter)
    assert (render(scene, settings).color == render(scene).color).all()


@pytest.mark.parametrize("wrong", [0, 9, 2.0, "3"])
def test_a_number_of_samples_that_cannot_be_is_refused(wrong):
    with pytest.raises(ValueError, match=f"samples_across must be a whole number from 1 to 8, got {wrong!r}"):
        Settings(samples_across=wrong)


@pytest.mark.parametrize("antialiasing", list(SIDES))
def test_the_box_averages_the_samples_of_a_pixel(antialiasing):
    frame = render(SCENES["lit"], Settings(antialiasing=antialiasing, blend="over"))
    mean = frame.samples.color.astype(float).mean(axis=0)
    assert np.abs(frame.color - mean).max() <= 1e-7


def test_centres_on_whole_numbers_have_their_samples_around_them():
    # A square of 3 x 3 pixels around the pixel whose centre is (4, 4): its border runs half-way to the neighbours.
    low, high = (2.5 / 8) * 2 - 1, (5.5 / 8) * 2 - 1
    corners = [[low, low, 0, 1], [high, low, 0, 1], [high, high, 0, 1], [low, high, 0, 1]]
    scene = ClipScene(
        [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]], size=(8, 8)
    )
    for antialiasing in ("ssaa-4", "ssaa-16", "ssaa-n", "msaa-4", "area"):
        frame = render(scene, Settings(antialiasing=antialiasing, pixel_center="integer"))
        wanted = np.zeros((8, 8))
        wanted[3:6, 3:6] = 1
        assert np.allclose(frame.color[..., 3], wanted, atol=1e-12), antialiasing


@every_pair(
    resolve_filter=["box", "tent"],
    antialiasing=["ssaa-4", "ssaa-16", "ssaa-n", "msaa-4", "area"],
    pixel_center=["half", "integer"],
)
def test_a_region_is_the_crop_of_the_picture(antialiasing, resolve_filter, pixel_center):
    scene = SCENES["clip"]
    settings = Settings(antialiasing=antialiasing, resolve_filter=resolve_filter, pixel_center=pixel_center)
    whole = render(scene, settings)
    for region in ((0, 0, 5, 4), (3, 2, 4, 5), (7, 4, 5, 5)):
        part = draw(scene, settings, make_raster(scene.size, pixel_center, region))
        at = slice(region[1], region[1] + region[3]), slice(region[0], region[0] + region[2])
        for buffer in ("color", "depth", "primitive", "attributes", "cover_count"):
            assert (
                getattr(part, buffer).tobytes() == np.ascontiguousarray(getattr(whole, buffer)[at]).tobytes()
            )


def test_bands_do_not_matter(monkeypatch):
    settings = Settings(antialiasing="ssaa-4", resolve_filter="tent")
    whole = render(SCENES["lit"], settings)
    monkeypatch.setattr(pipeline, "SAMPLE_BAND", 100)
    parts = render(SCENES["lit"], settings)
    assert parts.color.tobytes() == whole.color.tobytes()
    assert parts.statistics["shade"].outgoing == whole.statistics["shade"].outgoing


def test_a_picture_that_would_be_too_large_is_refused():
    scene = ClipScene([[[0, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 1]]], size=(5000, 10))
    with pytest.raises(ValueError, match="4 x 4 samples a pixel make 20000x40 samples of 5000x10 pixels"):
        render(scene, Settings(antialiasing="ssaa-16"))


@every_pair(
    encoding=["srgb", "linear"],
    resolve_filter=["box", "tent"],
    antialiasing=list(SIDES),
    name=["clip", "lit", "textured-clip"],
)
def test_the_fast_picture_is_near(name, antialiasing, resolve_filter, encoding):
    scene = SCENES[name]
    settings = Settings(antialiasing=antialiasing, resolve_filter=resolve_filter, fill="spans")
    picture = draw_picture(scene, settings, encoding=encoding)
    assert picture.route.visibility == "supersampled"
    wanted = to_display(render(scene, settings).color).pixels.astype(int)
    if encoding == "srgb":
        assert np.abs(picture.pixels - wanted).max() <= 2
    region = draw_picture(scene, settings, encoding=encoding, region=(3, 2, 5, 4))
    assert np.array_equal(region.pixels, picture.pixels[2:6, 3:8])


@pytest.mark.parametrize("antialiasing", ["msaa-4", "area"])
def test_other_pictures_take_the_plain_way(antialiasing):
    settings = Settings(antialiasing=antialiasing, fill="spans")
    picture = draw_picture(SCENES["lit"], settings, with_depth=True)
    assert picture.route.visibility == "frame"
    frame = render(SCENES["lit"], settings)
    assert np.array_equal(picture.pixels, to_display(frame.color).pixels)
    assert np.array_equal(picture.depth, frame.depth)


def test_resolving_is_the_rule():
    frame = render(SCENES["clip"], Settings(antialiasing="msaa-4", resolve_filter="tent"))
    from core.antialiasing.resolve import filter_weights

    weights = filter_weights(frame.samples.position, "tent")
    assert np.array_equal(resolve_samples(frame.samples.color, weights), frame.color)
