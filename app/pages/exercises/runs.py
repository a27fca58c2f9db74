"""The runs behind a question, for the Step page: the right one, and beside it the one with a mistake."""

from dataclasses import replace

import numpy as np

from app.pages.exercises.answer_pictures import Live, coverage_of, picture_of
from app.pages.exercises.scene_outline import document_of, scene_outline
from app.pages.page_bar import StepRequest
from core import STAGES, trace
from core.records.frame import Frame
from core.scene import ClipScene
from core.study.accuracy.record import Opening
from lessons.exercises.answers.answer import Response
from lessons.exercises.answers.code import CodeAnswer, Opened
from lessons.exercises.answers.pixels import PixelAnswer
from lessons.exercises.coding.shader_task import Beside
from lessons.exercises.question import Question
from lessons.exercises.refutation import Refutation
from lessons.mistakes.shelf import SHELF
from widgets.grid.buffer import GridBuffer
from widgets.grid.overlay import Mark, MaskOverlay

PICTURED = ("numbers", "table", "choice", "order", "line")
"""Types of answers beside which a picture may stand."""


def right_run(question: Question, *, is_asked: bool = False) -> StepRequest | None:
    """Return what steps the right run, hidden while it ``is_asked``; ``None``: the question draws nothing."""
    draft = question.draft
    if draft.scene is None:
        return None
    document = document_of(draft, question.template.title)
    opening = Opening(draft.scene, document.settings, question.template.stage, draft.pixel)
    return StepRequest(opening, question.template.title, is_asked=is_asked)


def explaining_run(question: Question, response: Response) -> StepRequest | None:
    """Return what steps the right run at the pixel asked about, or the lowest that an answer has wrong."""
    request, answer = right_run(question), question.draft.answer
    if request is None or request.opening.pixel is not None or not isinstance(answer, PixelAnswer):
        return request
    wrong = (response ^ answer.reference) - answer.may
    pixel = min(wrong, key=lambda pixel: pixel[::-1], default=None)
    return replace(request, opening=replace(request.opening, pixel=pixel))


def is_stepped(question: Question, mistake: str) -> bool:
    """Return whether the run with a mistake can be stepped beside the right one."""
    return isinstance(question.draft.scene, ClipScene) and mistake in SHELF and SHELF[mistake].is_run


def is_pictured(question: Question, mistake: str) -> bool:
    """Return whether only the picture with a mistake can be shown; of marked pixels the answer is that picture."""
    has_scene = isinstance(question.draft.scene, ClipScene) and question.draft.answer.kind in PICTURED
    return has_scene and mistake in SHELF and not SHELF[mistake].is_run


def faulty_picture(question: Question, mistake: str) -> Live:
    """Return the picture with a mistake."""
    scene = question.draft.scene
    assert isinstance(scene, ClipScene)
    return Live(scene_outline(scene), picture_of(SHELF[mistake].draw(scene, question.draft.settings)))


def refuting_step(refutation: Refutation, title: str) -> StepRequest:
    """Return what shows the step that refutes a belief."""
    opening = Opening(refutation.scene, refutation.settings, refutation.stage)
    return StepRequest(opening, title, position=refutation.position(), is_asked=False)


def faulty_run(question: Question, mistake: str) -> StepRequest | None:
    """Return what steps the right run beside that with a mistake, from their first difference on."""
    request, scene = right_run(question), question.draft.scene
    if request is None or not isinstance(scene, ClipScene):
        return None
    twin = SHELF[mistake]
    return StepRequest(
        request.opening,
        request.title,
        twin.change_settings(request.opening.settings),
        other_scene=twin.change_scene(scene),
        other_title=f"with the mistake: {mistake.replace('-', ' ')}",
        is_asked=False,
    )


def wanted_picture(question: Question) -> GridBuffer | None:
    """Return the picture that a question shows, which a listing must draw; ``None``: there is none."""
    answer = question.draft.answer
    wanted = answer.picture if isinstance(answer, CodeAnswer) else None
    return None if wanted is None else coverage_of(wanted, "the picture")


def drawn_picture(question: Question, drawn: Frame) -> Live:
    """Return what a listing draws in place of the wanted picture, with marks where it differs."""
    answer = question.draft.answer
    assert isinstance(answer, CodeAnswer)
    assert answer.picture is not None
    differs = np.asarray((drawn.primitive >= 0) != (answer.picture.primitive >= 0))
    marks = (MaskOverlay("differs", Mark.DIFFERENCE, differs, title="other than wanted"),)
    return Live(None, coverage_of(drawn, "your picture"), marks)


def wrong_run(question: Question, opened: Opened | Beside, *, hides_right: bool) -> StepRequest:
    """Return what steps the right run beside a wrong one, on the smallest input that shows it.

    ``hides_right``: the right listing itself is not shown. A shader stands beside built-in shading.
    """
    if isinstance(opened, Beside):
        last = trace(opened.scene, opened.settings).stage(STAGES[-1]).steps.count
        return StepRequest(
            Opening(opened.scene, opened.settings, STAGES[-1]),
            question.template.title,
            opened.settings,
            other_scene=opened.other,
            other_title="my shader",
            position=last,
            is_asked=False,
        )
    shown = opened.shown
    opening = Opening(shown.scene, shown.settings, shown.stage, shown.pixel)
    return StepRequest(
        opening, question.template.title, edits=(opened.edit,), hides_right=hides_right, is_asked=False
    )
