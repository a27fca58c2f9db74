"""One step of a lesson in its pane: what it asks or wants done, what the learner does, and what refutes it."""

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, Qt, Signal, Slot
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QLineEdit, QWidget

from app.background import is_working
from app.pages.lessons.question import RIGHT, SHOWN, JudgedAnswer, LessonAnswers
from app.pages.lessons.states import PANES, LessonStates, LessonWatch, OpenState, Wanted, paragraphs
from app.pages.step.ab.side_b import settings_difference
from app.session.moment import Change
from core import STAGES
from core.scene import ClipScene
from lessons.course.record import StepPart
from lessons.course.state import State, States, edited_shader, wanted_settings
from lessons.mistakes.shelf import SHELF
from lessons.scene_edits import scene_digest
from widgets.basics.accessibility import first_stop, give_focus
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.records import LessonFeedback, LessonStepRecord, Standing
from widgets.grid.pixel_grid import PixelGrid
from widgets.lessons.lesson_scroll import LessonScroll
from widgets.lessons.lesson_view import LessonView

if TYPE_CHECKING:
    from app.pages.step.page import StepPage


# What shows why an answer is wrong: the step that refutes it, or the run with its mistake beside the right
# one.


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
        page.comparing.meeting.meet_at(state.pixel)
        page.tell("")


# One step of a lesson in its pane: what it asks or wants done, what the learner does, and what is shown for
# it.


DONE = "Done."
DONE_BEFORE = "You had done it. What is open now no longer does it."
PEEKED = "You have stepped on. An answer counts as seen now."
NO_PICTURE = "This question needs no picture."
ONE_WAY = "This is one way to do it"
SHOW_ME, REVEAL = "Show me", "Reveal"


class LessonTask(QObject):
    """The pane of a lesson, and the step that is shown in it."""

    standing_changed = Signal(object)
    """The `Standing` that the step has now, if it had a lower one."""
    ended = Signal(float, object)
    """Score of an answer or a task, and the `JudgedAnswer`, or ``None``."""
    left = Signal()
    """Something else was opened."""

    def __init__(self, page: "StepPage") -> None:
        super().__init__(page)
        self._page, self._session = page, page.session
        self.grid = MarkGrid(page)
        self.grid.hide()
        self.grid.installEventFilter(self)
        self._blank = PixelGrid(page)
        """Stands for the picture of an exercise that has none: that of the first step would contradict it."""
        self._blank.empty_text = NO_PICTURE
        self._blank.hide()
        self.view = LessonView(self.grid, page)
        self.scroll = LessonScroll(self.view, self.view.bar, page)
        self.states = LessonStates(page)
        self.answers = LessonAnswers(self.view, self.grid, self)
        self._watch = LessonWatch(page.session, self)
        self._part: StepPart | None = None
        """The step as its file has it; ``None``: what comes before the first one, or the end."""
        self._number = 0
        self._made: States | None = None
        self._home: OpenState | None = None
        """Where the step began; ``None``: no lesson is open."""
        self._is_showing = self._has_peeked = self._is_revealed = self._is_done = False
        self.view.reveal_requested.connect(self.reveal)
        self.view.link_chosen.connect(self._take_measured)
        # Queued: it has its place then.
        self.view.feedback_shown.connect(self._show_feedback, Qt.ConnectionType.QueuedConnection)
        self.answers.judged.connect(self._take_judged)
        self._watch.done.connect(self._take_done)
        self._watch.undone.connect(self._take_undone)
        self._watch.tried.connect(self._take_tried)
        page.grid.view_changed.connect(self.grid.set_view)
        self._session.changed.connect(self._follow)

    @property
    def is_working(self) -> bool:
        """Whether a state is being traced, or an answer or a task is being looked at."""
        return self.states.is_working or is_working(self)

    def begin(
        self,
        part: StepPart | None,
        number: int,
        made: States,
        shown: OpenState,
        record: LessonStepRecord,
        *,
        is_hidden: bool,
    ) -> None:
        """Show a step: its state, its text, and the form of its answer; ``is_hidden``: nothing of what comes after."""
        page, asked = self._page, shown.asked
        self._part, self._number, self._made, self._home = part, number, made, shown
        self.answers.end()
        self._watch.end()
        self._has_peeked = self._is_revealed = self._is_done = False
        with page.laid_out_once():
            if page.predicting.is_active:
                page.set_predicting(False)
            page.tell("")  # What was said of the step before no longer holds.
            panes = (*PANES, *shown.state.panes)
            kept = [name for name in page.desk_panes() if name in panes]
            if kept != page.desk_panes():
                page.show_desk_panes(kept)  # What goes need not show the new state first.
            page.settings_panel.show_wanted(wanted_settings(part, panes))
            self._show(shown, is_hidden=is_hidden, panes=panes)
            if stage := "" if part is None else edited_shader(part):
                page.shader_pane.show_source(stage)
            page.column.fold_listing("listing" not in shown.state.panes)
            self.scroll.keep_in_sight(None)
            self.view.show_step(record, None if asked is None else asked.question.draft.answer.form)
            self.view.reveal_button.setText(REVEAL)
            self.view.offer_solution(self._has_solution())
            page.side.let_inspector_give_way(asked is not None and shown.cursor.position == 0)
            if asked is not None:
                self.answers.begin(asked)
            picture = None if asked is None or asked.number >= 0 else self._blank
            page.main_area.show_asked(self.grid if asked is not None and asked.is_on_picture else picture)
            if part is not None and part.until is not None:
                self._watch.begin(part.until)
            elif part is not None and asked is None and not part.show:
                self.standing_changed.emit(Standing.DONE)
            self._give_keyboard()

    def end(self) -> None:
        """Ask nothing and hide nothing any more; what is open stays."""
        self._home = self._part = None
        self._page.settings_panel.show_wanted({})
        self.states.forget()
        self.answers.end()
        self._watch.end()
        self._page.main_area.gives_room = False
        self._page.main_area.show_asked(None)
        self._page.column.fold_listing(False)
        self._session.set_asked("", is_open=False, by="lesson")
        self._session.set_predicting(False)

    # Showing.

    def _show(self, shown: OpenState, *, is_hidden: bool, panes: Sequence[str] = ()) -> None:
        """Show a state, as the lesson's own doing, beside its ``panes``; none: those that are there."""
        self._is_showing = True
        digest = scene_digest(shown.document.scene) if is_hidden else ""
        self._session.set_asked(digest, is_open=is_hidden, by="lesson")
        self._page.main_area.gives_room = is_hidden
        self.states.show(shown, is_hidden=is_hidden, panes=panes)
        self._is_showing = False
        self._show_away()

    @Slot()
    def _show_feedback(self) -> None:
        """Bring what is said of a task into sight, where the pane scrolls."""
        self.scroll.keep_in_sight(self.view.feedback)

    def answer_stop(self) -> QWidget | None:
        """Return what takes the answer by keyboard; ``None``: no question is open."""
        asked = None if self._home is None else self._home.asked
        if asked is None or not self.answers.is_open:
            return None
        answer = self.view.answer
        return self.grid if asked.is_on_picture else first_stop([] if answer is None else [answer])

    def _give_keyboard(self) -> None:
        """Let the next key answer: a digit would go to a stage else. A clicker's keys are nobody's."""
        page, focused = self._page, QApplication.focusWidget()
        if page.is_presenting or not page.isVisible():
            return
        by_mouse = QApplication.mouseButtons() != Qt.MouseButton.NoButton
        reason = Qt.FocusReason.MouseFocusReason if by_mouse else Qt.FocusReason.TabFocusReason
        if (stop := self.answer_stop()) is not None:
            give_focus(stop, reason)
        elif focused is None or focused is self.grid or self.view.is_of_answer(focused):
            page.take_focus()

    def _show_away(self) -> None:
        """Say whether the learner has left where the step began, and show a step where there is one."""
        home, session = self._home, self._session
        shows_listing = home is not None and "listing" in home.state.panes
        self._page.side.set_idle(not (shows_listing or self._is_about_a_step()))
        is_there = home is not None and session.document is home.document and session.cursor == home.cursor
        self.view.show_away(not is_there)

    def _is_about_a_step(self) -> bool:
        """Return whether the step that is done is to be read: not before the first, nor beside a listing that is typed.

        Where all triangles are covered, and at the end of the run, the whole picture is looked at, not the last pixel.
        """
        cursor, asked = self._session.cursor, None if self._home is None else self._home.asked
        if cursor.position == 0 or (asked is not None and asked.is_typed):
            return False
        has_triangles = self._session.document.scene.corner_count == 3
        is_picture = cursor.stage == STAGES[-1] or (cursor.stage == "raster" and has_triangles)
        return not is_picture or cursor.position < self._session.stage_trace.steps.count

    # What the learner does.

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Check with Return on the picture, as in the pane."""
        if not isinstance(event, QKeyEvent) or event.type() != QEvent.Type.KeyPress or event.modifiers():
            return False
        is_return = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        if is_return:
            self.answers.check()
        return is_return

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        """Follow what is done outside of the pane."""
        if self._home is None or self._is_showing:
            return
        if Change.OPENED in what and Change.RETURNED not in what:
            self.left.emit()
            return
        if self.answers.is_open and not self._session.is_predicting and not self._is_revealed:
            self._show_right()
        elif self.answers.is_open and Change.CURSOR in what and self._is_ahead() and not self._has_peeked:
            self._has_peeked = True
            self._page.tell(PEEKED)
        self._show_away()

    def _is_ahead(self) -> bool:
        """Return whether the cursor has gone beyond where the question is asked."""
        assert self._home is not None
        here, there = self._session.cursor, self._home.cursor
        places = [(STAGES.index(cursor.stage), cursor.position) for cursor in (here, there)]
        return places[0] > places[1]

    @Slot(object)
    def _take_judged(self, judged: JudgedAnswer) -> None:
        """Go on after an answer."""
        is_right, is_first = judged.outcome.is_right, not (self._has_peeked or self._is_revealed)
        if is_right:
            self.standing_changed.emit(Standing.DONE if is_first else Standing.SEEN)
            self._conclude(RIGHT, is_right=True)
        else:
            self.view.reveal_button.setText(SHOW_ME if self._has_evidence() else REVEAL)
        if self._page.is_presenting and isinstance(QApplication.focusWidget(), QLineEdit):
            self._page.take_focus()  # A clicker's period is for the screen again; a digit comes back to the field.
        self.ended.emit(float(is_right and is_first), judged)

    @Slot()
    def _take_done(self) -> None:
        """Say at once that a task is done."""
        self._is_done = True
        self.view.offer_solution(False)
        self._conclude_task(DONE, is_right=True)

    @Slot()
    def _take_undone(self) -> None:
        """Say at once that it is done no longer; the step stays done."""
        self.view.show_feedback(LessonFeedback((DONE_BEFORE,)))

    @Slot(str)
    def _take_tried(self, unmet: str) -> None:
        """Say what a task lacks that was never done in this visit."""
        if not self._is_done:
            self.view.show_hint(unmet)

    @Slot()
    def _take_measured(self) -> None:
        """Say what is to be seen where a step has led."""
        if self._part is not None and self._part.show:
            self._conclude_task("", is_right=None)

    def _conclude_task(self, said: str, is_right: bool | None) -> None:
        after = "" if self._part is None else paragraphs(self._part.after)
        self.standing_changed.emit(Standing.DONE)
        self.view.show_feedback(LessonFeedback(tuple(filter(None, (said, after))), is_right=is_right))
        self.ended.emit(1.0, None)

    def _has_evidence(self) -> bool:
        """Return whether the step or the run that refutes the last answer is offered."""
        judged, step = self.answers.last, self._part
        if judged is None or step is None or self._is_revealed or not self.answers.is_evidence_wanted:
            return False
        return has_refuting_step(judged, step) or bool(mistake_of(judged))

    def _has_solution(self) -> bool:
        """Return whether there is a task whose recorded solution can be shown."""
        is_open = not (self._is_done or self._is_revealed)
        return is_open and self._part is not None and self._part.solution is not None

    @property
    def is_unsolved(self) -> bool:
        """Whether an answer is wanted, or a task is still to be done: that can be revealed."""
        return self.answers.is_open or self._has_solution()

    @property
    def shows_solution(self) -> bool:
        """Whether the answer, or the finished task, is in sight."""
        return not self.is_unsolved and (self._is_done or self._is_revealed or self.answers.asked is not None)

    @Slot()
    def reveal(self) -> None:
        """Show what refutes the last answer, where that is offered, or else what is right, or the solution."""
        if self._has_evidence():
            self._is_revealed = True
            self.standing_changed.emit(Standing.SEEN)
            self.view.reveal_button.setText(REVEAL)
            self._refute()
        elif self.answers.is_open:
            self._show_right()
        elif self._has_solution() and self._made is not None:
            self._is_revealed = True
            self._watch.end()
            self.view.offer_solution(False)
            self.states.want(partial(_solved, self._made, self._number), self._show_solved)

    def _show_solved(self, shown: OpenState) -> None:
        """Show a task as the recorded solution does it: the step is seen, not done."""
        home = self._home
        assert self._part is not None
        assert home is not None
        # A class does not see the Methods pane, in which they are chosen.
        chosen = settings_difference(home.document.settings, shown.document.settings)
        self._show(shown, is_hidden=False)
        self.standing_changed.emit(Standing.SEEN)
        one_way = f"{ONE_WAY} ({chosen})." if chosen else f"{ONE_WAY}."
        said = filter(None, (one_way, paragraphs(self._part.after)))
        self.view.show_feedback(LessonFeedback(tuple(said)))
        self.ended.emit(0.0, None)

    def _refute(self) -> None:
        judged, step, states, home = self.answers.last, self._part, self._made, self._home
        assert judged is not None
        assert step is not None
        assert states is not None
        assert home is not None
        if has_refuting_step(judged, step):
            self.states.want(
                partial(_refuting, states, self._number, judged.outcome.wrong), self._show_revealed
            )
        else:
            self._show_revealed(home)
            show_mistake(self._page, home.state, mistake_of(judged))

    def _show_right(self) -> None:
        """Show what is right: the step is seen, not done."""
        self.answers.show_right()
        self.standing_changed.emit(Standing.SEEN)
        self._conclude(SHOWN, is_right=None)
        self.ended.emit(0.0, None)

    def _conclude(self, said: str, is_right: bool | None) -> None:
        """Show what comes after the answer."""
        step, asked, states, home = self._part, self.answers.asked, self._made, self._home
        assert asked is not None
        assert home is not None
        after = paragraphs(asked.question.draft.reveal)
        self.view.show_feedback(LessonFeedback((said, *filter(None, [after])), is_right=is_right))
        self._give_keyboard()
        if step is not None and step.reveal is not None and states is not None:
            self.states.want(partial(_revealed, states, self._number), self._show_revealed)
        elif step is not None:
            self._show_revealed(home, keeps_picture=asked.is_on_picture)

    def _show_revealed(self, shown: OpenState, *, keeps_picture: bool = False) -> None:
        """Show the state of the answer; marks on a picture stay in sight where there is no other to be seen."""
        self._page.tell("")
        self._show(shown, is_hidden=False)
        self._page.side.let_inspector_give_way(False)
        if not keeps_picture:
            self._page.main_area.show_asked(None)


def _revealed(states: States, number: int) -> Wanted:
    state = states.of_reveal(number)
    assert state is not None
    return state, None


def _solved(states: States, number: int) -> Wanted:
    return states.of_solution(number), None


def _refuting(states: States, number: int, wrong: int | None) -> Wanted:
    assert wrong is not None
    state = states.of_wrong(number, wrong)
    assert state is not None
    return state, None
