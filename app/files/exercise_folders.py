"""Where exercises of teachers are found: the user's own folder, and folders that were added."""

from pathlib import Path

from app.files.folder_list import FolderList
from app.files.user_folders import data_folder
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.folders import read_folders
from lessons.exercises.question import Template

FOLDERS = FolderList("exercise-folders.txt", "exercises")
"""The folders that were added."""


def own_folder() -> Path:
    """Return the folder of this user's exercises; it may not exist yet. Errors as `data_folder`."""
    return data_folder() / "exercises"


def all_templates() -> tuple[dict[str, Template], list[str]]:
    """Return the templates that ship with the program and those of all folders, and a sentence for each skipped file.

    Raises OSError if the list of folders cannot be read.
    """
    own = own_folder()
    found, skipped = read_folders([*([own] if own.is_dir() else []), *FOLDERS.added()], TEMPLATES)
    return TEMPLATES | found, skipped
