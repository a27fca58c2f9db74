import threading
from dataclasses import replace
from functools import partial
from typing import get_args

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from app.session.document import open_document
from app.views.scene_frames import (
    COLORS,
    VISIBILITIES,
    FrameFigures,
    SceneWorker,
    drawing_text,
    figures_text,
    fixed_size,
    size_choices,
)
from app.views.scene_picture import (
    HiddenBacks,
    SceneShot,
    SpaceLine,
    draw_scene,
    find_line_pixels,
    paint_lines,
    sight_places,
    triangle_seen,
    visible_part,
)
from app.views.view_space import make_space, thinned, viewed_scene, viewing_camera
from core import STAGES, Settings, render
from core.culling.culling import plane_distances
from core.fast_path.draw import draw_picture
from core.fast_path.draw_context import Coloring, Route, Split, Visibility
from core.fast_path.workers.band_workers import BandWorkers
from core.fast_path.workers.sharing import BandTime, Sharing
from core.records.frame import StageCount
from core.transform.vertex_stage import transform_vertices
from lessons.scenes import make_scene
from widgets.basics.theme import LIGHT
from widgets.space.orbit import fitted


@given(arrays(np.float64, (3, 2, 4), elements=st.integers(-256, 256).map(lambda number: number / 64)))
def test_cut_segments_are_inside_and_on_their_segments(clip):
    cut, source = visible_part(clip)
    assert (plane_distances(cut) >= -1e-9).all()
    assert (cut[..., 3] > 0).all()
    for (start, end), k in zip(cut, source, strict=True):
        whole = clip[k, 1] - clip[k, 0]
        for point in (start, end):
            t = (point - clip[k, 0]) @ whole / max(whole @ whole, 1e-300)
            assert np.allclose(clip[k, 0] + t * whole, point, atol=1e-9)
    # What is dropped has no inside point among many (an end at w = 0 is the viewer's own eye: no line).
    for k in sorted(set(np.flatnonzero((clip[..., 3] != 0).all(axis=1)).tolist()) - set(source.tolist())):
        along = np.linspace(0, 1, 33)[:, None]
        assert not (plane_distances(clip[k, 0] + along * (clip[k, 1] - clip[k, 0])) > 1e-6).all(axis=1).any()


def paint(pixels, depth, lines, colors, inverse_w=np.reciprocal):
    """Paint lines over pixels whose depth buffer is known, along the axes of the space."""
    height, width = depth.shape
    found = find_line_pixels(lines, np.eye(4), (width, height))
    paint_lines(pixels, found, inverse_w(depth.reshape(-1)[found.depth_at]), lines, colors)


def test_hidden_parts_are_faint():
    pixels = np.zeros((5, 9, 4), np.uint8)
    depth = np.full((5, 9), 10.0)
    depth[:, 4:] = 0.5  # something at w = 0.5, nearer than the line at w = 1
    line = SpaceLine(np.array([[-1.0, 0, 0], [1, 0, 0]]), "text", hidden=0.25)
    paint(pixels, depth, (line,), ["#ffffff"])
    assert pixels[2, 0:4, 0].tolist() == [255] * 4
    assert set(pixels[2, 5:, 0].tolist()) == {64}
    assert pixels[[0, 1, 3, 4]].max() == 0


def test_thick_lines_and_points_that_are_not_finite():
    pixels = np.zeros((6, 6, 4), np.uint8)
    points = np.array([[-0.9, -0.5, 0], [0.9, -0.5, 0], [np.nan, 0, 0], [1e300, 0, 0]])
    far = np.full((6, 6), 100.0)
    paint(pixels, far, (SpaceLine(points, "text", 2),), ["#0000ff"])
    assert (pixels[..., 2] > 0).any(axis=1).tolist() == [False, True, True, False, False, False]
    before = pixels.copy()
    paint(pixels, far, (), [])
    assert np.array_equal(pixels, before)


def test_a_later_line_lies_over_an_earlier_one_and_each_has_its_thickness_across():
    pixels, far = np.zeros((8, 8, 4), np.uint8), np.full((8, 8), 100.0)
    level = SpaceLine(np.array([[-1.0, 0, 0], [1, 0, 0]]), "text", 2)
    upright = SpaceLine(np.array([[0.0, -1, 0], [0, 1, 0]]), "text", 3)
    paint(pixels, far, (level, upright), ["#ff0000", "#00ff00"])
    assert (pixels[:, 0, 0] == 255).sum() == 2
    assert (pixels[0, :, 1] == 255).sum() == 3
    green = np.flatnonzero(pixels[0, :, 1])
    assert set(pixels[:, green, 1].ravel().tolist()) == {255}
    assert pixels[:, green, 0].max() == 0


def test_the_depth_of_a_line_is_asked_for_at_its_pixels_and_those_beside():
    line = SpaceLine(np.array([[-1.0, -1, 0], [1, 1, 0]]), "text")
    found = find_line_pixels((line,), np.eye(4), (7, 5))
    around = found.depth_at.reshape(5, -1)
    assert np.array_equal(around[0], found.row * 7 + found.column)
    for places, right, up in zip(around, (0, -1, 1, 0, 0), (0, 0, 0, -1, 1), strict=True):
        row, column = np.divmod(places, 7)
        assert np.array_equal(column, np.clip(found.column + right, 0, 6))
        assert np.array_equal(row, np.clip(found.row + up, 0, 4))


def test_only_the_last_waiting_picture_is_drawn(qtbot):
    worker = SceneWorker()
    begun, go = threading.Event(), threading.Event()
    ran: list[str] = []

    def slow() -> str:
        begun.set()
        go.wait(5)
        ran.append("first")
        return "first"

    def named(name: str) -> str:
        ran.append(name)
        return name

    told: list[object] = []
    worker.done.connect(told.append)
    worker.start(slow)
    begun.wait(5)
    worker.start(partial(named, "second"))
    worker.start(partial(named, "third"))
    assert worker.is_busy
    go.set()
    # The first one is shown too: while the user goes on turning, there is always something newer.
    qtbot.waitUntil(lambda: told == ["first", "third"])
    assert ran == ["first", "third"]
    assert not worker.is_busy
    worker.stop()


def test_what_is_forgotten_is_not_told(qtbot):
    worker = SceneWorker()
    begun, go = threading.Event(), threading.Event()

    def slow() -> str:
        begun.set()
        go.wait(5)
        return "old"

    told: list[object] = []
    worker.done.connect(told.append)
    worker.start(slow)
    begun.wait(5)
    worker.start(lambda: "old too")
    worker.forget()
    assert not worker.is_busy
    worker.start(lambda: "new")
    go.set()
    qtbot.waitUntil(lambda: told == ["new"])
    worker.stop()


def test_a_failure_is_told_and_the_next_picture_is_drawn(qtbot):
    worker = SceneWorker()

    def fail() -> object:
        raise MemoryError("no room")

    with qtbot.waitSignal(worker.failed) as told:
        worker.start(fail)
    assert "no room" in told.args[0]
    with qtbot.waitSignal(worker.done):
        worker.start(lambda: "a picture")
    worker.stop()
    worker.start(fail)
    assert not worker.is_busy


def shot_of(scene_name: str, size: tuple[int, int]) -> SceneShot:
    document = open_document(make_scene(scene_name), scene_name)
    space = make_space(document.traced_scene, transform_vertices(document.traced_scene))
    orbit = fitted(space.home, space.center, space.radius, size[0] / size[1])
    return SceneShot(space, space.scene, None, document.settings, orbit, size, None, 1.0, LIGHT)


def test_the_stages_of_a_frame_add_up_to_less_than_its_time():
    drawn = draw_scene(shot_of("torus", (320, 200)), BandWorkers(1), HiddenBacks())
    assert drawn.pixels.shape == (200, 320, 4)
    assert drawn.figures.size == (320, 200)
    assert tuple(drawn.figures.stages) == STAGES
    stages = sum(count.seconds for count in drawn.figures.stages.values())
    assert 0 < stages < drawn.figures.seconds
    assert drawn.figures.stages["transform"].incoming == drawn.figures.triangle_count


@pytest.mark.slow
def test_two_processes_draw_the_frame_of_one_with_its_lines():
    shot = shot_of("torus", (200, 150))
    alone = draw_scene(shot, BandWorkers(1), HiddenBacks())
    with BandWorkers(2, always=True) as workers:
        assert workers.start(), workers.failure
        together = draw_scene(shot, workers, HiddenBacks())
    assert np.array_equal(together.pixels, alone.pixels)
    assert together.figures.sharing.process_count == 2
    assert together.figures.route.color == alone.figures.route.color
    assert together.figures.route.visible == alone.figures.route.visible
    stages = sum(count.seconds for count in together.figures.stages.values())
    assert 0 < stages < together.figures.seconds


def test_a_frame_shares_the_meshes_of_its_scene():
    shot = shot_of("torus", (16, 12))
    camera = viewing_camera(shot.space, shot.orbit)
    viewed, _ = viewed_scene(shot.space, shot.scene, camera, shot.size, np.zeros(4))
    assert viewed.meshes is shot.scene.meshes


def test_a_thinned_scene_tells_the_triangles_of_the_document():
    whole = shot_of("torus", (64, 48))
    few, numbers = thinned(whole.scene, 500)
    shot = replace(whole, scene=few, numbers=numbers)
    viewed, _ = viewed_scene(shot.space, few, viewing_camera(shot.space, shot.orbit), shot.size, np.zeros(4))
    primitive = render(viewed).primitive
    row, column = np.argwhere(primitive >= 0)[7].tolist()
    assert triangle_seen(shot, column, row) == numbers[primitive[row, column]]
    row, column = np.argwhere(primitive < 0)[0].tolist()
    assert triangle_seen(shot, column, row) == -1


@pytest.mark.parametrize("size", [(160, 120), (10, 7)])
def test_distances_of_a_picture_are_those_of_what_is_seen(size):
    shot = shot_of("torus", size)
    found = draw_scene(shot, BandWorkers(1), HiddenBacks()).sight.distance
    camera = viewing_camera(shot.space, shot.orbit)
    viewed, _ = viewed_scene(shot.space, shot.scene, camera, size, np.zeros(4))
    inverse_w = render(viewed, Settings(depth="inverse-w")).depth.reshape(-1)[sight_places(size)]
    seen = inverse_w > 0
    assert seen.any()
    assert np.array_equal(np.isfinite(found), seen)
    # Of float32 depths, beside the outline worst.
    assert np.allclose(found[seen], 1 / inverse_w[seen], rtol=6e-4)


def test_places_of_distances_are_spread_over_the_picture():
    assert sight_places((4, 3)).tolist() == np.arange(12).reshape(3, 4).tolist()
    row, column = np.divmod(sight_places((960, 640)), 960)
    assert np.array_equal(column[0], 5 + 10 * np.arange(96))
    assert np.array_equal(row[:, 0], 5 + 10 * np.arange(64))


IN_ONE_PROCESS = Sharing()
BY_BUFFERS = Route("frame", "deferred")


def figures_of(
    size: tuple[int, int] = (1, 1),
    triangle_count: int = 1,
    seconds: float = 0.001,
    route: Route = BY_BUFFERS,
    sharing: Sharing = IN_ONE_PROCESS,
    are_backs_hidden: bool = False,
    stages: dict[str, StageCount] | None = None,
) -> FrameFigures:
    return FrameFigures(size, triangle_count, seconds, stages or {}, route, sharing, are_backs_hidden)


@pytest.mark.parametrize(
    ("seconds", "rate", "text"),
    [
        (0.0261, 38.2, "38 frames/s · 26.1 ms · 1024 × 768 · 81,920 triangles"),
        (0.4, 2.5, "2.5 frames/s · 400 ms · 1024 × 768 · 81,920 triangles"),
        (1.4031, None, "1,403 ms · 1024 × 768 · 81,920 triangles"),
    ],
)
def test_figures_as_text(seconds, rate, text):
    assert figures_text(figures_of((1024, 768), 81920, seconds), rate) == text
    assert figures_text(figures_of((1, 1), 1, 0.001), None) == "1.0 ms · 1 × 1 · 1 triangle"


def test_how_a_frame_was_drawn_as_text():
    route = Route("packed-depth", "lit", Split(67652, 3, 0, 798142), 399071)
    bands = (BandTime(0, 500, 0.0231), BandTime(500, 1024, 0.0228))
    stages = {stage: StageCount(seconds=0.001 * k) for k, stage in enumerate(STAGES)}
    assert drawing_text(figures_of(route=route, sharing=Sharing(bands), stages=stages)).splitlines() == [
        "Drawn by 2 processes: rows 0 to 499 in 23.1 ms, rows 500 to 1,023 in 22.8 ms.",
        "Seen: depth and triangle number packed in one word; the smallest is visible.",
        "Colours: light once per visible pixel, in single precision.",
        "Triangles: 67,652 along spans, 3 in bands, 0 one by one.",
        "Fragments: 798,142 for 399,071 pixels, depth complexity 2.00.",
        "Longest stages: Resolve 10.0 ms, Blend 9.0 ms, Depth 8.0 ms, Shade 7.0 ms.",
    ]
    failed = Sharing(reason="Traceback:\n  line\nKeyError: 1")
    assert drawing_text(figures_of(sharing=failed)).splitlines() == [
        "Drawn by one process: KeyError: 1.",
        "Seen: through all buffers.",
        "Colours: attributes and light once per visible pixel.",
    ]
    without_backs = drawing_text(figures_of(sharing=failed, are_backs_hidden=True)).splitlines()
    assert without_backs[-1] == "Back faces are left out: the meshes are closed and seen from outside."


@pytest.mark.parametrize("name", ["single-triangle", "torus", "textured-floor", "intersecting", "cube"])
def test_every_way_of_drawing_has_words(name):
    figures = draw_scene(shot_of(name, (64, 48)), BandWorkers(1), HiddenBacks()).figures
    assert drawing_text(figures).startswith("Drawn by one process: only one process is allowed.")


def test_every_route_has_words():
    assert set(VISIBILITIES) == set(get_args(Visibility))
    assert set(COLORS) == set(get_args(Coloring))


@pytest.mark.parametrize("antialiasing", ["ssaa-4", "msaa-4"])
def test_pictures_of_samples_have_words(antialiasing):
    route = draw_picture(make_scene("single-triangle"), Settings(antialiasing=antialiasing)).route
    assert f"Seen: {VISIBILITIES[route.visibility]}." in drawing_text(
        figures_of(route=route, sharing=Sharing(reason="it is small"))
    )


def test_sizes_that_can_be_chosen():
    choices = size_choices((24, 16))
    assert choices[1].title == "Size of the scene: 24 × 16"
    found = [fixed_size(choice.name, (24, 16)) for choice in choices]
    assert found[:2] == [None, (24, 16)]
    assert (1024, 1024) in found
    assert (1920, 1080) in found
    with pytest.raises(ValueError, match="size must be one of view"):
        fixed_size("huge", (24, 16))
