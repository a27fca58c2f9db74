"""Where the two runs of A | B part: the first step or pixel in which they differ is looked for, and both go there."""

from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot

from app.background import Job
from app.pages.page_bar import Page
from app.pages.step.ab.pictures import divergence_text
from app.pages.step.kept_look import line_positions
from app.pages.step.stepping_presenter import nearest
from app.session.moment import Pixel
from app.session.session import Session
from core import STAGES
from core.records.listing import EditedListing, Listing

if TYPE_CHECKING:
    from app.pages.step.ab.presenter import ComparePresenter
    from core.study.divergence import Divergence  # Looked for long after the window is open.


class Meeting(QObject):
    """Puts both runs at steps that belong together."""

    told = Signal(str)
    """Where both runs differ first, in words."""

    def __init__(self, comparing: "ComparePresenter", session: Session, page: Page) -> None:
        super().__init__(comparing)
        self._comparing, self._session, self._page = comparing, session, page
        self._search = Job(self, succeeded=self._land, failed=self._tell_no_divergence)

    @property
    def is_searching(self) -> bool:
        """Whether the first step that differs is being looked for."""
        return self._search.is_running

    def cancel(self) -> None:
        """Search no further."""
        self._search.cancel()

    @Slot()
    def go_to_divergence(self, since: str = "") -> None:
        """Search for the first step that differs, at last in the stages before ``since``, and put both runs there.

        Empty: since the first stage of the settings that differ. What differs before it only follows from them.
        """
        from core.study.divergence import diverge

        moment, second = self._comparing.runs
        if second is None:
            is_shown = self._comparing.is_active
            self._page.tell(self._comparing.refusal if is_shown else "Show A | B first (Ctrl+D).")
        else:
            begin = since or self._comparing.b.first_stage
            self._search.call(partial(diverge, moment.trace, second, by_outcome=True, since=begin))

    @Slot(object)
    def _land(self, found: "Divergence | None") -> None:
        moment, second = self._comparing.runs
        if second is None:
            return
        said = divergence_text(found, moment.trace, second)
        if found is not None:
            if found.pixel is not None:
                self._session.set_pin(found.pixel)
            self._comparing.put_at(found.stage, *found.rows)
        self._page.tell(said)
        self.told.emit(said)

    @Slot(object)
    def _tell_no_divergence(self, error: Exception) -> None:
        self._page.tell(f"A and B cannot be compared: {error}")

    @Slot()
    def go_to_first_difference(self) -> None:
        """Put both runs at the first pixel that another listing draws otherwise, or at the first step that differs."""
        from core.edits.editable import EDITABLE

        edits = self._comparing.b.edits
        if not edits:
            self.go_to_divergence()
            return
        first = min((EDITABLE[edit.part].stage for edit in edits), key=STAGES.index)
        is_line = any(edit.part == "line" for edit in edits)
        self._comparing.reach(self.go_to_other_pixel if is_line else partial(self.go_to_divergence, first))

    def go_to_other_pixel(self) -> None:
        """Put both runs at the first step that draws another pixel, or else at their first divergence."""
        from app.session.printed_runs import first_other_pixel

        moment, second = self._comparing.runs
        assert second is not None
        found = first_other_pixel(moment.trace.stage("raster"), second.stage("raster"))
        if found is None:
            self.go_to_divergence("raster")
        else:
            self._comparing.put_at("raster", *found[0])
            self._page.tell(f"{found[1]} Ctrl+[ goes back.")

    def meet_at(self, pixel: Pixel) -> None:
        """Put both runs at the first step about a pixel in which they differ, or else at the first one about it."""
        self._search.cancel()
        self._comparing.reach(partial(self._meet, pixel))

    def _meet(self, pixel: Pixel) -> None:
        from core.study.divergence import stage_divergence

        moment, trace = self._comparing.runs
        assert trace is not None
        stage = moment.cursor.stage
        first, second = moment.stage_trace, trace.stage(stage)
        found = stage_divergence(first, second, by_outcome=True)
        about = [run.rows_at_pixel(*pixel) for run in (first, second)]
        mine, theirs = (int(rows[0]) if len(rows) else None for rows in about)
        rows = found.rows if found is not None and found.pixel == pixel else (mine, theirs)
        self._comparing.put_at(stage, *rows)

    def run_to_line(self, listing: Listing, line: int) -> None:
        """Go to the next step of B that is of a line: one without a label is run with the labelled one before it."""
        step = self._comparing.second
        if step is None:
            return
        trace, begin = step.stage_trace, step.cursor.position
        if line in listing.lines.values() or not isinstance(listing, EditedListing):
            at = nearest(line_positions(trace, listing.name, line), begin, 1)
            if at is None:
                self._page.tell(f"No further step at line {line} in this stage.")
            else:
                self._comparing.go_to_second(at)
            return
        from core.explain.edited import position_that_runs

        at, last = position_that_runs(trace, listing, line, begin)
        if at is not None:
            self._comparing.go_to_second(at)
            self._page.tell(f"Line {line} runs in this step.")
        elif last < trace.steps.count:
            self._page.tell(f"Line {line} does not run in the next {last - begin:,} steps.")
        else:
            self._page.tell(f"No further step runs line {line} in this stage.")
