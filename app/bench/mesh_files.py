"""Meshes as files: written to be read, and what was read as a picture that can be compared."""

from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from app.bench.contender import Prepared
from app.bench.records import Bytes, Floats, Integers, MeshFile


def prepare_reading(
    work: MeshFile,
    stack: ExitStack,
    read: Callable[[Path], Any],
    arrays_of: Callable[[Any], tuple[Floats, Integers]],
) -> Prepared:
    """Write the file, which is read anew in every run; ``arrays_of`` gives positions and triangles of what was read."""
    folder = Path(stack.enter_context(TemporaryDirectory(prefix="rasterscope-bench-")))
    path = folder / f"sphere{work.extension}"
    path.write_bytes(file_bytes(work))
    return Prepared(lambda: read(path), picture=lambda found: corner_picture(*arrays_of(found)))


def corner_picture(positions: Floats, triangles: Integers) -> Bytes:
    """Return the corners (T, 3) as pixels whose colours are their places, none of them black."""
    return np.rint(100 * positions + 128).astype(np.uint8).take(triangles, axis=0)


def file_bytes(work: MeshFile) -> bytes:
    """Return the content of the file."""
    singles, indices = work.positions.astype("<f4"), work.triangles.astype("<i4")
    if work.extension == ".obj":
        vertices = [f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in work.positions.tolist()]
        polygons = [f"f {a} {b} {c}\n" for a, b, c in (work.triangles + 1).tolist()]
        return "".join(vertices + polygons).encode()
    if work.extension == ".ply":
        faces = np.zeros(len(indices), [("count", "u1"), ("corners", "<i4", 3)])
        faces["count"], faces["corners"] = 3, indices
        header = (
            f"ply\nformat binary_little_endian 1.0\nelement vertex {len(singles)}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {len(indices)}\nproperty list uchar int vertex_indices\nend_header\n"
        )
        return header.encode() + singles.tobytes() + faces.tobytes()
    rows = np.zeros(len(indices), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    rows["corners"] = singles[indices]
    return b"".join([bytes(80), len(rows).to_bytes(4, "little"), rows.tobytes()])
