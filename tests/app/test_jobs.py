"""Threads of jobs that have ended are let go of."""

from PySide6.QtCore import QCoreApplication, QEvent, QThread
from pytestqt.qtbot import QtBot

from app import workers
from app.workers import Job


def threads_of(job: Job) -> list[QThread]:
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    return job.findChildren(QThread)


def test_a_thread_goes_when_it_has_ended(qtbot: QtBot) -> None:
    job = Job()
    with qtbot.waitSignal(job.succeeded):
        job.start(lambda progress, is_cancelled: 1)
    qtbot.waitUntil(lambda: threads_of(job) == [])


def test_a_thread_that_ends_while_others_are_let_go_of_goes_too(qtbot: QtBot, monkeypatch) -> None:
    job = Job()
    job.start(lambda progress, is_cancelled: 1)
    job.cancel()
    (worker,) = threads_of(job)
    assert worker.wait(5000)
    # Still running when it is looked at first.
    answers = iter([True])
    monkeypatch.setattr(workers._Worker, "isRunning", lambda self: next(answers, False))
    job._retire()
    assert threads_of(job) == [worker]
    qtbot.waitUntil(lambda: threads_of(job) == [])
