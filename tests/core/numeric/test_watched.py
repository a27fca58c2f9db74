"""Long work reports to whoever watches it, in its own thread alone, and ends where it is cancelled."""

from threading import Thread

import pytest

from core.numeric.watched import AbandonedError, report, watched, work


def test_named_work_is_reported_at_once_and_then_now_and_then() -> None:
    told: list[tuple[float | None, str]] = []
    with watched(lambda fraction, doing: told.append((fraction, doing))):
        report(0.1)
        with work("building"):
            for k in range(1000):
                report(k / 1000)
        with work(""):
            report(0.5)
    report(0.9)
    assert told[0] == (None, "building")
    assert {doing for _, doing in told} == {"building"}
    assert len(told) < 1000
    assert [fraction for fraction, _ in told[1:]] == sorted(fraction for fraction, _ in told[1:])


def test_cancelled_work_ends_and_that_of_other_threads_goes_on() -> None:
    ends: list[str] = []

    def other() -> None:
        report(0.5)
        ends.append("other")

    with watched(None, lambda: True):
        with pytest.raises(AbandonedError):
            report(0.5)
        thread = Thread(target=other)
        thread.start()
        thread.join()
    report(0.5)
    assert ends == ["other"]
