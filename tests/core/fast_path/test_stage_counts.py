"""What a fast picture says of its stages is what the plain one says; every way of drawing has an estimate."""

from typing import get_args

import numpy as np
import pytest

from core import STAGES, ClipScene, Settings, render
from core.fast_path.draw import draw_picture
from core.fast_path.draw_context import Coloring, Visibility
from core.fast_path.workers.band_workers import BandWorkers
from core.fast_path.workers.sharing import COLOR, FRAGMENT
from lessons.scenes import make_scene
from tests.covering import in_turns

SETTINGS = {
    "one sample": Settings(),
    "samples": Settings(antialiasing="ssaa-4"),
    "multisampled": Settings(antialiasing="msaa-4"),
    "blended": Settings(blend="over"),
    "blended samples": Settings(blend="over", antialiasing="msaa-4"),
    "no depth test": Settings(blend="over", visibility="last-drawn"),
}


@in_turns(
    settings=list(SETTINGS.values()),
    name=["single-triangle", "shared-edge", "near-plane", "intersecting", "cube"],
)
def test_a_fast_picture_counts_as_the_plain_one_does(name: str, settings: Settings) -> None:
    scene = make_scene(name)
    plain, fast = render(scene, settings).statistics, draw_picture(scene, settings).statistics
    for stage in STAGES:
        found = fast[stage].incoming, fast[stage].outgoing
        assert found == (plain[stage].incoming, plain[stage].outgoing), stage


@pytest.mark.parametrize("settings", SETTINGS.values(), ids=SETTINGS)
def test_what_comes_out_of_a_stage_goes_into_the_next(settings: Settings) -> None:
    counts = render(make_scene("intersecting"), settings).statistics
    assert counts["bin"].outgoing == counts["raster"].outgoing == counts["depth"].incoming
    assert counts["depth"].outgoing == counts["blend"].incoming


def test_the_pixels_of_a_blended_picture_are_counted_once() -> None:
    route = draw_picture(make_scene("intersecting"), SETTINGS["blended"]).route
    seen = render(make_scene("intersecting"), SETTINGS["blended"]).primitive >= 0
    assert route.visible == seen.sum() < route.split.fragments
    assert route.depth_complexity > 1


def test_every_way_of_drawing_has_an_estimate() -> None:
    assert set(FRAGMENT) == set(get_args(Visibility))
    assert set(COLOR) == set(get_args(Coloring))


def test_workers_take_multisampled_pictures() -> None:
    scene = make_scene("single-triangle")
    with BandWorkers(1) as workers:
        picture = workers.draw(scene, SETTINGS["multisampled"])
    assert picture.route.visibility == "multisampled"


@pytest.mark.parametrize(("count", "visibility"), [(1, "layer"), (20, "packed-depth")])
def test_the_rows_of_large_triangles_take_time_of_the_stage_bin(count: int, visibility: str) -> None:
    corners = np.array([[[-1.0, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1]]] * count)
    scene = ClipScene(corners, np.ones((count, 3, 4)), (500, 500))
    picture = draw_picture(scene, Settings(depth="fixed-38"))
    assert picture.route.visibility == visibility
    assert picture.route.split.big == count
    assert picture.statistics["bin"].seconds > 0
