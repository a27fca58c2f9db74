"""The progress of long work: what is waited for, and how far it has come."""

from pytestqt.qtbot import QtBot

from app.window.main_window import MainWindow


def test_the_progress_of_opening_names_the_file(window: MainWindow, qtbot: QtBot) -> None:
    progress = window.files.progress
    progress.begin("Opening teapot.obj")
    progress._slow.stop()
    window.files.job.progressed.emit(0.25, "reading lines")
    assert window.messages.text.text() == "Opening teapot.obj: reading lines"
    window.files.job.progressed.emit(1.0, "")
    assert window.messages.text.text() == "Opening teapot.obj"
