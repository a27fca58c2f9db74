"""STL, the stereolithography format: triangles without shared vertices, as text or binary."""

from pathlib import Path

import numpy as np

from app.files.file_access import NamedFiles, open_input
from app.files.mesh_formats import reading
from core.scene import Mesh

HEADER = 84
"""Bytes before the first triangle of a binary file: 80 of any text and the number of triangles."""

TRIANGLE = 50
"""Bytes of a triangle in a binary file."""

MEMORY_PER_TRIANGLE = 600
"""Bytes of memory that a triangle of a binary file takes at most while it is opened (measured)."""

MEMORY_PER_BYTE = 10
"""Bytes of memory that a byte of a text file takes at most while it is opened (measured)."""


def read_stl(path: Path, report: reading.Report, files: NamedFiles) -> reading.LoadedMeshes:
    """Read an STL file; each of its solids is a mesh.

    The triangles share no vertices and keep no normals of the file, so that each is shaded by its own plane. Raises
    MeshFileError if the file is cut short, is no STL file, or has no triangles; OSError if ``path`` cannot be read.
    """
    count, is_binary = check_layout(path)
    report(None, "reading triangles")
    if is_binary:
        return read_binary(path, count)
    with reading.translated_errors(path, "some of its triangles are no three corners of three numbers"):
        scene = reading.load_with_trimesh(path)
    report(None, "checking")
    meshes = [
        Mesh(
            positions=np.asarray(part.vertices),
            triangles=np.asarray(part.faces),
            name=str(part.metadata.get("name") or path.stem),
        )
        for part in scene.geometry.values()
        if len(getattr(part, "faces", ()))
    ]
    found = sum(len(mesh.triangles) for mesh in meshes)
    if found != count:
        raise reading.MeshFileError(
            f"{path.name} is cut short or broken: {found} of its {count} triangles can be read"
        )
    if not meshes:
        raise reading.MeshFileError(f"{path.name} has no faces")
    return reading.LoadedMeshes(tuple(meshes))


def read_binary(path: Path, count: int) -> reading.LoadedMeshes:
    """Read the ``count`` triangles of a binary file."""
    if not count:
        raise reading.MeshFileError(f"{path.name} has no faces")
    row = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    with open_input(path) as file:
        found = np.fromfile(file, row, count, offset=HEADER)
    positions = found["corners"].astype(np.float64).reshape(-1, 3)
    del found
    reading.check_positions(path, positions)
    positions.flags.writeable = False
    triangles = np.arange(len(positions)).reshape(-1, 3)
    return reading.LoadedMeshes((Mesh(positions=positions, triangles=triangles, name=path.stem),))


def check_layout(path: Path) -> tuple[int, bool]:
    """Return the number of triangles and whether ``path`` is binary, or raise MeshFileError if it is no STL file."""
    size, head = path.stat().st_size, reading.first_bytes(path, HEADER)
    count = int.from_bytes(head[80:84], "little")
    if len(head) == HEADER and size == HEADER + TRIANGLE * count:
        reading.check_memory(path, count * MEMORY_PER_TRIANGLE)
        return count, True
    if head.lstrip()[:5].lower() == b"solid" and b"\0" not in head:
        reading.check_memory(path, size * MEMORY_PER_BYTE)
        with open_input(path) as file:
            return file.read().lower().count(b"outer loop"), False
    if HEADER <= size < HEADER + TRIANGLE * count and size > HEADER + TRIANGLE * count // 20:
        there = (size - HEADER) // TRIANGLE
        raise reading.MeshFileError(
            f"{path.name} is cut short: it counts {count} triangles and ends after {there}"
        )
    raise reading.MeshFileError(
        f"{path.name} is not an STL file: it is not text, and its length does not match its number of triangles"
    )
