"""Temporal antialiasing: at rest it is supersampling; ghosts and their end; listings, rows and the picture agree."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.files.state_motion import motion_of, motion_record
from core import ClipScene, Settings, render, trace
from core.antialiasing.moving import place_before, scene_before
from core.antialiasing.temporal import (
    HistoryRule,
    blended_history,
    ghost_length,
    halton,
    look_up,
    mix_pictures,
    range_around,
    sample_point,
)
from core.coverage.pixel_runs import Raster
from core.framebuffer.display import to_display
from core.pipeline import draw, mixed_pictures
from core.records.motion import Motion
from core.trace.source import TraceSource
from lessons.scenes import make_scene
from tests.core.strategies import ANY_TRIANGLES

TEMPORAL = Settings(antialiasing="temporal", pictures=4, blend_share=1, cull="none")
BAR = make_scene("bar-and-wire")


def moved(scene: ClipScene, point: tuple[float, float]) -> ClipScene:
    """Return the scene moved so that a point of each pixel comes to its centre."""
    clip, (width, height) = scene.clip.copy(), scene.size
    clip[..., 0] += 2 * (0.5 - point[0]) / width * clip[..., 3]
    clip[..., 1] += 2 * (0.5 - point[1]) / height * clip[..., 3]
    return replace(scene, clip=clip)


@given(st.integers(0, 10_000), st.sampled_from([2, 3]))
def test_halton_numbers_reverse_the_digits(index: int, base: int) -> None:
    digits, rest = [], index
    while rest:
        rest, digit = divmod(rest, base)
        digits.append(digit)
    assert halton(index, base) == pytest.approx(sum(d * base ** -(k + 1) for k, d in enumerate(digits)))


def test_points_lie_on_the_grid_of_snapping_and_the_last_picture_has_the_centre() -> None:
    points = np.array([sample_point(k) for k in range(64)])
    assert np.array_equal(points * 256, np.floor(points * 256))
    assert points.min() >= 0
    assert points.max() < 1
    assert points[0].tolist() == [0.5, 0.5]
    assert len(np.unique(points, axis=0)) == 64
    for scene in (BAR, make_scene("near-plane")):
        plain = render(scene, replace(TEMPORAL, antialiasing="none"))
        frame = render(scene, TEMPORAL)
        for name in ("depth", "primitive", "attributes", "cover_count"):
            assert np.array_equal(getattr(frame, name), getattr(plain, name))


@given(ANY_TRIANGLES, st.integers(1, 5), st.sampled_from(["kept", "reprojected"]))
def test_at_rest_it_is_the_mean_of_the_pictures_of_the_same_points(case, pictures: int, history: str) -> None:
    clip, size = case
    clip = clip.copy()
    clip[..., 3] = 1.0
    scene = ClipScene(clip, np.random.default_rng(1).random((len(clip), 3, 4)), size)
    settings = replace(TEMPORAL, pictures=pictures, history=history, interpolation="flat")
    plain = replace(settings, antialiasing="none")
    each = [render(moved(scene, sample_point(k)), plain).color.astype(float) for k in range(pictures)]
    assert np.allclose(render(scene, settings).color, np.mean(each, axis=0), rtol=1e-6, atol=1e-6)


def test_a_constant_share_keeps_its_variance() -> None:
    # Independent samples that hit with p: the variance is p (1 - p) a / (2 - a), as of 2/a - 1 samples.
    p, share, count = 0.3, 0.1, 64
    hits = (np.random.default_rng(0).random((count, 10_000)) < p).astype(np.float32)
    rule = HistoryRule(follows_camera=False, is_clamped=False)

    def draw_hits(age: int, point: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
        return np.repeat(hits[age].reshape(1, -1, 1), 4, axis=2), np.zeros((1, 10_000))

    kept = mix_pictures(BAR, rule, count, share, (0.5, 0.5), draw_hits)[-1].kept[..., 0]
    assert kept.var() == pytest.approx(p * (1 - p) * share / (2 - share), rel=0.05)


def test_a_bar_leaves_a_ghost_and_clamping_takes_it_with_the_wire() -> None:
    settings = replace(TEMPORAL, pictures=32, blend_share=10)
    kept, clamped = (
        render(BAR, replace(settings, history=name)).color[..., 0] for name in ("kept", "clamped")
    )
    assert kept[10, [54, 50, 46]].tolist() == pytest.approx([0.1, 0.19, 0.271])
    passed = [0.271 * 0.9**k for k in range(1, 8)]
    assert kept[10, [42 - 4 * k for k in range(7)]].tolist() == pytest.approx(passed)
    assert not clamped[10, :42].any()
    wire = render(BAR, replace(settings, antialiasing="area")).color[16:, :, 0]
    assert np.abs(kept[16:] - wire).mean() < 0.5 * np.abs(clamped[16:] - wire).mean()
    assert [ghost_length(share) for share in (0.5, 0.2, 0.1, 0.05)] == [8, 25, 53, 109]


def test_a_camera_that_moves_finds_its_history_by_depth() -> None:
    floor = make_scene("textured-floor")
    scene = replace(floor, size=(48, 36), motion=Motion(camera=(0.07, 0.0, 0.02)))
    settings = replace(TEMPORAL, pictures=8, blend_share=10)
    last = replace(scene, motion=None)
    wanted = render(last, replace(settings, pictures=32, blend_share=1)).color
    error = {
        name: np.abs(render(scene, replace(settings, history=name)).color - wanted).mean()
        for name in ("kept", "reprojected")
    }
    assert error["reprojected"] < 0.8 * error["kept"]
    # Where a point of the world was seen before: by the matrices of both cameras.
    x = np.array([[10.5]])
    y = np.array([[8.5]])
    depth = render(last, Settings()).depth[8:9, 10:11].astype(float)
    column, row = place_before(scene, 0, x, y, depth)
    world = unprojected(last, x, y, depth)
    assert np.allclose(projected(scene_before(scene, 1), world), [column.item(), row.item()])


def clip_of_world(scene) -> np.ndarray:
    vertices = TraceSource(scene, Settings()).geometry.vertices
    return vertices.projection @ vertices.view


def projected(scene, world: np.ndarray) -> np.ndarray:
    clip = clip_of_world(scene) @ world
    return (clip[:2] / clip[3] + 1) / 2 * np.array(scene.size)


def unprojected(scene, x: np.ndarray, y: np.ndarray, depth: np.ndarray) -> np.ndarray:
    width, height = scene.size
    ndc = [2 * x.item() / width - 1, 2 * y.item() / height - 1, 2 * depth.item() - 1, 1.0]
    world = np.linalg.solve(clip_of_world(scene), ndc)
    return world / world[3]


def test_a_part_of_the_picture_is_that_of_the_whole() -> None:
    floor = replace(make_scene("textured-floor"), size=(32, 24), motion=Motion(camera=(0.1, 0.0, 0.0)))
    for scene in (BAR, floor):
        for history in ("kept", "clamped"):
            settings = replace(TEMPORAL, history=history)
            part = draw(scene, settings, Raster(*scene.size, 0.5, region=(5, 4, 9, 7)))
            assert np.array_equal(part.color, render(scene, settings).color[4:11, 5:14])


@pytest.mark.parametrize("history", ["kept", "reprojected", "clamped"])
def test_the_listing_gives_the_rows_and_the_rows_the_picture(history: str) -> None:
    floor = replace(make_scene("textured-floor"), size=(12, 9), motion=Motion(camera=(0.4, 0.0, 0.0)))
    for scene in (replace(BAR, size=(32, 12)), floor):
        settings = replace(TEMPORAL, history=history, blend_share=30)
        found, frame = trace(scene, settings).stage("resolve"), render(scene, settings)
        ends = found.state(found.steps.count)
        assert np.array_equal(ends["color"], frame.color)
        assert np.array_equal(ends["display"], to_display(frame.color).pixels)
        c, kinds = found.columns, [found.kind_of(row) for row in range(found.steps.row_count)]
        assert ("outside" in kinds) == (scene is floor and history != "kept")
        for row in range(0, found.steps.row_count, 37):
            if kinds[row] not in ("mixed", "limited"):
                continue
            numbers = zip(*(c[name][row].tolist() for name in ("new", "history", "low", "high")), strict=True)
            k, is_clamped = int(c["picture"][row]), kinds[row] == "limited"
            values = [blended_history(*each, k, 0.3, is_clamped) for each in numbers]
            assert values == c["kept"][row].tolist()
            assert sample_point(int(c["age"][row])) == tuple(c["point"][row])


def test_ranges_and_positions_between_pixels_are_those_of_loops() -> None:
    picture = np.random.default_rng(2).random((4, 5, 4)).astype(np.float32)
    low, high = range_around(picture)
    for row, column in ((0, 0), (2, 3), (3, 4)):
        near = picture[max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2].reshape(-1, 4)
        assert np.array_equal(low[row, column], near.min(axis=0).astype(float))
        assert np.array_equal(high[row, column], near.max(axis=0).astype(float))
    columns, rows = np.array([[1.25, -0.6]]), np.array([[2.5, 1.0]])
    found, is_inside = look_up(picture.astype(float), columns, rows)
    corners = picture[2:4, 1:3].astype(float)
    weights = np.outer([0.5, 0.5], [0.75, 0.25])
    assert np.allclose(found[0, 0], (weights[..., None] * corners).sum(axis=(0, 1)))
    assert is_inside.tolist() == [[True, False]]


def test_motion_is_kept_in_files_and_wrong_ones_are_named() -> None:
    for motion in (None, BAR.motion, Motion((0.5, 0.0, -1.0), ((2, (0.0, 1.0, 0.0)),))):
        assert motion_of(motion_record(motion)) == motion
    with pytest.raises(ValueError, match="motion of object 3 must be 3 finite numbers, got"):
        Motion(objects=((3, (0.0, float("nan"), 0.0)),))
    # What has gone moves no more.
    few = replace(BAR, clip=BAR.clip[:1], attributes=BAR.attributes[:1])
    assert np.array_equal(scene_before(few, 2).clip, scene_before(BAR, 2).clip[:1])
    pictures, _ = mixed_pictures(few, TEMPORAL, Raster(*few.size, 0.5))
    assert len(pictures) == 4
