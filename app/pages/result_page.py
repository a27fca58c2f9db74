"""Pages that do long work: its results above what a choice in them opens; kept, exported and opened again."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Protocol

from PySide6.QtCore import QEvent, Qt, Slot
from PySide6.QtWidgets import QPushButton, QScrollArea, QSplitter, QWidget

from app.background.workers import JobGroup
from app.export.views import copy_widget, export_widget
from app.files.file_dialogs import SaveDialog
from app.files.file_writing import write_file
from app.files.kept_results import ENDING, KeptResults
from app.pages.background_task import BackgroundTask
from app.pages.page_bar import Page
from app.pages.result_presenter import Result, ResultPresenter
from app.pages.side_columns import SideColumns
from lessons.os_errors import problem_text
from widgets.basics.controls import button_with_tip, column_layout, flat_button
from widgets.basics.labels import ElidedLabel, Readout
from widgets.basics.pane_splitter import PaneSplitter
from widgets.basics.run_panel import RunPanel
from widgets.charts.family_list import FamilyList


class Opened(Protocol):
    """Shows what a choice in a result opens."""

    def dismiss(self) -> bool:
        """Close it; return whether there was anything."""


class WorkPage(Page):
    """A page around one job and what its result opens."""

    def join(self, jobs: JobGroup, work: BackgroundTask, opened: Opened) -> None:
        """Let Escape and the end of the window reach what the page does."""
        self._jobs, self._work, self._opened = jobs, work, opened

    def lay_out(
        self,
        left: QWidget,
        controls: RunPanel,
        above: Sequence[tuple[QWidget, int]],
        below: QWidget,
        spacing: int = 4,
    ) -> None:
        """Put ``left`` beside the controls, the widgets ``above``, each with its stretch, and ``below``."""
        top = _WrappingPane(self)
        layout = column_layout(top, spacing)
        self.place = ElidedLabel(self)
        self.place.hide()
        layout.addWidget(self.place)
        layout.addWidget(controls)
        for widget, stretch in above:
            layout.addWidget(widget, stretch)
        self._controls, self._below = controls, below
        self.panes = splitter(Qt.Orientation.Vertical, ((top, 3, 440), (below, 2, 280)), self)
        # Where all of it has no room, as in large type on a low screen, it scrolls: nothing lies over something else.
        scroll = QScrollArea(self)
        scroll.setWidget(self.panes)
        scroll.setWidgetResizable(True)
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.columns = SideColumns(left, scroll, self)
        self._desk: tuple[dict[str, str], bool] | None = None
        """While presenting, the sizes of the panes at the desk, and whether nothing was opened."""
        page = column_layout(self, margins=(8, 4, 8, 8))
        page.addWidget(self.columns)

    def set_presenting(self, is_presenting: bool) -> None:
        """Leave the room to the result: only what is opened of it shares the room."""
        if is_presenting == (self._desk is not None):
            return
        if is_presenting:
            self._desk = self.layout_state(), self._below.isHidden()
        self.place.setVisible(is_presenting and bool(self.place.text()))
        for widget in self.for_the_desk():
            widget.setVisible(not is_presenting)
        self._controls.set_brief(is_presenting)
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
        if self._work.is_running:
            self._work.cancel()
            return True
        was_open = self._opened.dismiss()
        if self._desk is not None:
            self._below.hide()
        return was_open

    def is_busy(self) -> bool:
        """Return whether the work runs."""
        return bool(self._work.is_running)

    def focus_panes(self) -> list[QWidget]:
        """Return the controls with the result, what is opened of it, and the column at the left."""
        return [*self.panes.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly), self]

    def stop(self) -> None:
        """End all work."""
        self._jobs.shut_down()


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


@dataclass(frozen=True)
class FileWords:
    """What is said of the files of a page."""

    noun: str
    """What is written: ``study``."""
    view: str
    """What is copied as a picture: ``charts``."""
    nothing: str
    """What to do while there is nothing to be written."""
    kinds: str
    """Kinds of files with their endings, as ``QFileDialog`` takes them."""
    export_tip: str
    copy_tip: str


class ResultPage(WorkPage):
    """A page with a list of what can be done; a page says what a file of its results is, and opens one."""

    results: ResultPresenter[Any]

    def __init__(self, words: FileWords, load: Callable[[Path], Any], parent: QWidget | None = None) -> None:
        """Make the widgets that all such pages have; ``load`` opens a file and raises ValueError."""
        super().__init__(parent)
        self._words, self._load = words, load
        self.kept = KeptResults(words.noun, load, self)
        self.kept.failed.connect(self.edit_refused)
        self.entries, self.readout = FamilyList(self), Readout("Figures", self)
        self.shown_text = ElidedLabel(self)
        self.shown_text.setProperty("role", "muted")
        self.shown_text.setAccessibleDescription(f"What the {words.view} show")
        self.export_button = self._button("Export…", words.export_tip, self.ask_export)
        self.copy_button = self._button("Copy", words.copy_tip, self.copy)
        about = "What these methods are, and where each is exact and breaks"
        self.reference_button = flat_button("i", "About these methods", about, self)
        self.reference_button.setMinimumSize(24, 24)
        self.reference_button.clicked.connect(self._show_reference)

    @Slot()
    def _show_reference(self) -> None:
        """Show the reference of the family that is measured, or that of all families."""
        families = self.results.choice.families
        self.help_requested.emit(f"family/{families[0]}" if families else "methods")

    def _button(self, text: str, tip: str, action: Callable[[], None]) -> QPushButton:
        button = button_with_tip(text, tip, self)
        button.clicked.connect(action)
        return button

    def join_results(self, jobs: JobGroup, results: ResultPresenter[Any], opened: Opened) -> None:
        """Connect the presenters with the page and its files."""
        self.join(jobs, results, opened)
        self.kept.found.connect(results.take_kept)
        self.kept.example_found.connect(results.take_example)
        results.result_taken.connect(self._keep)
        results.shown_text_changed.connect(self.shown_text.setText)
        results.shown_text_changed.connect(self._show_place)

    def list_column(self, heights: tuple[int, int]) -> QSplitter:
        """Return the list over the figures, which begin with these ``heights`` in pixels."""
        panes = ((self.entries, 3, heights[0]), (self.readout, 1, heights[1]))
        self.left = splitter(Qt.Orientation.Vertical, panes, self)
        return self.left

    def set_presenting(self, is_presenting: bool) -> None:
        """Leave the room to the result, and name it."""
        self._show_place()
        super().set_presenting(is_presenting)

    def for_the_desk(self) -> list[QWidget]:
        """Return the list and the figures: keys go through the list."""
        return [self.columns.left]

    @Slot()
    def _show_place(self) -> None:
        """Name what is shown, as the list does."""
        self.place.setText(self.results.choice.title)

    # What a page says.

    def stem_of(self, result: Any) -> str:
        """Return what a file of a result is called, without its ending."""
        raise NotImplementedError

    def content_of(self, result: Any, ending: str) -> bytes | None:
        """Return the content of a file of a result; ``None``: the file is a picture of the view."""
        raise NotImplementedError

    # Results of other days.

    def keep_results(self) -> None:
        """Show the results of the last start, and keep those that come from now on."""
        self.kept.begin()

    @Slot(object)
    def _keep(self, result: Result) -> None:
        self.kept.keep(result.name, partial(self.content_of, result, ENDING))

    def stop(self) -> None:
        """End all work, and finish what is being written."""
        super().stop()
        self.kept.shut_down()

    def open_path(self, path: str) -> None:
        """Open a saved result."""
        try:
            self.results.take_saved(self._load(Path(path)), Path(path).name)
        except ValueError as error:
            self.refuse(f"{error}. The page is unchanged.")
        else:
            self.went_well.emit()

    # Files.

    @property
    def finished(self) -> Any:
        """The result that is shown; ``None``: there is none, or it is not finished."""
        return None if self.results.is_partial else self.results.choice.result

    def export_view(self) -> bool:
        """Ask where to export the result."""
        self.ask_export()
        return True

    def copy_view(self) -> bool:
        """Copy what is shown of the result."""
        self.copy()
        return True

    @Slot()
    def ask_export(self) -> None:
        """Ask for a file and write the result to it."""
        if self._is_finished():
            title, name = f"Export {self._words.noun}", f"{self.stem_of(self.finished)}.png"
            self.ask_path(title, name, self._words.kinds, self.export_to)

    def export_to(self, path: str) -> None:
        """Write the result by the ending of the file."""
        if self._is_finished():
            self.tell_written(path, lambda: self._write(path), "exported", self._words.noun)

    def ask_path(self, title: str, name: str, kinds: str, write: Callable[[str], None]) -> None:
        """Ask for a file, and write to it unless there is none."""
        path = SaveDialog(self.window(), title, name, kinds).ask()
        if path:
            write(path)

    def tell_written(self, path: str, write: Callable[[], None], done: str, noun: str) -> None:
        """Write, and report that it is done, or why not."""
        try:
            write()
        except (OSError, ValueError) as error:
            self.refuse(f"The {noun} was not {done}: {problem_text(error)}")
        else:
            self.tell_done(f"{done.capitalize()} {Path(path).name}.")

    def _is_finished(self) -> bool:
        if self.finished is None:
            self.tell(f"There is nothing to export yet: {self._words.nothing}.")
            return False
        return True

    def _write(self, path: str) -> None:
        content = self.content_of(self.finished, Path(path).suffix.lower())
        if content is None:
            export_widget(self.main_view(), path)
            return
        write_file(path, content)

    @Slot()
    def copy(self) -> None:
        """Put the view on the clipboard as a picture."""
        copy_widget(self.main_view())
        self.tell(f"Copied the {self._words.view}.")
