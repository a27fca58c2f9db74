"""The Plan page: looking, choices and how they turned out, applying, pictures, and the point on the chart."""

import time
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.pages.compare.charts import title_of
from app.pages.compare.jobs import chosen_points, plan_candidates
from app.pages.plan.page import PlanPage
from app.pages.plan.plans import details, headline, rows_of
from app.window.main_window import MainWindow
from core.explain.stage_texts import family_title
from core.study.family import Candidate, settings_of
from core.study.planner import planning
from core.study.planner.measuring import measure_plan
from core.study.planner.planning import STAGES, plan
from core.study.planner.records import PlanReport, Tolerance
from core.study.planner.trials import Costs
from core.study.record import Point
from core.study.speed_accuracy import measure
from core.study.whole_picture import PIPELINE
from lessons.scenes import built_in_scene
from widgets.experiments.plan import Verdict

CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def page(window: MainWindow) -> PlanPage:
    """Return the page, reached by its key."""
    QTest.keyClick(window, Qt.Key.Key_4, Qt.KeyboardModifier.AltModifier)
    return plan_page(window)


@pytest.fixture
def looked_page(kept_window: MainWindow, qtbot: QtBot) -> Iterator[PlanPage]:
    """Return the page after a look at the scene that is open, for tests that change nothing in the end."""
    before = kept_window.session.document
    kept_window.pages.show_page("plan")
    page = plan_page(kept_window)
    if page.shown is None or page.shown.report is None:
        looked(page, qtbot)
    yield page
    after = kept_window.session.document
    assert (after.scene, after.settings) == (before.scene, before.settings)
    assert page.shown is not None
    assert not page.is_stale
    kept_window.messages.clear()


def plan_page(window: MainWindow) -> PlanPage:
    found = window.pages.current
    found.controls.rounds_box.setValue(1)
    return found


def report_of(page: PlanPage) -> PlanReport:
    shown = page.shown
    return shown.report


def looked(page: PlanPage, qtbot: QtBot) -> PlanReport:
    """Look by the key and wait."""
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    assert page.is_running
    qtbot.waitUntil(lambda: not page.is_running, timeout=60000)
    QApplication.processEvents()  # Rows that have just been made are shown a moment later.
    return report_of(page)


def wait_for_pictures(page: PlanPage, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: page.pictures.linked.grids[0].buffer() is not None, timeout=60000)


def another_scene(window: MainWindow) -> None:
    document = window.session.document
    scene = built_in_scene("intersecting").make()
    window.session.edit(replace(document, scene=scene, title="Another"))


def test_it_looks_at_a_scene_by_itself_and_measures_when_it_is_asked_to(page: PlanPage, qtbot: QtBot) -> None:
    assert "What does this scene need?" in page.controls.intro.text()
    assert page.rows.empty.isVisible()
    assert not page.summary.isVisible()
    qtbot.waitUntil(lambda: page.shown is not None)
    assert "Analyse (F5) measures it" in page.summary.headline.text()
    assert not page.rows.empty.isVisible()
    assert not page.controls.apply_button.isEnabled()
    assert page.window().focusWidget() is page.controls.start_button
    another_scene(page.window())
    qtbot.waitUntil(lambda: page.is_running)
    assert page.controls.start_button.isVisible()
    page.window().pages.show_page("step")
    assert not page.is_running
    page.window().pages.show_page("plan")
    qtbot.waitUntil(lambda: page.shown is not None and page.shown.title == "Another")
    page.window().session.undo()
    qtbot.waitUntil(lambda: page.is_running)
    another_scene(page.window())  # In the midst of a look.
    qtbot.waitUntil(lambda: not page.is_running)
    assert not page.is_stale


def test_a_look_shows_every_stage_with_reason_and_numbers(looked_page: PlanPage) -> None:
    page, report = looked_page, report_of(looked_page)
    assert tuple(page.rows.rows) == STAGES
    for decision in report.plan.decisions:
        view = page.rows.rows[decision.setting]
        assert view.reason.text() == decision.reason
        is_cheaper = decision.chosen != decision.dearest
        assert view.picture_button.isVisibleTo(view) == is_cheaper
        for text in ("predicted", "measured 0/255", "time alone", "of the reference)"):
            assert (text in view.numbers.text()) == is_cheaper
        assert (view.property("role") == "kept") == decision.is_needed
    assert "kept" in page.rows.rows["antialiasing"].instead.text()
    assert "Within the tolerance" in page.summary.headline.text()
    assert "the reference settings" in page.summary.headline.text()
    assert "the most accurate method of every stage" in page.summary.details.text()
    assert "0 pixels beyond 2/255, 0 allowed" in page.summary.details.text()
    assert page.controls.apply_button.isEnabled()


@pytest.mark.slow
def test_an_exact_plan_allows_nothing(page: PlanPage, qtbot: QtBot) -> None:
    page.controls.kind_box.setFocus()
    QTest.keyClick(page.controls.kind_box, Qt.Key.Key_Down)
    assert not page.controls.color_box.isEnabled()
    page.controls.start_button.click()
    qtbot.waitUntil(lambda: not page.is_running, timeout=60000)
    assert page.shown.plan.tolerance == Tolerance.exact()
    assert "exact" in page.summary.about.text()


def test_findings_are_read_and_folded_away(looked_page: PlanPage) -> None:
    page, report = looked_page, report_of(looked_page)
    assert page.findings.findings.text.isVisible()
    QTest.keyClick(page.window(), Qt.Key.Key_I)
    assert not page.findings.findings.text.isVisible()
    for fact in report.plan.findings.facts:
        assert fact.title in page.findings.findings.text.text()
    QTest.keyClick(page.window(), Qt.Key.Key_I)
    assert page.findings.findings.text.isVisible()


def test_applying_is_one_step_that_undo_takes_back(
    kept_window: MainWindow, looked_page: PlanPage, qtbot: QtBot
) -> None:
    window, page, report = kept_window, looked_page, report_of(looked_page)
    before = window.session.document
    QTest.mouseClick(page.controls.apply_button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: window.session.document is not before, timeout=60000)
    assert window.session.document.settings == report.plan.settings
    hint = window.statusBar().currentMessage()
    assert window.statusBar().fontMetrics().horizontalAdvance(hint) < window.statusBar().width(), "whole"
    assert not page.is_stale
    window.pages.show_page("step")
    window.page.toggle_pane("methods")
    combo = window.page.settings_panel.combo("visibility")
    assert combo.currentData() == report.plan.settings.visibility
    window.session.undo()
    assert window.session.document is before
    assert combo.currentData() == before.settings.visibility


def test_applying_says_what_changed_and_undo_is_beside_it(
    kept_window: MainWindow, looked_page: PlanPage, qtbot: QtBot
) -> None:
    window, page, report = kept_window, looked_page, report_of(looked_page)
    before = window.session.document.settings
    changed = before.differences(report.plan.settings)
    assert changed
    assert not page.summary.undo_button.isVisible()
    QTest.mouseClick(page.controls.apply_button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(page.summary.undo_button.isVisible, timeout=60000)
    for family in changed:
        assert f"{family_title(family)}: " in page.summary.applied.text()
    QTest.mouseClick(page.summary.undo_button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: window.session.document.settings == before, timeout=60000)
    assert not page.summary.undo_button.isVisible()


def test_another_scene_leaves_the_results_as_those_of_the_earlier(
    kept_window: MainWindow, looked_page: PlanPage
) -> None:
    window, page = kept_window, looked_page
    assert not page.summary.stale.isVisible()
    another_scene(window)
    assert "earlier scene" in page.summary.stale.text()
    assert page.summary.stale.isVisible()
    assert not page.controls.apply_button.isEnabled()
    settings = window.session.document.settings
    QTest.keyClick(window, Qt.Key.Key_Return, CTRL)
    assert window.session.document.settings == settings
    assert "Run the analysis again" in window.messages.text.text()
    assert window.session.plan is None
    window.session.undo()
    assert not page.summary.stale.isVisible()
    assert page.controls.apply_button.isEnabled()


@pytest.mark.slow
def test_other_things_to_be_seen_make_the_results_old(
    window: MainWindow, page: PlanPage, qtbot: QtBot
) -> None:
    looked(page, qtbot)
    window.session.set_setting("fill", "blocks")
    assert not page.is_stale
    window.session.set_setting("wrap", "mirror")
    assert page.is_stale


@pytest.mark.slow
def test_cancelling_leaves_what_was_found_before(page: PlanPage, qtbot: QtBot) -> None:
    report = looked(page, qtbot)
    page.controls.rounds_box.setValue(99)
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    qtbot.waitUntil(lambda: page.shown is not None and page.shown.report is None, timeout=60000)
    assert "Measuring" in page.summary.headline.text()
    QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert not page.is_running
    assert page.shown.report is report
    assert page.controls.start_button.isVisible()
    assert page.controls.start_button.hasFocus()


def test_a_scene_that_is_too_large_is_told(
    kept_window: MainWindow, looked_page: PlanPage, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    window, page, report = kept_window, looked_page, report_of(looked_page)

    def refuse(*arguments: object) -> None:
        raise MemoryError("the scene is too large")

    monkeypatch.setattr(planning, "look", refuse)
    QTest.keyClick(window, Qt.Key.Key_F5)
    qtbot.waitUntil(window.messages.isVisible, timeout=60000)
    assert "could not be analysed" in window.messages.text.text()
    assert page.shown.report is report


def test_a_wrong_prediction_is_said_plainly() -> None:
    scene = built_in_scene("shared-edge").make()
    report = measure_plan(scene, plan(scene, costs=Costs()), 1)
    broken = replace(report.outcomes[0], is_right=False, text="predicted 0/255, measured 7/255")
    report = replace(report, outcomes=(broken, *report.outcomes[1:]), fallen_back=("depth",))
    rows = rows_of(report.plan, report)
    assert rows[0].verdict is Verdict.WRONG
    assert {row.verdict for row in rows[1:]} == {Verdict.HELD, Verdict.OPEN}
    text = details(report.plan, report)
    changed = [row for row in rows if row.instead.startswith("instead of") and row.name != "depth"]
    assert changed
    assert all(f"{row.stage}: {row.chosen}" in text.partition("Changed: ")[2] for row in changed)
    assert "A prediction was wrong: Cull, predicted 0/255, measured 7/255." in text
    assert "beyond the tolerance when measured. Restored: Depth" in text
    slow = replace(report, seconds_everything=np.array([1.0]), seconds_chosen=np.array([2.0]))
    assert "2.00 times as slow" in headline(slow.plan, slow)


@pytest.mark.slow
def test_difference_pictures(window: MainWindow, page: PlanPage, qtbot: QtBot) -> None:
    page.controls.color_box.setValue(255)
    report = looked(page, qtbot)
    assert report.plan.settings.antialiasing == "none"
    QTest.keyClick(window, Qt.Key.Key_D)
    wait_for_pictures(page, qtbot)
    differs = page.pictures.linked.grids[2].buffer()
    assert differs.values.max() == report.largest_error > 0
    QTest.keyClick(window, Qt.Key.Key_Escape)
    assert not page.pictures.isVisible()
    page.pictures.linked.show_nothing()
    # Nothing is cut, so clipping draws the same.
    QTest.mouseClick(page.rows.rows["clipping"].picture_button, Qt.MouseButton.LeftButton)
    wait_for_pictures(page, qtbot)
    assert "none of 3,072 pixels differs" in page.pictures.heading.text()


def test_a_difference_within_the_tolerance_opens_in_the_stepper(
    window: MainWindow, page: PlanPage, qtbot: QtBot
) -> None:
    page.controls.color_box.setValue(255)
    page.controls.pixels_box.setValue(30)
    report = looked(page, qtbot)
    assert report.plan.tolerance == Tolerance(255.0, 30)
    QTest.keyClick(window, Qt.Key.Key_D)
    wait_for_pictures(page, qtbot)
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.mouseClick(page.pictures.step_button, Qt.MouseButton.LeftButton)
    assert window.pages.current_name == "step"
    assert window.session.document.settings == report.plan.settings
    assert window.page.comparing.other.antialiasing == "ssaa-16"


@pytest.mark.slow
def test_the_choice_is_a_ringed_point_of_the_chart(window: MainWindow, page: PlanPage, qtbot: QtBot) -> None:
    report = looked(page, qtbot)
    compare = window.pages.page("compare")
    compare.show_named("pipeline")
    compare.choice.rounds = 1
    compare.choice.dials["scene", "scale"] = 0.5
    QTest.keyClick(window, Qt.Key.Key_M, CTRL)
    assert window.pages.current is compare
    qtbot.waitUntil(lambda: not compare.is_running, timeout=120000)
    study, picture = compare.content, compare.scatter.picture
    (ringed,) = picture.ringed
    assert settings_of(study.settings, ringed) == report.plan.settings
    titles = {series.key: series.title for series in picture.series}
    assert titles[ringed] == "What the scene needs"
    assert "Reference settings" in titles.values()
    another_scene(window)
    compare.refresh()
    assert compare.scatter.picture.ringed == ()


def test_without_a_plan_the_chart_has_no_ring_and_says_so(window: MainWindow, page: PlanPage) -> None:
    QTest.keyClick(window, Qt.Key.Key_M, CTRL)
    assert window.pages.current is page
    assert "Run the analysis first" in window.statusBar().currentMessage()


def test_closing_while_looking_ends_the_thread(page: PlanPage) -> None:
    page.controls.rounds_box.setValue(99)
    page.start()
    start = time.perf_counter()
    page.window().close()
    assert not page.is_running
    assert time.perf_counter() - start < 20


def test_a_plan_that_is_applied_is_the_scene_as_it_is() -> None:
    chosen = plan(built_in_scene("shared-edge").make())
    others = PIPELINE.candidates(chosen.settings)
    (everything,) = plan_candidates(chosen, chosen.settings, others)
    assert settings_of(chosen.settings, everything.method) == chosen.everything
    study = replace(
        measure("visibility", "cycle", rounds=1),
        settings=chosen.settings,
        points=tuple(Point(each.method, each.title, np.ones(1), 1) for each in (*others, everything)),
    )
    assert chosen_points(study, chosen) == (f"fill={chosen.settings.fill}",)
    assert title_of(study.points[-1], [point.method for point in study.points]) == "Reference settings"
    one_away = replace(chosen.everything, antialiasing="none")
    (choice,) = plan_candidates(chosen, one_away, (Candidate("antialiasing=ssaa-16", ""),))
    assert settings_of(one_away, choice.method) == chosen.settings
