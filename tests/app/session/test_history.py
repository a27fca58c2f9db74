"""Undo keeps values, and a gesture is undone as one."""

from app.session.history import LIMIT, History


def test_undo_and_redo_walk_the_values() -> None:
    history = History("a")
    history.put("b")
    history.put("c")
    assert (history.undo(), history.undo(), history.can_undo) == ("b", "a", False)
    assert (history.redo(), history.redo(), history.can_redo) == ("b", "c", False)


def test_a_new_value_forgets_what_was_undone() -> None:
    history = History("a")
    history.put("b")
    history.undo()
    history.put("c")
    assert not history.can_redo
    assert history.undo() == "a"


def test_one_gesture_is_undone_together() -> None:
    history = History(0)
    for value in (1, 2, 3):
        history.put(value, "drag 0")
    history.put(4, "drag 1")
    assert history.undo() == 3
    assert history.undo() == 0


def test_the_gesture_of_the_present_value_is_known() -> None:
    history = History(0)
    history.put(1, "drag 0")
    assert history.is_within("drag 0")
    assert not history.is_within("drag 1")
    history.put(2)
    assert not history.is_within("drag 0")


def test_a_gesture_after_undo_starts_anew() -> None:
    history = History(0)
    history.put(1, "drag")
    history.undo()
    history.put(2, "drag")
    assert history.undo() == 0


def test_the_oldest_values_are_dropped() -> None:
    history = History(0)
    for value in range(1, LIMIT + 20):
        history.put(value)
    while history.can_undo:
        history.undo()
    assert history.present == 20
