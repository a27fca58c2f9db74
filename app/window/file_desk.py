"""Files of the window: opening meshes, states and scenes, saving a state, and the view as a file or on paper."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal, Slot
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication, QWidget

from app.background import Freeing, Job, Progress
from app.export.views import ViewSheet, copy_widget, export_widget
from app.files.file_access import is_text
from app.files.file_dialogs import SaveDialog, ask_file
from app.files.mesh_files import OpeningCancelledError
from app.files.mesh_formats import EXTENSIONS
from app.files.mesh_formats.reading import OutsideMeshError
from app.files.open_any import Opened, open_any
from app.files.state_files import EXTENSION, State, neighbour_of, save_state, states_beside
from app.files.state_scenes import OutsideSourceError, StateFileError
from app.files.user_folders import preferences_folder
from app.pages.page_bar import Pages
from app.pages.page_table import page_endings
from app.pages.step.kept_look import show_state, state_of
from app.pages.step.page import StepPage
from app.session.document import edits_beside
from app.session.moment import cursor_at
from app.session.tracing import Tracing, trace_now
from app.window.appearance import Appearance
from core import Trace
from core.numeric.watched import watched
from core.records.words import sentences
from lessons.os_errors import problem_text
from widgets.basics.message_bar import Message, MessageBar, MessageKind
from widgets.basics.message_bar import Progress as ShownProgress
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import LIGHT, current_theme

# What long work shows: its progress, once it takes a moment, and its cancelling.


PROGRESS_AFTER = 300
"""Milliseconds before the progress of long work is shown."""


class WorkProgress(QObject):
    """Shows the opening of a file and the tracing of an edit in the message bar."""

    opening_cancelled = Signal()
    edit_cancelled = Signal()

    def __init__(
        self, opening: Job, tracing: Tracing, messages: MessageBar, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._opening, self._tracing, self._messages = opening, tracing, messages
        self._title = ""
        """What is waited for, as ``Opening teapot.obj``."""
        self._slow = QTimer(self, singleShot=True, interval=PROGRESS_AFTER)
        self._slow.timeout.connect(self._show_slow)
        opening.progressed.connect(self._show_progress)
        opening.ended.connect(self._end)
        tracing.busy_changed.connect(self._show_busy)
        tracing.progressed.connect(self._show_progress)
        messages.cancel_requested.connect(self.cancel)

    @property
    def is_busy(self) -> bool:
        """Whether anything is waited for."""
        return self._opening.is_running or self._tracing.is_busy

    def begin(self, doing: str) -> None:
        """Show what is being done, if that takes a moment."""
        self._title = doing
        self._slow.start()

    @Slot()
    def cancel(self) -> None:
        """Stop waiting; the open scene is unchanged."""
        if self._tracing.is_busy:
            self._tracing.cancel()
            self.edit_cancelled.emit()
        if self._opening.is_running:
            self._opening.cancel()
            self.opening_cancelled.emit()

    @Slot(object, str)
    def _show_progress(self, fraction: float | None, doing: str) -> None:
        if not self._slow.isActive():
            done = 0 if fraction is None else round(fraction * 100)
            text = f"{self._title}: {doing}" if doing else self._title
            self._messages.show_progress(ShownProgress(text, done, 0 if fraction is None else 100))

    @Slot()
    def _show_slow(self) -> None:
        if self.is_busy:
            self._messages.show_progress(ShownProgress(self._title, 0, 0))

    @Slot(str)
    def _show_busy(self, doing: str) -> None:
        if doing:
            self.begin(doing)
        elif not self._opening.is_running:
            self._end()

    @Slot()
    def _end(self) -> None:
        self._slow.stop()
        self._messages.show_progress(None)


# The view as a file, on the clipboard and on paper, with the sentence and the formula of its step.


SCALES = (1, 2, 4, 8)
"""Pixels of a picture to a pixel of the screen's picture that can be chosen."""


class ExportActions(QObject):
    """Exports, copies and prints the main view of the page that is shown."""

    message_sent = Signal(object)
    """A ``Message`` about what became of it."""

    def __init__(self, pages: Pages, window: QWidget) -> None:
        super().__init__(window)
        self._pages = pages
        self.scale = 1
        """Of pictures, one of `SCALES`."""
        self.has_caption = False
        """Whether the sentence and the formula stand under the view."""

    @Slot(int)
    def set_scale(self, scale: int) -> None:
        """Choose how many pixels pictures have to a pixel of the screen's."""
        self.scale = scale

    def ask_export(self) -> None:
        """Ask where the view is to go, and export it."""
        kinds = "PNG picture (*.png);;SVG drawing (*.svg);;PDF page (*.pdf)"
        name = f"{self._pages.file_stem()}.png"
        path = SaveDialog(self._pages.window(), "Export view", name, kinds).ask()
        if path:
            self.export_to(path)

    def export_to(self, path: str) -> None:
        """Export the view by the ending of the file, and confirm it."""
        try:
            with self._figure() as figure:
                export_widget(figure, path, self._scale())
        except (OSError, ValueError) as error:
            self._tell(f"The view was not exported: {error}", MessageKind.ERROR)
            return
        name = Path(path).name
        size = QImage(path).size() if name.lower().endswith(".png") else None
        self._tell(f"Exported {name}" + (f", {size.width()} × {size.height()} pixels." if size else "."))

    def copy(self) -> None:
        """Put the view on the clipboard as a picture, and confirm it."""
        with self._figure() as figure:
            size = copy_widget(figure, self._scale())
        self._tell(f"Copied the view, {size.width()} × {size.height()} pixels.")

    def print_view(self, title: str) -> None:
        """Show the view with sentence and formula on one page, to be printed."""
        from PySide6.QtPrintSupport import QPrinter, QPrintPreviewDialog  # Only who prints waits for it.

        page = self._pages.current
        with _as_on_paper():
            page.settle()
            sheet = ViewSheet(page.main_view(), page.caption(), title)
            printer = QPrinter(QPrinter.PrinterMode.HighResolution)
            printer.setDocName(title or "Rasterscope")
            printer.setCreator("Rasterscope")
            dialog = QPrintPreviewDialog(printer, self._pages.window())
            dialog.setWindowTitle("Print view")
            # Qt's own size is that of its buttons: a page of a few pixels.
            dialog.resize(self._pages.window().size() * 0.9)
            dialog.paintRequested.connect(sheet.print_on)
            if dialog.exec():
                self._tell("Printed the view.")
            dialog.deleteLater()
            sheet.deleteLater()

    @contextmanager
    def _figure(self) -> Iterator[QWidget]:
        """Yield what is to be exported: the view, or a sheet with what its page says of it."""
        page = self._pages.current
        caption = page.caption()
        if not (self.has_caption and (caption.sentence or caption.formula)):
            yield page.main_view()
            return
        sheet = ViewSheet(page.main_view(), caption)
        yield sheet
        sheet.deleteLater()

    def _scale(self) -> float | None:
        """Return the pixels of a picture to a logical pixel; ``None``: those of the screen."""
        return None if self.scale == 1 else self.scale * self._pages.devicePixelRatioF()

    def _tell(self, text: str, kind: MessageKind = MessageKind.INFORMATION) -> None:
        self.message_sent.emit(Message(kind, text))


@contextmanager
def _as_on_paper() -> Iterator[None]:
    """Show the window in a light theme meanwhile: dark views would cover a page with ink."""
    theme, application = current_theme(), QApplication.instance()
    assert isinstance(application, QApplication)
    if theme.is_dark:
        apply_theme(application, LIGHT)
    try:
        yield
    finally:
        apply_theme(application, theme)


# Files of the window: opening meshes, states and built-in scenes, saving a state.


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
        self.job = Job(
            self,
            (OpeningCancelledError, ValueError, OSError, MemoryError),
            succeeded=self._show_result,
            failed=self._tell_failed,
        )
        self.progress = WorkProgress(self.job, page.session.tracing, messages, self)
        self.freeing = Freeing(self)
        page.session.tracing.traced.connect(self.freeing.ask)
        self.progress.opening_cancelled.connect(self._tell_cancelled)

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
            with watched(progress, is_cancelled):
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
        page.lessons.forget_wanted()
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
