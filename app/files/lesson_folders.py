"""Where lessons of lecturers are found: the user's own folder, and folders that were added."""

import re
from pathlib import Path
from typing import TYPE_CHECKING

from app.files.folder_list import FolderList
from app.files.input_files import open_input
from app.files.user_folders import data_folder

if TYPE_CHECKING:
    from lessons.course.catalogue import Course  # All kinds of answers come along: not at every start.

FOLDERS = FolderList("lesson-folders.txt", "lessons")
"""The folders that were added."""
_STEP = re.compile(rb"^\s*\[\[\s*step\s*\]\]", re.MULTILINE)


def own_folder() -> Path:
    """Return the folder of this user's lessons; it may not exist yet. Errors as `data_folder`."""
    return data_folder() / "lessons"


def is_lesson_file(path: str) -> bool:
    """Return whether a file is a lesson: the first 64 KiB of a ``.toml`` file have a step."""
    if not path.lower().endswith(".toml"):
        return False
    try:
        with open_input(path) as file:
            return _STEP.search(file.read(1 << 16)) is not None
    except OSError:
        return False  # Who opens it as something else says why it cannot be read.


def whole_course() -> "Course":
    """Return the lessons of the program and of all folders; OSError where the list of folders cannot be read."""
    from lessons.course.catalogue import with_folders

    own = own_folder()
    return with_folders([*([own] if own.is_dir() else []), *FOLDERS.added()])
