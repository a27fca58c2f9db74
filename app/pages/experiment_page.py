"""Pages that run experiments off the GUI thread, and what a choice in a result opens below it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal, Slot
from PySide6.QtWidgets import QScrollArea, QSplitter, QWidget

from app.background import Job, PartWork, turns
from app.export.views import copy_widget
from app.pages.columns import SideColumns
from app.pages.page_bar import Page, StepRequest, percent_done
from widgets.basics.controls import ElidedLabel, column_layout
from widgets.basics.message_bar import Progress, RunPanel
from widgets.basics.panes import PaneSplitter
from widgets.experiments.case_pictures import PicturesRecord, StudyPictures
from widgets.grid.linked_grids import Pixel

# Pages that run experiments off the GUI thread: what came of one, above what a choice in it opens.


@dataclass(frozen=True)
class WorkWords:
    """What is said of the work of a page."""

    page: str
    """Name of the page, for those that wait until its work is done."""
    cancelled: str
    """As ``Measuring was cancelled``."""
    failed: str
    """As ``It could not be measured``."""
    kept: str
    """As ``the previous results are unchanged``."""


class ExperimentPage(Page):
    """Runs one experiment at a time: what came before stays, and comes back unless a result takes its place."""

    controls: RunPanel

    def __init__(self, words: WorkWords, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.words = words
        self._told: Progress | None = None
        self.place = ElidedLabel(self)
        self.place.hide()
        self.work = Job(self, part_done=self._take_part, succeeded=self._take_result, failed=self._fail)
        self.work.progressed.connect(self._follow_work)
        self.work.ended.connect(self._end)
        """Gives parts of a result as they are done, and the result in the end."""

    def lay_out(
        self, left: QWidget, above: Sequence[tuple[QWidget, int]], below: QWidget, spacing: int = 4
    ) -> None:
        """Put ``left`` beside the controls, the widgets ``above``, each with its stretch, and ``below``."""
        self.controls.chosen.connect(self._choose)
        self.controls.start_requested.connect(self.start)
        self.controls.cancel_requested.connect(self.cancel)
        top = _WrappingPane(self)
        layout = column_layout(top, spacing)
        layout.addWidget(self.place)
        layout.addWidget(self.controls)
        for widget, stretch in above:
            layout.addWidget(widget, stretch)
        self._below = below
        self.panes = splitter(Qt.Orientation.Vertical, ((top, 3, 440), (below, 2, 280)), self)
        # Where all of it has no room, as in large type on a low screen, it scrolls: nothing lies over something else.
        scroll = QScrollArea(self, widgetResizable=True)
        scroll.setWidget(self.panes)
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.columns = SideColumns(left, scroll, self)
        self._desk: tuple[dict[str, str], bool] | None = None
        """While presenting, the sizes of the panes at the desk, and whether nothing was opened."""
        page = column_layout(self, margins=(8, 4, 8, 8))
        page.addWidget(self.columns)

    # Doing the work.

    @property
    def is_running(self) -> bool:
        """Whether a result is being waited for."""
        return self.work.is_running

    @Slot()
    def start(self) -> None:
        """Start the chosen work."""

    def begin(self, run: PartWork, doing: str) -> None:
        """Begin ``run(progress, is_cancelled, part_done)`` when its turn comes; until it says more it is ``doing``."""
        page = self.words.page

        def work(progress: Any, is_cancelled: Any, part_done: Any) -> Any:
            with turns.take(page, progress, is_cancelled):
                return run(progress, is_cancelled, part_done)

        self._show_progress(Progress(doing, 0, 0))
        self.work.start_in_parts(work)

    @Slot()
    def cancel(self) -> None:
        """Stop; what there was before is shown again."""
        if self.is_running:
            self.work.cancel()
            self._come_to_nothing()
            self.tell(f"{self.words.cancelled}; {self.words.kept}.")

    @Slot(object, str)
    def _follow_work(self, fraction: float | None, doing: str) -> None:
        self._show_progress(percent_done(fraction, self._doing(doing)))

    def _show_progress(self, progress: Progress | None) -> None:
        """Show how far it is, on the page and to those who listen: each percent once, not each of a thousand cases."""
        if progress is not None and progress == self._told:
            return
        self._told = progress
        self.controls.show_progress(progress)
        self.work_progressed.emit(progress)

    @Slot(object)
    def _fail(self, error: Exception) -> None:
        self._come_to_nothing()
        kept = self.words.kept
        self.refuse(f"{self.words.failed}: {error} {kept[:1].upper()}{kept[1:]}.")

    @Slot()
    def _end(self) -> None:
        """Go back to what was there before; a result or a reason may follow."""
        self._show_progress(None)
        self._put_back()

    # What a page does about it.

    @Slot(str, object)
    def _choose(self, name: str, value: Any) -> None:
        """Take over what the user has chosen in the control of a name."""

    def _doing(self, doing: str) -> str:
        """Return the words for the work in progress."""
        return doing

    @Slot(object)
    def _take_part(self, part: Any) -> None:
        """Show a part of the result."""

    @Slot(object)
    def _take_result(self, result: Any) -> None:
        """Show the result; `_put_back` has been called before."""

    def _put_back(self) -> None:
        """Show again what there was before."""

    def _come_to_nothing(self) -> None:
        """Forget what was chosen in work that was cancelled or failed; there may be nothing to choose in it."""

    @Slot()
    def close_opened(self) -> bool:
        """Close what is opened; return whether there was anything."""
        return False

    # As a page of the window.

    def show_way_back(self, is_shown: bool, task: str = "") -> None:
        """Keep in sight what the step of the open lesson asks here."""
        self.controls.show_task(task)

    def set_presenting(self, is_presenting: bool) -> None:
        """Leave the room to the result and name it: only what is opened of it shares the room."""
        if is_presenting == (self._desk is not None):
            return
        if is_presenting:
            self._desk = self.layout_state(), self._below.isHidden()
        self.place.setVisible(is_presenting and bool(self.place.text()))
        for widget in self.for_the_desk():
            widget.setVisible(not is_presenting)
        self.controls.set_brief(is_presenting)
        if is_presenting:
            self._below.hide()
        elif self._desk is not None:
            layout, is_hidden = self._desk
            self._below.setHidden(is_hidden)
            self.restore_layout(layout)
            self._desk = None

    def for_the_desk(self) -> list[QWidget]:
        """Return what is left out while presenting, beside most of the controls."""
        return []

    def dismiss(self) -> bool:
        """Cancel the work, or else close what is opened."""
        if self.is_running:
            self.cancel()
            return True
        was_open = self.close_opened()
        if self._desk is not None:
            self._below.hide()
        return was_open

    def is_busy(self) -> bool:
        """Return whether the work runs."""
        return self.is_running

    def focus_panes(self) -> list[QWidget]:
        """Return the controls with the result, what is opened of it, and the column at the left."""
        return [*self.panes.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly), self]


class _WrappingPane(QWidget):
    """A pane of a splitter, never lower than its wrapped rows: a splitter does not ask for a height by the width."""

    def event(self, event: QEvent) -> bool:
        """Ask for the height that the rows have at this width, whenever they are laid out."""
        layout = self.layout()
        if layout is not None and event.type() in (QEvent.Type.Resize, QEvent.Type.LayoutRequest):
            self.setMinimumHeight(layout.minimumHeightForWidth(self.width()))
        return super().event(event)


def splitter(
    direction: Qt.Orientation, panes: Sequence[tuple[QWidget, int, int]], parent: QWidget
) -> QSplitter:
    """Return a splitter of panes, each with its stretch and the pixels that it begins with."""
    made = PaneSplitter(direction, parent)
    for number, (pane, stretch, _) in enumerate(panes):
        made.addWidget(pane)
        made.setStretchFactor(number, stretch)
    made.setSizes([size for _, _, size in panes])
    return made


PAUSE = 250
"""Milliseconds between the end of one drawing and the beginning of the next."""


class PacedDrawing(QObject):
    """Says when to draw: at once after a pause, else when the pause is over; of a hidden page, when it is shown."""

    due = Signal()
    """It is to be drawn now."""

    def __init__(self, page: QWidget) -> None:
        super().__init__(page)
        self._page = page
        self._is_owed = False
        self._pause = QTimer(self, singleShot=True, interval=PAUSE)
        self._pause.timeout.connect(self._draw_what_is_owed)
        page.installEventFilter(self)

    def ask(self) -> None:
        """Something new has come."""
        self._is_owed = True
        self._draw_what_is_owed()

    def settle(self) -> None:
        """Owe nothing: everything has just been drawn."""
        self._is_owed = False

    @Slot()
    def _draw_what_is_owed(self) -> None:
        if self._is_owed and not self._pause.isActive() and self._page.isVisible():
            self._is_owed = False
            self.due.emit()
            self._pause.start()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Draw what came while the page was hidden."""
        if event.type() == QEvent.Type.Show:
            self._draw_what_is_owed()
        return False


# What a choice in a result opens below it: made off the GUI thread, shown, copied, and stepped.


@dataclass(frozen=True, eq=False)
class DrawnPictures:
    """Three pictures, and what they lead to."""

    record: PicturesRecord
    request: Callable[[Pixel | None], StepRequest | str]
    """Returns what opens in the stepper at the pinned pixel, or a sentence: why nothing does."""
    divergence: Callable[[], StepRequest | str] | None = None
    """Finds where two runs part ways, or says that they do not; ``None``: there is one run."""


class OpenedPictures(QObject):
    """At most one drawing of pictures and one search in them at a time."""

    def __init__(self, view: StudyPictures, page: Page) -> None:
        super().__init__(page)
        self._view, self._page = view, page
        self._drawn: DrawnPictures | None = None
        self.drawing = Job(self, succeeded=self._show, failed=self._show_failure)
        self._searching = Job(self, succeeded=self._take_divergence, failed=self._tell_no_divergence)
        view.step_requested.connect(self.step)
        view.divergence_requested.connect(self.step_to_divergence)
        view.copy_requested.connect(self.copy)

    def open(self, doing: str, draw: Callable[[], DrawnPictures]) -> None:
        """Draw, and say meanwhile what is being done."""
        self.say(doing)
        self._view.show()
        self.drawing.call(draw)

    def say(self, text: str) -> None:
        """Show no pictures, and say why, or how to get some."""
        self.drawing.cancel()
        self._searching.cancel()
        self._drawn = None
        self._view.show_waiting(text)

    def close(self) -> None:
        """Close the pictures."""
        self.say("")
        self._view.hide()

    @Slot(object)
    def _show(self, drawn: DrawnPictures) -> None:
        self._drawn = drawn
        self._view.show_pictures(drawn.record)

    @Slot(object)
    def _show_failure(self, error: Exception) -> None:
        self._view.show_waiting(f"It cannot be drawn: {error}")

    # Where they lead.

    @Slot()
    def step(self) -> None:
        """Open the run on the Step page, at the pinned pixel or where it is wrong first."""
        if self._drawn is None:
            self._page.tell("Click a point first: its run opens in the stepper.")
        else:
            self._follow(self._drawn.request(self._view.pin))

    @Slot()
    def step_to_divergence(self) -> None:
        """Open both runs on the Step page, where they first part ways."""
        if self._drawn is None or self._drawn.divergence is None:
            self._page.tell("Select two points first: click one, then Ctrl+click another.")
        else:
            self._view.show_busy("Searching for the first divergence …")
            self._searching.call(self._drawn.divergence)

    @Slot(object)
    def _take_divergence(self, found: StepRequest | str) -> None:
        self._show_again()
        self._follow(found)

    @Slot(object)
    def _tell_no_divergence(self, error: Exception) -> None:
        self._show_again()
        self._page.refuse(f"They cannot be traced: {error}")

    def _show_again(self) -> None:
        if self._drawn is not None:
            self._show(self._drawn)

    def _follow(self, found: StepRequest | str) -> None:
        if isinstance(found, str):
            self._page.tell(found)
        else:
            self._page.step_to(found)

    @Slot()
    def copy(self) -> None:
        """Put the three pictures on the clipboard."""
        if self._drawn is not None:
            copy_widget(self._view.linked)
            self._page.tell("Copied the pictures.")
