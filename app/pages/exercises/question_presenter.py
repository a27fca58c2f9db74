"""Asks one question: takes the answer, checks it, shows hints, marks, the mistake, and the runs behind them."""

from collections.abc import Callable
from functools import partial
from time import monotonic
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal, Slot
from PySide6.QtGui import QGuiApplication

from app.background import Job, end_work
from app.files.kept_work import Unfinished, UnfinishedFile
from app.pages.exercises.answers import (
    AnswerHistory,
    Asked,
    Checked,
    Live,
    Tried,
    asking,
    asking_apart,
    checking,
    drawing,
    new_seed,
    numbers_of,
    picture_of,
    place_of,
    size_of,
    trying,
)
from app.pages.exercises.catalogue_presenter import CataloguePresenter
from app.pages.exercises.evidence import Evidence, wanted_picture
from app.pages.exercises.feedback import LastCheck, not_checked_text, show_tried
from app.pages.page_bar import Page
from core.records.words import counted
from lessons.attempts.practice import TRY_LIMIT
from lessons.exercises.answers.answer import NotCheckedError, Response
from lessons.exercises.answers.listings import CannotRunError
from lessons.exercises.answers.spot import SpotAnswer
from lessons.exercises.answers.steps import StepsAnswer
from lessons.exercises.question import Question, Template, hints_after
from lessons.scene_edits import scene_digest
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.question_view import QuestionView
from widgets.exercises.records import QuestionRecord

SURE = "The model answer ends this question without points. Choose Model answer again to show it."


class QuestionPresenter(QObject):
    """Knows the question that is asked, and what has been done about it."""

    asked = Signal(object)
    """A `Question`: it is shown now."""
    checked = Signal(object)
    """An `Attempt` that was kept."""
    state_changed = Signal()
    """The question may be asked now, or be asked no longer; or none could be asked."""

    def __init__(
        self,
        view: QuestionView,
        grid: MarkGrid,
        unfinished: UnfinishedFile,
        exercises: CataloguePresenter,
        page: Page,
    ) -> None:
        """Begin without a question; ``exercises`` knows the attempts of the learner so far."""
        super().__init__(page)
        self._page, self._exercises = page, exercises
        self._view, self._grid, self._unfinished = view, grid, unfinished
        self.user = ""
        self.question: Question | None = None
        self._asked: Asked | None = None
        """The question with its outline, as it was drawn."""
        self._last = LastCheck(lambda: exercises.attempts)
        self._hints = 0
        self._has_answer = self._is_checked = self._is_shown = self._is_sure = False
        self._left_out: object = None
        """The answer of which was said that it leaves something empty."""
        self._digest = ""
        self._history = AnswerHistory(grid, self)
        self._begun = monotonic()
        self.evidence = Evidence(view, grid, page)
        self._asking = Job(self, succeeded=self._show, failed=self._refuse)
        self._checking = Job(self, succeeded=self._show_checked, failed=self._not_checked)
        self._drawing = Job(self, succeeded=self._show_live, failed=self._refuse)
        self._trying = Job(self, succeeded=self._show_tried)
        self._waiting: list[Callable[[], None]] = []
        """What ends this question, and was wanted while its answer was being checked."""
        # Queued: the verdict is shown first.
        self._checking.ended.connect(self._go_on, Qt.ConnectionType.QueuedConnection)
        view.check_requested.connect(self.check)
        view.hint_requested.connect(self.show_hint)
        view.variant_requested.connect(self.ask_variant)
        view.again_requested.connect(self.ask_again)
        view.model_requested.connect(self.show_model)
        view.copy_requested.connect(self.copy_line)

    @property
    def is_working(self) -> bool:
        """Whether a question or an answer is being drawn, or an answer is being checked."""
        return bool(self._waiting) or any(
            job.is_running for job in (self._asking, self._checking, self._drawing, self._trying)
        )

    @property
    def is_checking(self) -> bool:
        """Whether an answer is being checked."""
        return self._checking.is_running

    def stop(self) -> None:
        """End all work."""
        self._waiting.clear()
        end_work(self)

    def after_check(self, act: Callable[[], None]) -> None:
        """Do now what ends the question, or once its answer, if it is being checked, has its verdict."""
        self._waiting.append(act)
        self._go_on()

    @Slot()
    def _go_on(self) -> None:
        while self._waiting and not self._checking.is_running:
            self._waiting.pop(0)()

    @property
    def is_asked(self) -> bool:
        """Whether the question is still open: neither checked nor shown."""
        return self.question is not None and not self._is_checked and not self._is_shown

    @property
    def asked_scene(self) -> str:
        """Digest of the scene that is asked about; empty: none."""
        return self._digest if self.is_asked else ""

    # Asking.

    def open(self, template: Template, seed: int | None = None) -> None:
        """Ask a question of a template: of a seed, afresh if it was checked; or the last one; or else a new one."""
        self.after_check(partial(self._open, template, seed))

    def _open(self, template: Template, seed: int | None) -> None:
        if seed is None and self.question is not None and self.question.template is template:
            self._asking.cancel()  # It is shown: what was chosen since is not wanted any more.
        else:
            self._asking.start(asking(template, seed, self._unfinished.answers.answers))

    def open_at_once(self, template: Template, seed: int | None = None) -> None:
        """Ask a question as `open` does, and return when it is shown."""
        self._asking.cancel()
        try:
            self._show(asking(template, seed, self._unfinished.answers.answers)())
        except (ValueError, MemoryError) as error:
            self._refuse(error)

    @Slot()
    def ask_variant(self) -> None:
        """Ask the same with other numbers; if several mistakes fit the answer, with such as tell them apart."""
        self.after_check(self._ask_variant)

    def _ask_variant(self) -> None:
        if self.question is not None:
            mistakes = () if self._last.checked is None else self._last.checked.judgement.mistakes
            seeds = [new_seed() for _ in range(TRY_LIMIT)]
            self._asking.start(asking_apart(self.question.template, mistakes, seeds))

    @Slot()
    def ask_again(self) -> None:
        """Ask the same question with an empty answer."""
        self.after_check(self._ask_again)

    def _ask_again(self) -> None:
        if self._asked is not None:
            self._keep(given=None, is_checked=False)
            self._show(self._asked)

    @Slot(object)
    def _show(self, asked: Asked) -> None:
        """Show a question, with what was answered before."""
        for job in (self._asking, self._drawing, self._trying):
            job.cancel()  # They are about another one.
        self._asked, self.question = asked, asked.question
        question, template, draft = asked.question, asked.question.template, asked.question.draft
        kept = self._unfinished.answers.answers.get(template.name)
        is_other = kept is None or (kept.version, kept.seed) != (template.version, question.seed)
        if kept is None or is_other or (asked.is_afresh and kept.is_checked):
            kept = Unfinished(version=template.version, seed=question.seed)
        self._last.begin(question)
        self._left_out, self._is_sure = None, False
        self._has_answer = kept.given is not None
        self._hints = min(kept.hints, len(draft.hints))
        self._is_checked, self._is_shown = kept.is_checked, kept.is_shown
        self._digest = "" if draft.scene is None else scene_digest(draft.scene)
        self._begun = monotonic()
        size = size_of(draft)
        self._grid.setVisible(size is not None)
        if size is not None:
            self._grid.show_raster(size, asked.outline, draft.pixel)
            if isinstance(draft.answer, SpotAnswer):
                self._grid.show_picture(picture_of(draft.answer.picture))
            elif (wanted := wanted_picture(question)) is not None:
                self._grid.show_picture(wanted)
        credit = f"{counted(template.points, 'point')}. {draft.answer.credit}"
        record = QuestionRecord(
            template.title, question.mark, draft.text, numbers_of(draft), credit, draft.sketch
        )
        answer = self._view.show_question(record, draft.answer.form)
        answer.answer_changed.connect(self._change)
        answer.stop_requested.connect(self.stop_check)
        if kept.given is not None:
            try:
                answer.show_given(kept.given)
            except (TypeError, ValueError, LookupError):
                self._page.refuse("The answer that was kept is of another form. It is empty now.")
                answer.show_given(None)
        self._history.begin(answer.given())
        self._draw_live()
        self._show_state()
        self._keep()
        self.asked.emit(question)

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        self._page.refuse(f"{error}. The page is unchanged.")
        self.state_changed.emit()

    @Slot()
    def copy_line(self) -> None:
        """Copy the line that gives this question to anybody."""
        if self.question is not None:
            QGuiApplication.clipboard().setText(self.question.mark)
            self._page.tell(f"Copied: {self.question.mark}")

    # Answering.

    @Slot()
    def _change(self) -> None:
        """Take over a change of the answer."""
        assert self._view.answer is not None
        self._history.put(self._view.answer.given())
        self._follow_answer()

    def go_back(self, direction: int) -> None:
        """Take the last change of the answer back (-1), or make it again (1)."""
        question, view = self.question, self._view.answer
        if question is None or view is None or self._is_shown or not self._history.can_go(direction):
            word = "undo" if direction < 0 else "redo"
            self._page.tell(f"There is no change of the answer to {word}.")
        elif question.draft.answer.kind == StepsAnswer.kind:
            self._page.tell("A step that was tried counts. Try it again, or have it put right.")
        else:
            view.show_given(self._history.go(direction))
            self._follow_answer()

    def _follow_answer(self) -> None:
        """Keep the answer at once; what was found of another one does not hold for it."""
        self._has_answer = True
        self.evidence.end_picture()
        self._last.show(self._view)
        self._draw_live()
        self._try()
        self._keep()

    def _try(self) -> None:
        """Find why a listing that is typed cannot run."""
        if self.question is not None and self._view.answer is not None:
            work = trying(self.question.draft, self._view.answer.given())
            if work is not None:
                self._view.show_note("")  # It was about another text.
                self._trying.start(work)

    @Slot(object)
    def _show_tried(self, tried: Tried) -> None:
        view = self._view.answer
        if view is not None and view.given() == tried.given and (said := show_tried(view, tried)):
            self._view.show_note(said)

    def _draw_live(self, name: str = "your answer") -> None:
        """Draw what is shown of an answer while it is given; ``name`` stands at a point of the plane."""
        if self.question is not None and self._view.answer is not None:
            draft, given = self.question.draft, self._view.answer.given()
            if draft.sketch is not None:
                self._view.sketch.show_answer(place_of(draft, given), name)
            work = drawing(self.question, given)
            if work is not None:
                self._drawing.start(work)

    @Slot(object)
    def _show_live(self, live: Live) -> None:
        self._grid.show_geometry(live.outline)
        self._grid.show_picture(live.picture, live.overlays)

    def answer(self, response: Response) -> None:
        """Fill the form with an answer, as if the learner had given it."""
        if self.question is not None and self._view.answer is not None:
            answer = self.question.draft.answer
            self._view.answer.show_given(answer.given(response))
            self._change()

    def _keep(self, **changed: Any) -> None:
        """Keep how far the learner is."""
        if self.question is not None and self._view.answer is not None:
            template = self.question.template
            now: dict[str, Any] = {
                "version": template.version,
                "seed": self.question.seed,
                "given": self._view.answer.given() if self._has_answer else None,
                "hints": self._hints,
                "is_shown": self._is_shown,
                "is_checked": self._is_checked,
            }
            self._unfinished.keep(template, Unfinished(**{**now, **changed}), self.asked_scene)

    @Slot()
    def check(self) -> None:
        """Check the answer; what means nothing yet is not checked and costs nothing."""
        question, view = self.question, self._view.answer
        if question is None or view is None or self._checking.is_running:
            return
        if self._asking.is_running or self._waiting:
            self._page.tell("Not checked: you have chosen another question.")
            return
        if self._exercises.is_reading:  # Only beside those before it is it known whether an attempt counts.
            self._page.tell("Not checked: earlier answers are still being read. Check again.")
            return
        answer, given = question.draft.answer, view.given()
        try:
            if unread := view.unread():
                raise NotCheckedError(unread)
            response = answer.read(given)
        except NotCheckedError as problem:
            self._not_checked(problem)
            return
        left_out = answer.left_out(response)
        if left_out and given != self._left_out:
            self._left_out = given
            self._view.show_not_checked(f"{left_out}. Check anyway? Then choose Check again.")
            return
        self._view.show_note("")
        seconds = monotonic() - self._begun
        self._trying.cancel()  # What the check finds holds.
        self._checking.start(
            checking(question, given, response, self.user, seconds, is_kept=not self._is_shown)
        )

    @Slot(object)
    def _not_checked(self, problem: Exception) -> None:
        """Say why the answer is not checked; of a listing, mark where it cannot run."""
        if not isinstance(problem, NotCheckedError):
            self._refuse(problem)
            return
        if isinstance(problem, CannotRunError) and self._view.answer is not None:
            self._view.answer.show_problem((*problem.place, problem.sentence))
        self._view.show_not_checked(not_checked_text(problem))

    @Slot()
    def stop_check(self) -> None:
        """End a check that runs: nothing is charged."""
        if self._checking.is_running:
            self._checking.cancel()
            self._view.show_not_checked("Not checked: you have stopped it.")

    @Slot(object)
    def _show_checked(self, checked: Checked) -> None:
        """Show marks, points and the mistake."""
        attempt = checked.attempt
        self._last.take(checked)
        self._is_checked = True
        self._last.show(self._view)
        self._show_state()
        self._keep()
        if checked.trouble:
            self._page.refuse(checked.trouble)
        if attempt is not None:
            self.checked.emit(attempt)

    # Help.

    @Slot()
    def show_hint(self) -> None:
        """Show the next hint."""
        if self.question is not None and self._hints < len(self._all_hints()):
            self._hints += 1
            self._show_state()
            self._keep()

    def _all_hints(self) -> tuple[str, ...]:
        assert self.question is not None
        return hints_after(
            self.question.draft, None if self._last.checked is None else self._last.checked.response
        )

    def _show_state(self) -> None:
        """Show the hints so far, and what can be done next."""
        assert self.question is not None
        hints = self._all_hints()
        self._view.show_hints(hints[: self._hints], len(hints))
        self.evidence.follow(
            self.question,
            self._last.checked,
            is_asked=self.is_asked,
            is_shown=self._is_shown,
            is_explained=self._last.is_explained,
        )
        self.state_changed.emit()

    def give_up(self) -> None:
        """Take the question back: the Step page has shown what it asks for."""
        self.after_check(self._give_up)

    def _give_up(self) -> None:
        if self.is_asked:
            self._is_shown = True
            self._show_state()
            self._keep()
            self._page.tell("The Step page shows what was asked for. The question earns nothing any more.")

    @Slot()
    def show_model(self) -> None:
        """Show the right answer, after asking once more while it would end the question; then step the right run."""
        self.after_check(self._show_model)

    def _show_model(self) -> None:
        question, view = self.question, self._view.answer
        if question is None or view is None:
            return
        answer = question.draft.answer
        if self._is_shown:
            self.evidence.step_right()
        elif self.is_asked and not self._is_sure:
            self._is_sure = True
            self._view.show_note(SURE)
        else:
            self._is_shown = True
            self.evidence.end_picture()
            view.show_marks(None)
            view.show_given(answer.given(answer.reference))
            view.set_open(False)
            self._draw_live("model answer")
            self._view.show_note(
                "This is the model answer. Start again gives the question anew; a new variant earns points."
            )
            self._show_state()
            self._keep(given=None)
