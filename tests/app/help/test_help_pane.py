"""The pane of Help in a window: keys, links that do something, and words on screen that lead to their entries."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAction, QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu, QTabBar, QWidget
from pytestqt.qtbot import QtBot

from app.help import pane
from app.window.main_window import MainWindow

pytestmark = pytest.mark.shared_window


@pytest.fixture(autouse=True)
def pointer_outside(monkeypatch: pytest.MonkeyPatch) -> None:
    """Point at no widget, wherever the pointer is."""
    monkeypatch.setattr(pane.QApplication, "widgetAt", lambda point: None)


@pytest.mark.own_window
def test_f1_opens_the_contents_and_escape_closes_them(window: MainWindow) -> None:
    window.page.grid.setAccessibleName("")
    window.page.grid.setFocus()
    assert window.help.dock is None
    QTest.keyClick(window, Qt.Key.Key_F1)
    view = window.help.view
    assert (view.address(), view.search.hasFocus()) == ("home", True)
    assert "Five-minute guide" in view.browser.toPlainText()
    QTest.keyClick(view.search, Qt.Key.Key_Escape)
    assert not window.help.is_visible()


def test_f1_explains_what_has_the_keyboard(window: MainWindow) -> None:
    window.page.timeline.setFocus()
    window.focusWidget().setProperty("accessibleName", "Edge functions")
    window.focusWidget().setToolTip("")
    QTest.keyClick(window, Qt.Key.Key_F1)
    assert window.help.view.address().endswith("edge-function")


def test_f1_on_a_choice_of_methods_explains_the_method(window: MainWindow) -> None:
    window.page.show_panes(["methods"])
    QApplication.processEvents()
    combo = window.page.settings_panel.combo("shading")
    window.session.set_setting("shading", "flat")
    combo.setEnabled(True)
    combo.setFocus()
    QTest.keyClick(window, Qt.Key.Key_F1)
    assert window.help.view.address() == "method/shading/flat"


def test_return_opens_the_first_result(window: MainWindow, qtbot: QtBot) -> None:
    window.help.show_page("home")
    search = window.help.view.search
    QTest.keyClicks(search, "no such word")
    QTest.keyClick(search, Qt.Key.Key_Return)
    assert window.help.view.address() == "home"
    search.clear()
    QTest.keyClicks(search, "wu two")
    QTest.keyClick(search, Qt.Key.Key_Return)
    assert window.help.view.address() == "method/line/wu"
    search.clear()
    QTest.keyClicks(search, "pixels of the vertices")
    QTest.keyClick(search, Qt.Key.Key_Return)
    page = window.pages.current
    qtbot.waitUntil(lambda: page.question is not None and page.question.template.name == "vertex-pixels")
    search.clear()


def test_typing_finds_and_a_link_shows_the_entry_with_a_way_back(window: MainWindow) -> None:
    window.help.show_page("guide")
    view = window.help.view
    QTest.keyClicks(view.search, "z-fighting")
    assert "Two surfaces lie closer" in view.browser.toPlainText()
    view.show_page("term/z-fighting")
    assert view.browser.documentTitle() == "Z-fighting"
    view.back_button.click()
    assert view.address() == "guide"


@pytest.mark.parametrize(
    ("link", "reached"),
    [
        ("stage/depth", lambda window: window.session.cursor.stage == "depth"),
        ("use/fill/scanline", lambda window: window.session.document.settings.fill == "scanline"),
        ("view/clip", lambda window: window.page.current_view() == "clip"),
        ("action/page_compare", lambda window: window.pages.current_name == "compare"),
        ("compare/fill", lambda window: window.pages.current.choice.name == "fill"),
        ("stability/slivers", lambda window: window.pages.current.choice.name == "slivers"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_links_do_something_in_the_window(window: MainWindow, link: str, reached) -> None:
    window.help.follow(link)
    assert reached(window)


def test_the_guide_opens_its_scenes(window: MainWindow, qtbot: QtBot) -> None:
    window.pages.show_page("compare")
    window.help.follow("scene/z-fighting")
    qtbot.waitUntil(lambda: window.session.document.title == "Z-fighting plates")
    assert window.pages.current_name == "step"


def test_a_word_of_the_stage_card_a_variable_and_a_method_lead_to_their_pages(window: MainWindow) -> None:
    card, view = window.page.card, window.help.view
    card.show_folded(False)
    assert '<a style="color' in card.findChild(type(window.page.sentence), "purpose").text()
    card.link_chosen.emit("help:term/pixel")
    assert view.address() == "term/pixel"
    window.page.variables.setCurrentItem(window.page.variables.topLevelItem(0))
    action = next(a for a in window.page.variables.actions() if a.text() == "What is this?")
    action.trigger()
    assert view.address().startswith("variable/")
    assert window.page.variables.topLevelItem(0).text(0) == view.browser.documentTitle()
    window.page.settings_panel.reference_requested.emit("shading", "gouraud")
    assert view.browser.documentTitle() == "Gouraud (per vertex)"
    window.page.settings_panel.reference_requested.emit("block_size", "8")
    assert view.address() == "family/fill"


def test_the_pages_of_results_lead_to_the_reference_of_their_methods(window: MainWindow) -> None:
    window.help.follow("compare/depth")
    window.pages.current.reference_button.click()
    assert window.help.view.address() == "family/depth"
    window.help.follow("compare/pipeline")
    window.pages.current.reference_button.click()
    assert window.help.view.address() == "methods"
    window.help.follow("stability/z-fighting-range")
    window.pages.current.reference_button.click()
    assert window.help.view.address() == "family/depth"


def open_menu(window: MainWindow, widget: QWidget, point: QPoint) -> list[QAction]:
    """Click with the right button; return the entries of the menu."""
    place = widget.mapToGlobal(point)
    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, point, place)
    QApplication.sendEvent(widget, event)
    menu = QApplication.activePopupWidget()
    return menu.actions() if isinstance(menu, QMenu) else []


def test_a_right_click_on_a_text_asks_what_its_terms_are(window: MainWindow) -> None:
    window.page.sentence.setText("Pixel (3, 2) is covered.")
    entries = open_menu(window, window.page.sentence, QPoint(4, 4))
    assert [entry.text() for entry in entries] == ["What is “pixel”?", "What is “coverage”?", "", "Copy"]
    entries[-1].trigger()
    assert QApplication.clipboard().text() == "Pixel (3, 2) is covered."
    entries[1].trigger()
    assert window.help.view.browser.documentTitle() == "Coverage"
    QApplication.activePopupWidget().close()
    bar, index = next(
        (bar, k)
        for bar in window.page.findChildren(QTabBar)
        for k in range(bar.count())
        if bar.tabText(k) == "Clip space"
    )
    entries = open_menu(window, bar, bar.tabRect(index).center())
    assert entries[0].text() == "What is “clip space”?"
    QApplication.activePopupWidget().close()


def test_presenting_puts_help_aside_and_brings_it_back(window: MainWindow) -> None:
    window.help.show_page("term/pixel")
    window.presenter.presenting_changed.emit(True)
    assert not window.help.is_visible()
    window.presenter.presenting_changed.emit(False)
    assert window.help.is_visible()
    window.help.close()
    window.presenter.presenting_changed.emit(True)
    window.presenter.presenting_changed.emit(False)
    assert not window.help.is_visible()


def test_return_in_the_search_leads_to_a_page_and_does_nothing_else(window: MainWindow) -> None:
    window.help.show_page("home")
    search = window.help.view.search
    for text in ("presenter", "pixel", "nothing of this"):
        search.setText(text)
        QTest.keyClick(search, Qt.Key.Key_Return)
        assert window.help.is_visible()
        assert not window.presenter.is_presenting
