"""Cuts between bands: every row once, no band empty, and all bands done at the same time."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.fast_path.workers.sharing import STEP, even_cuts, moved_cuts, rows_of

TIMES = st.lists(st.floats(0, 10), min_size=2, max_size=6)


@given(st.integers(1, 8), st.integers(0, 40), st.data())
def test_every_row_belongs_to_one_band_and_no_band_is_empty(count: int, more: int, data) -> None:
    height = count + more
    inner = sorted(data.draw(st.lists(st.floats(0, 1), min_size=count - 1, max_size=count - 1), label="cuts"))
    rows = rows_of(np.array([0.0, *inner, 1.0]), height)
    assert [first for first, _ in rows] == [0, *(end for _, end in rows[:-1])]
    assert rows[-1][1] == height
    assert all(first < end for first, end in rows)


@given(TIMES, st.data())
def test_cuts_stay_in_order_and_move_a_little_at_a_time(times: list[float], data) -> None:
    count = len(times)
    fixed = data.draw(st.lists(st.floats(0, 10), min_size=count, max_size=count), label="fixed")
    cuts = even_cuts(count)
    for _ in range(20):
        moved = moved_cuts(cuts, np.array(times), np.array(fixed))
        assert (moved[0], moved[-1]) == (0, 1)
        assert (np.diff(moved) >= 0).all()
        assert np.abs(moved - cuts).max() <= STEP + 1e-12
        cuts = moved


@pytest.mark.parametrize("count", [2, 3, 5])
@pytest.mark.parametrize("guess", [0.0, 1.0, 2.0])
def test_bands_end_at_the_same_time_however_wrong_the_guess_of_the_fixed_part(
    count: int, guess: float
) -> None:
    # A model in the upper half of the picture, that one process draws more slowly than the others.
    places = np.linspace(0, 1, 2001)
    work = np.concatenate([[0.0], np.cumsum(np.exp(-(((places[1:] - 0.7) / 0.15) ** 2)))])
    work *= 30 / work[-1]
    fixed, pace = np.full(count, 4.0), np.linspace(1.0, 1.3, count)
    cuts = even_cuts(count)
    for _ in range(60):
        seconds = fixed + pace * np.diff(np.interp(cuts, places, work))
        cuts = moved_cuts(cuts, seconds, guess * fixed)
    assert seconds.max() / seconds.min() < 1.02


def test_bands_that_took_no_time_stay() -> None:
    cuts = even_cuts(3)
    np.testing.assert_array_equal(moved_cuts(cuts, np.zeros(3), np.zeros(3)), cuts)
