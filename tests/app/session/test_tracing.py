"""Long runs are traced in the background, can be cancelled, and are refused where they cannot be kept."""

from dataclasses import replace
from threading import Event

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from app.session import document as document_module
from app.session.document import TEACHING_LIMIT, TRACED_TOGETHER, Document, open_document
from app.session.session import Session
from app.window.main_window import MainWindow
from core import ClipScene, Settings
from core.numeric import watched
from core.trees.expected import SECONDS
from lessons.scene_edits import move_corner
from lessons.scenes import make_scene
from lessons.shapes import sphere
from tests.patience import PATIENCE

pytestmark = pytest.mark.shared_window

BALL = replace(make_scene("sphere"), meshes=(sphere(columns=24, rows=12),))


@pytest.fixture(autouse=True)
def slow_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let triangles be estimated to take as long as five times as many."""
    for name in ("TESTS_PER_SECOND", "TRIANGLES_PER_SECOND"):
        monkeypatch.setattr(document_module, name, getattr(document_module, name) / 5)


def all_by_force(document: Document) -> Document:
    """Return the document with all triangles stepped, every pixel tested."""
    settings = replace(document.settings, fill="brute-force")
    return replace(document, settings=settings, triangle=None)


def test_a_long_trace_is_taken_over_when_it_is_done(qtbot: QtBot) -> None:
    session = Session(open_document(BALL, "Sphere"))
    before = session.document
    slow = replace(before, settings=Settings(fill="brute-force"))
    session.edit(slow)
    assert session.document is before
    with qtbot.waitSignal(session.changed, timeout=20000):
        pass
    assert session.document is slow
    session.undo()
    assert session.document is before
    session.tracing.shut_down()


def test_a_tree_is_built_in_the_background_reported_and_cancelled(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(SECONDS, "bvh", 1e-3)
    monkeypatch.setattr(watched, "PAUSE", 0.0)
    session = Session(open_document(BALL, "Sphere"))
    before = session.document
    in_tree = replace(before.settings, object_culling="frustum", hierarchy="bvh", leaf_size=1)
    plain = before.estimated_seconds
    assert replace(before, settings=in_tree).estimated_seconds > 3 + plain
    told: list[tuple[float | None, str]] = []
    session.tracing.progressed.connect(lambda fraction, doing: told.append((fraction, doing)))
    session.edit(replace(before, settings=in_tree))
    assert session.document is before
    with qtbot.waitSignal(session.changed, timeout=20000):
        pass
    assert session.document.settings == in_tree
    assert told[0] == (None, f"building a tree of {before.triangle_count:,} triangles, about 5 s and 1 MB")
    assert any(fraction for fraction, _ in told)
    # It is there now: looked at from elsewhere, nothing is built.
    assert session.document.estimated_seconds < 1 + plain

    session.edit(replace(before, settings=replace(in_tree, leaf_size=2)))
    session.tracing.cancel()
    session.tracing.shut_down()
    assert session.document.settings == in_tree


def test_all_triangles_that_are_traced_together_are_traced_at_once(
    qapp: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.undo()
    corners = np.random.default_rng(1).uniform(-1, 1, (TRACED_TOGETHER, 3, 4))
    corners[..., 3] += 2
    scene = ClipScene(corners, size=TEACHING_LIMIT)
    session = Session(open_document(scene, "Many"))
    moved = replace(session.document, scene=replace(scene, clip=corners + 0.01))
    session.edit(moved)
    assert session.document is moved
    assert session.document.triangle is None
    assert not session.tracing.is_busy


def test_a_quick_edit_takes_the_place_of_a_long_one(qtbot: QtBot) -> None:
    session = Session(open_document(BALL, "Sphere"))
    session.edit(replace(session.document, settings=Settings(fill="brute-force")))
    quick = replace(session.document, settings=Settings(fill="bounding-box"))
    session.edit(quick)
    assert session.document is quick
    assert not session.tracing.is_busy
    session.tracing.shut_down()
    assert session.document is quick


def test_of_many_that_wait_the_last_is_kept(qtbot: QtBot) -> None:
    session = Session(open_document(BALL, "Sphere"))
    slow = [replace(session.document, settings=Settings(fill="brute-force", block_size=n)) for n in (1, 2, 4)]
    for document in slow:
        session.edit(document, "drag")
    qtbot.waitUntil(lambda: session.document is slow[2], timeout=30000)
    session.tracing.shut_down()


def wait_for(session: Session, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: not session.tracing.is_busy, timeout=20000)


def test_what_of_a_drag_is_traced_after_its_end_is_undone_with_it(window: MainWindow, qtbot: QtBot) -> None:
    session, grid = window.session, window.page.grid
    slow = replace(open_document(BALL, "Sphere"), settings=Settings(fill="brute-force"))
    session.open(slow)
    for x in (10.0, 20.0):
        grid.vertex_dragged.emit(0, x, 12.0)
        if x == 10.0:
            wait_for(session, qtbot)
    grid.vertex_drag_finished.emit(0)
    assert session.tracing.is_busy
    wait_for(session, qtbot)
    assert session.document is not slow
    session.undo()
    wait_for(session, qtbot)
    assert session.document is slow


def test_an_edit_that_is_being_traced_is_undone_alone(qtbot: QtBot) -> None:
    session = Session(open_document(BALL, "Sphere"))
    assert not session.can_undo
    with qtbot.waitSignal(session.tracing.busy_changed):
        session.set_setting("fill", "brute-force")
    assert session.can_undo
    session.undo()
    assert not session.can_undo
    session.set_setting("fill", "blocks")
    quick = session.document
    session.set_setting("fill", "brute-force")
    session.undo()
    assert session.document is quick
    assert not session.tracing.is_busy
    session.tracing.shut_down()
    assert session.document is quick


def test_undo_takes_a_drag_back_that_goes_on_in_the_background(qtbot: QtBot) -> None:
    session = Session(open_document(BALL, "Sphere"))
    before = session.document
    session.edit(replace(before, settings=Settings(fill="blocks")), "drag 0")
    session.edit(replace(before, settings=Settings(fill="brute-force")), "drag 0")
    session.undo()
    assert session.document is before
    assert not session.tracing.is_busy
    session.tracing.shut_down()


def test_an_edit_starts_from_the_one_that_is_still_being_traced(window: MainWindow, qtbot: QtBot) -> None:
    session = window.session
    session.open(replace(open_document(BALL, "Sphere"), settings=Settings(fill="brute-force")))
    document = session.document
    assert document.triangle is not None
    moved = move_corner(document.scene, document.triangle, 0, (10.0, 12.0), document.traced_scene.size)
    session.edit(replace(document, scene=moved))
    assert session.tracing.is_busy
    assert moved is not session.document.scene
    window.edits.toggle_cleared()
    session.set_setting("shading", "flat")
    session.set_setting("fill", "blocks")
    wait_for(session, qtbot)
    assert session.document.scene is moved
    assert session.document.before == "cleared"
    assert (session.document.settings.shading, session.document.settings.fill) == ("flat", "blocks")


def test_too_long_a_run_is_refused_with_what_to_do(qtbot: QtBot) -> None:
    session = Session(open_document(make_scene("knot"), "Knot"))
    before = session.document
    with pytest.raises(ValueError, match="bring one triangle into focus, or choose another fill"):
        session.edit(all_by_force(before))
    assert session.document is before


def test_the_window_shows_the_work_and_cancels_it(
    window: MainWindow, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    window.session.open(open_document(make_scene("sphere"), "Sphere"))
    before, is_shown = window.session.document, Event()
    whole = replace(
        before,
        raster=replace(before.raster, columns=56, rows=42, origin=None),
        settings=Settings(fill="brute-force"),
    )
    monkeypatch.setattr("app.session.tracing.trace_now", lambda document, stage: is_shown.wait(PATIENCE))
    window.edits.edit(whole)
    qtbot.waitUntil(window.messages.isVisible)
    is_shown.set()
    assert window.messages.text.text() == "Tracing Sphere"
    window.messages.cancel_button.click()
    assert not window.session.tracing.is_busy
    assert window.session.document is before
    assert "cancelled" in window.messages.text.text()


def test_a_refused_run_is_told_in_the_window(window: MainWindow) -> None:
    window.session.open(open_document(make_scene("knot"), "Knot"))
    document = window.session.document
    window.edits.edit(all_by_force(document))
    assert window.session.document is document
    assert "steps" in window.messages.text.text()


def test_undoing_to_a_long_trace_waits_for_it(qtbot: QtBot) -> None:
    slow = replace(open_document(BALL, "Sphere"), settings=Settings(fill="brute-force"))
    session = Session(slow)
    quick = replace(slow, settings=Settings())
    session.edit(quick)
    session.undo()
    session.undo()
    assert session.document is quick
    qtbot.waitUntil(lambda: session.document is slow and not session.tracing.is_busy, timeout=20000)
    assert not session.can_undo
    assert session.trace.source.settings == slow.settings
    session.redo()
    assert session.document is quick
    session.tracing.shut_down()


def test_undo_of_what_takes_a_while_is_traced_off_the_gui_thread(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = Session(open_document(make_scene("cube"), "Cube"))
    before = session.document
    session.set_setting("fill", "blocks")
    monkeypatch.setattr("app.session.session.RESTING_SECONDS", 0.0)
    session.undo()
    assert session.tracing.is_busy
    wait_for(session, qtbot)
    assert session.document is before
    session.tracing.shut_down()
