"""The progress of long work: what is waited for, and how far it has come."""

from pytestqt.qtbot import QtBot

from app.pages.experiment_page import ExperimentPage, WorkWords
from app.window.main_window import MainWindow
from widgets.basics.message_bar import Progress, RunPanel


def test_the_progress_of_opening_names_the_file(window: MainWindow) -> None:
    progress = window.files.progress
    progress.begin("Opening teapot.obj")
    progress._slow.stop()
    window.files.job.progressed.emit(0.25, "reading lines")
    assert window.messages.text.text() == "Opening teapot.obj: reading lines"
    window.files.job.progressed.emit(1.0, "")
    assert window.messages.text.text() == "Opening teapot.obj"


def test_each_percent_is_told_once(qtbot: QtBot) -> None:
    shown: list[tuple[str, int] | None] = []

    class Controls(RunPanel):
        def show_progress(self, progress: Progress | None) -> None:
            shown.append(progress and (progress.text, progress.done))

    page = ExperimentPage(WorkWords("", "", "", ""))
    page.controls = Controls("", "", "", "", "", page)
    qtbot.addWidget(page)
    job = page.work
    for k in range(100):
        job.progressed.emit(0.2 + 0.0001 * k, "slivers")
    job.progressed.emit(0.21, "cracks")
    job.ended.emit()
    job.progressed.emit(0.21, "cracks")
    assert shown == [("slivers", 20), ("slivers", 21), ("cracks", 21), None, ("cracks", 21)]
