"""What every reader shares: its result, its error, its progress and the limit on memory."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np

from app.files.input_files import open_input
from app.files.named_files import NamedFiles
from app.session.memory import amounts, free_memory
from core.records.arrays import Floats, Integers
from core.records.words import counted
from core.scene import Mesh

LARGEST = float(np.finfo(np.float32).max)
"""Farthest place of a vertex on any axis: colours and depths are stored as 32-bit floats."""

MEMORY_LIMIT = 4 * 2**30
"""Most memory in bytes that opening a file may take, as estimated before it is read."""

Number = TypeVar("Number", int, float)
MOST_MESHES = 10_000
"""Meshes that a file may have: each takes its own time, however few triangles it has."""

Report = Callable[[float | None, str], None]
"""Told how far the work is, from 0 to 1 (``None``: cannot be said), and what is being done."""


DRAWING = 250
"""Bytes of memory that a vertex, and a corner of a triangle, takes once it is drawn (measured)."""


class MeshFileError(ValueError):
    """A mesh file cannot be opened; the message is one sentence for the person who chose it."""


class OutsideMeshError(MeshFileError):
    """A mesh file cannot be opened unless a file is read that lies outside its folder."""


@dataclass(frozen=True, eq=False)
class Wires:
    """Points or segments of a file without faces."""

    positions: Floats
    """(N, 3) float64."""
    index: Integers
    """(K, 1) int64 vertices of points, (K, 2) of segments."""
    colors: Floats | None = None
    """(N, 4) float64, linear."""

    @property
    def text(self) -> str:
        """What they are, with their number."""
        return counted(len(self.index), "segment" if self.index.shape[1] == 2 else "point")


@dataclass(frozen=True, eq=False)
class LoadedMeshes:
    """The meshes of a file, in its order, and what of it could not be had."""

    meshes: tuple[Mesh, ...]
    warnings: tuple[str, ...] = ()
    """One sentence for each thing that is missing though the file names it, as a texture."""
    wires: Wires | None = None
    """What the file has in place of faces; ``meshes`` is empty then."""


def load_wires(path: Path, wires: Wires, warnings: list[str]) -> LoadedMeshes:
    """Return the points or segments of a file, and say what was read; raise MeshFileError for a wrong vertex."""
    check_positions(path, wires.positions)
    count = len(wires.positions)
    wrong = (wires.index < 0) | (wires.index >= count)
    if wrong.any():
        raise MeshFileError(
            f"{path.name}: a line or point names vertex {int(wires.index[wrong][0]) + 1} of {count}, counted from 1"
        )
    said = f"{path.name} has no faces: {wires.text} {'is' if len(wires.index) == 1 else 'are'} drawn"
    return LoadedMeshes((), (said, *warnings), wires)


Reader = Callable[[Path, Report, NamedFiles], LoadedMeshes]
"""Reads the file at a path; the last argument finds the files that it names."""


def check_memory(path: Path, wanted: int) -> None:
    """Raise MeshFileError if opening ``path`` takes ``wanted`` bytes: more than MEMORY_LIMIT, or than are free."""
    limit = int(min(free_memory(), MEMORY_LIMIT))
    if wanted > limit:
        text, least = amounts(wanted, limit)
        raise MeshFileError(
            f"{path.name} is too large: opening it would take about {text} of memory, the limit is {least}"
        )


def check_mesh_count(path: Path, count: int, what: str) -> None:
    """Raise MeshFileError for more than MOST_MESHES meshes; ``what`` they are in the file, in the plural."""
    if count > MOST_MESHES:
        raise MeshFileError(f"{path.name} has {count:,} {what}, and at most {MOST_MESHES:,} are opened")


def numbers_of(words: Iterable[str]) -> list[float]:
    """Return the numbers of words; ValueError names the first that is none."""
    return [_number(float, word, "a number") for word in words]


def whole_numbers_of(words: Iterable[str]) -> list[int]:
    """Return the whole numbers of words; ValueError names the first that is none."""
    return [_number(int, word, "a whole number") for word in words]


def _number(read: Callable[[str], Number], word: str, what: str) -> Number:
    try:
        return read(word)
    except ValueError:
        raise ValueError(f"expected {what}, got {word[:40]}") from None


def check_positions(path: Path, positions: Floats, first: int = 0) -> None:
    """Raise MeshFileError for the first vertex that has no place within 32-bit floats.

    Parameters
    ----------
    path : Path
        The file, for the message.
    positions : (N, 3) float64
    first : int
        What the file calls the first vertex.
    """
    if not (positions.min(initial=0) >= -LARGEST and positions.max(initial=0) <= LARGEST):
        where = int(np.argmin((np.abs(positions) <= LARGEST).all(axis=1)))
        raise MeshFileError(
            f"{path.name}: vertex {where + first} is at {positions[where].tolist()}, "
            f"which is not a number or beyond {LARGEST:.3g}"
        )


def first_bytes(path: Path, count: int = 4096) -> bytes:
    """Return up to ``count`` bytes from the start of ``path``."""
    with open_input(path) as file:
        return file.read(count)


def check_text(path: Path, kind: str) -> None:
    """Raise MeshFileError if ``path`` begins like a binary file, which no ``kind`` file does."""
    if b"\0" in first_bytes(path):
        raise MeshFileError(f"{path.name} is not an {kind} file: it is not text")
