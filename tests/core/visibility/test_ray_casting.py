"""Ray casting: the nearest triangle of every pixel, against rational arithmetic derived in another way."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera, ClipScene, Mesh, Scene, Settings, render, trace
from core.depth.measured import visible_triangles
from core.methods import table
from core.study.fragment_cases import clip_corners
from core.visibility.ray_casting import exact_plane, set_up_ray_planes
from tests.core.drawing import text
from tests.core.exact_reference import exact, exact_coverage
from tests.core.meshes import random_rotation
from tests.core.strategies import ANY_TRIANGLES, clip_of_window, grid_triangles, perspective_triangles

RAYS = Settings(visibility="ray-casting")
BIG = [(0, 0), (20, 0), (0, 20)]


def solved(rows: list[list[Fraction]]) -> list[Fraction] | None:
    """Solve three equations (3, 4) by elimination; ``None``: they have no single solution."""
    rows = [list(row) for row in rows]
    for k in range(3):
        pivot = next((r for r in range(k, 3) if rows[r][k] != 0), None)
        if pivot is None:
            return None
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [value / rows[k][k] for value in rows[k]]
        for r in range(3):
            if r != k:
                rows[r] = [a - rows[r][k] * b for a, b in zip(rows[r], rows[k], strict=True)]
    return [row[3] for row in rows]


def exact_nearness(corners, x: Fraction, y: Fraction, by_w: bool) -> Fraction | None:
    """Return 1/w or -z/w where the ray (X, Y, 1) t meets the plane of the corners: solve for their weights.

    Weights l with sum(l (x, y, w)) = (X, Y, 1) are those over w; their sum is 1/w, and sum(l z) is z/w.
    """
    points = [exact(corner) for corner in corners]
    weights = solved([[*(p[axis] for p in points), of] for axis, of in ((0, x), (1, y), (3, Fraction(1)))])
    if weights is None:
        return None
    return sum(weights) if by_w else -sum(a * p[2] for a, p in zip(weights, points, strict=True))


def reference(clip, size: tuple[int, int], by_w: bool = False) -> np.ndarray:
    """Return (H, W) int: of the triangles that cover a pixel within the depth range, the first of the nearest."""
    width, height = size
    covered = [exact_coverage(corners, size) for corners in clip]
    seen = np.full((height, width), -1)
    for row, column in np.argwhere(np.any(covered, axis=0)).tolist():
        x, y = Fraction(2 * column + 1, width) - 1, Fraction(2 * row + 1, height) - 1
        best = None
        for t, corners in enumerate(clip):
            if not covered[t][row, column]:
                continue
            nearness = exact_nearness(corners, x, y, by_w)
            is_nearer = nearness is not None and (best is None or nearness > best)
            if seen[row, column] < 0 or is_nearer:
                seen[row, column], best = t, nearness
    return seen


def in_range(clip: np.ndarray) -> np.ndarray:
    """Return the triangles whose corners lie between the near and the far plane: depth is not cut at a pixel."""
    z, w = clip[..., 2], clip[..., 3]
    return clip[((w > 0) & (np.abs(z) <= w)).all(axis=1)]


@given(st.one_of(perspective_triangles(4), grid_triangles(4)))
def test_pictures_are_those_of_rational_arithmetic(case) -> None:
    clip, size = case
    clip = in_range(clip)
    assert np.array_equal(render(ClipScene(clip, size=size), RAYS).primitive, reference(clip, size))


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.0, 1e-17, 1e-15, 1e-13]))
def test_planes_a_few_units_of_the_last_place_apart(seed: int, gap: float) -> None:
    # One plane, cut into other triangles and moved by rounding errors: float64 alone cannot tell them apart.
    generator, size = np.random.default_rng(seed), (6, 5)
    slope = generator.uniform(-0.3, 0.3, 3)
    points = generator.uniform(-3, 9, (5, 3, 2))
    w = generator.uniform(1, 3, (5, 3))
    clip = clip_of_window(points, size, w)
    clip[..., 2] = slope[0] * clip[..., 0] + slope[1] * clip[..., 1] + slope[2] * w
    clip[..., 2] += gap * generator.integers(-2, 3, (5, 3))
    clip = in_range(clip)
    scene = ClipScene(clip, size=size)
    assert np.array_equal(render(scene, RAYS).primitive, reference(clip, size))


def test_some_of_them_are_decided_in_whole_numbers_and_some_in_floats() -> None:
    clip = clip_of_window([BIG] * 3, (4, 4), [[1.0, 3.0, 2.0]], [[0.1, 0.2, 0.3]])
    clip[1, :, 2] -= 0.25
    clip[2, :, 2] -= 0.25
    clip[2, 0, 2] = np.nextafter(clip[2, 0, 2], -1)
    found = trace(ClipScene(clip, size=(4, 4)), RAYS).stage("depth")
    kinds = np.array(found.steps.kinds)[found.steps.kind]
    assert set(kinds[found.triangle == 0]) == {"ray-first"}
    assert set(kinds[found.triangle == 1]) == {"ray"}
    assert set(kinds[found.triangle == 2]) == {"ray-exact"}
    assert found.columns["passes"].all()


@given(ANY_TRIANGLES, st.booleans())
def test_values_are_within_their_bound(case, by_w: bool) -> None:
    clip, (width, height) = case
    planes = set_up_ray_planes(clip, (width, height), by_w)
    generator = np.random.default_rng(len(clip))
    triangle = np.repeat(np.arange(len(clip)), 5)
    m = generator.integers(-width, width + 1, len(triangle))
    n = generator.integers(-height, height + 1, len(triangle))
    value, bound = planes.values(triangle, m, n)
    for f, t in enumerate(triangle.tolist()):
        x, y = Fraction(int(m[f]), width), Fraction(int(n[f]), height)
        wanted = exact_nearness(clip[t], x, y, by_w)
        whole = exact_plane(clip[t].tolist(), by_w)
        assert (wanted is None) == (whole is None)
        if wanted is None:
            assert bound[f] == np.inf
            continue
        assert (whole.a * x + whole.b * y + whole.c) / whole.d == wanted
        assert bound[f] == np.inf or abs(Fraction(float(value[f])) - wanted) <= Fraction(float(bound[f]))


def test_coordinates_from_very_small_to_very_large() -> None:
    # Products fall below or near the ends of float64: the float values are left out or bounded, never wrong.
    for size_of in (1e-150, 1e-60, 1e59):
        clip = clip_of_window([BIG] * 3, (4, 4), 1.0, [[0.3] * 3, [0.1] * 3, [0.2] * 3]) * size_of
        assert (render(ClipScene(clip, size=(4, 4)), RAYS).primitive == 1).all()


@pytest.mark.parametrize("order", [[0, 1], [1, 0]])
def test_a_tie_keeps_the_triangle_that_came_first_and_a_hair_decides(order: list[int]) -> None:
    clip = clip_of_window([BIG, BIG], (4, 4), 2.0, 0.25)[order]
    assert (render(ClipScene(clip, size=(4, 4)), RAYS).primitive == 0).all()
    clip[1, :, 2] = np.nextafter(clip[1, :, 2], 0)
    assert (render(ClipScene(clip, size=(4, 4)), RAYS).primitive == 1).all()
    assert (render(ClipScene(clip, size=(4, 4))).primitive == 0).all()


def test_triangles_through_each_other() -> None:
    clip = clip_of_window([BIG, BIG], (4, 4))
    clip[0, :, 2] = 0.2 - 0.4 * (clip[0, :, 0] + 1) / 2
    clip[1, :, 2] = -0.2 + 0.4 * (clip[1, :, 0] + 1) / 2
    assert text(render(ClipScene(clip, size=(4, 4)), RAYS).primitive + 1) == ["2211"] * 4


def test_what_lies_on_the_far_plane_is_seen_as_there_is_no_cleared_depth() -> None:
    clip = clip_of_window([BIG], (4, 4), 1.0, 1.0)
    assert (render(ClipScene(clip, size=(4, 4)), RAYS).primitive == 0).all()
    assert (render(ClipScene(clip, size=(4, 4))).primitive == -1).all()


@pytest.mark.parametrize("depth", table.names("depth"))
def test_the_depth_format_has_no_say_and_the_buffer_holds_what_is_seen(depth: str) -> None:
    scene = scattered(1, "perspective")
    shown = render(scene, Settings(visibility="ray-casting", depth=depth))
    assert np.array_equal(shown.primitive, render(scene, RAYS).primitive)
    tested = render(scene, Settings(depth=depth))
    same = shown.primitive == tested.primitive
    assert same.mean() > 0.99
    assert np.array_equal(shown.depth[same], tested.depth[same])


def scattered(seed: int, projection: str) -> Scene:
    generator = np.random.default_rng(seed)
    positions = generator.normal(size=(40, 3, 3)) @ random_rotation(generator)
    mesh = Mesh(positions.reshape(-1, 3), np.arange(120).reshape(-1, 3))
    camera = Camera([0, 0, 6], [0, 0, 0], near=0.5, far=20, projection=projection, view_height=4.0)
    return Scene((mesh,), camera, size=(32, 24))


@given(st.integers(0, 2**32 - 1), st.sampled_from(["perspective", "orthographic"]))
def test_the_finest_depth_buffer_differs_only_where_snapping_moves_a_crossing(
    seed: int, projection: str
) -> None:
    # A snapped triangle is at a pixel as deep as the triangle within 1/512 pixel of it, in x and in y.
    scene = scattered(seed, projection)
    width, height = scene.size
    planes = set_up_ray_planes(clip_corners(scene), scene.size, by_w=False)
    slope = (np.abs(planes.a) * 2 / width + np.abs(planes.b) * 2 / height) / np.abs(planes.d)
    for clipping in ("homogeneous", "sutherland-hodgman"):
        chosen = Settings(clipping=clipping, depth="fixed-38")
        shown, nearest = render(scene, chosen).primitive, visible_triangles(scene, chosen)
        row, column = np.nonzero(shown != nearest)
        pair = np.stack([nearest[row, column], shown[row, column]])
        assert (pair >= 0).all()
        m, n = planes.rays(column, row, 0.5)
        nearer, farther = (planes.values(triangle, m, n)[0] for triangle in pair)
        assert (np.abs(nearer - farther) <= slope[pair].sum(axis=0) / 512 + 2.0**-35).all()


def test_the_nearest_triangle_is_the_reference() -> None:
    scene = ClipScene(clip_of_window([BIG, BIG], (4, 4), 1.0, [[0.5] * 3, [0.25] * 3]), size=(4, 4))
    wanted = visible_triangles(scene)
    assert (wanted == 1).all()
    assert (render(scene, Settings(visibility="last-drawn")).primitive == wanted).all()


def test_drawn_as_given() -> None:
    drawing = table.get("visibility", "ray-casting").function(np.zeros((3, 3, 4)))
    assert drawing.order.tolist() == [0, 1, 2]
    assert drawing.decides is not None
