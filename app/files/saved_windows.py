"""The state of each window, saved to a file of its own soon after every edit: the next start has it.

A lock beside the file says that a window has it open. A window that closes removes its lock; a lock whose process
is gone says that the window ended without closing. Nothing is ever overwritten by another window, and what cannot be
opened stays; only the oldest of many files are removed.
"""

import json
import os
import re
import shutil
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from pathlib import Path
from secrets import token_hex
from threading import Lock

from PySide6.QtCore import QElapsedTimer, QLockFile, QObject, QTimer, Signal, SignalInstance, Slot

from app.background import Job
from app.files.file_access import FileWriteError, make_folder, open_input, remove_abandoned
from app.files.state_arrays import ArrayFolder, array_folder
from app.files.state_files import EXTENSION, State, save_state
from app.files.state_models import Breakpoints
from app.files.state_scenes import StateFileError
from app.files.user_folders import preferences_folder
from app.session.document import Document
from app.session.moment import Change
from app.session.session import Session
from core.records.words import sentences

STEM = "last"
"""What the names of the files begin with."""
TITLE_WITHIN = 4096
"""Bytes of a file that are searched for its title, which stands near the beginning."""
LOCK_FAILED = "its folder cannot be written to, or the disk is full"
KEPT = 12
"""Files of windows that are closed, beside those of open windows."""


@dataclass(frozen=True)
class EarlierWindow:
    """What a window left that is not open any more."""

    path: Path
    was_closed: bool
    """False: its process ended while the window was open."""

    @property
    def title(self) -> str:
        """What was open."""
        with suppress(OSError, ValueError), open_input(self.path) as file:
            found = re.search(rb'"title": ("(?:[^"\\]|\\.)*")', file.read(TITLE_WITHIN))
            if found:
                return str(json.loads(found[1])) or "Untitled"
        return "Unreadable"

    @property
    def when(self) -> str:
        """When it was saved, in words."""
        written = datetime.fromtimestamp(self.path.stat().st_mtime)
        is_today = written.date() == datetime.now().date()
        return f"today at {written:%H:%M}" if is_today else f"on {written:%Y-%m-%d at %H:%M}"


class WindowFile:
    """The file that one window saves to, and no other one until it is released.

    Raises FileWriteError if another window has the file, or its folder cannot be written to.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._lock = _lock_of(path)
        self._turn = Lock()
        if not self._lock.tryLock(0):
            is_taken = self._lock.error() == QLockFile.LockError.LockFailedError
            reason = "another window has it open" if is_taken else LOCK_FAILED
            raise FileWriteError(f"{path} cannot be written: {reason}")

    def save(self, state: State) -> None:
        """Write the state, and those of its arrays that have changed.

        Raises OSError or StateFileError if it cannot be written; what stood there stays.
        """
        with self._turn:
            arrays = ArrayFolder(array_folder(self.path))
            save_state(self.path, state, arrays.keep)
            arrays.remove_unused()

    def release(self) -> None:
        """Leave the file to the next start."""
        self._lock.unlock()


def new_window_file(folder: Path) -> WindowFile:
    """Return a file that no window has had; FileWriteError if the folder cannot be made or written to."""
    make_folder(folder)
    return WindowFile(folder / f"{STEM}-{token_hex(4)}{EXTENSION}")


def earlier_windows(folder: Path) -> list[EarlierWindow]:
    """Return what earlier windows left, the last saved first; that a window was not closed is returned only once."""
    found = []
    for path in _by_age(folder):
        lock = _lock_of(path)
        had_lock = os.path.lexists(_lock_path(path))
        if lock.tryLock(0):
            lock.unlock()
            found.append(EarlierWindow(path, was_closed=not had_lock))
    return found


def remove_oldest_windows(folder: Path) -> None:
    """Remove the oldest of the files that no window has open, where there are more than `KEPT`, and unfinished ones."""
    if folder.is_dir():
        remove_abandoned(folder, f".{STEM}")
    for earlier in earlier_windows(folder)[KEPT:]:
        with suppress(OSError):
            earlier.path.unlink()
            shutil.rmtree(array_folder(earlier.path), ignore_errors=True)


def _by_age(folder: Path) -> list[Path]:
    """Return the files of windows, the last written first."""
    times = {}
    for path in folder.glob(f"{STEM}*{EXTENSION}"):
        with suppress(OSError):
            times[path] = path.stat().st_mtime_ns
    return sorted(times, key=lambda path: times[path], reverse=True)


def _lock_path(path: Path) -> Path:
    return path.with_suffix(".lock")


def _lock_of(path: Path) -> QLockFile:
    lock = QLockFile(str(_lock_path(path)))
    lock.setStaleLockTime(0)  # however long a window is open
    return lock


# Saving what is open soon after every edit: the next start has it, however this one ends.


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
        expected = (OSError, StateFileError, MemoryError)
        self._job = Job(self, expected, succeeded=self._succeed, failed=self._fail)
        self._waits = QElapsedTimer()
        """Since the first edit that is not saved."""
        self._timer = QTimer(self, singleShot=True)
        self._timer.timeout.connect(self._save)
        self._retry = QTimer(self, singleShot=True)
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
