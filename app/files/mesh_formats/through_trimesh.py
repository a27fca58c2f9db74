"""The boundary to trimesh: one call, its errors translated, what it could not find kept."""

import logging
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from app.files.mesh_formats.mtl import beside
from app.files.mesh_formats.reading import MeshFileError


class MissingFiles:
    """A resolver for trimesh that finds files beside the mesh file and remembers those it did not find."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.missing: list[str] = []

    def get(self, name: str) -> bytes:
        """Return the content of the file ``name`` beside the mesh file."""
        try:
            return beside(self.path, name).read_bytes()
        except OSError:
            self.missing.append(name)
            raise

    __getitem__ = get


@contextmanager
def translated_errors(path: Path, files: MissingFiles) -> Iterator[None]:
    """Turn the many kinds of exceptions that trimesh raises on broken files into MeshFileError."""
    try:
        yield
    except MeshFileError:
        raise
    except Exception as problem:
        reason = f"the file {files.missing[0]} is missing" if files.missing else describe(problem)
        kind = path.suffix[1:].upper()
        raise MeshFileError(f"{path.name} cannot be read as {kind}: {reason}") from problem


def load_with_trimesh(path: Path, files: MissingFiles) -> Any:
    """Load ``path`` as what its extension says, without any clean-up of its triangles.

    Returns
    -------
    trimesh.Scene

    Notes
    -----
    To be called under ``translated_errors``.
    """
    # trimesh takes a quarter of a second to import, which only those wait for who open such a file.
    import trimesh

    resolver: Any = files
    logging.getLogger("trimesh").setLevel(logging.ERROR)
    with path.open("rb") as file, warnings.catch_warnings():
        # numpy.fromstring only warns where a text stops being numbers: half a mesh would pass as the whole.
        warnings.filterwarnings("error", message="string or file could not be read to its end")
        return trimesh.load_scene(file, file_type=path.suffix.lower()[1:], resolver=resolver, process=False)


def describe(problem: Exception) -> str:
    """Return what an exception says, on one line; where it says little, what it means."""
    text = " ".join(str(problem).split())[:200]
    if isinstance(problem, KeyError):
        return f"{text} is missing"
    if isinstance(problem, AssertionError):
        return text or "its parts do not fit together"
    if isinstance(problem, MemoryError):
        return "there is not enough memory"
    if isinstance(problem, ModuleNotFoundError):
        # trimesh looks for a package that guesses encodings where a text is none.
        return "it holds something other than text and numbers"
    return text or type(problem).__name__
