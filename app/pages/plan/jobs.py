"""Runs the planner off the GUI thread: plans, measures the plan, draws the pictures of what was chosen."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, Slot

from app.background.turns import turns
from app.background.workers import JobGroup, Progress
from core.scene import AnyScene
from core.settings import Settings
from core.study import Plan, PlanReport, StudyCancelledError, Tolerance, check_plan, plan
from core.study.planner.measuring import alone_settings
from core.study.planner.trials import difference, shown


@dataclass(frozen=True, eq=False)
class PlanOrder:
    """What to analyse, and with which tolerance."""

    scene: AnyScene
    settings: Settings
    """What is to be seen, not how well."""
    tolerance: Tolerance
    rounds: int
    title: str
    """What the scene is called."""


@dataclass(frozen=True, eq=False)
class PlanPictures:
    """What some choices of a plan draw, and what the reference settings draw."""

    setting: str
    """The stage whose choice is drawn alone; empty: all choices together."""
    settings: Settings
    before: Settings
    """The reference settings, but for what the choice rests on."""
    result: NDArray[np.uint8]
    """(H, W, 3), bytes of a screen."""
    reference: NDArray[np.uint8]
    """(H, W, 3), drawn with ``before``."""
    difference: NDArray[np.float32]
    """(H, W), of the channel that differs most, in 1/255."""


class PlanJobs(JobGroup):
    """At most one analysis and one drawing at a time."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.analysing = self.add_job()
        """Gives the ``Plan`` before it is measured, and in the end a ``PlanReport``."""
        self.drawing = self.add_job()
        """Gives a `PlanPictures`."""

    def analyse(self, order: PlanOrder) -> None:
        """Plan, then measure; the plan comes before its numbers."""

        def work(
            progress: Progress, is_cancelled: Callable[[], bool], planned: Callable[[Plan], None]
        ) -> PlanReport:
            def watch(done: float, doing: str) -> None:
                if is_cancelled():
                    raise StudyCancelledError("The analysis was cancelled.")
                progress(done, doing)

            with turns.take("Plan", progress, is_cancelled):
                chosen = plan(order.scene, order.tolerance, order.settings, watch)
                planned(chosen)
                return check_plan(order.scene, chosen, order.rounds, watch, times_each=True)

        self.analysing.start_in_parts(work)

    def draw(self, scene: AnyScene, chosen: Plan, setting: str) -> None:
        """Draw what a plan chose at one stage and nowhere else, or with an empty ``setting`` all that it chose."""
        before, settings = chosen.everything, chosen.settings
        if setting:
            decision = next(each for each in chosen.decisions if each.setting == setting)
            before, settings = alone_settings(chosen, decision)

        def work() -> PlanPictures:
            result, reference = shown(scene, settings), shown(scene, before)
            differs = difference(result, reference).astype(np.float32)
            pictures = result.astype(np.uint8), reference.astype(np.uint8)
            return PlanPictures(setting, settings, before, *pictures, differs)

        self.drawing.call(work)

    @Slot()
    def stop_drawing(self) -> None:
        """Wait for no picture any more."""
        self.drawing.cancel()
