"""The guide's links, followed in order in a window: what a step promises is on screen."""

import pytest
from pytestqt.qtbot import QtBot

from app.window.main_window import MainWindow
from lessons.help import guide
from tests.covering import every_nth


@pytest.mark.slow
@pytest.mark.parametrize("title", every_nth(["Change a method", "Let two plates fight"], 2))
def test_a_change_of_method_is_seen_in_the_finished_picture(
    window: MainWindow, qtbot: QtBot, title: str
) -> None:
    (step,) = [step for step in guide() if step.title == title]
    *opening, first, second = [link.removeprefix("do:") for link in step.links.values()]
    for link in (*opening, first):
        window.help.follow(link)
        qtbot.waitUntil(lambda: not window.files.job.is_running)
    pictures = []
    for link in (first, second):
        window.help.follow(link)
        qtbot.waitUntil(lambda: not window.files.job.is_running)
        session, buffer = window.session, window.page.grid.buffer()
        assert window.page.current_view() == "pixels"
        assert session.cursor.position == session.stage_trace.steps.count
        pictures.append(buffer.values.copy())
    assert (pictures[0] != pictures[1]).any()
