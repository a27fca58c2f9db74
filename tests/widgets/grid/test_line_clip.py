import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from widgets.grid.view import clip_segments

BOX = (0.0, 0.0, 10.0, 8.0)
NUMBERS = st.one_of(
    st.floats(-30, 30), st.sampled_from([1e9, -1e9, 1e300, -1.7e308, 1.7e308, np.inf, np.nan])
)


@given(st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS), max_size=8), st.booleans())
def test_what_comes_out_is_finite_and_in_the_box(ends: list[tuple[float, ...]], extended: bool) -> None:
    cut, source = clip_segments(np.array(ends, dtype=np.float64).reshape(-1, 2, 2), BOX, extended)
    assert np.isfinite(cut).all()
    assert len(cut) == len(source)
    assert (source < len(ends)).all()
    assert (cut >= 0).all()
    assert (cut <= np.array([10, 8])).all()


def test_a_segment_inside_is_untouched() -> None:
    segment = np.array([[[1.0, 2.0], [3.0, 4.0]]])
    cut, _ = clip_segments(segment, BOX)
    assert cut == pytest.approx(segment)


def test_far_ends_keep_their_line() -> None:
    cut, _ = clip_segments(np.array([[[-1e9, -1e9], [1e9, 1e9]]]), BOX)
    assert cut[0] == pytest.approx(np.array([[0, 0], [8, 8]]), abs=1e-5)


def test_a_line_goes_on_past_its_ends() -> None:
    cut, _ = clip_segments(np.array([[[4.0, 4.0], [5.0, 4.0]]]), BOX, extended=True)
    assert cut[0] == pytest.approx(np.array([[0, 4], [10, 4]]))


def test_a_parallel_segment_outside_is_left_out() -> None:
    cut, source = clip_segments(np.array([[[-5.0, 9.0], [15.0, 9.0]], [[0.0, 1.0], [1.0, 1.0]]]), BOX)
    assert source.tolist() == [1]
    assert len(cut) == 1


def test_nothing_gives_nothing() -> None:
    cut, source = clip_segments(np.zeros((0, 2, 2)), BOX)
    assert cut.shape == (0, 2, 2)
    assert source.shape == (0,)
