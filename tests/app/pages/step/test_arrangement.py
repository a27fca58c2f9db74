"""The picture comes first: how much of the window the main view has, and what may not move it."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QHeaderView,
    QLabel,
    QLineEdit,
    QSlider,
    QTabBar,
    QWidget,
)
from pytestqt.qtbot import QtBot

from app.files.preferences import Preferences
from app.window.main_window import MainWindow
from core.stages.declared import STAGES
from tests.core.listings import listings_of_the_program
from tests.covering import is_everything
from widgets.basics.choice_box import ChoiceBox
from widgets.basics.message_bar import Message, MessageKind
from widgets.basics.settings_panel import SettingsPanel
from widgets.basics.style_sheet import style_sheet
from widgets.basics.theme import current_theme
from widgets.inspector.listing import ListingText, ListingView

pytestmark = pytest.mark.shared_window


def area_of_the_view(window: MainWindow) -> float:
    """Return the part of the window that the main view has."""
    view = window.page.main_view()
    return view.width() * view.height() / (window.width() * window.height())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("size", "least"), [((1280, 800), 0.45), pytest.param((1920, 1080), 0.6, marks=pytest.mark.slow)]
)
def test_the_main_view_has_its_part_of_the_window(
    window: MainWindow, qtbot: QtBot, size: tuple[int, int], least: float
) -> None:
    window.resize(*size)
    qtbot.waitUntil(lambda: (window.width(), window.height()) == size)
    for stage in STAGES:
        window.session.set_stage(stage)
        for view in window.page.view_names() if stage == "raster" else ["pixels"]:
            window.page.show_view(view)
            QApplication.processEvents()
            whole = window.page.main_area.both_sides
            assert whole.width() * whole.height() >= least * size[0] * size[1], (stage, view)
            if view != "compare" and not window.page.main_area.beside.isVisible():
                assert area_of_the_view(window) >= least, (stage, view)


def place_of_pixel(window: MainWindow) -> tuple[QPoint, QPoint]:
    """Return the corners of pixel (20, 20) in the window."""
    QApplication.processEvents()
    grid = window.page.grid
    rect = grid.placement().cells_rect(20, 20).toRect()
    return grid.mapTo(window, rect.topLeft()), grid.mapTo(window, rect.bottomRight())


def test_no_feedback_moves_the_grid(window: MainWindow) -> None:
    place = place_of_pixel(window)
    for kind in MessageKind:
        window.messages.show_message(Message(kind, "A long message. " * 40, "Details. " * 200))
        window.messages.details_button.click()
        assert window.messages.isVisible()
        assert place_of_pixel(window) == place
        window.messages.dismiss()
        assert place_of_pixel(window) == place
    window.notices.tell(
        "A hint that is a good deal longer than the room beside the names of the pages has. " * 4
    )
    assert place_of_pixel(window) == place
    window.run_action("predict")
    assert window.page.prediction.isVisible()
    assert place_of_pixel(window) == place
    window.run_action("predict")
    window.session.set_pin((20, 20))
    assert place_of_pixel(window) == place
    window.page.main_area.buffer_choice.buffer_chosen.emit("edge 0")
    window.page.main_area.range_button.click()
    assert window.page.ranges.isVisible()
    assert place_of_pixel(window) == place
    window.page.card.fold_button.click()
    assert place_of_pixel(window) == place


@pytest.mark.slow
def test_no_step_of_a_stage_moves_the_grid(window: MainWindow) -> None:
    for stage in ("transform", "edges", "raster", "depth"):
        window.session.set_stage(stage, 0)
        window.page.show_view("pixels")
        count = window.session.stage_trace.steps.count
        places = set()
        for position in range(0, count + 1, max(count // 3, 1)):
            window.session.go_to(position)
            places.add(str(place_of_pixel(window)))
        assert len(places) == 1, stage


def test_panes_are_folded_at_first_and_come_by_keys(window: MainWindow) -> None:
    page = window.page
    assert page.shown_panes() == ["inspector", "details", "navigator", "run"]
    assert not page.outline.isVisible()
    page.side_tabs.buttons["scene"].click()
    assert page.outline.isVisible()
    assert page.columns.sizes()[0] >= 200
    page.side_tabs.buttons["methods"].click()
    assert page.shown_panes() == ["methods", "inspector", "details", "navigator", "run"]
    assert window.menus.actions_by_name["pane_methods"].isChecked()
    page.side_tabs.buttons["methods"].click()
    assert page.shown_panes() == ["inspector", "details", "navigator", "run"]
    assert page.side_panes.isHidden()


@pytest.mark.slow
def test_a_buffer_that_is_alone_is_shown_once(window: MainWindow) -> None:
    page = window.page
    page.toggle_pane("thumbnails")
    assert page.strip.isVisible()
    window.session.set_stage("cull")
    assert not page.strip.isVisible()
    assert not page.main_area.buffer_choice.isEnabled()
    assert page.main_area.buffer_choice.currentText() == page.grid.buffer().label
    window.session.set_stage("raster")
    assert page.strip.isVisible()


@pytest.mark.slow
def test_shown_panes_and_widths_come_back(window: MainWindow, qtbot: QtBot) -> None:
    page = window.page
    page.show_panes(["overlays", "thumbnails"])
    page.columns.restoreState(b"30.000 25.000")
    left = page.columns.sizes()[0]
    layout = page.layout_state()
    window.memory.save_preferences(window)
    kept = window.memory.preferences
    assert kept.shown_panes == ["overlays", "thumbnails"]
    other = MainWindow(window.session.document, kept)
    qtbot.addWidget(other)
    other.resize(1280, 800)
    other.memory.restore(other)
    other.show()
    assert other.page.shown_panes() == ["overlays", "thumbnails"]
    assert other.page.columns.sizes()[0] == pytest.approx(left, abs=2)
    assert other.page.layout_state()["step columns"] == layout["step columns"]
    other.close()


def test_the_layout_of_an_earlier_version_opens_as_at_first(window: MainWindow, qtbot: QtBot) -> None:
    """Panes of three columns with the strip below, as they were saved before panes could be folded."""
    earlier = "AAAA/wAAAAEAAAADAAABKAAAAmgAAAFgAf////8BAAAAAQA="
    layout = {"columns": earlier, "rows": earlier, "inspector": earlier, "step columns": earlier}
    other = MainWindow(window.session.document, Preferences(layout=layout))
    qtbot.addWidget(other)
    other.resize(1280, 800)
    other.memory.restore(other)
    other.show()
    qtbot.waitExposed(other)
    assert other.page.shown_panes() == ["inspector", "details", "navigator", "run"]
    assert area_of_the_view(other) >= 0.45
    other.close()


@pytest.mark.slow
def test_nothing_is_cut_that_stands_nowhere_else(window: MainWindow) -> None:
    """Labels, tabs and buttons at 1280 x 800: whole, or with the whole text as a tip."""
    for stage in STAGES:
        window.session.set_stage(stage)
        QApplication.processEvents()
        for widget in window.page.findChildren(QWidget):
            if not widget.isVisible():
                continue
            where = stage, type(widget).__name__, widget.accessibleName()
            if isinstance(widget, QLabel) and widget.wordWrap():
                assert widget.heightForWidth(widget.width()) <= widget.height() + 1, (*where, widget.text())
            elif isinstance(widget, QLabel | QAbstractButton):
                is_whole = widget.sizeHint().width() <= widget.width() + 1 and "…" not in widget.text()
                assert is_whole or widget.toolTip(), (*where, widget.text())
            elif isinstance(widget, QTabBar):
                ends = [widget.tabRect(index) for index in range(widget.count())]
                assert all(end.left() >= 0 and end.right() <= widget.width() for end in ends), where
            elif isinstance(widget, ListingView):
                assert not widget.horizontalScrollBar().maximum(), where
                lines = [widget.document().findBlockByNumber(number) for number in range(10)]
                rows = sum(widget.blockBoundingRect(line).height() for line in lines if line.isValid())
                least = min(rows, 10 * widget.fontMetrics().lineSpacing())
                assert least <= widget.viewport().height(), (where, rows)


@pytest.mark.slow
def test_every_method_can_be_read_whole_in_its_box(window: MainWindow) -> None:
    """Of every family, beside a scroll bar."""
    page = window.page
    page.show_panes(["methods", "inspector"])
    panel = page.findChild(SettingsPanel)
    panel.show_more(True)
    try:
        for box in panel.findChildren(ChoiceBox):
            for text in (box.itemText(place) for place in range(box.count())):
                box.setCurrentText(text)
                QApplication.processEvents()
                rows = box.shown_rows()
                assert "".join(rows).replace(" ", "") == text.replace(" ", ""), box.accessibleName()
                assert len(rows) * box.fontMetrics().lineSpacing() < box.height()
    finally:
        panel.show_more(False)


@pytest.mark.slow
@pytest.mark.own_window
def test_ten_lines_are_in_sight_around_each_line_of_every_listing(window: MainWindow) -> None:
    """Whole, though some are wrapped; all of them where a function has fewer."""
    application = QApplication.instance()
    assert isinstance(application, QApplication)
    application.setStyleSheet(style_sheet(current_theme()))
    QApplication.processEvents()
    view = window.page.listing
    seen = 0
    for found in list(listings_of_the_program())[:: 1 if is_everything() else 4]:
        title = found.function.__name__
        view.keep_room_for([found.source])
        view.show_listing(ListingText(title, found.source))
        QApplication.processEvents()
        shown = len(list(view.visible_lines()))
        lines = sorted(set(found.lines.values()))
        for line in lines if is_everything() else {lines[0], lines[-1]}:
            view.show_line(line)
            bottom = view.viewport().height()
            whole = [k for k, box in view.visible_lines() if box.top() >= 0 and box.bottom() <= bottom]
            assert line in whole, (title, line)
            assert len(whole) >= min(10, shown), (title, line, whole)
        seen += 1
    assert seen >= 25


LEAST_TARGET = 24


@pytest.mark.slow
def test_everything_that_is_clicked_is_large_enough(window: MainWindow) -> None:
    """On every page; a border between panes is moved by its keys too, and what scrolls by wheel and keys."""
    application = QApplication.instance()
    assert isinstance(application, QApplication)
    application.setStyleSheet(style_sheet(current_theme()))
    page = window.page
    places = [("step", side) for side in ("scene", "methods", "overlays")]
    for name, side in [*places, *((other, "") for other in window.pages.names if other != "step")]:
        window.pages.show_page(name)
        page.show_panes([side, "inspector", "thumbnails", "navigator"])
        window.session.set_stage("interpolate")
        QApplication.processEvents()
        for widget in window.findChildren(QWidget):
            if not widget.isVisible() or isinstance(widget.parent(), QAbstractSpinBox | QComboBox):
                continue
            where = name, side, type(widget).__name__, widget.accessibleName()
            if isinstance(widget, QTabBar):
                sides = [widget.tabRect(index).size() for index in range(widget.count())]
            elif isinstance(widget, QHeaderView):
                continue
            elif isinstance(widget, QAbstractItemView) and widget.model() and widget.model().rowCount():
                sides = [widget.visualRect(widget.model().index(0, 0)).size()]
            elif isinstance(widget, QAbstractButton | QComboBox | QLineEdit | QAbstractSpinBox | QSlider):
                sides = [widget.size()]
            else:
                continue
            assert all(min(size.width(), size.height()) >= LEAST_TARGET for size in sides), (where, sides)


def test_a_border_is_taken_by_a_grip_that_reaches_over_the_panes(window: MainWindow) -> None:
    columns = window.page.columns
    border = columns.handle(2)
    grip = border.mask().boundingRect()
    assert min(grip.width(), grip.height()) >= LEAST_TARGET
    before = columns.sizes()
    start = border.rect().center() - QPoint(10, 0)
    QTest.mousePress(border, Qt.MouseButton.LeftButton, pos=start)
    QTest.mouseMove(border, start - QPoint(40, 0))
    QTest.mouseRelease(border, Qt.MouseButton.LeftButton, pos=start)
    assert columns.sizes()[2] == before[2] + 40
    assert columns.sizes()[1] == before[1] - 40
