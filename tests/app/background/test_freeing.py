"""Freed memory is given back once after several openings, off the GUI thread, and not while the window closes."""

from threading import get_ident

from app import background
from app.background import Freeing


def test_memory_is_given_back_once_and_off_the_gui_thread(qtbot, monkeypatch):
    threads = []
    monkeypatch.setattr(background, "PAUSE", 1)
    monkeypatch.setattr(background, "give_back", lambda: threads.append(get_ident()))
    back = Freeing()
    for _ in range(3):
        back.ask()
    qtbot.waitUntil(lambda: not back.is_waiting, timeout=20000)
    assert len(threads) == 1
    assert threads[0] != get_ident()
    back.ask()
    back.shut_down()
    assert not back.is_waiting
    assert len(threads) == 1
