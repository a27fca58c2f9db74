"""What the Plan page does off the GUI thread: plans, measures the plan, draws the pictures of what was chosen."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from app.background.workers import Progress
from app.pages.opened import DrawnPictures
from app.pages.page_bar import StepRequest
from core.explain.stage_texts import family_title
from core.methods import table
from core.records.words import counted
from core.scene import AnyScene
from core.settings import Settings
from core.study import Opening, Plan, PlanReport, StudyCancelledError, Tolerance, check_plan, plan
from core.study.planner.measuring import alone_settings
from core.study.planner.trials import difference, shown
from widgets.charts.study_pictures import PicturesRecord
from widgets.grid.buffer import GridBuffer
from widgets.grid.linked_grids import Pixel


@dataclass(frozen=True, eq=False)
class PlanShown:
    """A plan of a scene, and once it is measured its report."""

    scene: AnyScene
    title: str
    """What the scene is called."""
    plan: Plan
    report: PlanReport | None = None


def planned(
    scene: AnyScene,
    title: str,
    settings: Settings,
    tolerance: Tolerance,
    rounds: int,
    progress: Progress,
    is_cancelled: Callable[[], bool],
    part_done: Callable[[PlanShown], None],
) -> PlanShown:
    """Plan, then measure; the plan comes before its numbers.

    Parameters
    ----------
    settings : Settings
        What is to be seen, not how well.
    """

    def watch(done: float, doing: str) -> None:
        if is_cancelled():
            raise StudyCancelledError("The analysis was cancelled.")
        progress(done, doing)

    found = PlanShown(scene, title, plan(scene, tolerance, settings, watch))
    part_done(found)
    return replace(found, report=check_plan(scene, found.plan, rounds, watch, times_each=True))


def drawn_choice(scene: AnyScene, chosen: Plan, setting: str) -> DrawnPictures:
    """Return what a plan chose at one stage alone, or with an empty ``setting`` all of it, beside the reference."""
    before, settings, title = chosen.everything, chosen.settings, "All choices together"
    if setting:
        decision = next(each for each in chosen.decisions if each.setting == setting)
        before, settings = alone_settings(chosen, decision)
        title = f"{family_title(setting)}: {table.get(setting, getattr(settings, setting)).title}"
    result, reference = shown(scene, settings), shown(scene, before)
    differs = difference(result, reference).astype(np.float32)
    count = int(np.count_nonzero(differs))
    amount = (
        f"{counted(count, 'pixel')} of {differs.size:,} differ, by {int(differs.max())}/255 at most."
        if count
        else f"none of {differs.size:,} pixels differs."
    )
    buffers = (
        GridBuffer("chosen", result.astype(np.uint8), "color"),
        GridBuffer("reference settings", reference.astype(np.uint8), "color"),
        # White is no difference at any size of it.
        GridBuffer("difference", differs, "signed", unit="/255"),
    )
    except_for = "" if before == chosen.everything else ", except what this choice needs"
    heads = title, f"Reference settings{except_for}", "Difference, in 1/255"
    row, column = np.unravel_index(int(differs.argmax()), differs.shape)
    request = partial(_request, scene, settings, before, title, (int(column), int(row)))
    return DrawnPictures(PicturesRecord(f"{title}: {amount}", buffers, heads, can_step=True), request)


def _request(
    scene: AnyScene, settings: Settings, before: Settings, title: str, worst: Pixel, pin: Pixel | None
) -> StepRequest:
    """Return the choice beside the reference settings, A | B, at the pinned pixel or where they differ most."""
    return StepRequest(Opening(scene, settings, "resolve", pin or worst), title, before)
