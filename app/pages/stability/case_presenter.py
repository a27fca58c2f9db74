"""What a click on a cell opens: its run once more, the smallest scene that fails, and one pixel in every format."""

from dataclasses import replace
from functools import partial

from PySide6.QtCore import QObject, Slot

from app.background import Job
from app.pages.page_bar import Page, StepRequest
from app.pages.stability.jobs import CaseFound, CaseOrder, run_case, shrink_case, wanted_cover
from app.pages.stability.records import case_record, has_formats, is_failure
from core.coverage.measured_formats import FormatAtPixel, PixelInFormats, pixel_in_formats
from core.coverage.measured_pixel import DialReading
from core.explain.number_text import number_text
from core.records.words import numbered
from core.scene import ClipScene
from core.study.record import StudyCancelledError
from widgets.experiments.case_pictures import CaseView, DialRow

# One pixel in every number format, in words: the rows of the table, and the sentence above it.


def dial_sentence(found: PixelInFormats, run: str) -> str:
    """Return which pixel and which triangles the table is about, and what the run itself makes of them.

    Parameters
    ----------
    run : str
        The method of the run, ``coverage=float32``.
    """
    column, row = found.pixel
    triangles = numbered("triangle", found.triangles)
    if found.is_touched:
        more = f" and {found.left_out:,} more" if found.left_out else ""
        who = f"{triangles}{more}"
    else:
        who = f"not covered in any format, nearest {triangles}"
    if found.run_count is None:
        said = f"{run} does not take the scene"
    else:
        said = f"{times(found.run_count)} by {run}{_fault(found.run_count, found.run_wanted)}"
    rule = "" if found.fill_rule == "shared-edge" else ", and all formats with this rule"
    return f"Pixel ({column}, {row}), {who}: expected {times(found.run_wanted)}, {said}{rule}."


def dial_rows(found: PixelInFormats) -> tuple[DialRow, ...]:
    """Return one row for every format and triangle; the format's own figures stand in its first row."""
    rows: list[DialRow] = []
    for each in found.formats:
        for index, triangle in enumerate(found.triangles):
            own = (each.coverage, drawn_words(each.count, each.wanted), picture_words(each))
            is_count_right = each.count == each.wanted
            decision, is_right = _decision(each.readings[index], each.is_drawn[index], found.is_culled[index])
            cells = (*(own if index == 0 else ("",) * len(own)), str(triangle), *decision)
            rows.append(DialRow(cells, is_right, is_count_right if index == 0 else None))
    return tuple(rows)


def _decision(reading: DialReading, is_drawn: bool, is_culled: bool) -> tuple[tuple[str, ...], bool]:
    """Return what is said of one triangle, and whether it is right; pieces have no edge function to be shown."""
    should_cover = reading.is_covered == reading.is_right
    is_right = is_drawn == should_cover
    said = ("covers" if is_drawn else "outside") + ("" if is_right else ": wrong")
    if is_drawn != reading.is_covered:
        return (
            said,
            "",
            "",
            number_text(reading.exact_value),
            "culled" if is_culled else "clipped first: its pieces decide",
            "",
        ), is_right
    numbers = (str(reading.edge), number_text(reading.values[reading.edge]), number_text(reading.exact_value))
    return (said, *numbers, reading.flipped_by, reading.bits), is_right


def times(count: int) -> str:
    """Return how often in words: ``0 times``, ``once``, ``twice``, ``3 times``."""
    return {1: "once", 2: "twice"}.get(count, f"{count:,} times")


def drawn_words(count: int, wanted: int) -> str:
    """Return how often a pixel is covered, and what is wrong with that."""
    return f"{times(count)}{_fault(count, wanted)}"


def _fault(count: int, wanted: int) -> str:
    """Return what is wrong with a count in brackets, empty where it is right."""
    return "" if count == wanted else " (hole)" if count < wanted else " (too often)"


def picture_words(each: FormatAtPixel) -> str:
    """Return what a format makes of the whole picture."""
    if each.wrong_count is None:
        return "too large"
    if each.first_wrong is None:
        return "right"
    column, row = each.first_wrong
    return f"{each.wrong_count:,} wrong, first ({column}, {row})"


# What a click on a cell opens: its run once more, its picture, the smallest scene that fails, and the
# stepper.


DIAL = "precision-dial"
"""The experiment that is about number formats itself."""


class CasePresenter(QObject):
    """Keeps the case of a cell; at most one look at it, one shrinking and one reading at a time."""

    def __init__(self, view: CaseView, page: Page) -> None:
        super().__init__(page)
        self._view, self._page = view, page
        self.found: CaseFound | None = None
        """The case that is shown, as it was run or made small."""
        self._steps_when_found = False
        self._looking = Job(self, succeeded=self._show_case, failed=self._show_failure)
        self._reading = Job(self, succeeded=self._show_dial, failed=self._tell_no_dial)
        expected = (ValueError, MemoryError, StudyCancelledError)
        self._shrinking = Job(self, expected, succeeded=self._show_shrunk, failed=self._tell_no_shrinking)
        view.pixel_pinned.connect(self._read_dial)
        view.step_requested.connect(self.step)
        view.shrink_requested.connect(self.shrink)
        view.hide()

    def say(self, heading: str, text: str) -> None:
        """Show no case, and say why."""
        self._stop()
        self._view.show()
        self._view.show_waiting(heading, text)

    def look(self, heading: str, order: CaseOrder) -> None:
        """Run a cell once more and show it."""
        self.say(heading, "Running …")
        self._looking.call(partial(run_case, order))

    def close(self) -> None:
        """Close the case."""
        self._stop()
        self._view.hide()

    def _stop(self) -> None:
        for job in (self._looking, self._reading, self._shrinking):
            job.cancel()
        self.found, self._steps_when_found = None, False

    @Slot(object)
    def _show_case(self, found: CaseFound) -> None:
        self._show(found)
        self._view.show_tab("formats" if found.order.experiment.info.name == DIAL else "pictures")
        if self._steps_when_found:
            self.step()

    def _show(self, found: CaseFound) -> None:
        self.found = found
        self._view.show_case(case_record(found))
        self._view.show_formats("", ())
        if self._view.pin is not None:
            self._read_dial(*self._view.pin)

    @Slot(object)
    def _show_failure(self, error: Exception) -> None:
        self._view.show_waiting("This cell", f"It cannot be run: {error}")

    # The precision dial.

    @Slot(int, int)
    def _read_dial(self, column: int, row: int) -> None:
        """Look at a pixel in every number format, where the case is triangles in clip space."""
        found, opening = self.found, None if self.found is None else self.found.opening
        if found is None or opening is None or not has_formats(opening):
            return
        assert isinstance(opening.scene, ClipScene)
        wanted = wanted_cover(found.order.experiment, is_part=found.shrunk is not None)
        given = opening.scene, opening.settings, (column, row), wanted
        self._reading.start(lambda _, is_cancelled: pixel_in_formats(*given, is_cancelled))

    @Slot(object)
    def _show_dial(self, found: PixelInFormats) -> None:
        if self.found is not None:
            self._view.show_formats(dial_sentence(found, self.found.order.place.key), dial_rows(found))

    @Slot(object)
    def _tell_no_dial(self, error: Exception) -> None:
        self._page.refuse(f"The pixel could not be tested in every number format: {error}")

    # To the stepper.

    @Slot()
    def step(self) -> None:
        """Open the case that is shown on the Step page, at the pinned pixel."""
        self._steps_when_found = False
        if self.found is None:
            self._page.tell("Click a cell first: its run opens in the stepper.")
            return
        opening = self.found.opening
        title = f"{self.found.order.experiment.info.title}: {self.found.order.place.key}"
        if opening is None:
            self._page.tell("This run cannot be stepped: it is not a stage of the pipeline.")
            return
        if self._view.pin is not None:
            opening = replace(opening, pixel=self._view.pin)
        title += ", smallest case" if self.found.shrunk is not None else ""
        self._page.step_to(StepRequest(opening, title))

    def step_when_found(self) -> None:
        """Open the case in the stepper, as soon as it has been run."""
        if self.found is not None:
            self.step()
        else:
            self._steps_when_found = self._looking.is_running

    # Shrinking.

    @Slot()
    def shrink(self) -> None:
        """Make the case small."""
        found = self.found
        if found is None or not is_failure(found.verdict):
            self._page.tell("Only a failing cell can be shrunk.")
            return
        self._view.show_waiting("Shrinking …", "Removing parts, pixels and digits while it still fails.")
        self._shrinking.start(partial(shrink_case, found))

    @Slot(object)
    def _show_shrunk(self, shrunk: CaseFound) -> None:
        if self.found is not None and self.found.order is shrunk.order:
            self._show(shrunk)

    @Slot(object)
    def _tell_no_shrinking(self, error: Exception) -> None:
        if self.found is not None:
            self._view.show_case(case_record(self.found))
        self._page.refuse(f"The case could not be shrunk: {error}")
