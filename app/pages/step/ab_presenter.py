"""A | B | difference: the page's run and the same one under other settings, stepped together."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot

from app.background.workers import Job, Progress
from app.pages.step.ab_pictures import Place, buffers_at, compare, first_comparable, side_of
from app.pages.step.ab_settings import first_difference, settings_difference
from app.pages.step.grid_presenter import OUTLINING
from app.pages.step.grid_records import geometry_of
from app.pages.step.lock_step import LockStep
from app.pages.step.scene_outline_presenter import settings_records
from app.pages.step.vertex_drags import VertexDrags
from app.session.session import Cursor, Session
from app.session.tracing import QUICK_SECONDS
from core import STAGES, Settings, Trace
from core.methods import ReplacedName
from core.records.steps import Level
from core.scene import AnyScene
from core.settings import WHOLE_NUMBERS
from widgets.basics.settings_panel import SettingChoice
from widgets.grid.compare_view import CompareView, Comparison, Side
from widgets.grid.geometry import GridGeometry

if TYPE_CHECKING:
    from core.study.accuracy.divergence import Divergence  # Looked for long after the window is open.

PREDICTING = "Prediction hides the pictures of A and B. P ends it."
FAULTY = "B is a run with a mistake: the page cannot take it over."


@dataclass(frozen=True, eq=False)
class OtherRun:
    """A run that B is beside one scene: that of a mistake, which may draw something else."""

    of: AnyScene
    """What A draws; beside another scene B is a run of the page again."""
    scene: AnyScene
    """What B draws."""
    title: str


class ComparePresenter(QObject):
    """Keeps the settings, the run and the cursor of B, and shows both runs while the view is open."""

    edit_refused = Signal(str)
    message_sent = Signal(str)
    """What a search has found."""
    look_changed = Signal()
    """B differs otherwise, or another buffer is compared."""

    def __init__(self, session: Session, view: CompareView, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._view = session, view
        self._differences: dict[str, str | int] = {}
        """What B does otherwise than A: family and value."""
        self._is_chosen = False
        """Whether the user has chosen it; else it follows the stage that is shown."""
        self._buffer = ""
        self._is_active = False
        self._second: Trace | None = None
        """The run of B; ``None``: it cannot be drawn, or is being drawn."""
        self._geometry: dict[tuple[Trace, str, int], GridGeometry] = {}
        self._refusal = ""
        self._stage = ""
        self._meeting: tuple[int, int] | None = None
        """The pixel to which both runs go when B is drawn."""
        self._run: OtherRun | None = None
        """The run with a mistake that B is; ``None``: it is one that the settings can name."""
        self._seeks = False
        """Whether both runs go to their first divergence when B is drawn."""
        self._printed = ""
        """Name of the listing as printed that B runs; empty: none."""
        self._steps: LockStep | None = None
        self._job, self._search = Job(self), Job(self)
        self._job.succeeded.connect(self._take)
        self._job.failed.connect(self._refuse)
        self._search.succeeded.connect(self._land)
        self._search.failed.connect(self._tell_no_divergence)
        self._drags = VertexDrags(
            session, view.linked.grids, self._no_triangle, session.edit, "drag in A | B", self
        )
        self._drags.refused.connect(self.edit_refused)
        session.document_changed.connect(self.refresh)
        session.cursor_changed.connect(self._follow)
        session.predicting_changed.connect(self.refresh)
        session.pin_changed.connect(self.refresh_pointing)
        session.hover_changed.connect(self.refresh_pointing)
        view.setting_chosen.connect(self._choose)
        view.buffer_chosen.connect(self.set_buffer)
        view.reset_requested.connect(self._reset)
        view.swap_requested.connect(self._swap)
        view.use_requested.connect(self._use)
        view.divergence_requested.connect(self.go_to_divergence)
        view.pixel_hovered.connect(self._hover)
        view.pixel_left.connect(self._leave)
        view.pixel_clicked.connect(self._pin)

    # What is compared.

    @property
    def other(self) -> Settings:
        """Settings of B: those of the page, but for what it does otherwise."""
        return replace(self._session.document.settings, **self._differences)  # type: ignore[arg-type]

    @property
    def differences(self) -> Mapping[str, str | int]:
        """What B does otherwise than A, family and value; empty: it follows the stage, or is a run with a mistake."""
        return self._differences if self._is_chosen and self._faulty() is None else {}

    def _faulty(self) -> OtherRun | None:
        """Return the run with a mistake that B is beside the scene that is open."""
        return self._run if self._run is not None and self._run.of is self._session.document.scene else None

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
        self.refresh()
        if is_active and self._differences:
            self._view.show_family(next(iter(self._differences)))

    @property
    def printed(self) -> str:
        """Name of the listing as printed that B runs; empty: none."""
        return self._printed if self._faulty() is not None else ""

    def show_printed(self, name: str, *, seeks: bool = True) -> None:
        """Let A run the right method, and B a listing as a slide prints it, see `lessons.printed`.

        Both go to the first step in which they differ, where ``seeks`` is set.

        Raises
        ------
        ValueError
            If the listing does not run in the pipeline, or not on this scene.
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
        self._run, self._seeks, self._printed = run, seeks, printed
        mine = self._session.document.settings
        self._differences = mine.differences(replace(mine, **differences))  # type: ignore[arg-type]
        self._is_chosen = bool(differences) or run is not None
        self.refresh()
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
        named = {name: of for name, of in self._differences.items() if not isinstance(of, ReplacedName)}
        self.set_differences({**named, family: chosen})

    @Slot()
    def _reset(self) -> None:
        self._differences, self._is_chosen, self._run = {}, True, None
        self.refresh()
        self.look_changed.emit()

    @Slot()
    def _swap(self) -> None:
        mine = self._session.document.settings
        self._edit({family: getattr(mine, family) for family in self._differences})

    @Slot()
    def _use(self) -> None:
        said = settings_difference(self._session.document.settings, self.other)
        if self._edit({}) and said:
            self.message_sent.emit(f"The page now uses B: {said}. Ctrl+Z takes it back.")

    def _edit(self, differences: dict[str, str | int]) -> bool:
        """Give the page the settings of B, and B other differences; return whether the page could take them."""
        if self._faulty() is not None:
            self.message_sent.emit(FAULTY)
            return False
        other, before = self.other, (self._differences, self._is_chosen)
        self._differences, self._is_chosen = differences, True
        try:
            self._session.edit(replace(self._session.latest, settings=other))
        except ValueError as error:
            self._differences, self._is_chosen = before
            self.edit_refused.emit(str(error))
            return False
        return True

    # The run of B.

    @Slot()
    def refresh(self) -> None:
        """Trace B anew, and show both runs."""
        if not self._is_active:
            return
        session = self._session
        document, self._stage = session.document, session.cursor.stage
        self._job.cancel()
        self._search.cancel()
        self._steps = None
        if session.is_predicting:
            self._second, self._refusal = None, PREDICTING
            self._show()
            return
        if not self._is_chosen:
            self._differences = first_difference(document, session.trace, self._stage)
        run = self._faulty()
        other = replace(document, settings=self.other, scene=document.scene if run is None else run.scene)
        shown = settings_records(other)
        if self.printed and run is not None:
            label = SettingChoice("", run.title)
            shown = [
                replace(each, choices=(label, *each.choices), current="")
                if each.family in self._differences
                else each
                for each in shown
            ]
        self._view.show_settings(shown, frozenset(self._differences))
        if not self._is_chosen and self._differences:
            self._view.show_family(next(iter(self._differences)))
        self._view.set_pixel_center(document.settings.pixel_center)
        work = partial(_trace, other.make_trace, self._second or session.trace, self._stage)
        if other.estimated_seconds > QUICK_SECONDS:
            self._second, self._refusal = None, "Drawing B …"
            self._show()
            self._job.start(work)
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
            if self._printed and self._land_where_pixels_differ(second):
                return
            self._go_to_mistake(second)

    def _land_where_pixels_differ(self, second: Trace) -> bool:
        """Put both runs at the first step that draws another pixel; return whether there is one."""
        from app.session.printed_run import first_other_pixel

        found = first_other_pixel(self._session.trace.stage("raster"), second.stage("raster"))
        if found is not None:
            rows, said = found
            self._put_at("raster", *rows)
            self.message_sent.emit(f"{said} Ctrl+[ goes back.")
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

    @Slot()
    def _follow(self) -> None:
        """Take B along to where A has gone."""
        cursor = self._session.cursor
        if not self._is_active:
            return
        if cursor.stage == self._stage:
            if self._steps is not None:
                self._steps.follow(cursor.position, cursor.level)
            self._show()
        elif self._second is None or not self._is_chosen:
            self.refresh()
        else:
            self._stage = cursor.stage
            self._take(self._second)

    def _go_to_mistake(self, second: Trace) -> None:
        """Put both runs where they differ first: of other corners, in the stage at hand, since all differ before."""
        from core.study.accuracy.divergence import stage_divergence

        run, found = self._faulty(), None
        if run is not None and run.scene is not run.of:
            found = stage_divergence(self._session.stage_trace, second.stage(self._stage), by_outcome=True)
        if found is None:
            self.go_to_divergence()
        else:
            self._land(found)

    @property
    def is_searching(self) -> bool:
        """Whether the first step that differs is being searched for."""
        return self._search.is_running

    @Slot()
    def go_to_divergence(self) -> None:
        """Search for the first step that differs, in any stage, and put both runs there."""
        from app.pages.step.ab_divergence import search

        if self._second is None:
            self.message_sent.emit(self._refusal or "Show A | B first (Ctrl+D).")
        else:
            self._search.start(partial(search, self._session.trace, self._second))

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
        self.message_sent.emit(said)

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
        self._is_chosen = True
        steps = self._session.trace.stage(stage).steps
        self._session.set_stage(stage, 0 if mine is None else steps.position_after(mine))
        if self._steps is not None and self._second is not None and theirs is not None:
            self._steps.land(self._second.stage(stage).steps.position_after(theirs))
        self._show()

    @Slot(object)
    def _tell_no_divergence(self, error: Exception) -> None:
        self.message_sent.emit(f"A and B cannot be compared: {error}")

    # Showing.

    def _show(self) -> None:
        """Show both runs where they are, and their difference."""
        if not self._is_active:
            return
        session, cursor = self._session, self._session.cursor
        if session.is_predicting:
            blanks = Side("A", "A", reason=PREDICTING), Side("B", "B", reason=PREDICTING)
            self._view.show_comparison(Comparison(*blanks, None, PREDICTING))
            return
        steps, second = self._steps, self._second
        mine, theirs = Place(session.trace, cursor), None
        if steps is not None and second is not None:
            mine = replace(mine, done=steps.done(0), steps=steps.steps(0), waits=steps.waits(0))
            theirs = Place(second, replace(cursor, position=steps.second_position))
            theirs = replace(theirs, done=steps.done(1), steps=steps.steps(1), waits=steps.waits(1))
        buffers = [buffers_at(place) for place in (mine, theirs) if place is not None]
        names = {name: buffer.label for each in reversed(buffers) for name, buffer in each.items()}
        chosen = self._buffer if self._buffer in names else first_comparable(buffers)
        self._view.show_buffers(tuple(names.items()), chosen)
        has_listings = bool(self.printed)
        first = side_of(
            "A",
            "current settings",
            mine,
            self._outlines(mine),
            buffers[0].get(chosen),
            names[chosen],
            has_listings,
        )
        run = self._faulty()
        title = settings_difference(session.document.settings, self.other) or "the same settings"
        title = title if run is None else run.title
        if theirs is None:
            blank = Side("B", f"B: {title}", reason=self._refusal)
            comparison = Comparison(first, blank, None, self._refusal)
        else:
            picture = buffers[1].get(chosen)
            other = side_of("B", title, theirs, self._outlines(theirs), picture, names[chosen], has_listings)
            comparison = compare(first, other)
        self._view.show_comparison(comparison)
        self.refresh_pointing()

    def _outlines(self, place: Place) -> GridGeometry:
        """Return the triangles of a run, made anew only where they change."""
        cursor = place.cursor if place.cursor.stage in OUTLINING else Cursor(STAGES[-1])
        key = place.trace, cursor.stage, cursor.position
        if key not in self._geometry:
            if len(self._geometry) > 2:
                self._geometry.clear()
            self._geometry[key] = geometry_of(
                self._session.document, place.trace, stage=cursor.stage, position=cursor.position
            )
        return self._geometry[key]

    @Slot()
    def refresh_pointing(self) -> None:
        """Mark pin and hover."""
        if self._is_active:
            first_column, first_row, _, _ = self._session.trace.source.raster.bounds
            marks = [
                None if pixel is None else (pixel[0] - first_column, pixel[1] - first_row)
                for pixel in (self._session.pin, self._session.hover)
            ]
            self._view.show_pointing(marks[0], marks[1])

    @staticmethod
    def _no_triangle() -> int | None:
        """Return that only the document's own triangle has handles here."""
        return None

    @Slot(int, int)
    def _hover(self, column: int, row: int) -> None:
        first_column, first_row, _, _ = self._session.trace.source.raster.bounds
        self._session.set_hover((column + first_column, row + first_row))

    @Slot()
    def _leave(self) -> None:
        self._session.set_hover(None)

    @Slot(int, int)
    def _pin(self, column: int, row: int) -> None:
        first_column, first_row, _, _ = self._session.trace.source.raster.bounds
        self._session.set_pin((column + first_column, row + first_row))


def _trace(
    make: Callable[..., Trace],
    earlier: Trace,
    stage: str,
    progress: Progress | None = None,
    is_cancelled: Callable[[], bool] | None = None,
) -> Trace:
    """Trace B up to the stage that is shown."""
    trace = make(earlier=earlier)
    trace.stage(stage)
    return trace
