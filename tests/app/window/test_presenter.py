"""Presenting: type and picture that can be seen across a room, a clicker's keys, and the way back."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QFontMetricsF, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from app.files.open_any import Opened, open_any
from app.session.document import open_document
from app.window.main_window import MainWindow
from core import STAGES
from core.explain.records import Formula
from lessons.slides.scenes import ALL_SCENES
from tests.covering import in_turns, is_everything
from widgets.basics.key_claim import KeyClaim
from widgets.basics.message_bar import Message, MessageKind
from widgets.basics.theme import current_theme
from widgets.space.scene_view import SceneView
from widgets.tables.step_table_view import StepTableView

SIZES = [(1280, 720), (1920, 1080)]


def present(window: MainWindow, size: tuple[int, int]) -> None:
    """Arrange a window of a size for presenting, from the program's own look."""
    window.appearance.set_theme("light")
    window.resize(*size)
    window.presenter.arrange()
    window.page.settle()


def ink_height(widget: QWidget) -> int:
    """Return the height in pixels of what is drawn on the plain ground of a widget."""
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_RGB32)
    rows = np.frombuffer(image.constBits(), np.uint32).reshape(image.height(), image.width())
    inside = rows[2:-2, 2:-2]
    drawn = np.flatnonzero((inside != inside[0, 0]).any(axis=1))
    return int(drawn[-1] - drawn[0] + 1) if len(drawn) else 0


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_type_and_picture_are_as_large_as_a_lecture_hall_needs(
    window: MainWindow, size: tuple[int, int]
) -> None:
    present(window, size)
    page, height = window.page, size[1]
    assert (window.width(), window.height()) == size
    picture = page.main_view()
    assert window.pages.minimumSizeHint().width() <= 0.6 * size[0], "Help needs a third of the width"
    assert picture.width() * picture.height() >= 0.55 * size[0] * size[1]
    page.sentence.setText("H")
    page.formula.show_formula(Formula("E", ""))
    page.settle()
    assert ink_height(page.sentence) >= 0.022 * height
    assert ink_height(page.formula) >= 0.022 * height
    assert QFontMetricsF(page.listing.font()).tightBoundingRect("H").height() >= 0.018 * height


def test_a_settled_page_has_room_for_a_new_formula(window: MainWindow) -> None:
    present(window, (1280, 720))
    page = window.page
    window.session.set_stage("edges", 6)
    page.settle()
    assert page.formula.heightForWidth(page.formula.width()) <= page.formula.height()


@pytest.mark.slow
def test_the_formulas_of_a_run_are_not_shrunk(window: MainWindow) -> None:
    present(window, (1280, 720))
    page, session, formula = window.page, window.session, window.page.formula
    for stage in STAGES:
        session.set_stage(stage)
        for position in np.linspace(1, session.cursor.position, 3).astype(int).tolist():
            session.go_to(position)
            page.settle()
            assert formula.heightForWidth(formula.width()) <= formula.height()


def test_only_what_the_step_needs_is_shown_and_the_rest_comes_by_key(window: MainWindow) -> None:
    page = window.page
    present(window, (1920, 1080))
    rest = {Qt.Key.Key_R: page.timeline, Qt.Key.Key_T: page.strip, Qt.Key.Key_H: page.column.variables}
    rest[Qt.Key.Key_S] = page.outline
    assert page.sentence.isVisible()
    assert not any(
        widget.isVisible()
        for widget in (*rest.values(), window.menuBar(), window.pages.bar, page.side_tabs, page.card)
    )
    picture = page.main_view().geometry()
    window.session.set_stage("edges")
    page.show_view("pixels")
    page.settle()
    assert not page.main_area.range_button.isVisible()
    assert page.main_view().geometry() == picture
    for key, widget in rest.items():
        QTest.keyClick(window, key)
        assert widget.isVisible()
        QTest.keyClick(window, key)
        assert not widget.isVisible()


def test_a_clicker_steps_starts_and_blacks_out_here_and_only_here(window: MainWindow) -> None:
    session, stepping = window.session, window.page.stepping
    before = session.cursor
    session.set_pin((20, 20))
    QTest.keyClick(window, Qt.Key.Key_B)
    assert stepping.breaks.pixels == {(20, 20)}
    QTest.keyClick(window, Qt.Key.Key_PageDown)
    assert session.cursor == before
    present(window, (1280, 720))
    window.page.grid.setFocus()
    QTest.keyClick(window.page.grid, Qt.Key.Key_PageDown)
    assert session.cursor.position > before.position
    QTest.keyClick(window.page.grid, Qt.Key.Key_PageUp)
    assert session.cursor == before
    for key in (Qt.Key.Key_B, Qt.Key.Key_Period):
        QTest.keyClick(window, key)
        assert window.grab().toImage().pixelColor(640, 360) == Qt.GlobalColor.black
        QTest.keyClick(window, Qt.Key.Key_PageDown)
        assert window.grab().toImage().pixelColor(640, 5) != Qt.GlobalColor.black
        assert session.cursor == before
    assert stepping.breaks.pixels == {(20, 20)}
    QTest.keyClick(window, Qt.Key.Key_F5)
    assert (session.cursor.stage, session.cursor.position) == (STAGES[0], 0)
    window.overlays.ask_pixel()
    QTest.keyClicks(window.overlays.ask_bar.field, "b.")
    assert window.overlays.ask_bar.field.text() == "b."


@pytest.mark.parametrize("theme", [pytest.param("light", marks=pytest.mark.slow), "dark"])
def test_leaving_brings_the_window_back(window: MainWindow, qtbot: QtBot, theme: str) -> None:
    page = window.page
    window.appearance.set_theme(theme)
    page.show_panes(["methods", "inspector", "details", "run"])
    page.settle()

    def desk() -> tuple[object, ...]:
        shown = (window.menuBar(), window.pages.bar, page.side_tabs, page.card, page.main_area.view_bar)
        return (
            window.geometry(),
            window.windowState(),
            window.appearance.name,
            page.shown_panes(),
            [part.geometry() for part in (page.main_area, page.column, page.listing, page.column.variables)],
            [widget.isVisible() for widget in shown],
        )

    window.presenter.toggle()  # once: a style that is new changes a height by a pixel or two
    window.presenter.toggle()
    for _ in range(5):
        page.settle()
    before = desk()
    keys = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    QTest.keyClick(window, Qt.Key.Key_P, keys)
    assert window.isFullScreen()
    assert window.appearance.name == ("presenter" if theme == "light" else "presenter-dark")
    large = page.sentence.font().pixelSize()
    QTest.keyClick(window, Qt.Key.Key_T, Qt.KeyboardModifier.ControlModifier)
    assert window.appearance.name == ("presenter-dark" if theme == "light" else "presenter")
    assert page.sentence.font().pixelSize() == large
    QTest.keyClick(window, Qt.Key.Key_T)
    QTest.keyClick(window, Qt.Key.Key_Escape)
    assert not window.isFullScreen()
    qtbot.waitUntil(lambda: desk() == before)


def test_hints_are_seen_although_their_bar_is_not(window: MainWindow) -> None:
    present(window, (1280, 720))
    picture = window.page.main_view().geometry()
    window.run_action("next_at_pin")
    assert window.presenter.hint.isVisible()
    assert window.presenter.hint.text() == "Pin a pixel first: click it."
    assert window.page.main_view().geometry() == picture
    side = window.page.side
    assert window.presenter.hint.x() >= side.mapTo(window, QPoint(0, 0)).x(), "beside the picture"


def test_a_table_of_depths_has_large_numbers_or_stands_alone(window: MainWindow) -> None:
    scene = ALL_SCENES["jubair-z-buffer"]
    window.session.open(open_document(scene.make(), scene.title))
    window.session.set_stage("depth")
    assert window.page.main_area.beside.isVisible()
    present(window, (1280, 720))
    assert not window.page.main_area.beside.isVisible()
    assert current_theme().small_px >= 0.9 * current_theme().text_px


def test_a_b_has_the_whole_width(window: MainWindow) -> None:
    present(window, (1280, 720))
    assert "inspector" in window.page.shown_panes()
    window.page.show_view("compare")
    window.page.settle()
    raster = window.page.compare_view.grids[0].placement().seen_raster
    assert raster.width() >= 0.25 * window.width()
    window.page.show_view("pixels")
    assert "inspector" in window.page.shown_panes()


def test_pages_scroll_where_large_type_has_no_room(window: MainWindow) -> None:
    present(window, (1280, 720))
    for name in ("compare", "stability"):
        window.pages.show_page(name)
        panes = window.pages.current.panes
        panes.widget(1).show()
        QApplication.processEvents()
        assert panes.height() >= panes.minimumSizeHint().height(), name
        assert window.pages.minimumSizeHint().height() <= 720, name


def test_text_grows_while_presenting_and_is_the_desks_own_after_it(window: MainWindow) -> None:
    present(window, (1280, 720))
    usual, at_desk = window.page.sentence.font().pixelSize(), window.appearance.text_size
    QTest.keyClick(window, Qt.Key.Key_Plus, Qt.KeyboardModifier.ControlModifier)
    assert window.page.sentence.font().pixelSize() == round(1.1 * usual)
    QTest.keyClick(window, Qt.Key.Key_Minus, Qt.KeyboardModifier.ControlModifier)
    assert window.page.sentence.font().pixelSize() == usual
    assert window.appearance.text_size == at_desk


def test_a_state_of_the_desk_opens_clean_and_one_of_the_presenter_whole(window: MainWindow) -> None:
    page = window.page
    page.show_panes(["scene", "inspector", "details", "thumbnails", "navigator", "run"])
    desk, panes = window.files.state(), page.shown_panes()
    page.show_panes(["inspector"])
    present(window, (1280, 720))
    presented = page.shown_panes()
    window.files.show_opened(Opened(desk.document, state=desk))
    assert page.shown_panes() == presented
    assert window.files.state().look.panes == panes
    window.presenter.leave()
    assert page.shown_panes() == panes


def test_the_start_page_keeps_the_presenter(window: MainWindow) -> None:
    present(window, (1280, 720))
    window.run_action("page_start")
    window.run_action("unpin")
    assert window.pages.current_name == "step"
    assert window.presenter.is_presenting


def test_arrows_step_wherever_the_keyboard_is_but_in_a_field(window: MainWindow) -> None:
    page, session = window.page, window.session
    page.show_view("scene")
    present(window, (1280, 720))
    page.show_panes(["scene", "inspector", "run"])
    view = page.main_view()
    assert isinstance(view, SceneView)
    azimuth = view.orbit().azimuth
    for widget in (view, page.column.tabBar(), page.listing, page.timeline.bar):
        widget.setFocus(Qt.FocusReason.TabFocusReason)
        before = session.cursor
        QTest.keyClick(widget, Qt.Key.Key_Right)
        assert session.cursor.position > before.position, widget
    assert view.orbit().azimuth == azimuth
    field = page.outline.field("corner/0/0/x").edit
    field.setFocus(Qt.FocusReason.TabFocusReason)
    before = session.cursor
    QTest.keyClick(field, Qt.Key.Key_Right)
    assert session.cursor == before


def test_a_click_and_escape_give_the_arrows_back_to_stepping(window: MainWindow) -> None:
    page, session = window.page, window.session
    page.show_view("scene")
    view = page.main_view()
    assert isinstance(view, SceneView)
    view.setFocus(Qt.FocusReason.TabFocusReason)
    before, orbit = session.cursor, view.orbit()
    QTest.keyClick(view, Qt.Key.Key_Right)
    assert session.cursor == before
    assert view.orbit() != orbit
    QTest.mouseClick(view, Qt.MouseButton.LeftButton, pos=QPoint(8, 8))
    QTest.keyClick(view, Qt.Key.Key_Right)
    assert session.cursor != before
    page.listing.setFocus(Qt.FocusReason.TabFocusReason)
    view.setFocus(Qt.FocusReason.TabFocusReason)
    before = session.cursor
    QTest.keyClick(view, Qt.Key.Key_Escape)
    QTest.keyClick(view, Qt.Key.Key_Right)
    assert session.cursor != before


def test_escape_ends_run_editor_message_orbiting_pin_and_presenting_in_this_order(
    window: MainWindow,
) -> None:
    page, presenter = window.page, window.presenter
    page.show_view("scene")
    present(window, (1280, 720))
    window.session.set_pin((20, 20))
    page.main_view().setFocus(Qt.FocusReason.TabFocusReason)
    claim = page.main_view().findChild(KeyClaim)
    assert claim is not None
    window.messages.show_message(Message(MessageKind.WARNING, "A message that stays."))
    window.overlays.toggle_keys()
    window.run_action("toggle_play")
    there = {
        "run": page.timeline.is_playing,
        "editor": window.overlays.key_help.isVisible,
        "message": window.messages.isVisible,
        "orbiting": lambda: claim.is_kept,
        "pin": lambda: window.session.pin is not None,
        "presenting": lambda: presenter.is_presenting,
    }
    for number in range(len(there) + 1):
        assert [name for name, is_there in there.items() if is_there()] == list(there)[number:]
        window.run_action("unpin")


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_stage_step_and_scene_are_named(window: MainWindow, size: tuple[int, int]) -> None:
    session, place = window.session, window.page.place
    assert not place.isVisible()
    present(window, size)
    session.set_stage("raster", 4000)
    assert (
        place.text()
        == f"Raster · step 4,000 of {session.stage_trace.steps.count:,} · Two triangles sharing an edge"
    )
    assert place.fontMetrics().horizontalAdvance(place.text()) <= place.width()
    session.set_predicting(True)
    assert "step 4,000 of ?" in place.text()
    window.page.show_view("compare")
    assert place.isVisible()


def test_a_step_stops_at_the_end_of_a_stage_and_says_so(window: MainWindow) -> None:
    session = window.session
    present(window, (1280, 720))
    session.set_stage("cull")
    for _ in range(2):
        end = session.cursor
        QTest.keyClick(window, Qt.Key.Key_PageDown)
        assert session.cursor == end
        assert window.presenter.hint.isVisible()
        assert window.presenter.hint.text() == "Cull is finished. The next step begins Clip."
        QTest.keyClick(window, Qt.Key.Key_Left)
        assert session.cursor != end
        QTest.keyClick(window, Qt.Key.Key_Right)
        assert session.cursor == end
    for _ in range(2):
        QTest.keyClick(window, Qt.Key.Key_Right)
    assert (session.cursor.stage, session.cursor.position) == ("clip", 0)
    assert not window.presenter.hint.isVisible()
    window.presenter.leave()
    session.set_stage("cull")
    QTest.keyClick(window, Qt.Key.Key_Right)
    assert session.cursor.stage == "clip"


@in_turns(
    size=SIZES,
    table=[
        ("cube", "cull"),
        ("polygon-window", "raster"),
        ("polygon-holes", "raster"),
        ("connecting-edges", "clip"),
    ],
)
def test_tables_are_seen_whole(window: MainWindow, size: tuple[int, int], table: tuple[str, str]) -> None:
    scene, stage = table
    window.files.show_opened(open_any(scene))
    present(window, size)
    page, session = window.page, window.session
    session.set_stage(stage)
    page.settle()
    view = page.main_area.companions[stage].widget
    assert isinstance(view, StepTableView)
    for position in np.linspace(0, session.cursor.position, 6 if is_everything() else 3).astype(int).tolist():
        session.go_to(position)
        page.settle()
        assert view.isVisible()
        bars = view.cells.horizontalScrollBar(), view.cells.verticalScrollBar()
        assert [bar.maximum() for bar in bars] == [0, 0], view.table()
        assert page.main_view().height() >= 0.38 * page.main_area.height()
    assert view.cells.font().pixelSize() >= 0.6 * page.sentence.font().pixelSize()
