"""Files read and written safely: regular ones only, whole or not at all, and none outside a folder unasked."""

import errno
import os
import re
import stat
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from io import TextIOWrapper
from pathlib import Path
from typing import BinaryIO

from lessons.os_errors import os_error_reason

# Names of files: those that are not text (some systems allow any bytes, kept as lone surrogates), and
# endings.


VIEW_ENDINGS = (".png", ".svg", ".pdf")
"""Of pictures of a view."""
IMAGE_FORMATS = {
    ".png": "PNG",
    ".ppm": "PPM",
    ".pgm": "PPM",
    ".bmp": "BMP",
    ".tga": "TGA",
    ".jpg": "JPEG",
    ".jpeg": "JPEG",
}
"""Pillow's names of the images that other programs drew, by ending."""
DRAWN_ENDINGS = (*IMAGE_FORMATS, ".npz", ".csv")
"""Of pictures that other programs drew."""


def shown_name(name: str) -> str:
    """Return a name with a replacement character for each byte that is not text, to be shown and saved."""
    return re.sub("[\ud800-\udfff]", "\N{REPLACEMENT CHARACTER}", name)


def is_text(name: str) -> bool:
    """Return whether a name can be written to a file of text, and be read again as the same name."""
    return shown_name(name) == name


# Opening files that are read: regular files only, so that no pipe is waited for and no device read without
# end.


def open_input(path: str | Path) -> BinaryIO:
    """Open a regular file for reading bytes.

    Raises
    ------
    OSError
        If it cannot be opened, or is a folder, a pipe, a socket or a device.

    Notes
    -----
    What the path names is asked of the open file, so that nothing can take its place in between. A pipe is opened
    without waiting for somebody who writes into it.
    """
    file = open(path, "rb", opener=_open_at_once)  # noqa: SIM115
    if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
        file.close()
        raise OSError(errno.EINVAL, "it is not a file but a pipe or a device", str(path))
    return file


def _open_at_once(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def open_text_input(path: str | Path) -> TextIOWrapper:
    """Open a regular file as UTF-8 text, in which what is no UTF-8 is replaced; errors as `open_input`."""
    return TextIOWrapper(open_input(path), encoding="utf-8-sig", errors="replace")


def read_input(path: str | Path, limit: int) -> bytes:
    """Return the content of a regular file of at most ``limit`` bytes; errors as `open_input`."""
    with open_input(path) as file:
        size = os.fstat(file.fileno()).st_size
        if size > limit:
            raise OSError(errno.EFBIG, f"it has {size} bytes, more than the limit of {limit}", str(path))
        return file.read(limit)


# The files that another file names, as a mesh its textures: read from its folder, from elsewhere only if
# allowed.


class OutsideWarning(str):
    """A warning about a file that was not read because it lies outside the folder of the file that names it."""

    __slots__ = ()


class NamedFileError(ValueError):
    """A named file is not to be had; the message goes on after its name, as ``does not exist``."""


class OutsideError(NamedFileError):
    """A named file lies outside the folder of the file that names it, and only its folder is allowed."""


@dataclass(frozen=True)
class NamedFiles:
    """Finds the files that a file names."""

    path: Path
    """The file that was opened."""
    allows_outside: bool = False
    """Whether files may be read that lie outside its folder."""

    def find(self, name: str, folder: Path | None = None) -> Path:
        """Return where the file ``name`` is.

        Parameters
        ----------
        name : str
            The name, as the file gives it.
        folder : Path, optional
            The folder of the file in which it is written; that of ``path`` by default.

        Raises
        ------
        OutsideError
            If it is outside the folder of ``path``, with all links followed, and that is not allowed.
        NamedFileError
            If it is not there, or on a network.

        Notes
        -----
        Names written on another machine may have backslashes, or folders that are not here; then the file that stands
        beside is meant. Nothing outside the folder is even looked for unless that is allowed: a look at a network path
        may already send the user's name and password.
        """
        name = name.strip().strip('"').replace("\\", "/")
        folder = self.path.parent if folder is None else folder
        whole = Path(os.path.normpath(folder / name))
        near = folder / name.rsplit("/", 1)[-1]
        on_network = is_network_path(name)
        may_look = not on_network and (self.allows_outside or self._is_inside(whole))
        for place in [whole, near] if may_look else [near]:
            if (self.allows_outside or self._is_inside(place)) and os.path.isfile(place):
                return place
        if on_network:
            raise NamedFileError("is on a network, from where no named file is read")
        if not may_look or (
            os.path.lexists(whole) and not self.allows_outside and not self._is_inside(whole)
        ):
            raise OutsideError(f"is outside the folder of {self.path.name}")
        raise NamedFileError("is not a file" if os.path.lexists(whole) else "does not exist")

    def _is_inside(self, place: Path) -> bool:
        """Return whether a place is in the folder of ``path`` or below, by its name and with all links followed."""
        folder = os.path.abspath(self.path.parent)
        try:
            return Path(os.path.abspath(place)).is_relative_to(folder) and Path(
                os.path.realpath(place)
            ).is_relative_to(os.path.realpath(folder))
        except ValueError:  # a zero byte, which no name of a file has
            return False


def left_out(what: str, problem: NamedFileError) -> str:
    """Return the warning that a named file, ``what``, is not used."""
    text = f"{what} {problem}; it is left out"
    return OutsideWarning(text) if isinstance(problem, OutsideError) else text


def is_network_path(name: str) -> bool:
    """Return whether a name is that of a file on another machine: ``//server/share`` or ``http://server``."""
    return re.match(r"[/\\]{2}|[A-Za-z][A-Za-z0-9+.-]+://", name) is not None


# Writing a file whole or not at all: what was there stays until the new content is complete.


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
    from tempfile import mkstemp  # It takes a moment: not where files are only read.

    handle, name = mkstemp(dir=target.parent, prefix=_part_prefix(target), suffix=PART)
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
