"""Pictures drawn by several processes: the same bytes as drawn by one."""

import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from core import Camera, draw_picture
from core.fast_path.draw_context import Route
from core.fast_path.workers.band_workers import BandWorkers
from core.fast_path.workers.sharing import have_colors_of_whole, joined_route
from tests.core.fast_path.band_scenes import SCENES, SPANS, ball, textured_ball
from tests.covering import every_nth, in_turn


@pytest.fixture(scope="module")
def workers() -> Iterator[BandWorkers]:
    with BandWorkers(2, always=True) as started:
        assert started.start(), started.failure
        yield started
        assert started.failure == ""


@pytest.mark.parametrize(("name", "encoding"), every_nth(in_turn(SCENES, ["srgb", "linear"]), 3))
def test_two_processes_draw_the_bytes_of_one(workers: BandWorkers, name: str, encoding: str) -> None:
    scene, settings = SCENES[name]
    alone = draw_picture(scene, settings, encoding=encoding)
    for _ in range(3):  # the cut between the bands moves
        together = workers.draw(scene, settings, encoding)
        np.testing.assert_array_equal(together.pixels, alone.pixels)
        assert together.statistics["raster"].outgoing == alone.statistics["raster"].outgoing
        assert together.statistics["cull"].outgoing == alone.statistics["cull"].outgoing
        assert together.route.visible == alone.route.visible
        assert together.route.color == alone.route.color
    assert workers.sharing.process_count == 2 or "too few" in workers.sharing.reason
    assert not together.pixels.flags.writeable


def test_colours_that_one_band_needs_are_those_of_all_bands_and_later_again_the_cheap_ones() -> None:
    smooth, near = textured_ball(), textured_ball(with_near_triangle=True)
    assert draw_picture(near, region=(0, 0, 220, 100)).route.color == "lit"
    expected = {id(scene): draw_picture(scene) for scene in (smooth, near)}
    assert [expected[id(scene)].route.color for scene in (smooth, near)] == ["lit", "deferred"]
    assert (expected[id(near)].pixels[:90] != expected[id(smooth)].pixels[:90]).any()
    with BandWorkers(2, always=True) as workers:
        assert workers.start(), workers.failure
        for scene in (smooth, near, near, smooth, smooth, near):
            together = workers.draw(scene)
            np.testing.assert_array_equal(together.pixels, expected[id(scene)].pixels)
            assert together.route.color == expected[id(scene)].route.color
            assert workers.sharing.process_count == 2


@pytest.mark.parametrize(
    ("allowed", "with_cheap", "with_plain"),
    [
        (["corners", "corners"], True, False),
        (["corners", "deferred"], False, True),
        (["corners", "palette"], True, False),
        (["palette", "palette"], True, False),
        (["palette", "deferred"], True, True),
        (["deferred", "deferred"], True, True),
        (["", "lit"], True, False),
    ],
)
def test_bands_have_the_colours_of_the_whole(allowed: list[str], with_cheap: bool, with_plain: bool) -> None:
    routes = [Route("packed-depth", name or "lit", visible=1, allowed=name) for name in allowed]
    assert have_colors_of_whole(routes, plain_colors=False) == with_cheap
    assert have_colors_of_whole(routes, plain_colors=True) == with_plain


@pytest.mark.parametrize(
    ("colors", "joined"),
    [
        (["corners", "corners"], "corners"),
        (["palette", "deferred"], "deferred"),
        (["palette", "palette"], "palette"),
    ],
)
def test_the_route_of_a_picture_is_that_of_the_bands_that_show_something(colors, joined: str) -> None:
    nothing = Route("packed-depth", "lit", visible=0, allowed="palette")
    routes = [Route("layer", color, visible=1, allowed=color) for color in colors]
    for parts in (routes, [nothing, *routes], [*routes, nothing]):
        route = joined_route(parts)
        assert (route.color, route.visibility, route.visible) == (joined, "layer", 2)
    assert joined_route([*routes, replace(routes[1], visibility="packed-depth")]).visibility == "packed-depth"
    assert joined_route([nothing, nothing]) == nothing


@pytest.mark.parametrize("name", every_nth(SCENES, 4))
def test_two_processes_find_the_depth_that_one_finds(workers: BandWorkers, name: str) -> None:
    scene, settings = SCENES[name]
    count = scene.size[0] * scene.size[1]
    places = np.random.default_rng(3).integers(0, count, 500)
    alone = draw_picture(scene, settings, depth_at=places)
    together = workers.draw(scene, settings, depth_at=places)
    np.testing.assert_array_equal(together.pixels, alone.pixels)
    assert together.depth.dtype == alone.depth.dtype
    np.testing.assert_array_equal(together.depth, alone.depth)
    assert not together.depth.flags.writeable
    assert workers.draw(scene, settings).pixels.tobytes() == alone.pixels.tobytes()


def test_bands_without_pixels_whose_depth_is_asked_for(workers: BandWorkers) -> None:
    scene = ball(size=(75, 61))
    for places in (np.arange(75), np.arange(60 * 75, 61 * 75), np.zeros(0, np.int64)):
        depth = workers.draw(scene, SPANS, depth_at=places).depth
        np.testing.assert_array_equal(
            depth, draw_picture(scene, SPANS, with_depth=True).depth.ravel()[places]
        )


@pytest.mark.parametrize("depth_at", [None, np.array([3, 3, 4000])], ids=["no depth", "depth"])
def test_pixels_go_to_the_memory_that_is_given(workers: BandWorkers, depth_at) -> None:
    scene = ball(size=(75, 61))
    out = np.zeros((61, 75, 4), np.uint8)
    picture = workers.draw(scene, SPANS, depth_at=depth_at, out=out)
    assert np.shares_memory(picture.pixels, out)
    np.testing.assert_array_equal(out, draw_picture(scene, SPANS).pixels)
    assert workers.sharing.process_count == 2


@pytest.mark.parametrize(
    "out",
    [
        np.zeros((62, 75, 4), np.uint8),
        np.zeros((61, 75, 4), np.int8),
        np.zeros((61, 75, 8), np.uint8)[:, :, ::2],
    ],
    ids=["shape", "type", "gaps"],
)
def test_memory_that_does_not_fit_is_refused_for_the_whole_picture(workers: BandWorkers, out) -> None:
    pids = workers.pids
    with pytest.raises(ValueError, match=r"out must be \(61, 75, 4\)"):
        workers.draw(ball(size=(75, 61)), SPANS, out=out)
    assert workers.pids == pids


def test_depth_outside_of_the_picture_is_refused_as_by_one_process(workers: BandWorkers) -> None:
    scene = ball()
    for places, wrong in (([0, 96 * 80], "0 to 7680"), ([-3, 5], "-3 to 5")):
        with pytest.raises(ValueError, match=f"got {wrong}"):
            workers.draw(scene, SPANS, depth_at=np.array(places))


@pytest.mark.slow
def test_three_processes_draw_the_bytes_of_one() -> None:
    scene = ball(size=(70, 50))
    with BandWorkers(3, always=True) as workers:
        assert workers.start()
        for step in range(4):
            turned = replace(scene, camera=replace(scene.camera, eye=np.array([step * 0.3, 0.5, 2.5])))
            np.testing.assert_array_equal(
                workers.draw(turned, SPANS).pixels, draw_picture(turned, SPANS).pixels
            )
        bands = workers.sharing.bands
        assert [band.first for band in bands] == [0, bands[0].end, bands[1].end]
        assert bands[2].end == 50


def test_a_picture_stays_when_the_next_one_is_drawn_and_the_workers_are_closed() -> None:
    with BandWorkers(2, always=True) as workers:
        assert workers.start()
        first = workers.draw(ball(), SPANS)
        kept = first.pixels.copy()
        workers.draw(ball(size=(400, 300)), SPANS)  # also asks for more memory
        workers.draw(ball(eye=(2.0, 0.0, 2.0)), SPANS)
    np.testing.assert_array_equal(first.pixels, kept)


def test_a_scene_that_is_refused_is_refused_here_and_the_workers_stay(workers: BandWorkers) -> None:
    flat_camera = Camera(np.array([0.0, 0.0, 3.0]), np.zeros(3), projection="orthographic")
    pids = workers.pids
    with pytest.raises(ValueError, match="needs a perspective camera"):
        workers.draw(ball(camera=flat_camera), replace(SPANS, depth="inverse-w"))
    with pytest.raises(ValueError, match="encoding must be"):
        workers.draw(ball(), SPANS, "cmyk")
    assert workers.draw(ball(), SPANS).route.visible > 0
    assert workers.pids == pids


def test_threads_draw_at_the_same_time(workers: BandWorkers) -> None:
    scenes = [ball(eye=(0.3 * step, 0.4, 2.5)) for step in range(8)]
    with ThreadPoolExecutor(4) as pool:
        pictures = list(pool.map(lambda scene: workers.draw(scene, SPANS), scenes))
    for scene, picture in zip(scenes, pictures, strict=True):
        np.testing.assert_array_equal(picture.pixels, draw_picture(scene, SPANS).pixels)


def test_small_pictures_stay_in_one_process() -> None:
    with BandWorkers(2) as workers:
        for _ in range(3):
            workers.draw(ball(), SPANS)
        assert workers.pids == ()
        assert workers.sharing.process_count == 1
        assert "not worth it" in workers.sharing.reason


@pytest.mark.slow
def test_large_pictures_start_the_workers_and_do_not_wait_for_them() -> None:
    scene = ball(size=(700, 700))
    with BandWorkers(2) as workers:
        workers.draw(scene, SPANS)
        assert "first picture" in workers.sharing.reason
        workers.draw(scene, SPANS)
        assert "being started" in workers.sharing.reason
        assert len(workers.pids) == 1
        deadline = time.monotonic() + 120
        reasons = set()
        while workers.sharing.process_count == 1 and time.monotonic() < deadline:
            picture = workers.draw(scene, SPANS)
            reasons.add(workers.sharing.reason)
            time.sleep(0.2)
        assert reasons <= {"the worker processes are being started", "one process is timed first", ""}
        assert workers.sharing.process_count == 2
        assert workers.sharing.gain > 0
        np.testing.assert_array_equal(picture.pixels, draw_picture(scene, SPANS).pixels)
