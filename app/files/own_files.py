"""Which state files this program wrote on this machine: they carry a mark that nobody else can make."""

import hmac
import os
import secrets
from contextlib import suppress
from pathlib import Path

from app.files.file_writing import FileWriteError, make_folder, write_file
from app.files.input_files import read_input

KEY_NAME = "state.key"
KEY_BYTES = 32


def mark_of(path: Path, allows_outside: bool) -> str:
    """Return the mark of a state that names the mesh file ``path``, absolute; empty where no key can be kept.

    ``allows_outside``: the user has allowed that the mesh file reads files outside its folder.
    """
    key = _key()
    return (
        hmac.digest(key, f"{allows_outside} {path}".encode(errors="surrogateescape"), "sha256").hex()
        if key
        else ""
    )


def is_marked(mark: str, path: Path, allows_outside: bool) -> bool:
    """Return whether a mark is that of `mark_of`, made by this program on this machine."""
    return bool(mark) and hmac.compare_digest(mark.encode(), mark_of(path, allows_outside).encode())


def is_in_own_folder(path: Path) -> bool:
    """Return whether a file lies where the program keeps what was open last."""
    try:
        return path.resolve().is_relative_to(_folder().resolve())
    except FileWriteError:
        return False


def _folder() -> Path:
    from app.files.user_folders import preferences_folder  # Qt takes a moment: not before a mark is needed.

    return preferences_folder()


def _key() -> bytes:
    """Return the secret number of this user, which is made at its first use; empty where it cannot be kept."""
    with suppress(OSError):
        path = _folder() / KEY_NAME
        if not os.path.lexists(path):
            make_folder(path.parent)
            write_file(path, secrets.token_bytes(KEY_BYTES))
            path.chmod(0o600)
        key = read_input(path, KEY_BYTES)
        if len(key) == KEY_BYTES:
            return key
    return b""
