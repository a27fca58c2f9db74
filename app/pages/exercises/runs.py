"""The runs behind a question, for the Step page: the right one, and beside it the one with a mistake."""

from dataclasses import replace

from app.pages.exercises.answer_pictures import Live, picture_of
from app.pages.exercises.scene_outline import document_of, scene_outline
from app.pages.page_bar import StepRequest
from core.lanes.limits import LISTING
from core.lanes.run import bounded
from core.scene import ClipScene
from core.study.accuracy.record import Opening
from lessons.exercises.answers.answer import Response
from lessons.exercises.answers.code import CodeAnswer
from lessons.exercises.answers.pixels import PixelAnswer
from lessons.exercises.question import Question
from lessons.exercises.refutation import Refutation
from lessons.mistakes.shelf import SHELF

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


def is_opened(question: Question, score: float) -> bool:
    """Return whether an answer is a wrong listing that the program can run beside the right one."""
    answer = question.draft.answer
    return isinstance(answer, CodeAnswer) and score < 1 and answer.is_shown


def wrong_run(question: Question, response: Response) -> StepRequest | None:
    """Return what steps the right listing beside a wrong one, on the smallest input that shows it."""
    answer = question.draft.answer
    assert isinstance(answer, CodeAnswer)
    with bounded(LISTING.seconds):
        opened = answer.opened(response)
    if opened is None:
        return None
    shown, title = opened.shown, question.template.title
    return StepRequest(
        Opening(shown.scene, opened.right, shown.stage, shown.pixel),
        title,
        opened.typed,
        other_title="your listing",
        is_asked=False,
    )
