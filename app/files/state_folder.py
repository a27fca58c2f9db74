"""The states of a folder, one after the other: what a lecture goes through."""

import re
from pathlib import Path

from app.files.state_files import EXTENSION


def states_beside(path: str) -> list[str]:
    """Return the paths of all states in the folder of a state; numbers in names count: 2 comes before 10.

    Raises OSError where the folder cannot be listed.
    """
    found = [file for file in Path(path).parent.iterdir() if file.suffix.lower() == EXTENSION]
    return [str(file) for file in sorted(found, key=_natural)]


def neighbour_of(path: str, states: list[str], direction: int) -> int | None:
    """Return the place of the next state (1) or of the one before (-1), also of one that is gone; ``None``: none."""
    here = _natural(Path(path))
    if direction > 0:
        return next((k for k, state in enumerate(states) if _natural(Path(state)) > here), None)
    return next((k for k in reversed(range(len(states))) if _natural(Path(states[k])) < here), None)


def _natural(path: Path) -> tuple[list[tuple[int, str]], str]:
    """Return what a file is sorted by: its words and numbers, and where these are alike its name."""
    parts = re.findall(r"\d+|\D+", path.stem.casefold())
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in parts], path.name
