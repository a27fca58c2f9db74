"""Predict, then reveal: nothing on the page gives the answer away; verdicts are right."""

import pytest
from PySide6.QtWidgets import QApplication

from app.window.main_window import MainWindow
from core import STAGES
from core.explain.steps import question
from tests.covering import every_nth

pytestmark = pytest.mark.shared_window


@pytest.fixture
def asking(window: MainWindow) -> MainWindow:
    """Return the window at the first step of the raster stage, with prediction on."""
    window.session.go_to(0)
    window.run_action("predict")
    return window


def test_results_are_hidden_while_asking(asking: MainWindow) -> None:
    page = asking.page
    assert page.prediction.isVisible()
    assert all(len(places) == 0 for places in page.timeline.bar.run().marks.values())
    asking.session.set_pin((30, 20))
    page.column.setCurrentWidget(page.history)
    assert "hidden until the answer is shown" in page.history.verdict.text()
    assert page.pointed_text((30, 20)) == ""


def test_everything_is_shown_again(asking: MainWindow) -> None:
    asking.run_action("predict")
    page = asking.page
    assert not page.prediction.isVisible()
    assert page.grid.hidden() is None
    assert any(len(places) for places in page.timeline.bar.run().marks.values())


def test_the_view_of_the_stage_comes_back_with_its_results(window: MainWindow) -> None:
    window.session.set_stage("transform", 3)
    assert window.page.current_view() == "scene"
    window.run_action("predict")
    window.run_action("predict")
    assert window.page.current_view() == "scene"


def test_coverage_is_clicked_and_judged_at_once(asking: MainWindow) -> None:
    page = asking.page
    covered = asking.session.trace.source.picture.primitive >= 0
    right = next((x, y) for y in range(48) for x in range(64) if covered[y, x])
    wrong = next((x, y) for y in range(48) for x in range(64) if not covered[y, x])
    page.grid.pixel_clicked.emit(*right)
    assert page.prediction.verdict.text().startswith("Right:")
    page.grid.pixel_clicked.emit(*wrong)
    assert page.prediction.verdict.text().startswith("Wrong:")
    page.grid.pixel_clicked.emit(*wrong)
    assert page.prediction.count.text() == "1 of 2 right"
    hidden = page.grid.hidden()
    assert not hidden[right[1], right[0]]
    assert hidden.sum() == hidden.size - 2
    page.prediction.reveal_button.click()
    assert page.prediction.verdict.text().startswith("Answer: 1 of ")
    assert asking.session.cursor.position == asking.session.stage_trace.steps.count


def test_the_next_pixel_is_asked_and_answered(asking: MainWindow) -> None:
    session, view = asking.session, asking.page.prediction
    session.step(1)
    trace = session.stage_trace
    asked = question(trace, trace.steps.rows_done(session.cursor.position))
    assert view.question.text() == asked.text
    view.choice_buttons[int(asked.answer)].click()
    assert view.verdict.text().startswith("Right: ")
    assert not view.verdict.text().startswith("Right: Right")
    before = session.cursor.position
    view.next_button.click()
    assert trace.steps.rows_done(session.cursor.position) == trace.steps.rows_done(before) + 1


def test_a_reveal_counts_neither_way(asking: MainWindow) -> None:
    asking.session.step(1)
    view = asking.page.prediction
    view.reveal_button.click()
    assert view.verdict.text().startswith("Answer: ")
    assert view.count.text() == ""


def test_every_stage_can_be_gone_through_while_asking(asking: MainWindow) -> None:
    for stage in every_nth(STAGES, 4):
        session, view = asking.session, asking.page.prediction
        session.set_stage(stage, 0)
        for _ in range(3):
            session.step(1)
            QApplication.processEvents()
            row = session.stage_trace.steps.rows_done(session.cursor.position)
            if row < session.stage_trace.steps.row_count:
                asked = question(session.stage_trace, row)
                assert (asked is None) == ("needs no prediction" in view.question.text())
        session.go_to(session.stage_trace.steps.count)
        assert view.question.text().startswith("This stage is done.")


def test_a_history_that_is_hidden_says_so(window: MainWindow) -> None:
    window.session.set_pin((20, 20))
    assert window.page.history.place.isVisible()
    window.run_action("predict")
    window.page.column.setCurrentWidget(window.page.history)
    assert "hidden until the answer is shown" in window.page.history.verdict.text()
    window.run_action("predict")
    assert window.page.history.place.text() == "Pixel column 20, row 20"
