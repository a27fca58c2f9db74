"""Files of the window: opening meshes, states and built-in scenes, saving a state."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtWidgets import QWidget

from app.background.freeing import Freeing
from app.background.workers import Job, Progress
from app.files.file_dialogs import SaveDialog, ask_file
from app.files.file_names import is_text
from app.files.mesh_files import EXTENSIONS, OpeningCancelledError, OutsideMeshError
from app.files.open_any import Opened, open_any
from app.files.state_files import EXTENSION, OutsideSourceError, State, StateFileError, save_state
from app.files.state_folder import neighbour_of, states_beside
from app.files.user_folders import preferences_folder
from app.pages.page_bar import Pages
from app.pages.page_table import page_endings
from app.pages.step.looks import show_state, state_of
from app.pages.step.page import StepPage
from app.session.cursor import cursor_at
from app.session.document import edits_beside
from app.session.tracing import trace_now
from app.window.appearance import Appearance
from app.window.work_progress import WorkProgress
from core import Trace
from core.records.sentences import sentences
from lessons.os_errors import problem_text
from widgets.basics.message_bar import Message, MessageBar, MessageKind

READ_OUTSIDE = "Read outside its folder"
"""The button that opens a file again and allows what it names outside its folder."""


class FileActions(QObject):
    """Opens off the GUI thread; saves at once."""

    message_sent = Signal(object)
    """A ``Message`` about what became of a file."""
    file_used = Signal(str)
    """Path of a file that was opened or saved."""
    ended = Signal(bool)
    """Opening has ended: what was asked for is there and shown next, or it could not be opened."""
    path_chosen = Signal(str)
    """Path of a file that the user wants to open."""

    def __init__(
        self, page: StepPage, pages: Pages, messages: MessageBar, appearance: Appearance, window: QWidget
    ) -> None:
        super().__init__(window)
        self._appearance = appearance
        self._page, self._session, self._messages = page, page.session, messages
        self._pages = pages
        self.target = ""
        """What was to be opened last."""
        self.shown = ""
        """The file that is shown, absolute, or the name of the scene; empty: what the window began with."""
        self.state_path = ""
        """The state that was opened or saved last, absolute; empty: none. The states beside it come next."""
        self.job = Job(self, expected=(OpeningCancelledError, ValueError, OSError, MemoryError))
        self.progress = WorkProgress(self.job, page.session.tracing, messages, self)
        self.freeing = Freeing(self)
        page.session.tracing.traced.connect(self.freeing.ask)
        self.progress.opening_cancelled.connect(self._tell_cancelled)
        self.job.succeeded.connect(self._show_result)
        self.job.failed.connect(self._tell_failed)

    def _tell(
        self, text: str, kind: MessageKind = MessageKind.INFORMATION, details: str = "", action: str = ""
    ) -> None:
        self.message_sent.emit(Message(kind, text, details, action))

    # Opening.

    def ask_file(self) -> None:
        """Ask for a mesh or state file and open it."""
        endings = " ".join(f"*{ending}" for ending in (*EXTENSIONS, EXTENSION, *page_endings()))
        kinds = f"Meshes, states and studies ({endings});;All files (*)"
        path = ask_file(self._page.window(), "Open", kinds)
        if path:
            self.path_chosen.emit(path)

    @Slot(str)
    def open_path(self, target: str, allows_outside: bool = False) -> None:
        """Open a mesh, a state or a built-in scene off the GUI thread; the open scene stays until it is there.

        ``allows_outside``: files that it names may be read from outside its folder.
        """
        self.target = target

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> tuple[Opened, Trace]:
            opened = open_any(target, progress, is_cancelled, allows_outside)
            stage = opened.state.stage if opened.state else opened.place.stage
            return opened, trace_now(opened.document, stage)

        self.progress.begin(f"Opening {Path(target).name}")
        self.job.start(work)

    @Slot(object)
    def _show_result(self, result: tuple[Opened, Trace]) -> None:
        opened, trace = result
        self.shown = opened.path or self.target
        if opened.state is not None and not _is_in_preferences(opened.path):
            self.state_path = opened.path
        self.ended.emit(True)
        self.show_opened(opened, trace)
        self.freeing.ask()
        self._messages.clear()
        if opened.warnings:
            outside = opened.left_outside
            texts = [*outside, *(text for text in opened.warnings if text not in outside)]
            action = READ_OUTSIDE if outside else ""
            self._tell(texts[0], MessageKind.WARNING, "\n".join(texts[1:]), action)
        if is_text(opened.document.path) and opened.document.path:
            self.file_used.emit(opened.document.path)

    def show_opened(self, opened: Opened, trace: Trace | None = None) -> None:
        """Show what was opened: a scene at its place, a state where it was left."""
        page, session, state = self._page, self._session, opened.state
        page.timeline.show_playing(False)
        if state is None:
            place = opened.place
            kept, shaders = page.editing.typed, page.shading.kept
            document = edits_beside(opened.document)
            trace = (
                trace_now(document, place.stage)
                if trace is None or document is not opened.document
                else trace
            )
            # What was typed stays, where it runs on this scene; A | B says where it does not.
            document = replace(document, edits=document.edits or kept)
            session.open(document, trace, cursor_at(place, trace, session.cursor.level))
            page.stepping.set_places()
            session.set_pin(place.pixel)
            page.grids.focus_on(max(session.moment.triangle, 0))
            # As at first, also where the same scene was looked at in another view before.
            page.main_area.views_by_hand.clear()
            page.show_own_view()
            if document.edits and (refusal := page.editing.show_edited()):
                page.tell(refusal)
            page.shading.bring(shaders)
            page.views.look_from({})
            page.column.show_step()
            return
        show_state(page, state, trace)
        self._appearance.grow_text_to(state.look.text_size)

    # The states of a folder.

    def states(self) -> list[str]:
        """Return the paths of the states beside the last one; none where their folder cannot be read any more."""
        try:
            return states_beside(self.state_path) if self.state_path else []
        except OSError:
            return []

    def open_neighbour(self, direction: int) -> None:
        """Open the next state of the folder (1), or the one before (-1)."""
        if not self.state_path:
            self._tell("Open or save a state first: the states of its folder follow each other.")
            return
        folder = Path(self.state_path).parent
        try:
            states = states_beside(self.state_path)
        except OSError as error:
            self._tell(f"The folder {folder} cannot be read: {problem_text(error)}", MessageKind.ERROR)
            return
        place = neighbour_of(self.state_path, states, direction)
        if place is None:
            self._tell(f"There is no {'next' if direction > 0 else 'previous'} state in {folder.name}.")
            return
        self._tell(f"State {place + 1} of {len(states)}: {Path(states[place]).stem}")
        self.path_chosen.emit(states[place])

    @Slot(object)
    def _tell_failed(self, error: Exception) -> None:
        if isinstance(error, OpeningCancelledError):
            self._tell_cancelled()
        else:
            action = READ_OUTSIDE if isinstance(error, OutsideMeshError | OutsideSourceError) else ""
            self._tell(sentences(error, "The open scene is unchanged"), MessageKind.ERROR, action=action)
        self.ended.emit(False)

    @Slot()
    def _tell_cancelled(self) -> None:
        self._tell("Opening was cancelled; nothing has changed.")

    def shut_down(self) -> None:
        """Cancel opening and wait until its thread has ended."""
        self.freeing.shut_down()
        self.job.shut_down()

    # Saving.

    def state(self) -> State:
        """Return what a state file keeps."""
        return state_of(self._page, self._appearance.text_size)

    def kept_state(self) -> State:
        """Return what is kept for the next start: under a lesson, what was open before, with the lesson over it."""
        kept = self._page.lessons.kept
        if kept is None:
            return self.state()
        look = kept.look.model_copy(update={"text_size": self._appearance.text_size})
        return replace(kept, look=look)

    def ask_save(self) -> None:
        """Ask where the state is to be saved, and save it."""
        name, kinds = f"{self._session.document.file_stem}{EXTENSION}", f"States (*{EXTENSION})"
        path = SaveDialog(self._page.window(), "Save state", name, kinds).ask()
        if path:
            self.save_to(path)

    def save_to(self, path: str) -> None:
        """Save the state to a file."""
        try:
            save_state(path, self.state())
        except (OSError, StateFileError) as error:
            self._tell(f"The state was not saved: {error}", MessageKind.ERROR)
        else:
            self.state_path = self.shown = str(Path(path).absolute())
            self.file_used.emit(path)
            self._tell(f"Saved {Path(path).name}.")


def _is_in_preferences(path: str) -> bool:
    """Return whether a state is what a window has left: nobody goes through these."""
    try:
        return Path(path).parent == preferences_folder().absolute()
    except OSError:  # This user has no such folder.
        return False
