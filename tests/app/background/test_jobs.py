"""A job releases what it worked on, reports an expected error, and raises any other."""

from threading import Event
from weakref import ref

import pytest
from PySide6.QtCore import QThread
from pytestqt.qtbot import QtBot

from app import background
from app.background import Job, ending_within, is_work_left


class Large:
    """Something that should not stay in memory."""


@pytest.mark.parametrize("is_cancelled", [False, True])
def test_what_was_worked_on_goes_when_the_work_is_done_or_nobody_waits_for_it(
    qtbot: QtBot, is_cancelled: bool
) -> None:
    job, large = Job(), Large()
    seen = ref(large)

    def work(progress: object, is_cancelled: object, given: Large = large) -> int:
        return 1 if given else 0

    with qtbot.waitSignal(job.ended):
        job.start(work)
        if is_cancelled:
            job.cancel()
    del work, large
    qtbot.waitUntil(lambda: seen() is None)
    job.shut_down()


@pytest.mark.parametrize(
    ("error", "is_expected"), [(ValueError("a wrong scene"), True), (LookupError("a mistake"), False)]
)
def test_only_an_expected_error_is_reported(qtbot: QtBot, error: Exception, is_expected: bool) -> None:
    job, reported = Job(expected=(ValueError,)), []

    def work(*_: object) -> None:
        raise error

    job.failed.connect(reported.append)
    with qtbot.captureExceptions() as raised, qtbot.waitSignal(job.ended):
        job.start(work)
    job.shut_down()
    assert reported == [error] * is_expected
    assert [each for _, each, _ in raised] == [error] * (not is_expected)


def test_ended_threads_are_held_no_longer(qtbot: QtBot) -> None:
    job = Job()
    for _ in range(10):
        with qtbot.waitSignal(job.succeeded):
            job.call(lambda: 1)
    qtbot.wait(1)
    # The last one is told to go once it has ended altogether.
    qtbot.waitUntil(lambda: len(job.findChildren(QThread)) <= 2)
    job.shut_down()


def test_work_without_end_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "_left", [])
    job, is_over = Job(), Event()
    job.call(is_over.wait)
    with ending_within(0.05):
        job.shut_down()
    assert is_work_left()
    is_over.set()
    (left,) = background._left
    assert left.wait()
