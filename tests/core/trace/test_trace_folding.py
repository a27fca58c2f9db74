"""Folding the rows of a trace gives the picture, bit for bit; going to and fro changes nothing."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import STAGES, ClipScene, Settings, render, trace
from core.coverage.pixel_runs import make_raster
from core.framebuffer.display import to_display
from core.methods import table
from core.pipeline import draw
from core.records.frame import Frame
from core.resolved import resolve
from core.settings import families
from core.stages.vertices import Before
from core.trace import Trace
from core.trace.source import TraceSource
from tests.core.strategies import ANY_TRIANGLES, BLOCK_SIZES
from tests.core.trace.trace_cases import (
    CASES,
    EACH_METHOD,
    SCENES,
    clip_scene,
    name_of,
    settings_of,
    small_region,
    small_scene,
)
from tests.covering import every_nth, in_turn

FOLDED = {"depth": ("depth", "depth"), "primitive": ("depth", "primitive"), "color": ("blend", "color")}
"""Buffer of the frame to stage and name of its track."""


def track_of(traced: Trace, stage: str, name: str):
    return next(track for track in traced.stage(stage).buffers if track.name == name)


def folded(traced: Trace, stage: str, name: str) -> np.ndarray:
    """Return a buffer after all rows."""
    return track_of(traced, stage, name).at(traced.stage(stage).steps.row_count)


def same_bits(found: np.ndarray, wanted: np.ndarray) -> bool:
    return found.dtype == wanted.dtype and found.shape == wanted.shape and found.tobytes() == wanted.tobytes()


def check_frame(traced: Trace, frame: Frame, crop: tuple[slice, slice] = (slice(None), slice(None))) -> None:
    """Compare everything that rows write with a picture."""
    is_plain = resolve(traced.source.settings).sampling.is_plain
    for name, (stage, track) in FOLDED.items():
        if name == "color" and not is_plain:
            # Several samples are blended apart, and exact areas are those of the last stage.
            stage = "resolve"
        wanted = np.ascontiguousarray(getattr(frame, name)[crop])
        found = folded(traced, stage, track)
        assert same_bits(found, wanted), f"{name}\n{found[::-1]}\n{wanted[::-1]}"
    for sample in range(0 if frame.samples is None else len(frame.samples.position)):
        for name, (stage, track) in FOLDED.items():
            wanted = np.ascontiguousarray(getattr(frame.samples, name)[sample][crop])
            assert same_bits(folded(traced, stage, f"{track} {sample}" if sample else track), wanted), (
                name,
                sample,
            )
    shown = to_display(frame.color).pixels[crop]
    assert same_bits(folded(traced, "resolve", "display"), np.ascontiguousarray(shown))


def crop_of(region: tuple[int, int, int, int]) -> tuple[slice, slice]:
    column, row, columns, rows = region
    return slice(row, row + rows), slice(column, column + columns)


@pytest.mark.parametrize(("name", "choice"), CASES, ids=name_of)
def test_all_rows_give_the_picture_and_its_crop(name, choice):
    scene = SCENES[name]
    settings = settings_of(choice, scene)
    frame = render(scene, settings)
    for region in every_nth((small_region(scene), (0, 0, *scene.size)), 2):
        traced, crop = trace(scene, settings, region=region), crop_of(region)
        check_frame(traced, frame, crop)
        if scene.corner_count:  # Fragments of a table are there before the stage Raster.
            overdraw = folded(traced, "raster", "overdraw")
            assert same_bits(overdraw, np.ascontiguousarray(frame.cover_count[crop]))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sphere", "torus", "knot"])
def test_meshes(name):
    scene = small_scene(name)
    region = small_region(scene)
    for settings in (Settings(), Settings(cull="back", visibility="painters", shading="flat")):
        check_frame(trace(scene, settings, region=region), render(scene, settings), crop_of(region))


def part_of(scene: ClipScene, triangles: np.ndarray) -> ClipScene:
    """Return some triangles of a scene as a scene of their own."""
    return ClipScene(
        scene.clip[triangles], scene.attributes[triangles], scene.size, scene.texture, scene.background
    )


def picture_of(scene: ClipScene, settings: Settings, start: np.ndarray, then: list[int]) -> Frame:
    """Draw some triangles of a scene, with their numbers in it."""
    triangles = np.sort(np.append(start, then)).astype(np.int64)
    picture = render(part_of(scene, triangles), settings)
    number = np.append(triangles, -1).astype(np.int32)
    object.__setattr__(picture, "primitive", number[picture.primitive])
    if picture.samples is not None:
        object.__setattr__(picture.samples, "primitive", number[picture.samples.primitive])
    return picture


def check_one_triangle(scene: ClipScene, settings: Settings, triangle: int) -> None:
    """Compare the trace of a triangle with pictures of scenes that have only the triangles drawn so far."""
    order = TraceSource(scene, settings).order
    done = int(np.flatnonzero(order == triangle)[0])
    for before, place in (("earlier", done), ("cleared", 0)):
        traced = trace(scene, settings, triangle, before=before)
        if settings.visibility == "bsp":
            # Other triangles cut otherwise: pieces are those of the whole scene.
            raster = make_raster(scene.size, settings.pixel_center)
            first, frame = (draw(scene, settings, raster, Before(place, then)) for then in (-1, triangle))
        else:
            first, frame = (picture_of(scene, settings, order[:place], then) for then in ([], [triangle]))
        check_frame(traced, frame)
        for name, (stage, track) in FOLDED.items():
            if name == "color" and settings.antialiasing != "none":
                continue
            assert same_bits(track_of(traced, stage, track).at(0), getattr(first, name)), (before, name)
        for sample in range(0 if first.samples is None else len(first.samples.position)):
            started = track_of(traced, "blend", f"color {sample}" if sample else "color").at(0)
            assert same_bits(started, first.samples.color[sample]), (before, sample)
        count = track_of(traced, "raster", "overdraw").at(0)
        assert np.array_equal(count, first.cover_count), before


@pytest.mark.parametrize(("triangle", "choice"), in_turn([0, 2, 4, 5, 9], EACH_METHOD), ids=name_of)
def test_one_triangle_continues_the_picture_of_the_earlier_ones(triangle, choice):
    check_one_triangle(clip_scene(), Settings(**choice), triangle)


@pytest.mark.slow
def test_one_triangle_of_a_lit_scene_gives_the_picture_when_it_is_the_last():
    scene = SCENES["lit"]
    for choice in EACH_METHOD:
        settings = Settings(**choice)
        order = TraceSource(scene, settings).order
        last = int(order[-1])
        if (order == last).sum() > 1:
            continue  # Pieces of others are drawn between its own.
        check_frame(trace(scene, settings, last), render(scene, settings))


ANY_SETTINGS = st.builds(
    Settings,
    **{family: st.sampled_from(table.names(family)) for family in families()},
    block_size=BLOCK_SIZES,
)


@st.composite
def any_clip_scene(draw) -> ClipScene:
    clip, size = draw(ANY_TRIANGLES)
    value = st.sampled_from([0.0, 0.25, 0.5, 1.0])
    values = draw(st.lists(value, min_size=12 * len(clip), max_size=12 * len(clip)))
    return ClipScene(clip, np.reshape(values, (len(clip), 3, 4)), size)


@given(any_clip_scene(), ANY_SETTINGS)
def test_any_triangles_under_any_settings(scene, settings):
    traced, frame = trace(scene, settings), render(scene, settings)
    check_frame(traced, frame)
    assert same_bits(folded(traced, "raster", "overdraw"), frame.cover_count)


@given(any_clip_scene(), ANY_SETTINGS, st.data())
def test_any_triangle_alone(scene, settings, data):
    check_one_triangle(scene, settings, data.draw(st.integers(0, len(scene.clip) - 1)))


@given(any_clip_scene(), ANY_SETTINGS, st.data())
def test_there_and_back_again(scene, settings, data):
    traced = trace(scene, settings)
    for stage in STAGES:
        found = traced.stage(stage)
        k = data.draw(st.integers(0, found.steps.count), stage)
        j = data.draw(st.integers(0, found.steps.count), stage)
        first, _, again = found.state(k), found.state(j), found.state(k)
        for name, buffer in first.items():
            assert same_bits(buffer, again[name])
            assert not buffer.flags.writeable


@given(any_clip_scene(), ANY_SETTINGS, st.data())
def test_a_state_is_the_rows_written_one_by_one(scene, settings, data):
    traced = trace(scene, settings)
    for stage in ("raster", "depth", "blend", "resolve"):
        found = traced.stage(stage)
        done = data.draw(st.integers(0, found.steps.row_count), stage)
        for track in found.buffers:
            buffer = np.array(track.initial)
            flat = buffer.reshape(-1, *buffer.shape[2:])
            for row, place, value in zip(
                track.rows.tolist(), track.places.tolist(), track.values, strict=True
            ):
                if row < done:
                    flat[place] = value
            assert same_bits(track.at(done), buffer), (stage, track.name)


def test_fragments_out_of_depth_range_count_alike_in_picture_and_trace():
    scene = ClipScene([[[-1, -1, -2, 1], [1, -1, 0, 1], [0, 1, 0, 1]]], size=(3, 3))
    assert np.array_equal(folded(trace(scene), "raster", "overdraw"), render(scene).cover_count)


def test_negative_inverse_w_is_behind_the_eye_and_not_seen():
    # Snapping turns this sliver over, so that its far side, behind the eye, is covered.
    sliver = [[[-0.125, 0.875, 0, -1], [-0.2509765625, 1.7529296875, 0, 2], [0.25, -1.75, 0, 1]]]
    scene = ClipScene(sliver, size=(8, 8))
    for visibility in table.names("visibility"):
        settings = Settings(depth="inverse-w", visibility=visibility)
        check_frame(trace(scene, settings), render(scene, settings))


@pytest.mark.parametrize("choice", [{"fill": "scanline-lecture"}, {"interpolation": "affine"}], ids=name_of)
def test_clipping_is_inserted_for_a_triangle_whatever_is_drawn_with_it(choice):
    reaches_out = [[-0.9, -0.8, -2, 1], [0.9, -0.8, 0.5, 1.5], [0, 0.9, 0.5, 2]]
    crosses_eye = [[-0.5, -0.5, 0.1, 1], [1, 1.5, 0.2, 2], [0.3, 0.2, 0.4, -0.5]]
    values = np.random.default_rng(1).random((2, 3, 4))
    scene = ClipScene([crosses_eye, reaches_out], values, (12, 9))
    check_frame(trace(scene, Settings(**choice), 1), render(scene, Settings(**choice)))


def test_painters_order_of_the_earlier_triangles_is_that_of_all():
    # By w the third comes last and the others stay as given; those two alone have one w.
    far, near = (
        [[-1, -1, 1, 2], [2, -1, 1, 2], [0, 2, 1, 2]],
        [[-1, -1, 1.5, 2], [2, -1, 1.5, 2], [0, 2, 1.5, 2]],
    )
    small = [[-0.5, -0.5, 0, 1], [0.5, -0.5, 0, 1], [0, 0.5, 0, 1]]
    scene, settings = ClipScene([far, near, small], size=(8, 8)), Settings(visibility="painters")
    check_frame(trace(scene, settings, 2), render(scene, settings))


def test_without_a_row_the_frame_is_cleared():
    scene = SCENES["clip"]
    traced = trace(scene, Settings(depth="inverse-w"))
    assert (track_of(traced, "blend", "color").at(0) == scene.background.astype(np.float32)).all()
    assert (track_of(traced, "depth", "depth").at(0) == 0).all()
    assert (track_of(traced, "depth", "primitive").at(0) == -1).all()
    assert (track_of(traced, "raster", "overdraw").at(0) == 0).all()
    for name in ("coverage", "edge 0", "edge 1", "edge 2", "weight 0", "weight 1", "weight 2"):
        assert np.isnan(track_of(traced, "raster", name).at(0)).all()


def test_rows_of_a_pixel():
    traced = trace(SCENES["clip"]).stage("depth")
    for column, row in ((5, 4), (0, 0), (11, 8)):
        rows = traced.rows_at_pixel(column, row)
        wanted = [k for k in range(traced.steps.row_count) if tuple(traced.pixel[k]) == (column, row)]
        assert rows.tolist() == wanted
