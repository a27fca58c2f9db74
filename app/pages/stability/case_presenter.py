"""What a click on a cell opens: its run once more, its picture, the smallest scene that fails, and the stepper."""

from dataclasses import replace

from PySide6.QtCore import QObject, Slot

from app.pages.page_bar import Page, StepRequest
from app.pages.stability.format_probe_words import dial_rows, dial_sentence
from app.pages.stability.jobs import CaseFound, CaseOrder, ShrunkFound, StabilityJobs, wanted_cover
from app.pages.stability.presenter import StabilityPresenter
from app.pages.stability.records import (
    case_record,
    first_failure,
    has_formats,
    method_titles,
    place_on_curve,
    place_sentence,
    shrunk_record,
    values_at,
)
from core.scene import ClipScene
from core.study import Opening
from core.study.stability.coverage.dial_pixel import PixelInFormats
from core.study.stability.open_scene import NAME as OPEN_SCENE
from widgets.atlas.case_view import CaseView
from widgets.atlas.records import CellPlace
from widgets.atlas.view import AtlasView
from widgets.charts.chart import Chart
from widgets.charts.legend import ChartLegend

DIAL = "precision-dial"
"""The experiment that is about number formats itself."""


class StabilityCasePresenter(QObject):
    """Keeps the case of the chosen cell and what it was shrunk to."""

    def __init__(
        self,
        results: StabilityPresenter,
        jobs: StabilityJobs,
        maps: AtlasView,
        curves: tuple[Chart, ChartLegend],
        view: CaseView,
        page: Page,
    ) -> None:
        super().__init__(page)
        self._page = page
        self._results, self._jobs, self._view = results, jobs, view
        self._found: CaseFound | None = None
        self._shrunk: ShrunkFound | None = None
        self._steps_when_found = False
        maps.cell_chosen.connect(self.choose)
        maps.cell_opened.connect(self._open)
        curves[0].point_chosen.connect(self._choose_on_curve)
        curves[1].series_chosen.connect(self.choose_failure)
        results.shown_changed.connect(self._show_again)
        jobs.looking.succeeded.connect(self._show_case)
        jobs.looking.failed.connect(self._show_failure)
        jobs.shrinking.succeeded.connect(self._show_shrunk)
        jobs.shrinking.failed.connect(self._tell_no_shrinking)
        jobs.reading.succeeded.connect(self._show_dial)
        jobs.reading.failed.connect(self._tell_no_dial)
        view.pixel_pinned.connect(self._read_dial)
        view.step_requested.connect(self.step)
        view.shrink_requested.connect(self.shrink)
        view.closing_requested.connect(self.close)
        view.hide()

    @property
    def found(self) -> CaseFound | None:
        """The case that is shown."""
        return self._found

    @property
    def shrunk(self) -> ShrunkFound | None:
        """The case made small, if that is what is shown."""
        return self._shrunk

    @Slot(object)
    def choose(self, place: CellPlace) -> None:
        """Run the cell once more and show it."""
        self._results.choose(place)
        self._found = self._shrunk = None
        self._steps_when_found = False
        experiment, info = self._results.choice.experiment, self._results.info
        values = values_at(info, place)
        heading = f"{method_titles((*info.methods, place.key))[place.key]} at {place_sentence(info, values)}"
        self._view.show()
        if experiment is None:
            self._view.show_waiting(heading, _no_experiment(info.name))
        elif place.key not in experiment.info.methods:
            self._view.show_waiting(heading, "This version has no such method: the case cannot be run.")
        else:
            self._view.show_waiting(heading, "Running …")
            self._jobs.look(CaseOrder(experiment, place, values, self._results.seed()))

    @Slot(str, int)
    def _choose_on_curve(self, method: str, index: int) -> None:
        self.choose(place_on_curve(self._results.info, method, index))

    @Slot(str, bool)
    def choose_failure(self, method: str) -> None:
        """Show the first cell, row by row, at which a method fails."""
        place = first_failure(self._results.cells, method)
        if place is None:
            self._page.tell(f"No cell of {method} fails here.")
        else:
            self.choose(place)

    @Slot(object)
    def _open(self, place: CellPlace) -> None:
        """Open a cell in the stepper, as soon as it has been run."""
        if self._found is not None and self._found.order.place == place:
            self.step()
            return
        if self._results.choice.chosen != place:
            self.choose(place)
        self._steps_when_found = True

    @Slot()
    def close(self) -> None:
        """Close the case and choose no cell."""
        self._jobs.stop_looking()
        self._found = self._shrunk = None
        self._results.choose(None)
        self._view.hide()

    def dismiss(self) -> bool:
        """Close the case; return whether there was one."""
        is_open = self._results.choice.chosen is not None
        self.close()
        return is_open

    @Slot()
    def _show_again(self) -> None:
        """Show the case of the cell that was chosen of this experiment before."""
        chosen = self._results.choice.chosen
        if chosen is None or not self._results.is_shown(chosen):
            self.close()
        elif not self._is_shown_already(chosen):
            self.choose(chosen)

    def _is_shown_already(self, place: CellPlace) -> bool:
        """Return whether the case that is shown is of this very run: a grid that is finished changes nothing."""
        if self._found is None:
            return False
        order, values = self._found.order, values_at(self._results.info, place)
        here = (self._results.choice.experiment, place, values, self._results.seed())
        return (order.experiment, order.place, order.values, order.seed) == here

    @Slot(object)
    def _show_case(self, found: CaseFound) -> None:
        self._found = found
        self._view.show_case(case_record(found))
        self._view.show_tab("formats" if found.order.experiment.info.name == DIAL else "pictures")
        self._dial_pinned()
        if self._steps_when_found:
            self._steps_when_found = False
            self.step()

    @Slot(object)
    def _show_failure(self, error: Exception) -> None:
        self._view.show_waiting("This cell", f"It cannot be run: {error}")

    # The precision dial.

    def _dial_pinned(self) -> None:
        self._view.show_formats("", ())
        if self._view.pin is not None:
            self._read_dial(*self._view.pin)

    @Slot(int, int)
    def _read_dial(self, column: int, row: int) -> None:
        """Look at a pixel in every number format, where the case is triangles in clip space."""
        if self._found is None:
            return
        opening = self._found.opening if self._shrunk is None else self._shrunk.shrunk.opening
        if opening is not None and has_formats(opening) and isinstance(opening.scene, ClipScene):
            wanted = wanted_cover(self._found.order.experiment, is_part=self._shrunk is not None)
            self._jobs.read_dial(opening.scene, opening.settings, (column, row), wanted)

    @Slot(object)
    def _show_dial(self, found: PixelInFormats) -> None:
        if self._found is not None:
            self._view.show_formats(dial_sentence(found, self._found.order.place.key), dial_rows(found))

    @Slot(object)
    def _tell_no_dial(self, error: Exception) -> None:
        self._page.refuse(f"The pixel could not be tested in every number format: {error}")

    # To the stepper.

    @Slot()
    def step(self) -> None:
        """Open the case that is shown on the Step page, at the pinned pixel."""
        if self._found is None:
            self._page.tell("Click a cell first: its run opens in the stepper.")
            return
        opening: Opening | None = self._found.opening
        title = f"{self._found.order.experiment.info.title}: {self._found.order.place.key}"
        if self._shrunk is not None:
            opening, title = self._shrunk.shrunk.opening, f"{title}, smallest case"
        if opening is None:
            self._page.tell("This run cannot be stepped: it is not a stage of the pipeline.")
            return
        if self._view.pin is not None:
            opening = replace(opening, pixel=self._view.pin)
        self._page.step_to(StepRequest(opening, title))

    # Shrinking.

    @Slot()
    def shrink(self) -> None:
        """Make the case small."""
        found = self._found
        if found is None or not case_record(found).can_shrink:
            self._page.tell("Only a failing cell can be shrunk.")
            return
        self._view.show_waiting("Shrinking …", "Removing parts, pixels and digits while it still fails.")
        self._jobs.shrink(found.order)

    @Slot(object)
    def _show_shrunk(self, shrunk: ShrunkFound) -> None:
        if self._found is not None and self._found.order is shrunk.order:
            self._shrunk = shrunk
            self._view.show_case(shrunk_record(shrunk))
            self._dial_pinned()

    @Slot(object)
    def _tell_no_shrinking(self, error: Exception) -> None:
        if self._found is not None:
            self._view.show_case(case_record(self._found))
        self._page.refuse(f"The case could not be shrunk: {error}")


def _no_experiment(name: str) -> str:
    """Return why a cell of a saved atlas cannot be run."""
    if name == OPEN_SCENE:
        return "An atlas is saved without its scene. Open that scene and run the experiment to see its cases."
    return "This version has no such experiment: the case cannot be run."
