"""What a job has worked on is let go of."""

from weakref import ref

from pytestqt.qtbot import QtBot

from app.background.workers import Job


class Large:
    """Something that should not stay in memory."""


def test_what_was_worked_on_goes_when_the_work_is_done(qtbot: QtBot) -> None:
    job, large = Job(), Large()
    seen = ref(large)

    def work(progress: object, is_cancelled: object, given: Large = large) -> int:
        return 1 if given else 0

    with qtbot.waitSignal(job.succeeded):
        job.start(work)
    del work, large
    qtbot.waitUntil(lambda: seen() is None)


def test_it_goes_too_when_nobody_waits_for_it_any_more(qtbot: QtBot) -> None:
    job, large = Job(), Large()
    seen = ref(large)

    def work(progress: object, is_cancelled: object, given: Large = large) -> int:
        return 1 if given else 0

    job.start(work)
    job.cancel()
    del work, large
    qtbot.waitUntil(lambda: seen() is None)
