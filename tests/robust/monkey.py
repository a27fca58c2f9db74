"""Random keys, clicks, drags, files and pages in a window, from a seed; and how long each held the window up."""

import random
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, QPoint, QPointF, Qt, QTimer
from PySide6.QtGui import QKeySequence, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QWidget
from shiboken6 import isValid

from app.bench.window_script import fixed_work
from app.window.actions import ACTIONS
from app.window.main_window import MainWindow
from lessons.scenes import scene_names

LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
NO_MODIFIER = Qt.KeyboardModifier.NoModifier
NOT_PRESSED = ("quit",)
"""Actions whose keys would end it all."""
LONGEST = 200
"""Times a fixed piece of work, timed at the beginning, for which the window may be held up: about a second."""


@dataclass(frozen=True)
class Stall:
    """A step that held the window up for longer than it may: so many times the fixed work."""

    number: int
    step: str
    times: float


class Monkey(QObject):
    """Does random steps in a window; dialogs are closed as soon as they open."""

    def __init__(self, window: MainWindow, seed: int, files: list[Path]) -> None:
        super().__init__()
        self.window, self.files = window, files
        self.random = random.Random(seed)
        self.fixed = min(fixed_work() for _ in range(5))
        self.number = 0
        self.stalls: list[Stall] = []
        self.steps: list[str] = []
        keys = [key for action in ACTIONS if action.name not in NOT_PRESSED for key in action.keys]
        self.keys = [QKeySequence(key) for key in keys] + [QKeySequence(key) for key in "3.,-Q"]
        self.closing = QTimer(self)
        self.closing.timeout.connect(self.close_dialogs)
        self.closing.start(20)

    def close_dialogs(self) -> None:
        """Close what waits for a person: nothing goes on before."""
        popup, dialog = QApplication.activePopupWidget(), QApplication.activeModalWidget()
        if popup is not None:
            popup.close()
        elif isinstance(dialog, QDialog):
            dialog.reject()

    def step(self) -> None:
        """Do one step, and note it if it holds the window up without showing that it works."""
        kinds = (self.press, self.click, self.drag, self.turn, self.press, self.open, self.show, self.edit)
        kind = self.random.choices(kinds, (30, 30, 12, 8, 10, 3, 3, 4))[0]
        start = time.thread_time()
        step = kind()
        self.steps.append(step)
        QApplication.processEvents()
        times = (time.thread_time() - start) / self.fixed
        if times > LONGEST and not self.window.messages.progress.isVisible():
            self.stalls.append(Stall(self.number, step, times))
        self.number += 1

    def place(self) -> tuple[QWidget, QPoint]:
        """Return a widget at a random place of the window, and the place in it."""
        at = QPoint(self.random.randrange(self.window.width()), self.random.randrange(self.window.height()))
        found = self.window.childAt(at) or self.window
        return found, found.mapFrom(self.window, at)

    def press(self) -> str:
        """Press the keys of an action, or others."""
        key = self.random.choice(self.keys)
        target = QApplication.focusWidget() or self.window
        if target.window() is self.window:
            QTest.keySequence(target, key)
        return f"key {key.toString()}"

    def click(self) -> str:
        """Click or double-click anywhere, seldom with the right button."""
        widget, at = self.place()
        button = self.random.choice((LEFT, LEFT, LEFT, LEFT, RIGHT))
        modifier = self.random.choice((NO_MODIFIER, NO_MODIFIER, Qt.KeyboardModifier.ShiftModifier))
        name = f"click {type(widget).__name__} {widget.accessibleName()}"
        if self.random.random() < 0.1:
            QTest.mouseDClick(widget, button, modifier, at)
        else:
            QTest.mouseClick(widget, button, modifier, at)
        return name

    def drag(self) -> str:
        """Press at one place, move, and release at another one."""
        widget, at = self.place()
        button = self.random.choice((LEFT, LEFT, RIGHT))
        name = f"drag {type(widget).__name__}"
        QTest.mousePress(widget, button, NO_MODIFIER, at)
        for _ in range(self.random.randrange(1, 6)):
            at = at + QPoint(self.random.randrange(-60, 60), self.random.randrange(-60, 60))
            if isValid(widget):  # what was opened meanwhile may have other widgets
                QTest.mouseMove(widget, at)
            QApplication.processEvents()
        if isValid(widget):
            QTest.mouseRelease(widget, button, NO_MODIFIER, at)
        return name

    def turn(self) -> str:
        """Turn the wheel."""
        widget, at = self.place()
        turned = QPoint(0, self.random.choice((-240, -120, 120, 240)))
        event = QWheelEvent(
            QPointF(at),
            QPointF(widget.mapToGlobal(at)),
            QPoint(),
            turned,
            Qt.MouseButton.NoButton,
            NO_MODIFIER,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(widget, event)
        return f"wheel {type(widget).__name__}"

    def open(self) -> str:
        """Open a built-in scene or a file."""
        target = str(self.random.choice([*scene_names(), *self.files]))
        self.window.open_path(target)
        return f"open {target}"

    def show(self) -> str:
        """Show another page, or give the window another size."""
        if self.random.random() < 0.5:
            name = self.random.choice(self.window.pages.names)
            self.window.run_action(f"page_{name}")
            return f"page {name}"
        size = self.random.randrange(900, 1700), self.random.randrange(600, 1000)
        self.window.resize(*size)
        return f"size {size}"

    def edit(self) -> str:
        """Choose a theme, go back to the window, or undo a few edits."""
        what = self.random.choice(("theme", "window", "undo"))
        if what == "theme":
            self.window.appearance.set_theme(self.random.choice(("light", "dark", "presenter")))
        elif what == "window":
            self.window.showNormal()
        else:
            for _ in range(5):
                self.window.session.undo()
        return what

    def told(self) -> Iterator[str]:
        """Return the stalls, each with the steps before it, for a message."""
        for stall in self.stalls:
            before = "; ".join(self.steps[max(stall.number - 4, 0) : stall.number])
            yield f"step {stall.number}, {stall.step}: {stall.times:.0f} times the fixed work, after {before}"
