"""Readers of mesh files: a file goes in, meshes of the core and warnings come out.

Text STL and DXF go through trimesh. The others are read here, because time or something promised would be lost there.
trimesh's OBJ, PLY and OFF sort triangles before quads, forget the polygons and open half a file as a whole one; its
glTF takes fractions for vertices, sparse positions for zeros and texture coordinates in whole numbers for large ones;
its XYZ takes two broken lines for two whole ones.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

from app.files.file_access import NamedFiles, OutsideWarning
from app.files.mesh_formats import reading
from app.files.mesh_formats.dxf import read_dxf
from app.files.mesh_formats.obj import read_obj
from app.files.mesh_formats.off import read_off
from app.files.mesh_formats.ply import read_ply
from app.files.mesh_formats.stl import read_stl
from app.files.mesh_formats.xyz import read_xyz
from app.session.memory import MemoryBoundError
from core.scene import Mesh
from lessons.os_errors import os_error_reason


def read_gltf(path: Path, report: reading.Report, files: NamedFiles) -> reading.LoadedMeshes:
    """Read a GLB or glTF file; its reader, the largest, is loaded when there is one to read."""
    from app.files.mesh_formats import gltf

    return gltf.read_gltf(path, report, files)


READERS: dict[str, reading.Reader] = {
    ".obj": read_obj,
    ".ply": read_ply,
    ".stl": read_stl,
    ".off": read_off,
    ".glb": read_gltf,
    ".gltf": read_gltf,
    ".xyz": read_xyz,
    ".dxf": read_dxf,
}
"""Reader of every file name extension, in lower case."""

EXTENSIONS = tuple(READERS)
"""Endings of the files that open, in lower case with their dot."""

WARNINGS = 20
"""Most warnings about one file."""

TOGETHER = 4096
"""Triangles looked at together: nearly always some of the first have an area."""


def read_file(path: Path, report: reading.Report, allows_outside: bool = False) -> reading.LoadedMeshes:
    """Read ``path`` with the reader of its extension and check that there is something to draw.

    ``allows_outside``: files that it names may be read from outside its folder.
    """
    try:
        if path.is_dir():
            raise reading.MeshFileError(f"{path.name} is a folder, not a mesh file")
        reader = READERS.get(path.suffix.lower())
        if reader is None:
            extension = f"the extension {path.suffix}" if path.suffix else "no extension"
            known = ", ".join(EXTENSIONS)
            raise reading.MeshFileError(f"the file {path.name} has {extension}; files that open are {known}")
        if path.exists() and not path.is_file():
            raise reading.MeshFileError(f"{path.name} is not a file")
        if path.stat().st_size == 0:
            raise reading.MeshFileError(f"{path.name} is empty")
        # A signalling NaN, or a number that becomes infinite, would warn; it is refused like any other.
        with np.errstate(all="ignore"):
            loaded = reader(path, report, NamedFiles(path, allows_outside))
            if loaded.wires is None:
                check_meshes(path, loaded.meshes)
        loaded = replace(loaded, warnings=first_warnings(loaded.warnings))
    except reading.MeshFileError:
        raise
    except FileNotFoundError as problem:
        raise reading.MeshFileError(f"there is no file {path}") from problem
    except PermissionError as problem:
        raise reading.MeshFileError(f"{path.name} may not be read: permission is denied") from problem
    except OSError as problem:
        raise reading.MeshFileError(f"{path.name} cannot be read: {os_error_reason(problem)}") from problem
    except MemoryError as problem:
        raise reading.MeshFileError(
            f"{path.name} is too large: there is not enough memory for it"
        ) from problem
    except MemoryBoundError as problem:
        raise reading.MeshFileError(f"{path.name} is too large: {problem}") from problem
    except (LookupError, ValueError, ArithmeticError, RecursionError) as problem:
        # The checks of the core on the arrays of a mesh, and whatever a reader has not thought of.
        said = " ".join(str(problem).split())[:200] if type(problem) is ValueError else ""
        raise reading.MeshFileError(
            f"{path.name} cannot be used: {said or 'its parts do not fit together'}"
        ) from problem
    return loaded


def first_warnings(warnings: tuple[str, ...]) -> tuple[str, ...]:
    """Return as many warnings as a person may read, and how many more there are."""
    if len(warnings) <= WARNINGS:
        return warnings
    kept = sorted(warnings, key=lambda text: not isinstance(text, OutsideWarning))[:WARNINGS]
    return (*kept, f"{len(warnings) - WARNINGS} more warnings are not shown")


def check_meshes(path: Path, meshes: tuple[Mesh, ...]) -> None:
    """Raise MeshFileError if a vertex is too far away or no triangle has an area."""
    for mesh in meshes:
        reading.check_positions(path, mesh.positions)
    if not any(has_area(mesh, first) for mesh in meshes for first in range(0, len(mesh.triangles), TOGETHER)):
        raise reading.MeshFileError(f"{path.name} has only degenerate faces: no triangle has an area")


def has_area(mesh: Mesh, first: int) -> bool:
    """Whether some of the triangles looked at together, from ``first`` on, has an area."""
    corners = mesh.positions[mesh.triangles[first : first + TOGETHER]]
    sides = corners[:, 1:] - corners[:, :1]
    longest = np.abs(sides).max(axis=(1, 2), keepdims=True)
    sides /= np.where(longest > 0, longest, 1)
    return bool((np.abs(np.cross(sides[:, 0], sides[:, 1])) > 1e-12).any())
