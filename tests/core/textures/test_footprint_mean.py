"""The mean over a footprint against two other derivations: polygons cut texel by texel, in fractions, and samples."""

from fractions import Fraction
from math import floor

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from core import Texture
from core.textures.footprints import PIECE_LIMIT, footprint_means
from core.textures.look_up import texture_colors, wrapped_index

WRAPS = ["repeat", "clamp", "mirror"]
TEXTURE = Texture(np.random.default_rng(11).random((3, 5, 3)).astype(np.float32))
coordinates = st.integers(-80, 80).map(lambda n: n / 8)
positions = st.tuples(coordinates, coordinates)


def slope_footprint(position: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """Return the parallelograms (F, 4, 2) around positions (F, 2) that pixels cover by their slopes (4, F)."""
    right, up = slopes[:2].T, slopes[2:].T
    ways = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
    return np.stack([position + a * right + b * up for a, b in ways], axis=1)


def cut(polygon, axis: int, limit: int, sign: int):
    """Keep the part of a polygon where sign * (coordinate - limit) >= 0, in fractions."""
    kept = []
    for start, end in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        a, b = sign * (start[axis] - limit), sign * (end[axis] - limit)
        if a >= 0:
            kept.append(start)
        if (a > 0 > b) or (a < 0 < b):
            t = a / (a - b)
            kept.append(tuple(p + t * (q - p) for p, q in zip(start, end, strict=True)))
    return kept


def signed_area(polygon) -> Fraction:
    ends = polygon[1:] + polygon[:1]
    return sum((a[0] * b[1] - a[1] * b[0] for a, b in zip(polygon, ends, strict=True)), Fraction(0)) / 2


def mean_by_cutting(quad, wrap: str):
    """Return the exact mean over a convex quadrilateral: its area in every texel, times the texel."""
    polygon = [tuple(map(Fraction, corner)) for corner in quad]
    height, width, channels = TEXTURE.pixels.shape
    total, columns, rows = (
        [Fraction(0)] * channels,
        *([floor(c) for c in axis] for axis in zip(*polygon, strict=True)),
    )
    for row in range(min(rows), max(rows) + 1):
        of_row = cut(cut(polygon, 1, row, 1), 1, row + 1, -1)
        for column in range(min(columns), max(columns) + 1):
            part = cut(cut(of_row, 0, column, 1), 0, column + 1, -1)
            if len(part) < 3:
                continue
            texel = TEXTURE.pixels[wrapped_index(row, height, wrap), wrapped_index(column, width, wrap)]
            area = signed_area(part)
            total = [t + area * Fraction(float(value)) for t, value in zip(total, texel, strict=True)]
    return [value / signed_area(polygon) for value in total]


@given(positions, positions, positions, st.sampled_from(WRAPS))
def test_means_over_parallelograms_are_those_of_exact_arithmetic(middle, right, up, wrap) -> None:
    assume(abs(right[0] * up[1] - right[1] * up[0]) >= 0.05)
    quad = slope_footprint(np.array([middle]), np.array([*right, *up])[:, None])
    found = footprint_means(TEXTURE, quad, wrap)[0]
    expected = [float(value) for value in mean_by_cutting(quad[0].tolist(), wrap)]
    assert np.allclose(found, expected, rtol=0, atol=1e-10)


@pytest.mark.parametrize("wrap", WRAPS)
def test_many_samples_come_near(wrap) -> None:
    generator = np.random.default_rng(5)
    middle, slopes = generator.uniform(-9, 9, (20, 2)), generator.uniform(-6, 6, (4, 20))
    means = footprint_means(TEXTURE, slope_footprint(middle, slopes), wrap)
    count = 400
    steps = (np.arange(count) + 0.5) / count - 0.5
    a, b = (part.ravel() for part in np.meshgrid(steps, steps))
    for k in range(20):
        places = middle[k] + a[:, None] * slopes[:2, k] + b[:, None] * slopes[2:, k]
        sampled = texture_colors(TEXTURE, places / (5, 3), "nearest", wrap)[:, :3].mean(axis=0)
        assert np.allclose(means[k], sampled, atol=0.02)


def test_by_hand() -> None:
    board = Texture(np.array([[0.0, 1.0], [1.0, 0.0]])[..., None])
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    quads = np.stack(
        [
            square,
            square + 0.5,
            2 * square,
            square[::-1],
            square + np.array([0.25, 0]),
            0.125 * square + np.array([1.5, 0.25]),
        ]
    )
    assert footprint_means(board, quads)[:, 0].tolist() == [0, 0.5, 0.5, 0, 0.25, 1]


def test_far_away_repetitions_have_the_same_mean() -> None:
    quad = slope_footprint(np.array([[1.25, 0.5]]), np.array([[3.0], [0.5], [-0.75], [2.0]]))
    near = footprint_means(TEXTURE, quad, "repeat")
    far = footprint_means(TEXTURE, quad + np.array([5.0, 3.0]) * 2.0**20, "repeat")
    assert np.allclose(near, far, atol=1e-9)


def test_what_has_no_mean_is_nan() -> None:
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    quads = np.stack([square + np.nan, square * 0, square + np.inf, square * PIECE_LIMIT, square])
    found = np.isnan(footprint_means(TEXTURE, quads)).all(axis=1)
    assert found.tolist() == [True, True, True, True, False]
    assert footprint_means(TEXTURE, np.empty((0, 4, 2))).shape == (0, 3)
    with pytest.raises(ValueError, match=r"^corners must be \(F, 4, 2\), got \(4, 2\)$"):
        footprint_means(TEXTURE, square)
    with pytest.raises(ValueError, match=r"^wrap must be one of repeat, clamp, mirror, got border$"):
        footprint_means(TEXTURE, square[None], "border")


@pytest.mark.parametrize("depth", [0.0, 0.05, 0.3, 1.0, 3.0])
def test_the_mean_of_the_pixel_stays_within_the_bound_of_perspective(depth) -> None:
    # A pixel from (0, 0) to (1, 1) of a plane with 1/w = 1 + depth x, mapped to 7 x 4 texels by u/w and v/w.
    def place(x, y):
        inverse_w = 1 + depth * x
        return np.stack([7 * x / inverse_w, 4 * y / inverse_w], axis=-1), inverse_w

    steps = (np.arange(700) + 0.5) / 700
    x, y = (part.ravel() for part in np.meshgrid(steps, steps))
    corners, inverse_w = place(np.array([0.0, 1, 1, 0]), np.array([0.0, 0, 1, 1]))
    step = Texture((np.arange(8) < 1).astype(np.float32)[None, :, None])
    pixel = texture_colors(step, place(x, y)[0] / (8, 1), "nearest", "repeat")[:, 0].mean()
    footprint = footprint_means(step, corners[None])[0, 0]
    root = (inverse_w.max() / inverse_w.min()) ** 1.5
    bound = (root - 1) / (root + 1)
    assert abs(pixel - footprint) <= bound + 2e-3
    assert bound < 1
    if depth == 0:
        assert bound == 0
