import pytest

from widgets.space.frame_corner import FrameRate


def rate_of(*times: float) -> float | None:
    rate = FrameRate()
    for time in times:
        rate.add(time)
    return rate.per_second()


def test_one_picture_has_no_rate():
    assert rate_of() is None
    assert rate_of(5.0) is None


def test_the_rate_is_that_of_the_median_interval():
    assert rate_of(0.0, 0.1, 0.2, 0.3) == pytest.approx(10)
    assert rate_of(0.0, 0.1, 0.8, 0.9) == pytest.approx(10), "the hand has rested once"


def test_only_the_last_second_counts():
    slow = [0.25 * k for k in range(8)]
    fast = [2.0 + 0.05 * k for k in range(25)]
    assert rate_of(*slow, *fast) == pytest.approx(20)


def test_a_pause_of_more_than_a_second_begins_anew():
    assert rate_of(0.0, 0.1, 0.2, 5.0) is None
    assert rate_of(0.0, 0.1, 0.2, 5.0, 5.5) == pytest.approx(2)


def test_two_pictures_at_the_same_time_have_no_rate():
    assert rate_of(1.0, 1.0) is None
