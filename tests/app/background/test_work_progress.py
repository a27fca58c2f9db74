"""The progress of long work: what is waited for, and how far it has come."""

from pytestqt.qtbot import QtBot

from app.background.workers import Job
from app.pages.background_task import BackgroundTask, WorkWords
from app.pages.page_bar import Page
from app.window.main_window import MainWindow
from widgets.basics.message_bar import Progress


def test_the_progress_of_opening_names_the_file(window: MainWindow, qtbot: QtBot) -> None:
    progress = window.files.progress
    progress.begin("Opening teapot.obj")
    progress._slow.stop()
    window.files.job.progressed.emit(0.25, "reading lines")
    assert window.messages.text.text() == "Opening teapot.obj: reading lines"
    window.files.job.progressed.emit(1.0, "")
    assert window.messages.text.text() == "Opening teapot.obj"


def test_each_percent_is_told_once(qtbot: QtBot) -> None:
    shown: list[tuple[str, int] | None] = []

    class Controls:
        def show_progress(self, progress: Progress | None) -> None:
            shown.append(progress and (progress.text, progress.done))

    class Task(BackgroundTask):
        def _put_back(self) -> None:
            pass

    # The page is held here: held by the task only, it would go while the task goes, and delete it once more.
    job, page = Job(), Page()
    qtbot.addWidget(page)
    Task(job, Controls(), WorkWords("", "", ""), page)
    for k in range(100):
        job.progressed.emit(0.2 + 0.0001 * k, "slivers")
    job.progressed.emit(0.21, "cracks")
    job.ended.emit()
    job.progressed.emit(0.21, "cracks")
    assert shown == [("slivers", 20), ("slivers", 21), ("cracks", 21), None, ("cracks", 21)]
