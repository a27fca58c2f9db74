"""While presenting: type and picture that can be seen across a room, and other scenes without leaving."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QFontMetricsF, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QWidget
from pytestqt.qtbot import QtBot

from app.window.main_window import MainWindow
from core import STAGES
from core.explain.records import Formula
from tests.covering import is_everything

SIZES = [(1280, 720), (1920, 1080)]
CTRL_SHIFT = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier


def resize(window: MainWindow, size: tuple[int, int]) -> None:
    """Give a window another size; a presenter's type follows."""
    window.resize(*size)
    window.page.settle()


def ink_height(widget: QWidget) -> int:
    """Return the height in pixels of what is drawn on the plain ground of a widget."""
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_RGB32)
    rows = np.frombuffer(image.constBits(), np.uint32).reshape(image.height(), image.width())
    inside = rows[2:-2, 2:-2]
    drawn = np.flatnonzero((inside != inside[0, 0]).any(axis=1))
    return int(drawn[-1] - drawn[0] + 1) if len(drawn) else 0


def press(
    window: MainWindow, key: Qt.Key, modifiers: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier
) -> None:
    """Press a key where the keyboard is, as a person or a clicker does."""
    QTest.keyClick(window.focusWidget() or window, key, modifiers)


@pytest.mark.slow
def test_type_and_picture_are_as_large_as_a_lecture_hall_needs(presented: MainWindow) -> None:
    page, session = presented.page, presented.session
    for size in SIZES if is_everything() else SIZES[:1]:
        resize(presented, size)
        assert (presented.width(), presented.height()) == size
        picture = page.main_view()
        assert presented.pages.minimumSizeHint().width() <= 0.6 * size[0], "Help needs a third of the width"
        assert picture.width() * picture.height() >= 0.55 * size[0] * size[1]
        steps = f"step {session.cursor.position:,} of "
        assert steps + f"{session.stage_trace.steps.count:,}" in page.place.text()
        assert page.place.fontMetrics().horizontalAdvance(page.place.text()) <= page.place.width()
        page.sentence.setText("H")
        page.formula.show_formula(Formula("E", ""))
        page.settle()
        assert ink_height(page.sentence) >= 0.022 * size[1]
        assert ink_height(page.formula) >= 0.022 * size[1]
        assert QFontMetricsF(page.listing.font()).tightBoundingRect("H").height() >= 0.018 * size[1]
    session.set_predicting(True)
    assert steps + "?" in page.place.text()
    page.show_view("compare")
    assert page.place.isVisible()


def test_a_settled_page_has_room_for_a_new_formula(presented: MainWindow) -> None:
    page = presented.page
    presented.session.set_stage("edges", 6)
    page.settle()
    assert page.formula.heightForWidth(page.formula.width()) <= page.formula.height()


@pytest.mark.slow
def test_the_formulas_of_a_run_are_not_shrunk(presented: MainWindow) -> None:
    page, session, formula = presented.page, presented.session, presented.page.formula
    for stage in STAGES:
        session.set_stage(stage)
        for position in np.linspace(1, session.cursor.position, 3).astype(int).tolist():
            session.go_to(position)
            page.settle()
            assert formula.heightForWidth(formula.width()) <= formula.height()


@pytest.mark.slow
def test_only_what_the_step_needs_is_shown_and_the_rest_comes_by_key(presented: MainWindow) -> None:
    page = presented.page
    rest = {
        Qt.Key.Key_R: page.timeline,
        Qt.Key.Key_T: page.strip,
        Qt.Key.Key_H: page.column.variables,
        Qt.Key.Key_S: page.outline,
    }
    bars = presented.menuBar(), presented.pages.bar, page.side_tabs, page.card
    assert page.sentence.isVisible()
    assert not any(widget.isVisible() for widget in (*rest.values(), *bars))
    picture = page.main_view().geometry()
    presented.session.set_stage("edges")
    page.show_view("pixels")
    page.settle()
    assert not page.main_area.range_button.isVisible()
    assert page.main_view().geometry() == picture
    for key, widget in rest.items():
        for is_shown in (True, False):
            QTest.keyClick(presented, key)
            assert widget.isVisible() == is_shown


def test_hints_are_seen_although_their_bar_is_not(presented: MainWindow) -> None:
    hint, picture = presented.presenter.hint, presented.page.main_view()
    place = picture.geometry()
    presented.run_action("next_at_pin")
    assert hint.isVisible()
    assert hint.text() == presented.statusBar().currentMessage() != ""
    assert picture.geometry() == place
    assert hint.x() >= presented.page.side.mapTo(presented, QPoint(0, 0)).x(), "beside the picture"


def test_a_b_has_the_whole_width(presented: MainWindow) -> None:
    page = presented.page
    assert "inspector" in page.shown_panes()
    page.show_view("compare")
    page.settle()
    assert page.compare_view.grids[0].placement().seen_raster.width() >= 0.25 * presented.width()
    page.show_view("pixels")
    assert "inspector" in page.shown_panes()


def test_pages_scroll_where_large_type_has_no_room(presented: MainWindow) -> None:
    for name in ("compare", "stability"):
        presented.pages.show_page(name)
        panes = presented.pages.current.panes
        panes.widget(1).show()
        QApplication.processEvents()
        assert panes.height() >= panes.minimumSizeHint().height(), name
        assert presented.pages.minimumSizeHint().height() <= 720, name


def test_text_grows_while_presenting_and_is_the_desks_own_after_it(presented: MainWindow) -> None:
    sentence, at_desk = presented.page.sentence, presented.appearance.text_size
    usual = sentence.font().pixelSize()
    for key, size in ((Qt.Key.Key_Plus, round(1.1 * usual)), (Qt.Key.Key_Minus, usual)):
        QTest.keyClick(presented, key, Qt.KeyboardModifier.ControlModifier)
        assert sentence.font().pixelSize() == size
    assert presented.appearance.text_size == at_desk


def test_the_start_page_keeps_the_presenter(presented: MainWindow) -> None:
    presented.run_action("page_start")
    presented.run_action("unpin")
    assert presented.pages.current_name == "step"
    assert presented.presenter.is_presenting


def test_a_step_stops_at_the_end_of_a_stage_and_says_so(presented: MainWindow) -> None:
    session, hint = presented.session, presented.presenter.hint
    session.set_stage("cull")
    for _ in range(2):
        end = session.cursor
        QTest.keyClick(presented, Qt.Key.Key_PageDown)
        assert session.cursor == end
        assert hint.isVisible()
        QTest.keyClick(presented, Qt.Key.Key_Left)
        assert session.cursor != end
        QTest.keyClick(presented, Qt.Key.Key_Right)
        assert session.cursor == end
    for _ in range(2):
        QTest.keyClick(presented, Qt.Key.Key_Right)
    assert (session.cursor.stage, session.cursor.position) == ("clip", 0)
    assert not hint.isVisible()


def test_a_clicker_opens_another_scene(presented: MainWindow, qtbot: QtBot) -> None:
    chooser = presented.overlays.scenes
    press(presented, Qt.Key.Key_F5)
    assert presented.session.cursor.stage == STAGES[0]
    assert not chooser.isVisible()
    press(presented, Qt.Key.Key_F5)
    assert chooser.isVisible()
    first = chooser.current()
    press(presented, Qt.Key.Key_PageDown)
    second = chooser.current()
    assert second not in ("", first)
    press(presented, Qt.Key.Key_PageUp)
    assert chooser.current() == first
    press(presented, Qt.Key.Key_Period)
    assert not chooser.isVisible()
    presented.page.stepping.choose_stage(5)
    presented.pages.show_page("start")
    press(presented, Qt.Key.Key_F5)
    press(presented, Qt.Key.Key_PageDown)
    press(presented, Qt.Key.Key_F5)
    assert not chooser.isVisible()
    qtbot.waitUntil(lambda: second in (presented.files.shown, presented.page.lessons.path))
    assert presented.presenter.is_presenting
    assert presented.pages.current_name == "step"


def test_typed_words_find_a_scene_from_any_page(presented: MainWindow, qtbot: QtBot) -> None:
    presented.pages.show_page("compare")
    press(presented, Qt.Key.Key_O, CTRL_SHIFT)
    field = presented.overlays.scenes.field
    QTest.keyClicks(field, "bresenham jubair zzz")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert presented.overlays.scenes.isVisible(), "nothing has these words, so nothing is chosen"
    field.clear()
    QTest.keyClicks(field, "polygon b. weiler")
    assert presented.overlays.scenes.current() == ""
    field.clear()
    QTest.keyClicks(field, "weiler-ath")
    QTest.keyClick(field, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: presented.files.shown == "weiler-atherton")
    assert presented.pages.current_name == "step"
    assert presented.presenter.is_presenting
    press(presented, Qt.Key.Key_O, CTRL_SHIFT)
    press(presented, Qt.Key.Key_Escape)
    assert not presented.overlays.scenes.isVisible()
    assert presented.presenter.is_presenting


def test_a_printed_listing_is_shown_without_the_menu(presented: MainWindow, qtbot: QtBot) -> None:
    presented.open_path("pellacini-line")
    qtbot.waitUntil(lambda: presented.session.document.scene.corner_count == 2)
    presented.run_action("choose_scene")
    chooser = presented.overlays.scenes
    QTest.keyClicks(chooser.field, "printed bresenham")
    QTest.keyClick(chooser.field, Qt.Key.Key_Return)
    assert presented.page.current_view() == "compare"
    assert presented.page.comparing.printed


def test_f5_measures_on_compare(presented: MainWindow) -> None:
    presented.pages.show_page("compare")
    page = presented.pages.current
    press(presented, Qt.Key.Key_F5)
    assert page.is_running
    page.cancel()
    assert presented.pages.current is page


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_flow_grows_and_is_seen_whole(presented: MainWindow, size: tuple[int, int]) -> None:
    presented.page.show_view("flow")
    resize(presented, size)
    view = presented.page.main_view()
    assert view.width() * view.height() >= 0.5 * size[0] * size[1]
    sizes = {label.font().pixelSize() for label in view.findChildren(QLabel) if not label.property("role")}
    assert len(sizes) == 1
    assert sizes.pop() >= 0.024 * size[1]
    assert view.verticalScrollBar().maximum() == view.horizontalScrollBar().maximum() == 0
