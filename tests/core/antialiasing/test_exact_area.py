"""Exact areas against rational arithmetic, hidden surfaces, and the limit of many samples."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, render
from core.antialiasing.exact_area import draw_pieces
from core.coverage.pixel_runs import make_raster
from core.records.frame import StageCount
from core.stages.declared import STAGES
from core.stages.vertices import process_geometry
from lessons.scenes import make_scene
from tests.core.antialiasing.many_samples import many_samples
from tests.core.antialiasing.test_pixel_pieces import area, clipped
from tests.core.trace.trace_cases import SCENES
from tests.covering import in_turns

STEP = st.integers(-200, 1000)
CORNERS = st.lists(st.tuples(STEP, STEP), min_size=3, max_size=3)
SIZE = (3, 3)


def triangle(corners, depth=0.0) -> list:
    """Return corners in 1/256 pixel as clip positions of a raster of 3 x 3 pixels."""
    return [[x / 128 / SIZE[0] - 1, y / 128 / SIZE[1] - 1, depth, 1] for x, y in corners]


def exact_area(corners, column: int, row: int) -> Fraction:
    """Return how much of a pixel a triangle covers: the triangle cut by the pixel's sides."""
    polygon = [(Fraction(x), Fraction(y)) for x, y in corners]
    if area(polygon) < 0:
        polygon.reverse()
    low_x, low_y = 256 * column, 256 * row
    for side in ((1, 0, -low_x), (-1, 0, low_x + 256), (0, 1, -low_y), (0, -1, low_y + 256)):
        polygon = clipped(polygon, *side)
    return area(polygon) / 65536


@given(CORNERS)
def test_one_triangle_covers_its_exact_area(corners):
    color = render(ClipScene([triangle(corners)], size=SIZE), Settings(antialiasing="area")).color
    for row in range(SIZE[1]):
        for column in range(SIZE[0]):
            wanted = float(exact_area(corners, column, row))
            assert abs(color[row, column, 3] - wanted) <= 1e-7


@given(CORNERS, CORNERS, st.booleans())
def test_what_a_nearer_triangle_leaves(near, far, near_first):
    """Two layers: the nearer has its area, the farther its own less the overlap, in either order."""
    red, green = [[1.0, 0, 0, 1]] * 3, [[0, 1.0, 0, 1]] * 3
    clip, values = [triangle(near, -0.5), triangle(far, 0.5)], [red, green]
    order = slice(None) if near_first else slice(None, None, -1)
    scene = ClipScene(np.array(clip[order]), np.array(values[order]), SIZE)
    color = render(scene, Settings(antialiasing="area")).color
    alone = [
        render(ClipScene(np.array([each]), np.array([value]), SIZE), Settings(antialiasing="area")).color
        for each, value in zip(clip, values, strict=True)
    ]
    assert np.abs(color[..., 0] - alone[0][..., 0]).max() <= 2e-7
    union = color[..., 3]
    assert (union <= 1 + 1e-6).all()
    assert np.abs(color[..., 1] - (union - alone[0][..., 3])).max() <= 3e-7
    assert (color[..., 1] <= alone[1][..., 1] + 2e-7).all()
    dense = many_samples(scene, Settings(), 16)
    assert np.abs(color - dense).max() <= 0.08


def test_a_pixel_inside_one_triangle_has_the_colour_of_its_centre():
    scene = SCENES["lit"]
    plain, smooth = render(scene), render(scene, Settings(antialiasing="area"))
    same = np.abs(plain.color - smooth.color).max(axis=2) == 0
    assert same.mean() > 0.5
    for buffer in ("depth", "primitive", "attributes", "cover_count"):
        assert np.array_equal(getattr(plain, buffer), getattr(smooth, buffer))


@in_turns(
    choice=[{}, {"blend": "over"}, {"visibility": "last-drawn"}, {"cull": "back"},
            {"depth": "fixed-38"}, {"clipping": "sutherland-hodgman"}],
    name=["lit", "clip", "intersecting", "shared-edge"],
)  # fmt: skip
def test_many_samples_come_near(name, choice):
    scene = SCENES[name]
    exact = render(scene, Settings(antialiasing="area", **choice)).color
    errors = [np.abs(many_samples(scene, Settings(**choice), side) - exact).mean() for side in (1, 4, 16)]
    assert errors[2] < 0.01
    assert errors[2] <= errors[0] / 4 or errors[0] < 1e-6


def test_many_samples_are_the_mean_of_a_large_picture():
    scene = SCENES["clip"]
    side = 16
    larger = render(replace(scene, size=(side * scene.size[0], side * scene.size[1]))).color.astype(float)
    height, width = scene.size[1], scene.size[0]
    mean = larger.reshape(height, side, width, side, 4).mean(axis=(1, 3))
    assert np.abs(many_samples(scene, Settings(), side) - mean).max() <= 1e-6


def test_rays_keep_the_first_of_triangles_in_one_plane():
    """Triangles 0, 1 and 5 of the scene are the same corners in different orders: their planes differ by rounding."""
    exact = render(SCENES["clip"], Settings(antialiasing="area", visibility="ray-casting")).color
    dense = many_samples(SCENES["clip"], Settings(visibility="ray-casting"), 16)
    assert np.abs(exact - dense).max() < 0.02


def test_neighbours_cut_no_slivers_of_rounding():
    scene = replace(make_scene("torus"), size=(120, 90))
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(scene, Settings(), counts)
    pieces = draw_pieces(scene, geometry, make_raster(scene.size, "half"), counts)
    assert len(pieces.area) > 3 * len(pieces.touched)
    assert pieces.area.min() > 1e-15
    assert np.abs(np.bincount(pieces.pixel, pieces.area)[pieces.touched] - 1).max() <= 1e-12


def test_a_wireframe_has_no_area():
    settings = Settings(antialiasing="area", polygon_mode="wireframe")
    frame = render(SCENES["lit"], settings)
    assert np.array_equal(frame.color, render(SCENES["lit"], replace(settings, antialiasing="none")).color)
