"""What stands behind an answer: what is said of the check, the mistake's run or picture, the step that refutes it."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from PySide6.QtCore import QObject, Slot
from PySide6.QtWidgets import QMenu

from app.pages.exercises.answers import Checked, Live, coverage_of, document_of, picture_of, scene_outline
from app.pages.page_bar import Page, StepRequest
from core import STAGES, trace
from core.records.frame import Frame
from core.scene import ClipScene
from core.study.record import Opening
from lessons.exercises.answers.answer import Response
from lessons.exercises.answers.listings import CodeAnswer, Opened
from lessons.exercises.answers.marked import PixelAnswer
from lessons.exercises.coding.shader_task import Beside
from lessons.exercises.question import Question, Refutation
from lessons.mistakes.shelf import SHELF
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.question_view import QuestionView
from widgets.grid.layers import CellMark, GridBuffer, MaskOverlay

# The runs behind a question, for the Step page: the right one, and beside it the one with a mistake.


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
    """Return whether the run with a mistake can be stepped beside the right one.

    A question without a scene has the one that shows the mistake; a listing that was typed is run itself.
    """
    scene, is_typed = question.draft.scene, isinstance(question.draft.answer, CodeAnswer)
    has_scene = isinstance(scene, ClipScene) or (scene is None and not is_typed)
    return has_scene and mistake in SHELF and SHELF[mistake].is_run


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
    twin = SHELF[mistake]
    request, scene = right_run(question), question.draft.scene
    if scene is None:
        scene, settings = twin.shows.scene, twin.shows.settings
        request = StepRequest(Opening(scene, settings, question.template.stage), question.template.title)
    if request is None or not (isinstance(scene, ClipScene) or twin.takes_any_scene):
        return None
    return StepRequest(
        request.opening,
        request.title,
        twin.change_settings(request.opening.settings),
        other_scene=twin.change_scene(scene) if isinstance(scene, ClipScene) else scene,
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
    marks = (MaskOverlay("differs", CellMark.DIFFERENCE, differs, title="other than wanted"),)
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


# What stands behind an answer: the run or picture of its mistake, the step that refutes it, and the right
# run.


BACK, SEVERAL, EXPLAIN, OPEN = "Back to my answer", "Show those runs", "Step it", "Show it in A | B"
DRAWN = "Show what mine draws"


class Evidence(QObject):
    """Offers what can be shown of a question, and shows it when it is wanted."""

    def __init__(self, view: QuestionView, grid: MarkGrid, page: Page) -> None:
        super().__init__(page)
        self._view, self._grid, self._page = view, grid, page
        self._question: Question | None = None
        self._checked: Checked | None = None
        self._is_asked = self._is_shown = self._is_explained = self._is_pictured = False
        """Whether the question is open, whether the model answer was shown, whether the step that decides is offered,
        and whether the picture of a mistake stands in place of the raster."""
        view.twin_requested.connect(self.show_mistake)
        view.step_requested.connect(self.step_hidden)

    def follow(
        self,
        question: Question,
        checked: Checked | None,
        *,
        is_asked: bool,
        is_shown: bool,
        is_explained: bool,
    ) -> None:
        """Offer what can be shown of a question that ``is_asked``, was checked, or whose model answer ``is_shown``.

        ``is_explained``: it was missed so often that its step is offered.
        """
        if question is not self._question:
            self._is_pictured = False
        self._question, self._checked = question, checked
        self._is_asked, self._is_shown, self._is_explained = is_asked, is_shown, is_explained
        self._show_buttons()

    def _show_buttons(self) -> None:
        assert self._question is not None
        shown, has_run = self._shown(), self._question.draft.scene is not None
        mistake = "" if not shown else next(iter(shown)) if len(shown) == 1 else SEVERAL
        self._view.show_choices(
            twin=BACK if self._is_pictured else mistake,
            model="Model answer" if not self._is_shown else "Step the right run" if has_run else "",
            step=""
            if not has_run
            else "Step it, hidden"
            if self._is_asked
            else EXPLAIN
            if self._is_explained
            else "",
        )

    def _shown(self) -> dict[str, Callable[[], None]]:
        """Return what can be shown of the mistakes behind the answer, by what it is called."""
        if self._checked is None or self._question is None:
            return {}
        question, judgement = self._question, self._checked.judgement
        shown: dict[str, Callable[[], None]] = {}
        for name in judgement.mistakes:
            words = f": {name.replace('-', ' ')}" if len(judgement.mistakes) > 1 else ""
            if is_stepped(question, name):
                shown[f"Show that run{words}"] = partial(self._step, partial(faulty_run, question, name))
            elif is_pictured(question, name):
                shown[f"Show that picture{words}"] = partial(self._show_picture, name)
        if self._checked.opened is not None:
            make = partial(wrong_run, question, self._checked.opened, hides_right=not self._is_shown)
            shown[OPEN] = partial(self._step, make)
        if self._checked.drawn is not None:
            shown[DRAWN] = partial(self._show_drawn, self._checked.drawn)
        if judgement.refutation is not None:
            title = question.template.title
            shown["Show the step"] = partial(self._step, partial(refuting_step, judgement.refutation, title))
        return shown

    @Slot()
    def show_mistake(self) -> None:
        """Show the run, the picture or the step behind a wrong answer; of several, ask which."""
        shown = self._shown()
        if self._is_pictured:
            self.end_picture()
        elif len(shown) == 1:
            next(iter(shown.values()))()
        elif shown:
            menu = QMenu(self._view)
            for text in shown:
                menu.addAction(text)
            chosen = menu.exec(self._view.twin_button.mapToGlobal(self._view.twin_button.rect().bottomLeft()))
            act = None if chosen is None else self._shown().get(chosen.text())
            if act is not None:  # Else another question has come below the menu.
                act()

    def _step(self, make: Callable[[], StepRequest | None]) -> None:
        try:
            request = make()
        except ValueError as problem:
            self._page.refuse(f"This cannot be stepped: {problem}.")
            return
        if request is not None:
            self._page.step_to(request)

    def _show_picture(self, name: str) -> None:
        """Show the picture that the mistake makes, until the learner goes back to the answer."""
        assert self._question is not None
        live = faulty_picture(self._question, name)
        self._put(live, "The picture shows what this mistake makes of the scene.")

    def _show_drawn(self, drawn: Frame) -> None:
        """Show the picture that a listing draws, until the learner goes back to the answer."""
        assert self._question is not None
        note = "The picture shows what your listing draws, with marks where it is not as it must be."
        self._put(drawn_picture(self._question, drawn), note)

    def _put(self, live: Live, note: str) -> None:
        self._grid.show_geometry(live.outline)
        self._grid.show_picture(live.picture, live.overlays)
        self._is_pictured = True
        self._view.show_note(note)
        self._show_buttons()

    def end_picture(self) -> None:
        """Show the answer again."""
        if self._is_pictured:
            self._is_pictured = False
            assert self._question is not None
            wanted = wanted_picture(self._question)
            self._grid.show_picture(wanted)
            self._view.show_note("")
            self._show_buttons()

    @Slot()
    def step_hidden(self) -> None:
        """Step the scene while it is asked about, hidden as while predicting; or the step that decides it."""
        if self._question is not None and self._is_asked:
            self._step(partial(right_run, self._question, is_asked=True))
        elif self._question is not None and self._checked is not None and self._is_explained:
            self._step(partial(explaining_run, self._question, self._checked.response))

    def step_right(self) -> None:
        """Step the right run."""
        if self._question is not None:
            self._step(partial(right_run, self._question))
