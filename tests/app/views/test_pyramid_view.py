import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.session.document import open_document
from app.session.session import Session
from app.views.pointed_pixel import PointedPixel, fragment_at
from app.views.pyramid_diagram import hit_point, homogeneous_corners, pyramid_diagram, pyramid_frame
from core import ClipScene, Settings
from lessons.scenes import make_scene


def source_of(name: str, **settings: str):
    return Session(open_document(make_scene(name), name, settings=Settings(**settings))).trace.source


@pytest.mark.parametrize("name", ["single-triangle", "near-plane", "intersecting", "textured-floor"])
def test_rays_hit_where_perspective_interpolation_says(qapp, name):
    source = source_of(name)
    weights, _ = source.interpolated
    for fragment in range(0, len(source.fragments), max(len(source.fragments) // 50, 1)):
        triangle = int(source.triangle_of_fragment[fragment])
        x = source.fragments.column[fragment] + 0.5
        y = source.fragments.row[fragment] + 0.5
        corners = homogeneous_corners(source, triangle)
        point, shares, inverse_w = hit_point(corners, float(x), float(y))
        assert np.array_equal(shares, weights[fragment])
        assert inverse_w == source.inverse_w[fragment]
        assert np.allclose(point, shares @ corners, rtol=1e-6, atol=1e-9 * np.abs(corners).max())
        assert np.allclose(point[:2] / point[2], [x, y])


NUMBERS = st.floats(-4, 4).map(lambda value: round(value * 8) / 8)


@given(
    st.lists(NUMBERS, min_size=12, max_size=12), st.tuples(st.integers(0, 15), st.integers(0, 11)) | st.none()
)
def test_any_triangle_can_be_drawn(numbers, pixel):
    source = ClipScene(np.array(numbers).reshape(1, 3, 4), size=(16, 12))
    trace = open_document(source, "typed").make_trace()
    pointed = None if pixel is None else PointedPixel(*pixel, "pin")
    diagram = pyramid_diagram(trace.source, 0, pointed)
    assert np.isfinite(diagram.frame).all()
    assert diagram.caption


def test_the_raster_stands_on_the_plane_w_1(qapp):
    source = source_of("single-triangle")
    diagram = pyramid_diagram(source, 0, None)
    border = next(stroke for stroke in diagram.strokes if stroke.is_closed and stroke.ink == "text")
    assert np.allclose(border.points[:, 2], -1.0)
    assert np.allclose(np.abs(border.points[:, 1]), 1.0)
    assert np.allclose(np.abs(border.points[:, 0]), 64 / 48)


def test_a_segment_has_no_weights_in_its_plane(qapp):
    caption = pyramid_diagram(source_of("segment"), 0, PointedPixel(5, 3, "pin")).caption
    assert "a segment has no area" in caption
    assert "weights" not in caption


def test_what_is_covered_of_the_raster_is_drawn_exactly(qapp):
    source = source_of("near-plane")
    diagram = pyramid_diagram(source, 0, None)
    image = next(patch.points for patch in diagram.patches if patch.opacity == 0.75)
    frame = pyramid_frame(source, homogeneous_corners(source, 0))
    window = image @ np.linalg.inv(frame.matrix).T
    x, y = window[:, 0], window[:, 1]
    area = 0.5 * abs((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
    assert area == pytest.approx(len(source.fragments), rel=0.05)
    assert np.allclose(window[:, 2], 1.0)


@pytest.mark.parametrize(
    ("scene", "words"), [("single-triangle", "in front of the eye"), ("near-plane", "reaches behind the eye")]
)
def test_the_caption_says_where_the_triangle_is(qapp, scene, words):
    assert words in pyramid_diagram(source_of(scene), 0, None).caption


def test_a_triangle_behind_the_eye_says_so(qapp):
    clip = np.array([[[0.0, 0, 0, -1], [1, 0, 0, -1], [0, 1, 0, -2]]])
    source = Session(open_document(ClipScene(clip, size=(8, 8)), "typed")).trace.source
    diagram = pyramid_diagram(source, 0, PointedPixel(4, 4, "hover"))
    assert "behind the eye" in diagram.caption
    assert fragment_at(source, 4, 4) == -1


def test_the_ray_tells_inside_from_beyond_an_edge(qapp):
    source = source_of("single-triangle")
    inside = pyramid_diagram(source, 0, PointedPixel(28, 18, "pin"))
    beside = pyramid_diagram(source, 0, PointedPixel(60, 40, "pin"))
    assert "inside the triangle" in inside.caption
    assert "pinned pixel (28, 18)" in inside.caption
    assert "beyond an edge" in beside.caption
    assert [spot.shape for spot in inside.spots].count("cross") == 0
    assert [spot.shape for spot in beside.spots].count("cross") == 1
