"""Corners on the 1/256-pixel grid: half to even, up to 2^16 pixels away, in front of the eye only."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.coverage.number_formats import number_format
from core.coverage.snapping import SUBPIXELS, place_corners, snap_one
from tests.core.exact_reference import snapped_window
from tests.core.strategies import ANY_TRIANGLES, clip_of_window


def snapped(point: tuple[float, float], size: tuple[int, int] = (8, 8), w: float = 1.0):
    clip = clip_of_window([[point, (0, 0), (1, 0)]], size, w)
    corners = place_corners(clip, size, "snapped")
    return corners.decided[0, 0], bool(corners.is_projected[0, 0])


@pytest.mark.parametrize(
    ("subpixels", "expected"),
    [
        (0.5, 0),
        (1.5, 2),
        (2.5, 2),
        (3.5, 4),
        (-0.5, 0),
        (-1.5, -2),
        (0.49, 0),
        (0.51, 1),
        (255.5, 256),
        (256.5, 256),
    ],
)
def test_half_a_subpixel_rounds_to_even(subpixels: float, expected: int) -> None:
    position, _ = snapped((subpixels / 256, 1.0))
    assert position.tolist() == [expected / 256, 1.0]


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(
    ("distance", "expected"), [(65536.0, True), (65536 + 1 / 256, False), (65535.998, True), (1e300, False)]
)
def test_the_limit_of_snapping_is_65536_pixels(sign: int, distance: float, expected: bool) -> None:
    size = (8, 8)
    for point in [(sign * distance, 0.0), (0.0, sign * distance)]:
        position, is_projected = snapped(point, size)
        assert is_projected is expected
        assert bool(np.isfinite(position).all()) is expected


@pytest.mark.parametrize("w", [0.0, -0.0, -1.0, -1e-300])
def test_what_is_not_in_front_of_the_eye_has_no_window_position(w: float) -> None:
    clip = np.array([[[0.5, 0.5, 0, w], [0, 0, 0, 1], [1, 0, 0, 2]]])
    corners = place_corners(clip, (4, 4), "snapped")
    assert corners.is_projected.tolist() == [[False, True, True]]
    assert np.isnan(corners.window[0, 0]).all()
    assert np.isnan(corners.decided[0, 0]).all()
    assert corners.window[0, 2].tolist() == [3.0, 2.0]


def test_homogeneous_is_viewport_times_clip() -> None:
    corners = place_corners(np.array([[[0.5, -0.5, 9, 2], [3, 1, 9, -1], [1, 2, 9, 0]]]), (8, 4), "snapped")
    assert corners.homogeneous.tolist() == [[[10.0, 3.0, 2.0], [8.0, 0.0, -1.0], [4.0, 4.0, 0.0]]]


@given(ANY_TRIANGLES)
def test_positions_are_those_of_exact_arithmetic(case) -> None:
    clip, size = case
    corners = place_corners(clip, size, "snapped")
    for t, triangle in enumerate(clip):
        for k, corner in enumerate(triangle):
            place = snapped_window(corner, size)
            assert corners.is_projected[t, k] == (place is not None)
            if place is not None:
                assert corners.decided[t, k].tolist() == [float(p) for p in place]


@given(st.floats(-65536, 65536))
def test_snapping_moves_by_at_most_half_a_subpixel_and_only_once(value: float) -> None:
    once = snap_one(value)
    assert abs(once - value) <= 0.5 / SUBPIXELS
    assert snap_one(once) == once
    assert (once * SUBPIXELS).is_integer()


def test_float64_leaves_every_corner_to_its_homogeneous_position() -> None:
    positions, is_projected = number_format("float64").place(np.zeros((2, 3, 2)))
    assert not is_projected.any()
    assert np.isnan(positions).all()


def test_a_corner_too_far_to_be_snapped_overflows_nothing() -> None:
    # 205 / 2.3e-303 times 256 is beyond float64: such a corner is left alone, without a warning.
    clip = np.array([[[0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], [0.0, 205.0, 0.0, 2.3e-303]]])
    assert place_corners(clip, (16, 16), "snapped").is_projected.tolist() == [[True, True, False]]
