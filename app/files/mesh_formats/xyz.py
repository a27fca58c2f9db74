"""XYZ, lists of points as scanners write them: three numbers a line, and maybe a colour."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from app.files.file_access import NamedFiles, open_text_input
from app.files.mesh_formats import reading
from app.files.mesh_formats.images import linear_from_srgb

MEMORY_PER_BYTE = 60
"""Bytes of memory that a byte of an XYZ file takes at most while it is opened (measured)."""


class Lines:
    """The lines of an XYZ file that hold points, with where the reading is."""

    def __init__(self, path: Path) -> None:
        self.path, self.number, self.text = path, 0, ""

    def __iter__(self) -> Iterator[str]:
        """Yield the numbers of each line, with spaces between them."""
        with open_text_input(self.path) as file:
            for self.number, line in enumerate(file, 1):
                self.text = line.partition("#")[0].replace(",", " ").strip()
                if self.text:
                    yield self.text


def read_xyz(path: Path, report: reading.Report, files: NamedFiles) -> reading.LoadedMeshes:
    """Read an XYZ file: x, y, z of each point, then red, green, blue and alpha from 0 to 255 where it has them.

    Commas count as spaces, and what follows a # is passed over. Further columns that are no colours are left out with a
    warning. Raises MeshFileError for the first line that does not have numbers as the first one has, at least three, or
    if there are no points; OSError if ``path`` cannot be read.
    """
    reading.check_memory(path, path.stat().st_size * MEMORY_PER_BYTE)
    reading.check_text(path, "XYZ")
    report(None, "reading lines")
    lines = Lines(path)
    first = next(iter(lines), "").split()
    if not first:
        raise reading.MeshFileError(f"{path.name} has no points")
    width = max(len(first), 3)
    try:
        reading.numbers_of([*first, "nothing"][:width])
        rows = np.loadtxt(lines, ndmin=2)
    except ValueError as problem:
        raise reading.MeshFileError(
            f"{path.name}, line {lines.number}: expected {width} numbers, got {lines.text[:40]}"
        ) from problem
    more, colors, warnings = rows[:, 3:], None, []
    if width in (6, 7) and ((more >= 0) & (more <= 255) & (more == np.floor(more))).all():
        colors = np.ones((len(rows), 4))
        colors[:, : width - 3] = more / 255
        colors[:, :3] = linear_from_srgb(colors[:, :3])
    elif width > 3:
        warnings.append(f"columns 4 to {width} are not colours from 0 to 255; they are left out")
    return reading.load_wires(
        path, reading.Wires(rows[:, :3], np.arange(len(rows))[:, None], colors), warnings
    )
