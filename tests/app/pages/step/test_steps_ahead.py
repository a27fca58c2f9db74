"""Formulas of the next steps are typeset while the user looks at this one."""

from time import sleep

from PySide6.QtCore import QCoreApplication
from pytestqt.qtbot import QtBot

from app.pages.step.inspector_presenter import QUIET_MS, STEPS_AHEAD, StepsAhead, load_stages
from app.session.document import open_document
from app.session.moment import Cursor, Step
from app.session.session import Session
from core.explain.steps import formula
from core.records.steps import Level
from core.trace.tracers import trace_stage
from lessons.scenes import built_in_scene
from tests.calls import calls_of
from widgets.inspector.formula_view import FormulaView
from widgets.inspector.typesetter import Typesetter


def test_a_step_finds_its_formula_typeset(qtbot: QtBot) -> None:
    session = Session(open_document(built_in_scene("shared-edge").make(), ""))
    view = FormulaView(typesetter=Typesetter())
    qtbot.addWidget(view)
    ahead = StepsAhead(session.moment, view)
    session.set_stage("edges", 0)
    session.set_level(Level.OPERATION)
    ahead.begin(session.moment)
    qtbot.waitUntil(lambda: not ahead.is_working)
    for _ in range(STEPS_AHEAD):
        session.step(1)
        explanation = session.explanation
        assert explanation is not None
        view.show_formula(formula(explanation))
        assert view.is_complete()
    ahead.stop()


def test_it_begins_only_when_the_window_has_come_to_rest(qtbot: QtBot) -> None:
    session = Session(open_document(built_in_scene("shared-edge").make(), ""))
    view = FormulaView(typesetter=Typesetter())
    qtbot.addWidget(view)
    ahead = StepsAhead(session.moment, view)
    load_stages().join()
    session.set_stage("edges", 0)
    ahead.begin(session.moment)
    owed = list(ahead._positions)
    sleep(2 * QUIET_MS / 1000)  # The step takes its time, and then it is painted.
    QCoreApplication.processEvents()
    assert ahead._positions == owed
    ahead.is_drawing = lambda: True  # In the background, as a picture in space.
    qtbot.wait(3 * QUIET_MS)
    assert ahead._positions == owed
    ahead.is_drawing = lambda: False
    qtbot.waitUntil(lambda: not ahead._positions)
    ahead.stop()


def test_a_step_of_another_run_is_prepared_after_those_of_this_one(qtbot: QtBot) -> None:
    session = Session(open_document(built_in_scene("shared-edge").make(), ""))
    view = FormulaView(typesetter=Typesetter())
    qtbot.addWidget(view)
    ahead = StepsAhead(session.moment, view)
    ahead.begin(session.moment)
    other = open_document(built_in_scene("single-triangle").make(), "").make_trace()
    step = Step(other, Cursor("raster", 7))
    filled: list[bool] = []
    ahead.look_at(step, lambda: filled.append(view.is_complete()))
    qtbot.waitUntil(lambda: bool(filled))
    explanation = step.explanation
    assert explanation is not None
    view.show_formula(formula(explanation))
    assert view.is_complete()
    assert filled == [True]
    ahead.stop()


def test_the_next_stage_is_traced_meanwhile(qtbot: QtBot) -> None:
    session = Session(open_document(built_in_scene("shared-edge").make(), ""))
    view = FormulaView(typesetter=Typesetter())
    qtbot.addWidget(view)
    ahead = StepsAhead(session.moment, view)
    session.set_stage("depth", 0)
    ahead.begin(session.moment)
    qtbot.waitUntil(lambda: not ahead.is_working, timeout=10000)
    assert calls_of([trace_stage], lambda: session.next_stage(1)) == {}
    assert session.cursor.stage == "blend"
    assert calls_of([trace_stage], lambda: session.next_stage(1)), "nobody has waited for it"
    ahead.stop()
