"""Pages with a list of experiments: the choices and results of all are kept, those of one are shown; and its files."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Generic, TypeVar

from PySide6.QtCore import Qt, Slot
from PySide6.QtWidgets import QPushButton, QSplitter, QWidget

from app.background import PartWork
from app.export.views import copy_widget, export_widget
from app.files.file_access import write_file
from app.files.file_dialogs import SaveDialog
from app.files.kept_work import ENDING, KeptResults
from app.pages.experiment_page import ExperimentPage, PacedDrawing, WorkWords, splitter
from app.pages.words import machine_words
from core.scene import AnyScene
from lessons.os_errors import problem_text
from widgets.basics.controls import ElidedLabel, Readout, button_with_tip, flat_button
from widgets.experiments.controls import FamilyEntry, FamilyList

Content = TypeVar("Content")


@dataclass(frozen=True, eq=False)
class Result(Generic[Content]):
    """What came of an experiment, a study or an atlas, and where it is from."""

    content: Content
    scene: AnyScene | None = None
    """What was measured on, where that is the open scene; a file does not hold it."""
    path: str = ""
    """The file it was opened from; empty: it was made here."""
    is_kept: bool = False
    """Whether it is of an earlier start of the window."""
    is_example: bool = False
    """Whether it came with the program."""


@dataclass(eq=False, kw_only=True)
class Choice(Generic[Content]):
    """One experiment: what is chosen for it, and its last result."""

    name: str
    title: str
    """What it is called in the list."""
    families: tuple[str, ...] = ()
    """The families of methods that differ in it; empty: all may."""
    can_run: bool = True
    """Whether this version can do it again: a saved result may be of another version."""
    seed: int = 0
    result: Result[Content] | None = None

    @property
    def entry(self) -> FamilyEntry:
        """The row of the list."""
        return FamilyEntry(self.name, self.title, is_measured=self.result is not None)

    @property
    def is_changed(self) -> bool:
        """Whether something else is chosen now than what the result is of."""
        return False

    def take(self, result: Result[Content]) -> None:
        """Keep a result; one that was opened from a file, or is of an earlier start, sets the choices too."""
        self.result = result


ChoiceType = TypeVar("ChoiceType", bound=Choice[Any])


@dataclass(frozen=True)
class ResultKind(WorkWords, Generic[Content, ChoiceType]):
    """What the results of a page are, and what is said of them and of their files."""

    running: str
    """After the title of what runs: ``is still being measured``."""
    unknown: str
    """Why a kind of work of another version cannot be done again."""
    again: str
    """What to do once the settings have changed: ``measure again (F5)``."""
    noun: str
    """What is written: ``study``, the first word of its files."""
    view: str
    """What is copied as a picture: ``charts``."""
    nothing: str
    """What to do while there is nothing to be written."""
    endings: str
    """Kinds of files with their endings, as ``QFileDialog`` takes them."""
    export_tip: str
    copy_tip: str
    load: Callable[[Path], Content]
    """Opens a file, or raises ValueError."""
    content: Callable[[Content, ChoiceType, str], bytes | None]
    """The content of a file with an ending; ``None``: the file is a picture of the view."""
    stem: Callable[[Content], str]
    """What a file is called, without its ending."""
    name_of: Callable[[Content], str]
    """The name of the experiment that a result is of."""
    saved_choice: Callable[[Content], ChoiceType]
    """The choice of a saved result that this version cannot make."""
    sentences: Callable[[Content], list[str]]
    """What a result is of."""
    so_far: Callable[[Content], str]
    """What is shown of it while it is being made."""
    done: Callable[[str, Content], str]
    """The message that the work of a title is done."""


class ResultPage(ExperimentPage, Generic[Content, ChoiceType]):
    """Keeps the choices and results of all experiments and shows those of one."""

    def __init__(
        self,
        kind: ResultKind[Content, ChoiceType],
        choices: dict[str, ChoiceType],
        first: str,
        parent: QWidget | None = None,
    ) -> None:
        """Make the widgets that all such pages have."""
        super().__init__(kind, parent)
        self._kind, self._choices, self._current = kind, choices, first
        self._running = ""
        """Name of what is being done; empty: nothing."""
        self._partial: Content | None = None
        """What runs or ran last, with the parts so far, whatever is shown meanwhile; ``None``: there is none yet."""
        self._pointed: Any = None
        """The method or the cell that is pointed at; ``None``: none."""
        self._pace = PacedDrawing(self)
        self._pace.due.connect(self._show_parts)
        self.kept = KeptResults(kind.noun, kind.load, self)
        self.kept.failed.connect(self.edit_refused)
        self.kept.found.connect(self.take_kept)
        self.entries, self.readout = FamilyList(self), Readout("Figures", self)
        self.entries.family_chosen.connect(self.show_named)
        self.shown_text = ElidedLabel(self)
        self.shown_text.setProperty("role", "muted")
        self.shown_text.setAccessibleDescription(f"What the {kind.view} show")
        self.export_button = self._button("Export…", kind.export_tip, self.ask_export)
        self.copy_button = self._button("Copy", kind.copy_tip, self.copy)
        about = "What these methods are, and where each is exact and breaks"
        self.reference_button = flat_button("i", "About these methods", about, self)
        self.reference_button.setMinimumSize(24, 24)
        self.reference_button.clicked.connect(self._show_reference)

    def _button(self, text: str, tip: str, action: Callable[[], None]) -> QPushButton:
        button = button_with_tip(text, tip, self)
        button.clicked.connect(action)
        return button

    @Slot()
    def _show_reference(self) -> None:
        """Show the reference of the family that is measured, or that of all families."""
        families = self.choice.families
        self.help_requested.emit(f"family/{families[0]}" if families else "methods")

    def list_column(self, heights: tuple[int, int]) -> QSplitter:
        """Return the list over the figures, which begin with these ``heights`` in pixels."""
        panes = ((self.entries, 3, heights[0]), (self.readout, 1, heights[1]))
        self.left = splitter(Qt.Orientation.Vertical, panes, self)
        return self.left

    def for_the_desk(self) -> list[QWidget]:
        """Return the list and the figures: keys go through the list."""
        return [self.columns.left]

    # What is shown.

    @property
    def choice(self) -> ChoiceType:
        """What is shown."""
        return self._choices[self._current]

    @property
    def content(self) -> Content | None:
        """The result that is shown: a whole one, or the parts so far; ``None``: there is none."""
        if self.is_partial:
            return self._partial
        return None if self.choice.result is None else self.choice.result.content

    @property
    def is_partial(self) -> bool:
        """Whether what is shown is being done now."""
        return self._running == self._current

    @property
    def names(self) -> list[str]:
        """Names of all that can be shown, in their order."""
        return list(self._choices)

    @Slot(str)
    def show_named(self, name: str) -> None:
        """Show another one of the list."""
        if name != self._current:
            self._turn_to(name)

    def show_neighbour(self, direction: int) -> None:
        """Show the next of the list, or the one before."""
        self.show_named(self.names[(self.names.index(self._current) + direction) % len(self.names)])

    def _turn_to(self, name: str) -> None:
        """Show one of the list, afresh."""
        self._current, self._pointed = name, None
        self.refresh()
        self._show_opened()

    @Slot()
    def refresh(self) -> None:
        """Show the list, the controls and the result."""
        self.entries.show_families([choice.entry for choice in self._choices.values()], self._current)
        self._show_controls()
        self._show()

    def _show(self) -> None:
        """Show the result, or as much of it as has come."""
        self._pace.settle()
        self._show_result()
        self._show_text()

    @Slot()
    def _show_parts(self) -> None:
        """Show the parts that have come since."""
        self._show()

    def _show_text(self) -> None:
        """Say in words what is shown: the result or the choices have changed."""
        self.shown_text.setText(self._text())
        self.place.setText(self.choice.title)

    def _text(self) -> str:
        choice = self.choice
        result = choice.result
        if self.is_partial:
            return "" if self._partial is None else self._kind.so_far(self._partial)
        if result is None:
            return ""
        parts = self._kind.sentences(result.content)
        if result.is_example:
            # First: the line is cut at its end where the page is narrow.
            parts.insert(0, "An example from another computer: F5 makes your own.")
        elif result.is_kept:
            parts.append("Kept from an earlier start.")
        if choice.can_run and choice.is_changed:
            parts.append(f"The settings have changed since: {self._kind.again}.")
        if result.content.machine:
            parts.append(f"{machine_words(result.content.machine)}.")
        return " ".join(parts)

    @Slot(str, object)
    def _choose(self, name: str, value: Any) -> None:
        setattr(self.choice, name, value)
        self._show_text()

    # Doing the work.

    @Slot()
    def start(self) -> None:
        """Start the chosen work."""
        if not self.choice.can_run:
            self.refuse(self._kind.unknown)
        elif self._running:
            title = self._choices[self._running].title
            self.tell(f"{title} {self._kind.running}. Wait until it is done, or cancel it first (Shift+F5).")
        else:
            self._running, self._pointed = self._current, None
            run = self._prepare()
            self._show()
            self._show_opened()
            self.begin(run, "Preparing")

    def _doing(self, doing: str) -> str:
        """Name what is being done while something else is shown."""
        return (
            doing
            if not self._running or self.is_partial
            else f"{self._choices[self._running].title}: {doing}"
        )

    @Slot(object)
    def _take_part(self, part: Any) -> None:
        self._keep_part(part)
        if self.is_partial:
            self._pace.ask()

    @Slot(object)
    def _take_result(self, result: Result[Any]) -> None:
        name = self._kind.name_of(result.content)
        choice = self._choices[name]
        choice.take(result)
        self.refresh()
        self.tell(self._kind.done(choice.title, result.content))
        self.kept.keep(name, partial(self._kind.content, result.content, choice, ENDING))

    def _put_back(self) -> None:
        """Show the result that there was before."""
        self._running = ""
        self.refresh()

    # Results of earlier days, and of files.

    def keep_results(self) -> None:
        """Show the results of the last start, and keep those that come from now on."""
        self.kept.begin()

    @Slot(object, bool)
    def take_kept(self, content: Any, is_example: bool = False) -> None:
        """Show what was kept from an earlier start, or the program's example, unless there is a newer result."""
        name = self._kind.name_of(content)
        choice = self._choices.get(name)
        if choice is not None and choice.result is None and self._running != name:
            choice.take(Result(content, is_kept=True, is_example=is_example))
            self.refresh()

    def take_saved(self, content: Any, path: str) -> None:
        """Show what was opened from a file."""
        name = self._kind.name_of(content)
        if name not in self._choices:
            self._choices[name] = self._kind.saved_choice(content)
        self._choices[name].take(Result(content, path=path))
        self._turn_to(name)

    def open_path(self, path: str) -> None:
        """Open a saved result."""
        try:
            self.take_saved(self._kind.load(Path(path)), Path(path).name)
        except ValueError as error:
            self.refuse(f"{error}. The page is unchanged.")
        else:
            self.went_well.emit()

    @property
    def finished(self) -> Result[Any] | None:
        """The result that is shown; ``None``: there is none, or it is not finished."""
        return None if self.is_partial else self.choice.result

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
        if self._is_finished() and self.finished is not None:
            name = f"{self._kind.stem(self.finished.content)}.png"
            self.ask_path(f"Export {self._kind.noun}", name, self._kind.endings, self.export_to)

    def export_to(self, path: str) -> None:
        """Write the result by the ending of the file."""
        if self._is_finished():
            self.tell_written(path, lambda: self._write(path), "exported", self._kind.noun)

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
            self.tell(f"There is nothing to export yet: {self._kind.nothing}.")
        return self.finished is not None

    def _write(self, path: str) -> None:
        assert self.finished is not None
        content = self._kind.content(self.finished.content, self.choice, Path(path).suffix.lower())
        if content is None:
            export_widget(self.main_view(), path)
        else:
            write_file(path, content)

    @Slot()
    def copy(self) -> None:
        """Put the view on the clipboard as a picture."""
        copy_widget(self.main_view())
        self.tell(f"Copied the {self._kind.view}.")

    # What a page says.

    def _show_controls(self) -> None:
        """Show the choices."""

    def _show_result(self) -> None:
        """Show the result, or the parts of it that have come."""

    def _show_opened(self) -> None:
        """Show what is opened of the result, or close it."""

    def _prepare(self) -> PartWork:
        """Forget the parts of earlier work; return the new one, which gives a `Result`."""
        raise NotImplementedError

    def _keep_part(self, part: Any) -> None:
        """Keep a part of the result."""
