"""Writing a file whole or not at all: what was there stays until the new content is complete."""

import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from lessons.os_errors import os_error_reason

if sys.platform != "win32":
    import fcntl


PART = ".part"
"""Ending of a file that is being written."""
SECONDS_TO_BEGIN = 10.0
"""A younger unfinished file may not have its lock yet."""


class FileWriteError(OSError):
    """A file cannot be written; the message is one sentence that names it."""


def make_folder(folder: Path) -> None:
    """Make a folder and those above it, where they are not there yet; FileWriteError if it cannot be made."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        raise FileWriteError(f"{folder} cannot be made: {os_error_reason(problem)}") from problem


def write_file(path: str | Path, content: bytes) -> None:
    """Write a whole file, or nothing; its arguments and errors are those of `whole_file`."""
    with whole_file(path) as file:
        file.write(content)


def write_files(
    folder: Path, stem: str, endings: Iterable[str], content: Callable[[str], bytes | None]
) -> list[Path]:
    """Write a file for every ending, which ``content`` makes, and return the paths; others of that name are replaced.

    Raises FileWriteError if a file cannot be written.
    """
    written = []
    for ending in endings:
        made = content(ending)
        assert made is not None
        written.append(folder / f"{stem}{ending}")
        write_file(written[-1], made)
    return written


def check_writable(path: str | Path) -> None:
    """Raise FileWriteError, as `whole_file` would, where a file cannot be written: before the work for it is done."""
    target = Path(os.path.realpath(path))
    if target.is_dir():
        raise FileWriteError(f"{path} cannot be written: it is a folder")
    if os.path.exists(path) and not os.path.isfile(path):
        return  # a device or pipe
    if not target.parent.is_dir():
        raise FileWriteError(f"{path} cannot be written: there is no folder {target.parent}")
    if not os.access(target if target.exists() else target.parent, os.W_OK):
        raise FileWriteError(f"{path} cannot be written: permission is denied")


@contextmanager
def whole_file(path: str | Path) -> Iterator[BinaryIO]:
    """Open a file beside ``path`` for binary writing, and move it there when the block is done.

    Parameters
    ----------
    path : str or Path
        A link is followed; a device or pipe is written directly.

    Raises
    ------
    FileWriteError
        If it cannot be written; what stood at ``path`` is unchanged.
    """
    target = Path(os.path.realpath(path))
    try:
        check_writable(path)
        if os.path.exists(path) and not os.path.isfile(path):
            with open(path, "wb") as file:
                yield file
            return
        with _beside(target) as file:
            yield file
    except FileWriteError:
        raise
    except OSError as problem:
        raise FileWriteError(f"{path} cannot be written: {os_error_reason(problem)}") from problem


@contextmanager
def _beside(target: Path) -> Iterator[BinaryIO]:
    """Open a new file in the folder of ``target`` that replaces it at the end, or disappears."""
    remove_abandoned(target.parent, _part_prefix(target))
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=_part_prefix(target), suffix=PART)
    try:
        with os.fdopen(handle, "wb") as file:
            if sys.platform != "win32":
                with suppress(OSError):  # not every network drive has locks
                    fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            yield file
            file.flush()
            os.fsync(file.fileno())
        os.chmod(name, _mode(target))
        os.replace(name, target)
    except BaseException:
        with suppress(OSError):
            os.unlink(name)
        raise


def remove_abandoned(folder: Path, prefix: str) -> None:
    """Remove unfinished files whose writer was killed; the others are locked, or have just begun."""
    for entry in os.scandir(folder):
        if entry.name.startswith(prefix) and entry.name.endswith(PART):
            with suppress(OSError):
                if time.time() - entry.stat().st_mtime > SECONDS_TO_BEGIN and not _is_locked(entry.path):
                    os.unlink(entry.path)


def _part_prefix(target: Path) -> str:
    return f".{target.name[:40]}."


def _is_locked(path: str) -> bool:
    """Return whether another process writes to this file; Windows itself keeps a file that is open."""
    if sys.platform != "win32":
        with open(path, "rb") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
            except OSError:
                return True
    return False


def _mode(target: Path) -> int:
    """Return the permissions of the file that is replaced, or those of a new one."""
    if target.exists():
        return target.stat().st_mode & 0o7777
    umask = os.umask(0)
    os.umask(umask)
    return 0o666 & ~umask
