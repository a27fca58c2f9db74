"""Logarithmic axes with places of their own for 0 and infinity."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from widgets.charts.scale import scale_of, time_text

VALUES = st.lists(st.floats(0, 1e300) | st.just(float("inf")), min_size=1, max_size=12)


def test_zero_stands_below_every_other_value() -> None:
    values = np.array([0.0, 1e-6, 3.0, 1e4])
    scale = scale_of(values)
    places = scale.positions(values)
    assert scale.has_zero
    assert not scale.has_infinite
    assert (np.diff(places) > 0).all()
    assert places[0] < scale.separators[0] < places[1]
    assert scale.start < places[0]


def test_without_zero_there_is_no_place_for_it() -> None:
    scale = scale_of(np.array([1.0, 10.0]))
    assert scale.separators == ()
    assert scale.start == scale.low


def test_nothing_but_zeros_still_has_an_axis() -> None:
    scale = scale_of(np.zeros(3))
    assert scale.start < scale.positions(np.zeros(1))[0] < scale.separators[0]


def test_what_is_no_size_has_no_place() -> None:
    scale = scale_of(np.array([1.0, np.nan, -1.0]))
    assert np.isnan(scale.positions(np.array([np.nan, -1.0]))).all()
    assert not np.isnan(scale.positions(np.array([1.0]))).any()


@given(VALUES)
def test_positions_keep_the_order_and_stay_on_the_axis(values: list[float]) -> None:
    array = np.array(sorted(values))
    scale = scale_of(array)
    places = scale.positions(array)
    assert (np.diff(places) >= 0).all()
    assert (places >= scale.start).all()
    assert (places <= scale.stop).all()


@given(VALUES)
def test_labels_stand_where_their_value_does(values: list[float]) -> None:
    scale = scale_of(np.array(values))
    for position, text in scale.ticks(scale.start, scale.stop, ""):
        if text == "0":
            assert position == scale.positions(np.zeros(1))[0]
        elif text == "∞":
            assert position == scale.positions(np.array([np.inf]))[0]
        else:
            value = float(text.replace(",", "").replace("−", "-"))
            assert scale.positions(np.array([value]))[0] == pytest.approx(position)


def test_few_decades_have_more_labels() -> None:
    few, many = scale_of(np.array([1.0, 20.0])), scale_of(np.array([1.0, 1e9]))
    assert [text for _, text in few.ticks(few.start, few.stop, "")] == ["1", "2", "5", "10", "20"]
    texts = [text for _, text in many.ticks(many.start, many.stop, "")]
    assert len(texts) <= 7
    assert "100" in texts


def test_times_have_a_prefix() -> None:
    assert [time_text(seconds) for seconds in (2.5, 0.0015, 3e-6, 1e-7, 0)] == [
        "2.5 s",
        "1.5 ms",
        "3 µs",
        "100 ns",
        "0 s",
    ]
    scale = scale_of(np.array([1e-6, 1e-3]))
    assert "10 µs" in [text for _, text in scale.ticks(scale.start, scale.stop, "s")]
