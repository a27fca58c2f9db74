"""Long work of several pages runs one after another, and names the page that it waits for."""

from threading import Event

import pytest
from pytestqt.qtbot import QtBot

from app.background import CancelledWaitError, Job, Turns


def test_work_waits_for_that_of_another_page_and_names_it(qtbot: QtBot) -> None:
    turns, first, second = Turns(), Job(), Job()
    may_end, order = Event(), []

    def measure(progress, is_cancelled) -> None:
        with turns.take("Compare", progress, is_cancelled):
            may_end.wait(10)
            order.append("Compare")

    def analyse(progress, is_cancelled) -> None:
        with turns.take("Plan", progress, is_cancelled):
            order.append("Plan")

    first.start(measure)
    qtbot.waitUntil(lambda: turns._page == "Compare")
    with qtbot.waitSignal(second.progressed) as told:
        second.start(analyse)
    assert told.args == [None, "Waiting until the Compare page is done"]
    with qtbot.waitSignals([first.succeeded, second.succeeded]):
        may_end.set()
    assert order == ["Compare", "Plan"]
    first.shut_down()
    second.shut_down()


def test_work_that_is_cancelled_while_it_waits_gives_up() -> None:
    turns = Turns()
    with (
        turns.take("Plan", lambda *_: None, lambda: False),
        pytest.raises(CancelledWaitError),
        turns.take("Compare", lambda *_: None, lambda: True),
    ):
        raise AssertionError("two pages have the turn")
    with turns.take("Compare", lambda *_: None, lambda: False):
        pass
