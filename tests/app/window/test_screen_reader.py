"""What a screen reader hears: names that hold the text, roles, descriptions that are current, announcements."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import (
    QAccessible,
    QAccessibleAnnouncementEvent,
    QAccessibleEvent,
    QAccessibleInterface,
    QGuiApplication,
    QTextDocumentFragment,
)
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QLabel, QWidget
from pytestqt.qtbot import QtBot

from app.window.main_window import MainWindow
from tests.lessons.course.lesson_texts import GOOD
from widgets.basics import accessibility
from widgets.basics.message_bar import MessageKind

pytestmark = pytest.mark.shared_window

PAGES = ("start", "step", "compare", "stability", "plan", "exercises")
Heard = list[tuple[str, str]]


@pytest.fixture
def heard(monkeypatch: pytest.MonkeyPatch) -> Iterator[Heard]:
    """Return the announcements from now on: politeness and text; a screen reader is running."""
    texts: Heard = []

    def hear(event: QAccessibleEvent) -> None:
        if isinstance(event, QAccessibleAnnouncementEvent):
            texts.append((event.politeness().name, event.message()))

    monkeypatch.setattr(QAccessible, "updateAccessibility", staticmethod(hear))
    monkeypatch.setattr(accessibility, "NOTICE_PLATFORMS", ())
    QAccessible.setActive(True)
    yield texts
    QAccessible.setActive(False)


def visible_widgets(window: MainWindow, page: str) -> list[QWidget]:
    """Return what can be seen of a window that shows a page."""
    window.run_action(f"page_{page}")
    QApplication.processEvents()
    return [widget for widget in window.findChildren(QWidget) if widget.isVisible()]


def spoken_name(widget: QWidget) -> str:
    """Return the name that a screen reader reads."""
    return QAccessible.queryAccessibleInterface(widget).text(QAccessible.Text.Name)


def description(widget: QWidget) -> str:
    """Return what a screen reader reads after the name."""
    return QAccessible.queryAccessibleInterface(widget).text(QAccessible.Text.Description)


def test_names_hold_the_text_and_views_have_roles(window: MainWindow) -> None:
    """Of all pages: no text is replaced by a name, and nothing that has a name or takes the keyboard is a filler."""
    window.session.set_pin((20, 20))
    window.page.show_panes(["methods", "overlays", "inspector", "thumbnails"])
    silent, fillers = [], []
    for page in PAGES:
        for widget in visible_widgets(window, page):
            name = spoken_name(widget)
            if isinstance(widget, QLabel | QAbstractButton):
                text = QTextDocumentFragment.fromHtml(widget.text().replace("&", "")).toPlainText()
                words = " ".join(re.findall(r"\w{2,}", text)).lower()
                if words not in " ".join(re.findall(r"\w{2,}", name)).lower():
                    silent.append((page, name, text))
            takes_keys = widget.focusPolicy() & Qt.FocusPolicy.TabFocus and widget.focusProxy() is None
            role = QAccessible.queryAccessibleInterface(widget).role()
            is_inside = isinstance(widget.parent(), QWidget) and widget.parent().focusProxy() is widget
            assert role != QAccessible.Role.LayeredPane  # Orca would say so of every stack of pages.
            if (widget.accessibleName() or takes_keys) and role == QAccessible.Role.Client:
                fillers.append((page, type(widget).__name__, name))
            if takes_keys and not name and not is_inside:
                silent.append((page, type(widget).__name__, "no name"))
    assert silent == []
    assert fillers == []


@pytest.mark.slow
def test_every_step_is_announced(window: MainWindow, heard: Heard, qtbot: QtBot) -> None:
    """After a step one hears its sentence, the line of the algorithm and the formula in words."""
    window.run_action("step_forward")
    qtbot.waitUntil(lambda: bool(heard))
    (_, text), page = heard[-1], window.page
    assert page.sentence.text() in text
    assert description(page.formula) in text
    assert "=" not in description(page.formula).replace(" = ", "")
    assert "Line " in text
    assert "Line " in description(page.listing)
    heard.clear()
    window.run_action("level_out")
    qtbot.waitUntil(lambda: any("Step by" in text for _, text in heard))


def test_what_is_shown_of_the_pin_is_current(window: MainWindow, heard: Heard, qtbot: QtBot) -> None:
    """The description of the grid has the value after the step, and moving the pin says the value there."""
    window.session.set_stage("raster", 0)
    window.session.set_pin((20, 20))
    assert description(window.page.grid) == "Pinned pixel 20, 20: no value"
    window.session.set_stage("raster", window.session.stage_trace.steps.count)
    assert description(window.page.grid) == "Pinned pixel 20, 20: 1"
    heard.clear()
    window.run_action("pin_right")
    qtbot.waitUntil(lambda: any("Pinned pixel 21, 20: 1" in text for _, text in heard))


def test_where_orca_listens_each_announcement_is_a_notice_that_appears(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch, heard: Heard, qtbot: QtBot
) -> None:
    """Orca asks for its text a moment later, when others may have appeared."""
    notices: list[QAccessibleInterface] = []

    def hear(event: QAccessibleEvent) -> None:
        if event.type() == QAccessible.Event.ObjectShow:
            notices.append(event.accessibleInterface())

    monkeypatch.setattr(QAccessible, "updateAccessibility", staticmethod(hear))
    monkeypatch.setattr(accessibility, "NOTICE_PLATFORMS", (QGuiApplication.platformName(),))
    for number, texts in enumerate((("First.",), ("Second", "Third."), ("Second.",))):
        for text in texts:
            accessibility.announce(window.page.sentence, text)
        qtbot.waitUntil(lambda count=number: len(notices) > count)
    assert {notice.role() for notice in notices} == {QAccessible.Role.Notification}
    said = [notice.text(QAccessible.Text.Name) for notice in notices]
    assert said == ["First.", "Second. Third.", "Second."]
    assert not heard


def test_messages_are_announced(window: MainWindow, heard: Heard) -> None:
    """A warning interrupts; a hint does not."""
    window.notices.tell("nothing covers this pixel")
    window.notices.tell("the file ends too early.", MessageKind.WARNING)
    assert heard == [
        ("Polite", "Nothing covers this pixel"),
        ("Assertive", "Warning: The file ends too early."),
    ]


def test_a_message_of_the_start_is_said_once_the_window_is_active(
    window: MainWindow, heard: Heard, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A screen reader knows no window before that."""
    monkeypatch.setattr(window.messages, "isActiveWindow", lambda: False)
    window.notices.tell("the last scene is gone.", MessageKind.WARNING)
    heard.clear()
    for _ in range(2):
        QApplication.sendEvent(window.messages, QEvent(QEvent.Type.WindowActivate))
    assert heard == [("Assertive", "Warning: The last scene is gone.")]


def test_the_timeline_is_a_slider(window: MainWindow) -> None:
    """A screen reader reads its position and can set it."""
    QApplication.sendPostedEvents(window, QEvent.Type.LayoutRequest)
    value = QAccessible.queryAccessibleInterface(window.page.timeline.bar).valueInterface()
    assert (value.currentValue(), value.minimumValue()) == (4000, 0)
    assert value.maximumValue() == window.session.stage_trace.steps.count
    value.setCurrentValue(17)
    assert window.session.cursor.position == 17


@pytest.mark.slow
def test_a_question_is_announced_after_the_step_it_follows(
    window: MainWindow, heard: Heard, qtbot: QtBot
) -> None:
    window.session.set_stage("raster", 0)
    window.run_action("predict")
    window.run_action("step_forward")
    page = window.page
    qtbot.waitUntil(lambda: any(text.endswith(page.prediction.question.text()) for _, text in heard))
    page.prediction.choice_buttons[0].click()
    assert page.prediction.verdict.text() in [text for _, text in heard]


def test_a_lesson_is_heard_step_by_step(
    window: MainWindow, qtbot: QtBot, heard: Heard, tmp_path: Path
) -> None:
    """The text of a step, the verdict, and that a task is done: quietly, without what stands in the way of it."""
    path = tmp_path / "heard.toml"
    path.write_text(GOOD, encoding="utf-8")
    window.open_path(str(path))
    lessons = window.page.lessons
    qtbot.waitUntil(lambda: not lessons.is_working)
    heard.clear()
    QTest.keyClick(window, Qt.Key.Key_PageDown)
    qtbot.waitUntil(lambda: not lessons.is_working)
    assert ("Polite", "Whose pixel?, step 2 of 4. How many pixels are drawn here? Predict.") in heard
    assert not any("16" in text for _, text in heard)
    QTest.keyClicks(QApplication.focusWidget(), "25")
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: ("Polite", "That would be right if each edge counted.") in heard)
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClicks(QApplication.focusWidget(), "16")
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Return)
    said = "Right.\nSixteen, and none of them twice. Under the other rule five are."
    qtbot.waitUntil(lambda: ("Polite", said) in heard)
    assert window.focusWidget() is window.page.grid
