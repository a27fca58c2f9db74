"""Where the program keeps what is the user's: data and preferences."""

import os
from pathlib import Path

from PySide6.QtCore import QStandardPaths

from app.files.file_writing import FileWriteError

FOLDER_VARIABLE = "RASTERSCOPE_CONFIG"
"""Environment variable that names another folder for all of it."""

ANSWERS = "answers.json"
"""File of answers in progress, in the folder of data."""


def data_folder() -> Path:
    """Return the folder of kept results, attempts and own exercises; see `user_folder`."""
    return user_folder(QStandardPaths.StandardLocation.GenericDataLocation, "data")


def has_answers() -> bool:
    """Return whether answers to exercises have been kept: what reads them is not imported before."""
    try:
        return (data_folder() / ANSWERS).is_file()
    except OSError:
        return False


def preferences_folder() -> Path:
    """Return the folder of preferences and of the states of windows; see `user_folder`."""
    return user_folder(QStandardPaths.StandardLocation.GenericConfigLocation, "preferences")


def user_folder(location: QStandardPaths.StandardLocation, purpose: str) -> Path:
    """Return the program's folder at a location; it may not exist yet.

    Raises FileWriteError if this user has none.
    """
    chosen = os.environ.get(FOLDER_VARIABLE)
    if chosen:
        return Path(chosen).absolute()
    # Not a location of applications: that one depends on how the running program is called.
    folder = QStandardPaths.writableLocation(location)
    if not folder:
        raise FileWriteError(f"there is no folder for {purpose}; {FOLDER_VARIABLE} may name one")
    return Path(folder) / "rasterscope"
