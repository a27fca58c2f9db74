"""Nine questions of a student, answered from the start page by a few keys and clicks each."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QAbstractButton, QApplication, QLabel, QScrollArea
from pytestqt.qtbot import QtBot

from app.window.main_window import MainWindow
from tests.app.window.new_user import NewUser
from widgets.inspector.pixel_history import ENTRY_ROLE

pytestmark = pytest.mark.shared_window
MOST_ACTIONS = 6
"""Keys, clicks and numbers that an answer may take; turning the wheel to a scene counts as one."""
Script = list[tuple[str | int, ...]]
"""Actions: the name of what somebody at the window does, then what with."""
CLICKED = "click_pixel"
QUESTIONS: dict[str, tuple[Script, list[str]]] = {
    "why is this pixel not covered": (
        [("open", "Single triangle"), (CLICKED, 40, 40)],
        [
            "No triangle covers this pixel. The nearest is triangle 0: the pixel centre is 9.775 px beyond edge 0."
        ],
    ),
    "who owns the shared edge": (
        [("open", "Two triangles sharing an edge")],
        [
            "Pixel (30, 24) is covered by triangle 1: its centre lies exactly on edge 2, "
            "which the triangle owns because it is a left edge."
        ],
    ),
    "Bresenham's decision at column 6": (
        [("open", "Segment"), (CLICKED, 6, 3), ("press", "J")],
        ["D is −10, below 0, so y stays."],
    ),
    "affine against perspective at one pixel": (
        [("open", "Attributes in perspective"), ("click_tab", "A | B")],
        [
            "Pixel (32, 18) of triangle 0: corners 0, 1 and 2 have weights 0.4882, 0.2886 and 0.2231",
            "Pixel (32, 18) of triangle 0: corners 0, 1 and 2 have weights 0.3992, 0.236 and 0.3649",
        ],
    ),
    "w < 0": (
        [("open", "Near-plane crosser"), ("press", "Right")],
        [
            "its NDC z is 1.798, clip z = −2.469 divided by w = −1.373; "
            "as w is below 0 it lies behind the eye, and the division mirrors it."
        ],
    ),
    "the weights at a pixel of a triangle of one's own": (
        [
            ("open", "Single triangle"),
            ("click", "Scene"),
            ("type_into", "vertex 0 x", "12.5"),
            (CLICKED, 30, 20),
        ],
        [
            "Weights 0.5022, 0.3179 and 0.1798 after the division by w (in the window 0.3515, 0.3338 and 0.3147)."
        ],
    ),
    "who wins in the z-buffer": (
        [("open", "Intersecting triangles"), (CLICKED, 30, 22)],
        [
            "Triangle 0 is visible here; 1 fragment rejected.",
            "Failed the depth test: 0.5439 is not nearer than triangle 0 (0.5076).",
        ],
    ),
    "the scanline in row 5": (
        [("open", "Scanline fill"), (CLICKED, 5, 5), ("press", "J")],
        [
            "Pixel (5, 5) is covered by triangle 0 without a test of its own: "
            "it is in the span of row 5, columns 3 to 7."
        ],
    ),
    "the cheapest methods for the teapot": (
        [("open", "Teapot"), ("press", "Alt+4"), ("click", "Analyse")],
        ["Within the tolerance, ", "times as fast as the reference settings: ", "Drawing both faces: kept."],
    ),
}

EVERYDAY = (
    "why is this pixel not covered",
    "affine against perspective at one pixel",
    "the weights at a pixel of a triangle of one's own",
    "who wins in the z-buffer",
)


@pytest.fixture
def user(window: MainWindow, qtbot: QtBot, capfd: pytest.CaptureFixture[str]) -> NewUser:
    """Return somebody in front of the start page."""
    window.run_action("page_start")
    for area in window.pages.current.findChildren(QScrollArea):
        area.verticalScrollBar().setValue(0)
    QApplication.processEvents()
    capfd.readouterr()
    return NewUser(window, qtbot, capfd)


def is_whole(widget: QLabel | QAbstractButton) -> bool:
    """Return whether nothing of a widget is hidden or scrolled away."""
    return widget.visibleRegion().boundingRect() == widget.rect()


def turn_wheel(user: NewUser, card: QAbstractButton) -> None:
    """Turn the wheel over the scenes until a card is in sight."""
    area = next(area for area in user.window.findChildren(QScrollArea) if area.isAncestorOf(card))
    middle = QPointF(area.viewport().rect().center())
    for _ in range(60):
        if is_whole(card):
            return
        turned = QWheelEvent(
            middle,
            area.viewport().mapToGlobal(middle),
            QPoint(),
            QPoint(0, -120),
            Qt.MouseButton.NoButton,
            Qt.KeyboardModifier.NoModifier,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(area.viewport(), turned)
        QApplication.processEvents()
    raise AssertionError(card.accessibleName())


def follow(user: NewUser, script: Script) -> int:
    """Do what a script says, and return how many actions that took."""
    count = len(script)
    for name, *what in script:
        if name == "open":
            card = user.find(QAbstractButton, str(what[0]))
            if not is_whole(card):
                turn_wheel(user, card)
                count += 1
            name = "click"
        user.does(str(name), lambda name=name, what=what: getattr(user, str(name))(*what), lambda: True)
    return count


def seen(user: NewUser) -> str:
    """Return the texts that are wholly in sight: of labels, and of the rows of a pixel's history."""
    texts = [
        label.text() for label in user.window.findChildren(QLabel) if label.isVisible() and is_whole(label)
    ]
    rows = user.page.history.view
    if rows.isVisible():
        for row in range(rows.model().rowCount()):
            index = rows.model().index(row, 0)
            if rows.viewport().rect().contains(rows.visualRect(index)):
                texts.append(index.data(ENTRY_ROLE).reason)
    return "\n".join(texts)


@pytest.mark.parametrize(
    "question",
    [name if name in EVERYDAY else pytest.param(name, marks=pytest.mark.slow) for name in QUESTIONS],
)
def test_a_question_is_answered_in_a_few_actions(question: str, user: NewUser, qtbot: QtBot) -> None:
    script, answers = QUESTIONS[question]
    assert follow(user, script) <= MOST_ACTIONS
    qtbot.waitUntil(lambda: all(answer in seen(user) for answer in answers), timeout=300_000)


def test_a_click_on_the_pixel_that_a_scene_opens_at_shows_its_history(user: NewUser) -> None:
    follow(user, [("open", "Two triangles sharing an edge"), (CLICKED, 30, 24)])
    assert "The pixel centre is exactly on edge 1, which the triangle does not own" in seen(user)
    follow(user, [("press", "Alt+0"), ("open", "Self-crossing polygon")])
    said = "Row 12 is outside from x = 11.78 to 20.22, since the number of edges to the left, 2, is even."
    assert said in seen(user)
