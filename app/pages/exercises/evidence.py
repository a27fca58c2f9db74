"""What stands behind an answer: the run or picture of its mistake, the step that refutes it, and the right run."""

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QObject, Slot
from PySide6.QtWidgets import QMenu

from app.pages.exercises.answer_pictures import Live
from app.pages.exercises.runs import (
    drawn_picture,
    explaining_run,
    faulty_picture,
    faulty_run,
    is_pictured,
    is_stepped,
    refuting_step,
    right_run,
    wanted_picture,
    wrong_run,
)
from app.pages.exercises.work import Checked
from app.pages.page_bar import Page, StepRequest
from core.records.frame import Frame
from lessons.exercises.question import Question
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.question_view import QuestionView

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
