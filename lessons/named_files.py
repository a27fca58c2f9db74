"""Folders of TOML files that people write: each file is one thing, called as the file is."""

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Protocol, TypeVar

from lessons.os_errors import os_error_reason


class Named(Protocol):
    """An exercise or a lesson."""

    @property
    def name(self) -> str:
        """That of its file."""


Thing = TypeVar("Thing", bound=Named)
Found = tuple[dict[str, Thing], list[str]]
"""Things by name in the order of reading, and a sentence for each file or folder that was skipped."""


def read_files(
    paths: Iterable[Path], read: Callable[[Path], Thing], noun: str, taken: Mapping[str, Thing]
) -> Found[Thing]:
    """Read things, ``an exercise`` each, whose names are not taken, and say why others are not read."""
    found: dict[str, Thing] = {}
    skipped = []
    for path in paths:
        try:
            thing = read(path)
        except ValueError as problem:
            skipped.append(str(problem))
        except OSError as problem:
            skipped.append(f"{path}: expected {noun}: {os_error_reason(problem)}")
        else:
            if thing.name in taken or thing.name in found:
                skipped.append(f"{path}: expected another name: there is {noun} {thing.name} already")
            else:
                found[thing.name] = thing
    return found, skipped


def read_folders(
    folders: Iterable[Path], read: Callable[[Path], Thing], noun: str, limit: int, taken: Mapping[str, Thing]
) -> Found[Thing]:
    """Read the things of folders: up to ``limit`` files of each, not those of folders inside."""
    found: dict[str, Thing] = {}
    skipped = []
    many = f"{noun.split()[-1]}s"
    for folder in folders:
        try:
            paths = sorted(path for path in folder.iterdir() if path.suffix.lower() == ".toml")
        except OSError as problem:
            skipped.append(f"{folder}: expected a folder of {many}: {os_error_reason(problem)}")
            continue
        if len(paths) > limit:
            skipped.append(f"{folder}: expected up to {limit} {many}, got {len(paths)}: the first are read")
        more, problems = read_files(paths[:limit], read, noun, {**taken, **found})
        found |= more
        skipped += problems
    return found, skipped
