"""Where the program keeps what is the user's, and where lessons are found: folders of its own and added ones."""

import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from app.files.file_access import FileWriteError, make_folder, open_input, read_input, write_file

if TYPE_CHECKING:
    from lessons.attempts.store import AttemptFile
    from lessons.course.catalogue import Course
    from lessons.exercises.question import Template


# Where the program keeps what is the user's: data and preferences.


FOLDER_VARIABLE = "RASTERSCOPE_CONFIG"
"""Environment variable that names another folder for all of it."""

ANSWERS = "answers.json"
"""File of answers in progress, in the folder of data."""


def data_folder() -> Path:
    """Return the folder of kept results, attempts and own exercises; see `user_folder`."""
    return user_folder("GenericDataLocation", "data")


def has_answers() -> bool:
    """Return whether answers to exercises have been kept: what reads them is not imported before."""
    try:
        return (data_folder() / ANSWERS).is_file()
    except OSError:
        return False


def preferences_folder() -> Path:
    """Return the folder of preferences and of the states of windows; see `user_folder`."""
    return user_folder("GenericConfigLocation", "preferences")


def user_folder(location: str, purpose: str) -> Path:
    """Return the program's folder at a location, named as in ``QStandardPaths``; it may not exist yet.

    Raises FileWriteError if this user has none.
    """
    chosen = os.environ.get(FOLDER_VARIABLE)
    if chosen:
        return Path(chosen).absolute()
    from PySide6.QtCore import QStandardPaths  # Qt takes a moment: not before a folder is asked for.

    # Not a location of applications: that one depends on how the running program is called.
    folder = QStandardPaths.writableLocation(QStandardPaths.StandardLocation[location])
    if not folder:
        raise FileWriteError(f"there is no folder for {purpose}; {FOLDER_VARIABLE} may name one")
    return Path(folder) / "rasterscope"


# Where the attempts of this user are kept.


MOST_ATTEMPT_BYTES = 1 << 26
"""Most bytes of an imported file."""


def attempt_file() -> "AttemptFile":
    """Return the file of attempts in the user's folder of data; FileWriteError where there is none."""
    from lessons.attempts.store import FILE_NAME, AttemptFile

    return AttemptFile(data_folder() / FILE_NAME)


# A list of folders that the user has added, kept among the files of the user.


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


# Where exercises of teachers are found: the user's own folder, and folders that were added.


EXERCISE_FOLDERS = FolderList("exercise-folders.txt", "exercises")
"""The folders that were added."""


def own_exercise_folder() -> Path:
    """Return the folder of this user's exercises; it may not exist yet. Errors as `data_folder`."""
    return data_folder() / "exercises"


def all_templates() -> tuple[dict[str, "Template"], list[str]]:
    """Return the templates that ship with the program and those of all folders, and a sentence for each skipped file.

    Raises OSError if the list of folders cannot be read.
    """
    from lessons.exercises.catalogue import TEMPLATES
    from lessons.exercises.exercise_file import read_folders

    own = own_exercise_folder()
    found, skipped = read_folders([*([own] if own.is_dir() else []), *EXERCISE_FOLDERS.added()], TEMPLATES)
    return TEMPLATES | found, skipped


# Where lessons of lecturers are found: the user's own folder, and folders that were added.


LESSON_FOLDERS = FolderList("lesson-folders.txt", "lessons")
"""The folders that were added."""
_STEP = re.compile(rb"^\s*\[\[\s*step\s*\]\]", re.MULTILINE)


def own_lesson_folder() -> Path:
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

    own = own_lesson_folder()
    return with_folders([*([own] if own.is_dir() else []), *LESSON_FOLDERS.added()])
