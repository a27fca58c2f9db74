"""The boundary to trimesh: one call, its errors translated."""

import logging
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from app.files.input_files import open_input
from app.files.mesh_formats.reading import MeshFileError


@contextmanager
def translated_errors(path: Path) -> Iterator[None]:
    """Turn the many kinds of exceptions that trimesh raises on broken files into MeshFileError."""
    try:
        yield
    except MemoryError:
        raise
    except Exception as problem:
        kind = path.suffix[1:].upper()
        raise MeshFileError(
            f"{path.name} cannot be read as {kind}: some of its triangles are no three corners of three numbers"
        ) from problem


def load_with_trimesh(path: Path) -> Any:
    """Load ``path`` as what its extension says, without any clean-up of its triangles.

    To be called under ``translated_errors``.
    """
    # trimesh takes a quarter of a second to import, which only those wait for who open such a file.
    import trimesh

    logging.getLogger("trimesh").setLevel(logging.CRITICAL)
    # Infinite numbers would warn in its products; they are refused later.
    with open_input(path) as file, warnings.catch_warnings(), np.errstate(all="ignore"):
        # numpy.fromstring only warns where a text stops being numbers: half a mesh would pass as the whole.
        warnings.filterwarnings("error", message="string or file could not be read to its end")
        return trimesh.load_scene(file, file_type=path.suffix.lower()[1:], process=False)
