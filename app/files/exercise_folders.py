"""Where exercises of teachers are found: the user's own folder, and folders that were added."""

import os
from pathlib import Path

from app.files.file_writing import make_folder, write_file
from app.files.input_files import read_input
from app.files.user_folders import data_folder
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.folders import read_folders
from lessons.exercises.question import Template

LIST_NAME = "exercise-folders.txt"
"""One folder a line, absolute."""
SIZE_LIMIT = 1 << 16


def own_folder() -> Path:
    """Return the folder of this user's exercises; it may not exist yet. Errors as `data_folder`."""
    return data_folder() / "exercises"


def added_folders() -> list[Path]:
    """Return the folders that were added; OSError if their list cannot be read."""
    try:
        content = read_input(data_folder() / LIST_NAME, SIZE_LIMIT)
    except FileNotFoundError:
        return []
    lines = content.decode("utf-8", "surrogateescape").splitlines()
    return [Path(line) for line in lines if line.strip() and "\0" not in line]


def add_folder(folder: str | Path) -> None:
    """Look for exercises in a folder from now on.

    Raises ValueError if there is no such folder; the message is one sentence; OSError if the list of folders cannot be
    written.
    """
    path = Path(os.path.abspath(folder))
    if not path.is_dir() or len(str(path).splitlines()) != 1:
        raise ValueError(f"expected a folder of exercises, got {str(folder)!r}")
    if path not in added_folders():
        _write([*added_folders(), path])


def remove_folder(folder: str | Path) -> None:
    """Look no more for exercises in a folder; its files stay.

    Raises ValueError if it was not added; the message is one sentence; OSError if the list of folders cannot be
    written.
    """
    path = Path(os.path.abspath(folder))
    left = [other for other in added_folders() if other != path]
    if left == added_folders():
        raise ValueError(f"expected a folder that was added, got {str(folder)!r}")
    _write(left)


def all_templates() -> tuple[dict[str, Template], list[str]]:
    """Return the templates that ship with the program and those of all folders, and a sentence for each skipped file.

    Raises OSError if the list of folders cannot be read.
    """
    own = own_folder()
    found, skipped = read_folders([*([own] if own.is_dir() else []), *added_folders()], TEMPLATES)
    return TEMPLATES | found, skipped


def _write(folders: list[Path]) -> None:
    make_folder(data_folder())
    content = "".join(f"{folder}\n" for folder in folders)
    write_file(data_folder() / LIST_NAME, content.encode("utf-8", "surrogateescape"))
