"""The user's folder of data: kept results, attempts, own exercises."""

import os
from pathlib import Path

from PySide6.QtCore import QStandardPaths

from app.files.file_writing import FileWriteError
from app.window.preferences import FOLDER_VARIABLE


def data_folder() -> Path:
    """Return the folder; it may not exist yet.

    Raises
    ------
    FileWriteError
        If this user has none.
    """
    chosen = os.environ.get(FOLDER_VARIABLE)
    if chosen:
        return Path(chosen).absolute()
    folder = QStandardPaths.writableLocation(QStandardPaths.StandardLocation.GenericDataLocation)
    if not folder:
        raise FileWriteError(f"there is no folder for data; {FOLDER_VARIABLE} may name one")
    return Path(folder) / "rasterscope"
