"""A step lays out once and paints once, and nothing outside of the panes that say something else."""

from collections import Counter

import pytest
from PySide6.QtCore import QEvent, QObject, QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QCheckBox, QComboBox, QWidget
from pytestqt.qtbot import QtBot

from app.pages.step.inspector_presenter import load_stages
from app.session.document import open_document
from app.window.main_window import MainWindow
from core.records.steps import Level
from lessons.scenes import make_scene
from tests.app.pages.step.lesson_walks import settled

pytestmark = pytest.mark.shared_window


class EventCount(QObject):
    """Counts layouts, sizes and paintings by widget."""

    def __init__(self) -> None:
        super().__init__()
        self.layouts: Counter[str] = Counter()
        self.paints: Counter[QWidget] = Counter()
        self.resizes: Counter[QWidget] = Counter()
        self.updates = 0

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if isinstance(watched, QWidget):
            if event.type() == QEvent.Type.LayoutRequest:
                self.layouts[type(watched).__name__] += 1
            elif event.type() == QEvent.Type.Paint:
                self.paints[watched] += 1
            elif event.type() == QEvent.Type.Resize:
                self.resizes[watched] += 1
            elif event.type() == QEvent.Type.UpdateRequest and watched.isWindow():
                self.updates += 1
        return False


def events_of_a_step(window: MainWindow, qtbot: QtBot) -> EventCount:
    """Return what one press of Right makes, once the formulas around are typeset."""
    qtbot.waitUntil(lambda: window.page.formula.is_complete() and not window.page.inspector.ahead.is_working)
    QApplication.processEvents()
    count = EventCount()
    application = QApplication.instance()
    application.installEventFilter(count)
    QTest.keyClick(window, Qt.Key.Key_Right)
    for _ in range(3):
        QApplication.processEvents()
    application.removeEventFilter(count)
    return count


@pytest.mark.parametrize("stage", ["raster", "interpolate", "depth"])
def test_a_step_is_laid_out_in_the_inspector_alone_and_painted_once(
    window: MainWindow, qtbot: QtBot, stage: str
) -> None:
    session = window.session
    session.set_stage(stage, 0)
    session.set_level(Level.PIXEL)
    QTest.keyClick(window, Qt.Key.Key_Right)
    for _ in range(3):
        count = events_of_a_step(window, qtbot)
        assert not {"MainWindow", "Pages", "StepPage", "Timeline", "MainArea"} & set(count.layouts)
        assert count.updates == 1
        assert {str(widget): times for widget, times in count.paints.items() if times > 1} == {}
        assert not any(count.paints[pane] for pane in (window.page.outline, window.page.settings_panel))


def test_a_step_that_moves_nothing_in_space_paints_no_space(window: MainWindow, qtbot: QtBot) -> None:
    session, page = window.session, window.page
    session.open(open_document(make_scene("cube"), "cube"))
    session.set_stage("transform", 0)
    session.set_level(Level.OPERATION)
    session.go_to(1)
    page.settle()
    views = page.main_view(), page.main_area.companions["transform"].widget
    count = events_of_a_step(window, qtbot)
    assert session.cursor.position < session.stage_trace.steps.starts[1], "inside of a row"
    assert [count.paints[view] for view in views] == [0, 0]
    session.set_level(Level.PIXEL)
    count = events_of_a_step(window, qtbot)
    assert [count.paints[view] for view in views] == [1, 1]


@pytest.mark.slow
def test_a_table_that_fills_is_laid_out_by_itself_and_painted_once(window: MainWindow, qtbot: QtBot) -> None:
    session, page = window.session, window.page
    session.open(open_document(make_scene("cube"), "cube"))
    session.set_stage("cull", 0)
    session.set_level(Level.TRIANGLE)
    page.settle()
    cells = page.main_area.companions["cull"].widget.cells
    widths = {cells.columnWidth(0)}
    for _ in range(3):
        count = events_of_a_step(window, qtbot)
        assert "MainArea" not in count.layouts
        assert count.paints[cells.viewport()] == 1
        widths.add(cells.columnWidth(0))
    assert len(widths) > 1, "a width changed"


def test_panes_that_are_folded_away_are_filled_when_they_are_unfolded(window: MainWindow) -> None:
    page, session = window.page, window.session
    assert not page.settings_panel.isVisible()
    session.set_setting("fill", "blocks")
    assert page.settings_panel.findChildren(QComboBox) == []
    page.show_panes(["methods"])
    assert page.settings_panel.findChildren(QComboBox) != []
    assert page.legend.findChildren(QCheckBox) == []
    page.show_panes(["overlays"])
    assert page.legend.findChildren(QCheckBox) != []


def test_listings_that_take_turns_in_a_stage_move_nothing(window: MainWindow, qtbot: QtBot) -> None:
    session, listing = window.session, window.page.listing
    qtbot.waitUntil(lambda: listing.width() < 440)
    session.set_stage("edges", 0)
    session.set_level(Level.GROUP)
    session.step(1)
    room, functions = listing.minimumHeight(), set()
    for _ in range(4):
        functions.add(listing.accessibleName())
        assert listing.minimumHeight() == room
        session.step(1)
    assert len(functions) > 1


def test_what_stages_are_traced_with_is_loaded_once_the_window_stands(
    window: MainWindow, qtbot: QtBot
) -> None:
    qtbot.waitUntil(lambda: not window.page.inspector.ahead.is_working)
    assert load_stages.cache_info().currsize == 1
    assert not load_stages().is_alive()


def test_a_step_of_a_lesson_gives_each_pane_its_room_and_paints_it_once(
    window: MainWindow, qtbot: QtBot
) -> None:
    page = window.page
    page.lessons.keeps_attempts = False
    page.lessons.open("the-middle", 4)
    walk = settled(window, qtbot)
    page.settle()
    QTest.mouseMove(
        window, QPoint(1, 1)
    )  # Where nothing lights up: a border would when it comes to the pointer.
    area, before = page.main_area, page.main_area.width()
    count = EventCount()
    application = QApplication.instance()
    application.installEventFilter(count)
    walk.next()
    settled(window, qtbot)
    QApplication.processEvents()
    application.removeEventFilter(count)
    assert walk.number == 5
    assert area.width() < before, "the Scene pane has been unfolded"
    panes = (area, area.view_stack, page.side, walk.task.scroll, page.outline.widget())
    assert [count.resizes[pane] for pane in panes] == [1] * len(panes)
    assert {str(widget): times for widget, times in count.paints.items() if times > 1} == {}
    assert {count.paints[grid] for grid in area.compare_view.grids} == {1}
