"""A list of folders that the user has added, kept among the files of the user."""

import os
from dataclasses import dataclass
from pathlib import Path

from app.files.file_writing import make_folder, write_file
from app.files.input_files import read_input
from app.files.user_folders import data_folder

SIZE_LIMIT = 1 << 16


@dataclass(frozen=True)
class FolderList:
    """One folder a line, absolute."""

    file_name: str
    """Of the list."""
    what: str
    """What the folders hold, as ``exercises``."""

    def added(self) -> list[Path]:
        """Return the folders that were added; OSError if their list cannot be read."""
        try:
            content = read_input(data_folder() / self.file_name, SIZE_LIMIT)
        except FileNotFoundError:
            return []
        lines = content.decode("utf-8", "surrogateescape").splitlines()
        return [Path(line) for line in lines if line.strip() and "\0" not in line]

    def add(self, folder: str | Path) -> None:
        """Look in a folder from now on.

        Raises ValueError if there is no such folder; the message is one sentence; OSError if the list of folders cannot
        be written.
        """
        path = Path(os.path.abspath(folder))
        if not path.is_dir() or len(str(path).splitlines()) != 1:
            raise ValueError(f"expected a folder of {self.what}, got {str(folder)!r}")
        if path not in self.added():
            self._write([*self.added(), path])

    def remove(self, folder: str | Path) -> None:
        """Look no more in a folder; its files stay.

        Raises ValueError if it was not added; the message is one sentence; OSError if the list of folders cannot be
        written.
        """
        path = Path(os.path.abspath(folder))
        left = [other for other in self.added() if other != path]
        if left == self.added():
            raise ValueError(f"expected a folder that was added, got {str(folder)!r}")
        self._write(left)

    def _write(self, folders: list[Path]) -> None:
        make_folder(data_folder())
        content = "".join(f"{folder}\n" for folder in folders)
        write_file(data_folder() / self.file_name, content.encode("utf-8", "surrogateescape"))
