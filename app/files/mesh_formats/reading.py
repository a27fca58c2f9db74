"""What readers share: result, error, progress, the limit on memory, polygons as triangles, and trimesh."""

import logging
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from app.files.file_access import NamedFiles, open_input
from app.session.memory import amounts, free_memory
from core.records.arrays import Floats, Integers
from core.records.words import counted
from core.scene import Mesh

# What every reader shares: its result, its error, its progress and the limit on memory.


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


# From the polygons of a file to triangles that share vertices.


REPORT_POLYGONS = 5000
"""Polygons between two reports."""


def check_polygons(path: Path, sizes: Integers, indices: NDArray[Any], count: int) -> None:
    """Raise MeshFileError for a polygon of fewer than 3 corners or one that names a vertex that is not there.

    Parameters
    ----------
    path : Path
        The file, for the message.
    sizes : (P,) int64
    indices : (sum of sizes,) of any numbers
        Vertices of all corners, from 0.
    count : int
        Vertices that there are.
    """
    if sizes.min() < 3:
        face = int(np.argmax(sizes < 3))
        raise MeshFileError(f"{path.name}: face {face} needs at least 3 corners, got {sizes[face]}")
    wrong = ~((indices >= 0) & (indices < count) & (indices == np.floor(indices)))
    if wrong.any():
        corner = int(np.argmax(wrong))
        face = int(np.searchsorted(np.cumsum(sizes), corner, side="right"))
        raise MeshFileError(
            f"{path.name}: face {face} names vertex {indices[corner]:g}, the file has {count}, counted from 0"
        )


def fan(sizes: Integers) -> tuple[Integers, Integers]:
    """Split polygons into triangles around their first corner.

    Parameters
    ----------
    sizes : (P,) int64
        Corners of each polygon, at least 3; the corners of all polygons stand in one row.

    Returns
    -------
    corners : (T, 3) int64
        Places in the row of corners; triangles of a polygon stand together, in the order of the polygons.
    faces : (T,) int64
        The polygon of each triangle.
    """
    first = np.cumsum(sizes) - sizes
    counts = sizes - 2
    faces = np.repeat(np.arange(len(sizes)), counts)
    turn = np.arange(len(faces)) - np.repeat(np.cumsum(counts) - counts, counts)
    start = first[faces]
    return np.stack([start, start + turn + 1, start + turn + 2], axis=1), faces


def triangulate_polygons(
    vertices: Floats, indices: Integers, sizes: Integers, report: Report
) -> tuple[Integers, Integers]:
    """Split polygons into triangles: by a fan, or by cutting ears where a polygon is not convex.

    Parameters
    ----------
    vertices : (N, 3) float64
        Positions.
    indices : (C,) int64
        Vertices of the corners of all polygons, one polygon after the other.
    sizes : (P,) int64
    report : callable
        Told that there is something to do, many times where there is much.

    Returns
    -------
    corners : (T, 3) int64
    faces : (T,) int64
        As ``fan``.
    """
    if (sizes == 3).all():
        return np.arange(len(indices)).reshape(-1, 3), np.arange(len(sizes))
    corners, faces = fan(sizes)
    positions = vertices[indices]
    a, b, c = (positions[corners[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    count = len(sizes)
    polygon_normals = np.stack([np.bincount(faces, normals[:, k], count) for k in range(3)], axis=1)

    # A triangle of the fan that faces against its polygon shows a polygon that the fan leaves.
    against = np.unique(faces[(normals * polygon_normals[faces]).sum(axis=1) < 0])
    first_corner, first_triangle = np.cumsum(sizes) - sizes, np.cumsum(sizes - 2) - (sizes - 2)
    # The fan of a quad leaves it where its other diagonal does not.
    quads = against[sizes[against] == 4]
    for row, turned in enumerate(((3, 0, 1), (1, 2, 3))):
        corners[first_triangle[quads] + row] = first_corner[quads, None] + turned
    is_kept = np.ones(len(corners), np.bool_)
    for done, face in enumerate(against[sizes[against] > 4].tolist()):
        if done % REPORT_POLYGONS == 0:
            report(None, "splitting polygons")
        start, row = first_corner[face], first_triangle[face]
        found = cut_ears(positions[start : start + sizes[face]], polygon_normals[face])
        if not len(found):
            continue  # All its corners lie on one line: the fan is as good as anything.
        corners[row : row + len(found)] = start + found
        is_kept[row + len(found) : row + sizes[face] - 2] = False
    return corners[is_kept], faces[is_kept]


def cut_ears(positions: Floats, normal: Floats) -> Integers:
    """Triangulate one simple polygon by cutting off its ears.

    Parameters
    ----------
    positions : (n, 3) float64
    normal : (3,) float64
        Its normal, of any length.

    Returns
    -------
    (m, 3) int64
        Corners of the triangles, which turn as the polygon does: n - 2, or fewer where corners lie on one line or on
        each other, or where the polygon crosses itself.

    References
    ----------
    G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82, 1975. The library, Mapbox' earcut, finds the
    corners near an ear along a curve through the plane instead of looking at all of them.
    """
    from mapbox_earcut import triangulate_float64  # Not before there is a polygon that needs it.

    # Drop the axis that the polygon faces most, keeping the sense of rotation.
    axis = int(np.argmax(np.abs(normal)))
    flat = positions[:, [(axis + 1) % 3, (axis + 2) % 3]] * np.array([np.sign(normal[axis]) or 1.0, 1.0])
    ends = np.array([len(flat)], np.uint32)
    triangles = triangulate_float64(np.ascontiguousarray(flat), ends).reshape(-1, 3).astype(np.int64)
    (ax, ay), (bx, by), (cx, cy) = (flat[triangles[:, k]].T for k in range(3))
    is_turned = (bx - ax) * (cy - ay) < (by - ay) * (cx - ax)
    triangles[is_turned] = triangles[is_turned, ::-1]
    return triangles


def share_vertices(*indices: Integers) -> tuple[Integers, tuple[Integers, ...]]:
    """Make one vertex of all corners that agree in every index.

    Parameters
    ----------
    *indices : (T, 3) int64
        Numbers of position, texture coordinate, ...; -1 where a corner has none.

    Returns
    -------
    triangles : (T, 3) int64
        The vertices, which are in the order of the first index.
    sources : tuple of (N,) int64
        For each of ``indices``, the number that each vertex came with.
    """
    code = indices[0].ravel()
    for more in indices[1:]:
        width = int(more.max()) + 2
        code = np.unique(code * width + more.ravel() + 1, return_inverse=True)[1]
    if np.ptp(code) > 8 * len(code):
        code = np.unique(code, return_inverse=True)[1]
    code = code - code.min()
    corner_of = np.full(int(code.max()) + 1, -1)
    corner_of[code] = np.arange(len(code))
    is_used = corner_of >= 0
    triangles = (np.cumsum(is_used) - 1)[code].reshape(-1, 3)
    return triangles, tuple(more.ravel()[corner_of[is_used]] for more in indices)


# The boundary to trimesh: one call, its errors translated.


@contextmanager
def translated_errors(path: Path, reason: str) -> Iterator[None]:
    """Turn the many kinds of exceptions that trimesh raises on broken files into MeshFileError, for this ``reason``."""
    try:
        yield
    except MemoryError:
        raise
    except Exception as problem:
        kind = path.suffix[1:].upper()
        raise MeshFileError(f"{path.name} cannot be read as {kind}: {reason}") from problem


def load_with_trimesh(path: Path) -> Any:
    """Load ``path`` as what its extension says, without any clean-up.

    To be called under ``translated_errors``.
    """
    # trimesh takes a quarter of a second to import, which only those wait for who open such a file.
    import trimesh

    logging.getLogger("trimesh").setLevel(logging.CRITICAL)
    with open_input(path) as file, warnings.catch_warnings():
        # numpy.fromstring only warns where a text stops being numbers: half a mesh would pass as the whole.
        warnings.filterwarnings("error", message="string or file could not be read to its end")
        return trimesh.load_scene(file, file_type=path.suffix.lower()[1:], process=False)
