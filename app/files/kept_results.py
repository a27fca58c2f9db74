"""The last result of every family or experiment, kept from one start of the window to the next.

They are the files that an export writes, in a folder of the user's data: one for each name, replaced by the next
result of that name. All of them together stay below a size; the oldest go first.
"""

from collections.abc import Callable
from pathlib import Path
from threading import Lock
from typing import Any

from PySide6.QtCore import QObject, Signal, Slot

from app.background.workers import JobGroup, Progress
from app.files.file_writing import FileWriteError, make_folder, write_file
from app.files.user_folders import data_folder

LARGEST = 4 << 20
"""Bytes of one file; a result that is larger is not kept."""
LARGEST_TOGETHER = 32 << 20
"""Bytes of all files of the folder."""
ENDING = ".json"
EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
"""A result of each kind, which this program made on another computer: shown where there is none of the user's own."""
_turn = Lock()
"""Two pages write to one folder, and look together at how much there is in it."""


def results_folder() -> Path:
    """Return the folder of kept results; it may not exist yet. Errors as `data_folder`."""
    return data_folder() / "results"


class KeptResults(JobGroup):
    """Writes results and reads them again, off the GUI thread; does nothing before it has begun."""

    found = Signal(object, bool)
    """A result of an earlier start, or where nothing was kept the example, and whether it is that."""
    failed = Signal(str)
    """Why something cannot be kept or read again, as a sentence."""

    def __init__(self, kind: str, load: Callable[[Path], Any], parent: QObject | None = None) -> None:
        """Keep results of a ``kind``, as ``study``, the first word of its files; ``load`` opens one of them."""
        super().__init__(parent)
        self._kind, self._load = kind, load
        self._has_begun = False
        self._reading, self._writing = (self.add_job((OSError, ValueError)) for _ in range(2))
        self._reading.part_done.connect(self._take)
        self._reading.succeeded.connect(self._tell_unread)
        for job in (self._reading, self._writing):
            job.failed.connect(self._tell)

    def begin(self) -> None:
        """Read what was kept, and keep what comes from now on."""
        self._has_begun = True

        def work(
            progress: Progress, is_cancelled: Callable[[], bool], part_done: Callable[[Any], None]
        ) -> tuple[str, ...]:
            unread = []
            paths = sorted(results_folder().glob(f"{self._kind}-*{ENDING}"))
            if not paths:
                part_done((self._load(EXAMPLES / f"{self._kind}{ENDING}"), True))
            for path in paths:
                if is_cancelled():
                    break
                try:
                    part_done((self._load(path), False))
                except ValueError as problem:
                    unread.append(str(problem))
            return tuple(unread)

        self._reading.start_in_parts(work)

    @Slot(object)
    def _take(self, read: tuple[Any, bool]) -> None:
        self.found.emit(*read)

    def keep(self, name: str, content: Callable[[], bytes | None]) -> None:
        """Replace the last result of this ``name``."""
        if not self._has_begun:
            return

        def work() -> None:
            written = content()
            assert written is not None
            with _turn:
                write_result(results_folder(), f"{self._kind}-{name}{ENDING}", written)

        self._writing.call(work)

    @Slot(object)
    def _tell_unread(self, unread: tuple[str, ...]) -> None:
        if unread:
            self.failed.emit(f"Results of the last start: {'; '.join(unread)}.")

    @Slot(object)
    def _tell(self, error: Exception) -> None:
        self.failed.emit(f"The result could not be kept for the next start: {error}.")


def write_result(folder: Path, name: str, content: bytes) -> None:
    """Write one result whole, and remove the oldest of the folder that are too many.

    Raises OSError if it cannot be written or is too large; the previous results are unchanged.
    """
    if len(content) > LARGEST:
        raise FileWriteError(f"{name} is larger than {LARGEST >> 20} MiB")
    make_folder(folder)
    write_file(folder / name, content)
    remove_oldest(folder, LARGEST_TOGETHER)


def remove_oldest(folder: Path, limit: int) -> None:
    """Remove results, the oldest first, until those that are left have at most ``limit`` bytes together."""
    files = [(path, path.stat()) for path in folder.glob(f"*{ENDING}")]
    total = 0
    for path, status in sorted(files, key=lambda found: found[1].st_mtime_ns, reverse=True):
        total += status.st_size
        if total > limit:
            path.unlink(missing_ok=True)
