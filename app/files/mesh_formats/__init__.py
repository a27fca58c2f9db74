"""Readers of mesh files: a file goes in, meshes of the core and warnings come out.

Formats made of polygons (OBJ, PLY, OFF) are read here, line by line, because every triangle must keep its
place in the file and know its polygon, and a broken line must be named. trimesh's readers of these three
sort triangles before quads, regroup them by material and leave out what they do not understand. Formats made
of triangles (STL, GLB, glTF) go through trimesh.
"""

from app.files.mesh_formats.gltf import read_gltf
from app.files.mesh_formats.obj import read_obj
from app.files.mesh_formats.off import read_off
from app.files.mesh_formats.ply import read_ply
from app.files.mesh_formats.reading import LoadedMeshes, MeshFileError, Reader, Report
from app.files.mesh_formats.stl import read_stl

READERS: dict[str, Reader] = {
    ".obj": read_obj,
    ".ply": read_ply,
    ".stl": read_stl,
    ".off": read_off,
    ".glb": read_gltf,
    ".gltf": read_gltf,
}
"""Reader of every file name extension, in lower case."""

__all__ = ["READERS", "LoadedMeshes", "MeshFileError", "Reader", "Report"]
