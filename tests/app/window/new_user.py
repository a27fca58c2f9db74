"""Somebody at the window, for scripts by intent: what is clicked is found by its name, never by its place."""

from collections.abc import Callable
from typing import TypeVar

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QComboBox,
    QLineEdit,
    QTabBar,
    QTextBrowser,
    QWidget,
)
from pytestqt.qtbot import QtBot

from app.session.document import Document
from app.window.main_window import MainWindow

Kind = TypeVar("Kind", bound=QWidget)
LEFT = Qt.MouseButton.LeftButton
OFFSCREEN = "This plugin does not support "
"""What Qt says of a platform without a screen."""


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
        self._qtbot.waitUntil(lambda: not (files.job.is_running or comparing.meeting.is_searching))
        self.page.settle()
        QApplication.processEvents()
        said = f"step {self.steps}: {intent}"
        assert holds(), (said, self.window.statusBar().currentMessage(), self.session.cursor)
        assert self.page.sentence.text().strip(), said
        assert self.session.cursor.position <= self.session.stage_trace.steps.count, said
        lines = self._capfd.readouterr().err.splitlines()
        assert [line for line in lines if not line.startswith(OFFSCREEN)] == [], said

    def find(self, kind: type[Kind], name: str) -> Kind:
        """Return the widget that is called so, by what a screen reader says or what it writes, once it is in sight."""
        self._qtbot.waitUntil(lambda: bool(self._in_sight(kind, name)))
        return self._in_sight(kind, name)[0]

    def _in_sight(self, kind: type[Kind], name: str) -> list[Kind]:
        found = []
        for widget in self.window.findChildren(kind):
            written = widget.text() if isinstance(widget, QAbstractButton) else ""
            if widget.isVisible() and name in (widget.accessibleName(), written):
                found.append(widget)
        return found

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
