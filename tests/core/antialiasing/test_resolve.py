"""Resolving samples: weights, border, and the listing."""

import numpy as np
import pytest

from core.antialiasing.resolve import filter_weights, reach_of, resolve_samples, weighted_mean
from core.antialiasing.sampling import ROTATED_GRID, grid_positions
from core.methods import table

POSITIONS = {"2x2": grid_positions(2), "4x4": grid_positions(4), "rotated": ROTATED_GRID}
RANDOM = np.random.default_rng(2).random((16, 4, 5, 4)).astype(np.float32)


@pytest.mark.parametrize("name", table.names("resolve_filter"))
@pytest.mark.parametrize("positions", list(POSITIONS))
def test_every_sample_weighs_the_same_in_all_pixels_together(positions, name):
    weights = filter_weights(POSITIONS[positions], name)
    assert np.array_equal(weights.sum(axis=(0, 1)), np.ones(len(POSITIONS[positions])))


def test_the_box_is_the_mean_of_the_pixel():
    weights = filter_weights(grid_positions(4), "box")
    assert reach_of(weights) == 0
    found = resolve_samples(RANDOM, weights)
    mean = RANDOM.astype(float).cumsum(axis=0)[-1] / 16
    assert np.array_equal(found, mean.astype(np.float32))


def test_weights_of_the_tent_by_hand():
    weights = filter_weights(grid_positions(2), "tent")
    assert reach_of(weights) == 1
    # Along an axis samples lie 1/4 and 3/4 away: they weigh 3/4 and 1/4.
    assert weights[1, 1].tolist() == [9 / 16] * 4
    assert weights[1, 0].tolist() == [0, 3 / 16, 0, 3 / 16]
    assert weights[0, 0].tolist() == [0, 0, 0, 1 / 16]


@pytest.mark.parametrize("name", table.names("resolve_filter"))
@pytest.mark.parametrize("positions", list(POSITIONS))
def test_one_colour_stays_to_the_border(positions, name):
    color = np.full((len(POSITIONS[positions]), 3, 4, 4), np.float32(0.7))
    assert (resolve_samples(color, filter_weights(POSITIONS[positions], name)) == np.float32(0.7)).all()


@pytest.mark.parametrize("name", table.names("resolve_filter"))
@pytest.mark.parametrize("positions", list(POSITIONS))
def test_the_listing_gives_every_pixel(positions, name):
    position = POSITIONS[positions]
    weights = filter_weights(position, name)
    color = RANDOM[: len(position)]
    found = resolve_samples(color, weights)
    for row in range(4):
        for column in range(5):
            values, shares = [], []
            for j in range(3):
                for i in range(3):
                    y, x = row + j - 1, column + i - 1
                    if 0 <= y < 4 and 0 <= x < 5:
                        values += [float(color[s, y, x, 1]) for s in range(len(position))]
                        shares += weights[j, i].tolist()
            assert weighted_mean(values, shares) == found[row, column, 1]


def test_samples_of_the_rotated_grid_are_alone_in_row_column_and_quarter():
    assert len(set(ROTATED_GRID[:, 0])) == len(set(ROTATED_GRID[:, 1])) == 4
    assert (ROTATED_GRID // 0.5).tolist() == [[0, 0], [1, 0], [0, 1], [1, 1]]
    assert np.array_equal(ROTATED_GRID * 256, np.rint(ROTATED_GRID * 256))
