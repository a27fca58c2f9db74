import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from tests.widgets.showing import shown
from widgets.basics.key_pages import KeyEntry, KeyHelp

KEYS = [
    KeyEntry("Stepping", "Left, Right", "Step back, forward"),
    KeyEntry("Stepping", "Space", "Play or pause"),
    KeyEntry("Pixel", "Ctrl+G", "Go to a pixel"),
]


@pytest.fixture
def page(qtbot) -> KeyHelp:
    result = KeyHelp()
    result.show_keys(KEYS)
    return shown(qtbot, result, 900, 400)


def shown_texts(page: KeyHelp) -> list[str]:
    return [label.text() for label in page._scroll.widget().findChildren(QLabel)]


def test_every_key_of_the_table_is_shown_under_its_group(page) -> None:
    texts = shown_texts(page)
    for text in ("Stepping", "Left", "Right", "Space", "Play or pause", "Pixel", "Ctrl+G", "Go to a pixel"):
        assert text in texts
    assert texts.count("Stepping") == 1


def test_typing_narrows_the_page(qtbot, page) -> None:
    assert page.search.hasFocus()
    qtbot.keyClicks(page.search, "pixel go")
    assert page.shown_entries() == (KEYS[2],)
    assert "Space" not in shown_texts(page)
    qtbot.keyClicks(page.search, "zzz")
    assert page.none_found.isVisible()


def test_escape_clears_then_closes(qtbot, page) -> None:
    seen = []
    page.closed.connect(lambda: seen.append("closed"))
    qtbot.keyClicks(page.search, "x")
    qtbot.keyClick(page.search, Qt.Key.Key_Escape)
    assert page.search.text() == ""
    assert seen == []
    qtbot.keyClick(page.search, Qt.Key.Key_Escape)
    qtbot.mouseClick(page.close_button, Qt.MouseButton.LeftButton)
    assert seen == ["closed", "closed"]


def test_columns_follow_the_width(page) -> None:
    assert page._columns == 2
    page.resize(400, 400)
    assert page._columns == 1


def test_the_table_is_there_only_while_the_page_is_open(qtbot) -> None:
    page = KeyHelp()
    qtbot.addWidget(page)
    page.show_keys(KEYS)
    page.search.setText("pixel")
    assert page._scroll.widget() is None
    page.show()
    qtbot.waitExposed(page)
    assert "Go to a pixel" in shown_texts(page)
    assert "Space" not in shown_texts(page)
    page.hide()
    assert page._scroll.widget() is None
    page.show_keys(KEYS[:2])
    page.search.clear()
    page.show()
    assert "Space" in shown_texts(page)
    assert "Go to a pixel" not in shown_texts(page)


def test_many_keys_of_one_entry_leave_room_for_what_they_do(page) -> None:
    many = "Shift+Left, Shift+Right, Shift+Up, Shift+Down"
    page.show_keys([*KEYS, KeyEntry("Pixel", many, "In the texture: read the next texel")])
    page.resize(380, 400)
    labels = {label.text(): label for label in page._scroll.widget().findChildren(QLabel)}
    page.grab()
    text, cap = labels["In the texture: read the next texel"], labels["Shift+Down"]
    right = cap.mapTo(page, cap.rect().topRight()).x()
    assert right < text.mapTo(page, text.rect().topLeft()).x()
    assert text.width() > 140
    assert cap.parentWidget().height() >= cap.geometry().bottom()


def test_keys_are_shown_whole(qtbot) -> None:
    page = KeyHelp()
    qtbot.addWidget(page)
    page.setStyleSheet('QLabel[role="key"] { padding: 1px 12px; }')
    page.show_keys([KeyEntry("View", "Ctrl+Shift+P", "Presenter")])
    page.resize(900, 300)
    page.show()
    cap = next(label for label in page.findChildren(QLabel) if label.text() == "Ctrl+Shift+P")
    qtbot.waitUntil(cap.isVisible)
    assert cap.x() + cap.sizeHint().width() <= cap.parentWidget().width()
