"""What only the collector frees goes in the GUI thread, whatever thread makes the objects."""

import gc
from collections.abc import Iterator
from threading import Thread, get_ident

import pytest
from pytestqt.qtbot import QtBot

from app.background import Collecting
from core.study.record import collector_off


class Ring:
    """Holds itself, and tells in which thread it goes."""

    def __init__(self, gone: list[int]) -> None:
        self.itself, self.gone = self, gone

    def __del__(self) -> None:
        self.gone.append(get_ident())


@pytest.fixture
def most() -> Iterator[int]:
    """Let Python collect after a few objects, so that it does so during the test; return after how many."""
    usual = gc.get_threshold()
    gc.set_threshold(500, 10, 10)
    yield 500
    gc.set_threshold(*usual)


def work(most: int) -> list[list[int]]:
    """Return more objects than Python leaves uncollected, made in another thread."""
    made: list[list[int]] = []
    thread = Thread(target=lambda: made.extend([[k] for k in range(4 * most)]))
    thread.start()
    thread.join()
    return made


def test_a_ring_goes_in_the_gui_thread_though_another_one_makes_the_objects(qtbot: QtBot, most: int) -> None:
    gone: list[int] = []
    collecting = Collecting()
    Ring(gone)
    made = work(most)
    assert len(made) > most
    assert gone == []
    with collector_off():
        collecting._collect()
    assert gone == [], "nothing is collected while something is timed"
    qtbot.waitUntil(lambda: gone == [get_ident()])
    collecting.stop()
    assert gc.get_threshold()[0] == most
