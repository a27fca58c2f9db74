"""Undo keeps values, and a gesture is undone as one."""

from dataclasses import replace

import pytest

from app.session.history import BYTES_LIMIT, LIMIT, History, held_arrays
from lessons.scenes import make_scene


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


def test_values_are_kept_by_the_bytes_that_they_hold_together() -> None:
    half = BYTES_LIMIT // 2 + 1
    history = History("a", lambda state: {ord(name): half for name in state})
    for state in ("ab", "ab", "a", "b"):
        history.put(state)
    assert undone(history) == ["b", "a", "ab", "ab", "a"], (
        "a and b are held once, whatever number of values has them"
    )
    history.put("c")
    assert undone(history) == ["c", "b"]
    large = History("a", lambda state: {ord(state): 2 * BYTES_LIMIT})
    large.put("b")
    assert undone(large) == ["b", "a"], "what was before stays, however large it is"


def undone(history: History[str]) -> list[str]:
    """Return the present value and all before it; the present one stays."""
    found = [history.present]
    while history.can_undo:
        found.append(history.undo())
    while history.can_redo:
        history.redo()
    return found


def test_the_arrays_of_a_record_count_once() -> None:
    scene = make_scene("sphere")
    (mesh,) = scene.meshes
    moved = replace(scene, meshes=(replace(mesh, positions=mesh.positions + 1.0),))
    one, both = held_arrays(scene), held_arrays((scene, moved))
    assert sum(one.values()) >= mesh.positions.nbytes + mesh.triangles.nbytes
    assert sum(both.values()) - sum(one.values()) == pytest.approx(mesh.positions.nbytes, abs=2000)
