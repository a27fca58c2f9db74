"""A | B | difference: the page's run and another one, stepped together."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot

from app.background import is_working
from app.pages.page_bar import Page
from app.pages.step.ab.lock_step import LockStep
from app.pages.step.ab.meeting import Meeting
from app.pages.step.ab.runs import DrawnB, EditedB
from app.pages.step.ab.shown_runs import ShownRuns
from app.pages.step.ab.side_b import SideB, first_difference, settings_difference
from app.pages.step.grid_presenter import VertexDrags
from app.pages.step.inspector_presenter import sentence_at
from app.pages.step.setting_records import settings_records
from app.session.document import Document
from app.session.moment import Cursor, Moment, Step
from app.session.session import Session
from core import Settings, Trace
from core.records.steps import Level
from core.scene import AnyScene
from core.settings import WHOLE_NUMBERS
from widgets.grid.compare_view import CompareView

if TYPE_CHECKING:
    from core.edits.edit import Edit


class ComparePresenter(QObject):
    """Keeps what B is and its run, and shows both runs while the view is open."""

    second_shown = Signal()
    """B is shown where it is now, or that it cannot be shown."""
    look_changed = Signal()
    """B differs otherwise, or another buffer is compared."""

    def __init__(self, session: Session, view: CompareView, page: Page) -> None:
        super().__init__(page)
        self._page = page
        self._session, self._view, self._moment = session, view, session.moment
        self._chosen: SideB | None = None
        """B as it was chosen; ``None``: it follows the stage."""
        self._suggested = SideB()
        """B as it follows the stage."""
        self._shown = ShownRuns(view)
        self._is_active = self._is_held = False
        self._ready: tuple[Document, Trace] | None = None
        """What B may draw, traced before it is wanted."""
        self._second: Trace | None = None
        """The run of B; ``None``: it cannot be drawn, is being drawn, or is not shown."""
        self._steps: LockStep | None = None
        self._refusal = ""
        self._goal: Callable[[], object] | None = None
        """What is done once B is drawn."""
        self.edited, self._drawing = EditedB(self), DrawnB(self)
        self._drawing.drawn.connect(self._take)
        self._drawing.failed.connect(self._refuse)
        self.meeting = Meeting(self, session, page)
        # Only the document's own triangle has handles here.
        self._drags = VertexDrags(
            session, view.linked.grids, lambda: None, session.edit, "drag in A | B", page
        )
        view.setting_chosen.connect(self._choose)
        view.buffer_box.buffer_chosen.connect(self.set_buffer)
        view.reset_requested.connect(self._reset)
        view.swap_requested.connect(self._swap)
        view.use_requested.connect(self._use)
        view.divergence_requested.connect(self.meeting.go_to_divergence)
        view.linked.pixel_hovered.connect(session.hover_place)
        view.linked.pixel_left.connect(session.end_hover)
        view.linked.pixel_clicked.connect(session.pin_place)

    # What B is.

    @property
    def _choice(self) -> SideB | None:
        """What was chosen, if it is a B for the scene that is open."""
        chosen = self._chosen
        return chosen if chosen is not None and chosen.is_beside(self._session.document) else None

    @property
    def b(self) -> SideB:
        """What B is."""
        return self.edited.side or self._choice or self._suggested

    @property
    def other(self) -> Settings:
        """Settings of B: those of the page, but for what it does otherwise."""
        return self.b.document(self._session.document).settings

    @property
    def differences(self) -> Mapping[str, str | int]:
        """What B does otherwise than A, family and value; empty: it follows the stage, or is a run with a mistake."""
        choice = self.edited.side or self._choice
        return {} if choice is None or choice.title else choice.differences

    @property
    def printed(self) -> str:
        """Name of the listing as printed that B runs; empty: none."""
        return self.b.printed

    @property
    def buffer(self) -> str:
        """Name of the buffer in which both are compared in the stage at hand; empty: the first one."""
        return self._shown.buffers.get(self._session.cursor.stage, "")

    @property
    def is_active(self) -> bool:
        """Whether both runs are shown, or would be."""
        return self._is_active

    @property
    def runs(self) -> tuple[Moment, Trace | None]:
        """The moment of A that B stands beside, and the run of B; ``None``: it has none."""
        return self._moment, self._second

    @property
    def second(self) -> Step | None:
        """B where it is; ``None``: it has no run."""
        if self._second is None or self._steps is None:
            return None
        return Step(self._second, replace(self._moment.cursor, position=self._steps.positions[1]))

    def show_printed(self, name: str, *, seeks: bool = True, stays: bool = False) -> None:
        """Let A run the right method, and B a listing as a slide prints it, see `lessons.lectures`.

        Both go to the first step in which they differ, where ``seeks`` is set. Where B ``stays``, it stands beside the
        step that A is at, even if A has no further one. Raises ValueError if the listing does not run in the pipeline,
        or not on this scene.
        """
        # Wanted by few, long after the start.
        from app.session.printed_runs import settings_as_printed, title_as_printed

        mine, other = settings_as_printed(name, self._session.latest)
        if mine != self._session.latest.settings:
            self._session.edit(replace(self._session.latest, settings=mine))
        goal = self.meeting.go_to_other_pixel if seeks else self._put_beside if stays else None
        self._become(SideB(mine.differences(other), title_as_printed(name), name), goal)

    def _put_beside(self) -> None:
        if self._steps is not None:
            self._steps.put_beside()
            self._show()

    def set_differences(self, differences: Mapping[str, str | int]) -> None:
        """Choose what B does otherwise than the page; nothing: something that shows in the stage at hand."""
        mine = self._session.document.settings
        really = mine.differences(replace(mine, **differences))  # type: ignore[arg-type]
        self._become(SideB(really) if differences else None)

    def show_mistake(
        self, differences: Mapping[str, str | int], scene: AnyScene, title: str, *, seeks: bool = True
    ) -> None:
        """Let B make a mistake, in its settings or the scene.

        Both go to the first step in which they differ, where ``seeks`` is set.
        """
        mine = self._session.document.scene
        scenes = None if scene is mine else (mine, scene)
        goal = partial(self.meeting.go_to_divergence, self._session.cursor.stage) if seeks else None
        self._become(SideB(differences, title, scenes=scenes), goal)

    def begin_at(self, pixel: tuple[int, int] | None) -> None:
        """Go to a pixel, or to the first step in which both differ, once B is drawn."""
        stage = self._session.cursor.stage
        self._goal = (
            partial(self.meeting.go_to_divergence, stage)
            if pixel is None
            else partial(self.meeting.meet_at, pixel)
        )
        self.refresh(self._session.moment)

    def begin_anew(self, moment: Moment) -> None:
        """Forget what has no effect in a scene that was opened."""
        self._goal, self._suggested, self._ready = None, SideB(), None
        self._chosen = None if self._chosen is None else self._chosen.opened_beside(moment.document)

    def _become(self, b: SideB | None, goal: Callable[[], object] | None = None) -> None:
        self._chosen, self._goal = b, goal
        if self._session.latest.edits:
            # B is one thing at a time; undo brings the edited listings back.
            self._session.edit(replace(self._session.latest, edits=()))
        self.refresh(self._session.moment)
        self.look_changed.emit()

    def look_only_at(self, stage: str, name: str) -> None:
        """Compare in a buffer while a stage is shown, and in other stages in what shows first; empty: there, too."""
        self._shown.buffers = {stage: name} if name else {}

    @Slot(str)
    def set_buffer(self, name: str) -> None:
        """Compare in another buffer, whenever the stage at hand is shown."""
        self._shown.buffers[self._session.cursor.stage] = name
        self._show()
        self.look_changed.emit()

    @Slot(str, str)
    def _choose(self, family: str, value: str) -> None:
        if value:  # Else the printed listing is still chosen.
            chosen: str | int = int(value) if family in WHOLE_NUMBERS else value
            self.set_differences({**self.b.named(), family: chosen})

    @Slot()
    def _reset(self) -> None:
        self._become(SideB())

    @Slot()
    def _swap(self) -> None:
        mine = self._session.document.settings
        self._edit({family: getattr(mine, family) for family in self.b.differences})

    @Slot()
    def _use(self) -> None:
        said = settings_difference(self._session.document.settings, self.other)
        if self._edit({}) and said:
            self._page.tell(f"The page now uses B: {said}. Ctrl+Z takes it back.")

    def _edit(self, differences: dict[str, str | int]) -> bool:
        """Give the page the settings of B, and B other differences; return whether the page could take them."""
        other, before = self.other, self._chosen
        self._chosen = SideB(differences)
        try:
            self._session.edit(replace(self._session.latest, settings=other))
        except ValueError as error:
            self._chosen = before
            self._page.refuse(str(error))
            return False
        return True

    # The run of B.

    def set_active(self, is_active: bool) -> None:
        """Show both runs from now on, or stop computing the second one."""
        self._is_active = is_active
        self.refresh(self._session.moment)
        if not is_active:
            self._goal = None
        elif self.b.differences:
            self._view.show_family(next(iter(self.b.differences)))

    @contextmanager
    def held(self, ready: tuple[Document, Trace] | None = None) -> Iterator[None]:
        """Do nothing while another scene, another B and another view are chosen, then show both runs once.

        ``ready``: what B draws then, traced before.
        """
        was_active, self._is_held = self._is_active, True
        try:
            yield
        finally:
            self._is_held, self._ready = False, ready
            if self._is_active is was_active:
                self.refresh(self._session.moment)
            else:
                self.set_active(self._is_active)

    def prepare(self, first: Trace, cursor: Cursor, document: Document, second: Trace) -> None:
        """Find what is seen and said of a B that may be shown next, and the settings that it offers."""
        steps = LockStep(first.stage(cursor.stage), second.stage(cursor.stage), cursor)
        beside = replace(cursor, position=steps.positions[1])
        sentence_at(Step(second, beside))
        self._shown.look(first, cursor)
        self._shown.look(second, beside)
        settings_records(document)

    def refresh(self, moment: Moment) -> None:
        """Trace B anew, and show both runs."""
        if self._is_held:
            return
        before, self._moment = self._moment, moment
        self._drawing.cancel()
        self.meeting.cancel()
        kept, self._shown.is_old = (self._second, self._steps), False
        self._second, self._steps, self._refusal = None, None, ""
        document, stage = moment.document, moment.cursor.stage
        refusal = self.edited.find(document)
        if not self._is_active or moment.is_predicting:
            self._show()
            return
        if refusal:
            self._refusal = refusal
            self._show()
            return
        if self._choice is None and self.edited.side is None:
            shown = self._suggested.differences
            self._suggested = SideB(first_difference(document, moment.trace, stage, shown))
        b, other = self.b, self.b.document(document)
        self._view.show_settings(b.shown_settings(document), frozenset(b.differences))
        if (self._choice is None or b.edits) and b.differences:
            self._view.show_family(next(iter(b.differences)))

        if self._ready is not None and self._ready[0].has_run_of(other):
            self._take(self._ready[1])
            return

        if b.edits and (tried := self.edited.run_of(document)) is not None:
            self._take(tried)
            return
        if b.edits and before.trace is moment.trace and before.cursor.stage == stage:
            # The last picture stays until the next one is there.
            self._second, self._steps = kept
        self._drawing.draw(other, stage, is_typed=bool(b.edits))
        if is_working(self._drawing):
            self._refusal = "Drawing B …"
            self._show()

    @Slot(object)
    def _take(self, second: Trace) -> None:
        moment, self._second = self._moment, second
        self._shown.fit(moment, second, self.b)
        self._steps = LockStep(moment.stage_trace, second.stage(moment.cursor.stage), moment.cursor)
        self._show()
        self._reach_goal()

    def reach(self, goal: Callable[[], object]) -> None:
        """Do something as soon as B is drawn."""
        self._goal = goal
        self._reach_goal()

    def _reach_goal(self) -> None:
        if self._goal is not None and self._second is not None:
            goal, self._goal = self._goal, None
            goal()

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        self._goal, self._refusal = None, f"B cannot be drawn: {error}"
        self._second, self._steps = None, None
        self._show()

    # Edited listings.

    def show_begun(self, edit: "Edit | None") -> None:
        """Let B be a copy of A whose listing stands in the editor; ``None``: the editor was left."""
        if edit != self.edited.begun:
            self.edited.begun = edit
            if not self._session.document.edits:
                self.refresh(self._session.moment)

    def try_edit(self, document: Document) -> None:
        """Run the edited listings of a document as B would, see `edited`; what B shows stays till then."""
        self.edited.try_edit(document, self._moment.cursor.stage)

    @property
    def is_drawing(self) -> bool:
        """Whether B is being drawn in the background."""
        return is_working(self._drawing) or is_working(self.edited)

    def cancel_drawing(self) -> None:
        """Draw B no further."""
        self.edited.cancel()
        if is_working(self._drawing):
            self._drawing.cancel()
            self._refusal = "B was stopped."
            self._show()

    def go_to_second(self, position: int) -> None:
        """Put B at a position of the stage at hand, and A beside it."""
        if self._steps is not None:
            self._steps.land_second(position)
            mine, theirs = self._steps.positions
            self._session.go_to(mine)
            self._steps.positions = mine, theirs
            self._show()

    @property
    def refusal(self) -> str:
        """Why B has no picture."""
        return self._refusal

    def edits_sleep(self, document: Document) -> bool:
        """Return whether the scene would pass over all edited listings of a document."""
        return all(edit.passed_over(document.settings, document.scene) for edit in document.edits)

    def show_old(self, is_old: bool) -> None:
        """Say that B is the last run that went well, of a text that is another one by now; or take that back."""
        if is_old != self._shown.is_old:
            self._shown.is_old = is_old
            self._show()

    # Stepping.

    def steps_alone(self, direction: int, level: Level) -> bool:
        """Step B where A has no step beside it in this stage; return whether that was so."""
        is_alone = self._steps is not None and self._steps.step_second(direction, level)
        if is_alone:
            self._show()
        return is_alone

    def follow_step(self, moment: Moment) -> None:
        """Take B along to where A has gone."""
        if self._is_held:
            return
        stage, self._moment = self._moment.cursor.stage, moment
        if not self._is_active:
            return
        if moment.cursor.stage == stage:
            if self._steps is not None:
                self._steps.follow(moment.cursor)
            self._show()
        elif self._second is None or self._choice is None or self.edited.side is not None:
            self.refresh(moment)
        else:
            self._take(self._second)

    def put_at(self, stage: str, mine: int | None, theirs: int | None) -> None:
        """Put both runs just after a row of each; one without a row goes where it is beside the other one."""
        second = self._second
        if second is None or (mine is None and theirs is None):
            return
        # B is what was compared, whatever stage it shows in.
        self._chosen = self._chosen if self.edited.side is not None else self.b
        start = replace(self._moment.cursor, stage=stage, position=0)
        steps = LockStep(self._moment.trace.stage(stage), second.stage(stage), start)
        steps.land(mine, theirs)
        self._session.set_stage(stage, steps.positions[0])
        self._steps = steps
        self._show()

    def _show(self) -> None:
        """Show both runs where they are, and their difference."""
        if self._is_active:
            self._shown.show(self._moment, self.second, self._steps, self.b, self._refusal)
            if not self._moment.is_predicting:
                self.second_shown.emit()

    def refresh_pointing(self, moment: Moment) -> None:
        """Mark pin and hover."""
        if self._is_active:
            self._shown.show_pointing(moment)
