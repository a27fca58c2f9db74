"""The conventions that ``core/__init__.py`` states, sentence by sentence; pictures show the top row first."""

import numpy as np
import pytest

from core import Camera, ClipScene, Mesh, Scene, Settings, Texture, draw_triangles, render
from core.coverage.pixel_runs import make_raster
from core.methods import table
from core.scene import triangulate
from tests.core.drawing import cover_each, text
from tests.core.strategies import clip_of_window

EVERYTHING = [[-1, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]]


def camera(**changes) -> Camera:
    return Camera(**{"eye": [0, 0, 5], "target": [0, 0, 0], "near": 1, "far": 9, **changes})


# Axes


def test_the_window_is_y_up_and_row_0_is_the_bottom() -> None:
    clip = [[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 0, 0, 1]]]  # in the lower left
    frame = draw_triangles(clip, 4, 4)
    assert text(frame.primitive + 1) == ["....", "....", "1...", "111."]
    assert frame.primitive[0, 0] == 0


def test_a_pixel_has_its_centre_at_half() -> None:
    # Attributes that are the window position of the corners: interpolated they are that of the centre.
    size = (4, 3)
    corners = [(-1.0, -1.0), (9.0, -1.0), (-1.0, 9.0)]
    frame = draw_triangles(clip_of_window([corners], size), *size, attributes=[corners])
    columns, rows = np.meshgrid(np.arange(4), np.arange(3))
    assert np.allclose(frame.attributes[..., 0], columns + 0.5)
    assert np.allclose(frame.attributes[..., 1], rows + 0.5)


def test_centres_on_integers_are_a_setting() -> None:
    size = (4, 3)
    corners = [(-1.0, -1.0), (9.0, -1.0), (-1.0, 9.0)]
    settings = Settings(pixel_center="integer")
    frame = draw_triangles(clip_of_window([corners], size), *size, attributes=[corners], settings=settings)
    columns, rows = np.meshgrid(np.arange(4), np.arange(3))
    assert np.allclose(frame.attributes[..., 0], columns)
    assert np.allclose(frame.attributes[..., 1], rows)
    assert make_raster(size, "integer").center == 0


def test_ndc_is_the_cube_from_minus_one_to_one_and_window_depth_from_0_to_1() -> None:
    for z, depth in ((-1.0, 0.0), (0.0, 0.5), (0.5, 0.75)):
        clip = np.array([EVERYTHING], float)
        clip[..., 2] = z
        assert (draw_triangles(clip, 3, 2).depth == depth).all()


def test_the_camera_looks_along_minus_z_of_a_right_handed_space() -> None:
    # Left and right of the target, seen from +z: x runs to the right, y upwards; nearer is the larger z.
    corner = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]])
    mesh = Mesh(np.concatenate([corner + np.array([0.2, 0.2, z]) for z in (0, 1)]), [[0, 1, 2], [3, 4, 5]])
    frame = render(Scene((mesh,), camera(), size=(8, 8)), Settings(shading="unlit"))
    assert (frame.primitive[:4] == -1).all()
    assert (frame.primitive[:, :4] == -1).all()
    assert frame.primitive[4, 4] == 1
    assert frame.cover_count[4, 4] == 2


def test_angles_are_radians() -> None:
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * 4.99
    square = Mesh(corners, [[0, 1, 2], [0, 2, 3]])
    right_angle = Scene((square,), camera(field_of_view=np.pi / 2), size=(6, 6))
    assert (render(right_angle, Settings(shading="unlit")).primitive >= 0).all()


def test_counter_clockwise_is_the_front() -> None:
    front = [[-1, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1]]
    for faces, triangle, seen in (
        ("back", front, True),
        ("back", front[::-1], False),
        ("front", front, False),
    ):
        frame = draw_triangles([triangle], 4, 4, settings=Settings(cull=faces))
        assert (frame.primitive == 0).any() == seen


def test_w_above_0_is_in_front_of_the_eye() -> None:
    mirrored = -np.array([EVERYTHING], float)  # the same points of the window, behind the eye
    assert (draw_triangles(mirrored, 4, 4).primitive == -1).all()


# Coverage


@pytest.mark.parametrize(
    ("shift", "drawn"), [(0.0, True), (0.5 / 256, True), (0.51 / 256, False), (1.5 / 256, False)]
)
def test_corners_are_snapped_to_a_256th_of_a_pixel_half_to_even(shift: float, drawn: bool) -> None:
    # The left side stands at the centre 1.5 = 384/256, and is moved right.
    clip = clip_of_window([[(1.5 + shift, 0), (4, 0), (1.5 + shift, 9)]], (4, 4))
    assert bool(cover_each(clip, (4, 4))[0, 1, 1]) == drawn


def test_an_edge_to_a_corner_behind_the_eye_starts_in_the_snapped_corner_and_keeps_its_direction() -> None:
    # The left side runs straight up from the corner that is snapped to (1.5, 0.5), away from the third, which
    # projects to below it from behind the eye: it meets the centres of column 1. Before snapping it passes them by.
    corners = [(1.5 + 0.4 / 256, 0.5), (6.5, 0.5), (1.5 + 0.4 / 256, -3.5)]
    clip = clip_of_window([corners], (8, 4), [[1.0, 1.0, -1.0]])
    assert text(cover_each(clip, (8, 4))[0] > 0) == [".#######", ".#######", ".#######", ".#####.."]
    unsnapped = cover_each(clip, (8, 4), coverage="float64")[0] > 0
    assert text(unsnapped) == ["..######", "..######", "..######", "..####.."]


def test_left_and_bottom_sides_own_their_centres() -> None:
    square = clip_of_window(
        [[(1.5, 1.5), (4.5, 1.5), (4.5, 4.5)], [(1.5, 1.5), (4.5, 4.5), (1.5, 4.5)]], (6, 6)
    )
    assert text(cover_each(square, (6, 6)).sum(axis=0)) == [
        "......",
        "......",
        ".111..",
        ".111..",
        ".111..",
        "......",
    ]
    diagonal_to = cover_each(square, (6, 6))
    assert text(diagonal_to[0]) == ["......", "......", "...1..", "..11..", ".111..", "......"]


def test_inclusive_draws_a_shared_side_twice_and_exclusive_never() -> None:
    pair = clip_of_window(
        [[(0.5, 0.5), (3.5, 0.5), (3.5, 3.5)], [(0.5, 0.5), (3.5, 3.5), (0.5, 3.5)]], (4, 4)
    )
    drawings = {
        "shared-edge": ["....", "111.", "111.", "111."],
        "inclusive": ["1112", "1121", "1211", "2111"],
        "exclusive": ["....", ".1..", "..1.", "...."],
    }
    for rule, drawing in drawings.items():
        assert text(cover_each(pair, (4, 4), fill_rule=rule).sum(axis=0)) == drawing


def test_attributes_come_from_the_corners_before_snapping() -> None:
    # A corner at 1.501 is snapped to 1.5 and covers the centre there; its value is just below 0.
    corners = [(1.501, 1.5), (5.501, 1.5), (1.501, 5.5)]
    frame = draw_triangles(clip_of_window([corners], (6, 6)), 6, 6, attributes=[[[0.0], [1.0], [0.0]]])
    assert frame.primitive[1, 1] == 0
    assert frame.attributes[1, 1, 0] == pytest.approx(-0.001 / 4, rel=1e-3)


# Depth


def test_the_nearer_wins_and_a_tie_keeps_what_is_there() -> None:
    clip = np.array([EVERYTHING] * 4, float)
    clip[..., 2] = np.array([0.5, 0.25, 0.25, 0.4])[:, None]
    frame = draw_triangles(clip, 2, 2)
    assert (frame.primitive == 1).all()
    assert (frame.cover_count == 4).all()


def test_depth_is_clamped_if_every_corner_is_in_range_and_only_otherwise_tested() -> None:
    # Steep triangles whose side at the near plane is snapped outward: the centre lies before it.
    corners = [(1.5 + 0.4 / 256, 0.0), (1.5 + 4 / 256, 2.0), (1.5 + 0.4 / 256, 4.0)]
    z = np.array([[-1.0, 1.0, -1.0]])
    for reach, drawn in ((0.0, True), (-1e-6, False)):
        clip = clip_of_window([corners], (4, 4), 1.0, z + np.array([[reach, 0.0, reach]]))
        frame = draw_triangles(clip, 4, 4)
        assert cover_each(clip, (4, 4))[0, 1, 1]
        assert (frame.primitive[1, 1] == 0) == drawn
        assert frame.depth[1, 1] == (0.0 if drawn else 1.0)


@pytest.mark.parametrize(("depth", "cleared"), [("z-float32", 1.0), ("inverse-w", 0.0)])
def test_cleared_buffers(depth: str, cleared: float) -> None:
    scene = ClipScene(np.zeros((0, 3, 4)), size=(3, 2), background=[0.1, 0.2, 0.3, 0.4])
    frame = render(scene, Settings(depth=depth))
    assert (frame.depth == np.float32(cleared)).all()
    assert (frame.primitive == -1).all()
    assert (frame.cover_count == 0).all()
    assert np.array_equal(frame.color, np.full((2, 3, 4), [0.1, 0.2, 0.3, 0.4], np.float32))


# Colours and textures


def test_the_first_four_attributes_are_the_colour_and_missing_ones_are_0_0_0_1() -> None:
    for count, expected in (
        (0, [0, 0, 0, 1]),
        (1, [0.5, 0, 0, 1]),
        (3, [0.5] * 3 + [1]),
        (4, [0.5] * 4),
        (6, [0.5] * 4),
    ):
        frame = draw_triangles([EVERYTHING], 2, 2, attributes=np.full((1, 3, count), 0.5))
        assert frame.color[0, 0].tolist() == expected
        assert frame.attributes.shape == (2, 2, count)
    assert draw_triangles([EVERYTHING], 2, 2).color[0, 0].tolist() == [0, 0, 0, 1]


def test_texture_0_0_is_the_bottom_left_corner() -> None:
    texels = np.arange(6.0).reshape(2, 3, 1) / 8
    uv = [[[0, 0], [2, 0], [0, 2]]]  # 0 to 1 over the window
    settings = Settings(texture_filter="nearest")
    frame = draw_triangles([EVERYTHING], 3, 2, attributes=uv, texture=Texture(texels), settings=settings)
    assert np.array_equal(frame.color[..., 0], texels[..., 0].astype(np.float32))


def test_colours_are_linear_float32_and_not_encoded() -> None:
    frame = draw_triangles([EVERYTHING], 2, 2, attributes=np.full((1, 3, 4), 0.2))
    assert frame.color.dtype == np.float32
    assert (frame.color == np.float32(0.2)).all()


def test_buffers_have_the_shapes_and_types_that_the_public_core_promises() -> None:
    frame = draw_triangles([EVERYTHING], 5, 3, attributes=np.zeros((1, 3, 7)))
    shapes = {
        name: (getattr(frame, name).shape, getattr(frame, name).dtype.name)
        for name in vars(frame)
        if name not in ("statistics", "samples")
    }
    assert shapes == {
        "color": ((3, 5, 4), "float32"),
        "depth": ((3, 5), "float32"),
        "primitive": ((3, 5), "int32"),
        "attributes": ((3, 5, 7), "float32"),
        "cover_count": ((3, 5), "int32"),
    }
    assert frame.samples is None


# Numbers of triangles


def test_a_piece_made_by_clipping_keeps_its_triangles_number() -> None:
    clip = np.array([EVERYTHING, EVERYTHING], float) * [2, 2, 1, 1]
    clip[1, :, 2] = 0.9
    for clipping in table.names("clipping"):
        frame = draw_triangles(clip, 4, 4, settings=Settings(clipping=clipping))
        assert (frame.primitive == 0).all()
        assert (draw_triangles(clip[::-1], 4, 4, settings=Settings(clipping=clipping)).primitive == 1).all()


def test_triangles_of_a_quad_are_numbered_in_turn_and_know_their_face() -> None:
    triangles, faces = triangulate([[0, 1, 2, 3], [4, 5, 6], [7, 8, 9, 10, 11]])
    assert triangles.tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 6], [7, 8, 9], [7, 9, 10], [7, 10, 11]]
    assert faces.tolist() == [0, 0, 1, 2, 2, 2]
    with pytest.raises(ValueError, match="polygon 1 must have at least 3 corners, got 2"):
        triangulate([[0, 1, 2], [3, 4]])


def test_triangles_of_a_scene_are_numbered_over_its_meshes() -> None:
    one = Mesh([[-3, -3, 0], [3, -3, 0], [0, 4, 0]], [[0, 1, 2]])
    near = Mesh([[-3, -3, 1], [3, -3, 1], [0, 4, 1]], [[2, 1, 0], [0, 1, 2]])
    frame = render(Scene((one, near), camera(), size=(4, 4)), Settings(shading="unlit"))
    assert frame.primitive[1, 2] == 1
    assert (frame.cover_count[1, 2]) == 3


# Settings


def test_the_first_method_of_a_family_is_the_default() -> None:
    settings = Settings()
    first = {
        "cull": "none",
        "clipping": "homogeneous",
        "coverage": "snapped",
        "fill_rule": "shared-edge",
        "polygon_mode": "fill",
        "line": "bresenham",
        "pixel_center": "half",
        "interpolation": "perspective",
        "provoking": "last",
        "texture_filter": "bilinear",
        "wrap": "repeat",
        "shading": "phong",
        "visibility": "z-buffer",
        "depth": "z-float32",
        "blend": "opaque",
    }
    for family, name in first.items():
        assert getattr(settings, family) == name
        assert table.names(family)[0] == name
