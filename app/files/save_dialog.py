"""Asking where a file is to be saved; a name without an ending gets that of the chosen kind."""

import re

from PySide6.QtWidgets import QFileDialog, QWidget


class SaveDialog(QFileDialog):
    """Asks for the file to save to.

    The ending is completed before the dialog looks whether there is such a file already: nothing is written over
    without being asked about.
    """

    def __init__(self, parent: QWidget | None, title: str, name: str, kinds: str) -> None:
        """Offer a name and kinds of files, such as ``PNG picture (*.png);;PDF page (*.pdf)``."""
        super().__init__(parent, title, "", kinds)
        self.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        self.setFileMode(QFileDialog.FileMode.AnyFile)
        self.filterSelected.connect(self._take_kind)
        self._take_kind(self.selectedNameFilter())
        self.selectFile(name)

    def ask(self) -> str:
        """Return the path; empty: the user has changed their mind."""
        is_chosen = self.exec()
        self.deleteLater()
        return self.selectedFiles()[0] if is_chosen else ""

    def _take_kind(self, kind: str) -> None:
        endings: list[str] = re.findall(r"\*\.(\w+)", kind)
        if endings:
            self.setDefaultSuffix(endings[0])
