"""Opening files that are read: regular files only, so that no pipe is waited for and no device read without end."""

import errno
import os
import stat
from io import TextIOWrapper
from pathlib import Path
from typing import BinaryIO


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
