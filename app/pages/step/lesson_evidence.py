"""What shows why an answer is wrong: the step that refutes it, or the run with its mistake beside the right one."""

from typing import TYPE_CHECKING

from app.pages.step.lesson_question import JudgedAnswer
from core.scene import ClipScene
from lessons.course.record import StepPart
from lessons.course.state import State
from lessons.mistakes.shelf import SHELF

if TYPE_CHECKING:
    from app.pages.step.page import StepPage


def has_refuting_step(judged: JudgedAnswer, step: StepPart) -> bool:
    """Return whether the file names a step that refutes an answer."""
    wrong = judged.outcome.wrong
    return wrong is not None and step.wrong[wrong].at is not None


def mistake_of(judged: JudgedAnswer) -> str:
    """Return the mistake behind an answer whose run can be stepped; empty: there is none."""
    names = judged.outcome.judgement.mistakes
    return next((name for name in names if name in SHELF and SHELF[name].is_run), "")


def show_mistake(page: "StepPage", state: State, name: str) -> None:
    """Show the run with a mistake beside the right one: at the pixel of a state, or at their first difference."""
    twin = SHELF[name]
    other = twin.change_settings(state.settings)
    scene = twin.change_scene(state.scene) if isinstance(state.scene, ClipScene) else state.scene
    title = f"with the mistake: {name.replace('-', ' ')}"
    page.comparing.show_mistake(state.settings.differences(other), scene, title)
    page.show_view("compare")
    if state.pixel is not None:
        page.session.set_pin(state.pixel)
        page.comparing.meet_at(state.pixel)
        page.tell("")
