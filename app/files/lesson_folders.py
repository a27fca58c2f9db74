"""Where lessons of lecturers are found: the user's own folder, and folders that were added."""

from pathlib import Path

from app.files.folder_list import FolderList
from app.files.user_folders import data_folder
from lessons.course.catalogue import Course, with_folders

FOLDERS = FolderList("lesson-folders.txt", "lessons")
"""The folders that were added."""


def own_folder() -> Path:
    """Return the folder of this user's lessons; it may not exist yet. Errors as `data_folder`."""
    return data_folder() / "lessons"


def whole_course() -> Course:
    """Return the lessons of the program and of all folders; OSError where the list of folders cannot be read."""
    own = own_folder()
    return with_folders([*([own] if own.is_dir() else []), *FOLDERS.added()])
