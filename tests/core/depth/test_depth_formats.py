"""Depth formats: what each stores, and where it tells two surfaces apart: counted against exact ray casting."""

from fractions import Fraction
from math import log2 as library_log2

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera, ClipScene, Mesh, Scene, Settings, render
from core.depth.formats import FARTHEST_W, NEAREST_W, as_unsigned, log2, log2_of, logarithmic_depth
from core.depth.measured import visible_triangles
from core.methods import table
from core.transform.matrices import reversed_clip_depth
from tests.core.strategies import clip_of_window

FORMATS = table.names("depth")
WITHOUT_W = [name for name in FORMATS if "perspective" not in table.get("depth", name).needs]
SHARE = st.floats(0, 1)


@given(SHARE, st.sampled_from([24, 16]))
def test_whole_numbers_are_the_nearest_ones(depth: float, bits: int) -> None:
    steps = 2**bits - 1
    stored = as_unsigned(np.array([depth]), float(steps))
    assert stored.dtype == np.float32
    assert stored[0] == int(stored[0])
    # One rounding of the product, then the nearest whole number.
    assert abs(Fraction(float(stored[0])) - Fraction(depth) * steps) <= Fraction(1, 2) + Fraction(
        steps, 2**53
    )


def test_half_a_step_goes_to_the_even_one() -> None:
    assert as_unsigned(np.array([0.5 / 65535, 1.5 / 65535, 2.5 / 65535]), 65535.0).tolist() == [0, 2, 2]
    assert as_unsigned(np.array([0.0, 1.0]), 65535.0).tolist() == [0, 65535]


@given(st.lists(st.floats(1e-300, 1e300), min_size=1, max_size=20))
def test_logarithms_are_those_of_the_library_and_the_same_in_every_batch(values: list[float]) -> None:
    array = np.array(values)
    found = log2(array)
    for value, of_array in zip(values, found.tolist(), strict=True):
        assert of_array == log2_of(value) == log2(np.array([value]))[0]
        assert abs(of_array - library_log2(value)) <= 4e-16 * max(abs(library_log2(value)), 1)
    assert np.array_equal(log2(np.repeat(array, 2)[::2]), found)


def test_powers_of_two_have_whole_logarithms() -> None:
    exponents = np.arange(-1022, 1024)
    assert np.array_equal(log2(2.0**exponents), exponents)


def test_the_logarithm_is_0_at_the_near_plane_and_1_at_the_far_plane() -> None:
    found = logarithmic_depth(np.array([1 / 0.25, 1 / 16, 1 / 1024, 0.0, -1.0, np.nan]), 0.25, 1024.0)
    assert found.tolist() == [0, 0.5, 1, 1, 1, 1]


def test_clip_positions_have_a_range_of_their_own() -> None:
    clip = clip_of_window([[(0, 0), (8, 0), (0, 8)]], (4, 4), 8.0, 0.25)
    depth = render(ClipScene(clip, size=(4, 4)), Settings(depth="logarithmic")).depth
    assert (depth == np.float32(19 / 32)).all()
    assert (NEAREST_W, FARTHEST_W) == (2.0**-16, 2.0**16)
    given_z = render(ClipScene(clip, size=(4, 4)), Settings(depth="reversed-z")).depth
    assert (given_z == np.float32(0.375)).all()


def projected(distance: float, near: float, far: float) -> Fraction:
    """Return the exact reversed depth at a distance."""
    w, n, f = (Fraction(value) for value in (distance, near, far))
    return n * (f - w) / ((f - n) * w)


@given(st.floats(0, 1, exclude_max=True), st.sampled_from([(0.1, 1e2), (0.01, 1e6), (1e-3, 1e9)]))
def test_reversed_depth_of_the_camera_keeps_what_1_minus_z_has_lost(share: float, planes) -> None:
    near, far = planes
    w = np.array([near * (far / near) ** share])
    found = Fraction(float(reversed_clip_depth(np.empty(1), w, planes)[0] / w[0]))
    wanted = projected(float(w[0]), near, far)
    assert abs(found - wanted) <= wanted * Fraction(1, 2**50) + Fraction(near / far) / 2**50


def test_1_minus_z_has_lost_it() -> None:
    near, far, distance = 1e-3, 1e9, 5e8
    z = (far + near) / (far - near) * distance - 2 * far * near / (far - near)
    wanted = projected(distance, near, far)
    own = reversed_clip_depth(np.array([z]), np.array([distance]), (near, far))[0] / distance
    from_z = reversed_clip_depth(np.array([z]), np.array([distance]), None)[0] / distance
    assert abs(Fraction(float(own)) / wanted - 1) < Fraction(1, 2**50)
    assert abs(Fraction(float(from_z)) / wanted - 1) > Fraction(1, 2**20)


def rectangle(distance: float, slant: float, half: float) -> np.ndarray:
    """Return corners (4, 3) of a rectangle ``distance`` before the eye, its right side ``slant`` farther."""
    return np.array(
        [
            [-half, -half, -distance],
            [half, -half, -distance - slant],
            [half, half, -distance - slant],
            [-half, half, -distance],
        ]
    )


def layered(distance: float, gap: float, near: float, far: float, projection: str = "perspective") -> Scene:
    """Return two slanted rectangles ``gap`` apart that fill the picture, the far one drawn first."""
    half, slant = distance, 0.02 * distance
    behind, before = rectangle(distance + gap, slant, half), rectangle(distance, slant, half)
    mesh = Mesh(np.concatenate([behind, before]), [[0, 1, 2], [0, 2, 3], [4, 5, 7], [5, 6, 7]])
    camera = Camera(
        [0, 0, 0], [0, 0, -1], near=near, far=far, projection=projection, view_height=1.2 * distance
    )
    return Scene((mesh,), camera, size=(48, 40))


def wrong_pixels(scene: Scene, depth: str) -> int:
    settings = Settings(depth=depth, shading="unlit")
    return int((render(scene, settings).primitive != visible_triangles(scene, settings)).sum())


def test_z_fighting_far_from_the_eye() -> None:
    # 0.1 to 1000; at 500 a step of 24 bits is 0.15 deep, one of 16 bits 38, one of reversed z 0.00003.
    scene = layered(500.0, 0.05, 0.1, 1000.0)
    wrong = {name: wrong_pixels(scene, name) for name in FORMATS}
    everything = 48 * 40
    assert wrong["z-16"] == everything
    assert wrong["z-24"] > everything // 4
    assert wrong["z-float32"] > everything // 4
    for name in ("reversed-z", "logarithmic", "inverse-w", "fixed-38"):
        assert wrong[name] == 0, name


def test_with_a_gap_of_many_steps_24_bits_hold_and_16_do_not() -> None:
    scene = layered(500.0, 2.0, 0.1, 1000.0)
    wrong = {name: wrong_pixels(scene, name) for name in FORMATS}
    assert wrong["z-16"] > 48 * 40 // 4
    assert {name for name, count in wrong.items() if count} == {"z-16"}


def test_near_to_the_eye_16_bits_are_enough() -> None:
    assert wrong_pixels(layered(0.5, 0.01, 0.1, 1000.0), "z-16") == 0


def test_reversed_z_is_better_than_z_at_the_far_plane() -> None:
    for gap in (0.02, 0.1):
        scene = layered(950.0, gap, 0.1, 1000.0)
        assert wrong_pixels(scene, "z-float32") > wrong_pixels(scene, "reversed-z") == 0


@pytest.mark.parametrize("distance", [1.0, 1e3, 1e6, 9e8])
def test_reversed_and_logarithmic_hold_from_a_millimetre_to_a_million_kilometres(distance: float) -> None:
    scene = layered(distance, 1e-5 * distance, 1e-3, 1e9)
    assert wrong_pixels(scene, "logarithmic") == 0
    assert wrong_pixels(scene, "reversed-z") == 0
    if distance > 10:
        assert wrong_pixels(scene, "z-float32") > 0
        assert wrong_pixels(scene, "z-24") == 48 * 40


@pytest.mark.parametrize("name", WITHOUT_W)
def test_orthographic_depth_is_linear(name: str) -> None:
    # 0.1 to 1000 in equal steps: 0.015 of 16 bits, wherever it is.
    for distance in (10.0, 500.0, 900.0):
        scene = layered(distance, 0.1, 0.1, 1000.0, "orthographic")
        assert wrong_pixels(scene, name) == 0
    frame = render(layered(500.0, 0.1, 0.1, 1000.0, "orthographic"), Settings(depth=name, shading="unlit"))
    kept = table.get("depth", name).function()
    shares = frame.depth / kept.scale
    nearest = 1 - shares if kept.larger_is_nearer else shares
    # The left column's centres are 352.5 left of the middle of a rectangle of 1000 that recedes by 10.
    assert np.allclose(nearest[:, 0], (500 - 0.1 + 10 * 0.1475) / 999.9, atol=1e-5)
    assert (np.diff(nearest, axis=1) > 0).all()


def test_orthographic_z_fights_in_16_bits_where_24_hold() -> None:
    scene = layered(500.0, 0.002, 0.1, 1000.0, "orthographic")
    assert wrong_pixels(scene, "z-16") > 0
    assert wrong_pixels(scene, "z-24") == wrong_pixels(scene, "reversed-z") == 0


def test_near_and_far_plane_cut_the_same_pixels_for_all_formats() -> None:
    # A floor that begins behind the eye and ends behind the far plane.
    floor = Mesh([[-9, -1, 5], [9, -1, 5], [9, -1, -80], [-9, -1, -80]], [[0, 1, 2], [0, 2, 3]])
    wall = Mesh([[-2, -3, -2], [2, -3, -60], [2, 3, -60], [-2, 3, -2]], [[0, 1, 2], [0, 2, 3]])
    camera = Camera([0, 0, 0], [0, 0, -1], near=2.5, far=40)
    scene = Scene((floor, wall), camera, size=(40, 30))
    for clipping in ("homogeneous", "sutherland-hodgman"):
        frames = [render(scene, Settings(depth=name, clipping=clipping)) for name in FORMATS]
        for frame in frames[1:]:
            assert np.array_equal(frame.cover_count, frames[0].cover_count)
        assert 0 < (frames[0].cover_count > 0).mean() < 1


def test_a_mesh_with_a_projection_of_its_own_has_no_distance_in_w() -> None:
    # Its w is not the distance: reversed z is then made from z, and still puts the nearer one first.
    half = np.diag([1.0, 1.0, 1.0, 0.5])
    far = Mesh([[-9, -9, -20], [9, -9, -20], [0, 9, -20]], [[0, 1, 2]])
    near = Mesh([[-9, -9, -8], [9, -9, -8], [0, 9, -8]], [[0, 1, 2]], transform=half)
    scene = Scene((far, near), Camera([0, 0, 0], [0, 0, -1], near=1, far=100), size=(16, 12))
    frame = render(scene, Settings(depth="reversed-z"))
    assert frame.primitive[6, 8] == 1
    assert np.isclose(frame.depth[6, 8], float(projected(16, 1, 100)), rtol=1e-6)
