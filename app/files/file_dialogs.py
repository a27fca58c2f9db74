"""Asking for files and folders: each question begins in the folder of the last answer, also in the next window."""

import re
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QWidget

_last = [""]
"""The folder of the last answer; empty: the one in which the program was started."""


def last_folder() -> str:
    """Return the folder of the last answer, if it is still there; else nothing."""
    return _last[0] if Path(_last[0]).is_dir() else ""


def keep_folder(folder: str) -> None:
    """Begin the next question in this folder."""
    _last[0] = folder


def ask_file(parent: QWidget | None, title: str, kinds: str) -> str:
    """Return the path of a file to be read; empty: the user has changed their mind."""
    path, _ = QFileDialog.getOpenFileName(parent, title, last_folder(), kinds)
    return _kept(path)


def ask_folder(parent: QWidget | None, title: str) -> str:
    """Return the path of a folder; empty: the user has changed their mind."""
    folder = QFileDialog.getExistingDirectory(parent, title, last_folder())
    keep_folder(folder or last_folder())
    return folder


def _kept(path: str) -> str:
    if path:
        keep_folder(str(Path(path).parent))
    return path


class SaveDialog(QFileDialog):
    """Asks for the file to save to; a name without an ending gets that of the chosen kind.

    The ending is completed before the dialog looks whether there is such a file already: nothing is written over
    without being asked about.
    """

    def __init__(self, parent: QWidget | None, title: str, name: str, kinds: str) -> None:
        """Offer a name and kinds of files, such as ``PNG picture (*.png);;PDF page (*.pdf)``."""
        super().__init__(parent, title, last_folder(), kinds)
        self.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        self.setFileMode(QFileDialog.FileMode.AnyFile)
        self.filterSelected.connect(self._take_kind)
        self._take_kind(self.selectedNameFilter())
        self.selectFile(name)

    def ask(self) -> str:
        """Return the path; empty: the user has changed their mind."""
        is_chosen = self.exec()
        self.deleteLater()
        return _kept(self.selectedFiles()[0] if is_chosen else "")

    def _take_kind(self, kind: str) -> None:
        endings: list[str] = re.findall(r"\*\.(\w+)", kind)
        if endings:
            self.setDefaultSuffix(endings[0])
