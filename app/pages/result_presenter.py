"""Long work of several kinds, in a list: the choices and results of all are kept, those of one are shown."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Generic, Protocol, TypeVar

from PySide6.QtCore import Signal, Slot

from app.background.workers import Job
from app.pages.background_task import BackgroundTask, PacedDrawing, WorkWords
from app.pages.page_bar import Page
from app.pages.words import machine_words
from widgets.basics.labels import Readout
from widgets.basics.message_bar import Progress
from widgets.charts.family_list import FamilyEntry, FamilyList


class Result(Protocol):
    """What came of one kind of work: a study, or an atlas."""

    @property
    def name(self) -> str:
        """Name of the kind of work."""

    @property
    def machine(self) -> Mapping[str, str]:
        """Where it was made."""

    @property
    def path(self) -> str:
        """The file it was opened from; empty: it was made here."""

    @property
    def is_kept(self) -> bool:
        """Whether it is of an earlier start of the window."""

    @property
    def is_example(self) -> bool:
        """Whether it came with the program."""


class Choice(Protocol):
    """One kind of work: what is chosen for it, and its last result."""

    seed: int

    @property
    def name(self) -> str:
        """Its name in the list."""

    @property
    def title(self) -> str:
        """What it is called in the list."""

    @property
    def families(self) -> tuple[str, ...]:
        """The families of methods that differ in it; empty: all may."""

    @property
    def result(self) -> Any:
        """What came of it last; ``None``: nothing."""

    @property
    def can_run(self) -> bool:
        """Whether this version can do it again: a saved result may be of another version."""

    @property
    def is_changed(self) -> bool:
        """Whether something else is chosen now than what the result is of."""

    def entry(self) -> FamilyEntry:
        """Return the row of the list."""

    def take(self, result: Any) -> None:
        """Keep a result; one that was opened from a file, or is of an earlier start, sets the choices too."""


ChoiceType = TypeVar("ChoiceType", bound=Choice)


@dataclass(frozen=True)
class ResultWords(WorkWords):
    """What is said of work that there is a list of."""

    running: str
    """After the title of what runs: ``is still being measured``."""
    unknown: str
    """Why a kind of work of another version cannot be done again."""
    again: str
    """What to do once the settings have changed: ``measure again (F5)``."""


class RunControls(Protocol):
    """The controls of a page with results."""

    seed_chosen: Any
    start_requested: Any
    cancel_requested: Any

    def show_progress(self, progress: Progress | None) -> None:
        """Show how far the work is; ``None``: nothing runs."""


class ResultPresenter(BackgroundTask, Generic[ChoiceType]):
    """Keeps the choices and results of all kinds of work and shows those of one."""

    shown_text_changed = Signal(str)
    """What is shown, in words."""
    result_taken = Signal(object)
    """A `Result` that has just been made."""

    def __init__(
        self,
        job: Job,
        words: ResultWords,
        choices: dict[str, ChoiceType],
        entries: FamilyList,
        controls: RunControls,
        readout: Readout,
        page: Page,
        first: str = "",
    ) -> None:
        super().__init__(job, controls, words, page)
        self._choices, self._entries, self._readout, self._run_words = choices, entries, readout, words
        self._current = first or next(iter(choices))
        self._running = ""
        """Name of what is being done; empty: nothing."""
        self._pace = PacedDrawing(page)
        self._pace.due.connect(self._show_parts)
        entries.family_chosen.connect(self.show_named)
        controls.seed_chosen.connect(self._choose_seed)
        controls.start_requested.connect(self.start)
        controls.cancel_requested.connect(self.cancel)

    # What is shown.

    @property
    def choice(self) -> ChoiceType:
        """What is shown."""
        return self._choices[self._current]

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
        self._current = name
        self._point_nowhere()
        self.refresh()
        self.shown_changed.emit()

    @Slot()
    def refresh(self) -> None:
        """Show the list, the controls and the result."""
        self._entries.show_families([choice.entry() for choice in self._choices.values()], self._current)
        self._show_controls()
        self._show()

    def _show(self) -> None:
        """Show the result, or as much of it as has come."""
        self._pace.settle()
        self._show_result()
        self.tell_shown()

    def tell_shown(self) -> None:
        """Say again what is shown: the result or the choices have changed."""
        self.shown_text_changed.emit(self._shown_text())

    def _shown_text(self) -> str:
        result: Result | None = self.choice.result
        if self.is_partial:
            return self._partial_text()
        if result is None:
            return ""
        parts = self._result_texts()
        if result.is_example:
            # First: the line is cut at its end where the page is narrow.
            parts.insert(0, "An example from another computer: F5 makes your own.")
        elif result.is_kept:
            parts.append("Kept from an earlier start.")
        if self.choice.can_run and self.choice.is_changed:
            parts.append(f"The settings have changed since: {self._run_words.again}.")
        if result.machine:
            parts.append(f"{machine_words(result.machine)}.")
        return " ".join(parts)

    # Doing the work.

    @Slot()
    def start(self) -> None:
        """Start the chosen work."""
        if not self.choice.can_run:
            self._page.refuse(self._run_words.unknown)
            return
        if self._running:
            title = self._choices[self._running].title
            self._page.tell(
                f"{title} {self._run_words.running}. Wait until it is done, or cancel it first (Shift+F5)."
            )
            return
        self._running = self._current
        begin = self._prepare()
        self._point_nowhere()
        self._tell_progress(Progress("Preparing", 0, 0))
        self._show()
        self.shown_changed.emit()
        begin()

    def _doing(self, doing: str) -> str:
        """Name what is being done while something else is shown."""
        if not self._running or self.is_partial:
            return doing
        return f"{self._choices[self._running].title}: {doing}"

    @Slot(object)
    def _take_part(self, part: Any) -> None:
        self._keep_part(part)
        if self.is_partial:
            self._pace.ask()

    @Slot(object)
    def _take_result(self, result: Any) -> None:
        self._choices[result.name].take(result)
        self.refresh()
        self._page.tell(self._done_text(result))
        self.result_taken.emit(result)

    def _put_back(self) -> None:
        """Show the result that there was before."""
        self._running = ""
        self.refresh()

    # Results of earlier days.

    @Slot(object)
    def take_kept(self, content: Any) -> None:
        """Show what was kept from an earlier start, unless there is a newer result."""
        self._take_earlier(self._result_of(content, is_kept=True))

    @Slot(object)
    def take_example(self, content: Any) -> None:
        """Show the example that came with the program, unless there is a result."""
        self._take_earlier(replace(self._result_of(content, is_kept=True), is_example=True))

    def _take_earlier(self, result: Any) -> None:
        choice = self._choices.get(result.name)
        if choice is not None and choice.result is None and self._running != result.name:
            choice.take(result)
            self.refresh()

    def take_saved(self, content: Any, path: str) -> None:
        """Show what was opened from a file."""
        result = self._result_of(content, path=path)
        if result.name not in self._choices:
            self._choices[result.name] = self._unknown_choice(result)
        self._choices[result.name].take(result)
        self._turn_to(result.name)

    @Slot(int)
    def _choose_seed(self, seed: int) -> None:
        self.choice.seed = seed
        self.tell_shown()

    # What a page says.

    def _point_nowhere(self) -> None:
        """Forget what is pointed at and chosen."""
        raise NotImplementedError

    def _show_controls(self) -> None:
        """Show the choices."""
        raise NotImplementedError

    def _show_result(self) -> None:
        """Show the result, or the parts of it that have come."""
        raise NotImplementedError

    @Slot()
    def _show_parts(self) -> None:
        """Show the parts that have come since."""
        self._show()

    def _partial_text(self) -> str:
        """Return what is shown while it is being made."""
        raise NotImplementedError

    def _result_texts(self) -> list[str]:
        """Return what the result that is shown is of, in sentences."""
        raise NotImplementedError

    def _done_text(self, result: Any) -> str:
        """Return the message that work is done."""
        raise NotImplementedError

    def _prepare(self) -> Any:
        """Forget the parts of earlier work; return what begins the new one."""
        raise NotImplementedError

    def _keep_part(self, part: Any) -> None:
        """Keep a part of the result."""
        raise NotImplementedError

    def _result_of(self, content: Any, path: str = "", is_kept: bool = False) -> Any:
        """Return the `Result` for the content of a file."""
        raise NotImplementedError

    def _unknown_choice(self, result: Any) -> ChoiceType:
        """Return the choice of a result that this version cannot make."""
        raise NotImplementedError
