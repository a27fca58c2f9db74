"""Dragging the triangle in focus traces it alone, and no trace of before stays in memory."""

import gc
from collections.abc import Callable, Iterator
from dataclasses import replace
from weakref import ReferenceType, ref

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

import app.session.session
from app.session.document import Document, open_document
from app.session.session import Session
from app.session.tracing import RESTING_SECONDS
from core import ClipScene
from core.trace import Trace, source
from core.trace.incremental.draft import Draft
from lessons.scene_edits import move_corner

pytestmark = pytest.mark.shared_window

SIZE = (48, 36)


def several_triangles() -> ClipScene:
    generator = np.random.default_rng(2)
    corners = np.ones((9, 3, 4))
    corners[..., :3] = generator.uniform(-0.5, 0.5, (9, 1, 3)) + generator.uniform(-0.4, 0.4, (9, 3, 3))
    return ClipScene(corners, generator.random((9, 3, 4)), SIZE)


def dragged(document: Document, triangle: int, x: float) -> Document:
    size = document.scene.size
    return replace(document, scene=move_corner(document.scene, triangle, 1, (x, 17.5), size))


@pytest.fixture
def session(qapp: object) -> Iterator[Session]:
    found = Session(open_document(several_triangles(), "Triangles"))
    yield found
    found.tracing.shut_down()


@pytest.fixture
def examined(monkeypatch: pytest.MonkeyPatch) -> list[set[int]]:
    """Return the list of sets of triangles whose pixels are examined together."""
    found: list[set[int]] = []
    examine = source.examine_pixels

    def note_and_examine(edges, runs, raster):
        found.append(set(runs.triangle.tolist()))
        return examine(edges, runs, raster)

    monkeypatch.setattr(source, "examine_pixels", note_and_examine)
    return found


def assert_traced_as_from_nothing(session: Session) -> None:
    wanted = session.document.make_trace().stage(session.cursor.stage)
    found = session.stage_trace
    assert set(found.columns) == set(wanted.columns)
    for name, column in wanted.columns.items():
        assert found.columns[name].tobytes() == column.tobytes(), name
    for track, other in zip(found.buffers, wanted.buffers, strict=True):
        assert track.at(found.steps.row_count).tobytes() == other.at(wanted.steps.row_count).tobytes()


def references(trace: Trace, stage: str) -> list[ReferenceType[object]]:
    return [ref(trace), ref(trace.source), ref(trace.stage(stage))]


def any_is_left(references: list[ReferenceType[object]]) -> bool:
    return any(of() is not None for of in references)


@pytest.fixture
def uncollected() -> Iterator[None]:
    """Go on without the collector of cycles: large traces would wait for it."""
    gc.collect()
    gc.disable()
    yield
    gc.enable()


def test_no_trace_of_before_stays_in_memory(session: Session, uncollected: None) -> None:
    earlier = references(session.trace, "raster")
    for x in (10.0, 10.5, 11.0):
        session.edit(dragged(session.document, 4, x), "drag")
        assert not any_is_left(earlier)
        earlier = references(session.trace, "raster")


def test_nor_does_it_after_tracing_in_the_background(
    qtbot: QtBot, session: Session, uncollected: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(app.session.session, "QUICK_SECONDS", 0.0)
    earlier = references(session.trace, "raster")
    for x in (10.0, 10.5):
        wanted = dragged(session.document, 4, x)
        session.edit(wanted, "drag")
        assert session.tracing.is_busy
        qtbot.waitUntil(lambda wanted=wanted: session.document is wanted and not session.tracing.is_busy)
        qtbot.waitUntil(lambda earlier=earlier: not any_is_left(earlier))
        earlier = references(session.trace, "raster")


@pytest.mark.parametrize("stage", ["raster", "depth", "resolve"])
def test_while_the_triangle_in_focus_is_dragged_it_alone_is_traced(
    session: Session, examined: list[set[int]], stage: str
) -> None:
    session.open(replace(session.document, triangle=4))
    session.set_stage(stage)
    first, picture = session.document, session.trace.source.picture
    for x in (10.0, 10.5, 11.0):
        examined.clear()
        session.drag(dragged(session.document, 4, x), "drag")
        assert examined == [{0}], "the only one of those that are traced"
        assert session.trace.source.picture is picture
    session.come_to_rest()
    assert not isinstance(session.trace.source, Draft)
    assert_traced_as_from_nothing(session)
    wanted = session.document.make_trace().source.picture
    np.testing.assert_array_equal(session.trace.source.picture.color, wanted.color)
    session.undo()
    assert session.document is first
    assert_traced_as_from_nothing(session)


def test_a_drag_that_rests_is_traced_whole_by_itself(qtbot: QtBot, session: Session) -> None:
    session.open(replace(session.document, triangle=4))
    session.drag(dragged(session.document, 4, 10.0), "drag")
    with qtbot.waitSignal(session.changed):
        pass
    assert_traced_as_from_nothing(session)
    session.come_to_rest()


@pytest.mark.parametrize("limit", [RESTING_SECONDS, 0.0], ids=["at once", "in the background"])
def test_a_scene_that_cannot_be_drawn_whole_goes_back_to_that_before_the_drag(
    qtbot: QtBot, session: Session, monkeypatch: pytest.MonkeyPatch, limit: float
) -> None:
    session.open(replace(session.document, triangle=4))
    before = session.document
    session.drag(dragged(session.document, 4, 10.0), "drag")
    monkeypatch.setattr(Document, "check_length", refuse_once())
    monkeypatch.setattr(app.session.session, "RESTING_SECONDS", limit)
    with qtbot.waitSignal(session.edit_failed):
        session.come_to_rest()
    qtbot.waitUntil(lambda: session.document is before)
    assert_traced_as_from_nothing(session)


def test_what_a_drag_left_out_of_a_large_scene_is_traced_in_the_background(
    qtbot: QtBot, session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(app.session.session, "RESTING_SECONDS", 0.0)
    session.open(replace(session.document, triangle=4))
    wanted = dragged(session.document, 4, 10.0)
    session.drag(wanted, "drag")
    session.come_to_rest()
    assert session.tracing.is_busy
    assert isinstance(session.trace.source, Draft), "what was dragged stays in sight"
    qtbot.waitUntil(lambda: not session.tracing.is_busy and not isinstance(session.trace.source, Draft))
    assert session.document is wanted
    assert_traced_as_from_nothing(session)
    session.undo()
    assert session.tracing.is_busy, "so is what is undone"


def refuse_once() -> Callable[[Document], None]:
    """Return a check that fails the first time."""
    calls: list[Document] = []

    def check(document: Document) -> None:
        calls.append(document)
        if len(calls) == 1:
            raise ValueError("too long")

    return check
