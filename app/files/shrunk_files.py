"""A failing case that was made small as files: a scene that opens in the window, and a Python test."""

from pathlib import Path

from app.files.file_writing import write_file
from app.files.state_files import EXTENSION, State, save_state
from app.session.opening_document import document_at
from core.study.stability.shrink import Shrunk

TEST_ENDING = ".py"


def shrunk_name(experiment: str, method: str) -> str:
    """Return what the files of a case are called, without an ending."""
    return f"{experiment}-{'-'.join(part.partition('=')[2] for part in method.split())}"


def save_shrunk(path: Path, shrunk: Shrunk, title: str) -> None:
    """Write a case as a Python test (``.py``) or as a state file (``.rasterscope``).

    Raises OSError or ValueError if it cannot be written, or for another ending; the message is one sentence.
    """
    if path.suffix == TEST_ENDING:
        write_file(path, shrunk.test.encode())
    elif path.suffix == EXTENSION:
        opening = shrunk.opening
        save_state(path, State(document_at(opening, title), opening.stage, pin=opening.pixel))
    else:
        raise ValueError(f"the file must end in {EXTENSION} or {TEST_ENDING}, got {path.name}")


def export_shrunk(shrunk: Shrunk, experiment: str, method: str, folder: Path) -> list[Path]:
    """Write a case into a folder as a Python test and as a state file; files of the same name are replaced.

    Raises OSError if a file cannot be written; the message is one sentence.
    """
    name = shrunk_name(experiment, method)
    paths = [folder / f"test_{name}{TEST_ENDING}".replace("-", "_"), folder / f"{name}{EXTENSION}"]
    for path in paths:
        save_shrunk(path, shrunk, f"{experiment}: {method}")
    return paths
