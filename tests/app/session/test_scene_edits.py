"""Edits of scenes: typed values and dragged corners land where they were put."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.pages.step.scene_values import outline
from core import ClipScene, Scene
from core.records.motion import Motion
from core.transform.vertex_stage import transform_vertices
from lessons.scene_edits import (
    clip_of_window,
    join_shared,
    move_corner,
    set_value,
    set_values,
    split_shared,
    window_of_clip,
)
from lessons.scenes import make_scene
from widgets.scene.outline import OutlineGroup

number = st.floats(-500, 500)


@given(number, number, st.floats(0, 1), st.floats(0.01, 100) | st.floats(-100, -0.01))
def test_window_and_clip_are_inverse(x: float, y: float, depth: float, w: float) -> None:
    window = np.array([x, y, depth, w])
    assert window_of_clip(clip_of_window(window, (64, 48)), (64, 48)) == pytest.approx(window, abs=1e-9)


@given(number, number)
def test_a_dragged_corner_keeps_depth_and_w(x: float, y: float) -> None:
    scene = make_scene("single-triangle")
    assert isinstance(scene, ClipScene)
    before = window_of_clip(scene.clip[0, 1], (64, 48))
    moved = move_corner(scene, 0, 1, (x, y), (64, 48))
    assert isinstance(moved, ClipScene)
    assert window_of_clip(moved.clip[0, 1], (64, 48)) == pytest.approx([x, y, *before[2:]], abs=1e-9)


def test_a_dragged_mesh_vertex_lands_in_the_window() -> None:
    scene = make_scene("cube")
    moved = move_corner(scene, 0, 0, (200.0, 300.0), (512, 512))
    assert isinstance(moved, Scene)
    vertices = transform_vertices(moved)
    assert vertices.window[vertices.corners[0, 0], :2] == pytest.approx([200, 300], abs=1e-6)


@pytest.mark.parametrize(
    "name", ["single-triangle", "line-strip", "cube", "textured-floor", "bar-and-wire", "box-in-light"]
)
def test_every_value_of_the_outline_can_be_typed_back(name: str) -> None:
    scene = make_scene(name)
    typed = _values(outline(scene, None, scene.size))
    assert len(typed) >= 12
    for path, value in typed.items():
        again = _values(outline(set_value(scene, path, value, scene.size), None, scene.size))
        assert again[path] == pytest.approx(value)


def test_what_moves_between_pictures_is_typed() -> None:
    scene = set_values(make_scene("cube"), {"motion/camera/x": 0.5, "motion/0/z": -1.0}, (64, 48))
    assert scene.motion == Motion((0.5, 0.0, 0.0), ((0, (0.0, 0.0, -1.0)),))
    still = set_values(scene, {"motion/camera/x": 0.0, "motion/0/z": 0.0}, (64, 48))
    assert still.motion is None
    with pytest.raises(ValueError, match="motion of camera must be 3 finite numbers"):
        set_value(scene, "motion/camera/y", np.nan, (64, 48))


def test_a_light_may_be_kept_from_casting_shadows() -> None:
    scene = make_scene("box-in-light")
    assert isinstance(scene, Scene)
    assert scene.casting_light == 0
    dark = set_value(scene, "light/0/shadow/casts_shadow", 0.0, (64, 48))
    assert isinstance(dark, Scene)
    assert dark.casting_light == -1


def _values(groups: tuple[OutlineGroup, ...]) -> dict[str, float]:
    return {f"{row.path}/{value.name}": value.value for g in groups for row in g.rows for value in row.values}


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("camera/range/near", 1000.0, "near must be less than far"),
        ("camera/lens/field_of_view", 180.0, "field of view must be between 0 and 180 degrees, got 180"),
        ("mesh/0/shininess/shininess", 0.0, "shininess must be above 0"),
    ],
)
def test_values_that_make_no_scene_are_refused(path: str, value: float, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        set_value(make_scene("cube"), path, value, (512, 512))


def test_w_zero_is_refused() -> None:
    with pytest.raises(ValueError, match="w must not be 0"):
        set_value(make_scene("single-triangle"), "corner/0/1/w", 0.0, (64, 48))


def test_shared_corners_split_and_join() -> None:
    scene = make_scene("shared-edge")
    split = split_shared(scene)
    assert isinstance(split, ClipScene)
    assert split.shared is None
    joined = join_shared(split)
    assert isinstance(joined, ClipScene)
    assert joined.shared is not None
    assert len(np.unique(joined.shared)) == 4


def test_ends_of_a_strip_move_and_split_as_corners_do() -> None:
    scene = make_scene("line-strip")
    assert [group.title for group in outline(scene, None, scene.size)][:2] == ["Segment 0", "Segment 1"]
    moved = move_corner(scene, 0, 1, (10.5, 2.5), scene.size)
    assert isinstance(moved, ClipScene)
    assert np.array_equal(moved.clip[0, 1], moved.clip[1, 0])
    alone = move_corner(split_shared(scene), 0, 1, (10.5, 2.5), scene.size)
    assert isinstance(alone, ClipScene)
    assert not np.array_equal(alone.clip[0, 1], alone.clip[1, 0])
    joined = join_shared(split_shared(scene))
    assert isinstance(joined, ClipScene)
    assert joined.shared is not None
    assert joined.shared[:-1, 1].tolist() == joined.shared[1:, 0].tolist()


def test_a_clip_window_is_typed_in_pixels_and_refused_without_area() -> None:
    scene = make_scene("segment")
    assert _values(outline(scene, None, scene.size))["clip-window/0/right"] == 16
    names = [f"clip-window/0/{name}" for name in ("left", "bottom", "right", "top")]
    typed = set_values(scene, dict(zip(names, (4.1, 2.0, 8.0, 6.0), strict=True)), scene.size)
    assert isinstance(typed, ClipScene)
    found = _values(outline(typed, None, scene.size))
    assert [found[name] for name in names] == pytest.approx([4.1, 2, 8, 6], abs=0)
    moved = set_values(typed, dict(zip(names, (9.0, 7.0, 12.0, 10.0), strict=True)), scene.size)
    assert _values(outline(moved, None, scene.size))["clip-window/0/left"] == 9
    with pytest.raises(ValueError, match="the clip window must have an area"):
        set_value(typed, "clip-window/0/left", 8.0, scene.size)
    whole = set_values(typed, dict(zip(names, (0.0, 0.0, 16.0, 12.0), strict=True)), scene.size)
    assert isinstance(whole, ClipScene)
    assert whole.clip_region is None
