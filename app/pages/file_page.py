"""A page whose result is written to files by their ending, copied, and opened again."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import Slot
from PySide6.QtWidgets import QPushButton, QWidget

from app.export.views import copy_widget, export_widget
from app.files.file_writing import whole_file
from app.files.kept_results import KeptResults
from app.files.save_dialog import SaveDialog
from app.pages.page_bar import Page


@dataclass(frozen=True)
class FileWords:
    """What is said of the files of a page."""

    noun: str
    """What is written: ``study``."""
    view: str
    """What is copied as a picture: ``charts``."""
    nothing: str
    """What to do while there is nothing to be written."""
    kinds: str
    """Kinds of files with their endings, as ``QFileDialog`` takes them."""
    export_tip: str
    copy_tip: str


class FilePage(Page):
    """Writes what is finished; a page says what that is, and what the content of a file with an ending is."""

    def __init__(self, words: FileWords, kept: KeptResults, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._words, self.kept = words, kept
        kept.setParent(self)
        kept.failed.connect(self.edit_refused)
        self.export_button = self._button("Export…", words.export_tip, self.ask_export)
        self.copy_button = self._button("Copy", words.copy_tip, self.copy)

    def _button(self, text: str, tip: str, action: Callable[[], None]) -> QPushButton:
        button = QPushButton(text, self)
        button.setToolTip(tip)
        button.clicked.connect(action)
        return button

    # What a page says.

    def file_stem(self) -> str:
        """Return what a file of the finished result is called without its ending; empty: nothing is finished."""
        raise NotImplementedError

    def file_content(self, ending: str) -> bytes | None:
        """Return the content of a file of the finished result; ``None``: the view as it is seen is written."""
        raise NotImplementedError

    def show_file(self, path: str) -> None:
        """Show the result in a file; ValueError with one sentence where that is not possible."""
        raise NotImplementedError

    # What all of them do.

    def keep_results(self) -> None:
        """Show the results of the last start, and keep those that come from now on."""
        self.kept.begin()

    def stop(self) -> None:
        """Let what is being written be written."""
        self.kept.shut_down()

    def open_path(self, path: str) -> None:
        """Open a saved result and show it as what it is."""
        try:
            self.show_file(path)
        except ValueError as error:
            self.edit_refused.emit(f"{error}. What is shown stays as it was.")

    @Slot()
    def ask_export(self) -> None:
        """Ask where the result is to go, and write it there."""
        if self._is_finished():
            title, name = f"Export {self._words.noun}", f"{self.file_stem()}.png"
            self.ask_path(title, name, self._words.kinds, self.export_to)

    def export_to(self, path: str) -> None:
        """Write the result by the ending of the file."""
        if self._is_finished():
            self.tell_written(path, lambda: self._write(path), "exported", self._words.noun)

    def ask_path(self, title: str, name: str, kinds: str, write: Callable[[str], None]) -> None:
        """Ask for a file, and write to it unless there is none."""
        path = SaveDialog(self.window(), title, name, kinds).ask()
        if path:
            write(path)

    def tell_written(self, path: str, write: Callable[[], None], done: str, noun: str) -> None:
        """Write, and say that it is done, or why not."""
        try:
            write()
        except (OSError, ValueError) as error:
            self.edit_refused.emit(f"The {noun} was not {done}: {error}")
        else:
            self.message_sent.emit(f"{done.capitalize()} {Path(path).name}.")

    def _is_finished(self) -> bool:
        if not self.file_stem():
            self.message_sent.emit(f"There is nothing to export yet: {self._words.nothing}.")
            return False
        return True

    def _write(self, path: str) -> None:
        content = self.file_content(Path(path).suffix.lower())
        if content is None:
            export_widget(self.main_view(), path)
            return
        with whole_file(path) as file:
            file.write(content)

    @Slot()
    def copy(self) -> None:
        """Put the view on the clipboard as a picture."""
        copy_widget(self.main_view())
        self.message_sent.emit(f"Copied the {self._words.view}.")
