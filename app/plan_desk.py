"""Runs the planner off the GUI thread: plans, measures the plan, draws the pictures of what was chosen."""

from collections.abc import Callable
from dataclasses import dataclass
from threading import Lock

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, Signal, Slot

from app.workers import Job, Progress
from core.scene import AnyScene
from core.settings import Settings
from core.study import Plan, PlanReport, StudyCancelledError, Tolerance, check_plan, plan
from core.study.planner.measuring import alone_settings, difference, shown


@dataclass(frozen=True, eq=False)
class PlanOrder:
    """What is to be looked at, and how closely."""

    scene: AnyScene
    settings: Settings
    """What is to be seen, not how well."""
    tolerance: Tolerance
    rounds: int
    title: str
    """What the scene is called."""


@dataclass(frozen=True, eq=False)
class PlanPictures:
    """What some choices of a plan draw, and what everything on draws."""

    setting: str
    """The stage whose choice is drawn alone; empty: all choices together."""
    settings: Settings
    before: Settings
    """Everything on, but for what the choice rests on."""
    result: NDArray[np.uint8]
    """(H, W, 3), bytes of a screen."""
    reference: NDArray[np.uint8]
    """(H, W, 3), drawn with ``before``."""
    difference: NDArray[np.float32]
    """(H, W), of the channel that differs most, in 1/255."""


@dataclass(frozen=True, eq=False)
class _Planned:
    serial: int
    plan: Plan


class PlanDesk(QObject):
    """At most one look and one drawing at a time; the newest counts."""

    planned = Signal(object)
    """The ``Plan``, before it is measured."""
    progressed = Signal(object, str)
    measured = Signal(object)
    """The ``PlanReport``."""
    failed = Signal(object)
    """The exception."""
    ended = Signal()
    """Measured, failed or cancelled."""
    pictures_drawn = Signal(object)
    """A `PlanPictures`."""
    pictures_failed = Signal(object)
    _planned_in_thread = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        # What was cancelled may still be in its last drawing, which would disturb the times of the next.
        self._turn = Lock()
        self._serial = 0
        self._looking, self._drawing = Job(self), Job(self)
        self._looking.progressed.connect(self.progressed)
        self._looking.succeeded.connect(self.measured)
        self._looking.failed.connect(self.failed)
        self._looking.ended.connect(self.ended)
        self._drawing.succeeded.connect(self.pictures_drawn)
        self._drawing.failed.connect(self.pictures_failed)
        self._planned_in_thread.connect(self._take_plan)

    @property
    def is_looking(self) -> bool:
        """Whether a plan is being made or measured."""
        return self._looking.is_running

    def look(self, order: PlanOrder) -> None:
        """Plan, then measure; the plan comes before its numbers."""
        self._serial += 1
        serial = self._serial

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> PlanReport:
            def watch(done: float, doing: str) -> None:
                if is_cancelled():
                    raise StudyCancelledError("The look was cancelled.")
                progress(done, doing)

            with self._turn:
                chosen = plan(order.scene, order.tolerance, order.settings, watch)
                self._planned_in_thread.emit(_Planned(serial, chosen))
                return check_plan(order.scene, chosen, order.rounds, watch, times_each=True)

        self._looking.start(work)

    @Slot()
    def cancel(self) -> None:
        """Stop looking; nothing comes of it."""
        self._serial += 1
        self._looking.cancel()

    @Slot(object)
    def _take_plan(self, planned: _Planned) -> None:
        if planned.serial == self._serial and self.is_looking:
            self.planned.emit(planned.plan)

    def draw(self, scene: AnyScene, chosen: Plan, setting: str) -> None:
        """Draw what a plan chose at one stage and nowhere else, or with an empty ``setting`` all that it chose."""
        before, settings = chosen.everything, chosen.settings
        if setting:
            decision = next(each for each in chosen.decisions if each.setting == setting)
            before, settings = alone_settings(chosen, decision)

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> PlanPictures:
            result, reference = shown(scene, settings), shown(scene, before)
            differs = difference(result, reference).astype(np.float32)
            pictures = result.astype(np.uint8), reference.astype(np.uint8)
            return PlanPictures(setting, settings, before, *pictures, differs)

        self._drawing.start(work)

    @Slot()
    def stop_drawing(self) -> None:
        """Wait for no picture any more."""
        self._drawing.cancel()

    def shut_down(self) -> None:
        """Cancel everything and wait for the threads."""
        self._serial += 1
        self._looking.shut_down()
        self._drawing.shut_down()
