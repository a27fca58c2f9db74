"""OFF, the object file format of Geomview: counts, vertices, polygons."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from app.files.file_access import NamedFiles, open_text_input
from app.files.mesh_formats import reading
from app.files.mesh_formats.images import linear_from_srgb
from core.records.arrays import Floats
from core.scene import Mesh

MEMORY_PER_BYTE = 16
"""Bytes of memory that a byte of an OFF file takes at most while it is opened (measured)."""

REPORT_LINES = 20000
"""Lines between two reports of progress."""


@dataclass
class OffLines:
    """The numbers of an OFF file, as its lines give them."""

    normal_count: int = 0
    """Numbers of a normal in a vertex line: 0 or 3."""
    has_colors: bool = False
    color_is_float: bool = False
    """Whether colours go to 1 instead of 255."""
    positions: list[list[float]] = field(default_factory=list)
    normals: list[list[float]] = field(default_factory=list)
    colors: list[list[float]] = field(default_factory=list)
    sizes: list[int] = field(default_factory=list)
    corners: list[int] = field(default_factory=list)
    colored_faces: int = 0

    def vertex(self, words: list[str]) -> None:
        """Add a line of position, normal and colour, as far as the kind of file has them."""
        values = reading.numbers_of(words)
        color = 3 + self.normal_count
        least = color + 3 * self.has_colors
        if len(values) < least:
            raise ValueError(f"a vertex needs {least} numbers, got {len(values)}")
        self.positions.append(values[:3])
        if self.normal_count:
            self.normals.append(values[3:6])
        if self.has_colors:
            self.color_is_float |= any("." in word for word in words[color:])
            # A colour without alpha is opaque, whatever the scale turns out to be.
            self.colors.append([*values[color : color + 4], np.inf][:4])

    def face(self, words: list[str]) -> None:
        """Add a line of the number of corners, the corners, and maybe a colour."""
        (size,) = reading.whole_numbers_of(words[:1])
        if size < 3 or len(words) < size + 1:
            raise ValueError(f"a face of {size} corners names {len(words) - 1}, it needs 3 or more")
        self.sizes.append(size)
        self.corners += reading.whole_numbers_of(words[1 : size + 1])
        self.colored_faces += len(words) > size + 2

    def linear_colors(self) -> Floats | None:
        """Return (N, 4) linear colours of the vertices, if there are any."""
        if not self.has_colors:
            return None
        colors = np.clip(np.array(self.colors) / (1 if self.color_is_float else 255), 0, 1)
        colors[:, :3] = linear_from_srgb(colors[:, :3])
        return np.asarray(colors)


def read_off(path: Path, report: reading.Report, files: NamedFiles) -> reading.LoadedMeshes:
    """Read an OFF file, also with colours (COFF) and normals (NOFF) of vertices.

    Colours count as sRGB, from 0 to 255 or, where one has a point, from 0 to 1. Colours of faces are left out with a
    warning. Raises MeshFileError if a line cannot be read, the file is cut short, or a face names a vertex that is not
    there; OSError if ``path`` cannot be read.
    """
    reading.check_memory(path, path.stat().st_size * MEMORY_PER_BYTE)
    reading.check_text(path, "OFF")
    found = read_lines(path, report)
    if not found.positions:
        raise reading.MeshFileError(f"{path.name} has no vertices")
    if not found.sizes:
        raise reading.MeshFileError(f"{path.name} has no faces")
    report(None, "joining corners")
    positions, sizes = np.array(found.positions), np.array(found.sizes, np.int64)
    corners = np.array(found.corners, np.int64)
    reading.check_positions(path, positions)
    reading.check_polygons(path, sizes, corners, len(positions))
    places, faces = reading.triangulate_polygons(positions, corners, sizes, report)
    mesh = Mesh(
        positions=positions,
        triangles=corners[places],
        normals=np.array(found.normals) if found.normals else None,
        colors=found.linear_colors(),
        faces=faces,
        name=path.stem,
    )
    colored = found.colored_faces
    return reading.LoadedMeshes((mesh,), (f"colours of {colored} faces are left out",) if colored else ())


def read_lines(path: Path, report: reading.Report) -> OffLines:
    """Read all lines of ``path``; a line that cannot be read raises MeshFileError with its number."""
    lines = content_lines(path, report)
    number, first = next(lines, (1, ""))
    kind = re.fullmatch(r"(ST)?(C?)(N?)OFF\s*([\d\s]*)", first)
    if kind is None:
        raise reading.MeshFileError(
            f"{path.name} is not an OFF file of text in 3D: it begins with {first[:20]!r}"
        )
    if kind[1]:
        raise reading.MeshFileError(f"{path.name} is a STOFF file; only OFF, COFF, NOFF and CNOFF are read")
    found = OffLines(normal_count=3 * bool(kind[3]), has_colors=bool(kind[2]))
    try:
        number, counts = (number, kind[4]) if kind[4] else next(lines)
        vertex_count, face_count = counts_of(counts)
        for _ in range(vertex_count):
            number, line = next(lines)
            found.vertex(line.split())
        for _ in range(face_count):
            number, line = next(lines)
            found.face(line.split())
    except StopIteration:
        raise reading.MeshFileError(
            f"{path.name} is cut short: it has fewer lines than its header counts"
        ) from None
    except ValueError as problem:
        raise reading.MeshFileError(f"{path.name}, line {number}: {problem}") from problem
    return found


def counts_of(line: str) -> tuple[int, int]:
    """Return how many vertices and faces a line counts."""
    if len(line.split()) < 2:
        raise ValueError(f"the numbers of vertices and faces are needed, got {line}")
    vertices, faces = reading.whole_numbers_of(line.split()[:2])
    return vertices, faces


def content_lines(path: Path, report: reading.Report) -> Iterator[tuple[int, str]]:
    """Yield number and text of every line that is more than a comment."""
    size, done = path.stat().st_size, 0
    with open_text_input(path) as file:
        for number, line in enumerate(file, 1):
            if number % REPORT_LINES == 0:
                report(min(1.0, done / size), "reading lines")
            done += len(line)
            text = line.partition("#")[0].strip()
            if text:
                yield number, text
