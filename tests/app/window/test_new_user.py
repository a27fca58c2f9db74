"""Sixty steps of a new user, by intent: what is pressed or clicked is found by its name, never by its place."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtPrintSupport import QPrintPreviewDialog
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QComboBox,
    QFileDialog,
    QLineEdit,
    QTabBar,
    QTextBrowser,
    QWidget,
)
from pytestqt.qtbot import QtBot

from app.files.save_dialog import SaveDialog
from app.session.document import Document
from app.window.main_window import MainWindow
from core import ClipScene
from core.records.steps import Level
from widgets.basics.theme import current_theme

Kind = TypeVar("Kind", bound=QWidget)
LEFT = Qt.MouseButton.LeftButton
OFFSCREEN = "This plugin does not support "
"""What Qt says of a platform without a screen."""
SIDE = 21
"""Vertices along each side of the user's own mesh, a hill of 800 triangles."""


class NewUser:
    """Somebody at the window: has keys, a mouse and eyes, and counts the steps."""

    def __init__(self, window: MainWindow, qtbot: QtBot, capfd: pytest.CaptureFixture[str]) -> None:
        self.window, self.page, self.session = window, window.page, window.session
        self.steps = 0
        self._qtbot, self._capfd = qtbot, capfd

    def does(self, intent: str, act: Callable[[], None], holds: Callable[[], object]) -> None:
        """Do one step; then what it is for must be true, the step be in words, and nothing have gone wrong."""
        act()
        self.steps += 1
        files, comparing = self.window.files, self.page.comparing
        self._qtbot.waitUntil(lambda: not (files.job.is_running or comparing.is_searching))
        self.page.settle()
        QApplication.processEvents()
        said = f"step {self.steps}: {intent}"
        assert holds(), (said, self.window.statusBar().currentMessage(), self.session.cursor)
        assert self.page.sentence.text().strip(), said
        assert self.session.cursor.position <= self.session.stage_trace.steps.count, said
        lines = self._capfd.readouterr().err.splitlines()
        assert [line for line in lines if not line.startswith(OFFSCREEN)] == [], said

    def find(self, kind: type[Kind], name: str) -> Kind:
        """Return the widget in sight that is called so, by what a screen reader says or by what it writes."""
        found = []
        for widget in self.window.findChildren(kind):
            written = widget.text() if isinstance(widget, QAbstractButton) else ""
            if widget.isVisible() and name in (widget.accessibleName(), written):
                found.append(widget)
        assert found, (kind.__name__, name)
        return found[0]

    def press(self, keys: str) -> None:
        """Press a key where the focus is."""
        QTest.keySequence(self.window.focusWidget() or self.window, QKeySequence(keys))

    def click(self, name: str) -> None:
        """Click a button."""
        QTest.mouseClick(self.find(QAbstractButton, name), LEFT)

    def click_tab(self, title: str) -> None:
        """Click the tab in sight that is called so."""
        for bar in self.window.findChildren(QTabBar):
            titles = [bar.tabText(index) for index in range(bar.count())]
            if bar.isVisible() and title in titles:
                QTest.mouseClick(bar, LEFT, pos=bar.tabRect(titles.index(title)).center())
                return
        raise AssertionError(title)

    def click_pixel(self, column: int, row: int) -> None:
        """Click a pixel of the grid."""
        QTest.mouseClick(
            self.page.grid, LEFT, pos=self.page.grid.placement().cells_rect(column, row).center().toPoint()
        )

    def click_link(self, text: str) -> None:
        """Click a link of the Help page."""
        page = self.find(QTextBrowser, "Help page")
        cursor = page.document().find(text)
        while not cursor.isNull() and not cursor.charFormat().isAnchor():
            cursor = page.document().find(text, cursor)
        assert not cursor.isNull(), text
        page.setTextCursor(cursor)
        page.ensureCursorVisible()
        QTest.mouseClick(page.viewport(), LEFT, pos=page.cursorRect(cursor).center() - QPoint(6, 0))

    def click_number(self, symbol: str) -> None:
        """Click the number of a symbol of the formula."""
        view = self.page.formula
        self._qtbot.waitUntil(lambda: bool(self._places(symbol)))
        QTest.mouseMove(view, self._places(symbol)[0])
        QTest.mouseClick(view, LEFT, pos=self._places(symbol)[0])

    def _places(self, symbol: str) -> list[QPoint]:
        view, found = self.page.formula, []
        self.page.settle()
        for y in range(view.height() - 1, 0, -5):
            for x in range(0, view.width(), 4):
                number = view.number_under(QPointF(x, y))
                if number is not None and number.symbol.replace("_", "") == symbol:
                    found.append(QPoint(x, y))
        return found

    def type_into(self, name: str, text: str) -> None:
        """Type a value into a field and confirm it."""
        field = self.find(QLineEdit, name)
        field.setFocus()
        field.selectAll()
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)

    def choose(self, name: str, title: str) -> None:
        """Open a list by the mouse and choose from it by the keyboard."""
        box = self.find(QComboBox, name)
        QTest.mouseClick(box, LEFT)
        for _ in range(box.count()):
            if box.view().currentIndex().data().startswith(title):
                break
            QTest.keyClick(box.view(), Qt.Key.Key_Down)
        QTest.keyClick(box.view(), Qt.Key.Key_Return)
        assert box.currentText().startswith(title)
        self.window.activateWindow()  # a platform without a screen does not do so after a list
        self._qtbot.waitUntil(self.window.isActiveWindow)

    def drag_vertex(self, by: QPoint) -> None:
        """Drag the first vertex of the triangle in the grid."""
        grid, geometry = self.page.grid, self.page.grids.geometry
        vertex = int(geometry.triangles[geometry.focus][0])
        start = grid.placement().to_widget(*geometry.vertices[vertex])
        assert start is not None
        QTest.mousePress(grid, LEFT, pos=start.toPoint())
        for share in (0.5, 1.0):
            QTest.mouseMove(grid, start.toPoint() + by * share)
        QTest.mouseRelease(grid, LEFT, pos=start.toPoint() + by)

    # What is seen.

    @property
    def stage(self) -> str:
        """The stage on screen."""
        return self.session.cursor.stage

    @property
    def position(self) -> int:
        """The step just done."""
        return self.session.cursor.position

    @property
    def view(self) -> str:
        """The main view."""
        return self.page.current_view()

    def corner(self) -> list[float]:
        """Return x and y of the first corner in clip space."""
        scene = self.session.document.scene
        assert isinstance(scene, ClipScene)
        return np.asarray(scene.clip).reshape(-1)[:2].tolist()

    def at(self) -> tuple[str, int]:
        """Return stage and step."""
        return self.stage, self.position

    def end(self) -> int:
        """Return the last step of the stage."""
        return self.session.stage_trace.steps.count

    def document(self) -> Document:
        """Return what is open."""
        return self.session.document

    def help_address(self) -> str:
        """Return which page Help shows."""
        return self.window.help.view.address()

    def covered(self) -> int:
        """Return how many pixels the grid shows as covered."""
        buffer = self.page.grid.buffer()
        assert buffer is not None
        return int(np.count_nonzero(buffer.values))

    def help_text(self) -> str:
        """Return what the Help page says."""
        return self.find(QTextBrowser, "Help page").toPlainText()

    def is_shown(self, name: str) -> bool:
        """Whether a widget in sight is called so."""
        return any(w.isVisible() and w.accessibleName() == name for w in self.window.findChildren(QWidget))

    @property
    def message(self) -> str:
        """The hint beside the names of the pages."""
        return self.window.statusBar().currentMessage()


@pytest.fixture
def user(
    window: MainWindow,
    qtbot: QtBot,
    capfd: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> NewUser:
    """Return a user in front of the start page, for whom the system's dialogs choose files of a folder."""
    mesh = tmp_path / "hill.obj"
    places = [(x / 10 - 1, y / 10 - 1) for y in range(SIDE) for x in range(SIDE)]
    corners = [row * SIDE + column + 1 for row in range(SIDE - 1) for column in range(SIDE - 1)]
    rows = [f"v {x} {y} {1 - x * x - y * y}" for x, y in places]
    rows += [f"f {k} {k + 1} {k + 1 + SIDE} {k + SIDE}" for k in corners]
    mesh.write_text("\n".join(rows))
    chosen = iter([mesh, tmp_path / "mine.rasterscope"])
    saved = iter([tmp_path / "mine.rasterscope", tmp_path / "view.png"])
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *args: (str(next(chosen)), ""))
    monkeypatch.setattr(SaveDialog, "ask", lambda dialog: str(next(saved)))
    monkeypatch.setattr(QPrintPreviewDialog, "exec", lambda dialog: 1)
    window.run_action("page_start")
    QApplication.processEvents()
    capfd.readouterr()
    return NewUser(window, qtbot, capfd)


def walk_the_run(user: NewUser) -> None:
    """From the start page through the stages to the last byte."""
    user.does(
        "begin",
        lambda: user.click("Begin with one triangle"),
        lambda: user.window.pages.current_name == "step",
    )
    user.does("see the start", lambda: user.press("1"), lambda: user.at() == ("transform", 0))
    user.does("do a step", lambda: user.press("Right"), lambda: user.position > 0 and user.view == "scene")
    user.does("take it back", lambda: user.press("Left"), lambda: user.position == 0)
    user.does(
        "step by stages",
        lambda: user.click("Step by stage"),
        lambda: user.session.cursor.level == Level.STAGE,
    )
    user.does("do a stage", lambda: user.press("Right"), lambda: user.at() == ("transform", user.end()))
    user.does("enter the next", lambda: user.press("Right"), lambda: user.at() == ("cull", 0))
    user.does("do it", lambda: user.press("Right"), lambda: user.at() == ("cull", user.end()))
    user.does(
        "go on to clip", lambda: user.press("Right"), lambda: user.at() == ("clip", 0) and user.view == "clip"
    )
    user.does(
        "enter raster by its card", lambda: user.click("Stage Raster"), lambda: user.at() == ("raster", 0)
    )
    user.does("go on by pixels", lambda: user.click("Step by pixel"), lambda: user.view == "pixels")
    user.does("test a pixel", lambda: user.press("Right"), lambda: "Pixel" in user.page.sentence.text())
    user.does("see no future", lambda: user.press("Right"), lambda: user.covered() <= 2)
    user.does(
        "enter the last stage", lambda: user.click("Stage Resolve"), lambda: user.at() == ("resolve", 0)
    )
    user.does("do all of it", lambda: user.press("End"), lambda: user.position == user.end())
    user.does(
        "press on", lambda: user.press("Right"), lambda: user.message and user.at() == ("resolve", user.end())
    )


def ask_numbers(user: NewUser) -> None:
    """Where numbers come from, and what a pixel went through."""
    click, press = user.click, user.press
    user.does(
        "enter raster by its digit", lambda: press("6"), lambda: (user.stage, user.position) == ("raster", 0)
    )
    user.does("go to a pixel's test", lambda: press("Right"), lambda: user.page.formula.spoken())
    before = user.session.cursor
    user.does(
        "follow E0", lambda: user.click_number("E0"), lambda: user.session.cursor != before and user.message
    )
    user.does("follow its a0", lambda: user.click_number("a0"), lambda: user.stage == "edges")
    user.does("come back", lambda: press("Ctrl+["), lambda: user.stage == "raster")
    user.does("come back further", lambda: press("Ctrl+["), lambda: user.session.cursor == before)
    user.does("click a pixel", lambda: user.click_pixel(27, 20), lambda: user.session.pin == (27, 20))
    user.does(
        "read why", lambda: user.click_tab("Pixel history"), lambda: "0" in user.page.history.verdict.text()
    )
    user.does("go to its step", lambda: press("J"), lambda: "(27, 20)" in user.page.sentence.text())
    user.does(
        "see the variables", lambda: user.click_tab("Variables"), lambda: user.page.variables.isVisible()
    )
    user.does("ask for the pinned value", lambda: press("Y"), lambda: user.message)
    user.does("unpin", lambda: press("Escape"), lambda: user.session.pin is None)
    user.does(
        "predict from the start", lambda: [press("6"), press("P")], lambda: user.page.prediction.isVisible()
    )
    user.does(
        "guess right",
        lambda: user.click_pixel(27, 20),
        lambda: "Right" in user.page.prediction.verdict.text(),
    )
    user.does(
        "guess wrong", lambda: user.click_pixel(2, 40), lambda: "Wrong" in user.page.prediction.verdict.text()
    )
    user.does("reveal", lambda: click("Reveal"), lambda: user.page.prediction.verdict.text())
    user.does("stop predicting", lambda: press("P"), lambda: not user.page.prediction.isVisible())


def learn(user: NewUser) -> None:
    """The guide, the glossary and a method's page."""
    user.does("look for keys", lambda: user.press("?"), lambda: user.window.overlays.key_help.isVisible())
    user.does(
        "close them", lambda: user.press("Escape"), lambda: not user.window.overlays.key_help.isVisible()
    )
    user.does(
        "open the guide",
        lambda: [user.press("Alt+0"), user.click("Five-minute guide")],
        lambda: user.help_address() == "guide",
    )
    user.does(
        "open its triangle",
        lambda: user.click_link("Open the triangle"),
        lambda: user.window.pages.current_name == "step",
    )
    user.does("go to its stage", lambda: user.click_link("Interpolate"), lambda: user.stage == "interpolate")
    user.does(
        "look a word up", lambda: user.click_link("fragments"), lambda: user.help_address() == "term/fragment"
    )
    user.does(
        "find a method",
        lambda: user.type_into("Find in Help", "affine"),
        lambda: "Affine" in user.help_text(),
    )
    user.does(
        "open its page",
        lambda: user.click_link("Affine (screen-linear)"),
        lambda: user.help_address() == "method/interpolation/affine",
    )
    user.does(
        "read its source",
        lambda: None,
        lambda: "Source" in user.help_text() and "Breaks where" in user.help_text(),
    )
    user.does("close Help", lambda: user.press("F1"), lambda: not user.window.help.is_visible())


def change(user: NewUser) -> None:
    """Methods, A | B, corners."""
    user.does("open Methods", lambda: user.click("Methods"), lambda: user.is_shown("Fill"))
    fill = user.document().settings.fill
    user.does(
        "fill by blocks",
        lambda: user.choose("Fill", "Blocks"),
        lambda: user.document().settings.fill == "blocks",
    )
    user.does("take it back", lambda: user.press("Ctrl+Z"), lambda: user.document().settings.fill == fill)
    user.does("compare", lambda: user.click_tab("A | B"), lambda: user.view == "compare")
    user.does("part ways", lambda: user.click("First divergence"), lambda: user.message)
    user.does("see the pixels", lambda: user.click_tab("Pixels"), lambda: user.view == "pixels")
    before = user.corner()
    user.does("drag a corner", lambda: user.drag_vertex(QPoint(20, -20)), lambda: user.corner() != before)
    user.does("take it back", lambda: user.press("Ctrl+Z"), lambda: user.corner() == before)
    user.does("open Scene", lambda: user.click("Scene"), lambda: user.is_shown("vertex 0 x"))
    user.does("type a corner", lambda: user.type_into("vertex 0 x", "12.5"), lambda: user.corner() != before)


def open_and_keep(user: NewUser) -> None:
    """A mesh of one's own, into a triangle and back; files, type and light."""
    press = user.press
    text = current_theme().text_px
    user.does(
        "open a mesh",
        lambda: press("Ctrl+O"),
        lambda: "hill" in user.window.windowTitle() and user.view == "scene",
    )
    user.does("go into a triangle", lambda: press("F"), lambda: user.document().triangle is not None)
    user.does("see its pixels", lambda: user.click_tab("Pixels"), lambda: user.page.navigator.isVisible())
    user.does("come back", lambda: press("Shift+F"), lambda: user.view == "scene")
    user.does("save", lambda: press("Ctrl+S"), lambda: "mine.rasterscope" in user.message)
    user.does(
        "start anew",
        lambda: [press("Alt+0"), user.click("Segment")],
        lambda: user.document().scene.corner_count == 2,
    )
    user.does("open what was saved", lambda: press("Ctrl+O"), lambda: user.document().scene.corner_count == 3)
    user.does("export", lambda: press("Ctrl+E"), lambda: "Exported view.png" in user.message)
    user.does("look at the print", lambda: press("Ctrl+P"), lambda: True)
    user.does("larger text", lambda: press("Ctrl++"), lambda: current_theme().text_px > text)
    user.does("smaller again", lambda: press("Ctrl+-"), lambda: current_theme().text_px == text)
    user.does("go dark", lambda: press("Ctrl+T"), lambda: current_theme().name == "dark")
    user.does("and light", lambda: press("Ctrl+T"), lambda: current_theme().name == "light")


def test_the_first_run(user: NewUser) -> None:
    walk_the_run(user)


@pytest.mark.slow
def test_sixty_steps(user: NewUser) -> None:
    for part in (walk_the_run, ask_numbers, learn, change, open_and_keep):
        part(user)
    assert user.steps >= 60
