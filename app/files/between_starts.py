"""What is kept from one start to the next: preferences, and the state of each window soon after every edit.

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
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from PySide6.QtCore import QElapsedTimer, QLockFile, QObject, QTimer, Signal, SignalInstance, Slot

from app.background import Job
from app.files.file_access import (
    FileWriteError,
    make_folder,
    open_input,
    read_input,
    remove_abandoned,
    write_file,
)
from app.files.saved_records import field_problem
from app.files.state_arrays import ArrayFolder, array_folder
from app.files.state_files import EXTENSION, State, StateFileError, save_state
from app.files.state_models import Breakpoints, TextSize
from app.files.user_folders import preferences_folder
from app.session.document import Document
from app.session.moment import Change
from app.session.session import Session
from core.records.words import sentences
from core.stages.declared import STAGES
from lessons.os_errors import os_error_reason

# What the program remembers between two starts: a small JSON file in the user's configuration folder.


FILE_NAME = "preferences.json"
RECENT_LIMIT = 10
SIZE_LIMIT = 1 << 22
"""Most bytes of the file."""


Base64 = Annotated[str, Field(pattern=r"^[A-Za-z0-9+/]*={0,2}$")]


class Preferences(BaseModel):
    """Everything that is restored at the next start."""

    model_config = ConfigDict(strict=True, frozen=True, extra="ignore", allow_inf_nan=False)

    recent_files: list[str] = []
    """Absolute paths, the last opened first."""
    folder: str = ""
    """Of the file that was chosen last."""
    theme: Literal["system", "light", "dark", "presenter"] = "system"
    text_size: TextSize = 0
    """Percent of the usual size of the text; 0: as large as the desktop's."""
    geometry: Base64 = ""
    """Place and size of the window, as Qt saves them, in base 64."""
    layout: dict[str, Base64] = {}
    """Sizes of panes by name, as Qt saves them, in base 64."""
    shown_panes: list[str] = ["inspector", "details", "navigator", "run"]
    """Panes of the Step page that are shown; the others are folded away."""
    folded_cards: list[str] = list(STAGES)
    """Stages whose card is folded."""
    page: str = "step"
    """Page that was shown last."""
    shows_start: bool = False
    """Whether the start page is shown although the last scene is restored."""
    shows_all_methods: bool = False
    """Whether the pane Methods shows those beyond a first course too."""
    level: Annotated[int, Field(ge=0, le=4)] = 3
    """Level of stepping, a ``core.records.steps.Level``."""
    speed: Annotated[float, Field(gt=0)] = 4.0
    """Steps per second while playing."""
    keys: dict[str, list[str]] = {}
    """Changed keys by the names of their actions, as Qt's portable texts."""
    has_character_keys: bool = True
    """Whether letters, digits and signs alone are keys."""


def with_recent_file(preferences: Preferences, path: str | Path) -> Preferences:
    """Return the preferences with ``path`` as the file opened last."""
    path = os.path.abspath(path)
    recent = [path, *(other for other in preferences.recent_files if other != path)]
    return preferences.model_copy(update={"recent_files": recent[:RECENT_LIMIT]})


def load_preferences() -> tuple[Preferences, str]:
    """Read the preferences.

    Returns
    -------
    Preferences
        Those of the file; the defaults where there is none or it is broken.
    str
        What to tell the user, empty if all is well. A broken file is kept under the ending ``.broken``.
    """
    try:
        path = preferences_folder() / FILE_NAME
        content = read_input(path, SIZE_LIMIT)
    except FileNotFoundError:
        return Preferences(), ""
    except OSError as problem:
        reason = os_error_reason(problem)
        return Preferences(), f"The preferences cannot be read: {reason}. The defaults are used."
    try:
        return Preferences.model_validate_json(content), ""
    except ValidationError as problem:
        return Preferences(), _set_aside(path, field_problem(problem))


def _set_aside(path: Path, reason: str) -> str:
    """Rename a broken file and say so."""
    broken = path.with_name(path.name + ".broken")
    try:
        os.replace(path, broken)
    except OSError as problem:
        kept = f"it could not be set aside ({os_error_reason(problem)})"
    else:
        kept = f"it is kept as {broken.name}"
    return f"The preferences were broken: {reason}. The defaults are used; {kept}."


def save_preferences(preferences: Preferences) -> None:
    """Write the preferences, and the folder where it is missing; recent files of other windows stay.

    Raises OSError if that is not possible; the message is one sentence.
    """
    folder = preferences_folder()
    make_folder(folder)
    recent = dict.fromkeys([*preferences.recent_files, *_recent_of_others(folder)])
    preferences = preferences.model_copy(update={"recent_files": list(recent)[:RECENT_LIMIT]})
    write_file(folder / FILE_NAME, preferences.model_dump_json(indent=1).encode() + b"\n")


def _recent_of_others(folder: Path) -> list[str]:
    """Return the recent files that stand in the preferences now; another window may have saved them."""
    try:
        return Preferences.model_validate_json(read_input(folder / FILE_NAME, SIZE_LIMIT)).recent_files
    except (OSError, ValidationError):
        return []


# The states of windows: each window saves to a file of its own, which stays for the next start.


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
