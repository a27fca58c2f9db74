"""The start page: shown at the first start, by key, and left for stepping by Right, a card, a file."""

from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton
from pytestqt.qtbot import QtBot

from app.files.open_any import open_any
from app.files.preferences import load_preferences
from app.pages.start_page import StartPage, picture_of
from app.window.main_window import MainWindow
from lessons.lectures.scenes import ALL_SCENES, LECTURES
from lessons.scenes import built_in_scene

pytestmark = pytest.mark.shared_window


@pytest.fixture
def page(window: MainWindow, qtbot: QtBot) -> StartPage:
    QTest.keyClick(window, Qt.Key.Key_0, Qt.KeyboardModifier.AltModifier)
    shown = window.pages.current
    qtbot.waitUntil(lambda: not shown.is_drawing)
    return shown


def test_every_scene_has_a_card(page: StartPage) -> None:
    assert [card.entry.name for card in page.cards.cards] == list(ALL_SCENES)
    for card, scene in zip(page.cards.cards, ALL_SCENES.values(), strict=True):
        assert (card.accessibleName(), card.accessibleDescription()) == (scene.title, scene.card)
        assert min(card.width(), card.height()) > 24
    groups = dict.fromkeys(card.parentWidget().accessibleName() for card in page.cards.cards)
    assert list(groups) == ["Scenes", *LECTURES.values()]


@pytest.mark.own_window
def test_pictures_are_drawn_ahead_of_the_eye_and_no_further(window: MainWindow, qtbot: QtBot) -> None:
    window.resize(1280, 800)
    window.pages.show_page("start")
    page = window.pages.current
    qtbot.waitUntil(lambda: page.lessons.place is not None and not page.is_drawing)
    (pane, cards), drawn = (page.cards.parentWidget().parentWidget(), page.cards.cards), []
    bar = pane.parentWidget().verticalScrollBar()
    for place in range(0, bar.maximum() + bar.pageStep(), bar.pageStep() // 2):
        bar.setValue(place)
        qtbot.waitUntil(lambda: not page.is_drawing)
        tops = [card.mapTo(pane, QPoint()).y() for card in cards]
        near = [card for card, top in zip(cards, tops, strict=True) if top <= 1.5 * pane.height()]
        drawn.append([card for card in cards if card.has_picture()])
        assert drawn[-1] == near, "those of all scenes down to half a screen below what is seen"
    assert [len(some) < len(cards) for some in (drawn[0], drawn[-1])] == [True, False]
    page.search.setText("shared edge")
    assert not page.is_drawing


@pytest.mark.own_window
def test_nothing_moves_when_the_lessons_are_there(window: MainWindow, qtbot: QtBot) -> None:
    window.resize(1280, 800)
    window.pages.show_page("start")
    page = window.pages.current
    QApplication.processEvents()
    assert page.lessons.place is None
    parts = (page.begin_button, page.now_label, page.guide_button, page.search, page.lesson_list, page.cards)
    before = {part: part.mapTo(page, QPoint()) for part in parts if part.isVisible()}
    qtbot.waitUntil(lambda: page.lessons.place is not None)
    QApplication.processEvents()
    assert page.cards.isVisible()
    assert before == {part: part.mapTo(page, QPoint()) for part in before}


@pytest.mark.own_window
def test_what_is_in_sight_is_drawn_first(window: MainWindow, qtbot: QtBot) -> None:
    window.pages.show_page("start")
    page = window.pages.current
    order = []
    page._job.succeeded.connect(lambda picture: order.append(picture[0]))
    page.search.setText(list(ALL_SCENES.values())[-1].title)
    qtbot.waitUntil(lambda: bool(order) and not page.is_drawing)
    assert order[0] == next(card.entry.name for card in page.cards.cards if card.isVisible())


def test_typed_words_leave_the_lessons_and_scenes_that_have_them(
    window: MainWindow, page: StartPage, qtbot: QtBot
) -> None:
    def found() -> tuple[list[str], list[str]]:
        lessons = [card.entry.name for card in page.lesson_list.cards if card.isVisible()]
        return lessons, [card.entry.name for card in page.cards.cards if card.isVisible()]

    before = found()
    QTest.keyClick(window, Qt.Key.Key_F, Qt.KeyboardModifier.ControlModifier)
    assert window.focusWidget() is page.search
    QTest.keyClicks(page.search, "Shared EDGE")
    lessons, scenes = found()
    assert lessons[0] == "shared-edges", "also of a part that was folded away"
    assert scenes[0] == "shared-edge"
    assert len(scenes) < 6
    assert page.none_found.isHidden()
    page.search.setText("no such words")
    assert found() == ([], [])
    assert page.none_found.isVisible()
    QTest.keyClick(page.search, Qt.Key.Key_Escape)
    assert found() == before
    assert page.search.text() == ""
    assert window.pages.current is page
    title = ALL_SCENES["cube"].title
    page.search.setText(title.upper())
    assert found()[1][0] != "cube", "another scene speaks of it, too, and comes first"
    QTest.keyClick(page.search, Qt.Key.Key_Return)
    page.search.clear()
    qtbot.waitUntil(lambda: window.session.document.title == title)


def test_pictures_are_drawn_by_the_core() -> None:
    fan, cube, plates = (
        picture_of(built_in_scene(name), built_in_scene(name).make())
        for name in ("fan", "cube", "z-fighting")
    )
    assert (fan.shape, cube.shape) == ((48, 64, 4), (384, 512, 4))
    # The plates are shown as 16 bits of depth draw them.
    assert set((plates[24, 26:36, 0] > plates[24, 26:36, 2]).tolist()) == {True, False}


def test_right_steps_what_is_open(window: MainWindow, page: StartPage) -> None:
    window.session.set_stage("transform", 0)
    assert "“Two triangles sharing an edge”" in page.now_label.text()
    QTest.keyClick(window, Qt.Key.Key_Right)
    assert (window.pages.current_name, window.session.cursor.position > 0) == ("step", True)


@pytest.mark.own_window
def test_arrows_go_from_card_to_card_and_return_opens(
    window: MainWindow, page: StartPage, qtbot: QtBot
) -> None:
    cards = page.cards.cards
    cards[0].setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(cards[0], Qt.Key.Key_Right)
    assert cards[1].hasFocus()
    QTest.keyClick(cards[1], Qt.Key.Key_Right)
    QTest.keyClick(cards[2], Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: window.session.document.title == "Fan of shared edges")
    assert window.pages.current_name == "step"
    session = window.session
    assert (session.cursor.stage, session.cursor.position, session.pin) == ("raster", 4, (32, 24))
    assert window.page.sentence.text().startswith("Pixel (32, 24) is covered")
    window.files.show_opened(open_any("shared-edge"))
    assert "by triangle 1" in window.page.sentence.text()
    assert not window.page.grids.geometry.owner, "the edges have the names of the sentence"
    session.undo()
    session.undo()
    assert session.document.title == "Two triangles sharing an edge"


@pytest.mark.own_window
def test_arrows_go_through_all_groups_and_bring_each_card_into_sight(
    window: MainWindow, page: StartPage
) -> None:
    window.resize(1280, 800)
    QApplication.processEvents()
    cards = page.cards.cards
    cards[0].setFocus(Qt.FocusReason.TabFocusReason)
    for key, back in ((Qt.Key.Key_Down, Qt.Key.Key_Up), (Qt.Key.Key_Right, Qt.Key.Key_Left)):
        passed = [cards[0]]
        while True:
            QTest.keyClick(passed[-1], key)
            (focused,) = [card for card in cards if card.hasFocus()]
            if focused is passed[-1]:
                break
            passed.append(focused)
            assert focused.visibleRegion().boundingRect() == focused.rect()
        assert passed[-1].parentWidget() is cards[-1].parentWidget()
        for _ in passed:
            QTest.keyClick(next(card for card in cards if card.hasFocus()), back)
        assert cards[0].hasFocus()


def test_recent_files_and_the_first_triangle_open(
    window: MainWindow, page: StartPage, qtbot: QtBot, tmp_path: Path
) -> None:
    mesh = tmp_path / "one.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    window.memory.remember_file(str(mesh))
    window.pages.show_page("step")
    window.pages.show_page("start")
    page.findChild(QPushButton, str(mesh)).click()
    qtbot.waitUntil(lambda: window.session.document.title == "one")
    window.pages.show_page("start")
    page.begin_button.click()
    qtbot.waitUntil(lambda: window.session.document.title == "Single triangle")
    assert window.session.cursor.stage == "raster"
    assert window.page.sentence.text().startswith("Pixel (8, 6) is covered")


@pytest.mark.own_window
def test_the_choice_is_remembered_and_the_page_is_not_where_one_stopped(
    window: MainWindow, page: StartPage
) -> None:
    page.always_box.click()
    window.close()
    kept = load_preferences()[0]
    assert (kept.shows_start, kept.page) == (True, "step")


@pytest.mark.own_window
def test_a_file_that_cannot_be_opened_leaves_the_start_page_or_leads_to_it(
    window: MainWindow, page: StartPage, qtbot: QtBot, tmp_path: Path
) -> None:
    wrong, before = str(tmp_path / "gone.obj"), window.session.document

    with qtbot.waitSignal(window.files.ended):
        page.open_requested.emit(wrong)
    assert "gone.obj" in window.messages.text.text()
    assert (window.pages.current_name, window.session.document) == ("start", before)
    for shows_start, shown in ((True, "start"), (False, "step")):
        with qtbot.waitSignal(window.files.ended):
            window.open_first(wrong, False, shows_start)
            assert window.pages.current_name == "step"
        assert window.pages.current_name == shown
    window.open_first("segment", False, True)
    qtbot.waitUntil(lambda: window.session.document.title == "Segment")
    assert window.pages.current_name == "step"


def test_keys_scroll_the_scenes_wherever_the_keyboard_is(window: MainWindow, page: StartPage) -> None:
    bar = page.cards.parentWidget().parentWidget().parentWidget().verticalScrollBar()
    for start in (page.begin_button, page.cards.cards[0]):
        start.setFocus(Qt.FocusReason.TabFocusReason)
        for key, wanted in (("PageDown", bar.pageStep()), ("End", bar.maximum()), ("Home", 0)):
            QTest.keyClick(start, getattr(Qt.Key, f"Key_{key}"))
            assert bar.value() == wanted > 0 or key == "Home"
    assert bar.value() == 0


@pytest.mark.slow
@pytest.mark.own_window
def test_the_page_is_reached_by_tab_from_begin_to_the_last_group(window: MainWindow, page: StartPage) -> None:
    page.begin_button.setFocus(Qt.FocusReason.TabFocusReason)
    reached = [QApplication.focusWidget()]
    for _ in range(40):
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
        reached.append(QApplication.focusWidget())
    wanted = [page.begin_button, page.open_button, page.guide_button, page.keys_button, page.always_box]
    assert [each for each in wanted if each not in reached] == []
    groups = {card.parentWidget(): card for card in reversed(page.cards.cards)}
    assert [card.entry.name for card in groups.values() if card not in reached] == []


@pytest.mark.slow
def test_the_left_column_is_not_cut_while_presenting(window: MainWindow, page: StartPage) -> None:
    button, column = page.begin_button, page.begin_button.parentWidget()
    window.presenter.arrange()
    for width in (900, 1920):
        window.resize(width, 1080)
        QApplication.processEvents()
        side = button.mapTo(page, button.rect().topRight()).x()
        assert side < page.cards.mapTo(page, page.cards.rect().topLeft()).x()
        assert button.width() >= button.sizeHint().width()
        assert column.width() <= column.parentWidget().width()


@pytest.mark.slow
@pytest.mark.own_window
def test_reading_and_drawing_wait_until_the_page_is_painted(window: MainWindow, qtbot: QtBot) -> None:
    window.pages.show_page("start")
    page = window.pages.current
    assert page.is_drawing
    assert not page.lessons.job.is_running
    qtbot.waitUntil(lambda: page.lessons.place is not None and not page.is_drawing, timeout=20000)
