"""Saving what is open soon after every edit: the next start has it, however this one ends."""

from collections.abc import Callable, Sequence
from functools import partial

from PySide6.QtCore import QElapsedTimer, QObject, QTimer, Signal, SignalInstance, Slot

from app.background.workers import Job
from app.files.state_files import State, StateFileError
from app.files.state_models import Breakpoints
from app.files.user_folders import preferences_folder
from app.files.window_files import WindowFile, new_window_file
from app.session.document import Document
from app.session.moment import Change
from app.session.session import Session
from core.records.sentences import sentences

PAUSE = 700
"""Milliseconds after the last edit."""
LATEST = 1800
"""Milliseconds after the first edit that is not saved, if others follow all the time."""
RETRY = 10_000
"""Milliseconds after saving has failed: the disk may have room again."""


class Autosave(QObject):
    """Keeps the file of one window up to date, from `begin` to `finish`."""

    failed = Signal(str)
    """Why the scene cannot be saved, in sentences; sent once until it can be saved again."""
    recovered = Signal()
    """It is saved again."""

    def __init__(
        self,
        session: Session,
        state: Callable[[], State],
        edits: Sequence[SignalInstance],
        parent: QObject | None = None,
    ) -> None:
        """Save what ``state`` returns whenever the document or the pin changes, or one of ``edits`` is emitted."""
        super().__init__(parent)
        self._session, self._state = session, state
        self._edits = edits
        self._file: WindowFile | None = None
        self._stand_in: Document | None = None
        self._has_failed = self._is_finished = False
        self._job = Job(self, expected=(OSError, StateFileError, MemoryError))
        self._job.succeeded.connect(self._succeed)
        self._job.failed.connect(self._fail)
        self._waits = QElapsedTimer()
        """Since the first edit that is not saved."""
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._save)
        self._retry = QTimer(self)
        self._retry.setSingleShot(True)
        self._retry.timeout.connect(self.ask)

    def begin(self, file: WindowFile | None, stand_in: Document | None = None) -> None:
        """Save every edit from now on.

        Parameters
        ----------
        file : WindowFile or None
            The file to save to; ``None``: a new one, made when there is something to be saved.
        stand_in : Document, optional
            What is shown because nothing else was to be opened: not worth a file while it is unchanged.
        """
        self._file, self._stand_in = file, stand_in
        for edited in self._edits:
            edited.connect(self.ask)
        self._session.changed.connect(self._follow)

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        if what & (Change.DOCUMENT | Change.EDITS | Change.PIN):
            self.ask()

    @property
    def is_waiting(self) -> bool:
        """Whether something is to be saved, or is being saved."""
        return self._timer.isActive() or self._job.is_running

    @Slot()
    def ask(self) -> None:
        """Save soon."""
        if self._is_finished:
            return
        if not self._timer.isActive():
            self._waits.start()
        self._timer.start(max(min(PAUSE, LATEST - self._waits.elapsed()), 0))

    def finish(self) -> None:
        """Save what is open now, and leave the file to the next start; a second time does nothing.

        Raises OSError, StateFileError or MemoryError if it cannot be saved; it is tried again later, unless `end`
        follows.
        """
        if self._is_finished:
            return
        self._timer.stop()
        try:
            if self._is_worth_saving():
                self._open_file().save(self._state())
        except (OSError, StateFileError, MemoryError):
            self._retry.start(RETRY)
            raise
        self.end()

    def end(self) -> None:
        """Leave the file, as it is, to the next start."""
        self._is_finished = True
        self._timer.stop()
        self._retry.stop()
        if self._file is not None:
            self._file.release()
        self._job.shut_down()

    def _is_worth_saving(self) -> bool:
        if self._file is not None or self._session.document is not self._stand_in:
            return True
        state = self._state()
        return bool(state.bookmarks) or state.breakpoints != Breakpoints()

    def _open_file(self) -> WindowFile:
        if self._file is None:
            self._file = new_window_file(preferences_folder())
        return self._file

    @Slot()
    def _save(self) -> None:
        if not self._is_worth_saving():
            return
        if self._job.is_running:
            self._timer.start(PAUSE)
            return
        state = self._state()
        try:
            file = self._open_file()
        except OSError as problem:
            self._fail(problem)
        else:
            self._job.call(partial(file.save, state))

    @Slot()
    def _succeed(self) -> None:
        if self._has_failed:
            self._has_failed = False
            self.recovered.emit()

    @Slot(object)
    def _fail(self, error: Exception) -> None:
        self._retry.start(RETRY)
        if not self._has_failed:
            self._has_failed = True
            why = f"What is open cannot be saved for the next start: {error}"
            self.failed.emit(sentences(why, "Saving is tried again every 10 seconds"))
