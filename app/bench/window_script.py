"""What is done in the window, stage by stage, and how long it takes until nothing is left to be done."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from math import cos, pi, sin
from time import perf_counter, sleep, thread_time

import numpy as np
from PySide6.QtCore import QAbstractEventDispatcher, QCoreApplication, QEvent, QEventLoop, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from app.files.open_any import Opened
from app.window.main_window import MainWindow
from core import STAGES
from core.fast_path.workers.band_workers import BandWorkers
from core.records.steps import Level
from widgets.grid.geometry import vertex_place

# The event loop of a window, run by hand: how long it takes from an input until nothing is left to do or to
# paint.


PAUSE = 0.06
"""Seconds between two inputs, as of a key that is held down: then the program works ahead."""
LONGEST_WAIT = 20.0
"""Seconds after which an answer is no longer waited for."""
WAIT_STEP = 0.001
"""Seconds between two looks whether something has come from the background."""
FIXED_ROUNDS = 100_000


@dataclass(frozen=True)
class Answer:
    """How long the window took over one input; all in seconds."""

    wall: float
    """From the input until nothing was left to do or to paint."""
    processor: float
    """What the window's thread worked in that time."""
    stall: float
    """The longest time in which no other input would have been taken, until the next input."""
    fixed: float
    """A fixed piece of work, timed just before: on a busy machine it takes longer."""


class TimedLoop:
    """Gives inputs to a window and times its answers."""

    def __init__(self, is_waiting: Callable[[], bool]) -> None:
        """Take what says whether something that was asked for still comes from another thread."""
        self._is_waiting = is_waiting
        self._stall = 0.0

    def time(self, give_input: Callable[[], object], pause: float = PAUSE) -> Answer:
        """Give an input, wait until it is answered, then pause."""
        fixed = fixed_work()
        self._stall = 0.0
        start, worked = perf_counter(), thread_time()
        give_input()
        self._stall = perf_counter() - start
        end, processor = self._settle(), thread_time() - worked
        self.pause(pause)
        return Answer(end - start, processor, self._stall, fixed)

    def pause(self, seconds: float) -> None:
        """Let the window do what it does while nobody acts."""
        end = perf_counter() + seconds
        while perf_counter() < end:
            self._settle()
            sleep(WAIT_STEP)

    def _settle(self) -> float:
        """Run the loop until it has nothing to do; return when it had done the last thing."""
        start = last = perf_counter()
        while True:
            turned = perf_counter()
            has_worked = self._turn()
            now = perf_counter()
            self._stall = max(self._stall, now - turned)
            if has_worked:
                last = now
            if now - start > LONGEST_WAIT:
                return now
            if not has_worked:
                if not self._is_waiting():
                    return last
                sleep(WAIT_STEP)

    def _turn(self) -> bool:
        """Do what is there to be done; return whether there was anything."""
        dispatcher = QAbstractEventDispatcher.instance()
        has_worked = dispatcher.processEvents(QEventLoop.ProcessEventsFlag.AllEvents)
        # These wait for the loop of the application itself, which does not run here.
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)
        return has_worked


def fixed_work() -> float:
    """Return the seconds that a fixed piece of work takes."""
    start, total = perf_counter(), 0
    for number in range(FIXED_ROUNDS):
        total += number * number
    return perf_counter() - start


# What is done in the window: every stage is entered, stepped at every level and scrubbed; a vertex is
# dragged.


LEVELS = (Level.TRIANGLE, Level.GROUP, Level.PIXEL, Level.OPERATION)
DRAG_STAGES = ("raster", "depth")
LESSONS = ("inside-or-outside", "shared-edges", "the-middle")
"""Those that are walked: small scenes, and a textured one beside another method."""
STARTS = (0.0, 0.4, 0.75)
"""Where in a stage it is stepped, as fractions of it."""
OPENING_SECONDS = 0.5
"""What a new window is given to come to rest."""


@dataclass(frozen=True)
class Amount:
    """How much of everything is done."""

    starts: tuple[float, ...] = STARTS
    steps: int = 6
    """From every start, at every level of every stage."""
    moves: int = 24
    """Of the pointer, or of the slider."""


WHOLE, QUICK = Amount(), Amount((0.4,), 3, 8)


@dataclass(frozen=True)
class Sample:
    """One input and its answer."""

    scene: str
    action: str
    """enter, step, scrub, hover, drag, drop, orbit or lesson: its next step."""
    stage: str
    level: str
    """Of the step; empty: another action."""
    answer: Answer


@contextmanager
def opened_window(opened: Opened, size: tuple[int, int]) -> Iterator[MainWindow]:
    """Show a window, and take it away without saving anything."""
    window = MainWindow(opened.document)
    window.page.views.scene_presenter.draw_with(BandWorkers())
    window.files.show_opened(opened)
    window.resize(*size)
    window.show()
    window.activateWindow()
    window.setFocus(Qt.FocusReason.OtherFocusReason)
    try:
        QTest.qWaitForWindowExposed(window)
        yield window
    finally:
        window.hide()
        for page in window.pages.made:
            page.stop()
        window.files.shut_down()
        window.opening.shut_down()
        window.session.tracing.shut_down()
        window.deleteLater()
        QCoreApplication.sendPostedEvents(window, QEvent.Type.DeferredDelete.value)


class Script:
    """Acts in one window and keeps the answers."""

    def __init__(self, window: MainWindow, scene: str, amount: Amount) -> None:
        self._window, self._page, self._session = window, window.page, window.session
        self._scene, self._amount = scene, amount
        self._loop = TimedLoop(self._is_waiting)
        self.samples: list[Sample] = []

    def run(self) -> None:
        """Do everything."""
        self._loop.pause(OPENING_SECONDS)
        self._enter()
        for stage in STAGES:
            for level in LEVELS:
                self._step(stage, level)
            self._scrub(stage)
        self._hover()
        for stage in DRAG_STAGES:
            self._drag(stage)
        self._orbit()
        for name in LESSONS:
            self._walk(name)

    def _is_waiting(self) -> bool:
        is_busy = self._session.tracing.is_busy or self._page.views.is_drawing
        return is_busy or self._page.lessons.is_working

    def _note(self, action: str, give_input: Callable[[], object], level: Level | None = None) -> None:
        answer = self._loop.time(give_input)
        name = "" if level is None else level.name.lower()
        self.samples.append(Sample(self._scene, action, self._session.cursor.stage, name, answer))

    def _enter(self) -> None:
        """Enter every stage for the first time, the one that is shown already at last."""
        shown = STAGES.index(self._session.cursor.stage)
        for stage in STAGES[shown + 1 :] + STAGES[: shown + 1]:
            self._note("enter", partial(self._session.set_stage, stage, 0))

    def _step(self, stage: str, level: Level) -> None:
        """Press Right at a level of a stage, from several places."""
        session = self._session
        session.set_stage(stage, 0)
        session.set_level(level)
        bounds = session.stage_trace.steps.boundaries(level)
        last = len(bounds) - 1
        for first in sorted({int(last * start) for start in self._amount.starts}):
            session.go_to(int(bounds[first]))
            self._loop.pause(OPENING_SECONDS / 4)
            for _ in range(min(self._amount.steps, last - first)):
                self._note("step", partial(QTest.keyClick, self._window, Qt.Key.Key_Right), level)

    def _scrub(self, stage: str) -> None:
        """Run through a stage in equal parts, without a pause."""
        count = self._session.stage_trace.steps.count
        places = np.unique(np.linspace(0, count, self._amount.moves, dtype=int))
        if self._session.cursor.stage == stage and len(places) > 2:
            self._session.go_to(0)
            self._loop.pause(0.0)
            for place in places[1:].tolist():
                self._note_at_once("scrub", partial(self._session.scrub, place))

    def _note_at_once(self, action: str, give_input: Callable[[], object]) -> None:
        answer = self._loop.time(give_input, pause=0.0)
        self.samples.append(Sample(self._scene, action, self._session.cursor.stage, "", answer))

    def _show_pixels(self, stage: str) -> None:
        self._session.set_stage(stage)
        self._page.show_view("pixels")
        self._loop.pause(OPENING_SECONDS)

    def _hover(self) -> None:
        """Move the pointer across the grid."""
        self._show_pixels("raster")
        area = self._page.grid.placement().seen_raster
        for move in range(self._amount.moves):
            part = (move + 1) / (self._amount.moves + 1)
            place = area.topLeft() + QPointF(part * area.width(), part * area.height())
            self._note_at_once("hover", partial(move_mouse, self._page.grid, place))
        self._session.set_hover(None)

    def _drag(self, stage: str) -> None:
        """Drag a vertex of the triangle in focus around a small circle, drop it, and take that back."""
        self._show_pixels(stage)
        grid, geometry = self._page.grid, self._page.grids.geometry
        placement = grid.placement()
        places = [vertex_place(geometry, placement, vertex) for vertex in geometry.focus_vertices]
        seen = [place for place in places if place and placement.seen_raster.contains(place)]
        if not seen:
            return
        self._drag_around("drag", grid, seen[0], max(1.5 * placement.cell, 12.0))
        self._note("drop", partial(send_mouse, grid, QEvent.Type.MouseButtonRelease, seen[0]))
        self._session.undo()
        self._loop.pause(OPENING_SECONDS)

    def _orbit(self) -> None:
        """Turn the 3D view."""
        self._page.show_view("scene")
        self._loop.pause(OPENING_SECONDS)
        view = self._page.main_view()
        corner = QPointF(view.width() / 8, view.height() / 8)
        self._drag_around("orbit", view, corner, view.height() / 10)
        send_mouse(view, QEvent.Type.MouseButtonRelease, corner)

    def _walk(self, name: str) -> None:
        """Go from step to step of a lesson, as somebody who reads them: the next one is traced meanwhile."""
        lessons = self._page.lessons
        lessons.keeps_attempts = False
        lessons.open(name, 0)
        self._loop.pause(2 * OPENING_SECONDS)
        while lessons.walk is not None and lessons.walk.step is not None:
            self._note("lesson", partial(QTest.keyClick, self._window, Qt.Key.Key_PageDown))
            self._loop.pause(OPENING_SECONDS)
        lessons.close()
        self._loop.pause(OPENING_SECONDS)

    def _drag_around(self, action: str, widget: QWidget, place: QPointF, radius: float) -> None:
        """Press the button and move around a circle."""
        send_mouse(widget, QEvent.Type.MouseButtonPress, place)
        for move in range(1, self._amount.moves + 1):
            angle = 2 * pi * (move / self._amount.moves + 0.05)
            there = place + QPointF(radius * sin(angle), radius * (1 - cos(angle)))
            self._note_at_once(action, partial(move_mouse, widget, there, Qt.MouseButton.LeftButton))


def move_mouse(widget: QWidget, place: QPointF, buttons: Qt.MouseButton = Qt.MouseButton.NoButton) -> None:
    """Move the pointer over a widget, with a button held or none."""
    send_mouse(widget, QEvent.Type.MouseMove, place, Qt.MouseButton.NoButton, buttons)


def send_mouse(
    widget: QWidget,
    kind: QEvent.Type,
    place: QPointF,
    button: Qt.MouseButton = Qt.MouseButton.LeftButton,
    buttons: Qt.MouseButton = Qt.MouseButton.LeftButton,
) -> None:
    """Give a widget a mouse event as the system does."""
    no_key = Qt.KeyboardModifier.NoModifier
    event = QMouseEvent(kind, place, QPointF(widget.mapToGlobal(place)), button, buttons, no_key)
    QApplication.sendEvent(widget, event)
