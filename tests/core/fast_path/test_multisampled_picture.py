"""The fast way to a multisampled picture has the bytes of the plain one, whatever is drawn."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, draw_picture, render
from core.coverage.number_formats import number_format
from core.families import decides_itself
from core.fast_path import sampled
from core.framebuffer.display import encode_linear, to_display
from core.methods import table
from lessons.scenes import make_scene
from tests.core.strategies import ANY_TRIANGLES
from tests.core.trace.trace_cases import EACH_METHOD, SCENES, name_of, settings_of
from tests.covering import every_nth, in_turn

SAMPLED = [
    {family: name for family, name in each.items() if family != "antialiasing"} for each in EACH_METHOD
]


def is_like_the_plain_one(scene, settings, encoding="srgb") -> bool:
    """Compare the bytes; the fast way must have been taken."""
    picture, color = draw_picture(scene, settings, encoding=encoding), render(scene, settings).color
    wanted = to_display(color).pixels if encoding == "srgb" else encode_linear(color)
    return picture.route.visibility == "multisampled" and np.array_equal(picture.pixels, wanted)


NAMES = list(product(["lit", "clip", "orthographic", "textured-clip", "intersecting"], ["box", "tent"]))


@pytest.mark.parametrize(("shown", "choice"), in_turn(NAMES, SAMPLED), ids=name_of)
def test_every_choice_has_the_bytes_of_the_plain_way(shown, choice):
    name, resolve_filter = shown
    scene = SCENES[name]
    settings = settings_of(choice | {"antialiasing": "msaa-4", "resolve_filter": resolve_filter}, scene)
    picture = draw_picture(scene, settings)
    assert np.array_equal(picture.pixels, to_display(render(scene, settings).color).pixels)
    is_plain = (
        settings.fill != "spans"
        or settings.blend != "opaque"
        or settings.polygon_mode != "fill"
        or decides_itself(settings.visibility)
        or not number_format(settings.coverage).suits_spans
    )
    assert picture.route.visibility == ("frame" if is_plain else "multisampled")


@pytest.mark.parametrize("encoding", every_nth(["srgb", "linear"], 2))
@pytest.mark.parametrize("shading", table.names("shading"))
@pytest.mark.parametrize("name", ["torus", "cube"])
def test_meshes_have_the_bytes_of_the_plain_way(name, shading, encoding):
    scene = replace(make_scene(name), size=(150, 110))
    assert is_like_the_plain_one(scene, Settings(antialiasing="msaa-4", shading=shading), encoding)


@given(
    ANY_TRIANGLES,
    st.sampled_from(table.names("depth")),
    st.sampled_from(["box", "tent"]),
    st.sampled_from(["half", "integer"]),
)
def test_any_triangles_have_the_bytes_of_the_plain_way(drawn, depth, resolve_filter, pixel_center):
    clip, size = drawn
    colors = np.random.default_rng(len(clip)).random((len(clip), 3, 4))
    scene = ClipScene(clip, colors, size, background=np.array([0.2, 0.4, 0.6, 1.0]))
    settings = Settings(
        antialiasing="msaa-4", depth=depth, resolve_filter=resolve_filter, pixel_center=pixel_center
    )
    assert is_like_the_plain_one(scene, settings)


@pytest.mark.parametrize("resolve_filter", ["box", "tent"])
def test_a_region_is_the_crop_whatever_the_bands(monkeypatch, resolve_filter):
    scene = replace(make_scene("torus"), size=(64, 48))
    settings = Settings(antialiasing="msaa-4", resolve_filter=resolve_filter)
    whole = draw_picture(scene, settings).pixels
    monkeypatch.setattr(sampled, "PIXELS_OF_BAND", 200)
    assert np.array_equal(draw_picture(scene, settings).pixels, whole)
    for column, row, columns, rows in ((0, 0, 20, 48), (13, 7, 30, 20), (50, 40, 14, 8)):
        part = draw_picture(scene, settings, region=(column, row, columns, rows))
        assert part.route.visibility == "multisampled"
        assert np.array_equal(part.pixels, whole[row : row + rows, column : column + columns])


def test_light_above_one_is_averaged_before_it_is_cut_off():
    bright = np.full((1, 3, 4), [3.0, 0.5, 0.0, 1.0])
    scene = ClipScene([[[-1, -1, 0, 1], [0.9, -1, 0, 1], [-1, 0.8, 0, 1]]], bright, (5, 4))
    assert is_like_the_plain_one(scene, Settings(antialiasing="msaa-4"))
    picture = draw_picture(scene, Settings(antialiasing="msaa-4"))
    # Half of the samples of a pixel on the edge: 1.5 of red is cut off only after the mean.
    assert ((picture.pixels[..., 0] == 255) & (picture.pixels[..., 3] < 255)).any()


def test_a_picture_with_its_depth_takes_the_plain_way():
    settings = Settings(antialiasing="msaa-4")
    picture = draw_picture(SCENES["lit"], settings, with_depth=True)
    assert picture.route.visibility == "frame"
    assert np.array_equal(picture.depth, render(SCENES["lit"], settings).depth)


def test_light_is_cut_off_where_samples_end_at_a_limit_and_differ():
    pairs = [(0, 0), (0, 5), (5, 7), (255, 255), (5, 255), (0, 255)]
    samples = np.zeros((2, 1, len(pairs), 4), np.uint8)
    samples[:, 0, :, 1] = np.transpose(pairs)
    usual, unusual = (sampled.is_cut_off(samples, 0, is_unusual)[0].tolist() for is_unusual in (False, True))
    assert usual == [False, False, False, False, True, True]
    assert unusual == [False, True, False, False, True, True]
    assert sampled.is_cut_off(samples, 1, False)[0].tolist() == [False, False, True, True, True, True]
