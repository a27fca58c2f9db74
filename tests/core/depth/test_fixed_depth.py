"""The depth ``fixed-38``: whole numbers on planes, the same by every fill, as near to the rational depth as stated."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Frame, Settings, render
from core.depth.fixed_depth import DEPTH_BITS, SCALE, SLACK, set_up_fixed_planes
from core.methods import table
from tests.core.drawing import TESTING_FILLS
from tests.core.meshes import clip_of_view, icosphere, random_rotation
from tests.core.spans.adversarial import PROJECTED, SIZES, drawn, mixed, projected
from tests.core.strategies import clip_of_window

SEEDS = st.integers(0, 2**32 - 1)


def with_fill(clip, size: tuple[int, int], fill: str, depth: str = "fixed-38") -> Frame:
    return render(ClipScene(clip, size=size), Settings(depth=depth, fill=fill))


@given(SEEDS, st.sampled_from([(8, 6), (61, 97), (3, 257)]))
def test_every_fill_stores_the_same(seed: int, size: tuple[int, int]) -> None:
    clip = mixed(np.random.default_rng(seed), 24, size)
    expected = with_fill(clip, size, "brute-force")
    for fill in TESTING_FILLS:
        frame = with_fill(clip, size, fill)
        assert np.array_equal(frame.primitive, expected.primitive), fill
        assert np.array_equal(frame.depth, expected.depth), fill


@given(SEEDS, st.sampled_from(SIZES))
def test_what_is_stored_are_whole_numbers_near_the_float_depth(seed: int, size: tuple[int, int]) -> None:
    # Corners behind the eye and beyond the snapping limit, triangles cut by the planes, seen edge-on.
    clip = mixed(np.random.default_rng(seed), 1, size)
    fixed, single = (with_fill(clip, size, "spans", depth) for depth in ("fixed-38", "z-float32"))
    seen = fixed.primitive >= 0
    assert (fixed.depth == np.rint(fixed.depth)).all()
    assert (np.abs(fixed.depth[seen] - SCALE / 2) <= SCALE / 2 + SLACK).all()
    assert (fixed.depth[~seen] == SCALE).all()
    # A triangle between the planes has its fixed depth from snapped corners, any other from unsnapped ones.
    z, w = clip[0, :, 2], clip[0, :, 3]
    if not ((w > 0).all() and (np.abs(z) <= w).all()):
        assert np.array_equal(seen, single.primitive >= 0)
        assert np.allclose(fixed.depth[seen] / SCALE, single.depth[seen], rtol=0, atol=2.0**-24)


def rational_depth(corners, depth, column: int, row: int) -> Fraction:
    """Return the depth at a pixel's centre in units of 2^-38, of the plane through three corners."""
    (x0, y0), (x1, y1), (x2, y2) = ((Fraction(float(x)), Fraction(float(y))) for x, y in corners)
    z0, z1, z2 = (Fraction(float(z)) for z in depth)
    x, y = column + Fraction(1, 2) - x0, row + Fraction(1, 2) - y0
    x1, y1, x2, y2 = x1 - x0, y1 - y0, x2 - x0, y2 - y0
    value = z0 + ((z1 - z0) * (x * y2 - x2 * y) + (z2 - z0) * (x1 * y - x * y1)) / (x1 * y2 - x2 * y1)
    return value * 2**DEPTH_BITS


def assert_within_the_bound(corners: np.ndarray, depth: np.ndarray, size: tuple[int, int], count: int) -> int:
    """Compare ``count`` pixels of snapped triangles (T, 3, 2); return how many triangles have a plane."""
    x, y = corners.transpose(2, 1, 0)
    area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    planes = set_up_fixed_planes(x, y, depth.T, area, np.ones(len(corners), bool), 0.5)
    pixels = drawn(clip_of_window(corners, size), size, "spans")
    for triangle, row, column in pixels[:: max(len(pixels) // count, 1)].tolist():
        if not planes.is_linear[triangle]:
            continue
        where = (np.array([n]) for n in (triangle, column, row))
        stored = int(planes.planes.at(*where)[0])
        away = abs(stored - rational_depth(corners[triangle], depth[triangle], column, row))
        columns, rows = np.abs(np.array([column + 0.5, row + 0.5]) - corners[triangle, 0])
        assert away <= 0.6 * (2 + columns + rows)
    return int(planes.is_linear.sum())


@given(SEEDS, st.sampled_from(list(PROJECTED)), st.booleans())
def test_error_stays_within_the_bound(seed: int, family: str, is_level: bool) -> None:
    generator, size = np.random.default_rng(seed), (700, 500)
    corners = projected(generator, 30, size, family)
    depth = generator.random((30, 3))
    if is_level:
        # Corners on one plane of little slope: the terms of a sliver's slopes cancel.
        depth = 0.4 + corners @ generator.uniform(-1e-6, 1e-6, 2)
    assert_within_the_bound(corners, depth, size, 20)


def test_error_of_triangles_of_the_least_area_stays_within_the_bound() -> None:
    # Twice their area is 2^-16, so they have no pixel but a corner's; a slope would be nothing but rounding.
    generator, size = np.random.default_rng(8), (1600, 1200)
    corners = []
    while len(corners) < 300:
        start = generator.integers(0, 256 * 100, 2)
        side = generator.integers([800, 600], [1500, 1100]) * 256 + 128 - start
        a, b = (int(n) for n in side)
        if np.gcd(a, b) == 1:
            # a y - b x = 1: no grid point lies nearer to the side.
            x = pow(-b, -1, a)
            beside = np.array([x, (1 + x * b) // a])
            corners.append(np.array([start, start + side, start + beside]) / 256)
    stacked = np.array(corners)
    depth = 0.4 + stacked @ np.array([1.7e-4, -1.2e-4])
    assert assert_within_the_bound(stacked, depth, size, 300) < len(stacked)


@pytest.mark.parametrize("level", [0.0, 2.0**-39, 0.5, 1 - 2.0**-39, 1.0])
def test_level_depths_are_rounded_once(level: float) -> None:
    size = (16, 16)
    clip = clip_of_window([[(0, 0), (40, 0), (0, 40)]], size, 1.0, 2 * level - 1)
    depth = with_fill(clip, size, "spans").depth
    # What is not nearer than the cleared buffer is not drawn: there it is the same number.
    assert (depth == np.rint(level * SCALE)).all()


@given(SEEDS)
def test_order_of_a_closed_mesh_changes_nothing_but_at_ties(seed: int) -> None:
    generator, size = np.random.default_rng(seed), (80, 64)
    positions, triangles = icosphere(2)
    eye = np.array([0.3, -0.2, 2.2])
    turned = positions @ random_rotation(generator)
    clip = clip_of_view(turned, triangles, eye, np.eye(3), size[0] / size[1])
    order = generator.permutation(len(clip))
    frame, shuffled = with_fill(clip, size, "spans"), with_fill(clip[order], size, "spans")
    assert np.array_equal(frame.depth, shuffled.depth)
    same = np.append(order, -1)[shuffled.primitive] == frame.primitive
    assert (~same).sum() <= 2


def test_all_depth_methods_agree_on_planes_apart() -> None:
    # Level triangles a step of 16 bits apart, drawn in any order: only the nearest is seen. None of it is in w.
    size, count = (12, 9), 40
    corners = np.tile([(-5.0, -5.0), (60.0, -5.0), (-5.0, 60.0)], (count, 1, 1))
    place = np.random.default_rng(2).permutation(count)
    clip = clip_of_window(corners, size, 1.0, (place * 2.0**-14)[:, None])
    for depth in table.names("depth"):
        if "perspective" in table.get("depth", depth).needs:
            continue
        assert (with_fill(clip, size, "spans", depth).primitive == place.argmin()).all()
