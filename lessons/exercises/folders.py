"""Folders of exercises that teachers write: TOML only, of which nothing runs as code."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import Template
from lessons.os_errors import os_error_reason

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
    found: dict[str, Template] = {}
    skipped = []
    for folder in folders:
        try:
            paths = sorted(path for path in folder.iterdir() if path.suffix.lower() == ".toml")
        except OSError as problem:
            skipped.append(f"{folder}: expected a folder of exercises: {os_error_reason(problem)}")
            continue
        if len(paths) > FILE_LIMIT:
            skipped.append(
                f"{folder}: expected up to {FILE_LIMIT} exercises, got {len(paths)}: the first are read"
            )
        for path in paths[:FILE_LIMIT]:
            try:
                template = read_exercise(path)
            except ValueError as problem:
                skipped.append(str(problem))
            except OSError as problem:
                skipped.append(f"{path}: expected an exercise: {os_error_reason(problem)}")
            else:
                if template.name in shipped or template.name in found:
                    skipped.append(
                        f"{path}: expected another name: there is an exercise {template.name} already"
                    )
                else:
                    found[template.name] = template
    return found, skipped
