"""Folders of exercises that teachers write: TOML only, of which nothing runs as code."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from lessons import named_files
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import Template

FILE_LIMIT = 300
"""Most files of a folder: each is drawn once."""


def read_folders(
    folders: Iterable[Path], shipped: Mapping[str, Template]
) -> tuple[dict[str, Template], list[str]]:
    """Read the exercises of folders.

    Parameters
    ----------
    folders : iterable of Path
        Each holds ``.toml`` files; folders inside them are not looked into.
    shipped : mapping
        Templates that come with the program, whose names are taken.

    Returns
    -------
    dict
        Templates by name, which is that of the file, in the order of folders and names.
    list of str
        A sentence for each file or folder that was skipped: which one, where, and what was expected.
    """
    return named_files.read_folders(folders, read_exercise, "an exercise", FILE_LIMIT, shipped)
