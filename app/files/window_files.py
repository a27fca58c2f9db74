"""The states of windows: each window saves to a file of its own, which stays for the next start.

A lock beside the file says that a window has it open. A window that closes removes its lock; a lock whose process
is gone says that the window ended without closing. Nothing is ever overwritten by another window, and what cannot be
opened stays; only the oldest of many files are removed.
"""

import json
import os
import re
import shutil
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from secrets import token_hex
from threading import Lock

from PySide6.QtCore import QLockFile

from app.files.file_writing import FileWriteError, make_folder, remove_abandoned
from app.files.input_files import open_input
from app.files.state_arrays import ArrayFolder, array_folder
from app.files.state_files import EXTENSION, State, save_state

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
