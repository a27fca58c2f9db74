"""The built-in scenes: each shows what it is for; window coordinates go to clip space and back."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Settings, render
from core.coverage.snapping import SUBPIXELS, snap
from core.scene import ClipScene, Scene
from core.transform.vertex_stage import transform_vertices
from lessons.scenes import CATALOGUE, built_in_scene, make_scene, scene_names
from lessons.shapes import patches
from lessons.window_scenes import window_triangle
from lessons.world_scenes import TEACHING_SIZE

sizes = st.tuples(st.integers(1, 4096), st.integers(1, 4096))
weights = st.floats(1e-3, 1e3) | st.floats(-1e3, -1e-3)


def window_corners(clip, size):
    """Return x, y, depth and w, each (3,), of clip-space corners (3, 4): the inverse of ``window_triangle``."""
    w = clip[:, 3]
    x, y, z = (clip[:, k] / w for k in range(3))
    return (x + 1) * (size[0] / 2), (y + 1) * (size[1] / 2), (z + 1) / 2, w


def grid(limit):
    """Three pixels on the 1/256-pixel grid."""
    return st.lists(st.integers(-limit * SUBPIXELS, limit * SUBPIXELS), min_size=3, max_size=3).map(
        lambda steps: np.array(steps) / SUBPIXELS
    )


@given(grid(8192), grid(8192), st.lists(st.floats(0, 1), min_size=3, max_size=3),
       st.lists(weights, min_size=3, max_size=3), sizes)  # fmt: skip
def test_window_to_clip_and_back_is_exact_on_the_grid(x, y, depth, w, size):
    clip = window_triangle(x, y, depth, w, size)
    back_x, back_y, back_depth, back_w = window_corners(clip, size)
    assert (np.rint(back_x * SUBPIXELS) / SUBPIXELS == x).all()
    assert (np.rint(back_y * SUBPIXELS) / SUBPIXELS == y).all()
    assert np.abs(back_depth - depth).max() < 1e-15
    assert (back_w == w).all()


@given(grid(4096), grid(4096), st.lists(st.floats(1e-3, 1e3), min_size=3, max_size=3), sizes)
def test_the_pipeline_snaps_a_typed_corner_to_where_it_was_typed(x, y, w, size):
    scene = ClipScene(window_triangle(x, y, np.full(3, 0.5), w, size)[None], size=size)
    snapped, is_projected = snap(transform_vertices(scene).window[None, :, :2])
    assert is_projected.all()
    assert snapped[0].tolist() == np.stack([x, y], axis=1).tolist()


def test_clip_coordinates_by_hand():
    clip = window_triangle([0, 64, 32], [0, 48, 24], [0, 1, 0.5], [1, 2, 4], (64, 48))
    assert clip.tolist() == [[-1, -1, -1, 1], [2, 2, 2, 2], [0, 0, 0, 4]]


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        (([0, 1], [0, 1, 2], [0, 0, 0], [1, 1, 1]), r"x must be \(3,\), got \(2,\)"),
        (([0, 1, 2], [0, 1, np.nan], [0, 0, 0], [1, 1, 1]), "y must be finite"),
        (([0, 1, 2], [0, 1, 2], [0, 0, 0], [1, 0, 1]), "w must not be 0"),
    ],
)
def test_bad_window_coordinates_are_refused(arguments, wanted):
    with pytest.raises(ValueError, match=wanted):
        window_triangle(*arguments, (64, 48))


def test_the_catalogue():
    assert scene_names() == (
        "single-triangle", "shared-edge", "fan", "segment", "clipped-segment", "polygon-window",
        "line-strip", "points", "triangle-strip", "polygon", "polygon-holes", "weiler-atherton", "connecting-edges",
        "pentagram", "near-plane", "intersecting", "crossing-glass", "bar-and-wire", "circle-of-bars", "depth-table",
        "four-layers", "two-buffers", "z-fighting", "textured-floor", "moving-camera",
        "lit-floor", "box-in-light", "mirror-cube", "cube", "boxes-around", "boxes-behind-wall",
        "two-boxes", "bent-bar", "twisted-tube", "blended-bar",
        "curve", "curve-in-depth", "hill", "diced-hill", "diced-ball", "folded-glass", "cracked-patches",
        "teapot", "sphere", "torus", "knot",
    )  # fmt: skip
    for scene in CATALOGUE:
        assert scene.title[0].isupper()
        assert scene.description.endswith(".")
        assert scene.description.count(". ") == 0
        assert built_in_scene(scene.name) is scene
    with pytest.raises(ValueError, match=r"scene must be one of single-triangle, .*, got kettle"):
        make_scene("kettle")


@pytest.mark.parametrize("name", scene_names())
def test_a_scene_is_made_anew_and_fills_a_good_part_of_its_picture(name):
    scene = make_scene(name)
    assert isinstance(scene, Scene | ClipScene)
    assert make_scene(name) is not scene
    if scene.corner_count < 3:
        assert (render(scene).primitive >= 0).any()
        return
    share = (render(scene).primitive >= 0).mean()
    assert share == 1 if name == "four-layers" else 0.15 < share < 0.8
    if scene.corner_count > 3:
        assert max(scene.size) <= max(TEACHING_SIZE)
        return
    is_mesh = name in ("textured-floor", "cube", "diced-ball", "teapot", "sphere", "torus", "knot")
    assert (scene.size == TEACHING_SIZE) == (
        not is_mesh and name not in ("four-layers", "two-buffers", "bar-and-wire")
    )


@pytest.mark.parametrize(
    "name", ["single-triangle", "shared-edge", "fan", "triangle-strip", "polygon", "intersecting"]
)
def test_typed_triangles_face_the_viewer_on_the_grid(name):
    scene = make_scene(name)
    for clip in scene.clip:
        x, y, depth, w = window_corners(clip, scene.size)
        assert (x[1] - x[0]) * (y[2] - y[0]) > (y[1] - y[0]) * (x[2] - x[0])
        assert x * SUBPIXELS == pytest.approx(np.rint(x * SUBPIXELS))
        assert ((depth >= 0) & (depth <= 1)).all()
        assert (w > 0).all()


def test_the_shared_edge_is_shared_and_runs_through_pixel_centres():
    scene = make_scene("shared-edge")
    common = set(scene.shared[0].tolist()) & set(scene.shared[1].tolist())
    assert len(common) == 2
    places = [
        {name: corner.tolist() for name, corner in zip(names, corners, strict=True)}
        for names, corners in zip(scene.shared.tolist(), scene.clip, strict=True)
    ]
    for name in common:
        assert places[0][name] == places[1][name]
    ends = [window_corners(scene.clip[0], scene.size)[axis][[0, 2]] for axis in (0, 1)]
    (x0, x1), (y0, y1) = np.rint(np.array(ends) * 2) / 2
    columns = np.arange(64) + 0.5
    rows = y0 + (columns - x0) * (y1 - y0) / (x1 - x0)
    on_edge = (columns >= min(x0, x1)) & (columns <= max(x0, x1))
    assert (np.abs(rows[on_edge] - np.floor(rows[on_edge]) - 0.5) < 1e-9).sum() >= 4


def test_the_plates_fight_in_16_bits_only():
    scene = make_scene("z-fighting")
    wanted = render(scene, Settings(visibility="ray-casting")).primitive
    wrong = {
        depth: int((render(scene, Settings(depth=depth)).primitive != wanted).sum())
        for depth in ("z-float32", "z-24", "inverse-w", "reversed-z", "logarithmic", "z-16")
    }
    fought = wrong.pop("z-16")
    assert set(wrong.values()) == {0}
    assert 0.15 < fought / (wanted >= 0).sum() < 0.5


def test_the_teapot_has_the_size_of_newells_and_only_the_rim_is_open():
    points = patches()
    assert points.shape == (32, 4, 4, 3)
    assert points.reshape(-1, 3).min(axis=0).tolist() == [-3, -2, 0]
    assert points.reshape(-1, 3).max(axis=0).tolist() == [3.525, 2, 3.15]
    mesh = make_scene("teapot").meshes[0]
    assert len(mesh.triangles) == 2256
    corners = mesh.positions[mesh.triangles]
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert ((facing[:, None] * mesh.normals[mesh.triangles]).sum(axis=2) > 0).all()
    # Edges that one triangle alone has: where body, lid, handle and spout begin, of 6 cells for each quarter.
    _, names = np.unique(mesh.positions.round(9), axis=0, return_inverse=True)
    edges = np.sort(names.ravel()[mesh.triangles][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    counts = np.unique(edges, axis=0, return_counts=True)[1]
    assert set(counts.tolist()) == {1, 2}
    assert (counts == 1).sum() == 24 + 24 + 2 * 12 + 2 * 12
