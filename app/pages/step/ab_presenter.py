"""A | B | difference: the page's run and the same one under other settings, stepped together."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot

from app.background.workers import Job
from app.pages.page_bar import Page
from app.pages.step.ab_choice import BChoice, OtherRun
from app.pages.step.ab_pictures import Outlines, Place, buffers_at, compare, first_comparable, side_of
from app.pages.step.ab_settings import first_difference, settings_difference
from app.pages.step.lock_step import LockStep
from app.pages.step.vertex_drags import VertexDrags
from app.session.moment import Moment
from app.session.session import Session
from app.session.tracing import QUICK_SECONDS
from core import Settings, Trace
from core.records.steps import Level
from core.settings import WHOLE_NUMBERS
from widgets.grid.compare_view import CompareView, Comparison, Side

if TYPE_CHECKING:
    from core.study.accuracy.divergence import Divergence  # Looked for long after the window is open.

PREDICTING = "Prediction hides the pictures of A and B. P ends it."
FAULTY = "B is a run with a mistake: the page cannot take it over."


class ComparePresenter(QObject):
    """Keeps the settings, the run and the cursor of B, and shows both runs while the view is open."""

    look_changed = Signal()
    """B differs otherwise, or another buffer is compared."""

    def __init__(self, session: Session, view: CompareView, page: Page) -> None:
        super().__init__(page)
        self._page = page
        self._session, self._view = session, view
        self._b = BChoice()
        self._buffer = ""
        self._is_active = False
        self._second: Trace | None = None
        """The run of B; ``None``: it cannot be drawn, or is being drawn."""
        self._outlines = Outlines()
        self._refusal = ""
        self._stage = ""
        self._meeting: tuple[int, int] | None = None
        """The pixel to which both runs go when B is drawn."""
        self._seeks = False
        """Whether both runs go to their first divergence when B is drawn."""
        self._steps: LockStep | None = None
        self._job, self._search = Job(self), Job(self)
        self._job.succeeded.connect(self._take)
        self._job.failed.connect(self._refuse)
        self._search.succeeded.connect(self._land)
        self._search.failed.connect(self._tell_no_divergence)
        self._drags = VertexDrags(
            session, view.linked.grids, self._no_triangle, session.edit, "drag in A | B", page
        )
        view.setting_chosen.connect(self._choose)
        view.buffer_chosen.connect(self.set_buffer)
        view.reset_requested.connect(self._reset)
        view.swap_requested.connect(self._swap)
        view.use_requested.connect(self._use)
        view.divergence_requested.connect(self.go_to_divergence)
        view.pixel_hovered.connect(session.hover_place)
        view.pixel_left.connect(session.end_hover)
        view.pixel_clicked.connect(session.pin_place)

    # What is compared.

    @property
    def other(self) -> Settings:
        """Settings of B: those of the page, but for what it does otherwise."""
        return self._b.document(self._session.document).settings

    @property
    def differences(self) -> Mapping[str, str | int]:
        """What B does otherwise than A, family and value; empty: it follows the stage, or is a run with a mistake."""
        return self._b.differences if self._b.is_chosen and not self._is_faulty else {}

    @property
    def _is_faulty(self) -> bool:
        """Whether B is a run with a mistake."""
        return self._b.run_beside(self._session.document) is not None

    @property
    def buffer(self) -> str:
        """Name of the buffer in which both are compared; empty: the first one of the stage."""
        return self._buffer

    @property
    def second_position(self) -> int | None:
        """Where B is in the stage that is shown; ``None``: it has no run."""
        return None if self._steps is None else self._steps.second_position

    def set_active(self, is_active: bool) -> None:
        """Show both runs from now on, or stop computing the second one."""
        self._is_active = is_active
        self.refresh(self._session.moment)
        if is_active and self._b.differences:
            self._view.show_family(next(iter(self._b.differences)))

    @property
    def printed(self) -> str:
        """Name of the listing as printed that B runs; empty: none."""
        return self._b.printed if self._is_faulty else ""

    def show_printed(self, name: str, *, seeks: bool = True) -> None:
        """Let A run the right method, and B a listing as a slide prints it, see `lessons.printed`.

        Both go to the first step in which they differ, where ``seeks`` is set. Raises ValueError if the listing does
        not run in the pipeline, or not on this scene.
        """
        from app.session.printed_run import settings_of, title_of  # Wanted by few, long after the start.

        scene = self._session.latest.scene
        mine, other = settings_of(name, self._session.latest)
        if mine != self._session.latest.settings:
            self._session.edit(replace(self._session.latest, settings=mine))
        self._compare(mine.differences(other), OtherRun(scene, scene, title_of(name)), name, seeks)

    def set_differences(self, differences: Mapping[str, str | int], run: OtherRun | None = None) -> None:
        """Choose what B does otherwise than the page; nothing: something that shows in the stage at hand.

        With the ``run`` of a mistake, both go to the first step in which they differ.
        """
        self._compare(differences, run, "", run is not None)

    def _compare(
        self, differences: Mapping[str, str | int], run: OtherRun | None, printed: str, seeks: bool
    ) -> None:
        self._seeks = seeks
        mine = self._session.document.settings
        really = mine.differences(replace(mine, **differences))  # type: ignore[arg-type]
        self._b = BChoice(really, bool(differences) or run is not None, run, printed)
        self.refresh(self._session.moment)
        self.look_changed.emit()

    @Slot(str)
    def set_buffer(self, name: str) -> None:
        """Compare in another buffer."""
        self._buffer = name
        self._show()
        self.look_changed.emit()

    @Slot(str, str)
    def _choose(self, family: str, value: str) -> None:
        if not value:
            return  # The printed listing is still chosen.
        chosen: str | int = int(value) if family in WHOLE_NUMBERS else value
        self.set_differences({**self._b.named, family: chosen})

    @Slot()
    def _reset(self) -> None:
        self._b = BChoice(is_chosen=True)
        self.refresh(self._session.moment)
        self.look_changed.emit()

    @Slot()
    def _swap(self) -> None:
        mine = self._session.document.settings
        self._edit({family: getattr(mine, family) for family in self._b.differences})

    @Slot()
    def _use(self) -> None:
        said = settings_difference(self._session.document.settings, self.other)
        if self._edit({}) and said:
            self._page.tell(f"The page now uses B: {said}. Ctrl+Z takes it back.")

    def _edit(self, differences: dict[str, str | int]) -> bool:
        """Give the page the settings of B, and B other differences; return whether the page could take them."""
        if self._is_faulty:
            self._page.tell(FAULTY)
            return False
        other, before = self.other, self._b
        self._b = replace(before, differences=differences, is_chosen=True)
        try:
            self._session.edit(replace(self._session.latest, settings=other))
        except ValueError as error:
            self._b = before
            self._page.refuse(str(error))
            return False
        return True

    # The run of B.

    def refresh(self, moment: Moment) -> None:
        """Trace B anew, and show both runs."""
        if not self._is_active:
            return
        document, self._stage = moment.document, moment.cursor.stage
        self._job.cancel()
        self._search.cancel()
        self._steps = None
        if moment.is_predicting:
            self._second, self._refusal = None, PREDICTING
            self._show()
            return
        if not self._b.is_chosen:
            self._b = replace(self._b, differences=first_difference(document, moment.trace, self._stage))
        b, other = self._b, self._b.document(document)
        self._view.show_settings(b.shown_settings(document), frozenset(b.differences))
        if not b.is_chosen and b.differences:
            self._view.show_family(next(iter(b.differences)))
        self._view.set_pixel_center(document.settings.pixel_center)
        earlier, stage = self._second or moment.trace, self._stage

        def work() -> Trace:
            """Trace B up to the stage that is shown."""
            trace = other.make_trace(earlier=earlier)
            trace.stage(stage)
            return trace

        if other.estimated_seconds > QUICK_SECONDS:
            self._second, self._refusal = None, "Drawing B …"
            self._show()
            self._job.call(work)
            return
        try:
            self._take(work())
        except ValueError as error:
            self._refuse(error)

    @Slot(object)
    def _take(self, second: Trace) -> None:
        session, self._second, self._refusal = self._session, second, ""
        mine, theirs = session.stage_trace.steps, second.stage(self._stage).steps
        self._steps = LockStep(mine, theirs, session.cursor.position, session.cursor.level)
        self._show()
        self._meet(second)
        if self._seeks:
            self._seeks = False
            if self._b.printed and self._land_where_pixels_differ(second):
                return
            self._go_to_mistake(second)

    def _land_where_pixels_differ(self, second: Trace) -> bool:
        """Put both runs at the first step that draws another pixel; return whether there is one."""
        from app.session.printed_run import first_other_pixel

        found = first_other_pixel(self._session.trace.stage("raster"), second.stage("raster"))
        if found is not None:
            rows, said = found
            self._put_at("raster", *rows)
            self._page.tell(f"{said} Ctrl+[ goes back.")
        return found is not None

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        self._second, self._refusal = None, f"B cannot be drawn: {error}"
        self._show()

    def stop(self) -> None:
        """End drawing in the background."""
        self._job.shut_down()
        self._search.shut_down()

    # Stepping.

    def steps_alone(self, direction: int, level: Level) -> bool:
        """Step B where A has no more steps in this stage; return whether that was so."""
        is_alone = self._is_active and self._steps is not None and self._steps.step_second(direction, level)
        if is_alone:
            self._show()
        return is_alone

    def follow_step(self, moment: Moment) -> None:
        """Take B along to where A has gone."""
        cursor = moment.cursor
        if not self._is_active:
            return
        if cursor.stage == self._stage:
            if self._steps is not None:
                self._steps.follow(cursor.position, cursor.level)
            self._show()
        elif self._second is None or not self._b.is_chosen:
            self.refresh(moment)
        else:
            self._stage = cursor.stage
            self._take(self._second)

    def _go_to_mistake(self, second: Trace) -> None:
        """Put both runs where they differ first from the stage at hand on, or else in any stage."""
        from core.study.accuracy.divergence import diverge, stage_divergence

        found = stage_divergence(self._session.stage_trace, second.stage(self._stage), by_outcome=True)
        if found is not None:
            self._land(found)
        else:
            first, stage = self._session.trace, self._stage
            self._search.call(
                lambda: (
                    diverge(first, second, by_outcome=True, since=stage)
                    or diverge(first, second, by_outcome=True)
                )
            )

    @Slot()
    def go_to_divergence(self) -> None:
        """Search for the first step that differs, in any stage, and put both runs there."""
        from core.study.accuracy.divergence import diverge

        if self._second is None:
            self._page.tell(self._refusal or "Show A | B first (Ctrl+D).")
        else:
            self._search.call(partial(diverge, self._session.trace, self._second, by_outcome=True))

    @Slot(object)
    def _land(self, found: "Divergence | None") -> None:
        from app.pages.step.ab_divergence import report

        if self._second is None:
            return
        said = report(found, self._session.trace, self._second)
        if found is not None:
            if found.pixel is not None:
                self._session.set_pin(found.pixel)
            self._put_at(found.stage, *found.rows)
        self._page.tell(said)

    def meet_at(self, pixel: tuple[int, int]) -> None:
        """Put both runs at the first step about a pixel in which they differ, or else at the first one about it."""
        self._meeting = pixel
        if self._second is not None:
            self._meet(self._second)

    def _meet(self, second: Trace) -> None:
        pixel, self._meeting = self._meeting, None
        if pixel is None:
            return
        from app.pages.step.ab_divergence import rows_about

        self._put_at(self._stage, *rows_about(self._session.stage_trace, second.stage(self._stage), pixel))

    def _put_at(self, stage: str, mine: int | None, theirs: int | None) -> None:
        """Put both runs just after a row of each; a run without one stays at its start."""
        # B is what was compared, whatever stage it shows in.
        self._b = replace(self._b, is_chosen=True)
        steps = self._session.trace.stage(stage).steps
        self._session.set_stage(stage, 0 if mine is None else steps.position_after(mine))
        if self._steps is not None and self._second is not None and theirs is not None:
            self._steps.land(self._second.stage(stage).steps.position_after(theirs))
        self._show()

    @Slot(object)
    def _tell_no_divergence(self, error: Exception) -> None:
        self._page.tell(f"A and B cannot be compared: {error}")

    # Showing.

    def _show(self) -> None:
        """Show both runs where they are, and their difference."""
        if not self._is_active:
            return
        moment, cursor = self._session.moment, self._session.cursor
        if moment.is_predicting:
            blanks = Side("A", "A", reason=PREDICTING), Side("B", "B", reason=PREDICTING)
            self._view.show_comparison(Comparison(*blanks, None, PREDICTING))
            return
        steps, second = self._steps, self._second
        mine, theirs = Place(moment.trace, cursor), None
        if steps is not None and second is not None:
            theirs = Place(second, replace(cursor, position=steps.second_position))
            mine, theirs = (
                replace(place, done=steps.done(k), step_count=steps.steps(k), waits=steps.waits(k))
                for k, place in enumerate((mine, theirs))
            )
        buffers = [buffers_at(place) for place in (mine, theirs) if place is not None]
        names = {name: buffer.label for each in reversed(buffers) for name, buffer in each.items()}
        chosen = self._buffer if self._buffer in names else first_comparable(buffers)
        self._view.show_buffers(tuple(names.items()), chosen)

        def side(name: str, title: str, place: Place) -> Side:
            buffer = buffers[name == "B"].get(chosen)
            geometry = self._outlines.of(place)
            return side_of(name, title, place, geometry, buffer, names[chosen], bool(self.printed))

        first, title = side("A", "current settings", mine), self._b.title(moment.document)
        if theirs is None:
            blank = Side("B", f"B: {title}", reason=self._refusal)
            comparison = Comparison(first, blank, None, self._refusal)
        else:
            comparison = compare(first, side("B", title, theirs))
        self._view.show_comparison(comparison)
        self.refresh_pointing(moment)

    def refresh_pointing(self, moment: Moment) -> None:
        """Mark pin and hover."""
        if self._is_active:
            self._view.show_pointing(*moment.pointed_places)

    @staticmethod
    def _no_triangle() -> int | None:
        """Return that only the document's own triangle has handles here."""
        return None
